//! Keys of the configuration. The doc texts are the reference page and `--help`.

use super::choices::{EnvObservation, EnvTask, LearnerMode, ObservationPrecision, Symmetry};
use super::section::section;
use treadmill_proto::{ident::check_task_name, limits::WIDTH_MAX};

section! {
    /// Seed, length and determinism of the run.
    RunConfig as "run" {
        /// Seed of all random streams of the run.
        seed: u64 = 1, "0 to 9223372036854775807" => |v| *v <= i64::MAX as u64;
        /// Environment steps of the run in total; no schedule depends on it.
        steps: u64 = 8_000_000, "1 to 1000000000000" => |v| (1..=1_000_000_000_000).contains(v);
        /// Run one actor in lock-step with the learner: the same seed then gives the same weights, bit for bit.
        deterministic: bool = false, "true or false" => |_| true;
        /// Words that group runs, shown by `treadmill runs` and TensorBoard.
        tags: Vec<String> = Vec::new(), "at most 16 words, each of 1 to 32 characters" => |v| v.len() <= 16 && v.iter().all(|tag| (1..=32).contains(&tag.chars().count()) && !tag.contains(|c: char| c.is_whitespace() || c.is_control()));
        /// Free text about the run, shown by `treadmill runs` and TensorBoard.
        description: String = String::new(), "at most 500 characters in one line" => |v| v.chars().count() <= 500 && !v.contains(char::is_control);
    }
}

section! {
    /// Humanoid task, by default Gymnasium's Humanoid-v5. Keys have the names of Gymnasium's arguments.
    EnvConfig as "env" {
        /// Task, which sets rewards and info. v4 has no contact cost, and adds the healthy reward also on the step that ends an episode. "velocity" follows commands and has sections of its own, `[velocity]` and `[rewards]`. "external" is a task that actors in other languages register.
        task: EnvTask = EnvTask::HumanoidV5, "\"humanoid-v5\", \"humanoid-v4\", \"velocity\" or \"external\"" => |_| true;
        /// Name of a task that the program defines itself, in place of `env.task`; empty means none. See docs/guide/own-task.md.
        own_task: String = String::new(), "at most 64 of the characters a-z, 0-9 and -" => |v| v.len() <= 64 && v.bytes().all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == b'-');
        /// Reward per m/s of forward velocity of the whole body's centre of mass.
        forward_reward_weight: f64 = 1.25, "a finite number" => |v| v.is_finite();
        /// Cost per squared unit of control, of the action as given.
        ctrl_cost_weight: f64 = 0.1, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Cost per squared newton (or newton metre) of external contact force.
        contact_cost_weight: f64 = 5e-7, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Range to which the contact cost of one step is clipped.
        contact_cost_range: [f64; 2] = [f64::NEG_INFINITY, 10.0], "[lowest, highest], the first not above the second; -inf and inf are allowed" => |[low, high]| low <= high && *low < f64::INFINITY && *high > f64::NEG_INFINITY;
        /// Reward for each step on which the humanoid is healthy.
        healthy_reward: f64 = 5.0, "a finite number" => |v| v.is_finite();
        /// Whether an unhealthy torso height ends the episode.
        terminate_when_unhealthy: bool = true, "true or false" => |_| true;
        /// Range of torso heights in metres, without its ends, in which the humanoid is healthy.
        healthy_z_range: [f64; 2] = [1.0, 2.0], "[lowest, highest], the first below the second; -inf and inf are allowed" => |[low, high]| low < high;
        /// Half width of the uniform noise on each position and velocity at reset.
        reset_noise_scale: f64 = 0.01, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Observation of the policy: positions and velocities (45 numbers), or that of Gymnasium's v5 (348) or v4 (376).
        observation: EnvObservation = EnvObservation::Compact, "\"compact\", \"gymnasium-v5\" or \"gymnasium-v4\"" => |_| true;
        /// Whether the observation omits x and y of the torso.
        exclude_current_positions_from_observation: bool = true, "true or false" => |_| true;
        /// Whether the observation `gymnasium-v5` includes the inertias of the bodies.
        include_cinert_in_observation: bool = true, "true or false" => |_| true;
        /// Whether the observation `gymnasium-v5` includes the velocities of the bodies.
        include_cvel_in_observation: bool = true, "true or false" => |_| true;
        /// Whether the observation `gymnasium-v5` includes the motors' torques.
        include_qfrc_actuator_in_observation: bool = true, "true or false" => |_| true;
        /// Whether the observation `gymnasium-v5` includes the contact forces.
        include_cfrc_ext_in_observation: bool = true, "true or false" => |_| true;
        /// Control steps after which an episode is truncated.
        max_episode_steps: u32 = 1000, "1 to 1000000" => |v| (1..=1_000_000).contains(v);
        /// Name of the model's keyframe at which episodes start; empty means the nominal pose.
        keyframe: String = String::new(), "at most 128 characters in one line" => |v| v.chars().count() <= 128 && !v.contains(char::is_control);
        /// Name of a built-in robot card (g1, g1-29, h1 or t1) that completes the model; empty means none. See docs/guide/robots.md.
        robot: String = String::new(), "at most 128 characters in one line" => |v| v.chars().count() <= 128 && !v.contains(char::is_control);
        /// Duration of one control step in seconds: one action, one observation, one reward.
        control_step_s: f64 = 0.015, "0.001 to 0.1" => |v| (0.001..=0.1).contains(v);
        /// Physics steps per control step.
        substeps: u32 = 4, "1 to 50" => |v| (1..=50).contains(v);
        /// Whether the humanoid's limbs collide with each other.
        self_collision: bool = true, "true or false" => |_| true;
    }
}

