//! Pool: actors that belong to no run find one that needs them, and its learner admits and releases them.
//!
//! An actor that works sends nothing of this, and only learners hear what others want, so that a large pool costs the bus
//! next to nothing. [`server`]: a learner's side; [`client`]: an actor's side; [`watch`]: what runs want, for a router.

pub(super) mod client;
pub(super) mod server;
pub(super) mod watch;

/// Most runs whose demands are kept.
const RUNS_MAX: usize = 1024;

/// Returns `treadmill/{run}/pool/demand`.
fn demand_key(run: &str) -> String {
    format!("treadmill/{run}/pool/demand")
}

/// Returns `treadmill/{run}/pool/join/{actor}`.
fn join_key(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/pool/join/{actor}")
}

/// Returns `treadmill/{run}/pool/release/{actor}`.
fn release_key(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/pool/release/{actor}")
}

/// Returns `treadmill/{run}/pool/room`.
fn room_key(run: &str) -> String {
    format!("treadmill/{run}/pool/room")
}

/// Returns `treadmill/@pool/actors/{actor}/{envs}`, which is no key of a run: names of runs have no `@`.
fn actor_key(actor: &str, envs: &str) -> String {
    format!("treadmill/@pool/actors/{actor}/{envs}")
}
