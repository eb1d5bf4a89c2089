//! One humanoid in one Rapier world, as named quantities.
//!
//! The state is in joint coordinates (see `dynamics`). A physics step has three parts:
//!
//! 1. The *flight* integrates the state over the step without contacts.
//! 2. Rapier steps the bodies as free rigid bodies at the flight's final velocities. It detects the contacts and solves them.
//! 3. The contact impulses are refined in joint coordinates, together with the hinge limits, and applied to the state.
//!
//! Therefore joints cannot come apart. Rapier's world has no joints: they would take a third more time and bring the motion no
//! closer to MuJoCo's.
//!
//! This module does not depend on rewards or episodes. Only this module names Rapier.

mod contact;
mod convert;
mod exchange;
mod motion;
mod snapshot;
mod state;
mod variation;
mod world;

use nalgebra::{Point3, Vector3};

pub use self::contact::ContactForce;
use self::contact::ContactImpulse;
pub use self::motion::BodyMotion;
pub use self::snapshot::PhysicsSnapshot;
use self::variation::VariableModel;
pub use self::variation::Variation;
use self::world::RapierWorld;
use crate::config::{CONTROL_STEP_S, PhysicsSettings};
use crate::dynamics::{Contacts, Flight, Motion, Posture, ROOT_DOFS, ROOT_POSITIONS, Tree};
use crate::error::ModelError;
use crate::model::Model;

/// Error of a simulation that produced a non-finite number; [`Physics::set_state`] recovers from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the physics state is not finite")]
pub struct PhysicsFault;

/// Error of the joints at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointQuality {
    /// Largest angle by which a hinge is outside its range (rad).
    pub limit_overshoot_rad: f64,
}

/// Simulated humanoid.
pub struct Physics {
    model: Model,
    tree: Tree,
    world: RapierWorld,
    flight: Flight,
    contacts: Contacts,
    settings: PhysicsSettings,
    position: Vec<f64>,
    velocity: Vec<f64>,
    /// Posture at `position`.
    posture: Posture,
    body_velocities: Vec<Motion>,
    motions: Vec<BodyMotion>,
    link_impulses: Vec<ContactImpulse>,
    /// Root position when `contacts` were detected (m); their points are relative to it.
    contacts_origin_m: Vector3<f64>,
    controls: Vec<f32>,
    hinge_torques_nm: Vec<f64>,
    variable: VariableModel,
    is_faulty: bool,
}

impl Physics {
    /// Builds a world for a model, at rest in its nominal pose; `&EnvironmentConfig` may serve as `settings`.
    ///
    /// # Errors
    /// [`ModelError`] if a setting is out of range, or a servo too stiff for the physics step.
    pub fn new(model: Model, settings: impl Into<PhysicsSettings>) -> Result<Self, ModelError> {
        let settings = settings.into();
        settings.check()?;
        model.check_servos(CONTROL_STEP_S / f64::from(settings.substeps))?;
        let bodies = model.bodies.len();
        let tree = Tree::new(&model);
        let mut physics = Self {
            world: RapierWorld::new(&model, &settings),
            flight: Flight::new(&tree),
            contacts: Contacts::new(&tree),
            settings,
            position: vec![0.0; model.position_size()],
            velocity: vec![0.0; model.velocity_size()],
            posture: Posture::new(&tree),
            body_velocities: vec![Motion::default(); bodies],
            motions: vec![BodyMotion::at_rest(); bodies],
            link_impulses: vec![ContactImpulse::default(); model.links.len()],
            contacts_origin_m: Vector3::zeros(),
            controls: vec![0.0; model.motors.len()],
            hinge_torques_nm: vec![0.0; model.hinges.len()],
            variable: VariableModel::new(&model),
            is_faulty: false,
            tree,
            model,
        };
        let (position, velocity) = (physics.model.nominal_position(), vec![0.0; physics.model.velocity_size()]);
        physics.set_state(&position, &velocity);
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
        self.position.copy_from_slice(position);
        self.velocity.copy_from_slice(velocity);
        let norm = position[3..ROOT_POSITIONS].iter().map(|part| part * part).sum::<f64>().sqrt();
        self.position[3..ROOT_POSITIONS].iter_mut().for_each(|part| *part /= norm);
        self.restart();
    }

