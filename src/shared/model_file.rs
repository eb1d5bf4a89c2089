//! Flags about the file of a robot, and where a run has its file on this machine.

use std::{
    fs, io,
    path::{Path, PathBuf, absolute},
};

use clap::Args;
use serde::{Deserialize, Serialize};
use treadmill_humanoid::{
    ModelFiles,
    mjcf::{VisualMesh, visual_meshes},
};
use treadmill_runtime::{atomic_file, error_chain, run_folder::RunFolder};

/// How the files of a model are read.
#[derive(Args, Clone, Debug, Default)]
pub struct ModelFileArgs {
    /// Folder of a ROS package that a URDF names; may be repeated.
    #[arg(long, value_name = "NAME=FOLDER", value_parser = package)]
    pub package: Vec<(String, PathBuf)>,
    /// Hold the prismatic joints of a URDF still; they are not simulated.
    #[arg(long)]
    pub hold_slides: bool,
}

impl ModelFileArgs {
    /// Returns how the files are read.
    #[must_use]
    pub fn files(&self) -> ModelFiles {
        ModelFiles { packages: self.package.clone(), holds_slides: self.hold_slides }
    }

    /// Returns the first flag that was given.
    #[must_use]
    pub fn given(&self) -> Option<&'static str> {
        match self {
            Self { package, .. } if !package.is_empty() => Some("--package"),
            Self { hold_slides: true, .. } => Some("--hold-slides"),
            _ => None,
        }
    }
}

/// Where the file of a run's robot is on the machine that began it. A run does without it; viewers take its meshes.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ModelSource {
    file: PathBuf,
    #[serde(default)]
    package: Vec<(String, PathBuf)>,
    #[serde(default)]
    hold_slides: bool,
}

impl ModelSource {
    /// Returns what flags say.
    ///
    /// # Errors
    /// If the working folder is unknown.
    pub fn given(file: &Path, flags: &ModelFileArgs) -> io::Result<Self> {
        let package = |(name, folder): &(String, PathBuf)| Ok((name.clone(), absolute(folder)?));
        Ok(Self {
            file: absolute(file)?,
            package: flags.package.iter().map(package).collect::<io::Result<_>>()?,
            hold_slides: flags.hold_slides,
        })
    }

    /// Returns what the folder of a run says; `None` for the built-in humanoid, a file, and a run of another machine.
    #[must_use]
    pub fn of_run(run: &str) -> Option<Self> {
        let text = fs::read_to_string(RunFolder::open(run).ok()?.model_source()).ok()?;
        toml::from_str(&text).ok().filter(|source: &Self| source.file.exists())
    }

    /// Writes it to the folder of a run.
    ///
    /// # Errors
    /// If that cannot be written.
    pub fn write(&self, folder: &RunFolder) -> io::Result<()> {
        let text = toml::to_string(self).expect("paths and names become text");
        atomic_file::write(&folder.model_source(), text.as_bytes())
    }

    fn meshes(&self) -> Vec<VisualMesh> {
        let files = ModelFiles { packages: self.package.clone(), holds_slides: self.hold_slides };
        let found = visual_meshes(&self.file, &files);
        found.inspect_err(|why| tracing::warn!(error = %error_chain(why), "meshes not shown")).unwrap_or_default()
    }
}

/// Returns the visual meshes of a robot's file; none without a readable one.
#[must_use]
pub fn meshes(source: Option<ModelSource>) -> Vec<VisualMesh> {
    source.map(|source| source.meshes()).unwrap_or_default()
}

fn package(text: &str) -> Result<(String, PathBuf), String> {
    let (name, folder) = text
        .split_once('=')
        .filter(|(name, folder)| !name.is_empty() && !folder.is_empty())
        .ok_or("it must be the package's name and folder, as in talos_data=robots/talos_data")?;
    let folder = PathBuf::from(folder);
    if folder.is_dir() { Ok((name.to_owned(), folder)) } else { Err(format!("`{}` is no folder", folder.display())) }
}
