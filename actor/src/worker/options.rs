//! Options of an actor process, and its final report.

use treadmill_experience::delivery::DeliveryCounts;
use treadmill_humanoid::TaskRegistry;
use treadmill_runtime::numbers::thousands;

use crate::policy_fetcher::Explain;

/// Options of an actor process.
#[derive(Clone)]
pub struct WorkerOptions {
    /// Name of the run to join; without it, the only run of the endpoint.
    pub run: Option<String>,
    /// Whether it belongs to no run, and joins those that need it.
    pub is_pooled: bool,
    /// Name of the actor.
    pub name: String,
    /// Tasks that this program can simulate.
    pub tasks: TaskRegistry,
    /// Number of environments.
    pub envs: u32,
    /// Threads that step the environments; 0 means one per core. Overrides the run's `rollout.threads`.
    pub threads: Option<u32>,
    /// Number of this start, from which its random streams are derived.
    pub start: u64,
    /// What to do if the endpoint is a standby's.
    pub behind_standby: BehindStandby,
    /// Explains why the run does not answer.
    pub explain: Explain,
    /// Notifies the user when the actor joins, loses the learner, finds it again, or leaves.
    pub notify: fn(&str),
}

/// What an actor does whose endpoint is a standby's. With encrypted links, a standby may not pass fragments on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BehindStandby {
    /// Nothing: the standby passes everything on.
    Stay,
    /// Warns, because there is no other endpoint.
    Warn,
    /// Ends, so that the next endpoint can be tried.
    End,
}

/// Final report of an actor on its membership in one run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActorSummary {
    /// Incarnation that its fragments carry.
    pub incarnation: u64,
    /// Fragments by outcome.
    pub fragments: DeliveryCounts,
    /// Highest sequence number up to which every fragment is durable or dropped.
    pub settled_through: u64,
    /// Environment steps in all fragments.
    pub env_steps: u64,
}

impl ActorSummary {
    /// Returns the number of fragments that a learner has handled, and of simulated steps, as text.
    pub(crate) fn delivered(&self) -> String {
        let DeliveryCounts { accepted, dropped_by_rule, .. } = self.fragments;
        let fragments = thousands(accepted + dropped_by_rule);
        format!("{fragments} fragments delivered, {} steps simulated", thousands(self.env_steps))
    }
}
