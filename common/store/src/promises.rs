//! Whether a store keeps the promises that leadership rests on.
//!
//! Servers that speak S3's language may ignore the conditions of a write. Two learners would then lead a run at once.

use crate::{Store, StoreError};

/// What a store did against its promises.
#[derive(Debug, thiserror::Error)]
pub enum PromiseError {
    /// It broke one.
    #[error("the store `{store}` {broken}; two learners could lead one run at once")]
    Broken {
        /// URL of the store.
        store: String,
        /// What it did.
        broken: &'static str,
    },
    /// It failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Writes, replaces, lists and deletes trial objects in the folder `check`, with names of this `number`.
///
/// # Errors
/// If the store breaks a promise, or fails. Trial objects may then stay.
pub fn check(store: &Store, number: u64) -> Result<(), PromiseError> {
    let names = ["json", "bundle"].map(|kind| format!("{number:016x}.{kind}"));
    let [manifest, state] = names.clone().map(|name| format!("check/{name}"));
    let broken = |broken| Err(PromiseError::Broken { store: store.to_string(), broken });
    let first = store.replace(&manifest, b"one", None)?;
    if !is_refused(store.replace(&manifest, b"two", None))? {
        return broken("creates an object that exists already");
    }
    if store.get(&manifest)? != (b"one".to_vec(), first.clone()) {
        return broken("does not return what was written last");
    }
    let second = store.replace(&manifest, b"two", Some(&first))?;
    if !is_refused(store.replace(&manifest, b"three", Some(&first)))? {
        return broken("replaces an object that another writer has changed");
    }
    if store.get(&manifest)? != (b"two".to_vec(), second) {
        return broken("does not return what was written last");
    }
    store.put(&state, b"a")?;
    store.put(&state, b"b")?;
    let listed = store.list("check")?;
    if store.get(&state)?.0 != b"b" || !names.iter().all(|name| listed.contains(name)) {
        return broken("does not list or return what was written last");
    }
    for name in [&state, &manifest] {
        store.delete(name)?;
    }
    // It is no error if there is none.
    store.delete(&state)?;
    match store.get(&state) {
        Err(StoreError::Missing { .. }) => Ok(()),
        Err(why) => Err(why.into()),
        Ok(_) => broken("returns an object that was deleted"),
    }
}

/// Returns whether a write lost against another writer.
fn is_refused(written: Result<crate::Tag, StoreError>) -> Result<bool, StoreError> {
    match written {
        Ok(_) => Ok(false),
        Err(StoreError::Conflict { .. }) => Ok(true),
        Err(why) => Err(why),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulated::SimulatedObjects;

    #[test]
    fn every_kind_keeps_its_promises() {
        let folder = tempfile::tempdir().unwrap();
        let files = Store::open(&format!("file://{}/run", folder.path().display())).unwrap();
        let memory = Store::simulated(&SimulatedObjects::default());
        for store in [files, memory] {
            assert!(matches!(store.get("check/0000000000000007.json"), Err(StoreError::Missing { .. })));
            assert_eq!(store.list("check").unwrap(), Vec::<String>::new());
            check(&store, 7).unwrap();
            assert_eq!(store.list("check").unwrap(), Vec::<String>::new());
        }
    }

    #[test]
    fn a_store_without_conditions_is_named() {
        let objects = SimulatedObjects::default();
        objects.ignore_conditions();
        let why = check(&Store::simulated(&objects), 7).unwrap_err().to_string();
        assert!(why.contains("`memory` creates an object that exists already; two learners"), "{why}");
    }
}