section! {
    /// Commands, gait and falls of the velocity task; see docs/guide/your-robot.md.
    VelocityConfig as "velocity" {
        /// Smallest and largest commanded forward velocity in m/s.
        lin_vel_x_mps: [f64; 2] = [-0.5, 1.0], "[smallest, largest], -5 to 5" => |v| is_range(v, -5.0, 5.0);
        /// Smallest and largest commanded velocity to the left in m/s.
        lin_vel_y_mps: [f64; 2] = [-0.3, 0.3], "[smallest, largest], -5 to 5" => |v| is_range(v, -5.0, 5.0);
        /// Smallest and largest commanded yaw rate, to the left, in rad/s.
        ang_vel_z_radps: [f64; 2] = [-0.5, 0.5], "[smallest, largest], -5 to 5" => |v| is_range(v, -5.0, 5.0);
        /// Shortest and longest time for which a command holds, in seconds.
        resampling_s: [f64; 2] = [3.0, 8.0], "[shortest, longest], 0.1 to 1000" => |v| is_range(v, 0.1, 1000.0);
        /// Share of the commands that say: stand.
        standing_share: f64 = 0.1, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Share of the commands that give a heading, from whose error the yaw rate follows, instead of a yaw rate.
        heading_share: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Duration of one step of both feet in seconds.
        gait_period_s: f64 = 0.8, "0.1 to 10" => |v| (0.1..=10.0).contains(v);
        /// Share of the gait period for which a foot stands.
        stance_share: f64 = 0.6, "0.05 to 0.95" => |v| (0.05..=0.95).contains(v);
        /// Height to which a swinging foot is lifted, in metres, above the highest ground within 0.2 m of it.
        swing_height_m: f64 = 0.08, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Squared error of a velocity at which its tracking reward falls to 1/e.
        tracking_variance: f64 = 0.1, "0.0001 to 100" => |v| (1e-4..=100.0).contains(v);
        /// Share of the standing height below which the robot has fallen.
        fall_height_share: f64 = 0.6, "0 to 0.95" => |v| (0.0..=0.95).contains(v);
        /// Tilt of the base above which the robot has fallen, in rad.
        fall_tilt_rad: f64 = 1.0, "0.1 to 3.2" => |v| (0.1..=3.2).contains(v);
        /// Number of observations, the present one included, that the policy sees together.
        history: u32 = 1, "1 to 16" => |v| (1..=16).contains(v);
        /// Whether the policy sees the heights of the ground around it: 11 x 7 points, 0.1 m apart, in its heading frame.
        height_scan: bool = false, "true or false" => |_| true;
        /// Whether the ranges of commands begin at 0.4 of their size in training, and grow with each environment's success.
        command_curriculum: bool = false, "true or false" => |_| true;
    }
}

/// Names of the kinds of ground.
const GROUND_KINDS: [&str; 5] = ["flat", "slope", "stairs", "rough", "stones"];

