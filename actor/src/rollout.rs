//! Fragments: T control steps of N environments under one policy.

use rand_distr::{Distribution, StandardNormal};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_policy::gaussian;
use treadmill_proto::{ActorState, Fragment, Precision, WIRE_VERSION};
use treadmill_runtime::seeds::Stream;

use crate::{
    ActorError,
    acting_policy::ActingPolicy,
    environments::{Environments, StepResults},
    identity::ActorIdentity,
    poses::PoseSampler,
};

/// Collects fragments one after the other; episodes continue from one fragment to the next.
pub struct Collector {
    environments: Environments,
    noise: Stream,
    identity: ActorIdentity,
    sequence: u64,
    /// Environment steps simulated so far.
    env_steps: u64,
    is_state_attached: bool,
    results: StepResults,
    pose_sampler: Option<PoseSampler>,
    normalised: Vec<f32>,
    means: Vec<f32>,
    /// `[N][action]`: exploration noise of the step, in standard deviations.
    normals: Vec<f32>,
}

impl Collector {
    /// Creates a collector.
    pub fn new(environments: Environments, noise: Stream, identity: ActorIdentity) -> Self {
        let (envs, action) = (environments.len(), environments.action_size());
        Self {
            noise,
            identity,
            sequence: 0,
            env_steps: 0,
            is_state_attached: false,
            results: StepResults::default(),
            pose_sampler: None,
            normalised: Vec::new(),
            means: vec![0.0; envs * action],
            normals: vec![0.0; envs * action],
            environments,
        }
    }

    /// Samples a pose after each step.
    pub fn with_pose_sampler(mut self, sampler: PoseSampler) -> Self {
        self.pose_sampler = Some(sampler);
        self
    }

    /// Attaches the actor's state to each further fragment, from which a resumed run continues bit for bit.
    pub fn attach_state(&mut self) {
        self.is_state_attached = true;
    }

    /// Continues from the state after a fragment.
    ///
    /// # Errors
    /// Returns why the state does not fit; all environments then begin their first episodes.
    pub fn restore_state(&mut self, state: &ActorState) -> Result<(), String> {
        self.noise = self.environments.restore_state(state)?;
        Ok(())
    }

    /// Returns the precision of observations on the wire.
    pub fn precision(&self) -> Precision {
        self.environments.precision()
    }

    /// Collects the next fragment, of `steps` control steps. Fragments up to `settled_through` will not be sent again.
    pub fn collect(&mut self, policy: &ActingPolicy, steps: u32, settled_through: u64) -> Result<Fragment, ActorError> {
        let (envs, width, action_size) =
            (self.environments.len(), self.environments.observation_size(), self.environments.action_size());
        let rows = steps as usize * envs;
        self.sequence += 1;
        self.env_steps += rows as u64;
        let mut fragment = Fragment {
            run: self.identity.run.clone(),
            actor: self.identity.actor.clone(),
            actor_incarnation: self.identity.incarnation,
            sequence: self.sequence,
            version: policy.version,
            config_hash: self.identity.config_hash,
            steps,
            envs: envs as u32,
            observation_size: width as u32,
            action_size: action_size as u32,
            observations: Vec::with_capacity(rows * width),
            actions: Vec::with_capacity(rows * action_size),
            log_probs: Vec::with_capacity(rows),
            rewards: Vec::with_capacity(rows),
            flags: Vec::with_capacity(rows),
            last_observations: Vec::new(),
            episodes: Vec::new(),
            settled_through,
            env_steps: self.env_steps,
            wire_version: WIRE_VERSION,
            physics_version: PHYSICS_VERSION,
            ..Fragment::default()
        };
        // Rapier's internal state is not part of an actor's state, so every fragment starts without it.
        self.environments.renew_worlds();
        for t in 0..steps {
            let start = fragment.actions.len();
            fragment.observations.extend_from_slice(self.environments.observations());
            self.normals.fill_with(|| StandardNormal.sample(&mut self.noise));
            self.act(policy, &mut fragment)?;
            self.environments.step(&fragment.actions[start..], &mut self.results);
            if let Some(sampler) = &mut self.pose_sampler {
                sampler.sample(&self.environments, policy.version);
            }
            fragment.rewards.extend_from_slice(&self.results.rewards);
            fragment.flags.extend_from_slice(&self.results.flags);
            fragment.episodes.append(&mut self.results.episodes);
            self.add_last_observations(t, &mut fragment);
        }
        if self.is_state_attached {
            fragment.actor_state = self.saved_state();
        }
        Ok(fragment)
    }

    /// Returns the actor's state; if that is too large for a fragment, returns `None` and attaches no further ones.
    fn saved_state(&mut self) -> Option<ActorState> {
        let state = self.environments.save_state(&self.noise)?;
        if !state.fits() {
            tracing::warn!(
                envs = self.environments.len(),
                "too many environments to save their state: this run cannot be resumed bit for bit; use fewer"
            );
            self.is_state_attached = false;
            return None;
        }
        Some(state)
    }

    fn act(&mut self, policy: &ActingPolicy, fragment: &mut Fragment) -> Result<(), ActorError> {
        let (envs, action_size) = (self.environments.len(), self.environments.action_size());
        policy.means(self.environments.observations(), envs, &mut self.normalised, &mut self.means)?;
        for (mean, normals) in self.means.chunks_exact(action_size).zip(self.normals.chunks_exact(action_size)) {
            let start = fragment.actions.len();
            fragment.actions.resize(start + action_size, 0.0);
            let action = &mut fragment.actions[start..];
            gaussian::sample(mean, policy.log_std(), normals, action);
            fragment.log_probs.push(gaussian::log_probability(action, mean, policy.log_std()));
        }
        Ok(())
    }

    /// Adds last observations ordered by step, then by environment; see [`Fragment::needs_last_observation`].
    fn add_last_observations(&mut self, t: u32, fragment: &mut Fragment) {
        let width = self.environments.observation_size();
        let mut truncated = self.results.truncated_observations.chunks_exact(width);
        for (env, flags) in self.results.flags.iter().enumerate() {
            if flags & treadmill_proto::fragment::TRUNCATED != 0 {
                let last = truncated.next().expect("one observation for each truncated environment");
                fragment.last_observations.extend_from_slice(last);
            } else if Fragment::needs_last_observation(*flags, t, fragment.steps) {
                let now = &self.environments.observations()[env * width..][..width];
                fragment.last_observations.extend_from_slice(now);
            }
        }
    }
}
