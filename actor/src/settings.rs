//! The run's configuration as the environment takes it.

use treadmill_common::config::EnvConfig;
use treadmill_humanoid::EnvironmentConfig;

/// The environment's settings; the environment's crate knows nothing of configuration files.
pub fn environment(config: &EnvConfig) -> EnvironmentConfig {
    EnvironmentConfig {
        forward_reward_weight: config.forward_reward_weight,
        ctrl_cost_weight: config.ctrl_cost_weight,
        contact_cost_weight: config.contact_cost_weight,
        contact_cost_max: config.contact_cost_max,
        healthy_reward: config.healthy_reward,
        terminate_when_unhealthy: config.terminate_when_unhealthy,
        healthy_z_min_m: config.healthy_z_min_m,
        healthy_z_max_m: config.healthy_z_max_m,
        reset_noise_scale: config.reset_noise_scale,
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

    #[test]
    fn a_model_that_is_read_also_travels() {
        assert_eq!(treadmill_humanoid::model::MODEL_BYTES_MAX, treadmill_proto::limits::MODEL_BYTES_MAX);
    }
}
