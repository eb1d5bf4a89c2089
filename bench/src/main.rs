//! `treadmill-bench`: measures a learner's bus and a whole learner among many actors, which it plays itself.
//!
//! # Layout
//! - [`bus`]: real connections into the learner's real intake, without training. [`load_step`] starts the processes for one
//!   number of actors and measures them: [`host`] has the learner's intake, [`load`] simulates actors.
//! - [`fleet`]: a real learner with real updates among played actors.
//! - [`helper`]: starts these processes and exchanges lines with them.
//! - [`workload`]: the fragment and the policies that `bus` sends; [`raw`]: plain TCP for comparison; [`usage`]:
//!   processor time and memory of this process.

mod bus;
mod fleet;
mod helper;
mod host;
mod load;
mod load_step;
mod raw;
mod usage;
mod workload;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use treadmill_rl::launch::{exit_code, log};

/// Measures Treadmill's bus and learner. Needs the program `treadmill` in the same folder.
#[derive(Parser)]
#[command(name = "treadmill-bench", version, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    benchmark: Benchmark,
}

#[derive(Subcommand)]
enum Benchmark {
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
    /// Starts `treadmill learner`, with its default settings and real updates, and played actors. On the
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
    /// `checkpoint_ms`: saving the state. `publish_ms`: encoding and announcing the policy, releasing the receipts.
    /// `serial_ms`: all work of the training thread per update outside the update, without waiting for fragments
    /// (time/serial_s). `training_thread_cpu_ms`: all processor time of that thread per update. Routers
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
    FleetActors(fleet::actors::PlayedActorsArgs),
}

fn main() -> ExitCode {
    log::begin("");
    let outcome = match Cli::parse().benchmark {
        Benchmark::Bus(args) => bus::run(&args),
        Benchmark::BusHost(args) => host::run(&args),
        Benchmark::BusLoad(args) => load::run(&args),
        Benchmark::Fleet(args) => fleet::run(&args),
        Benchmark::FleetActors(args) => fleet::actors::run(&args),
    };
    exit_code::exit_code(outcome)
}

/// Rounds to one decimal.
fn rounded(rate: f64) -> f64 {
    (rate * 10.0).round() / 10.0
}
