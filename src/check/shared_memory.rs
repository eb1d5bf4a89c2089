//! Whether shared memory has room for what `--shared-memory` lets pass through it.

use std::path::Path;

use super::finding::{Finding, actors as counted};

const NAME: &str = "shared memory";

const FOLDER: &str = "/dev/shm";
/// What each process fills at most (`common/src/bus/session.rs`).
const POOL_BYTES: u64 = 8 << 20;

/// Of this machine; `is_wanted` where `--shared-memory` was given.
pub fn look(actors: u64, is_wanted: bool) -> Finding {
    let free = rustix::fs::statvfs(Path::new(FOLDER)).map(|room| room.f_bavail.saturating_mul(room.f_frsize));
    judge(free.ok(), actors, is_wanted)
}

fn judge(free_bytes: Option<u64>, actors: u64, is_wanted: bool) -> Finding {
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
    use crate::check::finding::Verdict;

    #[test]
    fn too_little_of_it_matters_to_those_who_want_it() {
        let verdict = |free, is_wanted| judge(free, 9, is_wanted).verdict;
        assert_eq!(verdict(Some(64 << 20), true), Verdict::Problem);
        assert_eq!(verdict(Some(64 << 20), false), Verdict::Note);
        assert_eq!(verdict(Some(80 << 20), true), Verdict::Ok);
        assert_eq!(verdict(None, true), Verdict::Problem);
    }
}
