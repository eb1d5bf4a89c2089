//! Rollout fragments: T control steps of N environments under one policy version.

use bytes::{Buf, BufMut, Bytes};
use prost::Message;

use crate::{
    ActorState, Malformed, PolicyVersion, Precision, check_range, check_size,
    ident::check_ident,
    limits::{ENVS_MAX, FRAGMENT_BYTES_MAX, GROUND_KINDS_MAX, SEQUENCE_MAX, STEPS_MAX, WIDTH_MAX},
    pieces::Cursor,
    planes,
    reward_term::{self, RewardTerm},
    scan, version, wire,
};

/// Flag bit of a transition that ended the episode by a rule of the task.
pub const TERMINATED: u8 = 1;
/// Flag bit of a transition that ended the episode by the time limit.
pub const TRUNCATED: u8 = 2;

/// Cause of an episode's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndCause {
    /// The torso left its healthy range of height.
    Fell,
    /// The episode reached its maximum length.
    TimeLimit,
    /// The physics produced an infinite or NaN number.
    NonFinite,
    /// A rule of an external task ended the episode.
    Terminated,
}

impl EndCause {
    /// Returns the name used in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fell => "fell",
            Self::TimeLimit => "time_limit",
            Self::NonFinite => "non_finite",
            Self::Terminated => "terminated",
        }
    }
}

/// Finished episode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Episode {
    /// Sum of unscaled rewards.
    pub return_sum: f64,
    /// Control steps.
    pub length: u32,
    /// Forward distance between start and end (m).
    pub distance_m: f64,
    /// Distance over time (m/s).
    pub velocity_mean_mps: f64,
    /// Cause of the end.
    pub cause: EndCause,
    /// Kind of the ground, below 64; `None` where the task has no kinds.
    pub ground_kind: Option<u32>,
    /// Level of the ground's difficulty, from 0; `None` where the task has no levels.
    pub ground_level: Option<f64>,
    /// Factor on the ranges of commands; `None` where the task has no such curriculum.
    pub command_factor: Option<f64>,
    /// Control step, counted over all motions, at which it failed to imitate them; `None` otherwise.
    pub failed_step: Option<u32>,
}

/// Rollout fragment. Planes are time-major: entry `[t][n][i]` is at `((t * N) + n) * width + i`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fragment {
    /// Name of the run.
    pub run: String,
    /// Name of the actor.
    pub actor: String,
    /// Process of that name.
    pub actor_incarnation: u64,
    /// Number of the fragment within this incarnation, from 1.
    pub sequence: u64,
    /// Version of the policy that chose the actions.
    pub version: PolicyVersion,
    /// Hash over configuration and model.
    pub config_hash: u64,
    /// T.
    pub steps: u32,
    /// N.
    pub envs: u32,
    /// Entries of one observation.
    pub observation_size: u32,
    /// Entries of one action.
    pub action_size: u32,
    /// `[T][N][observation_size]`, before normalisation.
    pub observations: Vec<f32>,
    /// `[T][N][action_size]`, before clipping, in units of the action range.
    pub actions: Vec<f32>,
    /// `[T][N]`, log-probabilities of the unclipped actions.
    pub log_probs: Vec<f32>,
    /// `[T][N]`, unscaled.
    pub rewards: Vec<f32>,
    /// `[T][N]`, bits [`TERMINATED`] and [`TRUNCATED`].
    pub flags: Vec<u8>,
    /// `[K][observation_size]`; [`Fragment::needs_last_observation`] selects them.
    pub last_observations: Vec<f32>,
    /// Episodes that ended in this fragment.
    pub episodes: Vec<Episode>,
    /// Sequence number up to which all fragments are durable or dropped; the sender will not send them again.
    pub settled_through: u64,
    /// State of the actor after this fragment; only in deterministic runs.
    pub actor_state: Option<ActorState>,
    /// Environment steps that this incarnation has simulated, including this fragment; 0 if it does not count them.
    pub env_steps: u64,
    /// Seconds that the sender simulated this fragment, without waits; 0 if it does not measure them.
    pub collect_s: f64,
    /// Wire version of the sender; 0 if unknown.
    pub wire_version: u32,
    /// Version of the physics that the sender simulates; 0 in runs of external tasks, which have none.
    pub physics_version: u32,
    /// Terms of the reward, as means over the transitions; empty if the task names none.
    pub reward_terms: Vec<RewardTerm>,
}

