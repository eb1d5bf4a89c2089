//! Treadmill's viewer: the humanoid in [Rerun](https://rerun.io), in a browser, in Rerun's own window or as a file.
//!
//! A program of its own, so that building the trainer does not build it; `treadmill watch` starts it.
//!
//! # Layout, in the order of the data
//! - [`player`]: poses of a saved policy that plays episodes here.
//! - [`live`]: poses of an actor that trains somewhere, from the bus.
//! - [`stage`]: a pose as what Rerun draws: body, floor, trail, contacts, curves.
//! - [`shapes`]: the model's shapes.
//! - [`layout`]: what stands where in the viewer, and the camera that follows.
//! - [`screen`]: where it goes: a browser, a window, a file.

mod layout;
mod live;
mod player;
mod screen;
mod shapes;
mod stage;

use std::{
    process::ExitCode,
    time::{Duration, Instant},
};

use clap::{CommandFactory, FromArgMatches, Parser};
use treadmill_common::shutdown::Shutdown;
use treadmill_humanoid::Model;
use treadmill_learner::checkpoint::Which;
use treadmill_rl::{log, operator::ReachArgs, outcome, outcome::Usage};

use crate::{
    layout::Pace,
    screen::{Screen, ScreenArgs},
    stage::Stage,
};

/// See the humanoid move.
///
/// Plays episodes with a saved policy, or with --live shows an actor while it trains. By default a viewer is served to a
/// browser on this machine; play, pause, step and speed are below its timeline.
#[derive(Parser)]
#[command(name = "treadmill watch", bin_name = "treadmill watch", version, max_term_width = 110)]
struct Cli {
    #[command(flatten)]
    reach: ReachArgs,
    /// Watch an actor of a run that trains now. RUN is its folder on this machine; elsewhere give --connect.
    #[arg(long)]
    live: bool,
    /// The actor to watch; by default the first that shows itself.
    #[arg(long, value_name = "NAME", requires = "live")]
    actor: Option<String>,
    /// End after so many seconds of motion.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    for_s: Option<f64>,
    /// Which checkpoint: best, latest, or the number of updates of a kept one; by default best if there is one.
    #[arg(long, value_name = "WHICH", conflicts_with = "live")]
    checkpoint: Option<Which>,
    /// Episodes to play; 0 shows the empty stage.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(..=1000), conflicts_with = "live")]
    episodes: u32,
    /// Seed of the resets, as for `eval`.
    #[arg(long, default_value_t = 1, conflicts_with = "live")]
    seed: u64,
    /// Show motion as it happens, at so many times the pace of the clock, rather than all of it at once.
    #[arg(long, value_name = "TIMES", value_parser = positive, conflicts_with = "live")]
    speed: Option<f64>,
    /// Let the camera stand still; it follows the torso otherwise.
    #[arg(long)]
    no_follow: bool,
    #[command(flatten)]
    screen: ScreenArgs,
}

/// The same flag means a little more here than for `status`.
const RUN_HELP: &str = "A run's folder, its name below runs/, a bundle file, or what `export` wrote; with --live the folder of a run \
                        that trains on this machine";

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("expected a number above 0".to_string()),
    }
}

fn main() -> ExitCode {
    let command = Cli::command().mut_arg("folder", |arg| arg.help(RUN_HELP));
    let cli = Cli::from_arg_matches(&command.get_matches()).unwrap_or_else(|why| why.exit());
    log::begin("");
    outcome::exit_code(if cli.live { live(&cli) } else { play(&cli) })
}

fn play(cli: &Cli) -> anyhow::Result<()> {
    let Some(run) = cli.reach.named() else {
        let why =
            "watch needs a RUN, as in `treadmill watch runs/walk-1`; or --live and, from another machine, --connect";
        return Err(Usage(why.to_string()).into());
    };
    let mut player = player::Player::load(run, cli.checkpoint)?;
    let (screen, mut stage) = set_up(cli, run, player.model(), Pace::Played)?;
    let begun = Instant::now();
    player.play(cli.episodes, cli.seed, |pose| {
        stage.show(pose)?;
        if let Some(speed) = cli.speed {
            let due = Duration::from_secs_f64(stage.shown_s() / speed);
            std::thread::sleep(due.saturating_sub(begun.elapsed()));
        }
        Ok(cli.for_s.is_none_or(|limit_s| stage.shown_s() < limit_s))
    })?;
    screen.finish(&Shutdown::default())
}

fn live(cli: &Cli) -> anyhow::Result<()> {
    let wish = live::Wish { reach: &cli.reach, actor: cli.actor.as_deref(), for_s: cli.for_s };
    live::run(&wish, |name, model| set_up(cli, name, model, Pace::Live))
}

fn set_up(cli: &Cli, name: &str, model: Model, pace: Pace) -> anyhow::Result<(Screen, Stage)> {
    let screen = cli.screen.open(name, cli.reach.is_insecure())?;
    let stage = Stage::new(screen.recording().clone(), model);
    let followed = (!cli.no_follow).then(|| stage.torso());
    layout::send(screen.recording(), followed, pace)?;
    stage.set_up()?;
    Ok((screen, stage))
}
