//! One humanoid in its world, as named quantities.
//!
//! The state is in joint coordinates, and the equations of motion are ours (see `dynamics`). Rapier's collision detection
//! finds what touches (see `collision`). Several worlds of one model step together, one per lane of a vector register.
//!
//! This module does not depend on rewards or episodes.

mod motion;
mod state;
mod variation;

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Vector3};

pub use self::motion::{BodyMotion, LinkMotion};
use self::variation::VariableModel;
pub use self::variation::Variation;
use crate::articulation::{ROOT_DOFS, ROOT_POSITIONS, Structure};
use crate::collision::CollisionModel;
use crate::config::PhysicsSettings;
use crate::dynamics::{self, Drive, Impulse, Pass, World};
use crate::error::ModelError;
use crate::model::Model;

/// Distance from the edge of a height field at which an episode ends (m), and its greatest share of half a side.
const EDGE_M: f64 = 1.0;
const EDGE_SHARE: f64 = 0.25;

/// Error of a simulation that produced a non-finite number; [`Physics::set_state`] recovers from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the physics state is not finite")]
pub struct PhysicsFault;

/// Force between two links, or between a link and the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce {
    /// Indices into [`crate::Model::links`]; `None` is the ground.
    pub links: [Option<usize>; 2],
    /// Point at which it acts (m, world frame).
    pub at_m: Point3<f64>,
    /// Force on the first link (N, world frame); the opposite acts on the second.
    pub force_n: Vector3<f64>,
}

/// Simulated humanoid.
pub struct Physics {
    model: Model,
    structure: Arc<Structure>,
    collision: Arc<CollisionModel>,
    settings: PhysicsSettings,
    world: World,
    controls: Vec<f32>,
    variable: VariableModel,
    is_faulty: bool,
}

impl Physics {
    /// Builds a world for a model, at rest in its nominal pose; `&EnvironmentConfig` may serve as `settings`.
    ///
    /// # Errors
    /// [`ModelError`] if a setting is out of range.
    pub fn new(model: Model, settings: impl Into<PhysicsSettings>) -> Result<Self, ModelError> {
        let settings = settings.into();
        settings.check()?;
        let structure = Structure::new(&model);
        let collision = CollisionModel::new(&model, &structure, settings.self_collision);
        let mut physics = Self {
            structure: Arc::new(structure),
            collision: Arc::new(collision),
            settings,
            world: World::new(&model),
            controls: vec![0.0; model.motors.len()],
            variable: VariableModel::new(&model),
            is_faulty: false,
            model,
        };
        physics.restart();
        Ok(physics)
    }

    /// Restarts from a position and a velocity vector (see [`Self::position`] and [`Self::velocity`]).
    ///
    /// Earlier simulation does not influence what follows.
    ///
    /// # Panics
    /// If a vector has the wrong length.
    pub fn set_state(&mut self, position: &[f64], velocity: &[f64]) {
        assert_eq!(position.len(), self.model.position_size(), "position vector has the wrong length");
        assert_eq!(velocity.len(), self.model.velocity_size(), "velocity vector has the wrong length");
        self.world.position.copy_from_slice(position);
        self.world.velocity.copy_from_slice(velocity);
        let norm = position[3..ROOT_POSITIONS].iter().map(|part| part * part).sum::<f64>().sqrt();
        self.world.position[3..ROOT_POSITIONS].iter_mut().for_each(|part| *part /= norm);
        self.restart();
    }

    /// Restarts from the present position and velocity.
    fn restart(&mut self) {
        self.variable.apply_if_due(&mut self.model, &mut self.world.parameters);
        self.world.link_impulses.fill(Impulse::default());
        self.world.contacts.clear();
        self.controls.fill(0.0);
        self.update_torques();
        self.is_faulty = false;
        self.refresh();
    }

    /// Updates the bodies from position and velocity.
    fn refresh(&mut self) {
        dynamics::refresh(&self.structure, &self.collision, &mut self.world);
    }

    /// Varies the model that this simulation was built from, from the next [`Self::set_state`] until the next variation.
    ///
    /// From then on, [`Self::model`] returns the varied model.
    ///
    /// # Panics
    /// If the variation does not have the model's size.
    pub fn set_variation(&mut self, variation: &Variation) {
        self.variable.set(variation);
    }

    /// Adds a velocity (m/s, world frame) to all bodies at once, without any rotation.
    pub fn push(&mut self, velocity_mps: Vector3<f64>) {
        if self.is_faulty {
            return;
        }
        for (rate, change) in self.world.velocity.iter_mut().zip(velocity_mps.iter()) {
            *rate += change;
        }
        self.world.bodies.iter_mut().for_each(|body| body.linear_mps += velocity_mps);
    }

