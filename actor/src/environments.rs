//! N humanoids that step together on the caller's thread, each in its own world, and their episodes.

pub mod state;

use treadmill_humanoid::{Environment, EnvironmentConfig, ModelError, worlds_per_pass};
use treadmill_proto::{
    EndCause, Episode, Precision,
    fragment::{TERMINATED, TRUNCATED},
};
use treadmill_runtime::seeds;

/// Source of the random streams of these environments.
#[derive(Clone, Debug)]
pub struct SeedSource {
    /// Seed of the run.
    pub run_seed: u64,
    /// Name of the actor.
    pub actor: String,
    /// Number of this start of the actor, so that each start draws other random numbers.
    pub start: u64,
}

impl SeedSource {
    fn reset_seeds(self) -> ResetSeeds {
        let stream = format!("reset/{}", self.actor);
        ResetSeeds { run_seed: self.run_seed, actor: self.actor, stream, start: self.start }
    }

    /// Returns the stream of exploration noise.
    pub fn noise(&self) -> seeds::Stream {
        seeds::stream(self.run_seed, &format!("action-noise/{}", self.actor), &[self.start])
    }
}

/// Seeds of episodes. Each depends only on the numbers of the environment and of the episode.
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

/// Vector of N environments.
pub struct Environments {
    slots: Vec<EnvironmentSlot>,
    seeds: ResetSeeds,
    observations: Vec<f32>,
    observation_size: usize,
    action_size: usize,
    precision: Precision,
    /// For each term of the reward, its name, and its sum over all environments and steps since it was last taken.
    reward_sums: Vec<(&'static str, f64)>,
}

/// One environment with all outputs of its step.
struct EnvironmentSlot {
    env: usize,
    environment: Environment,
    precision: Precision,
    progress: EpisodeProgress,
    control: Vec<f32>,
    reward: f32,
    flags: u8,
    ended: Option<Episode>,
    /// Last observation of an episode; the next episode begins in the same step.
    last_observation: Vec<f32>,
}

#[derive(Clone, Copy, Debug, Default)]
struct EpisodeProgress {
    number: u64,
    length: u32,
    return_sum: f64,
    start_x_m: f64,
    last_x_m: f64,
}

/// Present state of one environment.
pub struct EnvironmentView<'a> {
    /// Number of its episode, from 1.
    pub episode: u64,
    /// Control steps since the episode began.
    pub step: u32,
    /// Position of the torso along x at the start of the episode (m).
    pub start_x_m: f64,
    /// Environment.
    pub environment: &'a Environment,
}

/// Results of one step of all environments; vectors are `[N]` unless stated otherwise.
#[derive(Debug, Default)]
pub struct StepResults {
    /// Unscaled rewards.
    pub rewards: Vec<f32>,
    /// Bits of [`treadmill_proto::fragment`].
    pub flags: Vec<u8>,
    /// `[K][observation]`: true last observations of the truncated environments, in order.
    pub truncated_observations: Vec<f32>,
    /// Episodes that ended.
    pub episodes: Vec<Episode>,
}

impl Environments {
    /// Creates and resets `count` environments.
    pub fn new(
        count: usize,
        config: &EnvironmentConfig,
        model_xml: &str,
        seeds: SeedSource,
    ) -> Result<Self, ModelError> {
        let slots = (0..count)
            .map(|env| Ok(EnvironmentSlot::new(env, Environment::new(config, model_xml)?)))
            .collect::<Result<Vec<_>, ModelError>>()?;
        let observation_size = slots.first().map_or(0, |slot| slot.environment.observation_size());
        let action_size = slots.first().map_or(0, |slot| slot.environment.action_size());
        let mut reward_sums = Vec::new();
        if let Some(first) = slots.first() {
            first.environment.task().reward_terms(&mut |name, _| reward_sums.push((name, 0.0)));
        }
        let mut environments = Self {
            slots,
            seeds: seeds.reset_seeds(),
            observations: vec![0.0; count * observation_size],
            observation_size,
            action_size,
            precision: Precision::F32,
            reward_sums,
        };
        environments.reset();
        Ok(environments)
    }

    /// Resets all environments to their first episodes.
    fn reset(&mut self) {
        let rows = self.observations.chunks_exact_mut(self.observation_size.max(1));
        for (slot, observation) in self.slots.iter_mut().zip(rows) {
            slot.progress = EpisodeProgress::default();
            slot.reset(&self.seeds, observation);
        }
    }

    /// Rounds every observation before the policy sees it, so that the learner receives the same numbers.
    pub fn with_precision(mut self, precision: Precision) -> Self {
        self.precision = precision;
        self.slots.iter_mut().for_each(|slot| slot.precision = precision);
        precision.round(&mut self.observations);
        self
    }

    /// Returns the precision of observations on the wire.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Divides the environments, in their order, into at most this many shares that can step on different threads. All but
    /// the last have whole passes of the physics.
    pub fn split(mut self, shares: usize) -> Vec<Self> {
        let chunk = worlds_per_pass();
        let share = self.len().div_ceil(shares.max(1)).next_multiple_of(chunk).max(chunk);
        let mut rest = std::mem::take(&mut self.slots).into_iter().peekable();
        let mut rows = self.observations.chunks(share * self.observation_size.max(1));
        let mut split = Vec::new();
        while rest.peek().is_some() {
            split.push(Self {
                slots: rest.by_ref().take(share).collect(),
                seeds: self.seeds.clone(),
                reward_sums: self.reward_sums.clone(),
                observations: rows.next().unwrap_or_default().to_vec(),
                ..self
            });
        }
        split
    }

