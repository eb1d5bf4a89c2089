//! Settings that every task has, and those of Gymnasium's tasks.

use crate::{choice, section};

choice! {
    /// Built-in task, or an external one.
    EnvTask {
        /// Gymnasium's Humanoid-v5.
        HumanoidV5 = "humanoid-v5",
        /// Gymnasium's Humanoid-v4.
        HumanoidV4 = "humanoid-v4",
        /// Walking at commanded velocities, for robots with a card.
        Velocity = "velocity",
        /// Imitation of motions, for robots with a card.
        Motion = "motion",
        /// Task that other programs simulate and register.
        External = "external",
    }
}

choice! {
    /// Observation of the policy in Gymnasium's tasks.
    EnvObservation {
        /// Positions and velocities.
        Compact = "compact",
        /// Observation of Gymnasium's Humanoid-v5.
        GymnasiumV5 = "gymnasium-v5",
        /// Observation of Gymnasium's Humanoid-v4.
        GymnasiumV4 = "gymnasium-v4",
    }
}

/// Task that a configuration selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChosenTask<'a> {
    /// Gymnasium's Humanoid-v5.
    HumanoidV5,
    /// Gymnasium's Humanoid-v4.
    HumanoidV4,
    /// Walking at commanded velocities.
    Velocity,
    /// Imitation of motions.
    Motion,
    /// Task that other programs simulate.
    External,
    /// Task that the program defines itself, by its name.
    Own(&'a str),
}

/// Returns whether `name` may name a task of a program: 1 to 64 of the characters a-z, 0-9 and -.
#[must_use]
pub fn is_task_name(name: &str) -> bool {
    let is_allowed = |letter: u8| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == b'-';
    (1..=64).contains(&name.len()) && name.bytes().all(is_allowed)
}

section! {
    /// Humanoid task, by default Gymnasium's Humanoid-v5. Keys have the names of Gymnasium's arguments.
    EnvConfig as "env" {
        /// Task, which sets rewards and info. v4 has no contact cost, and adds the healthy reward also on the step that ends
        /// an episode. "velocity" follows commands and has sections of its own, `[velocity]` and `[rewards]`. "motion"
        /// imitates what `--motion` gives, see `[motion]`. "external" is a task that actors in other languages register.
        task: EnvTask = EnvTask::HumanoidV5, "\"humanoid-v5\", \"humanoid-v4\", \"velocity\", \"motion\" or \"external\"" => |_| true;
        /// Name of a task that the program defines itself, in place of `env.task`; empty means none. See
        /// docs/guide/own-task.md.
        own_task: String = String::new(), "at most 64 of the characters a-z, 0-9 and -"
            => |name| name.is_empty() || is_task_name(name);
        /// Reward per m/s of forward velocity of the whole body's centre of mass.
        forward_reward_weight: f64 = 1.25, "a finite number" => |v| v.is_finite();
        /// Cost per squared unit of control, of the action as given.
        ctrl_cost_weight: f64 = 0.1, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Cost per squared newton (or newton metre) of external contact force.
        contact_cost_weight: f64 = 5e-7, "0 or more" => |v| *v >= 0.0 && v.is_finite();
        /// Range to which the contact cost of one step is clipped.
        contact_cost_range: [f64; 2] = [f64::NEG_INFINITY, 10.0],
            "[lowest, highest], the first not above the second; -inf and inf are allowed"
            => |[low, high]| low <= high && *low < f64::INFINITY && *high > f64::NEG_INFINITY;
        /// Reward for each step on which the humanoid is healthy.
        healthy_reward: f64 = 5.0, "a finite number" => |v| v.is_finite();
        /// Whether an unhealthy torso height ends the episode.
        terminate_when_unhealthy: bool = true, "true or false" => |_| true;
        /// Range of torso heights in metres, without its ends, in which the humanoid is healthy.
        healthy_z_range: [f64; 2] = [1.0, 2.0], "[lowest, highest], the first below the second; -inf and inf are allowed"
            => |[low, high]| low < high;
        /// Half width of the uniform noise on each position and velocity at reset.
        reset_noise_scale: f64 = 0.01, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Observation of the policy: positions and velocities (45 numbers), or that of Gymnasium's v5 (348) or v4 (376).
        observation: EnvObservation = EnvObservation::Compact, "\"compact\", \"gymnasium-v5\" or \"gymnasium-v4\""
            => |_| true;
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
        keyframe: String = String::new(), "at most 128 characters in one line"
            => |v| v.chars().count() <= 128 && !v.contains(char::is_control);
        /// Name of a built-in robot card (g1, g1-29, h1 or t1) that completes the model; empty means none. See
        /// docs/guide/robots.md.
        robot: String = String::new(), "at most 128 characters in one line"
            => |v| v.chars().count() <= 128 && !v.contains(char::is_control);
        /// Duration of one control step in seconds: one action, one observation, one reward.
        control_step_s: f64 = 0.015, "0.001 to 0.1" => |v| (0.001..=0.1).contains(v);
        /// Physics steps per control step.
        substeps: u32 = 4, "1 to 1000" => |v| (1..=1000).contains(v);
        /// Whether the humanoid's limbs collide with each other.
        self_collision: bool = true, "true or false" => |_| true;
    }
}

impl EnvConfig {
    /// Returns the task.
    #[must_use]
    pub fn chosen_task(&self) -> ChosenTask<'_> {
        match (self.own_task.as_str(), self.task) {
            ("", EnvTask::HumanoidV5) => ChosenTask::HumanoidV5,
            ("", EnvTask::HumanoidV4) => ChosenTask::HumanoidV4,
            ("", EnvTask::Velocity) => ChosenTask::Velocity,
            ("", EnvTask::Motion) => ChosenTask::Motion,
            ("", EnvTask::External) => ChosenTask::External,
            (own, _) => ChosenTask::Own(own),
        }
    }
}
