//! Copies of the simulation's state.

use std::sync::Arc;

use super::Physics;
use super::variation::VariableModel;
use crate::config::PhysicsSettings;
use crate::dynamics::World;
use crate::error::SnapshotError;
use crate::model::Model;

/// Everything that the further motion depends on; from [`Physics::snapshot`].
#[derive(Clone)]
pub struct PhysicsSnapshot {
    settings: PhysicsSettings,
    /// The model with its variation.
    model: Model,
    variable: VariableModel,
    world: World,
    controls: Vec<f32>,
    is_faulty: bool,
}

impl Physics {
    /// Copies the present state, including contacts and a variation that is not yet in effect.
    #[must_use]
    pub fn snapshot(&self) -> PhysicsSnapshot {
        PhysicsSnapshot {
            settings: self.settings,
            model: self.model.clone(),
            variable: self.variable.clone(),
            world: self.world.clone(),
            controls: self.controls.clone(),
            is_faulty: self.is_faulty,
        }
    }

    /// Restores a snapshot of this simulation, or of another one with the same model and settings.
    ///
    /// From there the same controls give the same motion, bit for bit.
    ///
    /// # Errors
    /// [`SnapshotError`] if the model or the settings differ; the state is then unchanged.
    pub fn restore(&mut self, snapshot: &PhysicsSnapshot) -> Result<(), SnapshotError> {
        if let Some((setting, taken, found)) = snapshot.settings.difference(self.settings) {
            return Err(SnapshotError::Setting { setting, taken, found });
        }
        let (taken, found) = (&snapshot.variable.nominal, &self.variable.nominal);
        if !Arc::ptr_eq(taken, found)
            && let Some(part) = taken.difference(found)
        {
            return Err(SnapshotError::Model { part });
        }
        self.model.clone_from(&snapshot.model);
        self.variable.clone_from(&snapshot.variable);
        self.world.clone_from(&snapshot.world);
        self.controls.clone_from(&snapshot.controls);
        self.is_faulty = snapshot.is_faulty;
        Ok(())
    }
}
