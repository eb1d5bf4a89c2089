//! N humanoids that step together, each in its own world, and the record of their episodes.

mod saved;

use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use treadmill_humanoid::{Environment, EnvironmentConfig, ModelError};
use treadmill_proto::{
    EndCause, Episode, Precision,
    fragment::{TERMINATED, TRUNCATED},
};
use treadmill_runtime::{machine, seeds};

use crate::ActorError;

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
    fn resets(self) -> ResetSeeds {
        let stream = format!("reset/{}", self.actor);
        ResetSeeds { run_seed: self.run_seed, actor: self.actor, stream, start: self.start }
    }

    /// The stream of exploration noise.
    pub fn noise(&self) -> seeds::Stream {
        seeds::stream(self.run_seed, &format!("action-noise/{}", self.actor), &[self.start])
    }
}

/// Seeds of episodes: they depend on the environment's number and the episode's, and on no other environment.
#[derive(Clone)]
struct ResetSeeds {
    run_seed: u64,
    actor: String,
    stream: String,
    start: u64,
}

impl ResetSeeds {
    fn of(&self, env: usize, episode: u64) -> u64 {
        seeds::derive(self.run_seed, &self.stream, &[self.start, env as u64, episode])
    }
}

/// N environments.
pub struct Environments {
    places: Vec<Place>,
    seeds: ResetSeeds,
    observations: Vec<f32>,
    observation_size: usize,
    action_size: usize,
    precision: Precision,
    /// None where the caller's own thread steps all. Rayon's, because it shares out what is left of a step whenever a
    /// thread runs dry: steps take unlike times, by contacts and resets. On two cores that others kept busy, 64
    /// environments took 5 % more CPU time on two threads than on one.
    pool: Option<ThreadPool>,
}

/// One environment with everything that its step writes, so that threads have nothing in common.
struct Place {
    env: usize,
    environment: Environment,
    precision: Precision,
    running: Running,
    control: Vec<f32>,
    reward: f32,
    flags: u8,
    ended: Option<Episode>,
    /// Where an episode ended, kept while the next one begins in the same step.
    last_observation: Vec<f32>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Running {
    number: u64,
    length: u32,
    return_sum: f64,
    start_x_m: f64,
    last_x_m: f64,
}

/// One environment as it is now.
pub struct View<'a> {
    /// Number of its episode, from 1.
    pub episode: u64,
    /// Control steps since that began.
    pub step: u32,
    /// Where the torso was then, along x (m).
    pub start_x_m: f64,
    /// The environment.
    pub environment: &'a Environment,
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
    /// Makes and resets `count` environments, to be stepped on the caller's thread.
    pub fn new(
        count: usize,
        config: &EnvironmentConfig,
        model_xml: &str,
        seeds: SeedSource,
    ) -> Result<Self, ModelError> {
        let places = (0..count)
            .map(|env| Ok(Place::new(env, Environment::new(config, model_xml)?)))
            .collect::<Result<Vec<_>, ModelError>>()?;
        let observation_size = places.first().map_or(0, |place| place.environment.observation_size());
        let action_size = places.first().map_or(0, |place| place.environment.action_size());
        let mut all = Self {
            places,
            seeds: seeds.resets(),
            observations: vec![0.0; count * observation_size],
            observation_size,
            action_size,
            precision: Precision::F32,
            pool: None,
        };
        all.begin();
        Ok(all)
    }

    /// Resets all to their first episodes.
    fn begin(&mut self) {
        let rows = self.observations.chunks_exact_mut(self.observation_size.max(1));
        for (place, observation) in self.places.iter_mut().zip(rows) {
            place.running = Running::default();
            place.reset(&self.seeds, observation);
        }
    }

    /// Rounds every observation to what arrives at the learner, before anybody acts by it.
    pub fn with_precision(mut self, precision: Precision) -> Self {
        self.precision = precision;
        self.places.iter_mut().for_each(|place| place.precision = precision);
        precision.round(&mut self.observations);
        self
    }

    /// How exactly observations travel.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Spreads the environments over this many threads; 0 means one per core, and more than environments are of no use.
    /// What they give is the same, bit for bit, for any number.
    pub fn with_threads(mut self, threads: usize) -> Result<Self, ActorError> {
        let threads = if threads == 0 { machine::cores() } else { threads };
        let threads = threads.min(self.len());
        let pool =
            || ThreadPoolBuilder::new().num_threads(threads).thread_name(|index| format!("physics-{index}")).build();
        self.pool = match threads {
            0 | 1 => None,
            _ => Some(pool().map_err(|why| ActorError::Physics { why: why.to_string() })?),
        };
        Ok(self)
    }

    /// N.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Threads that step the environments.
    pub fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
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

