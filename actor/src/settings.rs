//! Reads the run's configuration and maps it to that of the environment.

use treadmill_config::{
    Config, ConfigSource, EnvObservation, EnvTask, GroundConfig, ObservationPrecision, RandomisationConfig,
    RewardsConfig, RolloutConfig, VelocityConfig, is_key_of_actors,
};
use treadmill_humanoid::{
    EnvironmentConfig, ObservationKind, PHYSICS_VERSION, Randomisation, RewardTask,
    config::{GroundKind, GroundSettings, StartLevel, VelocityConfig as Velocity, VelocityRewards},
};
use treadmill_proto::{PolicyBundle, Precision, WIRE_VERSION, limits::fragment_envs_max};

use crate::ActorError;

/// Sections that actors need. Other sections may have values that only the learner's version knows.
const SECTIONS: [&str; 8] = ["env", "velocity", "rewards", "ground", "task", "randomisation", "rollout", "bus"];
/// Keys of other sections that actors need.
const KEYS: [&str; 5] = ["run.seed", "run.deterministic", "ppo.batch", "learner.mode", "eval.episodes"];
/// Most unknown keys that a message names.
const NAMED_MAX: usize = 8;

/// Reads what this program needs to simulate the run, whose learner may have another version.
///
/// # Errors
/// If the run trains another task or another physics, or sets a key that this program does not know.
pub fn read_simulated(bundle: &PolicyBundle) -> Result<Config, ActorError> {
    let config = read_config(bundle)?;
    check_supported(&bundle.run, &config)?;
    match bundle.physics_version {
        PHYSICS_VERSION => Ok(config),
        theirs => Err(ActorError::OtherPhysics { run: bundle.run.clone(), theirs }),
    }
}

/// Reads the keys that actors need from a policy bundle; all others have their defaults.
///
/// # Errors
/// If a needed key has a value that is not allowed here, or the run sets a key of actors that is unknown here.
pub fn read_config(bundle: &PolicyBundle) -> Result<Config, ActorError> {
    let mut source = ConfigSource::default();
    let unknown = source.text_of_run(&bundle.config_toml, "the configuration of the run", is_needed)?;
    if bundle.wire_version_min > WIRE_VERSION {
        let of_actors = unknown.iter().filter(|key| is_key_of_actors(key)).take(NAMED_MAX);
        let unknown = of_actors.map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
        let needed = bundle.wire_version_min;
        return Err(ActorError::UnknownKeys { run: bundle.run.clone(), unknown, needed });
    }
    if !unknown.is_empty() {
        let keys = unknown[..unknown.len().min(NAMED_MAX)].join(", ");
        tracing::info!(run = %bundle.run, %keys, count = unknown.len(), "ignored unknown keys of the run's configuration");
    }
    Ok(source.build()?)
}

fn is_needed(key: &str) -> bool {
    KEYS.contains(&key) || key.split_once('.').is_some_and(|(section, _)| SECTIONS.contains(&section))
}

/// Returns the control steps of the first fragment of an actor with `envs` environments. Every receipt says those of
/// the next.
///
/// # Errors
/// If such a fragment is too large for the bus.
pub fn first_fragment_steps(bundle: &PolicyBundle, config: &Config, envs: u32) -> Result<u32, ActorError> {
    let steps = match config.rollout.fragment_steps {
        // The learner does not know this actor yet, whose first fragment alone may fill a batch.
        0 => bundle.fragment_steps.min((config.ppo.batch / envs.max(1)).max(RolloutConfig::STEPS_MIN)),
        steps => steps,
    };
    let envs_max = fragment_envs_max(steps, bundle.observation_size as usize, bundle.action_size as usize);
    if envs as usize > envs_max {
        return Err(ActorError::FragmentSize { envs, steps, envs_max });
    }
    Ok(steps)
}

/// Refuses a task that this program does not simulate.
pub fn check_supported(run: &str, config: &Config) -> Result<(), ActorError> {
    match config.is_external() {
        true => Err(ActorError::OtherTask { run: run.to_string(), task: config.task_name() }),
        false => Ok(()),
    }
}

