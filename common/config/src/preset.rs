//! Presets: named configurations to start from.

use super::ConfigError;

/// Preset of a robot with a built-in card, or with one of its own for "". An action of 1 is four units, so that exploration
/// begins with 0.66 units. A discount of 0.98 looks ahead for 50 steps, a second: with 0.99, G1 and H1 obey after about
/// twice as many steps, and with 0.97, one of three H1 fell more often (`experiments/robots/time_to_obey.csv`).
macro_rules! velocity {
    ($card:literal) => {
        concat!(velocity!(of $card), "push_mps = [0.0, 0.5]\n")
    };
    (of $card:literal) => {
        concat!(
            "[env]\ntask = \"velocity\"\nrobot = \"",
            $card,
            "\"\ncontrol_step_s = 0.02\nsubsteps = 5\nreset_noise_scale = 0.05\n\
             [policy]\ninit_log_std = -1.8\n[ppo]\ngamma = 0.98\ngae_lambda = 0.9\nbatch_growth_steps = 1000000\n\
             [randomisation]\nmass_scale = [0.9, 1.1]\nfloor_friction_scale = [0.6, 1.3]\nmotor_scale = [0.9, 1.1]\n\
             sensor_noise_position = 0.01\nsensor_noise_velocity = 0.1\nencoder_bias_rad = 0.01\n\
             action_delay_steps = [0, 1]\npush_interval_s = [5.0, 10.0]\n"
        )
    };
}

/// Preset of motions for a robot with a built-in card, or with one of its own for "".
macro_rules! motion {
    ($card:literal) => {
        concat!(
            "[env]\ntask = \"motion\"\nrobot = \"",
            $card,
            "\"\ncontrol_step_s = 0.02\nsubsteps = 5\nreset_noise_scale = 0.0\nmax_episode_steps = 500\n\
             [policy]\ninit_log_std = -1.8\n[ppo]\ngamma = 0.98\ngae_lambda = 0.9\nbatch_growth_steps = 4000000\n\
             [randomisation]\nfloor_friction_scale = [0.5, 1.3]\nmass_scale = [0.9, 1.1]\nmotor_scale = [0.9, 1.1]\n\
             sensor_noise_position = 0.01\nsensor_noise_velocity = 0.1\nencoder_bias_rad = 0.01\n\
             push_interval_s = [5.0, 10.0]\npush_mps = [0.0, 0.5]\n"
        )
    };
}

/// Links of a G1 that mjlab 1.6.0 compares in its tracking task.
macro_rules! links_of_g1 {
    () => {
        "\
[motion]
anchor = \"torso_link\"
bodies = [\"pelvis\", \"left_hip_roll_link\", \"left_knee_link\", \"left_ankle_roll_link\", \"right_hip_roll_link\", \
\"right_knee_link\", \"right_ankle_roll_link\", \"torso_link\", \"left_shoulder_roll_link\", \"left_elbow_link\", \
\"left_wrist_yaw_link\", \"right_shoulder_roll_link\", \"right_elbow_link\", \"right_wrist_yaw_link\"]
end_effectors = [\"left_ankle_roll_link\", \"right_ankle_roll_link\", \"left_wrist_yaw_link\", \"right_wrist_yaw_link\"]
"
    };
}

/// Names and TOML text of the presets.
pub const PRESETS: &[(&str, &str)] = &[
    ("walk", WALK),
    // The defaults.
    ("own-task", ""),
    // Gymnasium's observations.
    ("walk-v5obs", "[env]\nobservation = \"gymnasium-v5\"\n"),
    ("walk-v4obs", "[env]\ntask = \"humanoid-v4\"\nobservation = \"gymnasium-v4\"\n"),
    // Ends within seconds, for a laptop or a test.
    (
        "smoke",
        "[run]\nsteps = 8192\n[rollout]\nenvs = 8\nactors = 2\nfragment_steps = 64\n\
         [policy]\nhidden = [32, 32]\n[ppo]\nbatch = 512\nminibatch = 256\nepochs = 2\n\
         [learner]\ntable_every_updates = 4\nmetrics_every_ms = 0\n[bus]\nstats_every_ms = 500\n",
    ),
    // Robots that follow velocity commands; each needs its model file. Without a card its size sets more keys.
    ("velocity", velocity!(of "")),
    ("g1", velocity!("g1")),
    ("g1-29", velocity!("g1-29")),
    // The same on generated ground, which the policy sees. The ankles of a G1 roll by 0.26 rad, so it cannot stand across a
    // gradient of 0.27.
    (
        "g1-rough",
        concat!(
            velocity!("g1"),
            "[ground]\nkinds = [\"slope\", \"stairs\", \"rough\"]\nslope_max = 0.25\n\
             [velocity]\nheight_scan = true\nswing_height_m = 0.1\n"
        ),
    ),
    // Robots that imitate motions; each needs its model file and a motion.
    ("motion", motion!("")),
    ("g1-motion", concat!(motion!("g1-29"), links_of_g1!())),
    ("h1", velocity!("h1")),
    ("t1", velocity!("t1")),
    // The defaults with a randomised body and floor, for policies that must walk in another simulator.
    ("sim2sim", SIM2SIM),
];

/// Returns that fade over 67 steps, a second, and growing batches; without these, more policies fall
/// (`experiments/learning/search.csv`). Starts have four times the noise of Gymnasium: in a symmetric state an equivariant
/// policy acts symmetrically, and one that learnt to start with the noise of actions falls without it
/// (`experiments/learning/walk_starts.csv`).
const WALK: &str =
    "[env]\nreset_noise_scale = 0.04\n[ppo]\ngamma = 0.985\ngae_lambda = 0.9\nbatch_growth_steps = 1000000\n";

/// Assumed differences between two simulators of the same humanoid.
const SIM2SIM: &str = "\
[randomisation]
mass_scale = [0.85, 1.15]
floor_friction_scale = [0.5, 1.5]
motor_scale = [0.85, 1.15]
damping_scale = [0.6, 1.5]
sensor_noise_position = 0.005
sensor_noise_velocity = 0.05
action_delay_steps = [0, 1]
push_interval_s = [2.0, 5.0]
push_mps = [0.0, 0.5]
";

/// Asks whether the preset nearest to `name` is meant; empty if none is near.
fn hint(name: &str) -> String {
    let given = name.to_lowercase();
    let nearest = PRESETS.iter().map(|(known, _)| (strsim::levenshtein(&given, known), *known)).min();
    // Up to a third of the letters wrong counts as a misspelling.
    let nearest = nearest.filter(|(distance, _)| distance * 3 <= given.len());
    nearest.map(|(_, known)| format!(" did you mean `{known}`?")).unwrap_or_default()
}

/// Returns the text of a preset.
///
/// # Errors
/// [`ConfigError::Preset`] if it does not exist.
pub fn preset(name: &str) -> Result<&'static str, ConfigError> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, text)| *text).ok_or_else(|| ConfigError::Preset {
        given: name.to_string(),
        hint: hint(name),
        allowed: PRESETS.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", "),
    })
}
