//! Thread that removes old states and notices when another learner leads.

use std::{
    io,
    sync::{
        Arc, OnceLock,
        atomic::{AtomicBool, Ordering},
        mpsc::{RecvTimeoutError, SyncSender, sync_channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

use treadmill_runtime::error_chain;
use treadmill_store::{Store, StoreError};

use super::{MANIFEST, Manifest, STATES, read_manifest, writer_name};

/// Interval of reading the manifest.
const READ_EVERY: Duration = Duration::from_secs(2);
/// Most states that are removed after a save.
const REMOVED_MAX: usize = 32;
/// Pause between two warnings. A store that fails for a while is warned of where training waits for it.
const WARN_EVERY: Duration = Duration::from_secs(300);
/// Newest states of a leader that are kept, so that a follower can read the one that it has found in the manifest.
const KEPT: usize = 3;

/// Handle to the thread.
#[derive(Debug)]
pub(super) struct Housekeeping {
    saved: Option<SyncSender<()>>,
    /// Manifest of the learner that has overtaken this one, once it is known.
    pub(super) successor: Arc<OnceLock<Manifest>>,
    /// Whether `successor` is known.
    pub(super) overtaken: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Housekeeping {
    pub(super) fn start(store: &Store, epoch: u64, writer: u64) -> io::Result<Self> {
        let (saved, events) = sync_channel(1);
        let (successor, overtaken) = (Arc::new(OnceLock::new()), Arc::new(AtomicBool::new(false)));
        let (store, found, is_found) = (store.clone(), successor.clone(), overtaken.clone());
        let work = move || {
            // Until the first save, the manifest is the predecessor's.
            let mut event = events.recv().map_err(|_| RecvTimeoutError::Disconnected);
            let (mut read, mut warned) = (Instant::now(), None::<Instant>);
            for name in [STATES, MANIFEST] {
                if let Err(why) = store.remove_unfinished(name) {
                    tracing::debug!(error = %error_chain(&why), "unfinished writes of killed learners not removed");
                }
            }
            loop {
                match event {
                    Ok(()) => {
                        if let Err(why) = remove_old_states(&store, epoch, writer)
                            && warned.is_none_or(|warned| warned.elapsed() >= WARN_EVERY)
                        {
                            tracing::warn!(error = %error_chain(&why), "old states not removed: the store will fill up");
                            warned = Some(Instant::now());
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {
                        read = Instant::now();
                        if let Some(manifest) = manifest_of_other(&store, writer) {
                            // Only here is it set, and once.
                            let _ = found.set(manifest);
                            return is_found.store(true, Ordering::Release);
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => return,
                }
                event = events.recv_timeout(READ_EVERY.saturating_sub(read.elapsed()));
            }
        };
        let thread = std::thread::Builder::new().name("leadership".to_string()).spawn(work)?;
        Ok(Self { saved: Some(saved), successor, overtaken, thread: Some(thread) })
    }

    /// Lets the thread remove old states. One note waits while it works; more are not needed.
    pub(super) fn note_saved(&self) {
        if let Some(saved) = &self.saved {
            let _ = saved.try_send(());
        }
    }
}

impl Drop for Housekeeping {
    fn drop(&mut self) {
        self.saved = None;
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been printed; leadership itself does not depend on it.
            let _ = thread.join();
        }
    }
}

/// Returns the manifest, if another learner wrote it. A store that fails shows nothing.
fn manifest_of_other(store: &Store, writer: u64) -> Option<Manifest> {
    let (manifest, _) = read_manifest(store).ok()??;
    (manifest.writer != writer_name(writer)).then_some(manifest)
}

/// Removes the states of lower epochs, and the older ones of this learner. States of higher epochs are a successor's.
/// Returns the first error.
fn remove_old_states(store: &Store, epoch: u64, writer: u64) -> Result<(), StoreError> {
    let own = format!("{epoch:012}-{writer:016x}-");
    let (mut mine, others): (Vec<_>, Vec<_>) = store.list(STATES)?.into_iter().partition(|name| name.starts_with(&own));
    mine.truncate(mine.len().saturating_sub(KEPT));
    let is_lower =
        |name: &String| name.split('-').next().and_then(|text| text.parse().ok()).is_some_and(|of: u64| of < epoch);
    let old = mine.into_iter().chain(others.into_iter().filter(is_lower));
    // One that cannot be removed must not keep the others; many must not delay everything else.
    old.take(REMOVED_MAX).map(|name| store.delete(&format!("{STATES}/{name}"))).fold(Ok(()), Result::and)
}
