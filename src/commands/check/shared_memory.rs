//! Whether shared memory has room for what `--shared-memory` lets pass through it.

use std::path::Path;

use super::finding::{Finding, actors as counted};

const NAME: &str = "shared memory";

const FOLDER: &str = "/dev/shm";
/// What each process fills at most (`common/src/bus/session.rs`).
const POOL_BYTES: u64 = 8 << 20;

/// Of this machine; `is_wanted` where `--shared-memory` was given.
pub fn diagnose(actors: u64, is_wanted: bool) -> Finding {
    let free = rustix::fs::statvfs(Path::new(FOLDER)).map(|room| room.f_bavail.saturating_mul(room.f_frsize));
    assess(free.ok(), actors, is_wanted)
}

fn assess(free_bytes: Option<u64>, actors: u64, is_wanted: bool) -> Finding {
    let needed = POOL_BYTES.saturating_mul(actors + 1);
    let seen = match free_bytes {
        None => format!("there is no {FOLDER}"),
        Some(free) => {
            let seen = format!("{} MB free in {FOLDER}", free / 1_000_000);
            if free >= needed {
                return Finding::ok(NAME, seen);
            }
            seen
        }
    };
    let seen = format!("{seen}; a learner and {} fill up to {} MB", counted(actors), needed / 1_000_000);
    match is_wanted {
        true => Finding::problem(
            NAME,
            seen,
            "give the container more (docker run --shm-size), or leave out --shared-memory",
        ),
        false => Finding::note(NAME, seen, "nothing, unless you use --shared-memory; then docker run --shm-size 1g"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn too_little_of_it_matters_to_those_who_want_it() {
        let severity = |free, is_wanted| assess(free, 9, is_wanted).severity;
        assert_eq!(severity(Some(64 << 20), true), Severity::Problem);
        assert_eq!(severity(Some(64 << 20), false), Severity::Note);
        assert_eq!(severity(Some(80 << 20), true), Severity::Ok);
        assert_eq!(severity(None, true), Severity::Problem);
    }
}
