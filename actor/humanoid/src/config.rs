//! Settings of the environment, which [`treadmill_settings`] declares, and of its physics.

pub use treadmill_settings::{
    ChosenTask, ConfigError, EnvConfig, EnvObservation, EnvTask, EnvironmentConfig, GroundConfig, GroundKind,
    MOTION_TERMS, MotionConfig, MotionRewards, REWARD_TERMS, RandomisationConfig, RewardFunctions, RewardsConfig,
    Section, VelocityConfig,
    environment::{HEADING_GAIN, is_task_name},
};

/// Version of the simulation. Raised whenever the same state, action and settings give another next state, observation,
/// reward or end of an episode. `tests/environment/physics_version.rs` holds it to that.
pub const PHYSICS_VERSION: u32 = 12;

/// How far outside its range a hinge may be set (rad). In the nominal pose of Humanoid-v5 the knees are 2° beyond the end
/// of their range, and limits are soft.
pub const HINGE_TOLERANCE_RAD: f64 = 0.1;

/// Settings that the motion depends on, see [`EnvConfig`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhysicsSettings {
    /// Duration of one control step (s).
    pub control_step_s: f64,
    /// Physics steps per control step.
    pub substeps: u32,
    /// Whether bodies that are not neighbours in the tree collide with each other.
    pub self_collision: bool,
}

impl Default for PhysicsSettings {
    fn default() -> Self {
        Self::from(&EnvConfig::default())
    }
}

impl From<&EnvConfig> for PhysicsSettings {
    fn from(env: &EnvConfig) -> Self {
        let EnvConfig { control_step_s, substeps, self_collision, .. } = *env;
        Self { control_step_s, substeps, self_collision }
    }
}

impl From<&EnvironmentConfig> for PhysicsSettings {
    fn from(config: &EnvironmentConfig) -> Self {
        Self::from(&config.env)
    }
}

impl PhysicsSettings {
    /// Rejects durations and counts that cannot be simulated.
    pub(crate) fn check(self) -> Result<(), ConfigError> {
        let Self { control_step_s, substeps, self_collision } = self;
        EnvConfig { control_step_s, substeps, self_collision, ..EnvConfig::default() }.check()
    }
}
