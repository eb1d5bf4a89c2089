//! Flags about the file of a robot.

use std::path::PathBuf;

use clap::Args;
use treadmill_humanoid::ModelFiles;

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

fn package(text: &str) -> Result<(String, PathBuf), String> {
    let (name, folder) = text
        .split_once('=')
        .filter(|(name, folder)| !name.is_empty() && !folder.is_empty())
        .ok_or("it must be the package's name and folder, as in talos_data=robots/talos_data")?;
    let folder = PathBuf::from(folder);
    if folder.is_dir() { Ok((name.to_owned(), folder)) } else { Err(format!("`{}` is no folder", folder.display())) }
}
