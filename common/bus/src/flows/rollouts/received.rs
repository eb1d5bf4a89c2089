//! Fragments as they arrive, decoded straight from the bus's buffers.

use std::{
    io::Read,
    sync::atomic::{AtomicU64, Ordering},
};

use treadmill_proto::{Fragment, Malformed, fragment::claimed_incarnation};
use zenoh::bytes::ZBytes;

use crate::session::SHARED_BYTES_MIN;

/// Bytes at the start of a fragment that hold run, actor and incarnation.
const HEADER_BYTES: usize = 160;

/// Received fragment, decoded, or the reason why it cannot be decoded.
#[derive(Clone, Debug)]
pub struct ReceivedFragment {
    /// Incarnation that it claims.
    pub claimed_incarnation: Option<u64>,
    /// Size on the bus.
    pub bytes: usize,
    /// Decoded fragment, checked by itself but not yet against the run.
    pub fragment: Result<Fragment, Malformed>,
}

impl ReceivedFragment {
    /// Decodes a payload in as many pieces as it lies in, and counts it in `shared` if it came through shared memory.
    pub(super) fn read(payload: &ZBytes, shared: &AtomicU64) -> Self {
        let pieces: Vec<&[u8]> = payload.slices().collect();
        // A payload of this size in one piece came through shared memory.
        if pieces.len() == 1 && payload.len() >= SHARED_BYTES_MIN {
            shared.fetch_add(1, Ordering::Relaxed);
        }
        Self {
            claimed_incarnation: incarnation_of(payload),
            bytes: payload.len(),
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

/// Returns the incarnation that a fragment claims.
pub(super) fn incarnation_of(payload: &ZBytes) -> Option<u64> {
    let mut header = Vec::with_capacity(HEADER_BYTES);
    payload.reader().take(HEADER_BYTES as u64).read_to_end(&mut header).ok()?;
    claimed_incarnation(&header)
}
