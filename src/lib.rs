//! Treadmill's command line: `treadmill` is [`main`], and the viewer (`watch/`) uses what is public here.
//!
//! # Layout
//! - `commands`: a file or folder for each subcommand.
//! - [`launch`]: starts and hosts a run; exit codes, signals, log and output of every command.
//! - [`shared`]: policies, and flags that several commands and the viewer have.
//! - `load_generator`: the processes of `bench bus`, which play a learner and many actors.

mod commands;
pub mod launch;
mod load_generator;
pub mod shared;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::{
    commands::{
        actor, bench, certs, check, control, eval, evaluator, export, learner, manual, router, runs, status, train,
        watch,
    },
    launch::{exit_code, log},
    shared::viewer_args,
};

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
    #[command(mut_arg("folder", |arg| arg.help(viewer_args::RUN_HELP)))]
    Watch(viewer_args::ViewerArgs),
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

/// Runs the command that the process's arguments name, and returns the exit code of the process.
///
/// Call it first in `main`: it changes the environment, which is allowed only before other threads run.
pub fn main() -> ExitCode {
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
    exit_code::exit_code(done)
}
