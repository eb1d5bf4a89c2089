//! State of the task as plain numbers.

use nalgebra::Vector3;

use super::VelocityTask;
use super::command::Command;
use super::curriculum::{CURRICULUM_SAVED, Curriculum};
use super::feet::FEET;
use super::standing::Standing;
use crate::error::StateError;

/// Numbers of the state that do not depend on the robot: command number and steps, control steps of the episode and of
/// standing, and five numbers of each foot.
const SAVED: usize = 4 + 5 * FEET;

impl VelocityTask {
    /// See [`crate::task::Task::save`].
    pub(super) fn saved_numbers(&self) -> Vec<f64> {
        let counts = [self.drawn_index, self.drawn_left_steps, self.episode_steps, self.standing.steps];
        let mut numbers = counts.map(f64::from).to_vec();
        for foot in &self.feet {
            numbers.push(f64::from(u8::from(foot.stands)));
            numbers.push(foot.air_s);
            numbers.extend(foot.velocity_mps.iter());
        }
        numbers.extend(&self.actions);
        numbers.extend(&self.rates_before_radps);
        numbers.extend(self.command.numbers());
        numbers.extend(self.past.iter().map(|number| f64::from(*number)));
        numbers.extend(self.curriculum.iter().flat_map(Curriculum::save));
        numbers
    }

    /// See [`crate::task::Task::restore`].
    pub(super) fn restore_numbers(&mut self, numbers: &[f64]) -> Result<(), StateError> {
        let (actions, hinges) = (self.actions.len(), self.rates_before_radps.len());
        let of_curriculum = if self.curriculum.is_some() { CURRICULUM_SAVED } else { 0 };
        let expected = SAVED + actions + hinges + 3 + self.past.len() + of_curriculum;
        if numbers.len() != expected {
            return Err(StateError::Length { what: "task", found: numbers.len(), expected });
        }
        let count = |number: f64| number as u32;
        if let (Some(curriculum), Some(saved)) = (&mut self.curriculum, numbers.last_chunk()) {
            curriculum.restore(*saved);
            self.scale_commands();
        }
        self.draw(count(numbers[0]));
        self.drawn_left_steps = count(numbers[1]).clamp(1, self.drawn.steps);
        self.episode_steps = count(numbers[2]);
        self.standing = Standing { steps: count(numbers[3]) };
        for (foot, saved) in self.feet.iter_mut().zip(numbers[4..SAVED].as_chunks::<5>().0) {
            foot.stands = saved[0] != 0.0;
            foot.air_s = saved[1];
            foot.velocity_mps = Vector3::new(saved[2], saved[3], saved[4]);
        }
        let (of_actions, rest) = numbers[SAVED..].split_at(actions);
        let (of_rates, rest) = rest.split_at(hinges);
        let (of_command, of_past) = rest.split_at(3);
        self.actions.copy_from_slice(of_actions);
        self.rates_before_radps.copy_from_slice(of_rates);
        self.command =
            Command { lin_vel_x_mps: of_command[0], lin_vel_y_mps: of_command[1], ang_vel_z_radps: of_command[2] };
        self.observed = (self.command, self.rested_s().is_some());
        self.past.iter_mut().zip(of_past).for_each(|(number, saved)| *number = *saved as f32);
        self.observed_step = Some(self.episode_steps);
        Ok(())
    }
}
