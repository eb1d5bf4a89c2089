//! What is sent: one fragment of random numbers under every actor's name, and policies of a given size.

use treadmill_policy::{init::initial_parameters, to_safetensors};
use treadmill_proto::{Fragment, Malformed, PolicyBundle, PolicyVersion, Precision, PreparedFragment};
use treadmill_runtime::seeds;

use crate::commands::bench::network::{self, Widths};

/// The run's name on the bus.
pub(super) const RUN: &str = "bench";
/// Stands for configuration and model, which nobody reads here.
pub(super) const CONFIG_HASH: u64 = 1;
/// Incarnation of every actor. Admission reads it from the first bytes, where the prepared fragment has it.
pub(super) const ACTOR_INCARNATION: u64 = 1;
/// The learner's incarnation in every policy version.
pub(super) const INCARNATION: u64 = 1;
/// Entries of an observation and an action: the compact humanoid's.
pub(super) const WIDTHS: (u32, u32) = (45, 17);
/// Networks whose bundle has one megabyte.
const NETWORK: &str = "45-448-224";
/// Control steps of a fragment, as configured by default.
const STEPS: u32 = 128;
/// Bytes of one transition, and of the last observation that each environment adds.
const BYTES: (usize, usize) = (257, 180);
/// The same where observations travel in half precision.
const HALF_BYTES: (usize, usize) = (167, 90);

/// A fragment of about so many bytes, and its transitions.
pub(super) fn fragment(bytes: usize, precision: Precision) -> Result<(PreparedFragment, usize), Malformed> {
    let (transition, last) = match precision {
        Precision::F32 => BYTES,
        Precision::F16 => HALF_BYTES,
    };
    let envs = (bytes / (STEPS as usize * transition + last)).max(1);
    let rows = STEPS as usize * envs;
    let mut random = seeds::stream(1, "bench-bus", &[]);
    let mut numbers = |width: u32, rows: usize| network::normals(width as usize * rows, &mut random);
    let mut fragment = Fragment {
        run: RUN.to_string(),
        actor: "a".to_string(),
        actor_incarnation: ACTOR_INCARNATION,
        sequence: 1,
        version: PolicyVersion { incarnation: INCARNATION, number: 0 },
        config_hash: CONFIG_HASH,
        steps: STEPS,
        envs: envs as u32,
        observation_size: WIDTHS.0,
        action_size: WIDTHS.1,
        observations: numbers(WIDTHS.0, rows),
        actions: numbers(WIDTHS.1, rows),
        log_probs: numbers(1, rows),
        rewards: numbers(1, rows),
        flags: vec![0; rows],
        last_observations: numbers(WIDTHS.0, envs),
        episodes: Vec::new(),
        settled_through: 0,
        actor_state: None,
    };
    precision.round(&mut fragment.observations);
    precision.round(&mut fragment.last_observations);
    Ok((PreparedFragment::new(&fragment, precision)?, rows))
}

/// The first policy; others differ from it in nothing but their number.
pub(super) fn bundle() -> PolicyBundle {
    let shape = NETWORK.parse::<Widths>().expect("widths").shape();
    let weights = to_safetensors(&shape, &initial_parameters(&shape, -0.5, &mut seeds::stream(1, "bench-bus", &[1])));
    PolicyBundle {
        run: RUN.to_string(),
        version: PolicyVersion { incarnation: INCARNATION, number: 0 },
        observation_size: WIDTHS.0,
        action_size: WIDTHS.1,
        hidden: shape.hidden.iter().map(|width| *width as u32).collect(),
        checksum: seeds::checksum(&[&weights]),
        weights: weights.into(),
        observation_mean: vec![0.0; shape.observation],
        observation_inverse_std: vec![1.0; shape.observation],
        observation_clip: 10.0,
        config_hash: CONFIG_HASH,
        config_toml: String::new(),
        model_xml: treadmill_humanoid::HUMANOID_XML.to_string(),
        actor_state: None,
    }
}
