//! One humanoid in one Rapier world, as named quantities.
//!
//! Its state is in joint coordinates (see `dynamics`). A physics step has three parts. The *flight* carries the state
//! over the step as if nothing touched. Then Rapier steps the bodies, as free rigid bodies with the velocities that the
//! flight leads to: it finds the contacts and solves them. From there the contact impulses are refined in joint coordinates
//! until the body as a whole answers to them, limits included, and what they do to the state is exact. So the body moves as
//! an articulated body does, and joints never come apart. Rapier's world has no joints: they would cost a third more time,
//! and with this refinement the motion is as near to MuJoCo's without them.
//!
//! Nothing here knows about rewards or episodes. Rapier is named in this module only.

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
use self::snapshot::Settings;
pub use self::state::HINGE_TOLERANCE_RAD;
use self::variation::Variable;
pub use self::variation::Variation;
use self::world::World;
use crate::config::{CONTROL_STEP_S, EnvironmentConfig};
use crate::dynamics::{Contacts, Flight, Motion, Posture, ROOT_DOFS, ROOT_POSITIONS, Tree};
use crate::error::ModelError;
use crate::model::Model;

/// The simulation produced a number that is not finite; only [`Physics::set_state`] makes it usable again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the physics state is not finite")]
pub struct PhysicsFault;

/// How well the joints hold at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointQuality {
    /// Largest angle by which a hinge is outside its range (rad).
    pub limit_overshoot_rad: f64,
}

/// A simulated humanoid.
pub struct Physics {
    model: Model,
    tree: Tree,
    world: World,
    flight: Flight,
    touching: Contacts,
    substeps: u32,
    settings: Settings,
    position: Vec<f64>,
    velocity: Vec<f64>,
    /// Posture at `position`.
    posture: Posture,
    body_velocities: Vec<Motion>,
    motions: Vec<BodyMotion>,
    contacts: Vec<ContactImpulse>,
    /// Where the root was when `touching` was found (m): its points are relative to that.
    touching_about_m: Vector3<f64>,
    controls: Vec<f32>,
    hinge_torques_nm: Vec<f64>,
    variable: Variable,
    is_faulty: bool,
}

