//! Defines a task and trains it with every command of `treadmill`: squat to a height that changes from episode to episode.
//!
//! ```sh
//! cargo run --release --example own_task -- train --task squat
//! ```

use std::process::ExitCode;

use treadmill_rl::humanoid::{
    EnvironmentConfig, ModelError, ObservationTerm, Physics, SensorNoise, Task,
    task::{Step, StepEvaluation},
};

/// Heights of the torso that an episode may ask for (m).
const HEIGHTS_M: [f64; 2] = [0.95, 1.35];
/// Height below which an episode ends (m).
const FALLEN_M: f64 = 0.75;
/// Error of the height (m) at which the reward has dropped to 1/e.
const TOLERANCE_M: f64 = 0.1;

/// Holds the torso at a height, above the place where the episode began.
struct Squat {
    target_m: f64,
    terms: Vec<ObservationTerm>,
    /// Terms of the last step's reward, for the logs.
    earned: [(&'static str, f64); 4],
}

impl Squat {
    fn build(_: &EnvironmentConfig, physics: &Physics) -> Result<Box<dyn Task>, ModelError> {
        // The position without x and y, the velocity, and the height asked for.
        let sizes = [("position", physics.position().len() - 2), ("velocity", physics.velocity().len()), ("target", 1)];
        let mut terms: Vec<ObservationTerm> = Vec::new();
        for (name, size) in sizes {
            let start = terms.last().map_or(0, |term| term.range.end);
            terms.push(ObservationTerm { name: name.to_owned(), range: start..start + size, is_privileged: false });
        }
        let earned = [("standing", 0.0), ("tracking", 0.0), ("drift", 0.0), ("effort", 0.0)];
        Ok(Box::new(Self { target_m: HEIGHTS_M[1], terms, earned }))
    }
}

impl Task for Squat {
    fn terms(&self) -> &[ObservationTerm] {
        &self.terms
    }

    fn begin(&mut self, seed: u64, _physics: &Physics) {
        // Seeds are uniform: their upper 53 bits are a number between 0 and 1.
        let share = (seed >> 11) as f64 / (1_u64 << 53) as f64;
        self.target_m = HEIGHTS_M[0] + share * (HEIGHTS_M[1] - HEIGHTS_M[0]);
    }

    fn evaluate(&mut self, step: &Step<'_>) -> StepEvaluation {
        let height_m = step.physics.torso_height_m();
        let effort: f64 = step.action.iter().map(|control| f64::from(*control).powi(2)).sum();
        let drift_mps = step.physics.centre_of_mass_velocity().xy().norm();
        let tracking = (-((height_m - self.target_m) / TOLERANCE_M).powi(2)).exp();
        let terms = [1.0, 4.0 * tracking, -0.5 * drift_mps, -0.1 * effort];
        self.earned.iter_mut().zip(terms).for_each(|((_, earned), term)| *earned = term);
        StepEvaluation { reward: terms.iter().sum::<f64>() as f32, terminated: height_m < FALLEN_M, truncated: false }
    }

    fn reward_terms(&self, each: &mut dyn FnMut(&'static str, f64)) {
        self.earned.iter().for_each(|(name, term)| each(name, *term));
    }

    fn observe(&mut self, physics: &Physics, noise: &mut SensorNoise, observation: &mut [f32]) {
        let positions = physics.position()[2..].iter().map(|position| position + noise.position());
        let mut observation = observation.iter_mut();
        observation.by_ref().zip(positions).for_each(|(entry, position)| *entry = position as f32);
        let velocities = physics.velocity().iter().map(|velocity| velocity + noise.velocity());
        observation.by_ref().zip(velocities).for_each(|(entry, velocity)| *entry = velocity as f32);
        observation.for_each(|entry| *entry = self.target_m as f32);
    }
}

fn main() -> ExitCode {
    treadmill_rl::main(&[("squat", Squat::build)])
}
