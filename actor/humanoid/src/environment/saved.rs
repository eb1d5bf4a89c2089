//! An episode as plain numbers, to be gone on with in another process.

use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Environment, standing_info};
use crate::error::StateError;

/// What the rest of an episode depends on beside model and settings, between two control steps.
///
/// Less than an [`super::EnvironmentSnapshot`] holds: what the episode drew at its start comes from its seed once more, and
/// Rapier's world is renewed.
#[derive(Clone, Debug, PartialEq)]
pub struct EpisodeState {
    /// Seed of the episode.
    pub seed: u64,
    /// Control steps since the reset.
    pub steps: u32,
    /// See [`crate::Physics::position`].
    pub position: Vec<f64>,
    /// See [`crate::Physics::velocity`].
    pub velocity: Vec<f64>,
    /// What was last observed, with sensor noise.
    pub observation: Vec<f32>,
    /// Actions that may yet arrive at the motors, `[delay + 1][motor]`, the newest last.
    pub past_actions: Vec<f32>,
    /// Control steps to the next push.
    pub steps_to_push: u32,
    /// Random numbers to come: of the sensors, of the motors, of the pushes.
    pub streams: [Xoshiro256PlusPlus; 3],
}

impl Environment {
    /// Puts a fresh Rapier world below the body; see [`crate::Physics::renew_world`].
    pub fn renew_world(&mut self) {
        self.physics.renew_world();
    }

    /// The episode as plain numbers; `None` before the first reset, and after a fault.
    ///
    /// Where [`Self::renew_world`] follows, [`Self::resume_episode`] goes on bit for bit as this environment does.
    /// A variation or state that somebody set through [`Self::physics_mut`] is no part of it.
    #[must_use]
    pub fn episode_state(&self) -> Option<EpisodeState> {
        let seed = self.seed.filter(|_| !self.physics.is_faulty())?;
        let (past_actions, steps_to_push, streams) = self.disturber.progress();
        Some(EpisodeState {
            seed,
            steps: self.episode_steps,
            position: self.physics.position().to_vec(),
            velocity: self.physics.velocity().to_vec(),
            observation: self.last_observation.clone(),
            past_actions,
            steps_to_push,
            streams,
        })
    }

    /// Goes on with an episode of an environment with the same model and settings, and writes what it last observed.
    ///
    /// From there the same actions give the same observations and rewards, bit for bit. Contact forces, torques and
    /// [`Self::info`] are told from the next step on; until then they are those of a body that was just placed.
    ///
    /// # Errors
    /// [`StateError`] if a size does not fit or a number cannot be; nothing has happened then.
    ///
    /// # Panics
    /// If `observation` does not have length [`Self::observation_size`].
    pub fn resume_episode(&mut self, state: &EpisodeState, observation: &mut [f32]) -> Result<(), StateError> {
        self.physics.check_exact(&state.position, &state.velocity)?;
        check("observation", &state.observation, self.observation_size())?;
        check("past actions", &state.past_actions, self.disturber.past_size())?;
        self.seed = Some(state.seed);
        self.disturber.begin_episode(state.seed, &mut self.physics);
        self.disturber.go_on(&state.past_actions, state.steps_to_push, &state.streams);
        self.physics.go_on_from(&state.position, &state.velocity);
        self.episode_steps = state.steps;
        self.last_observation.copy_from_slice(&state.observation);
        self.last_info = standing_info(&self.config, &self.physics);
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
