//! One humanoid in one Rapier world, as named quantities.
//!
//! Nothing here knows about rewards or episodes. Rapier is named in this module only.

mod contact;
mod convert;
mod drive;
mod kinematics;
mod world;

use nalgebra::{Isometry3, Point3, Vector3};

pub use self::contact::ContactForce;
use self::contact::ContactImpulse;
pub use self::kinematics::BodyMotion;
use self::kinematics::ChainMotion;
use self::world::World;
use crate::config::{CONTROL_STEP_S, EnvironmentConfig};
use crate::error::ModelError;
use crate::model::Model;

/// The simulation produced a number that is not finite; only [`Physics::set_state`] makes it usable again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the physics state is not finite")]
pub struct PhysicsFault;

/// How well the joints hold at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointQuality {
    /// Largest distance between the two ends of a joint (m).
    pub separation_m: f64,
    /// Largest angle by which a hinge is outside its range (rad).
    pub limit_overshoot_rad: f64,
}

/// A simulated humanoid.
pub struct Physics {
    model: Model,
    world: World,
    substeps: u32,
    motions: Vec<BodyMotion>,
    chains: Vec<ChainMotion>,
    position: Vec<f64>,
    velocity: Vec<f64>,
    contacts: Vec<ContactImpulse>,
    hinge_torques_nm: Vec<f64>,
    body_torques: Vec<Vector3<f64>>,
    is_faulty: bool,
}

impl Physics {
    /// Builds a world for a model, at rest in its nominal pose.
    ///
    /// # Errors
    /// [`ModelError`] if a setting is out of range.
    pub fn new(model: Model, config: &EnvironmentConfig) -> Result<Self, ModelError> {
        config.check()?;
        let bodies = model.bodies.len();
        let mut physics = Self {
            world: World::new(&model, config),
            substeps: config.substeps,
            motions: vec![BodyMotion::still(Isometry3::identity()); bodies],
            chains: vec![ChainMotion::default(); bodies],
            position: vec![0.0; model.position_size()],
            velocity: vec![0.0; model.velocity_size()],
            contacts: vec![ContactImpulse::default(); model.links.len()],
            hinge_torques_nm: vec![0.0; model.hinges.len()],
            body_torques: vec![Vector3::zeros(); bodies],
            is_faulty: false,
            model,
        };
        let (position, velocity) = (physics.model.nominal_position(), vec![0.0; physics.model.velocity_size()]);
        physics.set_state(&position, &velocity);
        Ok(physics)
    }

    /// Starts afresh from a position and a velocity vector (see [`Self::position`] and [`Self::velocity`]).
    ///
    /// Nothing of what was simulated before has any influence on what follows.
    ///
    /// # Panics
    /// If a vector has the wrong length.
    pub fn set_state(&mut self, position: &[f64], velocity: &[f64]) {
        assert_eq!(position.len(), self.model.position_size(), "position vector has the wrong length");
        assert_eq!(velocity.len(), self.model.velocity_size(), "velocity vector has the wrong length");
        kinematics::place(&self.model, position, velocity, &mut self.motions);
        self.world.restore(&self.motions);
        self.contacts.fill(ContactImpulse::default());
        self.hinge_torques_nm.fill(0.0);
        self.is_faulty = false;
        self.refresh();
    }