impl Physics {
    /// Builds a world for a model, at rest in its nominal pose.
    ///
    /// # Errors
    /// [`ModelError`] if a setting is out of range, or a servo too stiff for the physics step.
    pub fn new(model: Model, config: &EnvironmentConfig) -> Result<Self, ModelError> {
        config.check()?;
        model.check_servos(CONTROL_STEP_S / f64::from(config.substeps))?;
        let bodies = model.bodies.len();
        let tree = Tree::new(&model);
        let mut physics = Self {
            world: World::new(&model, config),
            flight: Flight::new(&tree),
            touching: Contacts::new(&tree),
            substeps: config.substeps,
            settings: Settings::of(config),
            position: vec![0.0; model.position_size()],
            velocity: vec![0.0; model.velocity_size()],
            posture: Posture::new(&tree),
            body_velocities: vec![Motion::default(); bodies],
            motions: vec![BodyMotion::still(); bodies],
            contacts: vec![ContactImpulse::default(); model.links.len()],
            touching_about_m: Vector3::zeros(),
            controls: vec![0.0; model.motors.len()],
            hinge_torques_nm: vec![0.0; model.hinges.len()],
            variable: Variable::new(&model),
            is_faulty: false,
            tree,
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
        self.position.copy_from_slice(position);
        self.velocity.copy_from_slice(velocity);
        let norm = position[3..ROOT_POSITIONS].iter().map(|part| part * part).sum::<f64>().sqrt();
        self.position[3..ROOT_POSITIONS].iter_mut().for_each(|part| *part /= norm);
        self.begin();
    }

    /// Starts afresh from `position` and `velocity` as they are now.
    fn begin(&mut self) {
        self.variable.take_effect(&mut self.model, &mut self.tree, &mut self.world);
        self.world.restore();
        self.contacts.fill(ContactImpulse::default());
        self.touching.points.clear();
        self.controls.fill(0.0);
        self.pull();
        self.is_faulty = false;
        self.posture.lay(&self.tree, &self.position);
        self.posture.weigh(&self.tree);
        self.describe();
    }

    /// Puts a fresh Rapier world below the present state; nothing that can be observed changes.
    ///
    /// Rapier keeps the impulses of the last physics step and where everything was, as first guesses for the next one:
    /// without them the next steps differ in their last digits. From here on, the motion depends on position, velocity,
    /// variation and controls alone, so that it can be gone on with where nothing else was kept.
    pub fn renew_world(&mut self) {
        self.world.restore();
    }

    /// Holds the motors' controls, one number per motor: see [`Self::joint_torques_nm`]. No time passes.
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
        self.pull();
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
            contact::push(force.links, &force.at_m.coords, &impulse, &about.coords, &mut self.contacts);
        }
    }

    /// Simulates one control step of [`CONTROL_STEP_S`] with the motors' controls held, one number per motor.
    ///
    /// Controls are clamped to each motor's [`crate::model::Motor::control`]. A servo's torque follows its hinge from
    /// one physics step to the next.
    ///
    /// # Errors
    /// [`PhysicsFault`] if anything is not finite; the named quantities then keep their values of the last control
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
        self.describe();
        Ok(())
    }

    /// Brings the torques of the motors up to date with controls and state.
    fn pull(&mut self) {
        let (angles_rad, rates_radps) = (&self.position[ROOT_POSITIONS..], &self.velocity[ROOT_DOFS..]);
        self.model.motor_torques(&self.controls, angles_rad, rates_radps, &mut self.hinge_torques_nm);
    }

    fn substep(&mut self) -> Result<(), PhysicsFault> {
        self.pull();
        let step_s = CONTROL_STEP_S / f64::from(self.substeps);
        let Self { tree, world, flight, touching, .. } = self;
        flight.fly(tree, &self.posture, &self.position, &self.velocity, &self.hinge_torques_nm, step_s);
        exchange::send(world, tree, &self.posture, self.position[2], flight, &mut self.body_velocities);
        world.rapier.step();
        if !world.is_sound() {
            self.is_faulty = true;
            return Err(PhysicsFault);
        }
        self.touching_about_m = Vector3::from_column_slice(&self.position[..3]);
        contact::collect(world, &self.posture, self.position[2], touching);
        flight.touch_down(tree, touching, &mut self.position, &mut self.velocity, &mut self.posture, step_s);
        contact::accumulate(touching, &flight.start_centre_m(), &mut self.contacts);
        if !self.position.iter().chain(&self.velocity).all(|number| number.is_finite()) {
            self.is_faulty = true;
            return Err(PhysicsFault);
        }
        Ok(())
    }

    /// Brings the bodies' motion up to date with the state.
    fn describe(&mut self) {
        let root = Vector3::from_column_slice(&self.position[..3]);
        motion::describe(
            &self.tree,
            &self.posture,
            &root,
            &self.velocity,
            &mut self.body_velocities,
            &mut self.motions,
        );
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
        &self.position[ROOT_POSITIONS..]
    }

    /// Rate of each hinge (rad/s), in position order.
    #[must_use]
    pub fn joint_rates(&self) -> &[f64] {
        &self.velocity[ROOT_DOFS..]
    }

    /// Torque of each hinge's motors during the last physics step (N·m), in position order.
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
        let root = Vector3::from_column_slice(&self.position[..3]);
        Point3::from(root + centre_of_mass(&self.tree, &self.posture))
    }

    /// Velocity of the centre of mass of the whole body (m/s, world frame).
    #[must_use]
    pub fn centre_of_mass_velocity(&self) -> Vector3<f64> {
        let sum: Vector3<f64> =
            self.tree.nodes.iter().zip(&self.motions).map(|(node, motion)| motion.linear_mps * node.mass_kg).sum();
        sum / self.tree.mass_kg()
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

    /// The points that touched and pressed during the last physics step, and with which mean force: for those who watch. What
    /// task and observation know of contacts is [`Self::contact_wrench`].
    pub fn contact_points(&self) -> impl Iterator<Item = ContactForce> {
        let about_m = self.touching_about_m;
        let step_s = CONTROL_STEP_S / f64::from(self.substeps);
        let pressing = self.touching.points.iter().filter(|point| point.impulse_ns != Vector3::zeros());
        pressing.map(move |point| ContactForce {
            links: point.links,
            at_m: Point3::from(point.place_m + about_m),
            // The solver counts what the second one feels.
            force_n: -point.impulse_ns / step_s,
        })
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
        for (hinge, &angle) in self.model.hinges.iter().zip(self.joint_angles()) {
            quality.limit_overshoot_rad = quality.limit_overshoot_rad.max(hinge.overshoot_rad(angle));
        }
        quality
    }

    /// Whether a control step produced a number that is not finite, or was given one, since the body was placed.
    #[must_use]
    pub fn is_faulty(&self) -> bool {
        self.is_faulty
    }

    /// Makes the root's velocity NaN, so that the next step faults; for tests of fault handling.
    #[doc(hidden)]
    pub fn poison(&mut self) {
        self.velocity[0] = f64::NAN;
    }
}

/// Centre of mass of the whole body (m, relative to the root's origin).
fn centre_of_mass(tree: &Tree, posture: &Posture) -> Vector3<f64> {
    let sum: Vector3<f64> = tree.nodes.iter().zip(&posture.centres_m).map(|(node, centre)| centre * node.mass_kg).sum();
    sum / tree.mass_kg()
}
