//! Messages to send: one fragment of random numbers under every actor's name, and policies of a given size.

use rand_distr::{Distribution, StandardNormal};
use treadmill_policy::{NetworkShape, actor_to_safetensors, init::initial_parameters, to_safetensors};
use treadmill_proto::{Fragment, Malformed, PolicyBundle, PolicyVersion, Precision, PreparedFragment};
use treadmill_runtime::seeds;

/// Name of the run on the bus.
pub const RUN: &str = "bench";
/// Hash in place of that of a configuration, which does not matter here.
pub const CONFIG_HASH: u64 = 1;
/// Incarnation of every actor. Admission control reads it from the first bytes, where the prepared fragment has it.
pub const ACTOR_INCARNATION: u64 = 1;
/// Incarnation of the learner in every policy version.
pub const INCARNATION: u64 = 1;
/// Sizes of an observation and an action of the compact humanoid.
pub const WIDTHS: (u32, u32) = (45, 17);
/// Hidden layers of networks whose bundle takes one megabyte.
const HIDDEN: [usize; 2] = [448, 224];
/// Control steps of a fragment, the default.
const STEPS: u32 = 128;
/// Bytes of one transition, and of the last observation of each environment.
const BYTES: (usize, usize) = (257, 180);
/// The same with observations in half precision.
const HALF_BYTES: (usize, usize) = (167, 90);

/// Returns a fragment of about `bytes` bytes, and its number of transitions.
pub fn fragment(bytes: usize, precision: Precision) -> Result<(PreparedFragment, usize), Malformed> {
    let (transition, last) = match precision {
        Precision::F32 => BYTES,
        Precision::F16 => HALF_BYTES,
    };
    let envs = (bytes / (STEPS as usize * transition + last)).max(1);
    let rows = STEPS as usize * envs;
    let mut random = seeds::stream(1, "bench-bus", &[]);
    let mut numbers = |width: u32, rows: usize| normals(width as usize * rows, &mut random);
    let mut fragment = Fragment {
        run: RUN.to_string(),
        actor: "a".to_string(),
        actor_incarnation: ACTOR_INCARNATION,
        sequence: 1,
        version: PolicyVersion::new(INCARNATION, 0),
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
        ..Fragment::default()
    };
    precision.round(&mut fragment.observations);
    precision.round(&mut fragment.last_observations);
    Ok((PreparedFragment::new(&fragment, precision)?, rows))
}

/// Returns the first policy, whole and as actors get it; others differ only in their number.
pub fn bundles() -> [PolicyBundle; 2] {
    let (observation, action) = (WIDTHS.0 as usize, WIDTHS.1 as usize);
    let shape = NetworkShape { observation, action, hidden: HIDDEN.to_vec(), privileged: 0 };
    let parameters = initial_parameters(&shape, -0.5, &mut seeds::stream(1, "bench-bus", &[1]));
    let weights = [to_safetensors(&shape, &parameters), actor_to_safetensors(&shape, &parameters)];
    weights.map(|weights| PolicyBundle {
        run: RUN.to_string(),
        version: PolicyVersion::new(INCARNATION, 0),
        observation_size: WIDTHS.0,
        action_size: WIDTHS.1,
        hidden: shape.hidden.iter().map(|width| *width as u32).collect(),
        checksum: seeds::checksum(&[&weights]),
        weights: weights.into(),
        observation_mean: vec![0.0; shape.observation],
        observation_inverse_std: vec![1.0; shape.observation],
        observation_clip: 10.0,
        config_hash: CONFIG_HASH,
        model_xml: treadmill_humanoid::HUMANOID_XML.to_string(),
        ..PolicyBundle::default()
    })
}

/// Draws standard normal numbers.
pub fn normals(count: usize, random: &mut seeds::Stream) -> Vec<f32> {
    (0..count).map(|_| StandardNormal.sample(random)).collect()
}

/// Returns the checksum of numbers as text.
pub fn checksum(numbers: &[f32]) -> String {
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    format!("{:016x}", seeds::checksum(&[&bytes]))
}
