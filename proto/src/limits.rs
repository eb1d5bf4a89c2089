//! Size limits, checked before anything is allocated.

/// Largest encoded fragment, below the bus's limit of 32 MiB per message.
pub const FRAGMENT_BYTES_MAX: usize = 30 << 20;
/// Bytes of a fragment's observations, actions, log-probabilities, rewards, flags and last observations. The rest is
/// for the header and for finished episodes.
const PLANES_BYTES_MAX: usize = FRAGMENT_BYTES_MAX - FRAGMENT_BYTES_MAX / 64;
/// Returns the most environments of a fragment of `steps` steps with observations and actions of these widths.
#[must_use]
pub fn fragment_envs_max(steps: u32, observation: usize, action: usize) -> usize {
    PLANES_BYTES_MAX / (steps as usize * step_bytes(observation, action) + 4 * observation)
}
/// Returns the most steps of a fragment of `envs` environments, at least one.
#[must_use]
pub fn fragment_steps_max(envs: usize, observation: usize, action: usize) -> u32 {
    let of_env = (PLANES_BYTES_MAX / envs.max(1)).saturating_sub(4 * observation);
    (of_env / step_bytes(observation, action)).clamp(1, STEPS_MAX as usize) as u32
}
/// Observation, action, log-probability, reward and flags.
fn step_bytes(observation: usize, action: usize) -> usize {
    4 * (observation + action + 2) + 1
}
/// Largest encoded policy bundle.
pub const BUNDLE_BYTES_MAX: usize = 30 << 20;
/// Largest piece of a policy bundle. With its header it fits into one batch of the bus, which has 32 to 64 KiB
/// depending on the link.
pub const PIECE_BYTES_MAX: usize = 30_000;
/// Most episodes whose curricula a bundle holds.
pub const CURRICULUM_MAX: usize = 16_384;
/// Kinds of ground that have a number.
pub const GROUND_KINDS_MAX: u32 = 64;
/// Largest encoded state of an actor, which is part of fragments and bundles.
pub const ACTOR_STATE_BYTES_MAX: usize = 8 << 20;
/// Longest model text, equal to the environment's limit.
pub const MODEL_BYTES_MAX: usize = 16 << 20;
/// Largest message of any other kind: receipts, statistics, announcements, JSON.
pub const SMALL_BYTES_MAX: usize = 64 << 10;
/// Largest statistics message of an actor.
pub const STATS_BYTES_MAX: usize = 4 << 10;
/// Largest text in it: the longest name of a host.
pub const STATS_TEXT_BYTES_MAX: usize = 253;
/// Largest pose: about a thousand bodies with their contacts.
pub const POSE_BYTES_MAX: usize = 64 << 10;
/// Most terms of the reward in one fragment.
pub const REWARD_TERMS_MAX: usize = 64;
/// Largest sequence number; counting on from it never overflows.
pub const SEQUENCE_MAX: u64 = u64::MAX >> 1;
/// Largest status of a run: a few hundred bytes for each actor.
pub const STATUS_BYTES_MAX: usize = 4 << 20;
/// Longest key or value in a request to change the configuration.
pub const CONTROL_VALUE_CHARS_MAX: usize = 1024;
/// Most control steps in one fragment.
pub const STEPS_MAX: u32 = 4096;
/// Most environments in one fragment.
pub const ENVS_MAX: u32 = 65_536;
/// Largest observation or action vector.
pub const WIDTH_MAX: u32 = 4096;
/// Most hidden layers.
pub const HIDDEN_LAYERS_MAX: usize = 8;
/// Largest registration of a task: two ranges of the widest action, two mirror images of at most five bytes an entry, and
/// names.
pub const TASK_BYTES_MAX: usize = SMALL_BYTES_MAX + 2 * (8 + 5) * WIDTH_MAX as usize;
/// Longest name of a task.
pub const TASK_NAME_CHARS_MAX: usize = 128;
/// Longest run or actor name.
pub const IDENT_CHARS_MAX: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_steps_and_most_environments_agree() {
        // (30 MiB - 1/64) / 1000 = 30 965 bytes: one observation of 180 and 119 steps of 257.
        assert_eq!(fragment_steps_max(1000, 45, 17), 119);
        assert!(fragment_envs_max(119, 45, 17) >= 1000 && fragment_envs_max(120, 45, 17) < 1000);
        assert_eq!((fragment_steps_max(1, 1, 1), fragment_steps_max(usize::MAX, 45, 17)), (STEPS_MAX, 1));
    }
}
