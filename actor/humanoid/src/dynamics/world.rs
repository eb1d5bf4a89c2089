//! State and parameters of one world, as plain numbers.

use nalgebra::{Matrix3, Vector3};

use crate::articulation::{ROOT_DOFS, ROOT_POSITIONS};
use crate::model::Model;

/// Contact points that a world has room for from the start; more of them allocate once.
const CONTACTS_EXPECTED: usize = 64;

/// One simulated robot: what the engine reads and writes.
#[derive(Clone, Debug)]
pub(crate) struct World {
    /// Position vector: root x, y, z (m), root quaternion w, x, y, z, one angle per hinge (rad).
    pub(crate) position: Vec<f64>,
    /// Velocity vector: root velocity (m/s, world axes), root angular velocity (rad/s, root's axes), one rate per hinge
    /// (rad/s).
    pub(crate) velocity: Vec<f64>,
    pub(crate) parameters: Parameters,
    /// Motors of each hinge.
    pub(crate) drives: Vec<Drive>,
    /// Total motor torque of each hinge in the last physics step (N·m).
    pub(crate) torques_nm: Vec<f64>,
    /// Bodies at `position` and `velocity`.
    pub(crate) bodies: Vec<BodyState>,
    /// Impulse of all contacts on each link during the last control step.
    pub(crate) link_impulses: Vec<Impulse>,
    /// Loaded contact points of the last physics step.
    pub(crate) contacts: Vec<ContactLoad>,
    /// Whether the last control step gave a number that is not finite; it then changed nothing else.
    pub(crate) has_failed: bool,
}

/// Quantities of a model that may differ from world to world.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parameters {
    pub(crate) masses_kg: Vec<f64>,
    pub(crate) inertias_kgm2: Vec<Matrix3<f64>>,
    /// Centre of mass of the root body in its frame (m).
    pub(crate) root_centre_m: Vector3<f64>,
    pub(crate) damping_nmsprad: Vec<f64>,
    pub(crate) damping_powers: Vec<[f64; 2]>,
    pub(crate) armature_kgm2: Vec<f64>,
    /// Factor on the friction coefficients of all contacts.
    pub(crate) friction_scale: f64,
    pub(crate) gravity_mps2: Vector3<f64>,
}

/// Motors of one hinge: torque = `torque_nm` − stiffness × angle − damping × rate, within limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Drive {
    pub(crate) torque_nm: f64,
    pub(crate) stiffness_nmprad: f64,
    pub(crate) damping_nmsprad: f64,
    pub(crate) min_nm: f64,
    pub(crate) max_nm: f64,
}

/// Pose and velocity of a rigid body; points are relative to the root's origin, velocities those of the centre of mass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyState {
    pub(crate) rotation: Matrix3<f64>,
    pub(crate) origin_m: Vector3<f64>,
    pub(crate) centre_m: Vector3<f64>,
    pub(crate) linear_mps: Vector3<f64>,
    pub(crate) angular_radps: Vector3<f64>,
}

/// Force × time (N·s) and moment × time (N·m·s) about the whole robot's centre of mass, world axes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Impulse {
    pub(crate) linear_ns: Vector3<f64>,
    pub(crate) angular_nms: Vector3<f64>,
}

/// Loaded contact point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactLoad {
    /// Links; `None` is the ground.
    pub(crate) links: [Option<usize>; 2],
    /// Position (m, world).
    pub(crate) at_m: Vector3<f64>,
    /// Force on the first link (N).
    pub(crate) force_n: Vector3<f64>,
}

impl World {
    pub(crate) fn new(model: &Model) -> Self {
        let hinges = model.hinges.len();
        let body = BodyState {
            rotation: Matrix3::identity(),
            origin_m: Vector3::zeros(),
            centre_m: Vector3::zeros(),
            linear_mps: Vector3::zeros(),
            angular_radps: Vector3::zeros(),
        };
        Self {
            position: model.nominal_position(),
            velocity: vec![0.0; model.velocity_size()],
            parameters: Parameters::of(model),
            drives: vec![Drive::default(); hinges],
            torques_nm: vec![0.0; hinges],
            bodies: vec![body; model.bodies.len()],
            link_impulses: vec![Impulse::default(); model.links.len()],
            contacts: Vec::with_capacity(CONTACTS_EXPECTED),
            has_failed: false,
        }
    }

