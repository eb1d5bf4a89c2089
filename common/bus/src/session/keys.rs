//! Keys of the bus. They are fixed, because other tools subscribe to them.

/// Returns `treadmill/{run}/policy/version`: announcements of policies.
pub fn policy_version(run: &str) -> String {
    format!("treadmill/{run}/policy/version")
}

/// Returns `treadmill/{run}/policy/pieces`: the newest policy for actors, in pieces, from the learner.
pub fn policy_pieces(run: &str) -> String {
    format!("treadmill/{run}/policy/pieces")
}

/// Returns `treadmill/{run}/policy/pieces/{node}`: the same from the learner or router with this Zenoh ID.
pub fn policy_pieces_of(run: &str, node: &str) -> String {
    format!("treadmill/{run}/policy/pieces/{node}")
}

/// Returns `treadmill/{run}/policy/latest`: the newest policy bundle.
pub fn policy_latest(run: &str) -> String {
    format!("treadmill/{run}/policy/latest")
}

/// Returns `treadmill/{run}/rollouts/{actor}`: acknowledged fragments.
pub fn rollouts(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/rollouts/{actor}")
}

/// Returns `treadmill/{run}/@rollouts/{actor}`: copies of accepted fragments. Wildcards do not match `@`.
pub fn rollout_copies(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/@rollouts/{actor}")
}

/// Returns `treadmill/{run}/tasks/{actor}`: registrations of external tasks.
pub fn tasks(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/tasks/{actor}")
}

/// Returns `treadmill/{run}/evaluations/{evaluator}`: evaluation reports, answered with the next policy to evaluate.
pub fn evaluations(run: &str, evaluator: &str) -> String {
    format!("treadmill/{run}/evaluations/{evaluator}")
}

/// Returns `treadmill/{run}/actors/{actor}`: liveliness token.
pub fn actor(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/actors/{actor}")
}

/// Returns `treadmill/{run}/learner`: liveliness token.
pub fn learner(run: &str) -> String {
    format!("treadmill/{run}/learner")
}

/// Returns the run in a key of [`learner`].
pub fn learner_run(key: &str) -> Option<&str> {
    key.strip_prefix("treadmill/")?.strip_suffix("/learner")
}

/// Returns `treadmill/{run}/actors/{actor}/stats`: statistics.
pub fn stats(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/actors/{actor}/stats")
}

/// Returns the actor in a key of [`stats`].
pub fn stats_actor(key: &str) -> Option<&str> {
    key.strip_suffix("/stats").map(last_part)
}

/// Returns `treadmill/{run}/episodes/{actor}`: finished episodes.
pub fn episodes(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/episodes/{actor}")
}

/// Returns `treadmill/{run}/poses/{actor}`: poses of an actor's first environment; `*` stands for any actor.
pub fn poses(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/poses/{actor}")
}

/// Returns `treadmill/{run}/metrics/{tag}`, where a tag is `group/name`.
pub fn metric(run: &str, tag: &str) -> String {
    format!("treadmill/{run}/metrics/{tag}")
}

/// Returns `treadmill/{run}/control`: commands to the learner.
pub fn control(run: &str) -> String {
    format!("treadmill/{run}/control")
}

/// Returns `treadmill/{run}/status`: status requests, also from peers that may not send commands.
pub fn status(run: &str) -> String {
    format!("treadmill/{run}/status")
}

/// Returns the part of a key after its last slash.
pub fn last_part(key: &str) -> &str {
    key.rsplit('/').next().unwrap_or(key)
}
