//! Objects as files of a folder.

use std::{fs, io, path::PathBuf, time::Duration};

use treadmill_runtime::atomic_file;

use crate::{StoreError, Tag, versions};

/// Age from which a temporary file is a killed writer's: no write takes so long.
const UNFINISHED_AFTER: Duration = Duration::from_secs(3600);

/// Folder of objects. An object is a file, or a folder of versions if it is replaced on a condition; its tag is then
/// the newest version's number, and empty otherwise.
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
        let path = self.root.join(name);
        let read = match path.is_dir() {
            true => versions::read(&path).map(|(bytes, number)| (bytes, tag(number))),
            false => fs::read(&path).map(|bytes| (bytes, Tag(String::new()))),
        };
        read.map_err(|why| StoreError::of_file(name, &why))
    }

    pub(crate) fn replace(&self, name: &str, bytes: &[u8], last: Option<&Tag>) -> Result<Tag, StoreError> {
        let last = match last {
            Some(tag) => Some(tag.0.parse().map_err(|_| StoreError::conflict(name))?),
            None => None,
        };
        let added = versions::add(&self.root.join(name), bytes, last);
        match added.map_err(|why| StoreError::failed(name, why.to_string()))? {
            Some(number) => Ok(tag(number)),
            None => Err(StoreError::conflict(name)),
        }
    }

    pub(crate) fn delete(&self, name: &str) -> Result<(), StoreError> {
        let path = self.root.join(name);
        let removed = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
        match removed {
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
        Ok(names.filter(|name| !atomic_file::is_temporary(name)).collect())
    }

    pub(crate) fn remove_unfinished(&self, name: &str) -> Result<(), StoreError> {
        match atomic_file::remove_older(&self.root.join(name), UNFINISHED_AFTER) {
            Err(why) if why.kind() != io::ErrorKind::NotFound => Err(StoreError::failed(name, why.to_string())),
            _ => Ok(()),
        }
    }

    fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let path = self.root.join(name);
        fs::create_dir_all(path.parent().unwrap_or(&self.root))?;
        atomic_file::write(&path, bytes)
    }
}

fn tag(number: u64) -> Tag {
    Tag(number.to_string())
}
