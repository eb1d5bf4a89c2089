//! Collects rollouts with a policy and delivers them to the learner; plays evaluations.
//!
//! # Layout, in the order of the data
//! - [`settings`]: reads the run's configuration and maps it to the environment's.
//! - [`environments`]: N humanoids that step together, and their episodes.
//! - [`acting_policy`]: the networks and statistics of one policy bundle, ready to choose actions.
//! - [`identity`]: name and number of an actor process.
//! - [`rollout`]: collects fragments of T control steps.
//! - [`delivery`]: sends fragments until each has a receipt, and keeps accepted ones until they are durable.
//! - [`policy_fetcher`]: joins a run and fetches the newest policy.
//! - [`pool`]: an actor that belongs to no run finds one.
//! - [`poses`]: poses of the first environment for observers.
//! - [`worker`]: one actor process.
//! - [`agent`]: agents that an evaluation can play: the trained policy and two baselines.
//! - [`evaluation`]: plays episodes without learning and computes their statistics.
//! - [`evaluator`]: one evaluator process.
//!
//! Physics runs on its own thread; async tasks use the bus.

pub mod acting_policy;
pub mod agent;
pub mod delivery;
pub mod environments;
mod error;
pub mod evaluation;
pub mod evaluator;
pub mod identity;
pub mod policy_fetcher;
pub mod pool;
pub mod poses;
pub mod rollout;
pub mod settings;
pub mod worker;

pub use error::ActorError;
