//! Policy bundles of the learner and their announcements.

use bytes::{Buf, Bytes};
use prost::Message;

use crate::{
    ActorState, Malformed, PolicyVersion, check_range, check_size,
    ident::check_ident,
    limits::{BUNDLE_BYTES_MAX, CURRICULUM_MAX, HIDDEN_LAYERS_MAX, MODEL_BYTES_MAX, SMALL_BYTES_MAX, WIDTH_MAX},
    mirror,
    pieces::Cursor,
    planes,
    receipt::check_fragment_steps,
    scan, version, wire,
};

/// Kind of message in errors.
const BUNDLE: &str = "policy bundle";

/// Announcement of the newest policy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PolicyAnnouncement {
    /// Newest version.
    pub version: PolicyVersion,
    /// Checksum of the weights.
    pub checksum: u64,
    /// Checksum of the weights that actors get.
    pub actor_checksum: u64,
}

impl PolicyAnnouncement {
    /// Encodes as protobuf.
    pub fn encode(&self) -> Vec<u8> {
        let Self { version, checksum, actor_checksum } = *self;
        wire::PolicyAnnouncement { version: Some(version), checksum, actor_checksum }.encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, Malformed> {
        check_size("announcement", bytes.len(), SMALL_BYTES_MAX)?;
        let message = wire::PolicyAnnouncement::decode(bytes).map_err(Malformed::undecodable("announcement"))?;
        let wire::PolicyAnnouncement { checksum, actor_checksum, .. } = message;
        Ok(Self { version: version::required(message.version)?, checksum, actor_checksum })
    }

    /// Returns whether `bundle` is of another version or has the announced weights, with or without the critic.
    #[must_use]
    pub fn agrees_with(&self, bundle: &PolicyBundle) -> bool {
        !self.version.names_same_policy(bundle.version)
            || [self.checksum, self.actor_checksum].contains(&bundle.checksum)
    }
}

/// Policy with everything else that an actor needs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolicyBundle {
    /// Name of the run.
    pub run: String,
    /// Version of the policy.
    pub version: PolicyVersion,
    /// Entries of one observation.
    pub observation_size: u32,
    /// Entries of one action.
    pub action_size: u32,
    /// Widths of the hidden layers.
    pub hidden: Vec<u32>,
    /// A safetensors file.
    pub weights: Bytes,
    /// Mean of each observation entry.
    pub observation_mean: Vec<f32>,
    /// Inverse standard deviation of each observation entry.
    pub observation_inverse_std: Vec<f32>,
    /// Bound of normalised observations.
    pub observation_clip: f32,
    /// Hash over configuration and model.
    pub config_hash: u64,
    /// Configuration of the run as TOML.
    pub config_toml: String,
    /// Humanoid as MJCF.
    pub model_xml: String,
    /// Checksum of `weights`.
    pub checksum: u64,
    /// State of the run's only actor at the last checkpoint; present only right after a resume of a deterministic run.
    pub actor_state: Option<ActorState>,
    /// Control steps of a fragment of an actor that has no receipt yet; 0 means `rollout.fragment_steps`.
    pub fragment_steps: u32,
    /// Wire version of the learner; 0 if unknown.
    pub wire_version: u32,
    /// Smallest [`WIRE_VERSION`](crate::WIRE_VERSION) of actors that know every key which this run sets; 0 admits all.
    pub wire_version_min: u32,
    /// Version of the physics that this run trains with; 0 in runs of external tasks, which have none.
    pub physics_version: u32,
    /// Last entries of an observation that only the critic sees.
    pub privileged_size: u32,
    /// Mirror image of an observation: for each entry the number of the original entry from 1, negative if the sign
    /// changes; empty if the networks have none.
    pub observation_mirror: Vec<i32>,
    /// Mirror image of an action.
    pub action_mirror: Vec<i32>,
    /// Kinds of ground of the last episodes, and their levels: what new environments draw their own from.
    pub curriculum_kinds: Vec<u32>,
    /// Level for each of the kinds.
    pub curriculum_levels: Vec<u32>,
    /// Factors on the ranges of commands of the last episodes.
    pub curriculum_factors: Vec<f32>,
    /// Control steps, counted over all motions, at which the last episodes failed to imitate them.
    pub curriculum_failures: Vec<u32>,
}

