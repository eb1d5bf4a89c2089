//! Treadmill's viewer: the humanoid in [Rerun](https://rerun.io), in a browser or as a file.
//!
//! `treadmill watch` starts this program. It is separate so that building the trainer does not build Rerun.
//!
//! # Layout, in the order of the data
//! - [`player`]: poses of a saved policy, from episodes played here.
//! - [`steering`]: commands from the keyboard.
//! - [`live`]: poses of a training actor, from the bus.
//! - [`scene_recorder`]: logs a pose to Rerun: body, floor, trail, contacts, curves.
//! - [`shapes`]: logs the model's shapes.
//! - [`layout`]: views and camera.
//! - [`viewer_output`]: browser or file.

mod layout;
mod live;
mod player;
mod scene_recorder;
mod shapes;
mod steering;
mod viewer_output;

use std::{
    process::ExitCode,
    time::{Duration, Instant},
};

use clap::{CommandFactory, FromArgMatches, Parser};
use treadmill_humanoid::{Model, mjcf::visual_meshes};
use treadmill_rl::{
    launch::{exit_code, exit_code::Usage, log},
    shared::viewer_args::{RUN_HELP, ViewerArgs},
};
use treadmill_runtime::shutdown::Shutdown;

use crate::{layout::PlayMode, scene_recorder::SceneRecorder, viewer_output::ViewerOutput};

/// See the humanoid move.
///
/// Plays episodes with a saved policy, or with --live shows an actor while it trains. By default the viewer is a page for a
/// browser on this machine; play, pause, step and speed are below its timeline.
#[derive(Parser)]
#[command(name = "treadmill watch", bin_name = "treadmill watch", version, max_term_width = 110)]
struct Cli {
    #[command(flatten)]
    view: ViewerArgs,
}

fn main() -> ExitCode {
    let command = Cli::command().mut_arg("folder", |arg| arg.help(RUN_HELP));
    let Cli { view } = Cli::from_arg_matches(&command.get_matches()).unwrap_or_else(|why| why.exit());
    log::begin("");
    exit_code::exit_code(if view.live { live(&view) } else { play(&view) })
}

fn play(view: &ViewerArgs) -> anyhow::Result<()> {
    let Some(run) = view.reach.folder.as_deref() else {
        let why =
            "watch needs a RUN, as in `treadmill watch runs/walk-1`; or --live and, from another machine, --connect";
        return Err(Usage(why.to_string()).into());
    };
    let mut player = player::Player::load(run, view.checkpoint)?;
    let mode = if view.steer { PlayMode::Live } else { PlayMode::Played };
    let shown =
        Shown { model: player.model(), control_step_s: player.control_step_s(), has_commands: player.has_commands() };
    let (output, mut recorder) = set_up(view, run, shown, mode)?;
    let is_within = |shown_s: f64| view.for_s.is_none_or(|limit_s| shown_s < limit_s);
    if view.steer {
        player.steer(view.seed, view.speed.unwrap_or(1.0), |pose| {
            recorder.show(pose)?;
            Ok(is_within(recorder.shown_s()))
        })?;
        return output.finish(&Shutdown::default());
    }
    let start = Instant::now();
    player.play(view.episodes, view.seed, |pose| {
        recorder.show(pose)?;
        if let Some(speed) = view.speed {
            let due = Duration::from_secs_f64(recorder.shown_s() / speed);
            std::thread::sleep(due.saturating_sub(start.elapsed()));
        }
        Ok(is_within(recorder.shown_s()))
    })?;
    output.finish(&Shutdown::default())
}

fn live(view: &ViewerArgs) -> anyhow::Result<()> {
    let options = live::LiveOptions { reach: &view.reach, actor: view.actor.as_deref(), for_s: view.for_s };
    live::run(&options, |name, shown| set_up(view, name, shown, PlayMode::Live))
}

/// Robot and task that are shown.
struct Shown {
    model: Model,
    control_step_s: f64,
    has_commands: bool,
}

fn set_up(
    view: &ViewerArgs,
    name: &str,
    shown: Shown,
    mode: PlayMode,
) -> anyhow::Result<(ViewerOutput, SceneRecorder)> {
    let output = ViewerOutput::open(&view.output, name, view.reach.network.insecure)?;
    layout::send(output.recording(), !view.no_follow, mode, &shown)?;
    let visuals = view
        .model
        .as_deref()
        .map(|file| visual_meshes(file, &view.model_file.files()))
        .transpose()?
        .unwrap_or_default();
    let recorder = SceneRecorder::new(output.recording().clone(), shown.model, visuals);
    recorder.set_up()?;
    Ok((output, recorder))
}
