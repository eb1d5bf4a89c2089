//! A body put aside in the middle of its motion.

use std::sync::Arc;

use rapier3d::prelude::*;

use super::Physics;
use super::contact::ContactImpulse;
use super::motion::BodyMotion;
use super::variation::Variable;
use super::world::World;
use crate::config::EnvironmentConfig;
use crate::dynamics::{Motion, Posture};
use crate::error::SnapshotError;
use crate::model::Model;

/// Settings that the motion of a body depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Settings {
    substeps: u32,
    solver_iterations: u32,
    self_collision: bool,
}

impl Settings {
    pub(super) fn of(config: &EnvironmentConfig) -> Self {
        Self {
            substeps: config.substeps,
            solver_iterations: config.solver_iterations,
            self_collision: config.self_collision,
        }
    }

    fn check(&self, here: &Self) -> Result<(), SnapshotError> {
        let pairs = [
            ("substeps", self.substeps.to_string(), here.substeps.to_string()),
            ("solver_iterations", self.solver_iterations.to_string(), here.solver_iterations.to_string()),
            ("self_collision", self.self_collision.to_string(), here.self_collision.to_string()),
        ];
        match pairs.into_iter().find(|(_, taken, found)| taken != found) {
            Some((setting, taken, found)) => Err(SnapshotError::Setting { setting, taken, found }),
            None => Ok(()),
        }
    }
}

/// All that the further motion of a body depends on, as [`Physics::snapshot`] took it.
#[derive(Clone)]
pub struct PhysicsSnapshot {
    settings: Settings,
    /// The model with its variation.
    model: Model,
    variable: Variable,
    rapier: RapierState,
    position: Vec<f64>,
    velocity: Vec<f64>,
    posture: Posture,
    body_velocities: Vec<Motion>,
    motions: Vec<BodyMotion>,
    contacts: Vec<ContactImpulse>,
    controls: Vec<f32>,
    hinge_torques_nm: Vec<f64>,
    is_faulty: bool,
}

/// What Rapier keeps from one step to the next; its pipeline is workspace only.
#[derive(Clone)]
struct RapierState {
    bodies: RigidBodySet,
    colliders: ColliderSet,
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
}

impl Physics {
    /// Puts the body aside as it is now, contacts and a variation to come included.
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
            contacts: self.contacts.clone(),
            controls: self.controls.clone(),
            hinge_torques_nm: self.hinge_torques_nm.clone(),
            is_faulty: self.is_faulty,
        }
    }

    /// Goes back to a snapshot, be it one of this body or of another one that was built from the same model with the same
    /// settings. From there the same controls give the same motion, bit for bit.
    ///
    /// # Errors
    /// [`SnapshotError`] if the model, or a setting that motion depends on, is another one; nothing has happened then.
    pub fn restore(&mut self, snapshot: &PhysicsSnapshot) -> Result<(), SnapshotError> {
        snapshot.settings.check(&self.settings)?;
        let (taken, here) = (&snapshot.variable.nominal, &self.variable.nominal);
        if !Arc::ptr_eq(taken, here)
            && let Some(part) = taken.difference(here)
        {
            return Err(SnapshotError::Model { part });
        }
        self.model.clone_from(&snapshot.model);
        self.variable.clone_from(&snapshot.variable);
        // Tree and template follow the model as it is varied now: the next start changes them only if a variation is due.
        self.tree.vary(&self.model);
        self.world.vary(&self.model);
        self.world.go_back(&snapshot.rapier);
        self.position.clone_from(&snapshot.position);
        self.velocity.clone_from(&snapshot.velocity);
        self.posture.clone_from(&snapshot.posture);
        self.body_velocities.clone_from(&snapshot.body_velocities);
        self.motions.clone_from(&snapshot.motions);
        self.contacts.clone_from(&snapshot.contacts);
        self.controls.clone_from(&snapshot.controls);
        self.hinge_torques_nm.clone_from(&snapshot.hinge_torques_nm);
        self.is_faulty = snapshot.is_faulty;
        Ok(())
    }
}

impl World {
    fn state(&self) -> RapierState {
        RapierState {
            bodies: self.rapier.bodies.clone(),
            colliders: self.rapier.colliders.clone(),
            islands: self.rapier.islands.clone(),
            broad_phase: self.rapier.broad_phase.clone(),
            narrow_phase: self.rapier.narrow_phase.clone(),
        }
    }

    fn go_back(&mut self, state: &RapierState) {
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
