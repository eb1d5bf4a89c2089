//! `treadmill bench`: measures speed. Each benchmark prints its workload and a checksum of its result.
//!
//! # Layout
//! - [`env`]: environment steps; [`quality`]: errors of joints and limits instead, counted by [`quantiles`].
//! - [`update`], [`policy`]: learner's update and actor's inference; [`network`]: their networks and inputs.
//! - [`bus`]: fragments from many actors (see `load_generator`).
//! - [`train`]: a whole training run.
//! - [`bench_worlds`]: humanoids that are stepped on several threads.

mod bench_worlds;
mod bus;
mod env;
pub(crate) mod network;
mod policy;
mod quality;
mod quantiles;
mod train;
mod update;

use clap::{Args, Subcommand};

use crate::{
    launch::output::say,
    load_generator::{host, load},
};

/// Flags of `bench`.
#[derive(Args)]
pub struct BenchArgs {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Environment steps per second, with observation and without policy; or how well the joints hold.
    Env(env::EnvArgs),
    /// Minibatch samples per second of the update.
    Update(update::UpdateArgs),
    /// Microseconds that an actor's policy takes to choose actions.
    Policy(policy::PolicyArgs),
    /// Fragments that a learner takes from many actors, receipts, policies and memory.
    Bus(bus::BusArgs),
    /// The learner of `bus`.
    #[command(hide = true)]
    BusHost(host::HostArgs),
    /// Some of the actors of `bus`.
    #[command(hide = true)]
    BusLoad(load::LoadArgs),
    /// Trained environment steps per second of the whole system.
    Train(train::BenchTrainArgs),
}

/// Runs one bench.
pub fn run(args: BenchArgs) -> anyhow::Result<()> {
    match args.what {
        What::Env(args) => env::run(&args),
        What::Update(args) => update::run(&args),
        What::Policy(args) => policy::run(&args),
        What::Bus(args) => bus::run(&args),
        What::BusHost(args) => host::run(&args),
        What::BusLoad(args) => load::run(&args),
        What::Train(args) => train::run(&args),
    }
}

/// The result as one JSON object or as lines for people.
fn print_result(result: &serde_json::Value, json: bool) {
    if json {
        return say(&result.to_string());
    }
    for (name, value) in result.as_object().into_iter().flatten() {
        let value = value.as_str().map_or_else(|| value.to_string(), str::to_string);
        say(&format!("{name:<24} {value}"));
    }
}

/// Digits that say something.
pub(crate) fn rounded(rate: f64) -> f64 {
    (rate * 10.0).round() / 10.0
}
