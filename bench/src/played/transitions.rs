//! Transitions that played actors send under each policy version.

use std::sync::{Arc, Mutex};

use rand_distr::{Distribution, StandardNormal};
use treadmill_actor::acting_policy::ActingPolicy;
use treadmill_policy::gaussian;
use treadmill_proto::{Fragment, PolicyBundle, PolicyVersion, Precision, PreparedFragment};
use treadmill_runtime::seeds;

/// Transitions that are evaluated for each version; larger fragments repeat them.
const ROWS: usize = 1024;
/// Mean of the rewards, as of a humanoid that stands.
const REWARD_MEAN: f32 = 5.0;
/// Fragments that a process keeps.
const KEPT: usize = 8;

/// Random transitions of a process, and the fragments that were made of them.
pub struct Transitions {
    /// Fragment of one step of [`ROWS`] environments, without actions.
    material: Fragment,
    /// `[ROWS][action]`: exploration noise in standard deviations.
    noise: Vec<f32>,
    precision: Precision,
    envs: u32,
    prepared: Mutex<Vec<(PolicyVersion, u32, Arc<PreparedFragment>)>>,
}

impl Transitions {
    /// Draws the random numbers for the run of `bundle`.
    pub fn new(bundle: &PolicyBundle, precision: Precision, actor_incarnation: u64, envs: u32) -> Self {
        let mut random = seeds::stream(1, "bench", &[]);
        let mut normals = |width: u32| -> Vec<f32> {
            (0..ROWS * width as usize).map(|_| StandardNormal.sample(&mut random)).collect()
        };
        let mut material = Fragment {
            run: bundle.run.clone(),
            actor: "played".to_string(),
            actor_incarnation,
            sequence: 1,
            config_hash: bundle.config_hash,
            observation_size: bundle.observation_size,
            action_size: bundle.action_size,
            observations: normals(bundle.observation_size),
            last_observations: normals(bundle.observation_size),
            rewards: normals(1).into_iter().map(|normal| REWARD_MEAN + normal).collect(),
            physics_version: bundle.physics_version,
            ..Fragment::default()
        };
        let noise = normals(bundle.action_size);
        precision.round(&mut material.observations);
        precision.round(&mut material.last_observations);
        Self { material, noise, precision, envs, prepared: Mutex::default() }
    }

    /// Returns a fragment of `steps` steps under this policy. The first call for a policy evaluates its network.
    pub fn fragment(&self, policy: &ActingPolicy, steps: u32) -> anyhow::Result<Arc<PreparedFragment>> {
        let mut prepared = self.prepared.lock().expect("no holder of this lock panics");
        if let Some((.., known)) = prepared.iter().find(|(version, of, _)| *version == policy.version && *of == steps) {
            return Ok(known.clone());
        }
        let fragment = Arc::new(PreparedFragment::new(&self.act(policy, steps)?, self.precision)?);
        prepared.push((policy.version, steps, fragment.clone()));
        let old = prepared.len().saturating_sub(KEPT);
        prepared.drain(..old);
        Ok(fragment)
    }

    /// Acts once on every row, as an actor does, and repeats the rows.
    fn act(&self, policy: &ActingPolicy, steps: u32) -> anyhow::Result<Fragment> {
        let (material, width) = (&self.material, self.material.action_size as usize);
        let (mut means, mut actions) = (vec![0.0; ROWS * width], vec![0.0; ROWS * width]);
        policy.means(&material.observations, ROWS, &mut Vec::new(), &mut means);
        let mut log_probs = Vec::with_capacity(ROWS);
        let rows = means.chunks_exact(width).zip(self.noise.chunks_exact(width));
        for ((mean, noise), action) in rows.zip(actions.chunks_exact_mut(width)) {
            gaussian::sample(mean, policy.log_std(), noise, action);
            log_probs.push(gaussian::log_probability(action, mean, policy.log_std()));
        }
        let (envs, observation) = (self.envs as usize, material.observation_size as usize);
        let rows = steps as usize * envs;
        let repeat =
            |plane: &[f32], length: usize| -> Vec<f32> { plane.iter().copied().cycle().take(length).collect() };
        Ok(Fragment {
            version: policy.version,
            steps,
            envs: self.envs,
            observations: repeat(&material.observations, rows * observation),
            actions: repeat(&actions, rows * width),
            log_probs: repeat(&log_probs, rows),
            rewards: repeat(&material.rewards, rows),
            flags: vec![0; rows],
            last_observations: repeat(&material.last_observations, envs * observation),
            ..material.clone()
        })
    }
}

#[cfg(test)]
mod tests {
    use treadmill_policy::{NetworkShape, Networks, to_safetensors};

    use super::*;

    fn bundle(number: u64) -> PolicyBundle {
        let shape = NetworkShape { observation: 3, action: 2, hidden: vec![8], privileged: 0 };
        let mut random = seeds::stream(number, "test", &[]);
        let weights = to_safetensors(&shape, &Networks::from(shape.clone()).initial_parameters(-0.5, &mut random));
        PolicyBundle {
            run: "run".to_string(),
            version: PolicyVersion::new(1, number),
            observation_size: 3,
            action_size: 2,
            hidden: vec![8],
            checksum: seeds::checksum(&[&weights]),
            weights: weights.into(),
            observation_mean: vec![0.5; 3],
            observation_inverse_std: vec![2.0; 3],
            observation_clip: 10.0,
            config_hash: 9,
            ..PolicyBundle::default()
        }
    }

    /// Log-density of a Gaussian with diagonal covariance, computed in double precision.
    fn log_density(action: &[f32], mean: &[f32], log_std: &[f32]) -> f64 {
        let terms = action.iter().zip(mean).zip(log_std).map(|((action, mean), log_std)| {
            let log_std = f64::from(*log_std);
            let z = f64::from(action - mean) / log_std.exp();
            -0.5 * z * z - log_std - 0.5 * (2.0 * std::f64::consts::PI).ln()
        });
        terms.sum()
    }

    #[test]
    fn log_probabilities_are_those_of_the_version_that_the_fragment_names() {
        let transitions = Transitions::new(&bundle(1), Precision::F32, 7, 30);
        for number in [1, 2] {
            let acting = ActingPolicy::new(&bundle(number)).unwrap();
            let prepared = transitions.fragment(&acting, 40).unwrap();
            assert!(Arc::ptr_eq(&prepared, &transitions.fragment(&acting, 40).unwrap()), "evaluated once");
            let header = Fragment { actor: "a".into(), actor_incarnation: 7, sequence: 5, ..Fragment::default() };
            let sent = Fragment::decode(prepared.under(&header)).unwrap();
            assert_eq!((sent.version.number, sent.config_hash, sent.transitions()), (number, 9, 1200));
            let mut means = vec![0.0; 1200 * 2];
            acting.means(&sent.observations, 1200, &mut Vec::new(), &mut means);
            for (row, log_prob) in sent.log_probs.iter().enumerate() {
                let at = row * 2..row * 2 + 2;
                let expected = log_density(&sent.actions[at.clone()], &means[at], acting.log_std());
                assert!((f64::from(*log_prob) - expected).abs() < 1e-4, "row {row}: {log_prob}, not {expected}");
            }
        }
    }
}
