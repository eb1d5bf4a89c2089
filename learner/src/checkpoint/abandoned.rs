//! Checkpoints of a way that a run has left: it was resumed from an earlier one.

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use treadmill_runtime::run_folder::RunFolder;

use super::{CheckpointError, fallback, load_file, name_of};

/// Moves the checkpoints after `updates` into a folder beside them whose name says so, where neither `--checkpoint` nor a
/// fallback finds them. Returns the folder, unless there was none to move.
///
/// # Errors
/// If a file cannot be moved.
pub fn set_aside(folder: &RunFolder, updates: u64) -> Result<Option<PathBuf>, CheckpointError> {
    let checkpoints = folder.checkpoints();
    let is_later = |path: &PathBuf| match name_of(path).parse::<u64>() {
        Ok(number) => number > updates,
        // A damaged one is replaced soon.
        Err(_) => load_file(path).is_ok_and(|state| state.counters.updates > updates),
    };
    let later: Vec<PathBuf> =
        fallback::bundles(&checkpoints).into_iter().filter(|path| path.is_file() && is_later(path)).collect();
    if later.is_empty() {
        return Ok(None);
    }
    let names = (1..).map(|count| match count {
        1 => format!("abandoned-after-{updates}"),
        _ => format!("abandoned-after-{updates}-{count}"),
    });
    let aside = names.map(|name| checkpoints.join(name)).find(|path| !path.exists()).unwrap_or_default();
    move_to(&later, &aside)
        .map_err(|source| CheckpointError::Write { path: aside.display().to_string(), source })
        .map(|()| Some(aside))
}

fn move_to(files: &[PathBuf], folder: &Path) -> io::Result<()> {
    fs::create_dir(folder)?;
    // The newest first: what a crash leaves is a run that ends earlier.
    for file in files.iter().rev() {
        fs::rename(file, folder.join(file.file_name().unwrap_or_default()))?;
    }
    Ok(())
}