impl Fragment {
    /// Returns the number of transitions, T × N.
    pub fn transitions(&self) -> usize {
        self.steps as usize * self.envs as usize
    }

    /// Returns whether step `t` of an environment with these flags carries its true last observation: at truncations, and
    /// at the fragment's end unless the episode terminated.
    pub fn needs_last_observation(flags: u8, t: u32, steps: u32) -> bool {
        flags & TRUNCATED != 0 || (t + 1 == steps && flags & TERMINATED == 0)
    }

    fn last_observation_count(&self) -> usize {
        let envs = self.envs as usize;
        self.flags
            .iter()
            .enumerate()
            .filter(|(index, flags)| Self::needs_last_observation(**flags, (index / envs) as u32, self.steps))
            .count()
    }

    /// Checks shapes, ranges and numbers, before encoding and after decoding.
    pub fn check(&self) -> Result<(), Malformed> {
        check_ident("run", &self.run)?;
        check_ident("actor", &self.actor)?;
        check_range("steps", self.steps, STEPS_MAX)?;
        check_range("envs", self.envs, ENVS_MAX)?;
        check_range("observation_size", self.observation_size, WIDTH_MAX)?;
        check_range("action_size", self.action_size, WIDTH_MAX)?;
        if !(1..=SEQUENCE_MAX).contains(&self.sequence) {
            return Err(Malformed::field("sequence", self.sequence, format!("1 to {SEQUENCE_MAX}")));
        }
        if self.settled_through >= self.sequence {
            return Err(Malformed::field("settled_through", self.settled_through, "below the fragment's own sequence"));
        }
        if let Some(state) = &self.actor_state {
            self.check_state(state)?;
        }
        let rows = self.transitions();
        if !(self.env_steps == 0 || (rows as u64..=SEQUENCE_MAX).contains(&self.env_steps)) {
            let expected = format!("0, or at least the fragment's own {rows} transitions and at most {SEQUENCE_MAX}");
            return Err(Malformed::field("env_steps", self.env_steps, expected));
        }
        if !(self.collect_s.is_finite() && self.collect_s >= 0.0) {
            return Err(Malformed::field("collect_s", self.collect_s, "0 or more"));
        }
        reward_term::check(&self.reward_terms)?;
        check_plane("observations", &self.observations, rows * self.observation_size as usize)?;
        check_plane("actions", &self.actions, rows * self.action_size as usize)?;
        check_plane("log_probs", &self.log_probs, rows)?;
        check_plane("rewards", &self.rewards, rows)?;
        check_flags(&self.flags, rows)?;
        let last_count = self.last_observation_count() * self.observation_size as usize;
        check_plane("last_observations", &self.last_observations, last_count)?;
        if self.episodes.len() > rows {
            return Err(Malformed::field("episodes", self.episodes.len(), format!("at most {rows}")));
        }
        for (index, episode) in self.episodes.iter().enumerate() {
            let difficulty = episode.ground_level.unwrap_or(0.0) + episode.command_factor.unwrap_or(0.0);
            let sum = episode.return_sum + episode.distance_m + episode.velocity_mean_mps + difficulty;
            if episode.ground_kind.is_some_and(|kind| kind >= GROUND_KINDS_MAX) {
                let found = format!("{:?} at index {index}", episode.ground_kind);
                return Err(Malformed::field("episodes.ground_kind", found, format!("less than {GROUND_KINDS_MAX}")));
            }
            if !sum.is_finite() {
                return Err(Malformed::NotFinite { field: "episodes", index, value: format!("{episode:?}") });
            }
        }
        Ok(())
    }

