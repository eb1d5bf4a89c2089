//! Writes a file atomically: to a temporary file that is synced, then renamed or linked.

use std::{
    fs::{self, File, Metadata},
    io::{self, Write},
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering},
    time::Duration,
};

/// End of a temporary file's name.
const SUFFIX: &str = ".tmp";

/// Writes `bytes` to `path`, or to the file that it is a link to. A crash at any moment leaves either the old file or
/// the new one. A device or a pipe is written directly.
///
/// # Errors
/// The system's error, such as a full disk. The old file is untouched and the temporary one removed.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    match destination(path) {
        Destination::Stream(mut stream) => stream.write_all(bytes),
        Destination::File(path) => write_by(&path, bytes, |temporary| fs::rename(temporary, &path)),
    }
}

/// The same without waiting until the name is durable, which takes most of the time: a crash of the machine, but not of this
/// process, may bring the old file back.
///
/// # Errors
/// As for [`write`].
pub fn write_quickly(path: &Path, bytes: &[u8]) -> io::Result<()> {
    match destination(path) {
        Destination::Stream(mut stream) => stream.write_all(bytes),
        Destination::File(path) => {
            let publish = |temporary: &Path, mut file: File| {
                file.write_all(bytes)?;
                file.sync_data()?;
                fs::rename(temporary, &path)
            };
            with_temporary(&path, publish).map(drop)
        }
    }
}

/// Tests that `path` can be written. Work that takes long asks first.
///
/// # Errors
/// The system's error, such as a missing folder or permission.
pub fn check(path: &Path) -> io::Result<()> {
    match destination(path) {
        Destination::Stream(_) => Ok(()),
        Destination::File(path) if path.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Destination::File(path) => with_temporary(&path, |temporary, _| fs::remove_file(temporary)).map(drop),
    }
}

/// Where a path leads.
#[derive(Debug)]
pub enum Destination {
    /// To a file, or to none yet: its path without links.
    File(PathBuf),
    /// To a device or a pipe, which a new file must not replace.
    Stream(File),
}

/// Returns where a path leads.
#[must_use]
pub fn destination(path: &Path) -> Destination {
    let is_stream = fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    match is_stream.then(|| File::options().write(true).open(path)) {
        Some(Ok(stream)) => Destination::Stream(stream),
        _ => Destination::File(fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf())),
    }
}

/// Creates `path` with `bytes`. A crash at any moment leaves no file or the whole one.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] if there is a file, or the system's error, as of a file system without hard links.
pub fn create(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_by(path, bytes, |temporary| {
        fs::hard_link(temporary, path)?;
        fs::remove_file(temporary)
    })
}

/// Writes a temporary file, which `publish` gives its name.
fn write_by(path: &Path, bytes: &[u8], publish: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let folder = with_temporary(path, |temporary, mut file| {
        file.write_all(bytes)?;
        file.sync_all()?;
        publish(temporary)
    })?;
    // The name itself is durable only once the folder is.
    File::open(folder)?.sync_all()
}

/// Calls `publish` with a new temporary file beside `path`, and removes it if that fails. Returns the folder.
fn with_temporary(path: &Path, publish: impl FnOnce(&Path, File) -> io::Result<()>) -> io::Result<&Path> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = path.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"))?;
    let (temporary, file) = create_temporary(folder, &name.to_string_lossy())?;
    publish(&temporary, file).inspect_err(|_| {
        // The first error is the one to report.
        let _ = fs::remove_file(&temporary);
    })?;
    Ok(folder)
}

/// Creates a temporary file that nothing else writes.
fn create_temporary(folder: &Path, name: &str) -> io::Result<(PathBuf, File)> {
    // Two threads may write the same file at the same time.
    static WRITES: AtomicU64 = AtomicU64::new(0);
    loop {
        let (write, process) = (WRITES.fetch_add(1, Ordering::Relaxed), std::process::id());
        let path = folder.join(format!(".{name}.{write}.{process}{SUFFIX}"));
        match File::create_new(&path) {
            // Of a process with the same number, on another machine or in another container, or that was killed.
            Err(why) if why.kind() == io::ErrorKind::AlreadyExists => {}
            created => return created.map(|file| (path, file)),
        }
    }
}

