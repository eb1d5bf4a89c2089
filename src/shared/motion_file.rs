//! Flags about motions, and their files.

use std::{
    ffi::OsStr,
    path::{Path, PathBuf},
};

use clap::Args;
use treadmill_humanoid::{
    Model, Physics, PhysicsSettings,
    mjcf::{motions_of, with_motions},
    motion::{MotionClip, MotionFile, read_motion_file},
};

use crate::launch::exit_code::Usage;

/// Most files of a library.
const FILES_MAX: usize = 1000;

/// Motions to imitate.
#[derive(Args, Clone, Debug, Default)]
pub struct MotionArgs {
    /// Motions that the robot imitates in the task `motion`: CSV or npz files, or folders of them (see
    /// docs/guide/motion.md); a resumed run keeps its own.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub motion: Vec<PathBuf>,
    /// Frames per second of motion files that do not say so, as CSV.
    #[arg(long, value_name = "HZ", requires = "motion")]
    pub motion_fps: Option<f64>,
}

impl MotionArgs {
    /// Returns a model text with the motions of these flags in it, or unchanged without flags.
    ///
    /// # Errors
    /// If a file is no motion of this robot.
    pub fn add_to(&self, text: &str) -> Result<String, Usage> {
        if self.motion.is_empty() {
            return Ok(text.to_owned());
        }
        let motions = self.read(text)?;
        let whole = with_motions(text, &motions).map_err(|why| Usage(why.to_string()))?;
        // Checks the length that a model may have.
        Model::from_mjcf(&whole).map_err(|why| {
            let (mib, seconds) = (whole.len() >> 20, motions.iter().map(MotionClip::duration_s).sum::<f64>());
            Usage(format!(
                "--motion: {seconds:.0} s of motions with the model take {mib} MiB: {why}; give fewer of them"
            ))
        })?;
        Ok(whole)
    }

    /// Refuses motions that are not those of a model text.
    ///
    /// # Errors
    /// If they are others.
    pub fn check_same(&self, run_text: &str) -> Result<(), Usage> {
        if self.motion.is_empty() || self.read(run_text)? == motions_of(run_text).unwrap_or_default() {
            return Ok(());
        }
        Err(Usage(
            "--motion: a resumed run keeps its motions, and these differ; leave --motion out, or begin a new run with \
             --init-from"
                .to_owned(),
        ))
    }

    /// Reads the motions for the robot of a model text.
    fn read(&self, text: &str) -> Result<Vec<MotionClip>, Usage> {
        let mut physics = physics_of(text)?;
        let files = self.motion.iter().map(|path| files(path)).collect::<Result<Vec<_>, _>>()?.concat();
        if files.len() > FILES_MAX {
            return Err(Usage(format!("--motion: there are {} files; allowed: {FILES_MAX}", files.len())));
        }
        let mut motions = Vec::new();
        for path in &files {
            let MotionFile { motion, notices, .. } = read_one(path, self.motion_fps, &mut physics)?;
            notices.iter().for_each(|notice| tracing::warn!("{}: {notice}", path.display()));
            motions.push(motion);
        }
        Ok(motions)
    }
}

/// Reads a file as a motion of a simulated robot.
///
/// # Errors
/// If the file is no motion of this robot.
pub fn read_one(path: &Path, fps: Option<f64>, physics: &mut Physics) -> Result<MotionFile, Usage> {
    // A rate that a file has must not be given.
    let is_csv = path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("npz"));
    read_motion_file(path, fps.filter(|_| is_csv), physics).map_err(|why| Usage(why.to_string()))
}

/// Returns a simulation of the robot of a model text, which may have no motors.
///
/// # Errors
/// If the text is no model.
pub fn physics_of(text: &str) -> Result<Physics, Usage> {
    let model = Model::without_motors(text);
    model.and_then(|model| Physics::new(model, PhysicsSettings::default())).map_err(|why| Usage(why.to_string()))
}

/// Returns a file, or the motion files of a folder in the order of their names.
fn files(path: &Path) -> Result<Vec<PathBuf>, Usage> {
    if path.join("checkpoints").is_dir() || path.extension().is_some_and(|ending| ending == "toml") {
        let why = format!(
            "--motion: `{}` is no motion; put it before --motion, which takes all that follows",
            path.display()
        );
        return Err(Usage(why));
    }
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let unreadable = |why: std::io::Error| Usage(format!("--motion {}: {why}", path.display()));
    let entries = path.read_dir().map_err(unreadable)?;
    let mut found =
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>().map_err(unreadable)?;
    let is_one_of = |ending: &OsStr| ["csv", "npz"].iter().any(|known| ending.eq_ignore_ascii_case(known));
    found.retain(|file| file.extension().is_some_and(is_one_of));
    found.sort();
    match found.is_empty() {
        true => Err(Usage(format!("--motion {}: the folder has no .csv and no .npz file", path.display()))),
        false => Ok(found),
    }
}