    fn check_state(&self, state: &ActorState) -> Result<(), Malformed> {
        state.check()?;
        if state.actor != self.actor {
            let wanted = format!("`{}`, as the fragment says", self.actor);
            return Err(Malformed::field("actor_state.actor", format!("`{}`", state.actor), wanted));
        }
        let (found, wanted) = (state.observations.len(), self.envs as usize * self.observation_size as usize);
        if (state.envs(), found) != (self.envs as usize, wanted) {
            let found = format!("of {} environments and {found} numbers", state.envs());
            return Err(Malformed::field("actor_state.observations", found, format!("{} and {wanted}", self.envs)));
        }
        Ok(())
    }

    /// Encodes as protobuf with observations in single precision.
    pub fn encode(&self) -> Result<Vec<u8>, Malformed> {
        self.encode_as(Precision::F32)
    }

    /// Encodes as protobuf; the observations must already be rounded to `precision`.
    pub fn encode_as(&self, precision: Precision) -> Result<Vec<u8>, Malformed> {
        self.check()?;
        let message = message!(
            wire::Fragment,
            clone self [run, actor, actor_incarnation, sequence, config_hash, steps, envs, observation_size, action_size,
                settled_through, actor_state, env_steps, collect_s, wire_version, physics_version, reward_terms],
            {
                version: Some(self.version),
                observations: precision.to_bytes("observations", &self.observations)?,
                actions: planes::to_bytes(&self.actions),
                log_probs: planes::to_bytes(&self.log_probs),
                rewards: planes::to_bytes(&self.rewards),
                flags: Bytes::copy_from_slice(&self.flags),
                last_observations: precision.to_bytes("last_observations", &self.last_observations)?,
                episodes: self.episodes.iter().map(Into::into).collect(),
                observation_precision: wire::Precision::from(precision).into(),
            }
        );
        let bytes = message.encode_to_vec();
        check_size("fragment", bytes.len(), FRAGMENT_BYTES_MAX)?;
        Ok(bytes)
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: impl AsRef<[u8]>) -> Result<Self, Malformed> {
        Self::decode_pieces(&[bytes.as_ref()])
    }

    /// Decodes and checks untrusted bytes in several pieces, without joining them.
    pub fn decode_pieces(pieces: &[&[u8]]) -> Result<Self, Malformed> {
        let bytes = Cursor::new(pieces);
        check_size("fragment", bytes.remaining(), FRAGMENT_BYTES_MAX)?;
        let Parts { planes: [observations, actions, log_probs, rewards, last_observations], others } =
            Parts::of(bytes)?;
        let message = wire::Fragment::decode(Bytes::from(others)).map_err(Malformed::undecodable("fragment"))?;
        check_range("steps", message.steps, STEPS_MAX)?;
        check_range("envs", message.envs, ENVS_MAX)?;
        check_range("observation_size", message.observation_size, WIDTH_MAX)?;
        check_range("action_size", message.action_size, WIDTH_MAX)?;
        let rows = message.steps as usize * message.envs as usize;
        let (width, action) = (message.observation_size as usize, message.action_size as usize);
        let precision = Precision::try_from(message.observation_precision)?;
        // `check` compares this number with the flags.
        let last_count = last_observations.remaining() / precision.bytes();
        let fragment = message!(
            Self,
            message [run, actor, actor_incarnation, sequence, config_hash, steps, envs, observation_size, action_size,
                settled_through, actor_state, env_steps, collect_s, wire_version, physics_version, reward_terms],
            {
                version: version::required(message.version)?,
                observations: precision.read("observations", observations, rows * width)?,
                actions: planes::read("actions", actions, rows * action)?,
                log_probs: planes::read("log_probs", log_probs, rows)?,
                rewards: planes::read("rewards", rewards, rows)?,
                last_observations: precision.read("last_observations", last_observations, last_count)?,
                flags: message.flags.to_vec(),
                episodes: message.episodes.iter().map(Episode::try_from).collect::<Result<_, _>>()?,
            }
        );
        fragment.check()?;
        Ok(fragment)
    }
}

/// Reads the unverified incarnation from the first bytes of an encoded fragment; returns `None` if they do not hold it.
pub fn claimed_incarnation(beginning: &[u8]) -> Option<u64> {
    scan::leading(beginning).find(|field| field.number == INCARNATION_FIELD)?.varint
}