    /// Restarts from the present `position` and `velocity`.
    fn restart(&mut self) {
        self.variable.apply_if_due(&mut self.model, &mut self.tree, &mut self.world);
        self.world.reset();
        self.link_impulses.fill(ContactImpulse::default());
        self.contacts.points.clear();
        self.controls.fill(0.0);
        self.update_torques();
        self.is_faulty = false;
        self.posture.update_kinematics(&self.tree, &self.position);
        self.posture.update_inertia(&self.tree);
        self.update_body_motions();
    }

    /// Replaces the Rapier world by a fresh one; no observable quantity changes.
    ///
    /// Rapier keeps impulses and poses of the last physics step as first guesses; without them the next steps differ in their
    /// last digits. After this call, the motion depends on position, velocity, variation and controls alone: these are enough
    /// to continue it elsewhere.
    pub fn renew_world(&mut self) {
        self.world.reset();
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
        for (rate, change) in self.velocity.iter_mut().zip(velocity_mps.iter()) {
            *rate += change;
        }
        self.update_body_motions();
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

    /// Replaces the contact forces of the last control step, to observe a state of choice.
    ///
    /// # Panics
    /// If a link does not exist.
    pub fn set_contacts(&mut self, forces: &[ContactForce]) {
        self.link_impulses.fill(ContactImpulse::default());
        let about = self.centre_of_mass();
        for force in forces {
            let impulse = force.force_n * CONTROL_STEP_S;
            contact::add_impulse(force.links, &force.at_m.coords, &impulse, &about.coords, &mut self.link_impulses);
        }
    }

    /// Simulates one control step of [`CONTROL_STEP_S`] with constant controls, one number per motor.
    ///
    /// Controls are clamped to each motor's [`crate::model::Motor::control`]. A servo's torque follows its hinge from
    /// one physics step to the next.
    ///
    /// # Errors
    /// [`PhysicsFault`] if a number is not finite; body motions then keep their values of the last finite control step.
    ///
    /// # Panics
    /// If there are not as many controls as motors.
    pub fn step_only(&mut self, controls: &[f32]) -> Result<(), PhysicsFault> {
        self.set_controls(controls)?;
        self.link_impulses.fill(ContactImpulse::default());
        for _ in 0..self.settings.substeps {
            self.substep()?;
        }
        self.update_body_motions();
        Ok(())
    }

    /// Updates the motors' torques from controls and state.
    fn update_torques(&mut self) {
        let (angles_rad, rates_radps) = (&self.position[ROOT_POSITIONS..], &self.velocity[ROOT_DOFS..]);
        self.model.motor_torques(&self.controls, angles_rad, rates_radps, &mut self.hinge_torques_nm);
    }

    fn substep(&mut self) -> Result<(), PhysicsFault> {
        self.update_torques();
        let step_s = self.step_s();
        let Self { tree, world, flight, contacts, .. } = self;
        flight.advance(tree, &self.posture, &self.position, &self.velocity, &self.hinge_torques_nm, step_s);
        exchange::send(world, tree, &self.posture, self.position[2], flight, &mut self.body_velocities);
        world.rapier.step();
        if !world.is_finite() {
            self.is_faulty = true;
            return Err(PhysicsFault);
        }
        self.contacts_origin_m = Vector3::from_column_slice(&self.position[..3]);
        contact::collect(world, &self.posture, self.position[2], contacts);
        flight.solve_constraints(tree, contacts, &mut self.position, &mut self.velocity, &mut self.posture, step_s);
        contact::accumulate(contacts, &flight.start_centre_m(), &mut self.link_impulses);
        if !self.position.iter().chain(&self.velocity).all(|number| number.is_finite()) {
            self.is_faulty = true;
            return Err(PhysicsFault);
        }
        Ok(())
    }

    /// Returns the duration of one physics step (s).
    fn step_s(&self) -> f64 {
        CONTROL_STEP_S / f64::from(self.settings.substeps)
    }

    /// Updates the bodies' motion from the state.
    fn update_body_motions(&mut self) {
        let root = Vector3::from_column_slice(&self.position[..3]);
        let Self { tree, posture, velocity, body_velocities, motions, .. } = self;
        motion::write_motions(tree, posture, &root, velocity, body_velocities, motions);
    }

    /// Returns the simulated model, with the present variation.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Returns the position vector: root x, y, z (m), root quaternion w, x, y, z, one angle per hinge (rad).
    #[must_use]
    pub fn position(&self) -> &[f64] {
        &self.position
    }

    /// Returns the velocity vector: root velocity in the world frame (m/s), root angular velocity in the torso's frame
    /// (rad/s), one rate per hinge (rad/s).
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Returns the angle of each hinge (rad), in position order.
    #[must_use]
    pub fn joint_angles(&self) -> &[f64] {
        &self.position[ROOT_POSITIONS..]
    }

    /// Returns the rate of each hinge (rad/s), in position order.
    #[must_use]
    pub fn joint_rates(&self) -> &[f64] {
        &self.velocity[ROOT_DOFS..]
    }

    /// Returns the torque of each hinge's motors during the last physics step (N·m), in position order.
    #[must_use]
    pub fn joint_torques_nm(&self) -> &[f64] {
        &self.hinge_torques_nm
    }

    /// Returns the height of the torso's frame above the floor (m).
    #[must_use]
    pub fn torso_height_m(&self) -> f64 {
        self.position[2]
    }

    /// Returns pose and velocity of every body, in the order of [`Model::bodies`].
    #[must_use]
    pub fn body_motions(&self) -> &[BodyMotion] {
        &self.motions
    }

    /// Returns the centre of mass of the whole humanoid (m, world frame).
    #[must_use]
    pub fn centre_of_mass(&self) -> Point3<f64> {
        let root = Vector3::from_column_slice(&self.position[..3]);
        let centres = self.tree.nodes.iter().zip(&self.posture.centres_m);
        let sum: Vector3<f64> = centres.map(|(node, centre)| centre * node.mass_kg).sum();
        Point3::from(root + sum / self.tree.mass_kg())
    }

    /// Returns the velocity of the whole humanoid's centre of mass (m/s, world frame).
    #[must_use]
    pub fn centre_of_mass_velocity(&self) -> Vector3<f64> {
        let sum: Vector3<f64> =
            self.tree.nodes.iter().zip(&self.motions).map(|(node, motion)| motion.linear_mps * node.mass_kg).sum();
        sum / self.tree.mass_kg()
    }

    /// Returns the mean contact force (N) on one link during the last control step, and its moment about the whole humanoid's
    /// centre of mass (N·m), in the world frame.
    ///
    /// # Panics
    /// If there is no such link.
    #[must_use]
    pub fn contact_wrench(&self, link: usize) -> (Vector3<f64>, Vector3<f64>) {
        let impulse = &self.link_impulses[link];
        (impulse.linear_ns / CONTROL_STEP_S, impulse.angular_nms / CONTROL_STEP_S)
    }

    /// Returns the points with a contact impulse in the last physics step and their mean forces, for display.
    ///
    /// Task and observation use [`Self::contact_wrench`] instead.
    pub fn contact_points(&self) -> impl Iterator<Item = ContactForce> {
        let origin_m = self.contacts_origin_m;
        let step_s = self.step_s();
        let loaded = self.contacts.points.iter().filter(|point| point.impulse_ns != Vector3::zeros());
        loaded.map(move |point| ContactForce {
            links: point.links,
            at_m: Point3::from(point.position_m + origin_m),
            // The solver's impulse acts on the second link.
            force_n: -point.impulse_ns / step_s,
        })
    }

    /// Returns the sum of squares of all links' contact forces (N²) and moments ((N·m)²) during the last control step.
    #[must_use]
    pub fn squared_contact_wrenches(&self) -> f64 {
        self.link_impulses
            .iter()
            .map(|impulse| impulse.linear_ns.norm_squared() + impulse.angular_nms.norm_squared())
            .sum::<f64>()
            / (CONTROL_STEP_S * CONTROL_STEP_S)
    }

    /// Returns the present error of the joints.
    #[must_use]
    pub fn joint_quality(&self) -> JointQuality {
        let mut quality = JointQuality::default();
        for (hinge, &angle) in self.model.hinges.iter().zip(self.joint_angles()) {
            quality.limit_overshoot_rad = quality.limit_overshoot_rad.max(hinge.overshoot_rad(angle));
        }
        quality
    }

    /// Returns whether a control step received or produced a non-finite number since the last [`Self::set_state`].
    #[must_use]
    pub fn is_faulty(&self) -> bool {
        self.is_faulty
    }

    /// Makes the root's velocity NaN, so that the next step faults; for tests.
    #[doc(hidden)]
    pub fn poison(&mut self) {
        self.velocity[0] = f64::NAN;
    }
}
