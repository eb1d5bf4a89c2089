//! `treadmill bench`: measures speed. Each benchmark prints its workload and a checksum of its result.
//!
//! # Layout
//! - [`env`]: environment steps.
//! - [`update`], [`policy`]: learner's update and actor's inference; [`network`]: their networks and inputs.
//! - [`train`]: a whole training run.

mod env;
pub(crate) mod network;
mod policy;
mod train;
pub(crate) mod update;

use clap::{Args, Subcommand};
use treadmill_humanoid::TaskRegistry;

/// Flags of `bench`.
#[derive(Args)]
pub struct BenchArgs {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Subcommand)]
enum Benchmark {
    /// Environment steps per second without a policy.
    Env(env::EnvArgs),
    /// Minibatch samples per second of the update.
    Update(update::UpdateArgs),
    /// Microseconds per call of an actor's policy.
    Policy(policy::PolicyArgs),
    /// Trained environment steps per second of the whole system.
    Train(train::BenchTrainArgs),
}

/// Runs one benchmark.
pub fn run(args: BenchArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    match args.benchmark {
        Benchmark::Env(args) => env::run(&args, tasks),
        Benchmark::Update(args) => update::run(&args),
        Benchmark::Policy(args) => policy::run(&args),
        Benchmark::Train(args) => train::run(&args),
    }
}

/// Rounds to one decimal.
fn rounded(rate: f64) -> f64 {
    (rate * 10.0).round() / 10.0
}