const INCARNATION_FIELD: u32 = 3;
const EPISODES_FIELD: u32 = 17;
const REWARD_TERMS_FIELD: u32 = 25;
/// Observations, actions, log-probabilities, rewards and last observations.
const PLANE_FIELDS: [u32; 5] = [11, 12, 13, 14, 16];
/// Smallest size of one transition: an entry each of observation and action, log-probability, reward and flags.
const TRANSITION_BYTES_MIN: usize = 17;

/// Encoded fragment, split: planes stay in place because they are nearly all of it; other fields are copied.
struct Parts<'a> {
    /// Planes in the order of [`PLANE_FIELDS`].
    planes: [Cursor<'a>; PLANE_FIELDS.len()],
    others: Vec<u8>,
}

impl<'a> Parts<'a> {
    fn of(message: Cursor<'a>) -> Result<Self, Malformed> {
        let mut parts = Self { planes: [Cursor::whole(&[]); _], others: Vec::new() };
        let (mut episodes, mut reward_terms) = (0, 0);
        scan::all("fragment", message, |field| {
            episodes += usize::from(field.number == EPISODES_FIELD);
            reward_terms += usize::from(field.number == REWARD_TERMS_FIELD);
            match (PLANE_FIELDS.iter().position(|plane| *plane == field.number), field.bytes) {
                // If a field occurs twice, protobuf uses the later one.
                (Some(plane), Some(bytes)) => parts.planes[plane] = bytes,
                _ => parts.others.put(field.encoded),
            }
        })?;
        reward_term::check_count(reward_terms)?;
        // An episode has at least one transition, and takes far more bytes decoded than encoded.
        let (bytes, most) = (message.remaining(), message.remaining() / TRANSITION_BYTES_MIN);
        if episodes > most {
            return Err(Malformed::field("episodes", episodes, format!("at most {most} in {bytes} bytes")));
        }
        Ok(parts)
    }
}

fn check_plane(field: &'static str, numbers: &[f32], count: usize) -> Result<(), Malformed> {
    if numbers.len() != count {
        let expected = format!("{count} numbers, as steps, envs and widths say");
        return Err(Malformed::length(field, numbers.len(), expected));
    }
    planes::check_finite(field, numbers)
}

fn check_flags(flags: &[u8], rows: usize) -> Result<(), Malformed> {
    if flags.len() != rows {
        return Err(Malformed::field("flags", format!("{} bytes long", flags.len()), format!("{rows} bytes")));
    }
    // A transition that is both terminated and truncated has no defined bootstrap.
    match flags.iter().find(|flags| **flags > TRUNCATED) {
        Some(bad) => Err(Malformed::field("flags", bad, "0, 1 (terminated) or 2 (truncated)")),
        None => Ok(()),
    }
}

const CAUSES: [(EndCause, wire::EndCause); 4] = [
    (EndCause::Fell, wire::EndCause::Fell),
    (EndCause::TimeLimit, wire::EndCause::TimeLimit),
    (EndCause::NonFinite, wire::EndCause::NonFinite),
    (EndCause::Terminated, wire::EndCause::Terminated),
];

impl From<&Episode> for wire::Episode {
    fn from(episode: &Episode) -> Self {
        let cause = CAUSES.iter().find(|(ours, _)| *ours == episode.cause).map(|(_, wire)| *wire);
        message!(
            Self,
            episode [return_sum, length, distance_m, velocity_mean_mps, ground_kind, ground_level, command_factor,
                failed_step],
            { cause: cause.unwrap_or_default().into() }
        )
    }
}

impl TryFrom<&wire::Episode> for Episode {
    type Error = Malformed;

    fn try_from(episode: &wire::Episode) -> Result<Self, Malformed> {
        let cause = CAUSES.iter().find(|(_, wire)| *wire as i32 == episode.cause).map(|(ours, _)| *ours);
        let cause = cause.ok_or_else(|| Malformed::field("episodes.cause", episode.cause, "1 to 4"))?;
        Ok(message!(
            Self,
            episode [return_sum, length, distance_m, velocity_mean_mps, ground_kind, ground_level, command_factor,
                failed_step],
            { cause: cause }
        ))
    }
}

#[cfg(test)]
#[path = "fragment_tests.rs"]
pub(crate) mod tests;
