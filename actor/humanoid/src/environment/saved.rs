//! State of an episode as plain numbers, to continue it in another process.

use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Environment, gymnasium_info};
use crate::error::StateError;

/// State of an episode between two control steps, apart from model and settings.
/// The seed reproduces what the episode drew at its start.
#[derive(Clone, Debug, PartialEq)]
pub struct EpisodeState {
    /// Seed of the episode.
    pub seed: u64,
    /// Control steps since the reset.
    pub steps: u32,
    /// Position vector, see [`crate::Physics::position`].
    pub position: Vec<f64>,
    /// Velocity vector, see [`crate::Physics::velocity`].
    pub velocity: Vec<f64>,
    /// Last observation, with sensor noise.
    pub observation: Vec<f32>,
    /// Actions that may not have reached the motors yet, `[delay + 1][motor]`, newest last.
    pub past_actions: Vec<f32>,
    /// Control steps until the next push.
    pub steps_to_push: u32,
    /// Random streams of sensors, motors and pushes.
    pub streams: [Xoshiro256PlusPlus; 3],
    /// State of the task, see [`crate::task::Task::save`].
    pub task: Vec<f64>,
}

impl Environment {
    /// Returns the episode's state; `None` before the first reset, and after a fault.
    ///
    /// [`Self::resume_episode`] continues bit for bit as this environment does. The state
    /// does not include a variation or state set through [`Self::physics_mut`].
    #[must_use]
    pub fn episode_state(&self) -> Option<EpisodeState> {
        let seed = self.seed.filter(|_| !self.physics.is_faulty())?;
        let (past_actions, steps_to_push, streams) = self.randomiser.progress();
        Some(EpisodeState {
            seed,
            steps: self.episode_steps,
            position: self.physics.position().to_vec(),
            velocity: self.physics.velocity().to_vec(),
            observation: self.last_observation.clone(),
            past_actions,
            steps_to_push,
            streams,
            task: self.task.save(),
        })
    }

    /// Continues an episode of an environment with the same model and settings, and writes its last observation.
    ///
    /// From there the same actions give the same observations and rewards, bit for bit. Until the next step, contact forces,
    /// torques and [`Self::info`] are those after a reset.
    ///
    /// # Errors
    /// [`StateError`] if a length is wrong or a number is invalid; the environment is then unchanged.
    ///
    /// # Panics
    /// If `observation` does not have length [`Self::observation_size`].
    pub fn resume_episode(&mut self, state: &EpisodeState, observation: &mut [f32]) -> Result<(), StateError> {
        self.physics.check_numbers(&state.position, &state.velocity)?;
        check("observation", &state.observation, self.observation_size())?;
        check("past actions", &state.past_actions, self.randomiser.past_size())?;
        self.task.restore(&state.task)?;
        self.seed = Some(state.seed);
        self.randomiser.begin_episode(state.seed, &mut self.physics);
        self.randomiser.resume(&state.past_actions, state.steps_to_push, &state.streams);
        self.physics.resume_from(&state.position, &state.velocity);
        self.episode_steps = state.steps;
        self.was_pushed = false;
        self.last_observation.copy_from_slice(&state.observation);
        self.task.begin(state.seed, &self.physics);
        self.last_info = gymnasium_info(&*self.task);
        self.task.restore(&state.task)?;
        observation.copy_from_slice(&state.observation);
        Ok(())
    }
}

fn check(what: &'static str, numbers: &[f32], expected: usize) -> Result<(), StateError> {
    if numbers.len() != expected {
        return Err(StateError::Length { what, found: numbers.len(), expected });
    }
    match numbers.iter().enumerate().find(|(_, number)| !number.is_finite()) {
        Some((index, &value)) => {
            Err(StateError::NotFinite { what, index, name: format!("entry {index}"), value: value.into() })
        }
        None => Ok(()),
    }
}
