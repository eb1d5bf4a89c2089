//! State of an actor at a fragment's end, from which a deterministic run resumes.

use prost::Message;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use crate::{
    Malformed, check_finite, check_size,
    ident::check_ident,
    limits::{ACTOR_STATE_BYTES_MAX, ENVS_MAX, WIDTH_MAX},
    planes,
};

pub use crate::wire::ActorState;

/// Numbers in the state of one random generator.
pub const GENERATOR_NUMBERS: usize = 4;
/// Generators of one environment: sensor noise, motor noise and pushes.
pub const ENVIRONMENT_GENERATORS: usize = 3;
/// Entries of [`ActorState::progress`] for one environment.
pub const PROGRESS_NUMBERS: usize = 3;
/// Largest number of a task's numbers per environment.
const TASK_NUMBERS_MAX: usize = 16 * WIDTH_MAX as usize;
/// Largest number of past action entries per environment.
const PAST_ACTIONS_MAX: usize = 16 * WIDTH_MAX as usize;

impl ActorState {
    /// Returns the number of environments, N.
    pub fn envs(&self) -> usize {
        self.episodes.len()
    }

    /// Returns whether the state is small enough for a message.
    pub fn fits(&self) -> bool {
        self.encoded_len() <= ACTOR_STATE_BYTES_MAX
    }

    /// Checks sizes and numbers, before encoding and after decoding.
    pub fn check(&self) -> Result<(), Malformed> {
        check_ident("actor_state.actor", &self.actor)?;
        check_size("actor state", self.encoded_len(), ACTOR_STATE_BYTES_MAX)?;
        let envs = self.envs();
        if !(1..=ENVS_MAX as usize).contains(&envs) {
            return Err(Malformed::field("actor_state.episodes", envs, format!("1 to {ENVS_MAX} numbers")));
        }
        for (field, found, wanted) in [
            ("actor_state.noise", self.noise.len(), GENERATOR_NUMBERS),
            ("actor_state.lengths", self.lengths.len(), envs),
            ("actor_state.progress", self.progress.len(), envs * PROGRESS_NUMBERS),
            ("actor_state.steps_to_push", self.steps_to_push.len(), envs),
            ("actor_state.streams", self.streams.len(), envs * ENVIRONMENT_GENERATORS * GENERATOR_NUMBERS),
        ] {
            if found != wanted {
                return Err(Malformed::length(field, found, format!("{wanted} numbers")));
            }
        }
        for (field, found, width_max) in [
            ("actor_state.positions", self.positions.len(), WIDTH_MAX as usize),
            ("actor_state.velocities", self.velocities.len(), WIDTH_MAX as usize),
            ("actor_state.observations", self.observations.len(), WIDTH_MAX as usize),
            ("actor_state.past_actions", self.past_actions.len(), PAST_ACTIONS_MAX),
        ] {
            if !found.is_multiple_of(envs) || !(1..=width_max).contains(&(found / envs)) {
                let wanted = format!("1 to {width_max} for each of {envs} environments");
                return Err(Malformed::length(field, found, wanted));
            }
        }
        if !self.task.len().is_multiple_of(envs) || self.task.len() / envs > TASK_NUMBERS_MAX {
            let wanted = format!("at most {TASK_NUMBERS_MAX} for each of {envs} environments");
            return Err(Malformed::length("actor_state.task", self.task.len(), wanted));
        }
        if let Some(index) = self.episodes.iter().position(|begun| *begun == 0) {
            return Err(Malformed::field("actor_state.episodes", format!("0 at index {index}"), "1 or more"));
        }
        check_finite("actor_state.progress", self.progress.iter().copied())?;
        check_finite("actor_state.positions", self.positions.iter().copied())?;
        check_finite("actor_state.velocities", self.velocities.iter().copied())?;
        check_finite("actor_state.task", self.task.iter().copied())?;
        planes::check_finite("actor_state.observations", &self.observations)?;
        planes::check_finite("actor_state.past_actions", &self.past_actions)
    }
}

/// As the bytes of a message, so that checkpoints admit new fields.
impl Serialize for ActorState {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.encode_to_vec().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for ActorState {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::decode(&*Vec::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Returns a state of `envs` environments with two observations each.
    pub(crate) fn sample(actor: &str, envs: usize) -> ActorState {
        ActorState {
            actor: actor.into(),
            start: 1 << 40,
            noise: vec![1, u64::MAX, 3, 4],
            episodes: vec![5; envs],
            lengths: vec![6; envs],
            progress: vec![0.1; 3 * envs],
            positions: vec![1.0 / 3.0; 8 * envs],
            velocities: vec![-0.0; 7 * envs],
            observations: vec![0.5; 2 * envs],
            past_actions: vec![-1.0; 4 * envs],
            steps_to_push: vec![u32::MAX; envs],
            streams: vec![9; 12 * envs],
            task: vec![0.25; envs],
        }
    }

    #[test]
    fn numbers_keep_every_bit_and_their_encoding_is_compact() {
        let state = sample("a", 3);
        state.check().unwrap();
        let bytes = state.encode_to_vec();
        let read = ActorState::decode(&*bytes).unwrap();
        assert_eq!(read, state);
        assert!(read.velocities.iter().all(|number| number.is_sign_negative()));
        // Name and start, 8 × (4 + 3 × (1 + 3 + 8 + 7 + 12 + 1)) + 4 × 3 × (1 + 2 + 4 + 1) bytes, and the tags of the
        // fields.
        assert!((896..946).contains(&bytes.len()), "{}", bytes.len());
    }

    #[test]
    fn the_error_names_the_bad_field() {
        type Corrupt = fn(&mut ActorState);
        let cases: [(&str, Corrupt); 16] = [
            ("actor_state.actor", |s| s.actor = "a/b".into()),
            ("actor_state.noise", |s| s.noise.truncate(1)),
            ("actor_state.episodes", |s| s.episodes.clear()),
            ("0 at index 2", |s| s.episodes[2] = 0),
            ("actor_state.lengths", |s| s.lengths.push(1)),
            ("actor_state.progress", |s| s.progress.truncate(1)),
            ("actor_state.progress` holds NaN at index 4", |s| s.progress[4] = f64::NAN),
            ("actor_state.positions` is 1 numbers long", |s| s.positions.truncate(1)),
            ("actor_state.positions` holds inf", |s| s.positions[0] = f64::INFINITY),
            ("actor_state.velocities", |s| s.velocities.clear()),
            ("actor_state.observations", |s| s.observations[1] = f32::NAN),
            ("actor_state.past_actions", |s| s.past_actions.clear()),
            ("actor_state.steps_to_push", |s| s.steps_to_push.clear()),
            ("actor_state.streams", |s| s.streams.truncate(1)),
            ("actor_state.task` is 1 numbers long", |s| s.task.truncate(1)),
            ("actor_state.task` holds NaN", |s| s.task[2] = f64::NAN),
        ];
        for (part, corrupt) in cases {
            let mut state = sample("a", 3);
            corrupt(&mut state);
            let error = state.check().expect_err(part).to_string();
            assert!(error.contains(part), "{error}");
        }
        let mut large = sample("a", 1);
        large.past_actions = vec![0.0; ACTOR_STATE_BYTES_MAX / 4];
        assert!(!large.fits());
        assert!(large.check().unwrap_err().to_string().contains("actor state has"));
    }
}