    /// The first environment, for those who watch.
    pub fn first(&self) -> Option<View<'_>> {
        let Place { running, environment, .. } = self.places.first()?;
        Some(View { episode: running.number, step: running.length, start_x_m: running.start_x_m, environment })
    }

    /// Steps all by `actions`, `[N][action]` where −1 is the lower end of a motor's range and 1 its upper one; they are
    /// clipped to it here. An episode that ends is followed by the next at once.
    ///
    /// # Panics
    /// If there are not as many actions as environments.
    pub fn step(&mut self, actions: &[f32], stepped: &mut Stepped) {
        assert_eq!(actions.len(), self.len() * self.action_size, "one action for each environment is needed");
        let Self { places, seeds, observations, .. } = self;
        // Without environments there is nothing to cut into pieces.
        let (width, action_size) = (self.observation_size.max(1), self.action_size.max(1));
        match &self.pool {
            None => places
                .iter_mut()
                .zip(observations.chunks_exact_mut(width))
                .zip(actions.chunks_exact(action_size))
                .for_each(|((place, observation), action)| place.step(action, seeds, observation)),
            Some(pool) => pool.install(|| {
                places
                    .par_iter_mut()
                    .zip(observations.par_chunks_exact_mut(width))
                    .zip(actions.par_chunks_exact(action_size))
                    // Pieces of a few hundred microseconds would leave threads idle at the end of each step.
                    .with_max_len(1)
                    .for_each(|((place, observation), action)| place.step(action, seeds, observation));
            }),
        }
        stepped.gather(&mut self.places);
    }

    /// Puts fresh Rapier worlds below all, so that what follows depends on nothing that [`Self::save`] leaves out.
    pub fn renew_worlds(&mut self) {
        match &self.pool {
            None => self.places.iter_mut().for_each(|place| place.environment.renew_world()),
            Some(pool) => {
                pool.install(|| self.places.par_iter_mut().for_each(|place| place.environment.renew_world()));
            }
        }
    }

    /// Makes the physics of one environment fail at the next step; for tests.
    #[doc(hidden)]
    pub fn poison(&mut self, env: usize) {
        self.places[env].environment.physics_mut().poison();
    }
}

impl Stepped {
    /// Takes what the environments left, in their order.
    fn gather(&mut self, places: &mut [Place]) {
        self.rewards.clear();
        self.flags.clear();
        self.truncated_observations.clear();
        self.episodes.clear();
        for place in places {
            self.rewards.push(place.reward);
            self.flags.push(place.flags);
            if place.flags & TRUNCATED != 0 {
                self.truncated_observations.extend_from_slice(&place.last_observation);
            }
            self.episodes.extend(place.ended.take());
        }
    }
}

impl Place {
    fn new(env: usize, environment: Environment) -> Self {
        Self {
            env,
            running: Running::default(),
            control: vec![0.0; environment.action_size()],
            reward: 0.0,
            flags: 0,
            ended: None,
            last_observation: vec![0.0; environment.observation_size()],
            precision: Precision::F32,
            environment,
        }
    }

    fn step(&mut self, action: &[f32], seeds: &ResetSeeds, observation: &mut [f32]) {
        self.environment.action_from_shares(action, &mut self.control);
        let step = self.environment.step(&self.control, observation);
        self.precision.round(observation);
        let running = &mut self.running;
        running.length += 1;
        // The reward of a step whose physics failed says nothing.
        self.reward = if step.fault { 0.0 } else { step.reward };
        running.return_sum += f64::from(self.reward);
        if !step.fault {
            // The torso's place, whatever the task's info tells.
            running.last_x_m = self.environment.physics().position()[0];
        }
        let (flags, cause) = match (step.fault, step.terminated, step.truncated) {
            (true, ..) => (TERMINATED, EndCause::NonFinite),
            (_, true, _) => (TERMINATED, EndCause::Fell),
            (_, _, true) => (TRUNCATED, EndCause::TimeLimit),
            _ => {
                self.flags = 0;
                return;
            }
        };
        self.flags = flags;
        self.last_observation.copy_from_slice(observation);
        let distance_m = running.last_x_m - running.start_x_m;
        self.ended = Some(Episode {
            return_sum: running.return_sum,
            length: running.length,
            distance_m,
            velocity_mean_mps: distance_m / (f64::from(running.length) * self.environment.control_step_s()),
            cause,
        });
        self.reset(seeds, observation);
    }

    fn reset(&mut self, seeds: &ResetSeeds, observation: &mut [f32]) {
        let number = self.running.number;
        self.environment.reset(seeds.of(self.env, number), observation);
        self.precision.round(observation);
        let x_m = self.environment.physics().position()[0];
        self.running = Running { number: number + 1, start_x_m: x_m, last_x_m: x_m, ..Running::default() };
    }
}