section! {
    /// Ground of the velocity task that code makes: square tiles, a column for each kind and a row for each level of difficulty.
    GroundConfig as "ground" {
        /// Kinds of tiles; none leaves the model's own ground. Slopes and stairs rise from the start in the tile's middle and fall towards its rim.
        kinds: Vec<String> = Vec::new(), "different names out of \"flat\", \"slope\", \"stairs\", \"rough\" and \"stones\"" => |v| v.iter().enumerate().all(|(index, kind)| GROUND_KINDS.contains(&kind.as_str()) && !v[..index].contains(kind));
        /// Levels of difficulty, from level ground to the largest values below.
        levels: u32 = 10, "1 to 20" => |v| (1..=20).contains(v);
        /// Side of a tile in metres; at most 1024 heights must fit along each side of the ground.
        tile_m: f64 = 8.0, "4 to 20" => |v| (4.0..=20.0).contains(v);
        /// Distance between two heights in metres.
        cell_m: f64 = 0.1, "0.05 to 0.5" => |v| (0.05..=0.5).contains(v);
        /// Largest gradient of the slopes.
        slope_max: f64 = 0.3, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Largest height of a stair in metres; stairs are 0.3 m deep, and rise along one cell.
        step_max_m: f64 = 0.1, "0 to 0.3" => |v| (0.0..=0.3).contains(v);
        /// Largest height and depth of rough ground in metres.
        rough_max_m: f64 = 0.05, "0 to 0.3" => |v| (0.0..=0.3).contains(v);
        /// Largest gap between two stones in metres; stones are 0.5 m wide, and gaps up to 0.3 m deep.
        stone_gap_max_m: f64 = 0.3, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Largest height and depth of a stone in metres.
        stone_height_max_m: f64 = 0.05, "0 to 0.3" => |v| (0.0..=0.3).contains(v);
        /// Seed of rough ground and stones.
        seed: u64 = 1, "0 to 9223372036854775807" => |v| *v <= i64::MAX as u64;
        /// Whether each environment's level rises and falls with success in training, and evaluation draws one for each episode. Otherwise it is always ground.start_level.
        curriculum: bool = true, "true or false" => |_| true;
        /// Level of the first episodes, from 0.
        start_level: u32 = 0, "0 to 19, below ground.levels" => |v| *v < 20;
    }
}

section! {
    /// Weights of the velocity task's reward: the reward of a control step is the sum of weight times term. A weight of 0 switches a term off.
    RewardsConfig as "rewards" {
        /// exp(-e²/velocity.tracking_variance) of the error e of the horizontal velocity in the heading frame (m/s).
        track_linear_velocity: f64 = 2.0, "a finite number" => |v| v.is_finite();
        /// The same of the yaw rate (rad/s).
        track_yaw_rate: f64 = 1.5, "a finite number" => |v| v.is_finite();
        /// 1 in each step that is no fall.
        alive: f64 = 0.3, "a finite number" => |v| v.is_finite();
        /// Squared horizontal part of gravity's direction in the frame of the base.
        upright: f64 = -2.0, "a finite number" => |v| v.is_finite();
        /// Squared difference from the standing height (m²).
        base_height: f64 = -20.0, "a finite number" => |v| v.is_finite();
        /// Squared vertical velocity of the base (m²/s²).
        vertical_velocity: f64 = -0.5, "a finite number" => |v| v.is_finite();
        /// Squared roll and pitch rates of the base (rad²/s²).
        roll_pitch_rate: f64 = -0.05, "a finite number" => |v| v.is_finite();
        /// Share of the feet that stand or swing as the gait says, less the share of the others.
        gait: f64 = 2.0, "a finite number" => |v| v.is_finite();
        /// Time in the air beyond 0.4 s, at each landing of a foot (s).
        feet_air_time: f64 = 0.0, "a finite number" => |v| v.is_finite();
        /// Squared difference of the swinging feet's heights from the gait's (m²); on generated ground only of feet that are lower.
        feet_clearance: f64 = -300.0, "a finite number" => |v| v.is_finite();
        /// Squared horizontal velocity of the feet that stand (m²/s²).
        feet_slip: f64 = -0.5, "a finite number" => |v| v.is_finite();
        /// Squared downward velocity of the foot that lands hardest (m²/s²).
        landing: f64 = 0.0, "a finite number" => |v| v.is_finite();
        /// Squared difference of the hinges from the default pose (rad²); hinges that swing the legs forwards count a tenth.
        pose: f64 = -0.5, "a finite number" => |v| v.is_finite();
        /// Squared change of the action from step to step, in units of the action.
        action_rate: f64 = -0.01, "a finite number" => |v| v.is_finite();
        /// Squared torques (N²m²).
        joint_torque: f64 = -1e-5, "a finite number" => |v| v.is_finite();
        /// Squared accelerations of the hinges (rad²/s⁴).
        joint_acceleration: f64 = -2.5e-7, "a finite number" => |v| v.is_finite();
        /// Angle beyond nine tenths of the hinges' ranges (rad).
        joint_limits: f64 = -5.0, "a finite number" => |v| v.is_finite();
    }
}

