//! Checkpoint of a run that a RUN argument names: a folder, a name below `runs/`, or the URL of a store.

use treadmill_learner::{
    checkpoint::{self, CheckpointChoice, Loaded, TrainingState},
    leadership::{
        Manifest,
        follower::{LoadedState, newest_state},
        read_manifest,
    },
};
use treadmill_runtime::{error_chain, run_folder::RunFolder, words::quoted};
use treadmill_store::{Store, StoreError};

use crate::launch::exit_code::Usage;

/// Reads a checkpoint of a run. The folder of a run whose state is in a store leads to the store.
///
/// # Errors
/// If there is no such run, or its checkpoint is missing or cannot be used.
pub fn load(run: &str, which: CheckpointChoice) -> anyhow::Result<Loaded> {
    match store_url(run) {
        Some(url) => load_stored(&url, which),
        None => Ok(checkpoint::load(&RunFolder::open(run)?, which)?),
    }
}

/// Returns the store that RUN names, or that of the run in its folder.
#[must_use]
pub fn store_url(run: &str) -> Option<String> {
    if run.contains("://") {
        return Some(run.to_string());
    }
    let url = std::fs::read_to_string(RunFolder::open(run).ok()?.store()).ok()?;
    Some(url.trim().to_string())
}

/// Returns the updates of the newest state in a store, without reading it; `None` if the store holds no run.
///
/// # Errors
/// If the store cannot be read.
pub fn stored_updates(url: &str) -> anyhow::Result<Option<u64>> {
    let store = Store::open(url).map_err(|why| Usage(error_chain(&why)))?;
    Ok(read_manifest(&store)?.map(|(manifest, _)| manifest.updates))
}

fn load_stored(url: &str, which: CheckpointChoice) -> anyhow::Result<Loaded> {
    let store = Store::open(url).map_err(|why| Usage(error_chain(&why)))?;
    let (name, object) = match which {
        CheckpointChoice::Best => ("best".to_string(), checkpoint::object(None)),
        CheckpointChoice::Numbered(number) => (number.to_string(), checkpoint::object(Some(number))),
        CheckpointChoice::Latest => return load_newest(&store),
        CheckpointChoice::BestOrLatest => match load_stored(url, CheckpointChoice::Best) {
            Err(why) if matches!(why.downcast_ref(), Some(StoreError::Missing { .. })) => return load_newest(&store),
            other => return other,
        },
    };
    let (bytes, _) = store.get(&object)?;
    Ok(Loaded { state: checkpoint::read(&format!("{store}/{object}"), &bytes)?, name })
}

/// Reads the newest state of the run in a store, and the manifest that names it.
///
/// # Errors
/// If the store cannot be read, or holds no run.
pub fn of_store(url: &str) -> anyhow::Result<(TrainingState, Manifest)> {
    let store = Store::open(url).map_err(|why| Usage(error_chain(&why)))?;
    let found = newest(&store)?;
    Ok((checkpoint::read(&format!("{store}/{}", found.manifest.state), &found.state)?, found.manifest))
}

fn load_newest(store: &Store) -> anyhow::Result<Loaded> {
    let LoadedState { manifest, state, .. } = newest(store)?;
    let state = checkpoint::read(&format!("{store}/{}", manifest.state), &state)?;
    Ok(Loaded { state, name: "latest".to_string() })
}

fn newest(store: &Store) -> anyhow::Result<LoadedState> {
    newest_state(store)?.ok_or_else(|| {
        let url = quoted(&store.to_string());
        let why = format!("the store `{store}` holds no run; begin one with `treadmill learner --store {url}`");
        Usage(why).into()
    })
}
