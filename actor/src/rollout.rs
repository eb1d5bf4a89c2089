//! Fragments: T control steps of N environments under one policy.

use rand_distr::{Distribution, StandardNormal};
use treadmill_policy::gaussian;
use treadmill_proto::{ActorState, Fragment, Precision};
use treadmill_runtime::seeds::Stream;

use crate::{
    ActorError,
    acting::ActingPolicy,
    environments::{Environments, Stepped},
    poses::Camera,
};

/// What every fragment of this actor says of itself.
#[derive(Clone, Debug)]
pub struct Sender {
    /// The run.
    pub run: String,
    /// The actor's name.
    pub actor: String,
    /// Which process of that name.
    pub incarnation: u64,
    /// Hash over configuration and model.
    pub config_hash: u64,
}

/// Collects fragments, one after the other; episodes run on from one to the next.
pub struct Collector {
    environments: Environments,
    noise: Stream,
    steps: u32,
    sender: Sender,
    sequence: u64,
    is_state_attached: bool,
    stepped: Stepped,
    camera: Option<Camera>,
    normalised: Vec<f32>,
    means: Vec<f32>,
    /// `[N][action]`: the exploration noise of the step, in standard deviations.
    normals: Vec<f32>,
}

impl Collector {
    /// A collector of fragments of `steps` control steps.
    pub fn new(environments: Environments, noise: Stream, steps: u32, sender: Sender) -> Self {
        let (envs, action) = (environments.len(), environments.action_size());
        Self {
            noise,
            steps,
            sender,
            sequence: 0,
            is_state_attached: false,
            stepped: Stepped::default(),
            camera: None,
            normalised: Vec::new(),
            means: vec![0.0; envs * action],
            normals: vec![0.0; envs * action],
            environments,
        }
    }

    /// Lets a camera look after each step.
    pub fn with_camera(mut self, camera: Camera) -> Self {
        self.camera = Some(camera);
        self
    }

    /// From now on each fragment says where it leaves the actor, so that a resumed run can go on from there exactly.
    pub fn attach_state(&mut self) {
        self.is_state_attached = true;
    }

    /// Goes on from where a fragment left an actor.
    ///
    /// # Errors
    /// What does not fit, in words; nothing has happened then.
    pub fn go_on(&mut self, state: &ActorState) -> Result<(), String> {
        self.noise = self.environments.go_on(state)?;
        Ok(())
    }

    /// How exactly the observations of its fragments travel.
    pub fn precision(&self) -> Precision {
        self.environments.precision()
    }

    /// Transitions of one fragment.
    pub fn transitions(&self) -> usize {
        self.steps as usize * self.environments.len()
    }

    /// The next fragment, which tells the learner what will not be sent again.
    pub fn collect(&mut self, policy: &ActingPolicy, settled_through: u64) -> Result<Fragment, ActorError> {
        let (envs, width, action_size) =
            (self.environments.len(), self.environments.observation_size(), self.environments.action_size());
        let rows = self.transitions();
        self.sequence += 1;
        let mut fragment = Fragment {
            run: self.sender.run.clone(),
            actor: self.sender.actor.clone(),
            actor_incarnation: self.sender.incarnation,
            sequence: self.sequence,
            version: policy.version,
            config_hash: self.sender.config_hash,
            steps: self.steps,
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
            actor_state: None,
        };
        // What Rapier keeps from step to step is no part of an actor's state, so no fragment begins with any of it.
        self.environments.renew_worlds();
        for t in 0..self.steps {
            let start = fragment.actions.len();
            fragment.observations.extend_from_slice(self.environments.observations());
            self.normals.fill_with(|| StandardNormal.sample(&mut self.noise));
            self.act(policy, &mut fragment)?;
            self.environments.step(&fragment.actions[start..], &mut self.stepped);
            if let Some(camera) = &mut self.camera {
                camera.see(&self.environments, policy.version);
            }
            fragment.rewards.extend_from_slice(&self.stepped.rewards);
            fragment.flags.extend_from_slice(&self.stepped.flags);
            fragment.episodes.append(&mut self.stepped.episodes);
            self.add_last_observations(t, &mut fragment);
        }
        if self.is_state_attached {
            fragment.actor_state = self.environments.save(&self.noise);
            if fragment.actor_state.as_ref().is_some_and(|state| !state.fits()) {
                tracing::warn!(
                    "{envs} environments are too many for their state to be saved: this run cannot be resumed bit for bit; \
                     use fewer"
                );
                self.is_state_attached = false;
                fragment.actor_state = None;
            }
        }
        Ok(fragment)
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

    /// Ordered by step, then by environment; see [`Fragment::needs_last_observation`].
    fn add_last_observations(&mut self, t: u32, fragment: &mut Fragment) {
        let width = self.environments.observation_size();
        let mut truncated = self.stepped.truncated_observations.chunks_exact(width);
        for (env, flags) in self.stepped.flags.iter().enumerate() {
            if flags & treadmill_proto::fragment::TRUNCATED != 0 {
                let last = truncated.next().expect("one observation for each truncated environment");
                fragment.last_observations.extend_from_slice(last);
            } else if Fragment::needs_last_observation(*flags, t, self.steps) {
                let now = &self.environments.observations()[env * width..][..width];
                fragment.last_observations.extend_from_slice(now);
            }
        }
    }
}