section! {
    /// External task, if `env.task` is `"external"`. Keys left at their defaults take the values that the first actor registers, and are then fixed for the run. The other keys of `[env]` and those of `[randomisation]` have no effect.
    TaskConfig as "task" {
        /// Name of the task, as its actors register it; empty takes the first registered one.
        name: String = String::new(), "at most 128 of the characters a-z, A-Z, 0-9, _ - . : and /, not beginning with treadmill/" => |v| v.is_empty() || check_task_name("task.name", v).is_ok();
        /// Entries of one observation; 0 takes what the first actor registers.
        observation_size: u32 = 0, "0 to 4096" => |v| *v <= WIDTH_MAX;
        /// Entries of one action; 0 takes what the first actor registers.
        action_size: u32 = 0, "0 to 4096" => |v| *v <= WIDTH_MAX;
        /// Environment's value for an action of -1, for each entry.
        action_low: Vec<f64> = vec![], "as many finite numbers as task.action_size says" => |v| v.iter().all(|v| v.is_finite());
        /// Environment's value for an action of 1, for each entry.
        action_high: Vec<f64> = vec![], "as many finite numbers, each above that of task.action_low" => |v| v.iter().all(|v| v.is_finite());
        /// Duration of one control step in seconds; 0 means unknown.
        control_step_s: f64 = 0.0, "0 or more" => |v| *v >= 0.0 && v.is_finite();
    }
}

