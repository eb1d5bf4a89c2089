//! `treadmill robot`: prints what was understood of a robot, and drafts its card.

mod report;

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::Args;
use treadmill_config::Config;
use treadmill_humanoid::{EnvTask, EnvironmentConfig, HomePose, Model, Physics, TaskRegistry, card, mjcf};
use treadmill_render::{Camera, Picture, Scene, film};
use treadmill_runtime::atomic_file;

use crate::{
    launch::{exit_code::Usage, model, output::say},
    shared::{existing_file::existing_file, model_file::ModelFileArgs},
};

/// Width and height of the picture, in pixels.
const PICTURE: (u32, u32) = (640, 480);
/// Camera's place relative to the robot (m).
const CAMERA_M: [f64; 3] = [2.2, -1.6, 0.6];

/// Flags of `robot`.
#[derive(Args)]
pub struct RobotArgs {
    /// Robot card (TOML), MJCF or URDF file.
    #[arg(value_parser = existing_file)]
    file: PathBuf,
    /// Flags about that file.
    #[command(flatten)]
    files: ModelFileArgs,
    /// Complete the model by a built-in card: g1, g1-29, h1 or t1.
    #[arg(long, value_name = "NAME")]
    card: Option<String>,
    /// Write a picture of the default pose.
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Prints the report; for an MJCF or URDF file as comments of the card that it drafts.
pub fn run(args: &RobotArgs) -> anyhow::Result<()> {
    let mut config = Config::default();
    config.env.robot = args.card.clone().unwrap_or_default();
    let text = model::completed(&config, Some(&args.file), &args.files)?;
    let robot = Model::without_motors(&text).map_err(|why| model::in_file(Some(&args.file), &why))?;
    let is_card = robot.robot.is_some();
    let config = config.environment();
    let mut physics = Physics::new(robot.clone(), &config).map_err(|why| model::in_file(Some(&args.file), &why))?;
    let home = home(config, &text, is_card);
    let position = match (&robot.robot, robot.keyframes.first()) {
        (Some(card), _) => card.default_position.clone(),
        (None, Some(key)) => key.position.clone(),
        (None, None) => robot.nominal_position(),
    };
    if let Some(path) = &args.png {
        physics.set_state(&position, &vec![0.0; robot.velocity_size()]);
        let camera = Camera::following(position[0], position[1], CAMERA_M);
        let picture = film::png(&Picture::of(&Scene::of(&physics), &camera, PICTURE))?;
        atomic_file::write(path, &picture).map_err(|why| Usage(format!("--png {}: {why}", path.display())))?;
    }
    // Numbers of links and hinges are those with all hinges at zero.
    let mut at_zero = robot.nominal_position();
    at_zero[7..].fill(0.0);
    physics.set_state(&at_zero, &vec![0.0; robot.velocity_size()]);
    // Nothing but a viewer needs them.
    let meshes = mjcf::visual_meshes(&args.file, &args.files.files()).map_or(0, |meshes| meshes.len());
    if args.json {
        say(&report::json(&physics, &text, meshes, home.as_ref()).to_string());
        return Ok(());
    }
    let lines = report::lines(&robot, &text, &args.file, meshes, home.as_ref());
    if is_card {
        say(lines.trim_end());
        return Ok(());
    }
    let file = from_standard_output(&args.file);
    let comments: String = lines.lines().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
    say(&format!("{comments}\n{}", card::draft(&robot, &file).trim_end()));
    Ok(())
}

/// Examines the default pose; `None` for a model that no task simulates yet, such as one without motors.
fn home(mut config: EnvironmentConfig, text: &str, is_card: bool) -> Option<HomePose> {
    // Heights that are healthy belong to a training.
    config.env.terminate_when_unhealthy = false;
    config.env.task = if is_card { EnvTask::Velocity } else { config.env.task };
    HomePose::of(&config, text, &TaskRegistry::default()).ok()
}

/// Returns the path of a file as the card on standard output names it: from the folder of the card, if that is a file.
fn from_standard_output(file: &Path) -> String {
    let Ok(whole) = fs::canonicalize(file) else { return file.display().to_string() };
    let card = fs::read_link("/proc/self/fd/1").ok().filter(|card| card.is_file());
    let folder = card.as_deref().and_then(Path::parent).and_then(|folder| fs::canonicalize(folder).ok());
    match folder {
        Some(folder) => whole.strip_prefix(folder).unwrap_or(&whole).display().to_string(),
        None => file.display().to_string(),
    }
}