    /// Updates the motors' torques from position and velocity.
    pub(crate) fn update_torques(&mut self) {
        let rates = self.position[ROOT_POSITIONS..].iter().zip(&self.velocity[ROOT_DOFS..]);
        for ((torque_nm, drive), (angle, rate)) in self.torques_nm.iter_mut().zip(&self.drives).zip(rates) {
            *torque_nm = drive.torque_at(*angle, *rate);
        }
    }
}

impl Parameters {
    fn of(model: &Model) -> Self {
        let mut parameters = Self::default();
        parameters.set(model, 1.0);
        parameters
    }

    /// Copies the quantities of another world of the same model; allocates nothing.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        let Self {
            masses_kg,
            inertias_kgm2,
            root_centre_m,
            damping_nmsprad,
            damping_powers,
            armature_kgm2,
            friction_scale,
            gravity_mps2,
        } = self;
        masses_kg.copy_from_slice(&other.masses_kg);
        inertias_kgm2.copy_from_slice(&other.inertias_kgm2);
        *root_centre_m = other.root_centre_m;
        damping_nmsprad.copy_from_slice(&other.damping_nmsprad);
        damping_powers.copy_from_slice(&other.damping_powers);
        armature_kgm2.copy_from_slice(&other.armature_kgm2);
        *friction_scale = other.friction_scale;
        *gravity_mps2 = other.gravity_mps2;
    }

    /// Copies the quantities of a model; allocates nothing if the last one had the same structure.
    pub(crate) fn set(&mut self, model: &Model, friction_scale: f64) {
        fn copy<T, O>(target: &mut Vec<T>, objects: &[O], quantity: impl Fn(&O) -> T) {
            target.clear();
            target.extend(objects.iter().map(quantity));
        }
        copy(&mut self.masses_kg, &model.bodies, |body| body.mass_kg);
        copy(&mut self.inertias_kgm2, &model.bodies, |body| body.inertia_kgm2);
        copy(&mut self.damping_nmsprad, &model.hinges, |hinge| hinge.damping_nmsprad);
        copy(&mut self.damping_powers, &model.hinges, |hinge| hinge.damping_powers);
        copy(&mut self.armature_kgm2, &model.hinges, |hinge| hinge.armature_kgm2);
        self.root_centre_m = model.bodies[0].centre_of_mass_m.coords;
        self.friction_scale = friction_scale;
        self.gravity_mps2 = model.gravity_mps2;
    }
}

impl Drive {
    /// Writes the motors of each hinge of a model for one control per motor. Clamps controls to [`Motor::control`].
    ///
    /// [`Motor::control`]: crate::model::Motor::control
    pub(crate) fn write(model: &Model, controls: &[f32], drives: &mut [Self]) {
        for (drive, hinge) in drives.iter_mut().zip(&model.hinges) {
            let [min_nm, max_nm] = hinge.torque_nm;
            *drive = Self { min_nm, max_nm, ..Self::default() };
        }
        for (motor, &control) in model.motors.iter().zip(controls) {
            let drive = &mut drives[motor.hinge];
            let [constant, per_length, per_velocity] = motor.bias;
            let force = motor.gain * f64::from(control).clamp(motor.control[0], motor.control[1]) + constant;
            let limits = motor.force.map(|force| motor.gear_nm * force);
            let limits = [limits[0].min(limits[1]), limits[0].max(limits[1])];
            if motor.gear_nm == 0.0 {
                // Infinite limits times 0 are no limits.
                continue;
            }
            if per_length == 0.0 && per_velocity == 0.0 {
                drive.torque_nm += (motor.gear_nm * force).clamp(limits[0], limits[1]);
            } else {
                drive.torque_nm += motor.gear_nm * force;
                drive.stiffness_nmprad -= motor.gear_nm * motor.length_per_rad * per_length;
                drive.damping_nmsprad -= motor.gear_nm * motor.length_per_rad * per_velocity;
                // A hinge rarely has several servos; their limits then hold for the sum.
                drive.min_nm = drive.min_nm.max(limits[0]);
                drive.max_nm = drive.max_nm.min(limits[1]);
            }
        }
        for drive in drives.iter_mut().filter(|drive| drive.stiffness_nmprad == 0.0 && drive.damping_nmsprad == 0.0) {
            drive.torque_nm = drive.torque_nm.max(drive.min_nm).min(drive.max_nm);
        }
    }

    /// Returns the torque (N·m) at an angle (rad) and rate (rad/s) of the hinge.
    fn torque_at(&self, angle_rad: f64, rate_radps: f64) -> f64 {
        (self.torque_nm - self.stiffness_nmprad * angle_rad - self.damping_nmsprad * rate_radps)
            .max(self.min_nm)
            .min(self.max_nm)
    }
}