section! {
    /// Randomisation of training episodes, so that the policy does not depend on exact values. A range is [smallest, largest]; by default nothing is randomised.
    RandomisationConfig as "randomisation" {
        /// Factor on the mass and inertia of each body.
        mass_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0.1 to 10" => |v| is_range(v, 0.1, 10.0);
        /// Factor on the friction coefficients of the floor and between limbs.
        floor_friction_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the torque of each motor.
        motor_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the stiffness (kp) of each servo.
        kp_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the damping (kd) of each servo.
        kd_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Largest offset of the root body's centre of mass along each of its axes (m).
        com_offset_m: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Factor on the viscous friction of each hinge.
        damping_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the rotor inertia of each hinge.
        armature_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on gravity.
        gravity_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Standard deviation of the noise on observed height (m), orientation (rad about each axis) and hinge angles (rad). All that is observed is computed from the noisy numbers.
        sensor_noise_position: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Standard deviation of the noise on observed velocities (m/s, rad/s), likewise.
        sensor_noise_velocity: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Largest constant error of each encoder in an episode (rad), which the velocity task observes.
        encoder_bias_rad: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Standard deviation of the noise on each control, as a fraction of the largest control.
        control_noise: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Control steps until an action reaches the motors; constant during an episode.
        action_delay_steps: [u32; 2] = [0, 0], "[smallest, largest], 0 to 3" => |v| v[0] <= v[1] && v[1] <= 3;
        /// Seconds between two pushes, and before the first of an episode.
        push_interval_s: [f64; 2] = [2.0, 5.0], "[smallest, largest], env.control_step_s to 1000" => |v| is_range(v, 0.0, 1000.0);
        /// Velocity in m/s that a push adds to the whole body in a random horizontal direction; 0 disables pushes.
        push_mps: [f64; 2] = [0.0, 0.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
    }
}

/// Returns whether `range` is ordered and within `min` to `max`.
fn is_range(range: &[f64; 2], min: f64, max: f64) -> bool {
    min <= range[0] && range[0] <= range[1] && range[1] <= max
}

section! {
    /// Collection of experience.
    RolloutConfig as "rollout" {
        /// Environments in total, divided among the actors of `train`.
        envs: u32 = 64, "1 to 65536" => |v| (1..=65_536).contains(v);
        /// Actor processes that `train` starts; 0 means one per core.
        actors: u32 = 0, "0 to 256" => |v| *v <= 256;
        /// Control steps of each environment in one fragment; 0 lets the learner fit them to the number and speed of the actors.
        fragment_steps: u32 = 0, "0 to 4096" => |v| *v <= 4096;
        /// Precision to which observations are rounded before the policy and the learner receive them; "f16" saves a third of the bytes.
        observation_precision: ObservationPrecision = ObservationPrecision::F32, "\"f32\" or \"f16\"" => |_| true;
        /// Fragments without a receipt that an actor may have on the bus; 0 means 1 in learner.mode "sync" and 2 in "async".
        max_in_flight: u32 = 0, "0 to 2, and not 2 in learner.mode \"sync\"" => |v| *v <= 2;
        /// Threads of each actor process, which divide its environments; 0 means one per core. A deterministic run uses one.
        threads: u32 = 1, "0 to 256" => |v| *v <= 256;
    }
}

section! {
    /// Actor and critic networks.
    PolicyConfig as "policy" {
        /// Widths of the hidden layers of both networks.
        hidden: Vec<u32> = vec![256, 128], "1 to 8 widths, each 1 to 4096" => |v| (1..=8).contains(&v.len()) && v.iter().all(|w| (1..=4096).contains(w));
        /// Natural logarithm of the initial standard deviation of each action.
        init_log_std: f64 = -0.5, "-5 to 2" => |v| (-5.0..=2.0).contains(v);
        /// Limit to which normalised observations are clipped, in both directions.
        observation_clip: f64 = 10.0, "above 0" => |v| *v > 0.0 && v.is_finite();
    }
}

section! {
    /// Proximal policy optimisation.
    PpoConfig as "ppo" {
        /// Fewest transitions of one update; a batch holds all that the actors have delivered.
        batch: u32 = 8192, "1 to 16777216" => |v| (1..=16_777_216).contains(v);
        /// Transitions of one update that automatic fragments do not exceed; in learner.mode "async" no batch does.
        batch_max: u32 = 131_072, "0 to 16777216; less than ppo.batch counts as ppo.batch" => |v| *v <= 16_777_216;
        /// Transitions of one gradient step; 0 divides each batch into 16.
        minibatch: u32 = 0, "0 to ppo.batch" => |_| true;
        /// Passes over the batch in one update.
        epochs: u32 = 2, "1 to 100" => |v| (1..=100).contains(v);
        /// Fewest passes in learner.mode "async", used when experience waits although batches have their largest size.
        epochs_min: u32 = 1, "1 to ppo.epochs; more than that counts as ppo.epochs" => |v| (1..=100).contains(v);
        /// Discount of future reward per control step.
        gamma: f64 = 0.99, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Bias-variance trade-off of generalised advantage estimation.
        gae_lambda: f64 = 0.95, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Range around 1 to which the probability ratio is clipped.
        clip_range: f64 = 0.2, "above 0, at most 1" => |v| *v > 0.0 && *v <= 1.0;
        /// Whether an update also learns from the mirror image of each transition, with left and right exchanged.
        symmetry: Symmetry = Symmetry::Off, "\"off\" or \"mirrored\"" => |_| true;
        /// Weight of the value loss.
        value_coefficient: f64 = 1.0, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Weight of the entropy bonus.
        entropy_coefficient: f64 = 0.0, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Weight of the squared excess of action means over ppo.bounds_limit.
        bounds_coefficient: f64 = 5e-4, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Absolute action mean above which the bounds loss applies, in units of the action range.
        bounds_limit: f64 = 1.1, "above 0" => |v| *v > 0.0 && v.is_finite();
        /// Largest Euclidean norm of the gradient.
        max_grad_norm: f64 = 1.0, "above 0" => |v| *v > 0.0 && v.is_finite();
        /// Learning rate of Adam at the start.
        learning_rate: f64 = 3e-4, "above 0, at most 1" => |v| *v > 0.0 && *v <= 1.0;
        /// Lowest learning rate that adaptation may reach.
        learning_rate_min: f64 = 1e-5, "above 0, at most ppo.learning_rate_max" => |v| *v > 0.0 && v.is_finite();
        /// Highest learning rate that adaptation may reach.
        learning_rate_max: f64 = 1e-3, "at least ppo.learning_rate_min, at most 1" => |v| *v > 0.0 && *v <= 1.0;
        /// Target KL divergence. Above twice this value the learning rate is divided by 1.5, below half of it multiplied by 1.5; 0 keeps it fixed.
        target_kl: f64 = 0.048, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Factor on rewards before returns are computed.
        reward_scale: f64 = 0.1, "above 0" => |v| *v > 0.0 && v.is_finite();
    }
}

section! {
    /// Learner: mode, intake and checkpoints.
    LearnerConfig as "learner" {
        /// Threads of the update; 0 means one per core.
        threads: u32 = 0, "0 to 256" => |v| *v <= 256;
        /// Whether a batch holds only experience of the newest policy and actors wait ("sync"), or also of older ones and actors never idle ("async").
        mode: LearnerMode = LearnerMode::Sync, "\"sync\" or \"async\"" => |_| true;
        /// Versions that a fragment's policy may lag behind the newest in mode "async"; older fragments are dropped and counted.
        max_policy_lag: u32 = 8, "0 to 100" => |v| *v <= 100;
        /// Fragments that may wait in the learner's queue.
        intake_fragments: u32 = 4096, "1 to 65536" => |v| (1..=65_536).contains(v);
        /// Malformed fragments in a row after which a sender is put in quarantine for 60 s.
        quarantine_after: u32 = 8, "1 to 1000" => |v| (1..=1000).contains(v);
        /// Updates in a row that may be undone, because a number is not finite, before the run stops.
        undone_max: u32 = 10, "1 to 1000" => |v| (1..=1000).contains(v);
        /// Numbered checkpoints kept beside `latest` and `best`.
        keep_checkpoints: u32 = 3, "0 to 1000" => |v| *v <= 1000;
        /// Updates between two numbered checkpoints.
        checkpoint_every_updates: u32 = 50, "1 to 1000000" => |v| (1..=1_000_000).contains(v);
        /// Updates between two outputs of all metrics with `--log-metrics`.
        table_every_updates: u32 = 10, "1 to 1000000" => |v| (1..=1_000_000).contains(v);
    }
}

section! {
    /// Evaluation during training.
    EvaluationConfig as "eval" {
        /// Environment steps between two evaluations of the current policy; 0 disables them.
        every_steps: u64 = 200_000, "0 to 1000000000000" => |v| *v <= 1_000_000_000_000;
        /// Deterministic episodes of one evaluation, without randomisation and always from the same initial states.
        episodes: u32 = 10, "1 to 1000" => |v| (1..=1000).contains(v);
    }
}

section! {
    /// Message bus.
    BusConfig as "bus" {
        /// Milliseconds that an actor waits for the receipt of a fragment before it sends the fragment again.
        receipt_timeout_ms: u64 = 60_000, "1000 to 3600000" => |v| (1000..=3_600_000).contains(v);
        /// Milliseconds between two polls for a newer policy without an announcement, jittered.
        policy_poll_ms: u64 = 10_000, "100 to 600000" => |v| (100..=600_000).contains(v);
        /// Milliseconds between two statistics messages of an actor.
        stats_every_ms: u64 = 2000, "100 to 600000" => |v| (100..=600_000).contains(v);
    }
}

impl RolloutConfig {
    /// Shortest automatic fragment in control steps.
    pub const STEPS_MIN: u32 = 8;
    /// Longest automatic fragment of an actor at the usual speed. Fewer environments than fill a batch with it deliver several
    /// fragments for each batch.
    pub const STEPS_MAX: u32 = 128;
}

impl PpoConfig {
    /// Gradient steps of one pass over a batch if `minibatch` is 0.
    const MINIBATCHES: usize = 16;

    /// Returns the transitions of one gradient step in a batch of `rows`.
    pub fn minibatch_rows(&self, rows: usize) -> usize {
        match self.minibatch {
            0 => rows.div_ceil(Self::MINIBATCHES),
            pinned => pinned as usize,
        }
    }
}
