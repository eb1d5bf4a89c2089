//! The run's configuration as the environment takes it.

use treadmill_common::config::{EnvConfig, EnvObservation, EnvTask};
use treadmill_humanoid::{EnvironmentConfig, ObservationKind, Task};

/// The environment's settings; the environment's crate knows nothing of configuration files.
pub fn environment(config: &EnvConfig) -> EnvironmentConfig {
    EnvironmentConfig {
        task: match config.task {
            EnvTask::HumanoidV5 => Task::HumanoidV5,
            EnvTask::HumanoidV4 => Task::HumanoidV4,
        },
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
        substeps: config.substeps,
        solver_iterations: config.solver_iterations,
        self_collision: config.self_collision,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_have_the_same_defaults() {
        assert_eq!(environment(&EnvConfig::default()), EnvironmentConfig::default());
    }
}
