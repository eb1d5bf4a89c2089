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
use treadmill_runtime::shutdown::Shutdown;
use treadmill_humanoid::Model;
use treadmill_rl::{
    log, outcome,
    outcome::Usage,
    viewing::{RUN_HELP, ViewArgs},
};

use crate::{layout::Pace, screen::Screen, stage::Stage};

/// See the humanoid move.
///
/// Plays episodes with a saved policy, or with --live shows an actor while it trains. By default a viewer is served to a
/// browser on this machine; play, pause, step and speed are below its timeline.
#[derive(Parser)]
#[command(name = "treadmill watch", bin_name = "treadmill watch", version, max_term_width = 110)]
struct Cli {
    #[command(flatten)]
    view: ViewArgs,
}

fn main() -> ExitCode {
    let command = Cli::command().mut_arg("folder", |arg| arg.help(RUN_HELP));
    let Cli { view } = Cli::from_arg_matches(&command.get_matches()).unwrap_or_else(|why| why.exit());
    log::begin("");
    outcome::exit_code(if view.live { live(&view) } else { play(&view) })
}

fn play(view: &ViewArgs) -> anyhow::Result<()> {
    let Some(run) = view.reach.folder.as_deref() else {
        let why =
            "watch needs a RUN, as in `treadmill watch runs/walk-1`; or --live and, from another machine, --connect";
        return Err(Usage(why.to_string()).into());
    };
    let mut player = player::Player::load(run, view.checkpoint)?;
    let (screen, mut stage) = set_up(view, run, player.model(), Pace::Played)?;
    let begun = Instant::now();
    player.play(view.episodes, view.seed, |pose| {
        stage.show(pose)?;
        if let Some(speed) = view.speed {
            let due = Duration::from_secs_f64(stage.shown_s() / speed);
            std::thread::sleep(due.saturating_sub(begun.elapsed()));
        }
        Ok(view.for_s.is_none_or(|limit_s| stage.shown_s() < limit_s))
    })?;
    screen.finish(&Shutdown::default())
}

fn live(view: &ViewArgs) -> anyhow::Result<()> {
    let wish = live::Wish { reach: &view.reach, actor: view.actor.as_deref(), for_s: view.for_s };
    live::run(&wish, |name, model| set_up(view, name, model, Pace::Live))
}

fn set_up(view: &ViewArgs, name: &str, model: Model, pace: Pace) -> anyhow::Result<(Screen, Stage)> {
    let screen = Screen::open(&view.screen, name, view.reach.network.insecure)?;
    let stage = Stage::new(screen.recording().clone(), model);
    layout::send(screen.recording(), !view.no_follow, pace)?;
    stage.set_up()?;
    Ok((screen, stage))
}
