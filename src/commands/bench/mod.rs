//! `treadmill bench`: measures speed. Each benchmark prints its workload and a checksum of its result.
//!
//! # Layout
//! - [`env`]: environment steps; [`quality`]: errors of joints and limits instead, counted by [`quantiles`].
//! - [`update`], [`policy`]: learner's update and actor's inference; [`network`]: their networks and inputs.
//! - [`bus`]: fragments from many actors; [`fleet`]: a whole learner among played actors (see `load_generator`).
//! - [`train`]: a whole training run.
//! - [`bench_worlds`]: humanoids that are stepped on several threads.

mod bench_worlds;
mod bus;
mod env;
mod fleet;
pub(crate) mod network;
mod policy;
mod quality;
mod quantiles;
mod train;
mod update;

use clap::{Args, Subcommand};

use crate::{
    launch::output::say,
    load_generator::{fleet::actors, host, load},
};

/// Flags of `bench`.
#[derive(Args)]
pub struct BenchArgs {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Subcommand)]
enum Benchmark {
    /// Environment steps per second without a policy, or errors of joint limits.
    Env(env::EnvArgs),
    /// Minibatch samples per second of the update.
    Update(update::UpdateArgs),
    /// Microseconds per call of an actor's policy.
    Policy(policy::PolicyArgs),
    /// Rates and latencies of a learner's bus with many actors.
    Bus(bus::BusArgs),
    /// Learner of `bus`.
    #[command(hide = true)]
    BusHost(host::HostArgs),
    /// Some of the actors of `bus`.
    #[command(hide = true)]
    BusLoad(load::LoadArgs),
    /// Share of experience that a learner uses, among actors of given rates.
    ///
    /// Starts `treadmill learner` of this binary, with its default settings and real updates, and played actors. On the
    /// bus, a played actor does what a real one does: it fetches policies, holds a liveliness token, sends fragments
    /// and waits for receipts. It does not simulate. A fragment of T × N transitions is ready T × N / rate seconds
    /// after its simulation began. A simulation begins when the previous one is finished and a credit is there, with
    /// the policy that is newest then. Actions and log-probabilities are those of that policy on random observations.
    ///
    /// `used_share`: environment steps learnt from / (these + dropped + lost ones); fragments under way do not count.
    /// `learner_used_share` is the learner's own metric rollout/used_share, if it has one.
    ///
    /// `update_steps_per_s`: environment steps of the batches / time in updates (time/update_s), the update's own
    /// speed. `update_steps_per_s_before` is the same before the measurement, while actors deliver as fast as they can
    /// (--rate auto).
    ///
    /// `trained_per_rate` and `trained_per_update`: environment steps learnt from per second / the sum of the rates, or
    /// / `update_steps_per_s`.
    ///
    /// `idle_share`: time in which actors wait for credit / all their time. `send_late_p99_ms`: time from the end of a
    /// simulation to its send; it is large if the played actors lack processor time.
    ///
    /// `checkpoint_ms`: saving the state. `publish_ms`: from the end of the update until the new policy is announced,
    /// which includes that. `serial_ms`: all work of the training thread per update outside the update, without waiting
    /// for fragments (time/serial_s). `training_thread_cpu_ms`: all processor time of that thread per update. Routers
    /// and played actors have the lowest priority, so that the learner has the machine as if they ran elsewhere.
    ///
    /// `learner_sent_mb_per_version`: bytes that the learner sent over all connections, by the counters of the program
    /// `ss`, / policy versions.
    ///
    /// `nothing_lost`: fragments produced = accepted + dropped by rule + in flight, and all accepted ones but the last
    /// batch were learnt from.
    Fleet(fleet::FleetArgs),
    /// Some of the actors of `fleet`.
    #[command(hide = true)]
    FleetActors(actors::PlayedActorsArgs),
    /// Trained environment steps per second of the whole system.
    Train(train::BenchTrainArgs),
}

/// Runs one benchmark.
pub fn run(args: BenchArgs) -> anyhow::Result<()> {
    match args.benchmark {
        Benchmark::Env(args) => env::run(&args),
        Benchmark::Update(args) => update::run(&args),
        Benchmark::Policy(args) => policy::run(&args),
        Benchmark::Bus(args) => bus::run(&args),
        Benchmark::BusHost(args) => host::run(&args),
        Benchmark::BusLoad(args) => load::run(&args),
        Benchmark::Fleet(args) => fleet::run(&args),
        Benchmark::FleetActors(args) => actors::run(&args),
        Benchmark::Train(args) => train::run(&args),
    }
}

/// Prints the result as one JSON object or as lines of text.
fn print_result(result: &serde_json::Value, json: bool) {
    if json {
        return say(&result.to_string());
    }
    for (name, value) in result.as_object().into_iter().flatten() {
        let value = value.as_str().map_or_else(|| value.to_string(), str::to_string);
        say(&format!("{name:<24} {value}"));
    }
}

/// Rounds to one decimal.
pub(crate) fn rounded(rate: f64) -> f64 {
    (rate * 10.0).round() / 10.0
}
