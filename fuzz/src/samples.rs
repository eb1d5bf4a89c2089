//! One valid message of each kind, small so that a mutated byte matters.

use bytes::Bytes;
use treadmill_config::Config;
use treadmill_humanoid::HUMANOID_XML;
use treadmill_learner::{
    checkpoint::{TrainingState, encoding},
    leadership::{Manifest, Status, manifest::FORMAT},
};
use treadmill_policy::{
    NetworkShape,
    exported::{ActionFacts, ExportedPolicy, ObservationFacts},
    normaliser::RunningMoments,
    to_safetensors,
};
use treadmill_proto::{ActorState, EndCause, Episode, Fragment, PolicyBundle, PolicyVersion, RewardTerm};

/// Name of the run.
pub const RUN: &str = "walk";
/// Name of the actor.
pub const ACTOR: &str = "a1";
/// Incarnation of the learner.
pub const INCARNATION: u64 = 9;
/// Hash over the configuration.
pub const CONFIG_HASH: u64 = 11;
/// Entries of an observation.
pub const WIDTH: u32 = 2;

fn version() -> PolicyVersion {
    PolicyVersion::new(INCARNATION, 1)
}

fn state() -> ActorState {
    ActorState {
        actor: ACTOR.into(),
        start: 3,
        noise: vec![1, 2, 3, 4],
        episodes: vec![5; 2],
        lengths: vec![6; 2],
        progress: vec![0.5; 6],
        positions: vec![0.25; 4],
        velocities: vec![-1.0; 4],
        observations: vec![0.5; 4],
        past_actions: vec![0.0; 2],
        steps_to_push: vec![7; 2],
        task: vec![0.5; 2],
        streams: vec![8; 24],
    }
}

fn fragment_message() -> Fragment {
    Fragment {
        run: RUN.into(),
        actor: ACTOR.into(),
        actor_incarnation: 7,
        sequence: 3,
        version: version(),
        config_hash: CONFIG_HASH,
        steps: 2,
        envs: 2,
        observation_size: WIDTH,
        action_size: 1,
        observations: (0..8).map(|i| i as f32).collect(),
        actions: vec![0.5; 4],
        log_probs: vec![-1.0; 4],
        rewards: vec![5.0; 4],
        flags: vec![0, 2, 0, 1],
        last_observations: vec![1.0; 4],
        episodes: vec![Episode {
            return_sum: 12.0,
            length: 2,
            distance_m: 0.1,
            velocity_mean_mps: 3.0,
            cause: EndCause::TimeLimit,
            ground_kind: Some(1),
            ground_level: Some(1.0),
            command_factor: Some(0.5),
            failed_step: Some(7),
        }],
        settled_through: 1,
        actor_state: None,
        env_steps: 8,
        collect_s: 0.5,
        wire_version: 1,
        physics_version: 1,
        reward_terms: vec![RewardTerm { name: "forward".into(), mean: 1.5 }],
    }
}

/// Encodes a rollout fragment.
pub fn fragment() -> Vec<u8> {
    Fragment { actor_state: Some(state()), ..fragment_message() }.encode().expect("a valid message")
}

/// Encodes a rollout fragment without the actor's state.
pub fn fragment_without_state() -> Vec<u8> {
    fragment_message().encode().expect("a valid message")
}

/// Encodes the state of an actor.
pub fn actor_state() -> Vec<u8> {
    let (with, without) = (fragment(), fragment_without_state());
    let start = with.iter().zip(&without).position(|(with, without)| with != without).expect("the state comes between");
    // Two bytes of tag, two of length.
    with[start + 4..start + with.len() - without.len()].to_vec()
}

/// Encodes a policy bundle.
pub fn bundle() -> Vec<u8> {
    PolicyBundle {
        run: RUN.into(),
        version: version(),
        observation_size: WIDTH,
        action_size: 1,
        hidden: vec![2],
        weights: Bytes::from(weights()),
        observation_mean: vec![0.5, 1.0],
        observation_inverse_std: vec![1.0, 2.0],
        observation_clip: 10.0,
        config_hash: CONFIG_HASH,
        config_toml: "[run]".into(),
        model_xml: "<mujoco/>".into(),
        checksum: 5,
        actor_state: Some(state()),
        fragment_steps: 16,
        wire_version: 1,
        wire_version_min: 1,
        physics_version: 1,
        privileged_size: 0,
        observation_mirror: Vec::new(),
        action_mirror: Vec::new(),
        curriculum_kinds: vec![1],
        curriculum_levels: vec![2],
        curriculum_factors: vec![0.5],
        curriculum_failures: vec![7],
    }
    .encode()
    .expect("a valid message")
}

