//! Fallback from an unsound checkpoint to the newest sound one.

use std::{
    fs,
    path::{Path, PathBuf},
};

use treadmill_runtime::error_chain;

use super::{CheckpointError, TrainingState, load_file};

/// Reads `wanted`. If it is damaged or missing, reads the newest sound checkpoint in its folder, with a warning: of
/// those since the run was resumed last, the one with the most updates. A run that was resumed from an older checkpoint
/// leaves later ones of the way that it did not take.
///
/// # Errors
/// As [`load_file`] if the file is sound but has another format or a refused configuration, or cannot be read;
/// [`CheckpointError::NoneSound`] if no checkpoint is sound.
pub(super) fn load_or_newest_sound(wanted: PathBuf) -> Result<(PathBuf, TrainingState), CheckpointError> {
    let why = match load_file(&wanted) {
        Err(why) if is_unsound(&why) => why,
        result => return result.map(|state| (wanted, state)),
    };
    let folder = wanted.parent().unwrap_or(&wanted);
    let mut tried = vec![describe(&wanted, &why)];
    let mut newest: Option<(PathBuf, TrainingState)> = None;
    for path in bundles(folder).into_iter().filter(|path| *path != wanted) {
        match load_file(&path) {
            Ok(state) if newest.as_ref().is_some_and(|(_, newest)| progress(newest) >= progress(&state)) => {}
            Ok(state) => newest = Some((path, state)),
            Err(why) => tried.push(describe(&path, &why)),
        }
    }
    if let Some((path, state)) = newest {
        let (tried, updates) = (tried.join("; "), state.counters.updates);
        tracing::warn!(%tried, used = %path.display(), updates, "checkpoint is unsound; using the newest sound one");
        return Ok((path, state));
    }
    match why {
        CheckpointError::Missing { .. } if tried.len() == 1 => Err(why),
        _ => Err(CheckpointError::NoneSound { tried: tried.join("; ") }),
    }
}

/// Returns what the newest checkpoint has the most of, the first number first.
fn progress(state: &TrainingState) -> (u64, u64) {
    (state.counters.resumes, state.counters.updates)
}

fn is_unsound(why: &CheckpointError) -> bool {
    matches!(why, CheckpointError::Missing { .. } | CheckpointError::Damaged { .. } | CheckpointError::Shape { .. })
}

fn describe(path: &Path, why: &CheckpointError) -> String {
    let path = path.display();
    match why {
        CheckpointError::Missing { .. } => format!("`{path}` does not exist"),
        CheckpointError::Damaged { why, .. } => format!("`{path}` is damaged ({why})"),
        CheckpointError::Shape { why, .. } => format!("`{path}` does not fit its network ({why})"),
        CheckpointError::Format { found, .. } => format!("`{path}` has format {found}"),
        other => format!("`{path}` cannot be read ({})", error_chain(other)),
    }
}

/// Returns the paths of a folder's checkpoints, sorted.
pub(super) fn bundles(folder: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .filter(|entry| {
            let name = entry.file_name();
            let name = name.to_string_lossy();
            name.ends_with(".bundle") && !name.starts_with('.')
        })
        .map(|entry| entry.path())
        .collect();
    paths.sort();
    paths
}

#[cfg(test)]
mod tests {
    use treadmill_config::Config;
    use treadmill_policy::NetworkShape;
    use treadmill_runtime::run_folder::RunFolder;

    use super::*;
    use crate::checkpoint::{CheckpointChoice, CheckpointWriter, load};

    fn state(updates: u64) -> TrainingState {
        let shape = NetworkShape { observation: 2, action: 1, hidden: vec![256, 128], privileged: 0 };
        let mut state = TrainingState::fresh("run", &Config::default(), "<mujoco/>", shape.into(), 1);
        state.counters.updates = updates;
        state
    }

