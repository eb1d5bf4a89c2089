//! One encoded fragment, sent under many names and numbers by load generators and replays.

use prost::Message;

use crate::{Fragment, Malformed, Precision, wire};

/// Fragment that is encoded once.
#[derive(Clone, Debug)]
pub struct PreparedFragment {
    encoded: Vec<u8>,
}

impl PreparedFragment {
    /// Checks and encodes a fragment.
    pub fn new(fragment: &Fragment, precision: Precision) -> Result<Self, Malformed> {
        Ok(Self { encoded: fragment.encode_as(precision)? })
    }

    /// Returns the fragment under another name, incarnation and sequence number.
    pub fn under(&self, actor: &str, actor_incarnation: u64, sequence: u64) -> Vec<u8> {
        let mut bytes = self.encoded.clone();
        self.rename(&mut bytes, actor, actor_incarnation, sequence);
        bytes
    }

    /// Renames the result of [`Self::under`] without copying the fragment.
    pub fn rename(&self, bytes: &mut Vec<u8>, actor: &str, actor_incarnation: u64, sequence: u64) {
        bytes.truncate(self.encoded.len());
        // If a field occurs twice, protobuf uses the later one.
        let names = wire::Fragment { actor: actor.to_string(), actor_incarnation, sequence, ..Default::default() };
        names.encode(bytes).expect("a vector grows");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_name_and_numbers_change() {
        let mut fragment = crate::fragment::tests::sample();
        fragment.actor_state = None;
        let prepared = PreparedFragment::new(&fragment, Precision::F32).unwrap();
        let mut bytes = prepared.under("first", 1, 1 << 60);
        prepared.rename(&mut bytes, "other", 12, 34);
        assert_eq!(bytes, prepared.under("other", 12, 34));
        assert_eq!(
            Fragment::decode(bytes).unwrap(),
            Fragment { actor: "other".into(), actor_incarnation: 12, sequence: 34, ..fragment }
        );
    }
}
