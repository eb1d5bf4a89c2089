//! Errors that end an actor or an evaluator.

use std::io;

use tokio::task::JoinError;
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_proto::WIRE_VERSION;

/// Error that ends an actor or an evaluator.
#[derive(Debug, thiserror::Error)]
pub enum ActorError {
    /// The bus failed.
    #[error(transparent)]
    Bus(#[from] treadmill_bus::BusError),
    /// The model cannot be simulated.
    #[error("the humanoid model cannot be used")]
    Model(#[from] treadmill_humanoid::ModelError),
    /// The configuration in the policy bundle is invalid.
    #[error("the configuration in the policy bundle cannot be used")]
    Config(#[from] treadmill_config::ConfigError),
    /// The policy bundle is damaged or does not fit the model.
    #[error("the policy bundle of version {number} cannot be used: {why}")]
    Bundle {
        /// Number of the policy.
        number: u64,
        /// Reason, with its causes.
        why: String,
    },
    /// Another actor of the same name is in the run.
    #[error("an actor named `{name}` is in the run `{run}` already; choose another --name, or leave it out")]
    NameTaken {
        /// Name of the run.
        run: String,
        /// Name of both actors.
        name: String,
    },
    /// The run trains a task that this program does not simulate.
    #[error(
        "run `{run}` trains `{task}`, which this program does not simulate: it simulates the humanoid only; join with an \
         actor that has that environment, as in `python -m treadmill_actor --run {run} --env NAME` (see python/README.md)"
    )]
    OtherTask {
        /// Name of the run.
        run: String,
        /// Task that the run trains.
        task: String,
    },
    /// The run trains with another version of the physics.
    #[error(
        "this actor simulates physics {PHYSICS_VERSION}, the run `{run}` has physics {theirs}: use the same version of \
         treadmill as its learner"
    )]
    OtherPhysics {
        /// Name of the run.
        run: String,
        /// Version of the run's physics.
        theirs: u32,
    },
    /// The run sets keys that actors of this version do not know.
    #[error(
        "run `{run}` sets keys that this actor does not know ({unknown}): it needs actors of wire version {needed}, this \
         actor has {WIRE_VERSION}; use the same version of treadmill as its learner"
    )]
    UnknownKeys {
        /// Name of the run.
        run: String,
        /// Unknown keys of the sections that concern actors.
        unknown: String,
        /// Smallest wire version that knows them.
        needed: u32,
    },
    /// A fragment would be larger than the bus allows.
    #[error(
        "fragments of {envs} environments and {steps} steps are too large to send; allowed for {steps} steps: --envs \
         {envs_max}; start further actors for the other environments"
    )]
    FragmentSize {
        /// Environments of this actor.
        envs: u32,
        /// Control steps of a fragment.
        steps: u32,
        /// Most environments for these steps.
        envs_max: usize,
    },
    /// A fragment failed its own checks.
    #[error("the fragment cannot be encoded")]
    Encoding(#[source] treadmill_proto::Malformed),
    /// The task that delivers a fragment panicked.
    #[error("the delivery of a fragment failed")]
    Delivery(#[source] JoinError),
    /// The task that plays an evaluation panicked.
    #[error("the evaluation failed")]
    Evaluation(#[source] JoinError),
    /// The system refused the physics threads.
    #[error("the physics threads cannot be started")]
    ThreadStart(#[source] io::Error),
    /// The physics thread ended before it was stopped.
    #[error("the physics thread ended unexpectedly")]
    PhysicsEnded,
    /// The physics thread panicked.
    #[error("the physics thread panicked")]
    PhysicsPanicked,
}

impl ActorError {
    /// Returns whether another run may suit this program.
    pub(crate) fn is_of_run(&self) -> bool {
        matches!(
            self,
            Self::Model(_)
                | Self::Config(_)
                | Self::Bundle { .. }
                | Self::OtherTask { .. }
                | Self::OtherPhysics { .. }
                | Self::UnknownKeys { .. }
                | Self::FragmentSize { .. }
                | Self::NameTaken { .. }
                | Self::Encoding(_)
                | Self::PhysicsEnded
                | Self::PhysicsPanicked
        )
    }
}