/// Returns the configuration of a training environment: the task with the run's randomisation and curricula.
pub fn training(config: &Config) -> EnvironmentConfig {
    let mut settings = randomised(config);
    if let Some(velocity) = &mut settings.velocity {
        velocity.command_curriculum = config.velocity.command_curriculum;
    }
    if config.ground.curriculum {
        settings.ground.start = StartLevel::Rising(config.ground.start_level);
    }
    settings
}

/// Returns the configuration of an environment with the run's randomisation, whose episodes do not depend on earlier ones.
pub fn randomised(config: &Config) -> EnvironmentConfig {
    EnvironmentConfig { randomisation: randomisation(&config.randomisation), ..environment(config) }
}

/// Returns the precision of observations on the wire.
pub fn precision(config: &Config) -> Precision {
    match config.rollout.observation_precision {
        ObservationPrecision::F32 => Precision::F32,
        ObservationPrecision::F16 => Precision::F16,
    }
}

fn randomisation(config: &RandomisationConfig) -> Randomisation {
    Randomisation {
        mass_scale: config.mass_scale,
        floor_friction_scale: config.floor_friction_scale,
        motor_scale: config.motor_scale,
        kp_scale: config.kp_scale,
        kd_scale: config.kd_scale,
        com_offset_m: config.com_offset_m,
        damping_scale: config.damping_scale,
        armature_scale: config.armature_scale,
        gravity_scale: config.gravity_scale,
        sensor_noise_position: config.sensor_noise_position,
        sensor_noise_velocity: config.sensor_noise_velocity,
        encoder_bias_rad: config.encoder_bias_rad,
        control_noise: config.control_noise,
        action_delay_steps: config.action_delay_steps,
        push_interval_s: config.push_interval_s,
        push_mps: config.push_mps,
    }
}

/// Returns the configuration of an environment without randomisation and curricula: commands have their full ranges,
/// and each episode draws its level of the ground's difficulty.
pub fn environment(config: &Config) -> EnvironmentConfig {
    let ground = ground(&config.ground);
    let is_velocity = config.env.task == EnvTask::Velocity;
    let velocity = is_velocity.then(|| velocity(&config.velocity, &config.rewards));
    let config = &config.env;
    EnvironmentConfig {
        task: match config.task {
            // `check_supported` refuses external tasks.
            EnvTask::HumanoidV5 | EnvTask::Velocity | EnvTask::External => RewardTask::HumanoidV5,
            EnvTask::HumanoidV4 => RewardTask::HumanoidV4,
        },
        own_task: config.own_task.clone(),
        forward_reward_weight: config.forward_reward_weight,
        ctrl_cost_weight: config.ctrl_cost_weight,
        contact_cost_weight: config.contact_cost_weight,
        contact_cost_range: config.contact_cost_range,
        healthy_reward: config.healthy_reward,
        terminate_when_unhealthy: config.terminate_when_unhealthy,
        healthy_z_range: config.healthy_z_range,
        reset_noise_scale: config.reset_noise_scale,
        observation: match config.observation {
            EnvObservation::Compact => ObservationKind::Compact,
            EnvObservation::GymnasiumV5 => ObservationKind::GymnasiumV5,
            EnvObservation::GymnasiumV4 => ObservationKind::GymnasiumV4,
        },
        exclude_current_positions_from_observation: config.exclude_current_positions_from_observation,
        include_cinert_in_observation: config.include_cinert_in_observation,
        include_cvel_in_observation: config.include_cvel_in_observation,
        include_qfrc_actuator_in_observation: config.include_qfrc_actuator_in_observation,
        include_cfrc_ext_in_observation: config.include_cfrc_ext_in_observation,
        max_episode_steps: config.max_episode_steps,
        keyframe: config.keyframe.clone(),
        control_step_s: config.control_step_s,
        substeps: config.substeps,
        self_collision: config.self_collision,
        velocity,
        ground,
        randomisation: Randomisation::default(),
    }
}

