//! Valid fragment for tests that send one themselves.

use treadmill_proto::{Fragment, PolicyBundle};

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
        log_probs: vec![-10.0],
        rewards: vec![5.0],
        flags: vec![0],
        last_observations: vec![0.0; width],
        episodes: vec![],
        settled_through: 0,
        ..Fragment::default()
    }
}
