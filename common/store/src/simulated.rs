//! Objects in memory, with faults, for tests. As on S3, an object's tag depends on its bytes alone.

use std::{
    collections::{BTreeMap, VecDeque},
    hash::{DefaultHasher, Hash, Hasher},
    sync::{Arc, Mutex, MutexGuard},
};

use crate::{StoreError, Tag};

/// Fault of one operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The request does not arrive.
    Lost,
    /// The request takes effect, and its answer does not arrive.
    AnswerLost,
}

/// Objects that several stores share.
#[derive(Clone, Debug, Default)]
pub struct SimulatedObjects {
    shared: Arc<Mutex<Shared>>,
    /// Whether faults do not concern this handle.
    is_faultless: bool,
}

#[derive(Debug, Default)]
struct Shared {
    objects: BTreeMap<String, Vec<u8>>,
    is_down: bool,
    ignores_conditions: bool,
    faults: VecDeque<Option<Fault>>,
}

impl SimulatedObjects {
    /// Returns a handle to the same objects whose operations always succeed.
    #[must_use]
    pub fn without_faults(&self) -> Self {
        Self { is_faultless: true, ..self.clone() }
    }

    /// Lets every operation fail until this is taken back.
    pub fn set_down(&self, is_down: bool) {
        self.lock().is_down = is_down;
    }

    /// Lets every conditional write succeed, as some servers do.
    pub fn ignore_conditions(&self) {
        self.lock().ignores_conditions = true;
    }

    /// Sets the faults of the next operations, `None` for one that succeeds.
    pub fn set_faults(&self, faults: impl IntoIterator<Item = Option<Fault>>) {
        self.lock().faults = faults.into_iter().collect();
    }

    pub(crate) fn put(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        self.run(name, |shared| {
            shared.objects.insert(name.to_string(), bytes.to_vec());
            Ok(())
        })
    }

    pub(crate) fn get(&self, name: &str) -> Result<(Vec<u8>, Tag), StoreError> {
        self.run(name, |shared| {
            let bytes = shared.objects.get(name).ok_or_else(|| StoreError::missing(name))?;
            Ok((bytes.clone(), tag(bytes)))
        })
    }

    pub(crate) fn replace(&self, name: &str, bytes: &[u8], last: Option<&Tag>) -> Result<Tag, StoreError> {
        self.run(name, |shared| {
            let is_last = shared.objects.get(name).map(|present| tag(present)).as_ref() == last;
            if !is_last && !shared.ignores_conditions {
                return Err(StoreError::conflict(name));
            }
            shared.objects.insert(name.to_string(), bytes.to_vec());
            Ok(tag(bytes))
        })
    }

    pub(crate) fn delete(&self, name: &str) -> Result<(), StoreError> {
        self.run(name, |shared| {
            shared.objects.remove(name);
            Ok(())
        })
    }

    pub(crate) fn list(&self, folder: &str) -> Result<Vec<String>, StoreError> {
        let start = format!("{folder}/");
        let within = |name: &String| name.strip_prefix(&start).filter(|rest| !rest.contains('/')).map(str::to_string);
        self.run(folder, |shared| Ok(shared.objects.keys().filter_map(within).collect()))
    }

    fn run<T>(
        &self,
        name: &str,
        operation: impl FnOnce(&mut Shared) -> Result<T, StoreError>,
    ) -> Result<T, StoreError> {
        let mut shared = self.lock();
        if self.is_faultless {
            return operation(&mut shared);
        }
        let fault = shared.faults.pop_front().flatten();
        if shared.is_down || fault == Some(Fault::Lost) {
            return Err(StoreError::failed(name, "the request was lost"));
        }
        let done = operation(&mut shared);
        match fault {
            Some(_) => Err(StoreError::failed(name, "the answer was lost")),
            None => done,
        }
    }

    fn lock(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().expect("no operation panics")
    }
}

fn tag(bytes: &[u8]) -> Tag {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    Tag(hasher.finish().to_string())
}
