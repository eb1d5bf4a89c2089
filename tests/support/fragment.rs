//! Valid fragment for tests that send one themselves.

use treadmill_actor::acting_policy::ActingPolicy;
use treadmill_policy::gaussian;
use treadmill_proto::{Fragment, PolicyBundle};

/// Returns the log-probabilities of actions under the policy of a bundle, without which a fragment is implausible.
pub fn log_probs(bundle: &PolicyBundle, observations: &[f32], actions: &[f32]) -> Vec<f32> {
    let policy = ActingPolicy::new(bundle).expect("a sound bundle");
    let mut means = vec![0.0; actions.len()];
    let rows = actions.len() / bundle.action_size as usize;
    policy.means(observations, rows, &mut Vec::new(), &mut means);
    gaussian::log_probabilities(actions, &means, policy.log_std())
}

/// Returns a valid fragment of one transition.
pub fn fragment(bundle: &PolicyBundle, actor: &str, sequence: u64) -> Fragment {
    let (width, action) = (bundle.observation_size as usize, bundle.action_size as usize);
    Fragment {
        run: bundle.run.clone(),
        actor: actor.into(),
        actor_incarnation: 1,
        sequence,
        version: bundle.version,
        config_hash: bundle.config_hash,
        steps: 1,
        envs: 1,
        observation_size: bundle.observation_size,
        action_size: bundle.action_size,
        observations: vec![0.0; width],
        actions: vec![0.0; action],
        log_probs: log_probs(bundle, &vec![0.0; width], &vec![0.0; action]),
        rewards: vec![5.0],
        flags: vec![0],
        last_observations: vec![0.0; width],
        episodes: vec![],
        settled_through: 0,
        physics_version: bundle.physics_version,
        ..Fragment::default()
    }
}
