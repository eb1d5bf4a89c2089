//! Several environments that step together.

use super::Environment;
use crate::dynamics::worlds_per_pass;
use crate::lanes::LANES_MAX;
use crate::task::StepOutcome;

/// N environments with the same model and settings, their present observations, and for each a `T` of the owner.
///
/// The machine simulates [`worlds_per_pass`] of them at once; passes may run on different threads. Results do not depend on
/// either.
pub struct VectorEnvironment<T> {
    slots: Vec<Slot<T>>,
    /// `[N][observation]`
    observations: Vec<f32>,
    observation_size: usize,
    action_size: usize,
}

/// An environment, and what the owner keeps for it.
pub struct Slot<T> {
    /// Environment.
    pub environment: Environment,
    /// What the owner keeps.
    pub kept: T,
}

/// Environments that step at once.
pub struct EnvironmentPass<'a, T> {
    /// Index of the first one in its vector.
    pub first: usize,
    slots: &'a mut [Slot<T>],
    observations: &'a mut [f32],
    observation_size: usize,
}

impl<T> VectorEnvironment<T> {
    /// Builds `count` environments; `keep` returns what belongs to the environment of an index.
    ///
    /// # Errors
    /// The first error of `build`.
    pub fn new<E>(
        count: usize,
        build: impl Fn() -> Result<Environment, E>,
        keep: impl Fn(usize, &Environment) -> T,
    ) -> Result<Self, E> {
        let slot = |index| build().map(|environment| Slot { kept: keep(index, &environment), environment });
        let slots = (0..count).map(slot).collect::<Result<Vec<_>, E>>()?;
        let sizes = slots.first().map(|slot| (slot.environment.observation_size(), slot.environment.action_size()));
        let (observation_size, action_size) = sizes.unwrap_or_default();
        Ok(Self { slots, observations: vec![0.0; count * observation_size], observation_size, action_size })
    }

    /// Divides the environments, in their order, into at most this many vectors. All but the last have whole passes.
    #[must_use]
    pub fn split(self, shares: usize) -> Vec<Self> {
        let pass = worlds_per_pass();
        let share = self.slots.len().div_ceil(shares.max(1)).next_multiple_of(pass).max(pass);
        let mut rest = self.slots.into_iter().peekable();
        let mut rows = self.observations.chunks(share * self.observation_size.max(1));
        let mut split = Vec::new();
        while rest.peek().is_some() {
            split.push(Self {
                slots: rest.by_ref().take(share).collect(),
                observations: rows.next().unwrap_or_default().to_vec(),
                ..self
            });
        }
        split
    }

    /// Returns all environments.
    #[must_use]
    pub fn slots(&self) -> &[Slot<T>] {
        &self.slots
    }

    /// Returns all environments, mutable, each with its observation.
    pub fn rows(&mut self) -> impl Iterator<Item = (&mut Slot<T>, &mut [f32])> {
        // Without environments the width is 0, which is no chunk size.
        self.slots.iter_mut().zip(self.observations.chunks_exact_mut(self.observation_size.max(1)))
    }

    /// Returns the present observations, `[N][observation]`.
    #[must_use]
    pub fn observations(&self) -> &[f32] {
        &self.observations
    }

    /// Returns the length of one observation; 0 without environments.
    #[must_use]
    pub fn observation_size(&self) -> usize {
        self.observation_size
    }

    /// Returns the length of one action; 0 without environments.
    #[must_use]
    pub fn action_size(&self) -> usize {
        self.action_size
    }

    /// Returns the environments in groups that step at once.
    pub fn passes(&mut self) -> impl Iterator<Item = EnvironmentPass<'_, T>> {
        let (count, observation_size) = (worlds_per_pass(), self.observation_size.max(1));
        let rows = self.observations.chunks_mut(count * observation_size);
        self.slots.chunks_mut(count).zip(rows).enumerate().map(move |(number, (slots, observations))| EnvironmentPass {
            first: number * count,
            slots,
            observations,
            observation_size,
        })
    }
}

impl<T> EnvironmentPass<'_, T> {
    /// Steps the environments for which `begin` calls [`Environment::begin_step`] and returns true. `finish` takes every one
    /// with its observation, and its outcome if it stepped. Both get the index in the vector. Does not allocate.
    pub fn step(
        self,
        mut begin: impl FnMut(usize, &mut Slot<T>) -> bool,
        mut finish: impl FnMut(usize, &mut Slot<T>, &mut [f32], Option<StepOutcome>),
    ) {
        let Self { first, slots, observations, observation_size } = self;
        let mut steps = [false; LANES_MAX];
        for (index, (slot, steps)) in slots.iter_mut().zip(&mut steps).enumerate() {
            *steps = begin(first + index, slot);
        }
        let stepping = slots.iter_mut().zip(steps).filter(|(_, steps)| *steps);
        Environment::step_together(&mut stepping.map(|(slot, _)| &mut slot.environment));
        let rows = slots.iter_mut().zip(observations.chunks_exact_mut(observation_size)).zip(steps);
        for (index, ((slot, observation), steps)) in rows.enumerate() {
            let outcome = steps.then(|| slot.environment.finish_step(observation));
            finish(first + index, slot, observation, outcome);
        }
    }
}