    /// Sets the motors' controls, one number per motor, and updates [`Self::joint_torques_nm`]. No time passes.
    ///
    /// Controls are clamped to each motor's [`crate::model::Motor::control`].
    ///
    /// # Errors
    /// [`PhysicsFault`] if one is not finite.
    ///
    /// # Panics
    /// If there are not as many controls as motors.
    pub fn set_controls(&mut self, controls: &[f32]) -> Result<(), PhysicsFault> {
        assert_eq!(controls.len(), self.model.motors.len(), "one control per motor is needed");
        if self.is_faulty || !controls.iter().all(|control| control.is_finite()) {
            self.is_faulty = true;
            return Err(PhysicsFault);
        }
        self.controls.copy_from_slice(controls);
        self.update_torques();
        Ok(())
    }

    /// Updates the motors' torques from controls and state.
    fn update_torques(&mut self) {
        Drive::write(&self.model, &self.controls, &mut self.world.drives);
        self.world.update_torques();
    }

    /// Replaces the contact forces of the last control step, to observe a state of choice.
    ///
    /// # Panics
    /// If a link does not exist.
    pub fn set_contacts(&mut self, forces: &[ContactForce]) {
        self.world.link_impulses.fill(Impulse::default());
        let about_m = self.centre_of_mass();
        for force in forces {
            let linear_ns = force.force_n * self.settings.control_step_s;
            let angular_nms = (force.at_m - about_m).cross(&linear_ns);
            for (link, sign) in force.links.into_iter().zip([1.0, -1.0]) {
                if let Some(link) = link {
                    let impulse = &mut self.world.link_impulses[link];
                    impulse.linear_ns += linear_ns * sign;
                    impulse.angular_nms += angular_nms * sign;
                }
            }
        }
    }

    /// Simulates one control step of [`PhysicsSettings::control_step_s`] with constant controls, one number per motor.
    ///
    /// Controls are clamped to each motor's [`crate::model::Motor::control`].
    ///
    /// # Errors
    /// [`PhysicsFault`] if a number is not finite; the state is then that of the last finite control step.
    ///
    /// # Panics
    /// If there are not as many controls as motors.
    pub fn step_only(&mut self, controls: &[f32]) -> Result<(), PhysicsFault> {
        self.set_controls(controls)?;
        Self::step_together(&mut std::iter::once(&mut *self));
        self.check_step()
    }

    /// Simulates one control step of several simulations with the controls that each has; those with a fault stay as
    /// they are.
    ///
    /// The result of each is the same, bit for bit, as if it had stepped alone. All must have the same model and
    /// settings. The machine simulates [`crate::worlds_per_pass`] of them at once. [`Self::check_step`] must follow for
    /// each.
    // Not generic, so that the engine is compiled once, at this crate's level of optimisation.
    pub fn step_together(simulations: &mut dyn Iterator<Item = &mut Self>) {
        let mut simulations = simulations.filter(|physics| !physics.is_faulty);
        let Some(first) = simulations.next() else { return };
        let (structure, collision, settings) =
            (Arc::clone(&first.structure), Arc::clone(&first.collision), first.settings);
        let step_s = settings.control_step_s / f64::from(settings.substeps);
        let pass = Pass { structure: &structure, collision: &collision, step_s };
        let mut worlds = std::iter::once(first).chain(simulations).map(|physics| &mut physics.world);
        dynamics::advance(pass, &mut worlds, settings.substeps);
    }

    /// Returns whether the last control step gave finite numbers.
    ///
    /// # Errors
    /// [`PhysicsFault`] if it did not, or the controls were not finite.
    pub fn check_step(&mut self) -> Result<(), PhysicsFault> {
        self.is_faulty |= self.world.has_failed;
        if self.is_faulty { Err(PhysicsFault) } else { Ok(()) }
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &PhysicsSettings {
        &self.settings
    }

    /// Returns the simulated model, with the present variation.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Returns the position vector: root x, y, z (m), root quaternion w, x, y, z, one angle per hinge (rad).
    #[must_use]
    pub fn position(&self) -> &[f64] {
        &self.world.position
    }

    /// Returns the velocity vector: root velocity in the world frame (m/s), root angular velocity in the torso's frame
    /// (rad/s), one rate per hinge (rad/s).
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        &self.world.velocity
    }

    /// Returns the angle of each hinge (rad), in position order.
    #[must_use]
    pub fn joint_angles(&self) -> &[f64] {
        &self.world.position[ROOT_POSITIONS..]
    }

    /// Returns the rate of each hinge (rad/s), in position order.
    #[must_use]
    pub fn joint_rates(&self) -> &[f64] {
        &self.world.velocity[ROOT_DOFS..]
    }

    /// Returns the controls that reach the motors, one number per motor; those of the last step that was finite.
    #[must_use]
    pub fn controls(&self) -> &[f32] {
        &self.controls
    }

    /// Returns the torque of each hinge's motors during the last physics step (N·m), in position order.
    #[must_use]
    pub fn joint_torques_nm(&self) -> &[f64] {
        &self.world.torques_nm
    }

    /// Returns the height of the torso's frame above the floor (m).
    #[must_use]
    pub fn torso_height_m(&self) -> f64 {
        self.world.position[2]
    }

