//! Whether a store keeps the promises that leadership rests on.
//!
//! Servers that speak S3's language may ignore the conditions of a write. Two learners would then lead a run at once.

use crate::{Store, StoreError, Tag};

/// What a store did against its promises.
#[derive(Debug, thiserror::Error)]
pub enum PromiseError {
    /// It broke one.
    #[error("the store `{store}` {broken}")]
    Broken {
        /// URL of the store.
        store: String,
        /// What it did, and what may follow.
        broken: String,
    },
    /// It failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Writes, replaces, lists and deletes two trial objects in the folder `check`, with names of this `number`.
///
/// # Errors
/// If the store breaks a promise, or fails.
pub fn check(store: &Store, number: u64) -> Result<(), PromiseError> {
    let names = ["json", "bundle"].map(|kind| format!("{number:016x}.{kind}"));
    let objects = names.clone().map(|name| format!("check/{name}"));
    let tried = attempt(store, &names, &objects);
    // The second time there is nothing to delete, which is no error.
    let deleted = objects.iter().chain(&objects).try_for_each(|name| store.delete(name));
    tried?;
    deleted?;
    match store.get(&objects[0]) {
        Err(StoreError::Missing { .. }) => Ok(()),
        Err(why) => Err(why.into()),
        Ok(_) => Err(broken(store, "returns an object that was deleted")),
    }
}

fn attempt(store: &Store, names: &[String; 2], [manifest, state]: &[String; 2]) -> Result<(), PromiseError> {
    const TWO_LEADERS: &str = "so that two learners could lead one run at once";
    const OLD: &str = "does not return what was written last, so that a standby could go on from an old state";
    store.put(state, b"a")?;
    let first = match store.replace(manifest, b"one", None) {
        Err(why) => return Err(broken(store, &format!("took a plain write, but not a conditional one: {why}"))),
        Ok(first) => first,
    };
    if !is_refused(store.replace(manifest, b"two", None))? {
        return Err(broken(store, &format!("creates an object that exists already, {TWO_LEADERS}")));
    }
    if store.get(manifest)? != (b"one".to_vec(), first.clone()) {
        return Err(broken(store, OLD));
    }
    store.pause();
    let second = store.replace(manifest, b"two", Some(&first))?;
    if !is_refused(store.replace(manifest, b"three", Some(&first)))? {
        return Err(broken(store, &format!("replaces an object that another writer has changed, {TWO_LEADERS}")));
    }
    store.put(state, b"b")?;
    let listed = store.list("check")?;
    let is_newest = store.get(manifest)? == (b"two".to_vec(), second) && store.get(state)?.0 == b"b";
    if !is_newest || !names.iter().all(|name| listed.contains(name)) {
        return Err(broken(store, OLD));
    }
    store.pause();
    Ok(())
}

fn broken(store: &Store, broken: &str) -> PromiseError {
    PromiseError::Broken { store: store.to_string(), broken: broken.to_owned() }
}

/// Returns whether a write lost against another writer.
fn is_refused(written: Result<Tag, StoreError>) -> Result<bool, StoreError> {
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
        assert!(why.contains("`memory` creates an object that exists already, so that two learners"), "{why}");
        let left = Store::simulated(&objects).list("check").unwrap();
        assert_eq!(left, Vec::<String>::new());
    }
}
