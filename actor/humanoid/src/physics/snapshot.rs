//! Copies of the simulation's state.

use std::sync::Arc;

use rapier3d::prelude::*;

use super::Physics;
use super::contact::ContactImpulse;
use super::motion::BodyMotion;
use super::variation::VariableModel;
use super::world::RapierWorld;
use crate::config::PhysicsSettings;
use crate::dynamics::{Motion, Posture};
use crate::error::SnapshotError;
use crate::model::Model;

/// Everything that the further motion depends on; from [`Physics::snapshot`].
#[derive(Clone)]
pub struct PhysicsSnapshot {
    settings: PhysicsSettings,
    /// The model with its variation.
    model: Model,
    variable: VariableModel,
    rapier: RapierState,
    position: Vec<f64>,
    velocity: Vec<f64>,
    posture: Posture,
    body_velocities: Vec<Motion>,
    motions: Vec<BodyMotion>,
    link_impulses: Vec<ContactImpulse>,
    controls: Vec<f32>,
    hinge_torques_nm: Vec<f64>,
    is_faulty: bool,
}

/// State that Rapier keeps from one step to the next; its pipeline is only workspace.
#[derive(Clone)]
struct RapierState {
    bodies: RigidBodySet,
    colliders: ColliderSet,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
}

impl Physics {
    /// Copies the present state, including contacts and a variation that is not yet in effect.
    #[must_use]
    pub fn snapshot(&self) -> PhysicsSnapshot {
        PhysicsSnapshot {
            settings: self.settings,
            model: self.model.clone(),
            variable: self.variable.clone(),
            rapier: self.world.state(),
            position: self.position.clone(),
            velocity: self.velocity.clone(),
            posture: self.posture.clone(),
            body_velocities: self.body_velocities.clone(),
            motions: self.motions.clone(),
            link_impulses: self.link_impulses.clone(),
            controls: self.controls.clone(),
            hinge_torques_nm: self.hinge_torques_nm.clone(),
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
        if let Some((setting, taken, found)) = snapshot.settings.difference(&self.settings) {
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
        // The next restart updates tree and template only if a variation is due.
        self.tree.apply_variation(&self.model);
        self.world.apply_variation(&self.model);
        self.world.restore(&snapshot.rapier);
        self.position.clone_from(&snapshot.position);
        self.velocity.clone_from(&snapshot.velocity);
        self.posture.clone_from(&snapshot.posture);
        self.body_velocities.clone_from(&snapshot.body_velocities);
        self.motions.clone_from(&snapshot.motions);
        self.link_impulses.clone_from(&snapshot.link_impulses);
        self.controls.clone_from(&snapshot.controls);
        self.hinge_torques_nm.clone_from(&snapshot.hinge_torques_nm);
        self.is_faulty = snapshot.is_faulty;
        Ok(())
    }
}

impl RapierWorld {
    fn state(&self) -> RapierState {
        RapierState {
            bodies: self.rapier.bodies.clone(),
            colliders: self.rapier.colliders.clone(),
            islands: self.rapier.islands.clone(),
            broad_phase: self.rapier.broad_phase.clone(),
            narrow_phase: self.rapier.narrow_phase.clone(),
        }
    }

    fn restore(&mut self, state: &RapierState) {
        let world = &mut self.rapier;
        world.bodies.clone_from(&state.bodies);
        world.colliders.clone_from(&state.colliders);
        world.islands.clone_from(&state.islands);
        world.broad_phase.clone_from(&state.broad_phase);
        world.narrow_phase.clone_from(&state.narrow_phase);
        world.physics_pipeline = PhysicsPipeline::new();
        world.ccd_solver = CCDSolver::new();
    }
}