impl PolicyBundle {
    fn check(&self) -> Result<(), Malformed> {
        check_ident("run", &self.run)?;
        check_range("observation_size", self.observation_size, WIDTH_MAX)?;
        check_range("action_size", self.action_size, WIDTH_MAX)?;
        if self.privileged_size >= self.observation_size {
            let expected = format!("less than observation_size, which is {}", self.observation_size);
            return Err(Malformed::field("privileged_size", self.privileged_size, expected));
        }
        if self.hidden.is_empty() || self.hidden.len() > HIDDEN_LAYERS_MAX {
            return Err(Malformed::field("hidden", self.hidden.len(), format!("1 to {HIDDEN_LAYERS_MAX} layers")));
        }
        self.hidden.iter().try_for_each(|width| check_range("hidden", *width, WIDTH_MAX))?;
        if self.model_xml.len() > MODEL_BYTES_MAX {
            let found = format!("{} bytes long", self.model_xml.len());
            return Err(Malformed::field("model_xml", found, format!("at most {MODEL_BYTES_MAX}")));
        }
        let size = self.observation_size as usize;
        for (field, plane) in
            [("observation_mean", &self.observation_mean), ("observation_inverse_std", &self.observation_inverse_std)]
        {
            if plane.len() != size {
                return Err(Malformed::length(field, plane.len(), size.to_string()));
            }
            planes::check_finite(field, plane)?;
        }
        for (field, mirror, size) in [
            ("observation_mirror", &self.observation_mirror, size),
            ("action_mirror", &self.action_mirror, self.action_size as usize),
        ] {
            mirror::check(field, mirror, size)?;
        }
        if !(self.observation_clip.is_finite() && self.observation_clip > 0.0) {
            return Err(Malformed::field("observation_clip", self.observation_clip, "a number above 0"));
        }
        check_fragment_steps(self.fragment_steps)?;
        let (kinds, levels) = (self.curriculum_kinds.len(), self.curriculum_levels.len());
        if levels != kinds {
            return Err(Malformed::length("curriculum_levels", levels, format!("{kinds}, one for each kind")));
        }
        for (field, count) in [
            ("curriculum_kinds", kinds),
            ("curriculum_factors", self.curriculum_factors.len()),
            ("curriculum_failures", self.curriculum_failures.len()),
        ] {
            if count > CURRICULUM_MAX {
                return Err(Malformed::field(field, count, format!("at most {CURRICULUM_MAX} numbers")));
            }
        }
        planes::check_finite("curriculum_factors", &self.curriculum_factors)?;
        self.actor_state.as_ref().map_or(Ok(()), ActorState::check)
    }

    /// Returns the bundle without configuration, model and state of an actor, for actors that have the same configuration.
    #[must_use]
    pub fn without_config(&self) -> Self {
        Self {
            config_toml: String::new(),
            model_xml: String::new(),
            actor_state: None,
            curriculum_kinds: Vec::new(),
            curriculum_levels: Vec::new(),
            curriculum_factors: Vec::new(),
            curriculum_failures: Vec::new(),
            ..self.clone()
        }
    }

