//! From environments to rollouts.
//!
//! # Layout, in the order of the data
//! - [`settings`]: the run's configuration as the environment takes it.
//! - [`environments`]: N humanoids that step together, and their episodes.
//! - [`acting`]: the policy in use.
//! - [`rollout`]: fragments of T control steps.
//! - [`courier`]: fragments to the learner, with receipts, credit and a window of what may have to be sent again.
//! - [`policies`]: the newest policy, announced and fetched.
//! - [`poses`]: what those who watch see.
//! - [`worker`]: all of it as one process.
//! - [`agent`]: whoever chooses actions in an evaluation.
//! - [`evaluation`]: episodes without learning, and their table.
//!
//! Physics runs on a thread of its own; the bus is spoken to from async tasks.

pub mod acting;
pub mod agent;
pub mod courier;
pub mod environments;
pub mod evaluation;
pub mod evaluator;
pub mod policies;
pub mod poses;
pub mod rollout;
pub mod settings;
pub mod worker;

/// Why an actor cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum ActorError {
    /// The bus failed.
    #[error(transparent)]
    Bus(#[from] treadmill_bus::BusError),
    /// The model cannot be simulated.
    #[error("the humanoid model cannot be used: {0}")]
    Model(#[from] treadmill_humanoid::ModelError),
    /// The configuration in the policy bundle cannot be used.
    #[error("the configuration in the policy bundle cannot be used: {0}")]
    Config(#[from] treadmill_config::ConfigError),
    /// The policy bundle does not fit.
    #[error("the policy bundle of version {number} cannot be used: {why}")]
    Bundle {
        /// The policy's number.
        number: u64,
        /// What is wrong.
        why: String,
    },
    /// The run trains what this program does not simulate.
    #[error(
        "run `{run}` trains `{task}`, which this program does not simulate: it trains the humanoid alone; join with an actor \
         that has that environment, as in `python -m treadmill_actor --run {run} --env NAME` (see python/README.md)"
    )]
    OtherTask {
        /// The run.
        run: String,
        /// What it trains.
        task: String,
    },
    /// The policy could not be evaluated.
    #[error("the policy cannot be evaluated: {0}")]
    Inference(#[from] candle_core::Error),
    /// The trace of an evaluation could not be written.
    #[error("the trace cannot be written: {why}")]
    Trace {
        /// What the system said.
        why: std::io::Error,
    },
    /// The physics thread is gone.
    #[error("the physics thread stopped: {why}")]
    Physics {
        /// Its last words.
        why: String,
    },
}
