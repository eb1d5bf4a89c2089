//! Named random streams, derived from the run's seed. Every random number of a run comes from one of them.

use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use sha2::{Digest, Sha256};

/// Generator of every stream. Its state is small and serialisable, for checkpoints.
pub type Stream = Xoshiro256PlusPlus;

/// Returns the seed of the stream `name` with the numbers `index`, derived from the run's seed.
pub fn derive(run_seed: u64, name: &str, index: &[u64]) -> u64 {
    let mut hash = Sha256::new();
    hash.update(run_seed.to_le_bytes());
    hash.update((name.len() as u64).to_le_bytes());
    hash.update(name.as_bytes());
    index.iter().for_each(|number| hash.update(number.to_le_bytes()));
    first_eight(&hash.finalize())
}

/// Returns the stream `name` with the numbers `index`.
pub fn stream(run_seed: u64, name: &str, index: &[u64]) -> Stream {
    Stream::seed_from_u64(derive(run_seed, name, index))
}

/// Returns the state of a stream.
pub fn words(stream: &Stream) -> [u64; 4] {
    // The state is accessible only through serialisation.
    let state = serde_json::to_value(stream).unwrap_or_default();
    std::array::from_fn(|index| state["s"][index].as_u64().unwrap_or_default())
}

/// Returns the stream with a state from [`words`]. Four zeros, an invalid state, give a stream of another state.
pub fn from_words(words: [u64; 4]) -> Stream {
    let mut bytes = [0; 32];
    for (place, word) in bytes.chunks_exact_mut(8).zip(words) {
        place.copy_from_slice(&word.to_le_bytes());
    }
    Stream::from_seed(bytes)
}

/// Returns a checksum for announcements and configuration hashes: the first eight bytes of SHA-256, little endian.
pub fn checksum(parts: &[&[u8]]) -> u64 {
    let mut hash = Sha256::new();
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    first_eight(&hash.finalize())
}

/// Returns a number unique to this call, for incarnations and names. Learning must not depend on it.
pub fn unique() -> u64 {
    let since_1970 = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
    let address = &since_1970 as *const _ as u64;
    let number = checksum(&[
        &since_1970.as_nanos().to_le_bytes(),
        &std::process::id().to_le_bytes(),
        &address.to_le_bytes(),
        crate::machine::host_name().as_bytes(),
    ]);
    // Zero stands for "none" on the wire.
    number.max(1)
}

fn first_eight(bytes: &[u8]) -> u64 {
    u64::from_le_bytes(bytes[..8].try_into().expect("a SHA-256 has 32 bytes"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_differ_by_seed_name_and_index_and_repeat() {
        let base = derive(1, "reset", &[0, 1]);
        assert_eq!(base, derive(1, "reset", &[0, 1]));
        for other in [derive(2, "reset", &[0, 1]), derive(1, "noise", &[0, 1]), derive(1, "reset", &[1, 0])] {
            assert_ne!(base, other);
        }
    }

    #[test]
    fn a_stream_continues_from_its_words() {
        use rand::Rng;
        let mut original = stream(3, "x", &[]);
        for _ in 0..50 {
            original.next_u64();
        }
        let kept = words(&original);
        let mut restored = from_words(kept);
        assert_eq!(words(&restored), kept);
        assert!(kept.iter().all(|word| *word != 0), "{kept:?}");
        for _ in 0..50 {
            assert_eq!(original.next_u64(), restored.next_u64());
        }
        assert_ne!(words(&restored), kept);
        assert_ne!(words(&from_words([0; 4])), [0; 4], "a generator at zero would stay there");
    }

    #[test]
    fn the_checksum_depends_on_the_boundaries_of_parts() {
        assert_ne!(checksum(&[b"ab", b"c"]), checksum(&[b"a", b"bc"]));
    }
}
