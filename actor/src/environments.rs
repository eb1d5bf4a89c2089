//! N humanoids that step together, each in its own world, and the record of their episodes.

use treadmill_common::seeds;
use treadmill_humanoid::{Environment, EnvironmentConfig, ModelError};
use treadmill_proto::{EndCause, Episode};

/// Where the reset seeds of these environments come from.
#[derive(Clone, Debug)]
pub struct SeedSource {
    /// The run's seed.
    pub run_seed: u64,
    /// The actor's name.
    pub actor: String,
    /// Number of this start of the actor: it draws other random numbers each time.
    pub start: u64,
}

impl SeedSource {
    fn reset(&self, env: usize, episode: u64) -> u64 {
        seeds::derive(self.run_seed, &format!("reset/{}", self.actor), &[self.start, env as u64, episode])
    }

    /// The stream of exploration noise.
    pub fn noise(&self) -> seeds::Stream {
        seeds::stream(self.run_seed, &format!("action-noise/{}", self.actor), &[self.start])
    }
}

/// N environments.
pub struct Environments {
    environments: Vec<Environment>,
    episodes: Vec<Running>,
    seeds: SeedSource,
    observations: Vec<f32>,
    observation_size: usize,
    action_size: usize,
    control: Vec<f32>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Running {
    number: u64,
    length: u32,
    return_sum: f64,
    start_x_m: f64,
    last_x_m: f64,
}

/// What one step of all environments gave. Planes are `[N]`.
#[derive(Debug, Default)]
pub struct Stepped {
    /// Unscaled rewards.
    pub rewards: Vec<f32>,
    /// Bits of [`treadmill_proto::fragment`].
    pub flags: Vec<u8>,
    /// `[K][observation]`: the true last observations of the environments that were truncated, in order.
    pub truncated_observations: Vec<f32>,
    /// Episodes that ended.
    pub episodes: Vec<Episode>,
}

impl Environments {
    /// Makes and resets `count` environments.
    pub fn new(
        count: usize,
        config: &EnvironmentConfig,
        model_xml: &str,
        seeds: SeedSource,
    ) -> Result<Self, ModelError> {
        let environments =
            (0..count).map(|_| Environment::new(config, model_xml)).collect::<Result<Vec<_>, ModelError>>()?;
        let observation_size = environments.first().map_or(0, Environment::observation_size);
        let action_size = environments.first().map_or(0, Environment::action_size);
        let mut all = Self {
            episodes: vec![Running::default(); count],
            seeds,
            observations: vec![0.0; count * observation_size],
            observation_size,
            action_size,
            control: vec![0.0; action_size],
            environments,
        };
        (0..count).for_each(|env| all.reset(env));
        Ok(all)
    }

    /// N.
    pub fn len(&self) -> usize {
        self.environments.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.environments.is_empty()
    }

    /// Entries of one observation.
    pub fn observation_size(&self) -> usize {
        self.observation_size
    }

    /// Entries of one action.
    pub fn action_size(&self) -> usize {
        self.action_size
    }

    /// `[N][observation]`: where the environments are now; after an episode's end, the start of the next.
    pub fn observations(&self) -> &[f32] {
        &self.observations
    }

    /// Steps all by `actions`, `[N][action]` in units of the action range, which are clipped to it here.
    pub fn step(&mut self, actions: &[f32], stepped: &mut Stepped) {
        stepped.rewards.clear();
        stepped.flags.clear();
        stepped.truncated_observations.clear();
        stepped.episodes.clear();
        for env in 0..self.environments.len() {
            let flags = self.step_one(env, &actions[env * self.action_size..][..self.action_size], stepped);
            stepped.flags.push(flags);
        }
    }

    /// Makes the physics of one environment fail at the next step; for tests.
    #[doc(hidden)]
    pub fn poison(&mut self, env: usize) {
        self.environments[env].physics_mut().poison();
    }

    fn step_one(&mut self, env: usize, action: &[f32], stepped: &mut Stepped) -> u8 {
        use treadmill_proto::fragment::{TERMINATED, TRUNCATED};
        let environment = &mut self.environments[env];
        let limit = environment.action_limit();
        for (control, action) in self.control.iter_mut().zip(action) {
            *control = action.clamp(-1.0, 1.0) * limit;
        }
        let observation = &mut self.observations[env * self.observation_size..][..self.observation_size];
        let step = environment.step(&self.control, observation);
        let running = &mut self.episodes[env];
        running.length += 1;
        // The reward of a step whose physics failed says nothing.
        let reward = if step.fault { 0.0 } else { step.reward };
        stepped.rewards.push(reward);
        running.return_sum += f64::from(reward);
        if !step.fault {
            // The torso's place, whatever the task's info tells.
            running.last_x_m = environment.physics().position()[0];
        }
        let (flags, cause) = match (step.fault, step.terminated, step.truncated) {
            (true, ..) => (TERMINATED, EndCause::Fault),
            (_, true, _) => (TERMINATED, EndCause::Fell),
            (_, _, true) => (TRUNCATED, EndCause::TimeLimit),
            _ => return 0,
        };
        if flags == TRUNCATED {
            stepped.truncated_observations.extend_from_slice(observation);
        }
        let distance_m = running.last_x_m - running.start_x_m;
        stepped.episodes.push(Episode {
            return_sum: running.return_sum,
            length: running.length,
            distance_m,
            velocity_mean_mps: distance_m / (f64::from(running.length) * environment.control_step_s()),
            cause,
        });
        self.reset(env);
        flags
    }

    fn reset(&mut self, env: usize) {
        let running = &mut self.episodes[env];
        let seed = self.seeds.reset(env, running.number);
        let observation = &mut self.observations[env * self.observation_size..][..self.observation_size];
        self.environments[env].reset(seed, observation);
        let x_m = self.environments[env].physics().position()[0];
        *running = Running { number: running.number + 1, start_x_m: x_m, last_x_m: x_m, ..Running::default() };
    }
}
