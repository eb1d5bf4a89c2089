//! N humanoids that step together on the caller's thread, each in its own world, and their episodes.

pub mod state;

use treadmill_humanoid::{
    Environment, EnvironmentConfig, ModelError, TaskRegistry, VectorEnvironment,
    environment::Slot,
    task::{Reached, StepOutcome},
};
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

/// N environments with their episodes.
pub struct Environments {
    vector: VectorEnvironment<Results>,
    seeds: ResetSeeds,
    precision: Precision,
    /// For each term of the reward, its name, and its sum over all environments and steps since it was last taken.
    reward_sums: Vec<(&'static str, f64)>,
}

/// Episode of one environment, with all outputs of its step.
struct Results {
    /// Number of the environment among all of the actor.
    env: usize,
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
        tasks: &TaskRegistry,
        config: &EnvironmentConfig,
        model_xml: &str,
        seeds: SeedSource,
    ) -> Result<Self, ModelError> {
        let results = |env, environment: &Environment| Results {
            env,
            progress: EpisodeProgress::default(),
            control: vec![0.0; environment.action_size()],
            reward: 0.0,
            flags: 0,
            ended: None,
            last_observation: vec![0.0; environment.observation_size()],
        };
        let vector = VectorEnvironment::new(count, || Environment::with_tasks(config, model_xml, tasks), results)?;
        let mut reward_sums = Vec::new();
        if let Some(first) = vector.slots().first() {
            first.environment.task().reward_terms(&mut |name, _| reward_sums.push((name, 0.0)));
        }
        let mut environments = Self { vector, seeds: seeds.reset_seeds(), precision: Precision::F32, reward_sums };
        environments.reset();
        Ok(environments)
    }

    /// Begins with curricula that other environments of the run have reached.
    pub fn adopt_curricula(&mut self, reached: &Reached<'_>) {
        let stream = format!("curricula/{}", self.seeds.actor);
        for (slot, _) in self.vector.rows() {
            let seed = seeds::derive(self.seeds.run_seed, &stream, &[self.seeds.start, slot.kept.env as u64]);
            slot.environment.adopt_curricula(reached, seed);
        }
        self.reset();
    }

    /// Resets all environments to their first episodes.
    fn reset(&mut self) {
        for (slot, observation) in self.vector.rows() {
            slot.kept.progress = EpisodeProgress::default();
            begin_episode(slot, &self.seeds, self.precision, observation);
        }
    }

    /// Rounds every observation before the policy sees it, so that the learner receives the same numbers.
    pub fn with_precision(mut self, precision: Precision) -> Self {
        self.precision = precision;
        self.vector.rows().for_each(|(_, observation)| precision.round(observation));
        self
    }

    /// Returns the precision of observations on the wire.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Divides the environments, in their order, into at most this many shares that can step on different threads. All but
    /// the last have whole passes of the physics.
    pub fn split(self, shares: usize) -> Vec<Self> {
        let Self { vector, seeds, precision, reward_sums } = self;
        let share = |vector| Self { vector, seeds: seeds.clone(), precision, reward_sums: reward_sums.clone() };
        vector.split(shares).into_iter().map(share).collect()
    }

    /// Returns N.
    pub fn len(&self) -> usize {
        self.vector.slots().len()
    }

    /// Returns the number of the first environment among all of the actor.
    pub fn first_number(&self) -> usize {
        self.vector.slots().first().map_or(0, |slot| slot.kept.env)
    }

    /// Returns whether N is 0.
    pub fn is_empty(&self) -> bool {
        self.vector.slots().is_empty()
    }

    /// Returns the number of entries in one observation.
    pub fn observation_size(&self) -> usize {
        self.vector.observation_size()
    }

    /// Returns the number of entries in one action.
    pub fn action_size(&self) -> usize {
        self.vector.action_size()
    }

    /// Returns the present observations, `[N][observation]`; after an episode's end, the first one of the next episode.
    pub fn observations(&self) -> &[f32] {
        self.vector.observations()
    }