/// Returns whether a file has the name of a temporary file of [`write`].
pub fn is_temporary(name: &str) -> bool {
    writer(name).is_some()
}

/// Removes the temporary files that killed processes of this machine left in `folder`. Returns how many there were.
///
/// # Errors
/// The system's error. It is no error if another process removes a file meanwhile.
pub fn remove_stale(folder: &Path) -> io::Result<usize> {
    remove_temporary(folder, |writer, _| {
        // Another command may write into this folder now. In a container, each process may have the number of the last one.
        let is_running = writer != std::process::id() && Path::new("/proc").join(writer.to_string()).exists();
        Ok(!is_running)
    })
}

/// Removes the temporary files in `folder` that have not been written for `age`, for folders that several machines
/// share. Returns how many there were.
///
/// # Errors
/// As for [`remove_stale`].
pub fn remove_older(folder: &Path, age: Duration) -> io::Result<usize> {
    // A clock that went back makes a file look new, which only keeps it.
    remove_temporary(folder, |_, file| Ok(file.modified()?.elapsed().is_ok_and(|since| since >= age)))
}

/// Removes the temporary files that `is_left` recognises by their writer and metadata.
fn remove_temporary(folder: &Path, is_left: impl Fn(u32, &Metadata) -> io::Result<bool>) -> io::Result<usize> {
    let mut removed = 0;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let Some(writer) = writer(&entry.file_name().to_string_lossy()) else { continue };
        let remove = || -> io::Result<bool> {
            let file = entry.metadata()?;
            let is_left = file.is_file() && is_left(writer, &file)?;
            if is_left {
                fs::remove_file(entry.path())?;
            }
            Ok(is_left)
        };
        match remove() {
            Ok(is_removed) => removed += usize::from(is_removed),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
    }
    Ok(removed)
}