    /// Encodes as protobuf.
    pub fn encode(&self) -> Result<Vec<u8>, Malformed> {
        self.check()?;
        let message = message!(
            wire::PolicyBundle,
            clone self [run, observation_size, action_size, hidden, weights, observation_clip, config_hash, config_toml,
                model_xml, checksum, actor_state, fragment_steps, wire_version, wire_version_min, physics_version,
                privileged_size, observation_mirror, action_mirror, curriculum_kinds, curriculum_levels,
                curriculum_factors, curriculum_failures],
            {
                version: Some(self.version),
                observation_mean: planes::to_bytes(&self.observation_mean),
                observation_inverse_std: planes::to_bytes(&self.observation_inverse_std),
            }
        );
        let bytes = message.encode_to_vec();
        check_size(BUNDLE, bytes.len(), BUNDLE_BYTES_MAX)?;
        Ok(bytes)
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: impl Into<Bytes>) -> Result<Self, Malformed> {
        let bytes = bytes.into();
        check_size(BUNDLE, bytes.len(), BUNDLE_BYTES_MAX)?;
        check_counts(&bytes)?;
        let message = wire::PolicyBundle::decode(bytes).map_err(Malformed::undecodable(BUNDLE))?;
        check_range("observation_size", message.observation_size, WIDTH_MAX)?;
        let size = message.observation_size as usize;
        let plane = |field, bytes: &Bytes| planes::from_bytes(field, bytes, size);
        let bundle = message!(
            Self,
            message [run, observation_size, action_size, hidden, weights, observation_clip, config_hash, config_toml,
                model_xml, checksum, actor_state, fragment_steps, wire_version, wire_version_min, physics_version,
                privileged_size, observation_mirror, action_mirror, curriculum_kinds, curriculum_levels,
                curriculum_factors, curriculum_failures],
            {
                version: version::required(message.version)?,
                observation_mean: plane("observation_mean", &message.observation_mean)?,
                observation_inverse_std: plane("observation_inverse_std", &message.observation_inverse_std)?,
            }
        );
        bundle.check()?;
        Ok(bundle)
    }
}

