//! Fuzz targets for every decoder of untrusted bytes.
//!
//! # Layout
//! - Here: one function per decoder. It accepts any bytes, and panics if the decoder panics or if a decoded value changes in
//!   a second round trip.
//! - [`robots`]: random robots that must simulate.
//! - [`samples`]: one valid message of each kind.
//! - `fuzz_targets/`: program for `cargo fuzz` that runs one of these functions, behind the feature `libfuzzer`.
//! - `tests/`: these functions in `cargo test`, on random bytes and mutated samples, with a limit on allocated memory.

pub mod robots;
pub mod samples;

use std::{fs::File, io::Read, path::Path, sync::Arc, time::Instant};

use bytes::Bytes;
use flate2::read::GzDecoder;
use tar::Archive;
use treadmill_bus::learner::Admission;
use treadmill_config::{Config, ConfigSource};
use treadmill_experience::{ledger::Ledger, lineage::Lineage};
use treadmill_humanoid::{HUMANOID_XML, Model, Physics, PhysicsSettings, card::RobotCard};
use treadmill_learner::{
    checkpoint::{decode as decode_checkpoint, encoding},
    intake::{ExpectedFragment, FragmentCounts, FragmentValidator},
    leadership::Manifest,
};
use treadmill_policy::{exported::ExportedPolicy, from_safetensors, to_safetensors};
use treadmill_proto::{
    ActorStats, EvaluationReport, Fragment, PolicyAnnouncement, PolicyBundle, PolicyPiece, PolicyRequest, Pose,
    Receipt,
    fragment::claimed_incarnation,
    json::{EpisodeReport, Metric},
};

/// Function that runs one decoder.
pub type Target = fn(&[u8]);

/// Function that returns a valid message.
type Sample = fn() -> Vec<u8>;

/// Every decoder with its name, a valid message, and the bytes that it may allocate per byte of a message, plus a constant.
pub const TARGETS: &[(&str, Target, Sample, usize)] = &[
    ("fragment", fragment, samples::fragment, 16),
    ("actor_state", actor_state, samples::actor_state, 16),
    ("bundle", bundle, samples::bundle, 16),
    ("announcement", announcement, samples::announcement, 16),
    ("policy_request", policy_request, samples::policy_request, 16),
    ("policy_piece", policy_piece, samples::policy_piece, 16),
    ("receipt", receipt, samples::receipt, 16),
    ("manifest", manifest, samples::manifest, 16),
    ("stats", stats, samples::stats, 16),
    ("evaluation", evaluation, samples::evaluation, 16),
    ("pose", pose, samples::pose, 16),
    ("json", json, samples::metric, 16),
    ("checkpoint", checkpoint, samples::checkpoint, 16),
    ("exported", exported, samples::exported, 64),
    ("weights", weights, samples::weights, 64),
    ("model", model, samples::model, 256),
    ("card", card, samples::card, 256),
    ("config", config, samples::config, 256),
    ("fragment_validator", fragment_validator, samples::fragment, 16),
];

/// Returns the inputs in `seeds/TARGET.tar.gz`, which together cover what fuzzing has covered.
///
/// # Panics
/// If they cannot be read.
#[must_use]
pub fn seeds_of(target: &str) -> Vec<Vec<u8>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("seeds/{target}.tar.gz"));
    let mut archive = Archive::new(GzDecoder::new(File::open(path).expect("an archive of seeds")));
    let files = archive.entries().expect("an archive").map(|entry| entry.expect("an entry"));
    let seeds = files.filter(|entry| entry.header().entry_type().is_file()).map(|mut entry| {
        let mut seed = Vec::new();
        entry.read_to_end(&mut seed).expect("a whole file");
        seed
    });
    seeds.collect()
}

/// Decodes a rollout fragment.
pub fn fragment(data: &[u8]) {
    let claimed = claimed_incarnation(data);
    let decoded = Fragment::decode(data);
    let (front, back) = data.split_at(data.len() / 3);
    assert_eq!(Fragment::decode_pieces(&[front, back]), decoded, "the result does not depend on the number of pieces");
    if let Ok(fragment) = decoded {
        assert!(claimed.is_none_or(|claimed| claimed == fragment.actor_incarnation) || has_two_incarnations(data));
        let encoded = fragment.encode().expect("what was decoded can be encoded");
        assert_eq!(claimed_incarnation(&encoded).unwrap_or(0), fragment.actor_incarnation);
        assert_eq!(Fragment::decode(encoded).expect("what was encoded can be decoded"), fragment);
    }
}

/// Returns whether the incarnation may occur twice; the decoder uses the last one, admission control the first.
fn has_two_incarnations(data: &[u8]) -> bool {
    data.iter().filter(|byte| **byte == 0x18).count() >= 2
}

/// Decodes the state of an actor inside a fragment.
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

/// Declares a target that decodes bytes, and encodes and decodes again what it got.
macro_rules! round_trip {
    ($($what:literal $name:ident: $decode:expr, $encode:expr;)*) => {$(
        #[doc = concat!("Decodes ", $what, ".")]
        pub fn $name(data: &[u8]) {
            if let Ok(decoded) = $decode(data) {
                assert_eq!($decode(&$encode(&decoded)[..]), Ok(decoded), "what was encoded can be decoded");
            }
        }
    )*};
}