/// Returns the number of the process that wrote a temporary file of this name, `.NAME.WRITE.PROCESS.tmp`.
fn writer(name: &str) -> Option<u32> {
    let (file, process) = name.strip_prefix('.')?.strip_suffix(SUFFIX)?.rsplit_once('.')?;
    let is_number = process.bytes().all(|byte| byte.is_ascii_digit());
    (!file.is_empty() && is_number).then(|| process.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use std::time::SystemTime;

    use super::*;

    #[test]
    fn a_write_replaces_the_file_and_leaves_no_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("state");
        for (write, [first, second]) in
            [(write as fn(&Path, &[u8]) -> _, ["one", "two"]), (write_quickly, ["three", "four"])]
        {
            write(&path, first.as_bytes()).unwrap();
            write(&path, second.as_bytes()).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), second);
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        }
    }

    #[test]
    fn a_write_follows_links_and_replaces_no_device() {
        let folder = tempfile::tempdir().unwrap();
        let [link, file] = ["link", "file"].map(|name| folder.path().join(name));
        fs::write(&file, b"one").unwrap();
        std::os::unix::fs::symlink("file", &link).unwrap();
        write(&link, b"two").unwrap();
        assert!(link.is_symlink() && fs::read(&file).unwrap() == b"two");
        // Not the device itself: a fault would replace it for the whole system.
        let device = folder.path().join("device");
        std::os::unix::fs::symlink("/dev/null", &device).unwrap();
        write(&device, b"three").unwrap();
        assert!(device.is_symlink() && !fs::metadata(&device).unwrap().is_file());
    }

    #[test]
    fn a_check_finds_what_cannot_be_written_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture");
        check(&path).unwrap();
        check(Path::new("/dev/null")).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        assert_eq!(check(folder.path()).unwrap_err().kind(), io::ErrorKind::IsADirectory);
        assert_eq!(check(&path.join("absent/picture")).unwrap_err().kind(), io::ErrorKind::NotFound);
        // Not even root can create files in /proc.
        assert!(check(Path::new("/proc/self/picture")).is_err());
        fs::write(&path, b"old").unwrap();
        check(&path).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
    }

    #[test]
    fn only_one_of_many_creates_a_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("state");
        let created: usize = std::thread::scope(|scope| {
            let create = || match create(&path, &[7; 10_000]) {
                Ok(()) => 1,
                Err(why) => usize::from(why.kind() != io::ErrorKind::AlreadyExists) * 100,
            };
            let threads: Vec<_> = (0..8).map(|_| scope.spawn(create)).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).sum()
        });
        assert_eq!((created, fs::read(&path).unwrap()), (1, vec![7; 10_000]));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn threads_may_write_the_same_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("state");
        std::thread::scope(|scope| {
            let write = || (0..50).try_for_each(|_| write(&path, &[7; 10_000]));
            let threads: Vec<_> = (0..4).map(|_| scope.spawn(write)).collect();
            threads.into_iter().for_each(|thread| thread.join().unwrap().unwrap());
        });
        assert_eq!(fs::read(&path).unwrap(), [7; 10_000]);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn the_unfinished_file_of_a_process_with_the_same_number_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        // More than other tests write meanwhile.
        let name = |write: u64| folder.path().join(format!(".state.{write}.{}.tmp", std::process::id()));
        (0..2000).for_each(|write| fs::write(name(write), b"other").unwrap());
        write(&folder.path().join("state"), b"own").unwrap();
        create(&folder.path().join("state"), b"late").unwrap_err();
        assert_eq!(fs::read(folder.path().join("state")).unwrap(), b"own");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2001);
        (0..2000).for_each(|write| assert_eq!(fs::read(name(write)).unwrap(), b"other"));
    }

    #[test]
    fn a_failed_write_leaves_the_folder_unchanged() {
        let folder = tempfile::tempdir().unwrap();
        // A folder with the file's name makes the rename fail after the write succeeded.
        let path = folder.path().join("state");
        fs::create_dir(&path).unwrap();
        assert!(write(&path, b"one").is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn only_temporary_files_of_ended_processes_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        // Linux numbers processes up to 2^22.
        let ended = 1 << 30;
        let own = std::process::id();
        let stale = [format!(".latest.bundle.{ended}.tmp"), format!(".a.{own}.tmp"), format!(".x.y.{ended}.tmp")];
        let others = [
            // The first process always runs.
            ".latest.bundle.1.tmp".to_string(),
            format!("latest.bundle.{ended}.tmp"),
            format!(".{ended}.tmp"),
            format!("..{ended}.tmp"),
            ".latest.bundle.12a.tmp".to_string(),
            ".latest.bundle.+5.tmp".to_string(),
            ".latest.bundle..tmp".to_string(),
            ".latest.bundle.99999999999.tmp".to_string(),
            "latest.bundle".to_string(),
        ];
        for name in stale.iter().chain(&others) {
            fs::write(folder.path().join(name), "x").unwrap();
        }
        fs::create_dir(folder.path().join(format!(".folder.{ended}.tmp"))).unwrap();
        assert_eq!(remove_stale(folder.path()).unwrap(), stale.len());
        for name in stale {
            assert!(is_temporary(&name) && !folder.path().join(&name).exists(), "{name}");
        }
        for name in others {
            assert!(folder.path().join(&name).exists(), "{name}");
        }
        assert_eq!(remove_stale(folder.path()).unwrap(), 0);
        assert!(remove_stale(&folder.path().join("missing")).is_err());
    }

    #[test]
    fn only_old_temporary_files_are_removed_whoever_wrote_them() {
        let folder = tempfile::tempdir().unwrap();
        let hour = Duration::from_secs(3600);
        for (name, age) in [(".state.0.1.tmp", 2 * hour), (".state.1.1.tmp", hour / 2), ("state", 2 * hour)] {
            let file = File::create(folder.path().join(name)).unwrap();
            file.set_modified(SystemTime::now() - age).unwrap();
        }
        assert_eq!(remove_older(folder.path(), hour).unwrap(), 1);
        assert!(!folder.path().join(".state.0.1.tmp").exists());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
