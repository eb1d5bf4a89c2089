//! Sessions and flows of the message bus. No other crate names Zenoh.
//!
//! Rollouts and policies are queries, because a publication also succeeds when no subscriber receives it. Announcements,
//! statistics and metrics are publications, which the bus may drop. Callbacks never block on a receiver: each one hands over to
//! a bounded queue, and [`admission`] slows down links that send too much.
//!
//! # Layout
//! - [`session`]: opens sessions; builds Zenoh's configuration, keys, endpoints and access rules.
//! - [`admission`]: which senders may deliver fragments now, and what limits a flood.
//! - `flows`: one file for each kind of message.
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
    actor::{Announcements, fetch_policy, publish_dropping, submit, token, watch_announcements},
    control::{ControlServer, PendingRequest, command, statuses},
    copies::RolloutCopies,
    evaluation::{Assignment, EvaluationServer, ask_for_evaluation},
    observer::{Feed, Message, MetricsFeed, observe},
    policies::PolicyServer,
    poses::{PosePublisher, Watched},
    presence::{Alive, AliveView, StatsFeed},
    received::ReceivedFragment,
    rollouts::{IncomingFragment, RolloutIntake},
    tasks::{Objection, TaskServer, register_task},
};
pub use session::{
    Bus, BusOptions,
    access_rules::{Credentials, Role},
    endpoint, keys,
};
