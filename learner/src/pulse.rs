//! A sign of life from the training thread, for whoever watches over it from another one.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

/// Beaten by the training thread as it goes along: while it waits for experience, and after each part of a round.
#[derive(Clone, Debug)]
pub struct Pulse {
    begun: Instant,
    /// Milliseconds from the beginning to the last beat.
    beaten_ms: Arc<AtomicU64>,
}

impl Default for Pulse {
    fn default() -> Self {
        Self { begun: Instant::now(), beaten_ms: Arc::default() }
    }
}

impl Pulse {
    /// Notes that something went on.
    pub fn beat(&self) {
        self.beaten_ms.store(self.begun.elapsed().as_millis() as u64, Ordering::Relaxed);
    }

    /// How long nothing went on.
    pub fn silence(&self) -> Duration {
        self.begun.elapsed().saturating_sub(Duration::from_millis(self.beaten_ms.load(Ordering::Relaxed)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn silence_lasts_until_the_next_beat() {
        let pulse = Pulse { begun: Instant::now() - Duration::from_secs(1000), beaten_ms: Arc::default() };
        let watched = pulse.clone();
        assert!(watched.silence() >= Duration::from_secs(1000));
        pulse.beat();
        assert!(watched.silence() < Duration::from_secs(1000));
    }
}