    /// Folder with `latest` after 7 updates, `best` after 3, and those after 2, 4 and 6.
    fn saved(at: &Path) -> RunFolder {
        let folder = RunFolder::create(Some(&at.join("run")), "x").unwrap();
        let mut writer = CheckpointWriter::new(&folder, 2, 9);
        for updates in 1..=7 {
            let saved = writer.save(&state(updates)).unwrap();
            if updates == 3 {
                writer.save_best(&saved).unwrap();
            }
            if writer.is_due(updates) {
                writer.save_numbered(updates, &saved).unwrap();
            }
        }
        folder
    }

    fn spoil(folder: &RunFolder, name: &str) {
        let path = folder.checkpoints().join(name);
        let mut bytes = fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 4;
        fs::write(path, bytes).unwrap();
    }

    fn updates(folder: &RunFolder, which: CheckpointChoice) -> u64 {
        load(folder, which).unwrap().state.counters.updates
    }

    #[test]
    fn the_sound_checkpoint_with_the_most_updates_replaces_a_damaged_one() {
        let at = tempfile::tempdir().unwrap();
        let folder = saved(at.path());
        assert_eq!(updates(&folder, CheckpointChoice::Latest), 7);
        assert_eq!(updates(&folder, CheckpointChoice::BestOrLatest), 3);
        spoil(&folder, "latest.bundle");
        assert_eq!(updates(&folder, CheckpointChoice::Latest), 6);
        spoil(&folder, "00000006.bundle");
        assert_eq!(updates(&folder, CheckpointChoice::Latest), 4);
        fs::remove_file(folder.checkpoints().join("latest.bundle")).unwrap();
        assert_eq!(updates(&folder, CheckpointChoice::Latest), 4);
        spoil(&folder, "best.bundle");
        assert_eq!(updates(&folder, CheckpointChoice::BestOrLatest), 4, "`best` was not requested by name");
    }

    #[test]
    fn checkpoints_that_a_resumed_run_left_do_not_replace_its_own() {
        let at = tempfile::tempdir().unwrap();
        let folder = saved(at.path());
        let mut resumed = state(5);
        resumed.counters.resumes = 1;
        let saved = CheckpointWriter::new(&folder, 5, 9).save(&resumed).unwrap();
        CheckpointWriter::new(&folder, 5, 9).save_numbered(5, &saved).unwrap();
        spoil(&folder, "latest.bundle");
        assert_eq!(
            updates(&folder, CheckpointChoice::Latest),
            5,
            "after 6 updates the run went on from an older checkpoint"
        );
    }

    #[test]
    fn a_requested_checkpoint_is_not_replaced_by_another() {
        let at = tempfile::tempdir().unwrap();
        let folder = saved(at.path());
        for (name, which) in
            [("best.bundle", CheckpointChoice::Best), ("00000004.bundle", CheckpointChoice::Numbered(4))]
        {
            spoil(&folder, name);
            let why = error_chain(&load(&folder, which).unwrap_err());
            assert!(why.contains(name) && why.contains("checksum") && why.contains("--checkpoint"), "{why}");
        }
    }

    #[test]
    fn if_no_checkpoint_is_sound_the_error_names_all() {
        let at = tempfile::tempdir().unwrap();
        let folder = saved(at.path());
        for path in bundles(&folder.checkpoints()) {
            spoil(&folder, &path.file_name().unwrap().to_string_lossy());
        }
        let why = load(&folder, CheckpointChoice::Latest).unwrap_err().to_string();
        for name in ["latest", "best", "00000002", "00000004", "00000006"] {
            assert!(why.contains(&format!("{name}.bundle` is damaged")), "{why}");
        }
        let empty = RunFolder::create(Some(&at.path().join("empty")), "x").unwrap();
        assert!(load(&empty, CheckpointChoice::Latest).unwrap_err().to_string().contains("has saved none yet"));
    }

    #[test]
    fn another_format_is_refused_without_fallback() {
        let at = tempfile::tempdir().unwrap();
        let folder = saved(at.path());
        let path = folder.checkpoints().join("latest.bundle");
        let mut bytes = fs::read(&path).unwrap();
        bytes[8] = 1;
        fs::write(path, bytes).unwrap();
        assert!(load(&folder, CheckpointChoice::Latest).unwrap_err().to_string().contains("format 1"));
    }
}
