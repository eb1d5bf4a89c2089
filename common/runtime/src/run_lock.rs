//! Lock of a run's folder: one process at a time writes into it.

use std::{
    fs::{File, OpenOptions, TryLockError},
    io::{self, Seek, Write},
    thread,
    time::Duration,
};

use serde_json::{Value, json};

use crate::{
    epoch,
    holder::Holder,
    machine,
    run_folder::{RunFolder, RunFolderError},
};

/// Attempts to take the lock, because [`holder`] takes it for a moment to see whether it is free.
const ATTEMPTS: u32 = 4;
const RETRY: Duration = Duration::from_millis(25);

/// Right to write into a run's folder. The system takes it back when the process ends, however it ends.
#[derive(Debug)]
pub struct RunLock {
    file: File,
    epoch: u64,
}

impl RunLock {
    /// Takes the lock of `folder` and writes this process into its file.
    ///
    /// # Errors
    /// [`RunFolderError::InUse`] if another process has it, [`RunFolderError::Io`] if the system refuses.
    pub fn take(folder: &RunFolder) -> Result<Self, RunFolderError> {
        let io = |source| RunFolderError::Io { path: folder.root().display().to_string(), source };
        let open = OpenOptions::new().create(true).truncate(false).write(true).open(folder.lock());
        let file = open.map_err(io)?;
        for attempt in 1.. {
            match file.try_lock() {
                Ok(()) => break,
                Err(TryLockError::WouldBlock) if attempt < ATTEMPTS => thread::sleep(RETRY),
                Err(TryLockError::WouldBlock) => {
                    let (path, holder) = (folder.root().display().to_string(), Holder::read(&folder.lock()));
                    return Err(RunFolderError::InUse { path, holder });
                }
                Err(TryLockError::Error(source)) => return Err(io(source)),
            }
        }
        let mut lock = Self { file, epoch: epoch::next(Holder::read(&folder.lock()).epoch) };
        lock.set_endpoint("").map_err(io)?;
        Ok(lock)
    }

    /// Returns the epoch of this process: higher than that of any before which had the lock.
    #[must_use]
    pub fn epoch(&self) -> u64 {
        self.epoch
    }

    /// Writes the endpoint on which this process listens into the lock's file.
    ///
    /// # Errors
    /// The system's error.
    pub fn set_endpoint(&mut self, endpoint: &str) -> io::Result<()> {
        let (pid, host) = (std::process::id(), machine::host_name());
        self.write(&json!({"pid": pid, "host": host, "endpoint": endpoint, "epoch": self.epoch, "ended": false}))
    }

    fn write(&mut self, holder: &Value) -> io::Result<()> {
        let line = format!("{holder}\n");
        // The same file, because the lock belongs to it; never empty, because the epoch must outlast a full disk.
        self.file.rewind()?;
        self.file.write_all(line.as_bytes())?;
        self.file.set_len(line.len() as u64)
    }
}

impl Drop for RunLock {
    fn drop(&mut self) {
        // A process that is killed does not come here, which `was_killed` sees.
        let _ = self.write(&json!({"epoch": self.epoch, "ended": true}));
    }
}

/// Returns the last process that wrote into `folder` if it ended without saying so, as one that was killed.
#[must_use]
pub fn killed(folder: &RunFolder) -> Option<Holder> {
    let last = holder(folder).is_none().then(|| Holder::read(&folder.lock()));
    last.filter(|last| last.is_left_behind)
}

/// Returns the process that writes into `folder` now, if there is one.
#[must_use]
pub fn holder(folder: &RunFolder) -> Option<Holder> {
    let file = File::open(folder.lock()).ok()?;
    matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)).then(|| Holder::read(&folder.lock()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_writer_is_told_the_first_until_that_has_gone() {
        let folder = tempfile::tempdir().unwrap();
        let run = RunFolder::create(Some(&folder.path().join("run")), "walk").unwrap();
        assert_eq!(holder(&run), None);
        let mut lock = RunLock::take(&run).unwrap();
        let epoch = lock.epoch();
        assert!(RunLock::take(&run).unwrap_err().to_string().contains(&format!("process {}", std::process::id())));
        lock.set_endpoint("tcp/127.0.0.1:7").unwrap();
        let refused = RunLock::take(&run).unwrap_err().to_string();
        assert!(refused.contains("which listens on tcp/127.0.0.1:7"), "{refused}");
        assert_eq!(holder(&run).unwrap().pid, Some(std::process::id()));
        assert_eq!(killed(&run), None, "it lives");
        let written = std::fs::read(run.lock()).unwrap();
        drop(lock);
        assert_eq!((holder(&run), killed(&run)), (None, None));
        std::fs::write(run.lock(), written).unwrap();
        assert_eq!(killed(&run).unwrap().pid, Some(std::process::id()), "nothing was written at its end");
        assert!(RunLock::take(&run).unwrap().epoch() > epoch, "each holder has a higher one");
    }

    #[test]
    fn a_lock_without_a_name_is_still_a_lock() {
        let folder = tempfile::tempdir().unwrap();
        let run = RunFolder::create(Some(&folder.path().join("run")), "walk").unwrap();
        let lock = RunLock::take(&run).unwrap();
        lock.file.set_len(0).unwrap();
        assert!(RunLock::take(&run).unwrap_err().to_string().contains("another process"));
    }
}
