//! Objects as files of a folder.

use std::{
    fs::{self, File, OpenOptions},
    io,
    path::PathBuf,
};

use sha2::{Digest, Sha256};
use treadmill_runtime::atomic_file;

use crate::{StoreError, Tag};

/// File that a conditional write locks. On a network file system it needs one that passes locks on, as NFS 4 does.
const LOCK: &str = ".lock";

/// Folder of objects. A tag is the checksum of an object's bytes.
#[derive(Debug)]
pub(crate) struct Folder {
    root: PathBuf,
}

impl Folder {
    pub(crate) fn new(root: PathBuf) -> Self {
        Self { root }
    }

    pub(crate) fn put(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        self.write(name, bytes).map_err(|why| StoreError::failed(name, why.to_string()))
    }

    pub(crate) fn get(&self, name: &str) -> Result<(Vec<u8>, Tag), StoreError> {
        let bytes = fs::read(self.root.join(name)).map_err(|why| StoreError::of_file(name, &why))?;
        let tag = tag(&bytes);
        Ok((bytes, tag))
    }

    pub(crate) fn replace(&self, name: &str, bytes: &[u8], last: Option<&Tag>) -> Result<Tag, StoreError> {
        let failed = |why: io::Error| StoreError::failed(name, why.to_string());
        // The system gives the lock back when the process ends, however it ends.
        let _lock = self.lock().map_err(failed)?;
        let present = match self.get(name) {
            Ok((_, tag)) => Some(tag),
            Err(StoreError::Missing { .. }) => None,
            Err(why) => return Err(why),
        };
        if present.as_ref() != last {
            return Err(StoreError::conflict(name));
        }
        self.write(name, bytes).map_err(failed)?;
        Ok(tag(bytes))
    }

    pub(crate) fn delete(&self, name: &str) -> Result<(), StoreError> {
        match fs::remove_file(self.root.join(name)) {
            Err(why) if why.kind() != io::ErrorKind::NotFound => Err(StoreError::failed(name, why.to_string())),
            _ => Ok(()),
        }
    }

    pub(crate) fn list(&self, folder: &str) -> Result<Vec<String>, StoreError> {
        let entries = match fs::read_dir(self.root.join(folder)) {
            Ok(entries) => entries,
            Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(why) => return Err(StoreError::failed(folder, why.to_string())),
        };
        let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
        Ok(names.filter(|name| !atomic_file::is_temporary(name) && name != LOCK).collect())
    }

    fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let path = self.root.join(name);
        fs::create_dir_all(path.parent().unwrap_or(&self.root))?;
        atomic_file::write(&path, bytes)
    }

    fn lock(&self) -> io::Result<File> {
        fs::create_dir_all(&self.root)?;
        let file = OpenOptions::new().create(true).truncate(false).write(true).open(self.root.join(LOCK))?;
        file.lock()?;
        Ok(file)
    }
}

fn tag(bytes: &[u8]) -> Tag {
    Tag(Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect())
}