round_trip! {
    "a policy bundle" bundle: |data| PolicyBundle::decode(Bytes::copy_from_slice(data)),
        |bundle: &PolicyBundle| bundle.encode().expect("what was decoded can be encoded");
    "an announcement" announcement: PolicyAnnouncement::decode, PolicyAnnouncement::encode;
    "a request for a piece of a policy" policy_request: PolicyRequest::decode, PolicyRequest::encode;
    "a piece of a policy" policy_piece: |data| PolicyPiece::decode(Bytes::copy_from_slice(data)), PolicyPiece::encode;
    "a receipt" receipt: Receipt::decode, Receipt::encode;
    "the manifest of a run in a store" manifest: Manifest::decode, Manifest::encode;
    "statistics of an actor" stats: ActorStats::decode_checked, ActorStats::to_bytes;
    "a report of an evaluation" evaluation: EvaluationReport::decode, EvaluationReport::encode;
    "a pose" pose: Pose::decode_checked, |pose: &Pose| pose.to_bytes().expect("what was decoded can be encoded");
    "a scalar on a JSON topic" metric: Metric::from_json, Metric::to_json;
    "a finished episode on a JSON topic" episode: EpisodeReport::from_json, EpisodeReport::to_json;
}

/// Decodes the objects on the JSON topics.
pub fn json(data: &[u8]) {
    metric(data);
    episode(data);
}

/// Decodes a checkpoint: the bytes as a file, and the bytes as the content of a file with a valid header and checksum.
pub fn checkpoint(data: &[u8]) {
    let mut wrapped = encoding::encode(&()).expect("the unit value can be encoded");
    wrapped.truncate(12);
    wrapped.extend((data.len() as u64).to_le_bytes());
    wrapped.extend(encoding::checksum(data));
    wrapped.extend(data);
    for bytes in [data, &wrapped] {
        let Ok(state) = decode_checkpoint("a file", bytes) else { continue };
        if let Ok(config) = state.check().and_then(|()| state.config()) {
            drop(state.bundle(&state.ppo.trained_policy(), &config, 0));
        }
        let encoded = encoding::encode(&state).expect("what was decoded can be encoded");
        // NaN is not equal to itself, so bytes are compared.
        let decoded = decode_checkpoint("a file", &encoded).expect("what was encoded can be decoded");
        assert_eq!(encoding::encode(&decoded).expect("what was decoded can be encoded"), encoded);
    }
}

/// Decodes an exported policy.
pub fn exported(data: &[u8]) {
    if let Ok(policy) = ExportedPolicy::from_bytes(data) {
        let encoded = policy.to_bytes().expect("what was decoded can be encoded");
        assert_eq!(ExportedPolicy::from_bytes(&encoded).expect("what was encoded can be decoded"), policy);
    }
}

/// Decodes the weights of a policy bundle.
pub fn weights(data: &[u8]) {
    let shape = samples::shape();
    if let Ok(parameters) = from_safetensors(data, &shape) {
        let encoded = to_safetensors(&shape, &parameters);
        assert_eq!(from_safetensors(&encoded, &shape).expect("what was encoded can be decoded"), parameters);
    }
}

/// Reads a robot from MJCF text.
pub fn model(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data) {
        drop(Model::from_mjcf(text));
    }
}

/// Reads a robot card and applies it to the humanoid; if it fits, the robot must simulate.
pub fn card(data: &[u8]) {
    let Some(card) = std::str::from_utf8(data).ok().and_then(|text| RobotCard::parse(text).ok()) else { return };
    let mut model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    if card.apply(&mut model).is_err() {
        return;
    }
    let controls: Vec<f32> = model.motors.iter().map(|motor| motor.control[1] as f32).collect();
    assert!(controls.iter().all(|control| control.is_finite()), "a target is not finite");
    let mut physics = Physics::new(model, PhysicsSettings::default()).expect("the settings are valid");
    // A fault is no error: any gain is allowed.
    let _ = physics.step_only(&controls);
}

/// Reads a configuration from TOML text, as this program's own and as that of a run of any version.
pub fn config(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let mut of_run = ConfigSource::default();
    let unknown = of_run.text_of_run(text, "a text", |_| true);
    let of_run = of_run.build();
    if let Ok(config) = read_config(text) {
        assert_eq!(unknown.as_deref(), Ok(&[][..]), "every key is known");
        assert_eq!(of_run.as_ref(), Ok(&config));
        assert_eq!(read_config(&config.to_toml()).expect("what was encoded can be decoded"), config);
    }
}

fn read_config(text: &str) -> Result<Config, String> {
    let mut source = ConfigSource::default();
    source.text(text, "a text").map_err(|error| error.to_string())?;
    source.build().map_err(|error| error.to_string())
}

/// Validates a fragment as the learner does, twice.
pub fn fragment_validator(data: &[u8]) {
    let expected = ExpectedFragment {
        run: samples::RUN.into(),
        config_hash: samples::CONFIG_HASH,
        observation_size: samples::WIDTH,
        action_size: 1,
        max_policy_lag: 1,
        physics_version: 1,
    };
    let admission = Arc::new(Admission::new(8, 64));
    let mut validator = FragmentValidator::new(expected, admission, Ledger::default(), FragmentCounts::default());
    let mut lineage = Lineage::new(samples::INCARNATION);
    lineage.advance();
    let now = Instant::now();
    for _ in 0..2 {
        let validated = validator.validate(samples::ACTOR, data.into(), &lineage, now);
        if let Err(receipt) = &validated {
            assert_eq!(
                Receipt::decode(&receipt.encode()).as_ref(),
                Ok(&**receipt),
                "the sender can decode the receipt"
            );
        }
    }
    assert!(validator.counts.accepted <= 1, "no fragment is accepted twice");
    let counts = validator.counts;
    assert_eq!(
        counts.accepted + counts.duplicate + counts.too_old + counts.vanished + counts.malformed,
        2,
        "{counts:?}"
    );
}
