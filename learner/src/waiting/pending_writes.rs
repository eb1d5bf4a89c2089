//! Writes of a run that have not ended, so that other threads see what training waits for.

use std::{
    sync::{Arc, Mutex, MutexGuard},
    time::Instant,
};

use super::STALLED_AFTER;

/// Writes in progress. Clones share them.
#[derive(Clone, Debug, Default)]
pub struct PendingWrites(Arc<Mutex<Vec<Write>>>);

#[derive(Debug)]
struct Write {
    begun: Instant,
    /// Error of the last attempt, if one has failed.
    error: Option<String>,
}

impl PendingWrites {
    /// Returns an alarm about the write that has stalled for longest, if there is one.
    pub fn alarm(&self, now: Instant) -> Option<String> {
        let writes = self.lock();
        let longest = writes.iter().min_by_key(|write| write.begun)?;
        let waited = now.duration_since(longest.begun);
        (waited >= STALLED_AFTER).then(|| {
            let why = longest.error.as_deref().unwrap_or("the disk or the store does not answer");
            let seconds = waited.as_secs();
            format!(
                "training waits for a write that began {seconds} s ago, and goes on by itself once it succeeds: {why}"
            )
        })
    }

    /// Records a write that begins now. It ends when the guard is dropped.
    pub(super) fn begin(&self) -> WriteGuard<'_> {
        let begun = Instant::now();
        self.lock().push(Write { begun, error: None });
        WriteGuard { writes: self, begun }
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Write>> {
        self.0.lock().expect("no holder of this lock panics")
    }
}

/// One write in progress.
pub(super) struct WriteGuard<'a> {
    writes: &'a PendingWrites,
    /// Also identifies the write.
    begun: Instant,
}

impl WriteGuard<'_> {
    /// Records that an attempt has failed.
    pub(super) fn record_error(&self, error: &str) {
        let mut writes = self.writes.lock();
        if let Some(write) = writes.iter_mut().find(|write| write.begun == self.begun) {
            write.error = Some(error.to_string());
        }
    }
}

impl Drop for WriteGuard<'_> {
    fn drop(&mut self) {
        self.writes.lock().retain(|write| write.begun != self.begun);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_write_that_lasts_is_an_alarm() {
        let pending = PendingWrites::default();
        let later = Instant::now() + 2 * STALLED_AFTER;
        assert_eq!(pending.alarm(later), None);
        let first = pending.begin();
        assert_eq!(pending.alarm(Instant::now()), None, "it has just begun");
        assert!(pending.alarm(later).unwrap().contains("does not answer"));
        let second = pending.begin();
        second.record_error("no space");
        first.record_error("access denied");
        assert!(pending.alarm(later).unwrap().contains("access denied"));
        drop(first);
        assert!(pending.alarm(later).unwrap().contains("no space"));
        drop(second);
        assert_eq!(pending.alarm(later), None);
    }
}