    /// Holds the motors' controls, one number per motor: see [`Self::joint_torques_nm`]. No time passes.
    ///
    /// Controls are clamped to ± [`Model::control_limit`].
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
        let limit = self.model.control_limit;
        self.hinge_torques_nm.fill(0.0);
        for (motor, &control) in self.model.motors.iter().zip(controls) {
            self.hinge_torques_nm[motor.hinge] += motor.gear_nm * f64::from(control).clamp(-limit, limit);
        }
        Ok(())
    }

    /// Replaces the contact forces of the last control step by others, for observations of a state of choice.
    ///
    /// # Panics
    /// If a link does not exist.
    pub fn set_contacts(&mut self, forces: &[ContactForce]) {
        self.contacts.fill(ContactImpulse::default());
        let about = self.centre_of_mass();
        for force in forces {
            let impulse = force.force_n * CONTROL_STEP_S;
            contact::push(force.links, force.at_m.coords, impulse, &about, &mut self.contacts);
        }
    }

    /// Simulates one control step of [`CONTROL_STEP_S`] with the motors' controls held, one number per motor.
    ///
    /// Controls are clamped to ± [`Model::control_limit`].
    ///
    /// # Errors
    /// [`PhysicsFault`] if anything is not finite; the named quantities then keep their values of the last physics
    /// step that was.
    ///
    /// # Panics
    /// If there are not as many controls as motors.
    pub fn step_only(&mut self, controls: &[f32]) -> Result<(), PhysicsFault> {
        self.set_controls(controls)?;
        self.contacts.fill(ContactImpulse::default());
        for _ in 0..self.substeps {
            self.substep()?;
        }
        Ok(())
    }

    fn substep(&mut self) -> Result<(), PhysicsFault> {
        drive::prepare(
            &mut self.world,
            &self.model,
            &self.motions,
            &self.chains,
            &self.hinge_torques_nm,
            &mut self.body_torques,
        );
        let about = self.centre_of_mass();
        self.world.rapier.step();
        if !self.world.is_sound() {
            self.is_faulty = true;
            return Err(PhysicsFault);
        }
        contact::accumulate(&self.world, &about, &mut self.contacts);
        self.refresh();
        Ok(())
    }

    /// Brings the named quantities up to date with Rapier.
    fn refresh(&mut self) {
        self.world.read(&mut self.motions);
        kinematics::read(&self.model, &self.motions, &mut self.chains, &mut self.position, &mut self.velocity);
    }

    /// The model that is simulated.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Position vector: root x, y, z (m), root quaternion w, x, y, z, one angle per hinge (rad).
    #[must_use]
    pub fn position(&self) -> &[f64] {
        &self.position
    }

    /// Velocity vector: root velocity in the world frame (m/s), root angular velocity in the torso's frame (rad/s),
    /// one rate per hinge (rad/s).
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Angle of each hinge (rad), in position order.
    #[must_use]
    pub fn joint_angles(&self) -> &[f64] {
        &self.position[7..]
    }

    /// Rate of each hinge (rad/s), in position order.
    #[must_use]
    pub fn joint_rates(&self) -> &[f64] {
        &self.velocity[6..]
    }

    /// Torque of each hinge's motor during the last step (N·m), in position order.
    #[must_use]
    pub fn joint_torques_nm(&self) -> &[f64] {
        &self.hinge_torques_nm
    }

    /// Height of the torso's frame above the floor (m).
    #[must_use]
    pub fn torso_height_m(&self) -> f64 {
        self.position[2]
    }

    /// Pose and velocity of every body, in the order of [`Model::bodies`].
    #[must_use]
    pub fn body_motions(&self) -> &[BodyMotion] {
        &self.motions
    }

    /// Centre of mass of the whole body (m, world frame).
    #[must_use]
    pub fn centre_of_mass(&self) -> Point3<f64> {
        Point3::from(self.mass_average(|body, motion| (motion.pose * body.centre_of_mass_m).coords))
    }

    /// Velocity of the centre of mass of the whole body (m/s, world frame).
    #[must_use]
    pub fn centre_of_mass_velocity(&self) -> Vector3<f64> {
        self.mass_average(|_, motion| motion.linear_mps)
    }

    fn mass_average(&self, of: impl Fn(&crate::model::Body, &BodyMotion) -> Vector3<f64>) -> Vector3<f64> {
        let (mut sum, mut mass_kg) = (Vector3::zeros(), 0.0);
        for (body, motion) in self.model.bodies.iter().zip(&self.motions) {
            sum += of(body, motion) * body.mass_kg;
            mass_kg += body.mass_kg;
        }
        sum / mass_kg
    }

    /// Mean contact force (N) and moment about the whole body's centre of mass (N·m) on one link during the last
    /// control step, world frame: what its surroundings do to it.
    ///
    /// # Panics
    /// If there is no such link.
    #[must_use]
    pub fn contact_wrench(&self, link: usize) -> (Vector3<f64>, Vector3<f64>) {
        let impulse = &self.contacts[link];
        (impulse.linear_ns / CONTROL_STEP_S, impulse.angular_nms / CONTROL_STEP_S)
    }

    /// Sum of squares of all links' contact forces (N²) and moments ((N·m)²) during the last control step.
    #[must_use]
    pub fn squared_contact_wrenches(&self) -> f64 {
        self.contacts
            .iter()
            .map(|impulse| impulse.linear_ns.norm_squared() + impulse.angular_nms.norm_squared())
            .sum::<f64>()
            / (CONTROL_STEP_S * CONTROL_STEP_S)
    }

    /// How well the joints hold now.
    #[must_use]
    pub fn joint_quality(&self) -> JointQuality {
        let mut quality = JointQuality::default();
        for (body, motion) in self.model.bodies.iter().zip(&self.motions) {
            let Some(parent) = body.parent else { continue };
            let inner = self.motions[parent].pose * kinematics::parent_anchor(body);
            let separation = nalgebra::distance(&inner, &(motion.pose * body.anchor_m));
            quality.separation_m = quality.separation_m.max(separation);
        }
        for (hinge, &angle) in self.model.hinges.iter().zip(self.joint_angles()) {
            quality.limit_overshoot_rad = quality.limit_overshoot_rad.max(hinge.overshoot_rad(angle));
        }
        quality
    }

    /// Makes one body's velocity NaN, so that the next step faults; for tests of fault handling.
    #[doc(hidden)]
    pub fn poison(&mut self) {
        self.world.poison();
    }
}