    /// Returns the first environment, which observers see.
    pub fn first(&self) -> Option<EnvironmentView<'_>> {
        let Slot { kept: Results { progress, .. }, environment } = self.vector.slots().first()?;
        let EpisodeProgress { number: episode, length: step, start_x_m, .. } = *progress;
        Some(EnvironmentView { episode, step, start_x_m, environment })
    }

    /// Steps all environments by `actions`, `[N][action]`, clipped to −1 and 1, the ends of a motor's range. After the end
    /// of an episode, the next begins in the same step.
    ///
    /// # Panics
    /// If there are not as many actions as environments.
    pub fn step(&mut self, actions: &[f32], results: &mut StepResults) {
        let action_size = self.action_size();
        assert_eq!(actions.len(), self.len() * action_size, "one action for each environment is needed");
        let Self { vector, seeds, precision, reward_sums } = self;
        results.clear();
        for pass in vector.passes() {
            pass.step(
                |index, Slot { environment, kept }| {
                    environment.action_from_shares(&actions[index * action_size..][..action_size], &mut kept.control);
                    environment.begin_step(&kept.control);
                    true
                },
                |_, slot, observation, outcome| {
                    if let Some(step) = outcome {
                        finish_step(slot, &step, *precision, observation, reward_sums);
                        if slot.kept.ended.is_some() {
                            begin_episode(slot, seeds, *precision, observation);
                        }
                    }
                    results.add(&mut slot.kept);
                },
            );
        }
    }

    /// Returns name and sum of each term of the reward, over all environments and steps since the last call. The terms of
    /// failed steps do not count.
    pub fn take_reward_sums(&mut self) -> Vec<(&'static str, f64)> {
        let zeros = self.reward_sums.iter().map(|(name, _)| (*name, 0.0)).collect();
        std::mem::replace(&mut self.reward_sums, zeros)
    }
}

impl StepResults {
    fn clear(&mut self) {
        self.rewards.clear();
        self.flags.clear();
        self.truncated_observations.clear();
        self.episodes.clear();
    }

    /// Moves the outputs of an environment here.
    fn add(&mut self, results: &mut Results) {
        self.rewards.push(results.reward);
        self.flags.push(results.flags);
        if results.flags & TRUNCATED != 0 {
            self.truncated_observations.extend_from_slice(&results.last_observation);
        }
        self.episodes.extend(results.ended.take());
    }
}

/// Notes the outcome of a step, and the episode if it ended.
fn finish_step(
    Slot { environment, kept }: &mut Slot<Results>,
    step: &StepOutcome,
    precision: Precision,
    observation: &mut [f32],
    reward_sums: &mut [(&'static str, f64)],
) {
    precision.round(observation);
    let progress = &mut kept.progress;
    progress.length += 1;
    // The reward of a step whose physics failed is meaningless.
    kept.reward = if step.fault { 0.0 } else { step.reward };
    progress.return_sum += f64::from(kept.reward);
    if !step.fault {
        // Position of the torso: the task's info may measure another point.
        progress.last_x_m = environment.physics().position()[0];
        let mut sums = reward_sums.iter_mut();
        environment.task().reward_terms(&mut |_, term| {
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
            kept.flags = 0;
            return;
        }
    };
    kept.flags = flags;
    kept.last_observation.copy_from_slice(observation);
    let distance_m = progress.last_x_m - progress.start_x_m;
    let difficulty = environment.task().difficulty();
    kept.ended = Some(Episode {
        return_sum: progress.return_sum,
        length: progress.length,
        distance_m,
        velocity_mean_mps: distance_m / (f64::from(progress.length) * environment.control_step_s()),
        cause,
        ground_kind: difficulty.ground_kind,
        ground_level: difficulty.ground_level,
        command_factor: difficulty.command_factor,
        failed_step: difficulty.failed_step,
    });
}

/// Begins the next episode of an environment.
fn begin_episode(
    Slot { environment, kept }: &mut Slot<Results>,
    seeds: &ResetSeeds,
    precision: Precision,
    observation: &mut [f32],
) {
    let number = kept.progress.number;
    environment.reset(seeds.of(kept.env, number), observation);
    precision.round(observation);
    let x_m = environment.physics().position()[0];
    kept.progress = EpisodeProgress { number: number + 1, start_x_m: x_m, last_x_m: x_m, ..EpisodeProgress::default() };
}
