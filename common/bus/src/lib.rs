//! Sessions and flows of the message bus. No other crate depends on Zenoh.
//!
//! Rollouts and policies are queries, because a publication also succeeds when no subscriber receives it. Announcements,
//! statistics and metrics are publications, which the bus may drop. Callbacks never wait for a receiver: each one puts its
//! message into a bounded queue, and [`admission`] throttles links that send too much.
//!
//! # Layout
//! - [`session`]: opens sessions; builds Zenoh's configuration, keys, endpoints and access rules.
//! - [`admission`]: decides which fragments are admitted, and throttles floods.
//! - `flows`: sends and receives; one file for each kind of message.
//! - [`workarounds`]: code that exists only because of a fault in Zenoh.

pub mod admission;
mod error;
mod flows;
pub mod session;
pub mod workarounds;

pub use admission::{
    acl_drops::{dropped_messages, throttle_drops},
    tls_rejections::log_tls_rejections,
};
pub use error::BusError;
pub use flows::{
    control::{ControlServer, PendingRequest, command, statuses},
    copies::RolloutCopies,
    evaluation::{Assignment, EvaluationServer, ask_for_evaluation},
    observer::{Feed, Message, MetricsFeed, observe},
    policies::{Announcements, PolicyServer, fetch_policy, watch_announcements},
    poses::PosePublisher,
    presence::{Alive, AliveView, token},
    publications::publish_dropping,
    received::ReceivedFragment,
    rollouts::{IncomingFragment, RolloutIntake, submit},
    stats::StatsFeed,
    tasks::{Objection, TaskServer, register_task},
    watched::Watched,
};
pub use session::{
    Bus, BusOptions,
    access_rules::{Credentials, Role},
    endpoint, keys,
};