fn ground(config: &GroundConfig) -> GroundSettings {
    GroundSettings {
        // The names are checked.
        kinds: config.kinds.iter().filter_map(|name| GroundKind::from_name(name)).collect(),
        levels: config.levels,
        tile_m: config.tile_m,
        cell_m: config.cell_m,
        slope_max: config.slope_max,
        step_max_m: config.step_max_m,
        rough_max_m: config.rough_max_m,
        stone_gap_max_m: config.stone_gap_max_m,
        stone_height_max_m: config.stone_height_max_m,
        seed: config.seed,
        start: match config.curriculum {
            true => StartLevel::Drawn,
            false => StartLevel::Fixed(config.start_level),
        },
    }
}

fn velocity(config: &VelocityConfig, rewards: &RewardsConfig) -> Velocity {
    Velocity {
        lin_vel_x_mps: config.lin_vel_x_mps,
        lin_vel_y_mps: config.lin_vel_y_mps,
        ang_vel_z_radps: config.ang_vel_z_radps,
        resampling_s: config.resampling_s,
        standing_share: config.standing_share,
        heading_share: config.heading_share,
        gait_period_s: config.gait_period_s,
        stance_share: config.stance_share,
        swing_height_m: config.swing_height_m,
        tracking_variance: config.tracking_variance,
        fall_height_share: config.fall_height_share,
        fall_tilt_rad: config.fall_tilt_rad,
        history: config.history,
        height_scan: config.height_scan,
        command_curriculum: false,
        rewards: VelocityRewards {
            track_linear_velocity: rewards.track_linear_velocity,
            track_yaw_rate: rewards.track_yaw_rate,
            alive: rewards.alive,
            upright: rewards.upright,
            base_height: rewards.base_height,
            vertical_velocity: rewards.vertical_velocity,
            roll_pitch_rate: rewards.roll_pitch_rate,
            gait: rewards.gait,
            feet_air_time: rewards.feet_air_time,
            feet_clearance: rewards.feet_clearance,
            feet_slip: rewards.feet_slip,
            landing: rewards.landing,
            pose: rewards.pose,
            action_rate: rewards.action_rate,
            joint_torque: rewards.joint_torque,
            joint_acceleration: rewards.joint_acceleration,
            joint_limits: rewards.joint_limits,
        },
    }
}

#[cfg(test)]
mod tests {
    use std::{collections::BTreeSet, fs, path::Path};

    use treadmill_humanoid::{Environment, HUMANOID_XML};

    use super::*;

    #[test]
    fn the_first_fragment_holds_at_most_a_batch() {
        let mut config = Config::default();
        let sizes = PolicyBundle { observation_size: 45, action_size: 17, ..PolicyBundle::default() };
        let bundle = PolicyBundle { fragment_steps: 64, ..sizes };
        let steps = |bundle: &PolicyBundle, config: &Config, envs| first_fragment_steps(bundle, config, envs).unwrap();
        assert_eq!(steps(&bundle, &config, 32), 64);
        assert_eq!(steps(&bundle, &config, 512), 16);
        assert_eq!(steps(&bundle, &config, 10_000), 8);
        config.rollout.fragment_steps = 24;
        assert_eq!(steps(&bundle, &config, 4096), 24, "as configured");
        config.rollout.fragment_steps = 32;
        let why = first_fragment_steps(&bundle, &config, 4096).unwrap_err().to_string();
        // 32 × 257 + 180 bytes of each environment, in 30 MiB less a sixty-fourth.
        assert!(why.contains("4096 environments and 32 steps") && why.contains("--envs 3684; start further"), "{why}");
    }

    #[test]
    fn configuration_and_environment_have_the_same_defaults() {
        let ground = GroundSettings { start: StartLevel::Rising(0), ..environment(&Config::default()).ground };
        assert_eq!(EnvironmentConfig { ground, ..environment(&Config::default()) }, EnvironmentConfig::default());
        assert_eq!(training(&Config::default()), EnvironmentConfig::default());
    }

