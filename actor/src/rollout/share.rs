//! Share of an actor's environments, which one thread collects.

use std::time::{Duration, Instant};

use treadmill_policy::gaussian;
use treadmill_proto::{Episode, Fragment, fragment::TRUNCATED};

use crate::{
    ActorError,
    acting_policy::ActingPolicy,
    environments::{Environments, StepResults},
    poses::PoseSampler,
};

/// n of an actor's N environments, with what they have collected for a fragment of T steps.
pub(super) struct Share {
    pub(super) environments: Environments,
    pub(super) pose_sampler: Option<PoseSampler>,
    results: StepResults,
    normalised: Vec<f32>,
    means: Vec<f32>,
    /// `[T][n][observation]`
    observations: Vec<f32>,
    /// `[T][n][action]`
    actions: Vec<f32>,
    /// `[T][n]`, like the next two.
    log_probs: Vec<f32>,
    rewards: Vec<f32>,
    flags: Vec<u8>,
    /// Last observations, and for each step the end of its own.
    last_observations: Vec<f32>,
    last_ends: Vec<usize>,
    /// Ended episodes, and for each step the end of its own.
    episodes: Vec<Episode>,
    episode_ends: Vec<usize>,
    /// Time in the networks and in the simulation.
    pub(super) inferring: Duration,
    pub(super) simulating: Duration,
}

impl Share {
    pub(super) fn new(environments: Environments) -> Self {
        Self {
            means: vec![0.0; environments.len() * environments.action_size()],
            environments,
            pose_sampler: None,
            results: StepResults::default(),
            normalised: Vec::new(),
            observations: Vec::new(),
            actions: Vec::new(),
            log_probs: Vec::new(),
            rewards: Vec::new(),
            flags: Vec::new(),
            last_observations: Vec::new(),
            last_ends: Vec::new(),
            episodes: Vec::new(),
            episode_ends: Vec::new(),
            inferring: Duration::ZERO,
            simulating: Duration::ZERO,
        }
    }

    /// Collects `steps` control steps. `normals` is the noise of all `envs` environments of the actor.
    pub(super) fn collect(
        &mut self,
        policy: &ActingPolicy,
        steps: u32,
        normals: &[f32],
        envs: usize,
    ) -> Result<(), ActorError> {
        self.clear();
        let (first, action_size) = (self.environments.first_number(), self.environments.action_size());
        for t in 0..steps {
            let start = self.actions.len();
            self.observations.extend_from_slice(self.environments.observations());
            let begun = Instant::now();
            self.act(policy, &normals[(t as usize * envs + first) * action_size..])?;
            let acted = Instant::now();
            self.environments.step(&self.actions[start..], &mut self.results);
            self.inferring += acted - begun;
            self.simulating += acted.elapsed();
            if let Some(sampler) = &mut self.pose_sampler {
                sampler.sample(&self.environments, policy.version);
            }
            self.rewards.extend_from_slice(&self.results.rewards);
            self.flags.extend_from_slice(&self.results.flags);
            self.episodes.append(&mut self.results.episodes);
            self.episode_ends.push(self.episodes.len());
            self.add_last_observations(t, steps);
            self.last_ends.push(self.last_observations.len());
        }
        Ok(())
    }

    fn clear(&mut self) {
        for plane in [&mut self.observations, &mut self.actions, &mut self.log_probs, &mut self.rewards] {
            plane.clear();
        }
        self.flags.clear();
        self.last_observations.clear();
        self.last_ends.clear();
        self.episodes.clear();
        self.episode_ends.clear();
    }

    /// Draws an action for each environment.
    fn act(&mut self, policy: &ActingPolicy, normals: &[f32]) -> Result<(), ActorError> {
        let (envs, action_size) = (self.environments.len(), self.environments.action_size());
        policy.means(self.environments.observations(), envs, &mut self.normalised, &mut self.means);
        for (mean, normals) in self.means.chunks_exact(action_size).zip(normals.chunks_exact(action_size)) {
            let start = self.actions.len();
            self.actions.resize(start + action_size, 0.0);
            let action = &mut self.actions[start..];
            gaussian::sample(mean, policy.log_std(), normals, action);
            self.log_probs.push(gaussian::log_probability(action, mean, policy.log_std()));
        }
        Ok(())
    }

    /// Adds last observations ordered by environment; see [`Fragment::needs_last_observation`].
    fn add_last_observations(&mut self, t: u32, steps: u32) {
        let width = self.environments.observation_size();
        let mut truncated = self.results.truncated_observations.chunks_exact(width);
        for (env, flags) in self.results.flags.iter().enumerate() {
            if flags & TRUNCATED != 0 {
                let last = truncated.next().expect("one observation for each truncated environment");
                self.last_observations.extend_from_slice(last);
            } else if Fragment::needs_last_observation(*flags, t, steps) {
                let now = &self.environments.observations()[env * width..][..width];
                self.last_observations.extend_from_slice(now);
            }
        }
    }

    /// Appends the rows of step `t` to the planes of a fragment.
    pub(super) fn append_step(&self, t: usize, fragment: &mut Fragment) {
        fn rows<T>(plane: &[T], t: usize, width: usize) -> &[T] {
            &plane[t * width..][..width]
        }
        fn of_step<'a, T>(plane: &'a [T], ends: &[usize], t: usize) -> &'a [T] {
            &plane[t.checked_sub(1).map_or(0, |before| ends[before])..ends[t]]
        }
        let envs = self.environments.len();
        let (observation_size, action_size) = (self.environments.observation_size(), self.environments.action_size());
        fragment.observations.extend_from_slice(rows(&self.observations, t, envs * observation_size));
        fragment.actions.extend_from_slice(rows(&self.actions, t, envs * action_size));
        fragment.log_probs.extend_from_slice(rows(&self.log_probs, t, envs));
        fragment.rewards.extend_from_slice(rows(&self.rewards, t, envs));
        fragment.flags.extend_from_slice(rows(&self.flags, t, envs));
        fragment.last_observations.extend_from_slice(of_step(&self.last_observations, &self.last_ends, t));
        fragment.episodes.extend_from_slice(of_step(&self.episodes, &self.episode_ends, t));
    }
}
