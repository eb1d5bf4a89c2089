//! Treadmill's command line: one file per subcommand, each thin.
//!
//! # Layout
//! - [`train`], [`learner`], [`actor`], [`evaluator`], [`router`], [`status`], [`control`], [`certs`], [`eval`],
//!   [`export`], [`runs`], [`bench`]: the subcommands.
//! - [`watch`]: hands over to the viewer. What the two share is a library (`src/lib.rs`).
//! - [`filming`]: pictures of an evaluation.
//! - [`startup`]: from flags to a run that is ready to begin.
//! - [`task`]: what a run trains where other programs simulate it.
//! - [`supervisor`]: the actor processes of `train`.
//! - [`one_core`]: why an encrypted router works on one.
//! - [`model`]: the robot, built in or from a file.
//! - [`metrics_page`]: metrics for Prometheus, over HTTP.
//! - [`memory`]: what becomes of memory that was freed.
//! - [`greeting`]: what `train` and `learner` say before and after.
//! - [`check`]: what is wrong with a machine.
//! - [`manual`]: completions, manual pages, and the generated part of the reference.

mod actor;
mod bench;
mod certs;
mod check;
mod control;
mod eval;
mod evaluator;
mod export;
mod filming;
mod greeting;
mod learner;
mod manual;
mod memory;
mod metrics_page;
mod model;
mod one_core;
mod router;
mod runs;
mod startup;
mod status;
mod supervisor;
mod task;
mod train;
mod watch;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use treadmill_rl::{log, operator, outcome, output, patience, saved_policy, signals, viewing};

/// Distributed reinforcement learning for humanoid robots.
///
/// Exit codes: 0 done, 1 failed, 2 wrong usage or configuration, 130 after a second Ctrl-C.
#[derive(Parser)]
#[command(name = "treadmill", version, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Train: a learner in this process, and actor processes beside it.
    Train(train::TrainArgs),
    /// Run only the learner; actors join from other terminals or machines.
    Learner(learner::LearnerArgs),
    /// Run only an actor; task and settings come from the learner.
    Actor(actor::ActorArgs),
    /// Evaluate the policies of a run while it trains; `train` starts one by itself.
    Evaluator(evaluator::EvaluatorArgs),
    /// Play deterministic episodes with a trained policy, or with one of the baselines.
    Eval(eval::EvalArgs),
    /// See the humanoid move, in a browser: a trained policy, or with --live a run while it trains.
    #[command(mut_arg("folder", |arg| arg.help(viewing::RUN_HELP)))]
    Watch(viewing::ViewArgs),
    /// Write a trained policy as a file that other programs read.
    Export(export::ExportArgs),
    /// Compare runs: how far they walk, how long they took, and what they were configured otherwise.
    Runs(runs::RunsArgs),
    /// Tell how runs go, and who takes part.
    Status(status::StatusArgs),
    /// Command a learner: pause, resume, checkpoint, stop, or set a key of its configuration.
    Control(control::ControlArgs),
    /// Hand messages on between machines: actors dial it, it dials the learner.
    Router(router::RouterArgs),
    /// Make the certificates that let only your own machines onto the bus.
    Certs(certs::CertsArgs),
    /// Measure speed.
    Bench(bench::BenchArgs),
    /// Look for what is wrong with this machine, or with the way to a learner, and tell what to do.
    Check(check::CheckArgs),
    /// Print a script by which a shell completes commands and flags.
    Completions(manual::CompletionsArgs),
    /// Write manual pages, one for each command.
    Man(manual::ManArgs),
    /// Print a generated page of docs/reference/.
    #[command(hide = true)]
    Reference(manual::ReferenceArgs),
}

fn main() -> ExitCode {
    // Candle would spread its larger element-wise operations over threads of its own, which wait by spinning and take the
    // cores from physics and from the update's threads.
    // SAFETY: no other thread is there yet that could read or write the environment.
    unsafe { std::env::set_var("CANDLE_NUM_THREADS", "1") };
    let command = Cli::parse().command;
    log::begin("");
    let done = match command {
        Command::Train(args) => train::run(args),
        Command::Learner(args) => learner::run(args),
        Command::Actor(args) => actor::run(args),
        Command::Evaluator(args) => evaluator::run(args),
        Command::Eval(args) => eval::run(args),
        Command::Watch(_) => watch::run(),
        Command::Export(args) => export::run(&args),
        Command::Runs(args) => runs::run(&args),
        Command::Status(args) => status::run(args),
        Command::Control(args) => control::run(args),
        Command::Router(args) => router::run(args),
        Command::Certs(args) => certs::run(&args),
        Command::Bench(args) => bench::run(args),
        Command::Check(args) => return check::run(args),
        Command::Completions(args) => {
            manual::completions(&args, Cli::command());
            Ok(())
        }
        Command::Man(args) => manual::man(&args, Cli::command()),
        Command::Reference(args) => {
            manual::reference(&args, Cli::command());
            Ok(())
        }
    };
    outcome::exit_code(done)
}
