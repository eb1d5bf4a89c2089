//! Film of the robot on its way to TensorBoard: the thread that has it rendered leaves it here, the next update logs it.

use std::sync::{Arc, Mutex, PoisonError};

/// Film of one policy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmOfPolicy {
    /// Environment steps that the policy has learnt from.
    pub env_steps: u64,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Bytes of a GIF.
    pub gif: Vec<u8>,
}

/// Place of the newest film that is not logged yet.
#[derive(Clone, Debug, Default)]
pub struct FilmSlot {
    film: Arc<Mutex<Option<FilmOfPolicy>>>,
}

impl FilmSlot {
    /// Leaves a film, in place of one that was not logged.
    pub fn put(&self, film: FilmOfPolicy) {
        *self.film.lock().unwrap_or_else(PoisonError::into_inner) = Some(film);
    }

    /// Takes the film.
    pub(super) fn take(&self) -> Option<FilmOfPolicy> {
        self.film.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}
