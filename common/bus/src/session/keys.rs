//! The keys of the bus. Names are fixed: other tools subscribe to them.

/// `treadmill/{run}/policy/version`: announcements.
pub fn policy_version(run: &str) -> String {
    format!("treadmill/{run}/policy/version")
}

/// `treadmill/{run}/policy/latest`: the newest policy bundle.
pub fn policy_latest(run: &str) -> String {
    format!("treadmill/{run}/policy/latest")
}

/// `treadmill/{run}/rollouts/{actor}`: acknowledged fragments.
pub fn rollouts(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/rollouts/{actor}")
}

/// `treadmill/{run}/@rollouts/{actor}`: copies of accepted fragments; wildcards do not match `@`.
pub fn rollout_copies(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/@rollouts/{actor}")
}

/// `treadmill/{run}/tasks/{actor}`: what actors of external tasks register.
pub fn tasks(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/tasks/{actor}")
}

/// `treadmill/{run}/evaluations/{evaluator}`: reports handed in, policies to evaluate handed out.
pub fn evaluations(run: &str, evaluator: &str) -> String {
    format!("treadmill/{run}/evaluations/{evaluator}")
}

/// `treadmill/{run}/actors/{actor}`: liveliness.
pub fn actor(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/actors/{actor}")
}

/// `treadmill/{run}/learner`: liveliness.
pub fn learner(run: &str) -> String {
    format!("treadmill/{run}/learner")
}

/// `treadmill/{run}/actors/{actor}/stats`.
pub fn stats(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/actors/{actor}/stats")
}

/// The actor whose statistics come on a key of [`stats`].
pub fn stats_actor(key: &str) -> Option<&str> {
    key.strip_suffix("/stats").map(last_part)
}

/// `treadmill/{run}/episodes/{actor}`.
pub fn episodes(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/episodes/{actor}")
}

/// `treadmill/{run}/poses/{actor}`: how the body of an actor's first environment moves; `*` for any actor.
pub fn poses(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/poses/{actor}")
}

/// `treadmill/{run}/metrics/{group}/{name}`.
pub fn metric(run: &str, tag: &str) -> String {
    format!("treadmill/{run}/metrics/{tag}")
}

/// `treadmill/{run}/control`: commands to the learner.
pub fn control(run: &str) -> String {
    format!("treadmill/{run}/control")
}

/// `treadmill/{run}/status`: how the run goes, for those who may not command.
pub fn status(run: &str) -> String {
    format!("treadmill/{run}/status")
}

/// The part of a key after its last slash.
pub fn last_part(key: &str) -> &str {
    key.rsplit('/').next().unwrap_or(key)
}