    #[test]
    fn only_training_depends_on_earlier_episodes() {
        let mut source = ConfigSource::default();
        for pair in ["env.task=velocity", "velocity.command_curriculum=true", "ground.kinds=[\"stairs\", \"rough\"]"] {
            source.set(pair).unwrap();
        }
        source.set("ground.start_level=3").unwrap();
        let config = source.build().unwrap();
        let of = |settings: EnvironmentConfig| (settings.ground.start, settings.velocity.unwrap().command_curriculum);
        assert_eq!(of(training(&config)), (StartLevel::Rising(3), true));
        assert_eq!(of(randomised(&config)), (StartLevel::Drawn, false));
        assert_eq!(of(environment(&config)), (StartLevel::Drawn, false));
        assert_eq!(training(&config).ground.kinds, [GroundKind::Stairs, GroundKind::Rough]);
        source.set("ground.curriculum=false").unwrap();
        let config = source.build().unwrap();
        assert_eq!(of(training(&config)), (StartLevel::Fixed(3), true));
        assert_eq!(of(environment(&config)), (StartLevel::Fixed(3), false));
    }

    #[test]
    fn configuration_and_environment_refuse_the_same_ranges() {
        let ends = [-1.0, 0.0, 0.015, 0.1, 1.0, 3.0, 10.0, 1000.0, f64::NAN];
        type Set = fn(&mut RandomisationConfig, [f64; 2]);
        let keys: [Set; 12] = [
            |config, range| config.mass_scale = range,
            |config, range| config.floor_friction_scale = range,
            |config, range| config.motor_scale = range,
            |config, range| config.kp_scale = range,
            |config, range| config.kd_scale = range,
            |config, [low, _]| config.com_offset_m = low,
            |config, range| config.damping_scale = range,
            |config, range| config.armature_scale = range,
            |config, range| config.gravity_scale = range,
            |config, range| config.push_interval_s = range,
            |config, range| config.push_mps = range,
            |config, [low, _]| config.control_noise = low,
        ];
        for (key, set) in keys.into_iter().enumerate() {
            for range in ends.iter().flat_map(|low| ends.map(|high| [*low, high])) {
                let mut config = Config::default();
                set(&mut config.randomisation, range);
                let is_accepted = Environment::new(&training(&config), HUMANOID_XML).is_ok();
                assert_eq!(config.check().is_ok(), is_accepted, "key {key}: {range:?}");
            }
        }
    }

    fn sources(folder: &Path, found: &mut String) {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            match entry.file_type().unwrap().is_dir() {
                true => sources(&entry.path(), found),
                false => found.push_str(&fs::read_to_string(entry.path()).unwrap()),
            }
        }
    }

    #[test]
    fn every_key_that_this_crate_uses_is_read_from_the_bundle() {
        let mut text = String::new();
        sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut text);
        let keys = Config::keys();
        let uses = text.split("config.").skip(1).filter_map(|rest| {
            let is_used = |key: &str| {
                let after = rest.strip_prefix(key).and_then(|after| after.chars().next());
                after.is_some_and(|next| !(next.is_ascii_alphanumeric() || next == '_'))
            };
            keys.iter().find(|known| is_used(&known.key))
        });
        let used: BTreeSet<&str> = uses.map(|known| known.key.as_str()).collect();
        assert!(used.len() > 5 && used.contains("run.seed"), "{used:?}");
        let missing: Vec<&str> = used.into_iter().filter(|key| !is_needed(key)).collect();
        assert!(missing.is_empty(), "these keys would have their defaults; add them to KEYS: {missing:?}");
    }

    #[test]
    fn every_readable_model_fits_into_a_bundle() {
        assert_eq!(treadmill_humanoid::mjcf::MODEL_BYTES_MAX, treadmill_proto::limits::MODEL_BYTES_MAX);
    }
}
