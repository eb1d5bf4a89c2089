//! Contents that are encoded once and sent under many names and numbers, by load generators and replays.

use bytes::Bytes;
use prost::Message;

use crate::{Fragment, Malformed, Precision, check_range, check_size, limits, wire};

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

/// Transitions without episode ends, encoded once; fragments of any size repeat them.
#[derive(Clone, Debug)]
pub struct PreparedTransitions {
    /// One step of as many environments as there are transitions.
    message: wire::Fragment,
}

impl PreparedTransitions {
    /// Checks and encodes the transitions of a fragment of one step in which no episode ends.
    pub fn new(fragment: &Fragment, precision: Precision) -> Result<Self, Malformed> {
        check_range("steps", fragment.steps, 1)?;
        if let Some(flags) = fragment.flags.iter().find(|flags| **flags != 0) {
            return Err(Malformed::field("flags", flags, "0: no episode may end"));
        }
        let encoded = Bytes::from(fragment.encode_as(precision)?);
        Ok(Self { message: wire::Fragment::decode(encoded).map_err(Malformed::undecodable("fragment"))? })
    }

    /// Returns an encoded fragment with the sender, numbers and size of `header`; its planes repeat the prepared
    /// transitions. Run, version, configuration and widths are those of the prepared ones.
    pub fn encode(&self, header: &Fragment) -> Result<Vec<u8>, Malformed> {
        check_range("steps", header.steps, limits::STEPS_MAX)?;
        check_range("envs", header.envs, limits::ENVS_MAX)?;
        let (rows, envs) = (header.transitions(), header.envs as usize);
        // Before anything is allocated: observations are the largest plane.
        let row_bytes = self.message.observations.len() / self.message.envs as usize;
        check_size("fragment", rows.saturating_mul(row_bytes), limits::FRAGMENT_BYTES_MAX)?;
        let repeat = |plane: &Bytes, rows| repeat(plane, self.message.envs as usize, rows);
        let message = wire::Fragment {
            actor: header.actor.clone(),
            actor_incarnation: header.actor_incarnation,
            sequence: header.sequence,
            steps: header.steps,
            envs: header.envs,
            observations: repeat(&self.message.observations, rows),
            actions: repeat(&self.message.actions, rows),
            log_probs: repeat(&self.message.log_probs, rows),
            rewards: repeat(&self.message.rewards, rows),
            flags: repeat(&self.message.flags, rows),
            last_observations: repeat(&self.message.last_observations, envs),
            settled_through: header.settled_through,
            env_steps: header.env_steps,
            collect_s: header.collect_s,
            ..self.message.clone()
        };
        let bytes = message.encode_to_vec();
        check_size("fragment", bytes.len(), limits::FRAGMENT_BYTES_MAX)?;
        Ok(bytes)
    }
}

/// Returns the first `rows` rows of an endless repetition of a plane of `known` rows.
fn repeat(plane: &Bytes, known: usize, rows: usize) -> Bytes {
    let size = rows * (plane.len() / known);
    if size <= plane.len() {
        return plane.slice(..size);
    }
    let mut repeated = Vec::with_capacity(size);
    while repeated.len() < size {
        repeated.extend_from_slice(&plane[..plane.len().min(size - repeated.len())]);
    }
    repeated.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three transitions with one observation, one action.
    fn three_transitions() -> Fragment {
        Fragment {
            run: "run".into(),
            actor: "a".into(),
            actor_incarnation: 1,
            sequence: 1,
            config_hash: 9,
            steps: 1,
            envs: 3,
            observation_size: 1,
            action_size: 2,
            observations: vec![1.0, 2.0, 3.0],
            actions: vec![1.0, -1.0, 2.0, -2.0, 3.0, -3.0],
            log_probs: vec![0.1, 0.2, 0.3],
            rewards: vec![5.0, 6.0, 7.0],
            flags: vec![0; 3],
            last_observations: vec![4.0, 5.0, 6.0],
            ..Fragment::default()
        }
    }

    #[test]
    fn fragments_of_any_size_repeat_the_prepared_transitions() {
        for precision in [Precision::F32, Precision::F16] {
            let prepared = PreparedTransitions::new(&three_transitions(), precision).unwrap();
            let header = Fragment {
                actor: "other".into(),
                actor_incarnation: 12,
                sequence: 34,
                settled_through: 33,
                steps: 2,
                envs: 2,
                env_steps: 100,
                collect_s: 0.5,
                ..Fragment::default()
            };
            let decoded = Fragment::decode(prepared.encode(&header).unwrap()).unwrap();
            let expected = Fragment {
                run: "run".into(),
                config_hash: 9,
                observation_size: 1,
                action_size: 2,
                observations: vec![1.0, 2.0, 3.0, 1.0],
                actions: vec![1.0, -1.0, 2.0, -2.0, 3.0, -3.0, 1.0, -1.0],
                log_probs: vec![0.1, 0.2, 0.3, 0.1],
                rewards: vec![5.0, 6.0, 7.0, 5.0],
                flags: vec![0; 4],
                last_observations: vec![4.0, 5.0],
                ..header
            };
            assert_eq!(decoded, expected);
        }
    }

    #[test]
    fn transitions_that_cannot_be_repeated_are_refused() {
        let ended = Fragment { flags: vec![0, crate::fragment::TERMINATED, 0], ..three_transitions() };
        assert!(PreparedTransitions::new(&ended, Precision::F32).unwrap_err().to_string().contains("flags"));
        let long = Fragment { steps: 3, envs: 1, last_observations: vec![4.0], ..three_transitions() };
        assert!(PreparedTransitions::new(&long, Precision::F32).unwrap_err().to_string().contains("steps"));
        let prepared = PreparedTransitions::new(&three_transitions(), Precision::F32).unwrap();
        for (steps, envs) in [(0, 1), (1, 0), (limits::STEPS_MAX + 1, 1), (limits::STEPS_MAX, limits::ENVS_MAX)] {
            assert!(prepared.encode(&Fragment { steps, envs, ..Fragment::default() }).is_err());
        }
    }

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