    /// Returns N.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Returns the number of the first environment among all of the actor.
    pub fn first_number(&self) -> usize {
        self.slots.first().map_or(0, |slot| slot.env)
    }

    /// Returns whether N is 0.
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Returns the number of entries in one observation.
    pub fn observation_size(&self) -> usize {
        self.observation_size
    }

    /// Returns the number of entries in one action.
    pub fn action_size(&self) -> usize {
        self.action_size
    }

    /// Returns the present observations, `[N][observation]`; after an episode's end, the first one of the next episode.
    pub fn observations(&self) -> &[f32] {
        &self.observations
    }

    /// Returns the first environment, which observers see.
    pub fn first(&self) -> Option<EnvironmentView<'_>> {
        let EnvironmentSlot { progress, environment, .. } = self.slots.first()?;
        let EpisodeProgress { number: episode, length: step, start_x_m, .. } = *progress;
        Some(EnvironmentView { episode, step, start_x_m, environment })
    }

    /// Steps all environments by `actions`, `[N][action]`, clipped to −1 and 1, the ends of a motor's range. After the end
    /// of an episode, the next begins in the same step.
    ///
    /// # Panics
    /// If there are not as many actions as environments.
    pub fn step(&mut self, actions: &[f32], results: &mut StepResults) {
        assert_eq!(actions.len(), self.len() * self.action_size, "one action for each environment is needed");
        let Self { slots, seeds, observations, reward_sums, .. } = self;
        // Without environments both widths are 0, which is no chunk size.
        let (width, action_size) = (self.observation_size.max(1), self.action_size.max(1));
        // Environments of one chunk step in one pass.
        let chunk = worlds_per_pass();
        let rows = observations.chunks_mut(chunk * width).zip(actions.chunks(chunk * action_size));
        for (slots, (observations, actions)) in slots.chunks_mut(chunk).zip(rows) {
            for (slot, action) in slots.iter_mut().zip(actions.chunks_exact(action_size)) {
                slot.begin_step(action);
            }
            Environment::step_together(&mut slots.iter_mut().map(|slot| &mut slot.environment));
            for (slot, observation) in slots.iter_mut().zip(observations.chunks_exact_mut(width)) {
                slot.finish_step(seeds, observation, reward_sums);
            }
        }
        results.collect(&mut self.slots);
    }

    /// Returns name and sum of each term of the reward, over all environments and steps since the last call. The terms of
    /// failed steps do not count.
    pub fn take_reward_sums(&mut self) -> Vec<(&'static str, f64)> {
        let zeros = self.reward_sums.iter().map(|(name, _)| (*name, 0.0)).collect();
        std::mem::replace(&mut self.reward_sums, zeros)
    }

    /// Makes the physics of one environment fail at the next step; for tests.
    #[doc(hidden)]
    pub fn poison(&mut self, env: usize) {
        self.slots[env].environment.physics_mut().poison();
    }
}

impl StepResults {
    /// Moves the outputs of all environments here, in their order.
    fn collect(&mut self, slots: &mut [EnvironmentSlot]) {
        self.rewards.clear();
        self.flags.clear();
        self.truncated_observations.clear();
        self.episodes.clear();
        for slot in slots {
            self.rewards.push(slot.reward);
            self.flags.push(slot.flags);
            if slot.flags & TRUNCATED != 0 {
                self.truncated_observations.extend_from_slice(&slot.last_observation);
            }
            self.episodes.extend(slot.ended.take());
        }
    }
}

impl EnvironmentSlot {
    fn new(env: usize, environment: Environment) -> Self {
        Self {
            env,
            progress: EpisodeProgress::default(),
            control: vec![0.0; environment.action_size()],
            reward: 0.0,
            flags: 0,
            ended: None,
            last_observation: vec![0.0; environment.observation_size()],
            precision: Precision::F32,
            environment,
        }
    }

    fn begin_step(&mut self, action: &[f32]) {
        self.environment.action_from_shares(action, &mut self.control);
        self.environment.begin_step(&self.control);
    }

    fn finish_step(&mut self, seeds: &ResetSeeds, observation: &mut [f32], reward_sums: &mut [(&'static str, f64)]) {
        let step = self.environment.finish_step(observation);
        self.precision.round(observation);
        let progress = &mut self.progress;
        progress.length += 1;
        // The reward of a step whose physics failed is meaningless.
        self.reward = if step.fault { 0.0 } else { step.reward };
        progress.return_sum += f64::from(self.reward);
        if !step.fault {
            // Position of the torso: the task's info may measure another point.
            progress.last_x_m = self.environment.physics().position()[0];
            let mut sums = reward_sums.iter_mut();
            self.environment.task().reward_terms(&mut |_, term| {
                if let Some((_, sum)) = sums.next() {
                    *sum += term;
                }
            });
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
        let distance_m = progress.last_x_m - progress.start_x_m;
        let difficulty = self.environment.task().difficulty();
        self.ended = Some(Episode {
            return_sum: progress.return_sum,
            length: progress.length,
            distance_m,
            velocity_mean_mps: distance_m / (f64::from(progress.length) * self.environment.control_step_s()),
            cause,
            ground_level: difficulty.ground_level,
            command_factor: difficulty.command_factor,
        });
        self.reset(seeds, observation);
    }

    fn reset(&mut self, seeds: &ResetSeeds, observation: &mut [f32]) {
        let number = self.progress.number;
        self.environment.reset(seeds.of(self.env, number), observation);
        self.precision.round(observation);
        let x_m = self.environment.physics().position()[0];
        self.progress =
            EpisodeProgress { number: number + 1, start_x_m: x_m, last_x_m: x_m, ..EpisodeProgress::default() };
    }
}