/// Encodes a manifest.
pub fn manifest() -> Vec<u8> {
    Manifest {
        format: FORMAT,
        run: "walk".into(),
        epoch: 7,
        writer: "00ff".into(),
        updates: 3,
        env_steps: 4096,
        state: "states/7-3.bundle".into(),
        status: Status::Training,
        host: "desk".into(),
        pid: 12,
        program_version: "0.1.0".into(),
    }
    .encode()
}

/// Messages as they were first encoded: a name and bytes in hexadecimal in each line.
const GOLDEN: &str = include_str!("../../proto/tests/golden/messages-1.txt");

/// Declares functions that return an encoded message.
macro_rules! golden {
    ($($what:literal $function:ident = $name:literal;)*) => {$(
        #[doc = concat!("Returns ", $what, ".")]
        pub fn $function() -> Vec<u8> {
            let hex = GOLDEN.lines().find_map(|line| line.strip_prefix(concat!($name, " "))).expect("a golden message");
            let byte = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).expect("two digits");
            (0..hex.len()).step_by(2).map(byte).collect()
        }
    )*};
}

golden! {
    "an announcement" announcement = "announcement";
    "a request for a piece of a policy" policy_request = "policy_request";
    "a piece of a policy" policy_piece = "policy_piece";
    "a receipt" receipt = "receipt.too_old";
    "statistics of an actor" stats = "stats";
    "the pose of a single body" pose = "pose";
    "a report of an evaluation" evaluation = "evaluation";
    "a scalar" metric = "metric";
}

/// Encodes the content of a checkpoint.
pub fn checkpoint() -> Vec<u8> {
    let mut config = Config::default();
    config.policy.hidden = vec![2];
    let state = TrainingState::fresh(RUN, &config, "<mujoco/>", shape().into(), INCARNATION);
    // Without the header, which the target adds.
    encoding::encode(&state).expect("a valid message")[52..].to_vec()
}

/// Encodes an exported policy.
pub fn exported() -> Vec<u8> {
    let shape = shape();
    let (observation, mean, variance) =
        ObservationFacts::from_moments("compact", &RunningMoments::new(WIDTH as usize), 10.0);
    ExportedPolicy {
        parameters: vec![0.5; shape.parameter_count()],
        shape,
        observation,
        mean,
        variance,
        action: ActionFacts { names: vec!["hip".into()], low: vec![-0.4], high: vec![0.4] },
        returns: None,
        control_step_s: 0.015,
        settings: Config::default().episodes_toml(),
        model_xml: "<mujoco/>".into(),
    }
    .to_bytes()
    .expect("a valid message")
}

/// Encodes the weights of a network.
pub fn weights() -> Vec<u8> {
    let shape = shape();
    to_safetensors(&shape, &vec![0.5; shape.parameter_count()])
}

/// Returns a robot as MJCF text.
pub fn model() -> Vec<u8> {
    HUMANOID_XML.as_bytes().to_vec()
}

/// Returns a robot card for the humanoid.
pub fn card() -> Vec<u8> {
    let card = "feet = [\"left_foot\", \"right_foot\"]\nheight_m = 1.3\nsymmetry = [[\"left_*\", \"right_*\"]]\n[[hinges]]\n\
                names = \"*\"\nkp = 80.0\nkd = 4.0\neffort_nm = 60\narmature_kgm2 = 0.01\n[[hinges]]\nnames = \"*_knee\"\n\
                default_rad = -0.3\naction_scale_rad = 0.5\nheld = true\n";
    card.as_bytes().to_vec()
}

/// Returns a configuration as TOML text.
pub fn config() -> Vec<u8> {
    Config::default().to_toml().into_bytes()
}

/// Returns the shape of the samples' network.
pub fn shape() -> NetworkShape {
    NetworkShape { observation: WIDTH as usize, action: 1, hidden: vec![2], privileged: 0 }
}
