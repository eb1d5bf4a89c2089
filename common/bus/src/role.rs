//! Roles on the bus.

/// Role of a process on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Trains; may use every key.
    Learner,
    /// Follows a run, and becomes its learner when that is gone; may use every key.
    Standby,
    /// Forwards messages of other processes.
    Router,
    /// Simulates: reads policies and the status; sends rollouts, statistics, episodes and poses.
    Actor,
    /// Evaluates: reads policies, sends reports.
    Evaluator,
    /// Watches: reads metrics, episodes, poses, statistics, policies and liveliness.
    Observer,
    /// Watches, and sends commands to the learner.
    Operator,
}

impl Role {
    /// All roles.
    pub const ALL: [Self; 7] =
        [Self::Learner, Self::Standby, Self::Router, Self::Actor, Self::Evaluator, Self::Observer, Self::Operator];

    /// Returns the name, as in file names.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Learner => "learner",
            Self::Standby => "standby",
            Self::Router => "router",
            Self::Actor => "actor",
            Self::Evaluator => "evaluator",
            Self::Observer => "observer",
            Self::Operator => "operator",
        }
    }

    /// Returns the common name in its certificate.
    #[must_use]
    pub fn common_name(self) -> String {
        format!("treadmill-{}", self.name())
    }

    /// Returns the common name in the certificate of a pool's actors. Only listeners that admit the pool know it.
    #[must_use]
    pub fn common_name_of_pool(pool: &str) -> String {
        format!("{}-{pool}", Self::Actor.common_name())
    }

    /// Returns whether others dial this role. Its certificate must then name the hosts it listens on.
    #[must_use]
    pub fn listens(self) -> bool {
        matches!(self, Self::Learner | Self::Standby | Self::Router)
    }
}