    /// Returns the height of the ground at a place (m, world frame); 0 beyond the edges of a height field.
    #[must_use]
    pub fn ground_height_m(&self, x_m: f64, y_m: f64) -> f64 {
        let field = self.model.ground.height_field.as_ref();
        field.and_then(|field| field.height_at(x_m, y_m)).unwrap_or(0.0)
    }

    /// Returns whether the humanoid is so near to the edge of a height field that it would soon fall off.
    #[must_use]
    pub fn is_at_edge(&self) -> bool {
        let [x_m, y_m] = [self.world.position[0], self.world.position[1]];
        self.model.ground.height_field.as_ref().is_some_and(|field| {
            let sides = [(x_m - field.centre_m.x, field.half_x_m), (y_m - field.centre_m.y, field.half_y_m)];
            sides.iter().any(|(place_m, half_m)| place_m.abs() > half_m - EDGE_M.min(EDGE_SHARE * half_m))
        })
    }

    /// Returns pose and velocity of a body, an index into [`Model::bodies`].
    ///
    /// # Panics
    /// If there is no such body.
    #[must_use]
    pub fn body_motion(&self, body: usize) -> BodyMotion {
        self.world.body_motion(body)
    }

    /// Returns pose and velocity of every body, in the order of [`Model::bodies`].
    pub fn body_motions(&self) -> impl Iterator<Item = BodyMotion> {
        (0..self.world.bodies.len()).map(|body| self.world.body_motion(body))
    }

    /// Returns the centre of mass of the whole humanoid (m, world frame).
    #[must_use]
    pub fn centre_of_mass(&self) -> Point3<f64> {
        self.world.centre_of_mass()
    }

    pub(crate) fn world(&self) -> &World {
        &self.world
    }

    /// Returns the velocity of the whole humanoid's centre of mass (m/s, world frame).
    #[must_use]
    pub fn centre_of_mass_velocity(&self) -> Vector3<f64> {
        self.world.mean_over_mass(|body| body.linear_mps)
    }

    /// Returns where the frame of a link is in the world.
    #[must_use]
    pub fn link_pose(&self, link: usize) -> Isometry3<f64> {
        let of = &self.model.links[link];
        self.body_motion(of.body).pose * of.pose
    }

    /// Returns where the frame of a link is in the world, and how it moves.
    #[must_use]
    pub fn link_motion(&self, link: usize) -> LinkMotion {
        let of = &self.model.links[link];
        let body = self.body_motion(of.body);
        let pose = body.pose * of.pose;
        let centre = body.pose * self.model.bodies[of.body].centre_of_mass_m;
        let from_centre_m = pose.translation.vector - centre.coords;
        let linear_mps = body.linear_mps + body.angular_radps.cross(&from_centre_m);
        LinkMotion { pose, linear_mps, angular_radps: body.angular_radps }
    }

    /// Returns the mean contact force (N) on one link during the last control step, and its moment about the whole
    /// humanoid's centre of mass (N·m), in the world frame.
    ///
    /// # Panics
    /// If there is no such link.
    #[must_use]
    pub fn contact_wrench(&self, link: usize) -> (Vector3<f64>, Vector3<f64>) {
        let impulse = &self.world.link_impulses[link];
        (impulse.linear_ns / self.settings.control_step_s, impulse.angular_nms / self.settings.control_step_s)
    }

    /// Returns the points with a contact force in the last physics step, for display.
    ///
    /// Task and observation use [`Self::contact_wrench`] instead.
    pub fn contact_points(&self) -> impl Iterator<Item = ContactForce> {
        self.world.contacts.iter().map(|contact| ContactForce {
            links: contact.links,
            at_m: Point3::from(contact.at_m),
            force_n: contact.force_n,
        })
    }

    /// Returns the sum of squares of all links' contact forces (N²) and moments ((N·m)²) during the last control step.
    #[must_use]
    pub fn squared_contact_wrenches(&self) -> f64 {
        self.world
            .link_impulses
            .iter()
            .map(|impulse| impulse.linear_ns.norm_squared() + impulse.angular_nms.norm_squared())
            .sum::<f64>()
            / self.settings.control_step_s.powi(2)
    }

    /// Returns the largest angle by which a hinge is outside its range (rad).
    #[must_use]
    pub fn limit_overshoot_rad(&self) -> f64 {
        let hinges = self.model.hinges.iter().zip(self.joint_angles());
        hinges.map(|(hinge, angle)| hinge.overshoot_rad(*angle)).fold(0.0, f64::max)
    }

    /// Returns whether a control step received or produced a non-finite number since the last [`Self::set_state`].
    #[must_use]
    pub fn is_faulty(&self) -> bool {
        self.is_faulty
    }

    /// Makes every further control step a fault until the next [`Self::set_state`].
    pub(crate) fn declare_faulty(&mut self) {
        self.is_faulty = true;
    }
}
