//! Command line of Treadmill: the program `treadmill` calls [`main`].
//!
//! # Layout
//! - `commands`: a file or folder for each subcommand.
//! - `diagnosis`: why no learner answers, for `check` and for every other command.
//! - [`launch`]: starting and hosting a run; exit codes, signals, log and output of every command.
//! - [`page`]: the page in the browser.
//! - [`shared`]: saved policies, and flags common to several commands.

mod commands;
mod diagnosis;
pub mod launch;
pub mod page;
pub mod shared;

use std::process::ExitCode;

/// The environment, for own tasks.
pub use treadmill_humanoid as humanoid;

use clap::{CommandFactory, Parser, Subcommand};

use crate::{
    commands::{
        actor, bench, certs, check, config, control, eval, evaluator, export, learner, manual, motion, robot, router,
        runs, status, sweep, train, watch,
    },
    launch::{exit_code, familiar_flags, log, output, processor, restart},
};

/// Distributed reinforcement learning for humanoid robots.
///
/// Exit codes: 0 done, 1 failed, 2 wrong usage or configuration, 130 after a second Ctrl-C.
#[derive(Parser)]
#[command(name = "treadmill", version = treadmill_runtime::program::version(), max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Train: run a learner in this process and start actor processes beside it.
    #[command(mut_arg("motion_fps", |arg| arg.visible_alias("fps")))]
    Train(train::TrainArgs),
    /// Train with several seeds or settings and compare them: each trial is a run of its own.
    #[command(mut_args(sweep::describe))]
    Sweep(sweep::SweepArgs),
    /// Run only the learner; actors join from other terminals or machines.
    #[command(mut_arg("motion_fps", |arg| arg.visible_alias("fps")))]
    Learner(learner::LearnerArgs),
    /// Run only an actor; the learner sends task and settings.
    Actor(actor::ActorArgs),
    /// Evaluate the policies of a run while it trains; `train` starts an evaluator itself.
    Evaluator(evaluator::EvaluatorArgs),
    /// Play deterministic episodes with a trained policy or a baseline.
    Eval(eval::EvalArgs),
    /// Show trained policies in a browser, steer them and compare them; or with --live an actor while it trains.
    #[command(mut_arg("folder", |arg| arg.help(watch::RUN_HELP)))]
    Watch(watch::WatchArgs),
    /// Write a trained policy as a file that other programs read.
    Export(export::ExportArgs),
    /// Print what was understood of a robot's file, and draft its card.
    Robot(robot::RobotArgs),
    /// Print what was understood of a motion file, make a film of it, and write it in mjlab's form.
    Motion(motion::MotionCommandArgs),
    /// Compare runs: distance walked, training time, and differences in configuration.
    Runs(runs::RunsArgs),
    /// Show the state of runs and of their actors.
    Status(status::StatusArgs),
    /// Command a learner: pause, resume, checkpoint, stop, or set a configuration key.
    Control(control::ControlArgs),
    /// Print the configuration, or explain one of its keys.
    Config(config::ConfigArgs),
    /// Forward messages between machines: actors dial the router, the router dials the learner.
    Router(router::RouterArgs),
    /// Create certificates that admit only your own machines to the bus.
    Certs(certs::CertsArgs),
    /// Measure speed.
    Bench(bench::BenchArgs),
    /// Examine this machine, the route to a learner and, by trial objects, a run's store; name problems and remedies.
    Check(check::CheckArgs),
    /// Print the script that completes commands and flags in a shell.
    Completions(manual::CompletionsArgs),
    /// Write one manual page per command.
    Man(manual::ManArgs),
    /// Print a generated page of docs/reference/.
    #[command(hide = true)]
    Reference(manual::ReferenceArgs),
}

/// Returns the definition of the command line.
#[must_use]
pub fn command_line() -> clap::Command {
    Cli::command()
}

/// Runs the command named by the process's arguments, and returns the exit code. `own_tasks` are tasks of the calling
/// program, under the names for `--task NAME`; see `examples/own_task.rs`.
///
/// Call it first in `main`: commands on the bus set an environment variable, which is sound only while no other thread runs.
///
/// # Panics
/// As [`humanoid::TaskRegistry::new`].
pub fn main(own_tasks: &[(&'static str, humanoid::task::TaskBuilder)]) -> ExitCode {
    treadmill_runtime::program::set_commit(env!("TREADMILL_COMMIT"));
    let tasks = humanoid::TaskRegistry::new(own_tasks);
    if !processor::is_supported() {
        return ExitCode::FAILURE;
    }
    run(&tasks)
}

/// Runs the command. Never part of [`main`], where the compiler would use instructions before they are known to exist.
#[inline(never)]
fn run(tasks: &humanoid::TaskRegistry) -> ExitCode {
    let command = match Cli::try_parse() {
        Ok(cli) => cli.command,
        Err(error) => {
            // Prints help to standard output and errors to standard error.
            let _ = error.print();
            familiar_flags::hint(&error).iter().for_each(|hint| output::say_error(hint));
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    restart::pause();
    log::begin("");
    // Training goes on without its output.
    let is_service = matches!(
        command,
        Command::Train(_)
            | Command::Sweep(_)
            | Command::Learner(_)
            | Command::Actor(_)
            | Command::Evaluator(_)
            | Command::Router(_)
    );
    let done = match command {
        Command::Train(args) => train::run(args, tasks),
        Command::Sweep(args) => sweep::run(&args, tasks),
        Command::Learner(args) => learner::run(args, tasks),
        Command::Actor(args) => actor::run(args, tasks),
        Command::Evaluator(args) => evaluator::run(args, tasks),
        Command::Eval(args) => eval::run(args, tasks),
        Command::Watch(args) => watch::run(&args, tasks),
        Command::Export(args) => export::run(&args, tasks),
        Command::Robot(args) => robot::run(&args),
        Command::Motion(args) => motion::run(&args),
        Command::Runs(args) => runs::run(&args),
        Command::Status(args) => status::run(args),
        Command::Control(args) => control::run(args),
        Command::Config(args) => config::run(&args),
        Command::Router(args) => router::run(args),
        Command::Certs(args) => certs::run(&args),
        Command::Bench(args) => bench::run(args, tasks),
        Command::Check(args) => {
            let verdict = check::run(args);
            return output::check_written().map_or_else(|why| exit_code::exit_code(Err(why)), |()| verdict);
        }
        Command::Completions(args) => {
            manual::completions(&args, command_line());
            Ok(())
        }
        Command::Man(args) => manual::man(&args, command_line()),
        Command::Reference(args) => {
            manual::reference(&args, command_line());
            Ok(())
        }
    };
    exit_code::exit_code(done.and_then(|()| if is_service { Ok(()) } else { output::check_written() }))
}
