//! A fragment as it arrives: read where the bus has put it.

use std::{
    io::Read,
    sync::atomic::{AtomicU64, Ordering},
};

use treadmill_proto::{Fragment, Malformed, fragment::claimed_incarnation};
use zenoh::bytes::ZBytes;

/// A payload in one piece of this size or more came through shared memory.
const SHARED_BYTES_MIN: usize = 64 << 10;
/// As much of a fragment's beginning as holds run, actor and incarnation.
const BEGINNING_BYTES: usize = 160;

/// A fragment that was read, or why it cannot be.
#[derive(Clone, Debug)]
pub struct ReceivedFragment {
    /// The incarnation that it claims to be of.
    pub claimed_incarnation: Option<u64>,
    /// Its size on the bus.
    pub bytes: usize,
    /// Checked by itself; whether it fits the run is another matter.
    pub fragment: Result<Fragment, Malformed>,
}

impl ReceivedFragment {
    /// Reads what the bus has received, in as many pieces of memory as it lies in. What came through shared memory is
    /// counted.
    pub(super) fn read(received: &ZBytes, shared: &AtomicU64) -> Self {
        let pieces: Vec<&[u8]> = received.slices().collect();
        if pieces.len() == 1 && received.len() >= SHARED_BYTES_MIN {
            shared.fetch_add(1, Ordering::Relaxed);
        }
        Self {
            claimed_incarnation: claimed(received),
            bytes: received.len(),
            fragment: Fragment::decode_pieces(&pieces),
        }
    }
}

impl<T: AsRef<[u8]>> From<T> for ReceivedFragment {
    fn from(encoded: T) -> Self {
        let (claimed_incarnation, bytes) = (claimed_incarnation(encoded.as_ref()), encoded.as_ref().len());
        Self { claimed_incarnation, bytes, fragment: Fragment::decode(encoded) }
    }
}

/// The incarnation that a fragment claims.
pub(super) fn claimed(received: &ZBytes) -> Option<u64> {
    let mut beginning = Vec::with_capacity(BEGINNING_BYTES);
    received.reader().take(BEGINNING_BYTES as u64).read_to_end(&mut beginning).ok()?;
    claimed_incarnation(&beginning)
}
