//! File format of a checkpoint: magic, format version, length, checksum, then the state in bincode.
//!
//! Only this file names bincode, which is unmaintained (RUSTSEC-2025-0141) and pinned to 2.0.1. To replace it: raise
//! [`FORMAT`], and encode the state by another serde format below.

use serde::{Serialize, de::DeserializeOwned};
use treadmill_runtime::error_chain;

use super::CheckpointError;

const MAGIC: &[u8; 8] = b"TREADMIL";
/// Version of the format, raised whenever the state's fields change: bincode files do not describe themselves.
pub const FORMAT: u32 = 11;
const CHECKSUM_BYTES: usize = 4;
const HEADER_BYTES: usize = 8 + 4 + 8 + CHECKSUM_BYTES;
/// Steps of (largest payload, memory that decoding it may take), in bytes, so that a wrong length inside cannot claim
/// all memory. There are steps because bincode's limits are constants.
const SMALL: (usize, usize) = (64 << 10, 1 << 20);
const MEDIUM: (usize, usize) = (1 << 20, 16 << 20);
const LARGE: (usize, usize) = (16 << 20, 256 << 20);
const STATE_BYTES_MAX: usize = 4 << 30;

/// Whether bytes begin like a checkpoint.
pub fn is_checkpoint(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Encodes a state as the bytes of a file.
pub fn encode<T: Serialize>(state: &T) -> Result<Vec<u8>, CheckpointError> {
    let payload = bincode::serde::encode_to_vec(state, bincode::config::standard())
        .map_err(|why| CheckpointError::Encode { why: error_chain(&why) })?;
    let mut bytes = Vec::with_capacity(HEADER_BYTES + payload.len());
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&FORMAT.to_le_bytes());
    bytes.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&checksum(&payload));
    bytes.extend_from_slice(&payload);
    Ok(bytes)
}

/// Returns the checksum of format and payload, CRC-32C: actors wait while it is computed.
pub fn checksum(payload: &[u8]) -> [u8; CHECKSUM_BYTES] {
    crc32c::crc32c_append(crc32c::crc32c(&FORMAT.to_le_bytes()), payload).to_le_bytes()
}

/// Returns the encoded state in the bytes of a file.
///
/// # Errors
/// If the file is damaged or has another format.
pub fn payload<'a>(path: &str, bytes: &'a [u8]) -> Result<&'a [u8], CheckpointError> {
    let damaged = |why: String| CheckpointError::Damaged { path: path.to_string(), why };
    if bytes.len() < HEADER_BYTES {
        return Err(damaged(format!("it has {} bytes, fewer than its header", bytes.len())));
    }
    let (header, payload) = bytes.split_at(HEADER_BYTES);
    if &header[..8] != MAGIC {
        return Err(damaged("it does not begin like a checkpoint".to_string()));
    }
    let format = u32::from_le_bytes(header[8..12].try_into().expect("four bytes"));
    if format != FORMAT {
        return Err(CheckpointError::Format { path: path.to_string(), found: format });
    }
    let length = u64::from_le_bytes(header[12..20].try_into().expect("eight bytes"));
    if length != payload.len() as u64 {
        return Err(damaged(format!("it is truncated to {} of {length} bytes of state", payload.len())));
    }
    if checksum(payload) != header[20..] {
        return Err(damaged("its checksum does not match its content".to_string()));
    }
    Ok(payload)
}

/// Decodes an encoded state.
///
/// # Errors
/// If the bytes are not those of such a state.
pub fn decode<T: DeserializeOwned>(path: &str, payload: &[u8]) -> Result<T, CheckpointError> {
    match payload.len() {
        length if length <= SMALL.0 => read::<T, { SMALL.1 }>(payload),
        length if length <= MEDIUM.0 => read::<T, { MEDIUM.1 }>(payload),
        length if length <= LARGE.0 => read::<T, { LARGE.1 }>(payload),
        _ => read::<T, STATE_BYTES_MAX>(payload),
    }
    .map_err(|why| CheckpointError::Damaged { path: path.to_string(), why })
}

fn read<T: DeserializeOwned, const BYTES_MAX: usize>(payload: &[u8]) -> Result<T, String> {
    bincode::serde::decode_from_slice(payload, bincode::config::standard().with_limit::<BYTES_MAX>())
        .map(|(state, _)| state)
        .map_err(|why| error_chain(&why))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_decoded_state_equals_the_encoded_one() {
        let state = (vec![1.0_f32, -0.5], "run".to_string(), 7_u64);
        let bytes = encode(&state).unwrap();
        let payload = payload("x", &bytes).unwrap();
        assert_eq!(decode::<(Vec<f32>, String, u64)>("x", payload).unwrap(), state);
    }

    #[test]
    fn each_kind_of_damage_is_named() {
        let sound = encode(&vec![1u64; 20]).unwrap();
        let why = |bytes: &[u8]| payload("here", bytes).unwrap_err().to_string();
        assert!(why(&sound[..10]).contains("header"));
        assert!(why(&sound[..sound.len() - 3]).contains("truncated"));
        let mut flipped = sound.clone();
        *flipped.last_mut().unwrap() ^= 1;
        assert!(why(&flipped).contains("checksum"));
        let mut newer = sound.clone();
        newer[8] = 99;
        assert!(why(&newer).contains("format 99"), "{}", why(&newer));
        let mut older = sound.clone();
        older[8] = 1;
        assert!(why(&older).contains(&format!("format 1; this program reads format {FORMAT}")), "{}", why(&older));
        assert!(why(&[b'x'; 200]).contains("does not begin"));
    }

    proptest! {
        #[test]
        fn one_changed_byte_is_always_detected(at in 0usize..100, with in 1u8..) {
            let mut bytes = encode(&vec![3u64; 40]).unwrap();
            let at = at % bytes.len();
            bytes[at] ^= with;
            prop_assert!(payload("x", &bytes).is_err());
        }
    }
}
