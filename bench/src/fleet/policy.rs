//! Transitions that played actors send under each policy version.

use std::sync::{Arc, Mutex, OnceLock};

use anyhow::Context;
use treadmill_actor::acting_policy::ActingPolicy;
use treadmill_config::{Config, ConfigSource, ObservationPrecision};
use treadmill_policy::gaussian;
use treadmill_proto::{Fragment, PolicyBundle, PolicyVersion, Precision, PreparedTransitions};
use treadmill_runtime::seeds;

use crate::workload;

/// Transitions that are evaluated for each version; larger fragments repeat them.
const ROWS: usize = 1024;
/// Mean of the rewards, as of a humanoid that stands.
const REWARD_MEAN: f32 = 5.0;
/// Versions that a process keeps; actors that use older ones keep those themselves.
const VERSIONS_MAX: usize = 8;

/// Random numbers of a process, the same for every version.
struct Material {
    /// `[ROWS][observation]`, raw.
    observations: Vec<f32>,
    /// `[ROWS][observation]`.
    last_observations: Vec<f32>,
    /// `[ROWS][action]`: exploration noise in standard deviations.
    normals: Vec<f32>,
    /// `[ROWS]`.
    rewards: Vec<f32>,
    precision: Precision,
}

impl Material {
    fn draw(bundle: &PolicyBundle, precision: Precision) -> Self {
        let mut random = seeds::stream(1, "bench-fleet", &[]);
        let mut normals = |width: u32| workload::normals(ROWS * width as usize, &mut random);
        let mut material = Self {
            observations: normals(bundle.observation_size),
            last_observations: normals(bundle.observation_size),
            normals: normals(bundle.action_size),
            rewards: normals(1).into_iter().map(|normal| REWARD_MEAN + normal).collect(),
            precision,
        };
        precision.round(&mut material.observations);
        precision.round(&mut material.last_observations);
        material
    }
}

/// Policy version with its transitions.
pub struct PlayedPolicy {
    bundle: PolicyBundle,
    material: Arc<Material>,
    transitions: OnceLock<Result<PreparedTransitions, String>>,
}

impl PlayedPolicy {
    /// Returns the version.
    pub fn version(&self) -> PolicyVersion {
        self.bundle.version
    }

    /// Returns the control steps of a fragment of an actor without a receipt; 0 means as the configuration says.
    pub fn fragment_steps(&self) -> u32 {
        self.bundle.fragment_steps
    }

    /// Returns whether [`Self::transitions`] answers at once.
    pub fn is_prepared(&self) -> bool {
        self.transitions.get().is_some()
    }

    /// Returns the transitions. The first call evaluates the networks; others wait for it.
    pub fn transitions(&self) -> anyhow::Result<&PreparedTransitions> {
        let transitions = self.transitions.get_or_init(|| self.prepare().map_err(|why| format!("{why:#}")));
        transitions.as_ref().map_err(|why| anyhow::anyhow!("policy {}: {why}", self.bundle.version.number))
    }

    /// Acts once on every row, as an actor does.
    fn prepare(&self) -> anyhow::Result<PreparedTransitions> {
        let Self { bundle, material, .. } = self;
        let (policy, action) = (ActingPolicy::new(bundle)?, bundle.action_size as usize);
        let (mut means, mut actions) = (vec![0.0; ROWS * action], vec![0.0; ROWS * action]);
        policy.means(&material.observations, ROWS, &mut Vec::new(), &mut means)?;
        let rows = means.chunks_exact(action).zip(material.normals.chunks_exact(action));
        let mut log_probs = Vec::with_capacity(ROWS);
        for ((mean, normals), action) in rows.zip(actions.chunks_exact_mut(action)) {
            gaussian::sample(mean, policy.log_std(), normals, action);
            log_probs.push(gaussian::log_probability(action, mean, policy.log_std()));
        }
        let fragment = Fragment {
            run: bundle.run.clone(),
            actor: "played".to_string(),
            actor_incarnation: 1,
            sequence: 1,
            version: bundle.version,
            config_hash: bundle.config_hash,
            steps: 1,
            envs: ROWS as u32,
            observation_size: bundle.observation_size,
            action_size: bundle.action_size,
            observations: material.observations.clone(),
            actions,
            log_probs,
            rewards: material.rewards.clone(),
            flags: vec![0; ROWS],
            last_observations: material.last_observations.clone(),
            physics_version: bundle.physics_version,
            ..Fragment::default()
        };
        Ok(PreparedTransitions::new(&fragment, material.precision)?)
    }
}

