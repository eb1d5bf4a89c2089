//! Sessions and flows of the message bus. No other crate depends on Zenoh.
//!
//! Rollouts and policies are queries, because a publication also succeeds when no subscriber receives it. Announcements,
//! statistics and metrics are publications, which the bus may drop. Callbacks never wait for a receiver: each one puts its
//! message into a bounded queue. Replies never wait for a requester that does not read: see [`session`].
//!
//! # Layout
//! - [`session`]: opens sessions; builds Zenoh's configuration, keys, endpoints and access rules.
//! - [`admission`]: decides which fragments are admitted, so that floods disturb no other sender.
//! - `flows`: sends and receives; one file for each kind of message.
//! - [`workarounds`]: code that exists only because of a fault in Zenoh.

pub mod admission;
mod error;
mod flows;
pub mod session;
pub mod workarounds;

pub use admission::tls_rejections::log_tls_rejections;
pub use error::BusError;
pub use flows::{
    control::{ControlServer, PendingRequest, command, newest_of_each_run, statuses},
    copies::RolloutCopies,
    evaluation::{Assignment, EvaluationServer, ask_for_evaluation},
    observer::{Feed, Message, MetricsFeed, observe},
    policies::{Announcements, PolicyServer, PublishedPolicy, watch_announcements},
    policy_cache::{PolicyCache, SilentLearner},
    policy_fetch::{FetchedPolicy, fetch_newer_policy, fetch_policy},
    policy_pieces::ServedPolicies,
    poses::PosePublisher,
    presence::{Alive, AliveView, is_actor_present, is_any_actor_present, is_learner_present, live_runs, token},
    publications::publish_dropping,
    received::ReceivedFragment,
    rollouts::{IncomingFragment, RolloutIntake, submit},
    standby_mark::{StandbyMark, is_behind_standby},
    stats::StatsFeed,
    tasks::{Objection, TaskServer, register_task},
    watched::Watched,
};
pub use session::{
    Bus, BusOptions,
    access_rules::{Credentials, Role},
    endpoint, keys,
};
