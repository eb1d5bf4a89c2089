//! Object store that keeps a run's durable state and decides who may write it.
//!
//! # Layout
//! - Here: [`Store`], its operations and their errors.
//! - `location`: a store's URL.
//! - `folder` with `versions`: objects as files of a folder, as on a network file system.
//! - [`promises`]: whether a store keeps the promises that leadership rests on.
//! - `remote`: S3, Google Cloud Storage and Azure, by the crate `object_store`.
//! - [`simulated`]: objects in memory, with faults, for tests.

mod error;
mod folder;
mod location;
pub mod promises;
mod remote;
pub mod simulated;
mod versions;

use std::{fmt, sync::Arc};

pub use self::error::StoreError;
use self::{folder::Folder, location::Location, remote::Remote, simulated::SimulatedObjects};

/// Version of an object's bytes, as its store names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tag(String);

/// Place with a run's objects. Clones share its connections.
///
/// All calls block: use them on threads of their own, never in an async task.
#[derive(Clone, Debug)]
pub struct Store {
    name: Arc<str>,
    objects: Objects,
}

#[derive(Clone, Debug)]
enum Objects {
    Folder(Arc<Folder>),
    Remote(Arc<Remote>),
    Simulated(SimulatedObjects),
}

impl Store {
    /// Opens the store at a URL: `file:///…`, `s3://…`, `gs://…` or `az://…`. Credentials of a remote store come from the
    /// environment, by the names that its own tools use, such as `AWS_ACCESS_KEY_ID`. No object is read or written.
    ///
    /// # Errors
    /// If the URL names no store, contains credentials, or the environment lacks what the store requires.
    pub fn open(url: &str) -> Result<Self, StoreError> {
        let objects = match Location::parse(url)? {
            Location::Folder(root) => Objects::Folder(Arc::new(Folder::new(root))),
            Location::Remote(scheme, url) => Objects::Remote(Arc::new(Remote::open(scheme, &url)?)),
        };
        Ok(Self { name: url.trim_end_matches('/').into(), objects })
    }

    /// Store in memory.
    #[must_use]
    pub fn simulated(objects: &SimulatedObjects) -> Self {
        Self { name: "memory".into(), objects: Objects::Simulated(objects.clone()) }
    }

    /// Writes an object, whatever was there.
    ///
    /// # Errors
    /// If the store fails. The object may have been written all the same.
    pub fn put(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        match &self.objects {
            Objects::Folder(folder) => folder.put(name, bytes),
            Objects::Remote(remote) => remote.put(name, bytes),
            Objects::Simulated(objects) => objects.put(name, bytes),
        }
        .map_err(|why| self.named(why))
    }

    /// Reads an object and its tag.
    ///
    /// # Errors
    /// [`StoreError::Missing`] if it does not exist, or if the store fails.
    pub fn get(&self, name: &str) -> Result<(Vec<u8>, Tag), StoreError> {
        match &self.objects {
            Objects::Folder(folder) => folder.get(name),
            Objects::Remote(remote) => remote.get(name),
            Objects::Simulated(objects) => objects.get(name),
        }
        .map_err(|why| self.named(why))
    }

    /// Writes an object only if it still has the tag `last`, or with `None` only if it does not exist. Returns its new tag.
    ///
    /// # Errors
    /// [`StoreError::Conflict`] if another writer was first. If the store fails otherwise, the object may have been written.
    pub fn replace(&self, name: &str, bytes: &[u8], last: Option<&Tag>) -> Result<Tag, StoreError> {
        match &self.objects {
            Objects::Folder(folder) => folder.replace(name, bytes, last),
            Objects::Remote(remote) => remote.replace(name, bytes, last),
            Objects::Simulated(objects) => objects.replace(name, bytes, last),
        }
        .map_err(|why| self.named(why))
    }

    /// Deletes an object. It is no error if there is none.
    ///
    /// # Errors
    /// If the store fails.
    pub fn delete(&self, name: &str) -> Result<(), StoreError> {
        match &self.objects {
            Objects::Folder(folder) => folder.delete(name),
            Objects::Remote(remote) => remote.delete(name),
            Objects::Simulated(objects) => objects.delete(name),
        }
        .map_err(|why| self.named(why))
    }

    /// Returns the sorted names, relative to `folder`, of the objects directly in it.
    ///
    /// # Errors
    /// If the store fails.
    pub fn list(&self, folder: &str) -> Result<Vec<String>, StoreError> {
        let mut names = match &self.objects {
            Objects::Folder(objects) => objects.list(folder),
            Objects::Remote(remote) => remote.list(folder),
            Objects::Simulated(objects) => objects.list(folder),
        }
        .map_err(|why| self.named(why))?;
        names.sort_unstable();
        Ok(names)
    }

    /// Removes what killed writers left unfinished beside the objects of a folder, or the versions of an object. Only a
    /// store of files keeps such things.
    ///
    /// # Errors
    /// If the store fails.
    pub fn remove_unfinished(&self, name: &str) -> Result<(), StoreError> {
        match &self.objects {
            Objects::Folder(folder) => folder.remove_unfinished(name).map_err(|why| self.named(why)),
            Objects::Remote(_) | Objects::Simulated(_) => Ok(()),
        }
    }

    /// Waits as long as this kind of store wants between two writes of one object.
    fn pause(&self) {
        if let Objects::Remote(remote) = &self.objects {
            std::thread::sleep(remote.pause());
        }
    }

    fn named(&self, mut why: StoreError) -> StoreError {
        why.set_store(&self.name);
        why
    }
}

impl fmt::Display for Store {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

#[cfg(test)]
mod tests {
    use std::{
        fs,
        time::{Duration, SystemTime},
    };

    use super::*;

    #[test]
    fn unfinished_writes_are_removed_once_they_are_old() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(&format!("file://{}", folder.path().display())).unwrap();
        store.remove_unfinished("states").unwrap();
        store.put("states/1.bundle", b"a").unwrap();
        store.replace("manifest.json", b"one", None).unwrap();
        for (name, age_s, stays) in [("states", 7200, false), ("manifest.json", 7200, false), ("states", 60, true)] {
            let path = folder.path().join(name).join(".x.0.1.tmp");
            let left = fs::File::create(&path).unwrap();
            left.set_modified(SystemTime::now() - Duration::from_secs(age_s)).unwrap();
            store.remove_unfinished(name).unwrap();
            assert_eq!(path.exists(), stays, "{name}");
        }
        assert_eq!(store.list("states").unwrap(), ["1.bundle"]);
        assert_eq!(store.get("manifest.json").unwrap().0, b"one");
    }

    #[test]
    fn one_of_many_writers_wins_each_time() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(&format!("file://{}", folder.path().display())).unwrap();
        let wins = |writer: usize| {
            let won = |round: usize| {
                let (name, text) = (format!("round-{round}"), format!("writer {writer}"));
                usize::from(store.replace(&name, text.as_bytes(), None).is_ok())
            };
            (0..20).map(won).sum::<usize>()
        };
        let total: usize = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..4).map(|writer| scope.spawn(move || wins(writer))).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).sum()
        });
        assert_eq!(total, 20);
    }
}
