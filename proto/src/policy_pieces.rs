//! Conditional requests of actors for the newest policy, and its pieces.
//!
//! Each piece fits into one batch of the bus. So a server never waits for a requester that reads slowly or not at all: the
//! requester asks for the next pieces when it has the previous ones.

use bytes::Bytes;
use prost::Message;

use crate::{
    Malformed, PolicyVersion, check_size,
    ident::check_ident,
    limits::{BUNDLE_BYTES_MAX, PIECE_BYTES_MAX, SMALL_BYTES_MAX},
    version, wire,
};

/// Kinds of message in errors.
const REQUEST: &str = "policy request";
const PIECE: &str = "piece of a policy";

/// Request for a piece of the newest policy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PolicyRequest {
    /// Version in use; `None` on joining.
    pub known: Option<PolicyVersion>,
    /// Newest version that the requester has heard of.
    pub announced: Option<PolicyVersion>,
    /// Hash of the configuration that the requester has; 0 on joining.
    pub config_hash: u64,
    /// First byte of the piece.
    pub offset: u64,
}

impl PolicyRequest {
    /// Encodes as protobuf.
    pub fn encode(&self) -> Vec<u8> {
        wire::PolicyRequest {
            known: self.known,
            announced: self.announced,
            config_hash: self.config_hash,
            offset: self.offset,
        }
        .encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, Malformed> {
        check_size(REQUEST, bytes.len(), SMALL_BYTES_MAX)?;
        let message = wire::PolicyRequest::decode(bytes).map_err(Malformed::undecodable(REQUEST))?;
        Ok(Self {
            known: message.known,
            announced: message.announced,
            config_hash: message.config_hash,
            offset: message.offset,
        })
    }
}

/// Piece of an encoded policy bundle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PolicyPiece {
    /// Name of the run.
    pub run: String,
    /// Version of the policy.
    pub version: PolicyVersion,
    /// Size of the whole bundle; 0 if the version that the requester knows is the newest.
    pub total_bytes: u64,
    /// First byte of this piece.
    pub offset: u64,
    /// The bytes.
    pub data: Bytes,
}

impl PolicyPiece {
    /// Returns the reply to a requester that has the newest version.
    pub fn unchanged(run: &str, version: PolicyVersion) -> Self {
        Self { run: run.to_string(), version, total_bytes: 0, offset: 0, data: Bytes::new() }
    }

    /// Returns the piece of `bundle` that begins at `offset`. It is empty if the bundle ends before.
    pub fn cut(run: &str, version: PolicyVersion, bundle: &Bytes, offset: u64) -> Self {
        let start = usize::try_from(offset).map_or(bundle.len(), |offset| offset.min(bundle.len()));
        let end = bundle.len().min(start + PIECE_BYTES_MAX);
        let (total_bytes, data) = (bundle.len() as u64, bundle.slice(start..end));
        Self { run: run.to_string(), version, total_bytes, offset: start as u64, data }
    }

    /// Returns whether the requester's version is the newest.
    #[must_use]
    pub fn is_unchanged(&self) -> bool {
        self.total_bytes == 0
    }

    /// Encodes as protobuf.
    pub fn encode(&self) -> Vec<u8> {
        wire::PolicyPiece {
            run: self.run.clone(),
            version: Some(self.version),
            total_bytes: self.total_bytes,
            offset: self.offset,
            data: self.data.clone(),
        }
        .encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: impl Into<Bytes>) -> Result<Self, Malformed> {
        let bytes = bytes.into();
        check_size(PIECE, bytes.len(), SMALL_BYTES_MAX)?;
        let message = wire::PolicyPiece::decode(bytes).map_err(Malformed::undecodable(PIECE))?;
        check_ident("run", &message.run)?;
        let (total, data) = (message.total_bytes, message.data.len() as u64);
        if total > BUNDLE_BYTES_MAX as u64 {
            return Err(Malformed::field("total_bytes", total, format!("at most {BUNDLE_BYTES_MAX}")));
        }
        if message.offset.checked_add(data).is_none_or(|end| end > total) {
            let found = format!("{} with {data} bytes of data", message.offset);
            return Err(Malformed::field("offset", found, format!("an end at or before {total}")));
        }
        Ok(Self {
            run: message.run,
            version: version::required(message.version)?,
            total_bytes: total,
            offset: message.offset,
            data: message.data,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERSION: PolicyVersion = PolicyVersion::new(7, 3);

    #[test]
    fn requests_and_pieces_round_trip() {
        let joining = PolicyRequest::default();
        assert_eq!(PolicyRequest::decode(&joining.encode()).unwrap(), joining);
        assert!(joining.encode().is_empty(), "an empty payload is a request of an actor that joins");
        let request = PolicyRequest { known: Some(VERSION), announced: Some(VERSION), config_hash: 9, offset: 60_000 };
        assert_eq!(PolicyRequest::decode(&request.encode()).unwrap(), request);
        let unchanged = PolicyPiece::unchanged("walk", VERSION);
        assert_eq!(PolicyPiece::decode(unchanged.encode()).unwrap(), unchanged);
        assert!(unchanged.is_unchanged() && unchanged.encode().len() < 64);
    }

    #[test]
    fn pieces_make_up_the_bundle() {
        let bundle = Bytes::from((0..75_001u32).map(|byte| byte as u8).collect::<Vec<_>>());
        let (mut joined, mut lengths) = (Vec::new(), Vec::new());
        while joined.len() < bundle.len() {
            let piece = PolicyPiece::cut("walk", VERSION, &bundle, joined.len() as u64);
            let encoded = piece.encode();
            assert!(encoded.len() < 32_000, "{}", encoded.len());
            let decoded = PolicyPiece::decode(encoded).unwrap();
            assert_eq!((decoded.offset, decoded.total_bytes), (joined.len() as u64, 75_001));
            joined.extend_from_slice(&decoded.data);
            lengths.push(decoded.data.len());
        }
        assert_eq!((joined == bundle, &lengths[..]), (true, &[30_000, 30_000, 15_001][..]));
        for beyond in [75_001, u64::MAX] {
            let piece = PolicyPiece::cut("walk", VERSION, &bundle, beyond);
            assert_eq!((piece.offset, piece.data.len()), (75_001, 0));
        }
    }

    #[test]
    fn the_error_names_the_bad_field() {
        let piece =
            PolicyPiece { total_bytes: 4, ..PolicyPiece::cut("walk", VERSION, &Bytes::from_static(b"policy"), 0) };
        let refusal = |piece: &PolicyPiece| PolicyPiece::decode(piece.encode()).unwrap_err().to_string();
        assert!(refusal(&piece).contains("offset"), "{}", refusal(&piece));
        let wraps = PolicyPiece { offset: u64::MAX, total_bytes: 6, ..piece.clone() };
        assert!(refusal(&wraps).contains("offset"), "{}", refusal(&wraps));
        let large = PolicyPiece { total_bytes: BUNDLE_BYTES_MAX as u64 + 1, ..piece.clone() };
        assert!(refusal(&large).contains("total_bytes"), "{}", refusal(&large));
        let unnamed = PolicyPiece { run: "Walk".into(), total_bytes: 6, ..piece };
        assert!(refusal(&unnamed).contains("run"), "{}", refusal(&unnamed));
        let versionless = wire::PolicyPiece { run: "walk".into(), ..Default::default() }.encode_to_vec();
        assert!(PolicyPiece::decode(versionless).unwrap_err().to_string().contains("version"));
    }
}