/// Newest policies of a process: its actors share them, so that each version is evaluated once.
pub struct PlayedPolicies {
    pub config: Config,
    config_hash: u64,
    material: Arc<Material>,
    newest: Mutex<Vec<Arc<PlayedPolicy>>>,
}

impl PlayedPolicies {
    /// Begins with the run of `bundle`.
    pub fn new(bundle: &PolicyBundle) -> anyhow::Result<Self> {
        let mut source = ConfigSource::default();
        source.text(&bundle.config_toml, "the configuration of the run")?;
        let config = source.build()?;
        let precision = match config.rollout.observation_precision {
            ObservationPrecision::F32 => Precision::F32,
            ObservationPrecision::F16 => Precision::F16,
        };
        let material = Arc::new(Material::draw(bundle, precision));
        Ok(Self { config, config_hash: bundle.config_hash, material, newest: Mutex::default() })
    }

    /// Returns the policy of a bundle that an actor fetched.
    pub fn get(&self, bundle: PolicyBundle) -> anyhow::Result<Arc<PlayedPolicy>> {
        anyhow::ensure!(bundle.config_hash == self.config_hash, "the learner trains another run");
        let mut newest = self.newest.lock().ok().context("a thread panicked")?;
        if let Some(known) = newest.iter().find(|known| known.version().names_same_policy(bundle.version)) {
            return Ok(known.clone());
        }
        let material = self.material.clone();
        let policy = Arc::new(PlayedPolicy { bundle, material, transitions: OnceLock::new() });
        newest.push(policy.clone());
        let old = newest.len().saturating_sub(VERSIONS_MAX);
        newest.drain(..old);
        Ok(policy)
    }
}

#[cfg(test)]
mod tests {
    use treadmill_policy::{NetworkShape, init::initial_parameters, to_safetensors};

    use super::*;

    fn bundle(number: u64) -> PolicyBundle {
        let shape = NetworkShape { observation: 3, action: 2, hidden: vec![8], privileged: 0 };
        let mut random = seeds::stream(number, "test", &[]);
        let weights = to_safetensors(&shape, &initial_parameters(&shape, -0.5, &mut random));
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
        let policies = PlayedPolicies::new(&bundle(1)).unwrap();
        for number in [1, 2] {
            let policy = policies.get(bundle(number)).unwrap();
            let header = Fragment { sequence: 1, actor: "a".into(), steps: 40, envs: 30, ..Fragment::default() };
            let sent = policy.transitions().unwrap().encode(&header).unwrap();
            let sent = Fragment::decode(sent).unwrap();
            assert_eq!((sent.version.number, sent.config_hash, sent.transitions()), (number, 9, 1200));
            let acting = ActingPolicy::new(&bundle(number)).unwrap();
            let mut means = vec![0.0; 1200 * 2];
            acting.means(&sent.observations, 1200, &mut Vec::new(), &mut means).unwrap();
            for (row, log_prob) in sent.log_probs.iter().enumerate() {
                let at = row * 2..row * 2 + 2;
                let expected = log_density(&sent.actions[at.clone()], &means[at], acting.log_std());
                assert!((f64::from(*log_prob) - expected).abs() < 1e-4, "row {row}: {log_prob}, not {expected}");
            }
        }
    }

    #[test]
    fn actors_of_a_process_share_a_version_and_refuse_another_run() {
        let policies = PlayedPolicies::new(&bundle(1)).unwrap();
        let first = policies.get(bundle(1)).unwrap();
        assert!(Arc::ptr_eq(&first, &policies.get(bundle(1)).unwrap()));
        assert!(!first.is_prepared(), "a version that no actor uses costs nothing");
        (2..20).for_each(|number| drop(policies.get(bundle(number)).unwrap()));
        assert_eq!(policies.newest.lock().unwrap().len(), VERSIONS_MAX);
        assert!(policies.get(PolicyBundle { config_hash: 8, ..bundle(1) }).is_err());
    }
}
