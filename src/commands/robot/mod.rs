//! `treadmill robot`: prints what was understood of a robot, and drafts its card.

mod report;

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::Args;
use treadmill_config::Config;
use treadmill_humanoid::{
    EnvTask, EnvironmentConfig, HomePose, Model, ModelError, Physics, TaskRegistry, card::Proposal, mjcf,
};
use treadmill_render::{Look, film, portrait};
use treadmill_runtime::atomic_file;

use crate::{
    launch::{exit_code::Usage, model, output::say},
    shared::{existing_file::existing_file, model_file::ModelFileArgs},
};

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
    /// Write the card that is found to a file, ready to edit, instead of standard output.
    #[arg(long, value_name = "CARD.toml", conflicts_with_all = ["json", "card"])]
    draft: Option<PathBuf>,
    /// Write a picture of the default pose, from the front and from the right.
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Prints the report; for an MJCF or URDF file as comments of the card that is found.
pub fn run(args: &RobotArgs) -> anyhow::Result<()> {
    Usage::unless_writable("--draft", args.draft.as_deref())?;
    Usage::unless_writable("--png", args.png.as_deref())?;
    let mut config = Config::default();
    config.env.robot = args.card.clone().unwrap_or_default();
    let text = model::completed(&config, Some(&args.file), &args.files, "")?;
    let robot = Model::without_motors(&text).map_err(|why| model::in_file(Some(&args.file), &why))?;
    let is_card = robot.robot.is_some();
    let in_file = |why: &ModelError| model::in_file(Some(&args.file), why);
    let proposal = if is_card { None } else { Some(Proposal::of(&robot).map_err(|why| in_file(&why))?) };
    // With the card that is found, a walker is what `train --task velocity` trains.
    let with_card = |found: &Proposal| {
        let whole = mjcf::with_card(&text, &found.card)?;
        Model::without_motors(&whole).map(|model| (whole, model))
    };
    let complete = proposal.as_ref().filter(|found| found.missing.is_empty()).map(with_card);
    let (walker, shown) = match complete {
        Some(Ok(walker)) => walker,
        Some(Err(why)) => {
            tracing::warn!("the card that was found must be edited: {why}");
            (text.to_string(), robot.clone())
        }
        None => (text.to_string(), robot.clone()),
    };
    let config = config.environment();
    let mut physics = Physics::new(shown.clone(), &config).map_err(|why| in_file(&why))?;
    let home = home(config.clone(), &walker, shown.robot.is_some());
    let position = match (&shown.robot, shown.keyframes.first()) {
        (Some(card), _) => card.default_position.clone(),
        (None, Some(key)) => key.position.clone(),
        (None, None) => robot.nominal_position(),
    };
    // Nothing but a picture needs them.
    let meshes = mjcf::visual_meshes(&args.file, &args.files.files()).unwrap_or_default();
    if let Some(path) = &args.png {
        physics.set_state(&position, &vec![0.0; robot.velocity_size()]);
        let picture = film::png(&portrait(&Look::of(&shown, &meshes), &physics))?;
        atomic_file::write(path, &picture).map_err(|why| Usage(format!("--png {}: {why}", path.display())))?;
    }
    // Numbers of links and hinges are those with all hinges at zero.
    let mut at_zero = robot.nominal_position();
    at_zero[7..].fill(0.0);
    let mut physics = Physics::new(robot.clone(), &config).map_err(|why| in_file(&why))?;
    physics.set_state(&at_zero, &vec![0.0; robot.velocity_size()]);
    if args.json {
        say(&report::json(&physics, &shown, &text, meshes.len(), home.as_ref()).to_string());
        return Ok(());
    }
    let lines = report::lines(&robot, &shown, &text, &args.file, meshes.len(), home.as_ref());
    let Some(proposal) = proposal else {
        if args.draft.is_some() {
            return Err(Usage(format!("--draft: `{}` has a card already; edit it", args.file.display())).into());
        }
        say(lines.trim_end());
        return Ok(());
    };
    if let Some(path) = &args.draft {
        if path.exists() {
            return Err(Usage(format!("--draft {}: it exists; name another file", path.display())).into());
        }
        let card = proposal.draft(&from_folder_of(&args.file, path));
        atomic_file::write(path, card.as_bytes()).map_err(|why| Usage(format!("--draft {}: {why}", path.display())))?;
        say(lines.trim_end());
        return Ok(());
    }
    let file = fs::read_link("/proc/self/fd/1").ok().filter(|card| card.is_file());
    let file = file.map_or_else(|| args.file.display().to_string(), |card| from_folder_of(&args.file, &card));
    let comments: String = lines.lines().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
    say(&format!("{comments}\n{}", proposal.draft(&file).trim_end()));
    Ok(())
}

/// Examines the default pose; `None` for a model that no task simulates yet, such as one without motors.
fn home(mut config: EnvironmentConfig, text: &str, is_card: bool) -> Option<HomePose> {
    // Heights that are healthy belong to a training.
    config.env.terminate_when_unhealthy = false;
    config.env.task = if is_card { EnvTask::Velocity } else { config.env.task };
    HomePose::of(&config, text, &TaskRegistry::default()).ok()
}

/// Returns the path of a model file as a card names it: from the folder of the card, if the file is below that.
fn from_folder_of(file: &Path, card: &Path) -> String {
    let folder = card.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (fs::canonicalize(file), fs::canonicalize(folder)) {
        (Ok(whole), Ok(folder)) => whole.strip_prefix(folder).unwrap_or(&whole).display().to_string(),
        _ => file.display().to_string(),
    }
}
