//! Whether runs can be written where they are to be, and how much room there is.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use super::finding::Finding;

const NAME: &str = "disk";

/// A run of the default length takes some tens of megabytes; below this one may not reach its end.
const ROOM_MIN_BYTES: u64 = 200_000_000;
/// And below this several will not.
const ROOM_BYTES: u64 = 1_000_000_000;

/// Of the folder that runs go to, or of the first above it that is there.
pub fn diagnose(run_dir: &Path) -> Finding {
    let Some(folder) = existing(run_dir) else {
        return Finding::problem(
            NAME,
            format!("no folder above {} can be found", run_dir.display()),
            "name a folder that is there by --run-dir",
        );
    };
    let shown = folder.display();
    if let Err(why) = tempfile::tempfile_in(&folder).and_then(|mut file| file.write_all(&[0; 4096])) {
        return Finding::problem(
            NAME,
            format!("{shown} cannot be written to: {why}"),
            "make room there or give this user the right to write, or choose another folder by --run-dir",
        );
    }
    let space = match rustix::fs::statvfs(&folder) {
        Ok(space) => space,
        Err(why) => return Finding::note(NAME, format!("{shown} does not tell its room: {why}"), "watch it yourself"),
    };
    assess(&shown.to_string(), space.f_bavail.saturating_mul(space.f_frsize))
}

fn assess(folder: &str, free_bytes: u64) -> Finding {
    let seen = format!("{} MB free in {folder}", free_bytes / 1_000_000);
    match free_bytes {
        0..ROOM_MIN_BYTES => Finding::problem(
            NAME,
            seen,
            "training waits while a disk is full: make room, or choose another folder by --run-dir",
        ),
        ROOM_MIN_BYTES..ROOM_BYTES => {
            Finding::note(NAME, seen, "enough for a few runs; delete old ones below runs/ before long")
        }
        _ => Finding::ok(NAME, seen),
    }
}

fn existing(run_dir: &Path) -> Option<PathBuf> {
    let whole = std::path::absolute(run_dir).ok()?;
    whole.ancestors().find(|folder| folder.is_dir()).map(Path::to_path_buf)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn the_room_decides() {
        let severity = |bytes| assess("runs", bytes).severity;
        assert_eq!(
            [0, 199_999_999, 200_000_000, 1_000_000_000].map(severity),
            [Severity::Problem, Severity::Problem, Severity::Note, Severity::Ok]
        );
    }

    #[test]
    fn a_folder_that_is_not_there_yet_is_judged_by_the_one_above() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(existing(&folder.path().join("a/b")).unwrap(), folder.path());
    }
}
