//! Fragments that are encoded once and sent under many names and numbers, by load generators.

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

    /// Returns the fragment with the sender and the numbers of `header`.
    pub fn under(&self, header: &Fragment) -> Vec<u8> {
        // If a field occurs twice, protobuf uses the later one.
        let names = wire::Fragment {
            actor: header.actor.clone(),
            actor_incarnation: header.actor_incarnation,
            sequence: header.sequence,
            settled_through: header.settled_through,
            env_steps: header.env_steps,
            collect_s: header.collect_s,
            ..Default::default()
        };
        let mut bytes = Vec::with_capacity(self.encoded.len() + names.encoded_len());
        bytes.extend_from_slice(&self.encoded);
        names.encode(&mut bytes).expect("a vector grows");
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_sender_and_numbers_change() {
        let mut fragment = crate::fragment::tests::sample();
        (fragment.actor_state, fragment.settled_through) = (None, 0);
        let prepared = PreparedFragment::new(&fragment, Precision::F32).unwrap();
        let (actor, actor_incarnation, sequence) = ("other".to_string(), 12, 34);
        let (settled_through, env_steps, collect_s) = (33, 100, 0.5);
        let header = Fragment { actor, actor_incarnation, sequence, settled_through, env_steps, collect_s, ..fragment };
        assert_eq!(Fragment::decode(prepared.under(&header)).unwrap(), header);
    }
}
