//! Flows of the bus: a file for each kind of message, with its key and both of its ends. Here is what each side needs.

mod control;
mod episodes;
mod evaluation;
mod metrics;
mod policies;
mod pool;
mod poses;
mod presence;
mod rollouts;
mod shared;
mod stats;
mod subscription;
mod tasks;
mod watched;

/// What a learner needs, and a router that answers for it.
pub mod learner {
    pub use super::{
        control::{ControlServer, PendingRequest},
        evaluation::EvaluationServer,
        metrics::publish_metric,
        policies::{
            cache::{PolicyCache, SilentLearner},
            pieces::ServedPolicies,
            server::{PolicyServer, PublishedPolicy},
            standby_mark::StandbyMark,
        },
        pool::{
            server::{PendingDemand, PendingJoin, PoolEvent, PoolServer},
            watch::PoolWatch,
        },
        presence::{Alive, AliveView},
        rollouts::{
            copies::RolloutCopies,
            intake::{IncomingFragment, RolloutIntake},
            received::ReceivedFragment,
        },
        stats::StatsFeed,
        tasks::{Objection, TaskServer},
    };
    pub use crate::admission::{
        Admission, AdmissionPermit, QUARANTINE, Refusal, Sender, Unread, rate_limited_log::RateLimitedLog,
    };
}

/// What actors and evaluators need.
pub mod actor {
    pub use super::{
        episodes::publish_episodes,
        evaluation::{Assignment, ask_for_evaluation},
        policies::{
            announcements::{Announcements, watch_announcements},
            fetch::{FetchedPolicy, fetch_newer_policy, fetch_policy},
            standby_mark::is_behind_standby,
        },
        pool::client::{PoolCalls, PoolRoom, ask_to_join, pool_demands, pool_token},
        poses::PosePublisher,
        presence::{is_actor_present, token},
        rollouts::intake::submit,
        stats::publish_stats,
        tasks::register_task,
        watched::Watched,
    };
}

/// What observers and operators need.
pub mod observer {
    pub use super::{
        control::{command, newest_of_each_run, statuses},
        metrics::MetricsFeed,
        poses::watch_poses,
        presence::{is_actor_present, is_learner_present, live_runs},
        subscription::{Feed, Message, observe},
    };
}
