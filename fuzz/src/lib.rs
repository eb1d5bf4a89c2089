//! What strangers could send, tried on every decoder.
//!
//! # Layout
//! - Here: one function for each decoder. It takes any bytes, and panics if the decoder does, or if what was decoded is not
//!   the same after it was encoded and decoded once more.
//! - [`samples`]: sound messages of each kind, to begin with.
//! - `fuzz_targets/`: the same functions for `cargo fuzz`, behind the feature `libfuzzer`.
//! - `tests/`: the same functions with changed samples and noise, in `cargo test`, under a limit on memory.

pub mod samples;

use std::{sync::Arc, time::Instant};

use bytes::Bytes;
use sha2::{Digest, Sha256};
use treadmill_bus::admission::Admission;
use treadmill_config::{Config, ConfigSource};
use treadmill_humanoid::Model;
use treadmill_learner::{
    checkpoint::{TrainingState, encoding},
    intake::{ExpectedFragment, FragmentCounts, FragmentValidator, Ledger, Lineage},
};
use treadmill_policy::{exported::ExportedPolicy, from_safetensors, to_safetensors};
use treadmill_proto::{
    ActorStats, EvaluationReport, Fragment, PolicyAnnouncement, PolicyBundle, Pose, Receipt,
    fragment::claimed_incarnation,
    json::{EpisodeReport, Metric},
};

/// A decoder under test.
pub type Target = fn(&[u8]);

/// Bytes that a decoder takes.
type Sample = fn() -> Vec<u8>;

/// Every decoder, with a sound message and how many bytes it may allocate for each byte of a message, beside a constant.
pub const TARGETS: &[(&str, Target, Sample, usize)] = &[
    ("fragment", fragment, samples::fragment, 16),
    ("actor_state", actor_state, samples::actor_state, 16),
    ("bundle", bundle, samples::bundle, 16),
    ("announcement", announcement, samples::announcement, 16),
    ("receipt", receipt, samples::receipt, 16),
    ("stats", stats, samples::stats, 16),
    ("evaluation", evaluation, samples::evaluation, 16),
    ("pose", pose, samples::pose, 16),
    ("json", json, samples::metric, 16),
    ("checkpoint", checkpoint, samples::checkpoint, 16),
    ("exported", exported, samples::exported, 64),
    ("weights", weights, samples::weights, 64),
    ("model", model, samples::model, 256),
    ("config", config, samples::config, 256),
    ("fragment_validator", fragment_validator, samples::fragment, 16),
];

/// A rollout fragment.
pub fn fragment(data: &[u8]) {
    let claimed = claimed_incarnation(data);
    let decoded = Fragment::decode(data);
    let (front, back) = data.split_at(data.len() / 3);
    assert_eq!(Fragment::decode_pieces(&[front, back]), decoded, "it does not matter in how many pieces it came");
    if let Ok(fragment) = decoded {
        assert!(claimed.is_none_or(|claimed| claimed == fragment.actor_incarnation) || has_two_incarnations(data));
        let again = fragment.encode().expect("what was decoded can be encoded");
        assert_eq!(claimed_incarnation(&again).unwrap_or(0), fragment.actor_incarnation);
        assert_eq!(Fragment::decode(again).expect("what was encoded can be decoded"), fragment);
    }
}

/// A sender may write a field twice; the last one counts, but admission reads the first.
fn has_two_incarnations(data: &[u8]) -> bool {
    data.iter().filter(|byte| **byte == 0x18).count() >= 2
}

/// The state of an actor, which travels in fragments.
pub fn actor_state(data: &[u8]) {
    let mut message = samples::fragment_without_state();
    message.extend([0x9a, 0x01]);
    let mut length = data.len();
    while length >= 0x80 {
        message.push(length as u8 | 0x80);
        length >>= 7;
    }
    message.push(length as u8);
    message.extend(data);
    fragment(&message);
}

/// A policy bundle.
pub fn bundle(data: &[u8]) {
    if let Ok(bundle) = PolicyBundle::decode(Bytes::copy_from_slice(data)) {
        let again = bundle.encode().expect("what was decoded can be encoded");
        assert_eq!(PolicyBundle::decode(again).expect("what was encoded can be decoded"), bundle);
    }
}

/// An announcement.
pub fn announcement(data: &[u8]) {
    if let Ok(announcement) = PolicyAnnouncement::decode(data) {
        assert_eq!(PolicyAnnouncement::decode(&announcement.encode()), Ok(announcement));
    }
}

