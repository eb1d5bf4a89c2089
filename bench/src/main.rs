//! `treadmill-bench`: measures a learner's bus and a whole learner among many actors, which it plays itself.
//!
//! # Layout
//! - [`bus`]: real connections into the learner's real intake, without training, which [`host`] has. [`raw`]: plain TCP
//!   for comparison.
//! - [`fleet`]: a real learner with real updates. [`measurement`] starts it and marks the measured window, [`figures`]
//!   computes what is printed, from the metrics that [`run_metrics`] follows.
//! - [`played`]: processes of played actors, for both.
//! - [`pool`]: a pool of played actors among played learners.
//! - [`process`]: child processes, and their use of the machine.

mod bus;
mod figures;
mod fleet;
mod host;
mod measurement;
mod played;
mod pool;
mod process;
mod raw;
mod run_metrics;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use treadmill_rl::launch::{exit_code, log};

/// Name of every measured run on the bus.
const RUN: &str = "bench";

/// Measures Treadmill's bus and learner. Needs the program `treadmill` in the same folder.
#[derive(Parser)]
#[command(name = "treadmill-bench", version, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Subcommand)]
enum Benchmark {
    /// Rates and latencies of a learner's bus with many played actors.
    Bus(bus::BusArgs),
    /// Learner of `bus`.
    #[command(hide = true)]
    Host(host::HostArgs),
    /// Share of experience that a learner uses, among played actors of given rates.
    ///
    /// Starts `treadmill learner`, with its default settings and real updates, and played actors. On the bus, a played
    /// actor does what a real one does, by the same code. It does not simulate. A fragment of T × N transitions is
    /// ready T × N / rate seconds after its simulation began. A simulation begins when the previous one is finished
    /// and a credit is there. Actions and log-probabilities are those of the policy on random observations.
    ///
    /// `used_share`: environment steps learnt from / (these + dropped + lost ones); fragments under way do not count.
    /// `learner_used_share` is the learner's own metric rollout/used_share, if it has one.
    ///
    /// `update_steps_per_s`: environment steps of the batches / time in updates (time/update_s), the update's own
    /// speed. `trained_per_rate` and `trained_per_update`: environment steps learnt from per second / the sum of the
    /// rates, or / `update_steps_per_s`.
    ///
    /// `idle_share`: time in which actors wait for credit / all their time. `send_late_p99_ms`: time from the end of a
    /// simulation to its send; it is large if the played actors lack processor time, though learner and routers have
    /// the machine as if the actors ran elsewhere.
    ///
    /// `checkpoint_ms`: saving the state. `publish_ms`: encoding and announcing the policy, releasing the receipts.
    /// `serial_ms`: all work of the training thread per update outside the update (time/serial_s).
    /// `learner_sent_mb_per_version`: bytes that the learner sent over all connections, by the counters of the program
    /// `ss`, / policy versions.
    ///
    /// `nothing_lost`: fragments produced = accepted + dropped by rule + in flight, and all accepted ones but the last
    /// batch were learnt from.
    Fleet(fleet::FleetArgs),
    /// Pool of played actors among played learners that come and go.
    ///
    /// `distance_mean`: the sum over runs of the difference between what they have and their fair share, / the pool's
    /// actors, sampled four times a second; `distance_before_change_mean`: the same just before each change.
    /// `idle_actors_mean`: actors that had no run for more than 3 s. `move_median_s`: from the call to leave, or the
    /// notice that the learner is gone, to the token in the next run; nothing is simulated. `pool_bytes_per_s`: bytes on
    /// the loopback interface, all ends together, beyond those of the same sessions without a pool; nothing else may
    /// use it.
    Pool(pool::PoolArgs),
    /// Some of the played actors.
    #[command(hide = true)]
    Played(played::PlayedArgs),
}

fn main() -> ExitCode {
    log::begin("");
    let outcome = match Cli::parse().benchmark {
        Benchmark::Bus(args) => bus::run(&args),
        Benchmark::Host(args) => host::run(&args),
        Benchmark::Fleet(args) => fleet::run(&args),
        Benchmark::Pool(args) => pool::run(&args),
        Benchmark::Played(args) => played::run(&args),
    };
    exit_code::exit_code(outcome)
}
