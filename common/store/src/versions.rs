//! Versions of an object in a folder: numbered files, of which the greatest counts.
//!
//! Who creates the next number has replaced the object. No writer waits for a lock, which a frozen process would keep.

use std::{fs, io, path::Path};

use treadmill_runtime::atomic_file;

/// Versions that stay: readers and writers that are slow, or whose network file system shows them an old list, still
/// find them.
const KEPT: u64 = 100;

/// Returns the greatest number, or `None` without versions.
fn newest(folder: &Path) -> io::Result<Option<u64>> {
    Ok(numbers(folder)?.into_iter().max())
}

/// Reads the newest version. Returns its number too.
pub(crate) fn read(folder: &Path) -> io::Result<(Vec<u8>, u64)> {
    let number = newest(folder)?.ok_or(io::ErrorKind::NotFound)?;
    let bytes =
        fs::read(folder.join(number.to_string())).map_err(|why| io::Error::other(format!("{number}: {why}")))?;
    Ok((bytes, number))
}

/// Adds the version after `last`. Returns its number, or `None` if another writer was first.
pub(crate) fn add(folder: &Path, bytes: &[u8], last: Option<u64>) -> io::Result<Option<u64>> {
    fs::create_dir_all(folder)?;
    if newest(folder)? != last {
        return Ok(None);
    }
    let number = last.map_or(1, |last| last + 1);
    Ok(create(folder, bytes, number)?.then_some(number))
}

/// Creates the version with this number, unless another writer was first.
fn create(folder: &Path, bytes: &[u8], number: u64) -> io::Result<bool> {
    match atomic_file::create(&folder.join(number.to_string()), bytes) {
        Err(why) if why.kind() == io::ErrorKind::AlreadyExists => return Ok(false),
        created => created?,
    }
    let numbers = numbers(folder)?;
    for old in numbers.iter().filter(|old| **old + KEPT <= number) {
        // A file that stays does no harm, and the next writer tries again.
        let _ = fs::remove_file(folder.join(old.to_string()));
    }
    // While this process was frozen, others may have gone so far ahead that they removed the number.
    Ok(numbers.into_iter().all(|other| other < number + KEPT))
}

fn numbers(folder: &Path) -> io::Result<Vec<u64>> {
    let mut numbers = Vec::new();
    for entry in fs::read_dir(folder)? {
        numbers.extend(entry?.file_name().to_str().and_then(|name| name.parse::<u64>().ok()));
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_replacement_of_many_writers_is_lost() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("object");
        add(&path, b"0", None).unwrap();
        let count_up = || {
            let mut counted = 0;
            while counted < 50 {
                let (bytes, last) = read(&path).unwrap();
                let next = String::from_utf8(bytes).unwrap().parse::<u64>().unwrap() + 1;
                counted += u64::from(add(&path, next.to_string().as_bytes(), Some(last)).unwrap().is_some());
            }
        };
        std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(count_up))));
        assert_eq!(read(&path).unwrap(), (b"200".to_vec(), 201));
    }

    #[test]
    fn a_writer_that_was_frozen_has_lost_even_if_its_number_is_free() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("object");
        let mut last = None;
        for number in 1..=250u64 {
            last = add(&path, &number.to_le_bytes(), last).unwrap();
            assert_eq!(last, Some(number));
        }
        assert_eq!(numbers(&path).unwrap().len() as u64, KEPT);
        // Another looked for the newest version when that was 100, and was frozen until now.
        assert!(!path.join("101").exists());
        assert!(!create(&path, b"late", 101).unwrap());
        assert_eq!(read(&path).unwrap(), (250u64.to_le_bytes().to_vec(), 250));
        assert_eq!(add(&path, b"late", Some(101)).unwrap(), None);
        assert_eq!(add(&path, b"next", Some(250)).unwrap(), Some(251));
        assert!(!path.join("101").exists(), "removed like other old ones");
    }
}