/// A receipt.
pub fn receipt(data: &[u8]) {
    if let Ok(receipt) = Receipt::decode(data) {
        assert_eq!(Receipt::decode(&receipt.encode()), Ok(receipt));
    }
}

/// Statistics of an actor.
pub fn stats(data: &[u8]) {
    if let Ok(stats) = ActorStats::decode_checked(data) {
        assert_eq!(ActorStats::decode_checked(&stats.to_bytes()), Ok(stats));
    }
}

/// A report of an evaluation.
pub fn evaluation(data: &[u8]) {
    if let Ok(report) = EvaluationReport::decode(data) {
        assert_eq!(EvaluationReport::decode(&report.encode()), Ok(report));
    }
}

/// How a body stands.
pub fn pose(data: &[u8]) {
    if let Ok(pose) = Pose::decode_checked(data) {
        let again = pose.to_bytes().expect("what was decoded can be encoded");
        assert_eq!(Pose::decode_checked(&again), Ok(pose));
    }
}

/// The objects on the JSON topics.
pub fn json(data: &[u8]) {
    if let Ok(metric) = Metric::from_json(data) {
        assert_eq!(Metric::from_json(&metric.to_json()), Ok(metric));
    }
    if let Ok(report) = EpisodeReport::from_json(data) {
        assert_eq!(EpisodeReport::from_json(&report.to_json()), Ok(report));
    }
}

/// A checkpoint: the file, and its content in a file that is otherwise sound, which no chance would bring about.
pub fn checkpoint(data: &[u8]) {
    let mut wrapped = encoding::encode(&()).expect("nothing is easily encoded");
    wrapped.truncate(12);
    wrapped.extend((data.len() as u64).to_le_bytes());
    wrapped.extend(Sha256::digest(data));
    wrapped.extend(data);
    for bytes in [data, &wrapped] {
        let Ok(state) = encoding::decode::<TrainingState>("a file", bytes) else { continue };
        if state.check().is_ok() {
            drop(state.bundle());
        }
        let again = encoding::encode(&state).expect("what was decoded can be encoded");
        // Numbers that are no numbers are equal to nothing, so bytes are compared.
        let read: TrainingState = encoding::decode("a file", &again).expect("what was encoded can be decoded");
        assert_eq!(encoding::encode(&read).expect("as before"), again);
    }
}

/// An exported policy.
pub fn exported(data: &[u8]) {
    if let Ok(policy) = ExportedPolicy::from_bytes(data) {
        let again = policy.to_bytes().expect("what was decoded can be encoded");
        assert_eq!(ExportedPolicy::from_bytes(&again).expect("what was encoded can be decoded"), policy);
    }
}

/// The weights in a policy bundle.
pub fn weights(data: &[u8]) {
    let shape = samples::shape();
    if let Ok(parameters) = from_safetensors(data, &shape) {
        let again = to_safetensors(&shape, &parameters);
        assert_eq!(from_safetensors(&again, &shape).expect("what was encoded can be decoded"), parameters);
    }
}

/// A robot as MJCF text.
pub fn model(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data) {
        drop(Model::from_mjcf(text));
    }
}

/// A configuration as TOML text.
pub fn config(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Ok(config) = read_config(text) {
        assert_eq!(read_config(&config.to_toml()).expect("what was written can be read"), config);
    }
}

fn read_config(text: &str) -> Result<Config, String> {
    let mut source = ConfigSource::default();
    source.text(text, "a text").map_err(|why| why.to_string())?;
    source.build().map_err(|why| why.to_string())
}

/// The learner's validation of a fragment.
pub fn fragment_validator(data: &[u8]) {
    let expected = ExpectedFragment {
        run: samples::RUN.into(),
        config_hash: samples::CONFIG_HASH,
        observation_size: samples::WIDTH,
        action_size: 1,
        max_policy_lag: 1,
    };
    let admission = Arc::new(Admission::new(8, 64));
    let mut validator = FragmentValidator::new(expected, admission, Ledger::default(), FragmentCounts::default());
    let mut lineage = Lineage::new(samples::INCARNATION);
    lineage.advance();
    let now = Instant::now();
    for _ in 0..2 {
        let validated = validator.validate(samples::ACTOR, data.into(), &lineage, now);
        if let Err(receipt) = &validated {
            assert_eq!(Receipt::decode(&receipt.encode()).as_ref(), Ok(&**receipt), "its sender can read the answer");
        }
    }
    assert!(validator.counts.accepted <= 1, "nothing is learnt from twice");
    let counts = validator.counts;
    assert_eq!(
        counts.accepted + counts.duplicate + counts.too_old + counts.vanished + counts.malformed,
        2,
        "{counts:?}"
    );
}
