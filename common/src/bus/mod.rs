//! Sessions, keys and flows of the bus; the only place that names Zenoh.
//!
//! Rollouts and policies are queries, because a publication succeeds also when it goes nowhere. Announcements,
//! statistics and metrics are publications that may be dropped. No callback waits for anybody: each hands over
//! to a bounded queue, and a flood is slowed by naps (see `brake`).

mod actor_side;
mod arrival;
mod brake;
pub mod complaints;
mod control;
mod copies;
mod discovery;
mod door;
pub mod endpoint;
mod evaluation;
mod forbidden;
pub mod gate;
pub mod keys;
mod learner_side;
mod observer_side;
mod poses;
mod presence;
mod security;
mod session;
mod tasks;
pub mod threads;

pub use actor_side::{Announcements, fetch_policy, publish_dropping, submit, token, watch_announcements};
pub use arrival::Arrival;
pub use control::{ControlDesk, Inquiry, command, statuses};
pub use copies::RolloutCopies;
pub use door::turned_away;
pub use evaluation::{Assignment, EvaluationDesk, ask_for_evaluation};
pub use forbidden::{brake_forbidden, forbidden_messages};
pub use learner_side::{Delivery, PolicyShelf, RolloutIntake};
pub use observer_side::{Feed, Message, MetricsFeed, observe};
pub use poses::{PosePublisher, Watched};
pub use presence::{Alive, AliveView, StatsFeed};
pub use security::{Credentials, Role};
pub use session::{Bus, BusOptions};
pub use tasks::{Objection, TaskDesk, register_task};

/// Why the bus cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum BusError {
    /// An endpoint is not acceptable.
    #[error("endpoint `{endpoint}`: {why}")]
    Endpoint {
        /// As given.
        endpoint: String,
        /// What is wrong and what to do.
        why: String,
    },
    /// An endpoint cannot be listened on.
    #[error("cannot listen on `{endpoint}`: {why}; choose another port with --listen, or port 0 for any free one")]
    Listen {
        /// As given.
        endpoint: String,
        /// What the system said.
        why: String,
    },
    /// The process may open too few files.
    #[error(
        "this process may have {limit} files open, and the bus needs {needed}: raise the limit, as by `ulimit -Hn 4096`, \
         LimitNOFILE=4096 in systemd, or `docker run --ulimit nofile=4096`"
    )]
    OpenFiles {
        /// The limit.
        limit: u64,
        /// What is needed at least.
        needed: u64,
    },
    /// A setting was refused.
    #[error("{what}: {why}")]
    Config {
        /// Which setting.
        what: String,
        /// What the bus said.
        why: String,
    },
    /// The session could not be opened.
    #[error("the bus cannot be opened: {why}")]
    Open {
        /// What the bus said.
        why: String,
    },
    /// A declaration, query or publication failed.
    #[error("{what} failed on the bus: {why}")]
    Flow {
        /// What was tried.
        what: String,
        /// What the bus said.
        why: String,
    },
}

impl BusError {
    fn flow(what: impl Into<String>) -> impl FnOnce(zenoh::Error) -> Self {
        let what = what.into();
        move |why| Self::Flow { what, why: why.to_string() }
    }
}
