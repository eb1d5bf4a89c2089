//! Fragments: T control steps of N environments under one policy.

mod share;

use std::{io, time::Duration};

use rand_distr::{Distribution, StandardNormal};
use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_proto::{ActorState, Fragment, Precision, RewardTerm, WIRE_VERSION, limits::fragment_steps_max};
use treadmill_runtime::{machine, seeds::Stream};

use self::share::Share;
use crate::{
    ActorError,
    acting_policy::ActingPolicy,
    environments::{Environments, state},
    identity::ActorIdentity,
    poses::PoseSampler,
};

/// Collects fragments one after the other; episodes continue from one fragment to the next.
pub struct Collector {
    /// The environments, in their order; each thread acts and steps for a share of them. There is at least one share.
    shares: Vec<Share>,
    /// `None` if the caller's thread collects all.
    pool: Option<ThreadPool>,
    precision: Precision,
    envs: usize,
    observation_size: usize,
    action_size: usize,
    noise: Stream,
    identity: ActorIdentity,
    sequence: u64,
    /// Environment steps simulated so far.
    env_steps: u64,
    is_state_attached: bool,
    /// `[T][N][action]`: exploration noise of a fragment, in standard deviations.
    normals: Vec<f32>,
}

impl Collector {
    /// Creates a collector, which uses the caller's thread.
    pub fn new(environments: Environments, noise: Stream, identity: ActorIdentity) -> Self {
        Self {
            precision: environments.precision(),
            envs: environments.len(),
            observation_size: environments.observation_size(),
            action_size: environments.action_size(),
            shares: vec![Share::new(environments)],
            pool: None,
            noise,
            identity,
            sequence: 0,
            env_steps: 0,
            is_state_attached: false,
            normals: Vec::new(),
        }
    }

    /// Divides the environments among at most this many threads; 0 means one per core. Their number
    /// changes only the rounding of action means, as matrix products of fewer rows may add in another order. A pose
    /// sampler is added afterwards.
    pub fn with_threads(mut self, threads: usize) -> Result<Self, ActorError> {
        let threads = if threads == 0 { machine::cores() } else { threads };
        let shares = self.shares.into_iter().flat_map(|share| share.environments.split(threads));
        self.shares = shares.map(Share::new).collect();
        let pool = ThreadPoolBuilder::new().num_threads(self.shares.len());
        let pool = pool.thread_name(|index| format!("physics-{index}"));
        if self.shares.len() > 1 {
            self.pool = Some(pool.build().map_err(|error| ActorError::ThreadStart(io::Error::other(error)))?);
        }
        Ok(self)
    }

    /// Samples a pose of the first environment after each step.
    pub fn with_pose_sampler(mut self, sampler: PoseSampler) -> Self {
        if let Some(first) = self.shares.first_mut() {
            first.pose_sampler = Some(sampler);
        }
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
        let mut shares: Vec<&mut Environments> = self.shares.iter_mut().map(|share| &mut share.environments).collect();
        self.noise = state::restore(&mut shares, state)?;
        Ok(())
    }

    /// Returns the precision of observations on the wire.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Returns the environment steps per second that simulation and networks would each allow alone, on all threads.
    pub fn speeds(&self) -> [f64; 2] {
        let sum = |of: fn(&Share) -> Duration| self.shares.iter().map(of).sum::<Duration>().as_secs_f64();
        let thread_steps = self.env_steps as f64 * self.shares.len() as f64;
        [sum(|share| share.simulating), sum(|share| share.inferring)].map(|busy_s| thread_steps / busy_s.max(1e-9))
    }

    /// Collects the next fragment, of `steps` control steps, or as many as a message holds. Fragments up to
    /// `settled_through` will not be sent again.
    pub fn collect(&mut self, policy: &ActingPolicy, steps: u32, settled_through: u64) -> Result<Fragment, ActorError> {
        let Self { envs, observation_size, action_size, .. } = *self;
        let steps = steps.min(fragment_steps_max(envs, observation_size, action_size));
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
            observation_size: observation_size as u32,
            action_size: action_size as u32,
            observations: Vec::with_capacity(rows * observation_size),
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
        self.normals.resize(rows * action_size, 0.0);
        self.normals.fill_with(|| StandardNormal.sample(&mut self.noise));
        let normals = &self.normals;
        let collect = |share: &mut Share| share.collect(policy, steps, normals, envs);
        match &self.pool {
            None => self.shares.iter_mut().try_for_each(collect)?,
            Some(pool) => pool.install(|| self.shares.par_iter_mut().try_for_each(collect))?,
        }
        for t in 0..steps as usize {
            self.shares.iter().for_each(|share| share.append_step(t, &mut fragment));
        }
        fragment.reward_terms = self.reward_terms(rows);
        if self.is_state_attached {
            fragment.actor_state = self.saved_state();
        }
        Ok(fragment)
    }

    /// Returns the terms of the reward as means over the `rows` transitions of a fragment. One that is not finite is
    /// left out.
    fn reward_terms(&mut self, rows: usize) -> Vec<RewardTerm> {
        let mut of_shares = self.shares.iter_mut().map(|share| share.environments.take_reward_sums());
        let mut sums = of_shares.next().unwrap_or_default();
        for others in of_shares {
            sums.iter_mut().zip(others).for_each(|((_, sum), (_, more))| *sum += more);
        }
        let means = sums.into_iter().map(|(name, sum)| RewardTerm { name: name.to_owned(), mean: sum / rows as f64 });
        means.filter(|term| term.mean.is_finite()).collect()
    }

    /// Returns the actor's state; if that is too large for a fragment, returns `None` and attaches no further ones.
    fn saved_state(&mut self) -> Option<ActorState> {
        let shares: Vec<&Environments> = self.shares.iter().map(|share| &share.environments).collect();
        let state = state::save(&shares, &self.noise)?;
        if !state.fits() {
            tracing::warn!(
                envs = self.envs,
                "too many environments to save their state: this run cannot be resumed bit for bit; use fewer"
            );
            self.is_state_attached = false;
            return None;
        }
        Some(state)
    }
}