/// Checks the lengths of lists of integers before decoding, because one encoded byte becomes four.
fn check_counts(bytes: &[u8]) -> Result<(), Malformed> {
    let mut lists = [
        (5, "hidden", HIDDEN_LAYERS_MAX, 0),
        (20, "observation_mirror", WIDTH_MAX as usize, 0),
        (21, "action_mirror", WIDTH_MAX as usize, 0),
        (22, "curriculum_kinds", CURRICULUM_MAX, 0),
        (23, "curriculum_levels", CURRICULUM_MAX, 0),
        // Four bytes each.
        (24, "curriculum_factors", CURRICULUM_MAX, 0),
        (25, "curriculum_failures", CURRICULUM_MAX, 0),
    ];
    scan::all(BUNDLE, Cursor::whole(bytes), |field| {
        if let Some((_, _, _, size)) = lists.iter_mut().find(|(number, ..)| *number == field.number) {
            // Packed, or one field each.
            *size += field.bytes.map_or(1, |packed| packed.remaining().max(1));
        }
    })?;
    // An integer takes at most five bytes.
    match lists.into_iter().find(|(_, _, most, size)| *size > 5 * most) {
        Some((_, field, most, size)) => {
            Err(Malformed::field(field, format!("{size} bytes long"), format!("at most {most} numbers")))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> PolicyBundle {
        PolicyBundle {
            run: "walk".into(),
            version: PolicyVersion::new(1, 2),
            observation_size: 2,
            action_size: 1,
            hidden: vec![4],
            weights: Bytes::from_static(b"weights"),
            observation_mean: vec![0.5, 1.0],
            observation_inverse_std: vec![1.0, 2.0],
            observation_clip: 10.0,
            config_hash: 3,
            config_toml: "[run]".into(),
            model_xml: "<mujoco/>".into(),
            checksum: 5,
            actor_state: Some(crate::actor_state::tests::sample("a", 2)),
            fragment_steps: 64,
            wire_version: 2,
            wire_version_min: 1,
            physics_version: 3,
            privileged_size: 1,
            observation_mirror: vec![1, -2],
            action_mirror: vec![-1],
            curriculum_kinds: vec![0, 2],
            curriculum_levels: vec![7, 300],
            curriculum_factors: vec![0.5],
            curriculum_failures: vec![400_000],
        }
    }

    #[test]
    fn bundle_and_announcement_round_trip() {
        assert_eq!(PolicyBundle::decode(sample().encode().unwrap()).unwrap(), sample());
        let announcement = PolicyAnnouncement { version: sample().version, checksum: 5, actor_checksum: 6 };
        assert_eq!(PolicyAnnouncement::decode(&announcement.encode()).unwrap(), announcement);
    }

    #[test]
    fn an_epoch_travels_but_does_not_identify_a_policy() {
        let version = PolicyVersion { epoch: 9, ..sample().version };
        let announcement = PolicyAnnouncement { version, checksum: 5, actor_checksum: 6 };
        assert_eq!(PolicyAnnouncement::decode(&announcement.encode()).unwrap().version.epoch, 9);
        assert!(version != sample().version && version.names_same_policy(sample().version));
        for other in [PolicyVersion::new(8, version.number), PolicyVersion::new(version.incarnation, 8)] {
            assert!(!version.names_same_policy(PolicyVersion { epoch: 9, ..other }));
        }
    }

    #[test]
    fn an_announcement_agrees_with_the_announced_weights_only() {
        let announced = |version, checksum, actor_checksum| PolicyAnnouncement { version, checksum, actor_checksum };
        let (version, other) = (sample().version, PolicyVersion::new(1, 3));
        assert!(announced(version, 5, 6).agrees_with(&sample()), "weights with the critic");
        assert!(announced(version, 4, 5).agrees_with(&sample()), "weights without the critic");
        assert!(!announced(version, 4, 6).agrees_with(&sample()));
        assert!(announced(other, 4, 6).agrees_with(&sample()), "another version");
    }

    #[test]
    fn a_bundle_without_configuration_keeps_the_policy() {
        let short = sample().without_config();
        assert_eq!((short.config_toml.len(), short.model_xml.len(), &short.actor_state), (0, 0, &None));
        let whole = sample();
        let restored = PolicyBundle {
            config_toml: whole.config_toml.clone(),
            model_xml: whole.model_xml.clone(),
            actor_state: whole.actor_state.clone(),
            curriculum_kinds: whole.curriculum_kinds.clone(),
            curriculum_levels: whole.curriculum_levels.clone(),
            curriculum_factors: whole.curriculum_factors.clone(),
            curriculum_failures: whole.curriculum_failures.clone(),
            ..PolicyBundle::decode(short.encode().unwrap()).unwrap()
        };
        assert_eq!(restored, whole);
    }

    #[test]
    fn the_error_names_the_bad_field() {
        let bad = PolicyBundle { observation_mean: vec![1.0], ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("observation_mean"));
        let bad = PolicyBundle { observation_inverse_std: vec![1.0, f32::NAN], ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("index 1"));
        let bad = PolicyBundle { hidden: vec![], ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("hidden"));
        let bad = PolicyBundle { curriculum_levels: vec![1], ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("curriculum_levels"));
        let many = vec![1; CURRICULUM_MAX + 1];
        let bad = PolicyBundle { curriculum_kinds: many.clone(), curriculum_levels: many, ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("curriculum_kinds"));
        let bad = PolicyBundle { curriculum_failures: vec![1; CURRICULUM_MAX + 1], ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("curriculum_failures"));
        let bad = PolicyBundle { curriculum_factors: vec![f32::NAN], ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("curriculum_factors"));
        let mut bad = sample();
        bad.actor_state.as_mut().unwrap().streams.pop();
        assert!(bad.encode().unwrap_err().to_string().contains("actor_state.streams"));
        let bad = PolicyBundle { model_xml: " ".repeat(MODEL_BYTES_MAX + 1), ..sample() };
        assert!(bad.encode().unwrap_err().to_string().contains("model_xml"));
    }
}
