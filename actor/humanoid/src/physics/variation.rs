//! Variation of the simulated model.

use nalgebra::Vector3;

use crate::dynamics::Parameters;
use crate::model::Model;

/// Factors by which humanoid, floor and gravity differ from the model text.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// On mass and inertia, one per body; above 0.
    pub mass_scale: Vec<f64>,
    /// On the viscous friction of each hinge.
    pub damping_scale: Vec<f64>,
    /// On the rotor inertia of each hinge.
    pub armature_scale: Vec<f64>,
    /// On the torque of each motor.
    pub motor_scale: Vec<f64>,
    /// On the stiffness of each servo; one per motor.
    pub kp_scale: Vec<f64>,
    /// On the damping of each servo; one per motor.
    pub kd_scale: Vec<f64>,
    /// Offset of the root body's centre of mass, in its frame (m).
    pub root_centre_offset_m: Vector3<f64>,
    /// On the friction coefficients of the floor and of the links.
    pub floor_friction_scale: f64,
    /// On gravity.
    pub gravity_scale: f64,
}

impl Variation {
    /// Returns the variation that changes nothing.
    #[must_use]
    pub fn none(model: &Model) -> Self {
        Self {
            mass_scale: vec![1.0; model.bodies.len()],
            damping_scale: vec![1.0; model.hinges.len()],
            armature_scale: vec![1.0; model.hinges.len()],
            motor_scale: vec![1.0; model.motors.len()],
            kp_scale: vec![1.0; model.motors.len()],
            kd_scale: vec![1.0; model.motors.len()],
            root_centre_offset_m: Vector3::zeros(),
            floor_friction_scale: 1.0,
            gravity_scale: 1.0,
        }
    }

    /// Writes the varied quantities of `nominal` into `model`, a copy of it; allocates nothing.
    fn apply(&self, nominal: &Model, model: &mut Model) {
        for ((body, nominal), scale) in model.bodies.iter_mut().zip(&nominal.bodies).zip(&self.mass_scale) {
            body.mass_kg = nominal.mass_kg * scale;
            body.inertia_kgm2 = nominal.inertia_kgm2 * *scale;
            // A pair has the greater of both frictions, so scaling that of the floor alone could change nothing.
            for (shape, nominal) in body.shapes.iter_mut().zip(&nominal.shapes) {
                shape.friction = nominal.friction * self.floor_friction_scale;
            }
        }
        for (link, nominal) in model.links.iter_mut().zip(&nominal.links) {
            let scale = self.mass_scale[link.body];
            link.mass_kg = nominal.mass_kg * scale;
            link.inertia_kgm2 = nominal.inertia_kgm2 * scale;
            if link.body == 0 {
                link.centre_of_mass_m = nominal.centre_of_mass_m + self.root_centre_offset_m;
            }
        }
        model.bodies[0].centre_of_mass_m = nominal.bodies[0].centre_of_mass_m + self.root_centre_offset_m;
        for (index, (hinge, nominal)) in model.hinges.iter_mut().zip(&nominal.hinges).enumerate() {
            hinge.damping_nmsprad = nominal.damping_nmsprad * self.damping_scale[index];
            hinge.damping_powers = nominal.damping_powers.map(|power| power * self.damping_scale[index]);
            hinge.armature_kgm2 = nominal.armature_kgm2 * self.armature_scale[index];
        }
        for (index, (motor, nominal)) in model.motors.iter_mut().zip(&nominal.motors).enumerate() {
            let (kp_scale, kd_scale) = (self.kp_scale[index], self.kd_scale[index]);
            let [constant, stiffness, damping] = nominal.bias;
            motor.gear_nm = nominal.gear_nm * self.motor_scale[index];
            motor.bias = [constant, stiffness * kp_scale, damping * kd_scale];
            // The target of a servo acts through its stiffness, or else through its damping.
            motor.gain = match (stiffness != 0.0, damping != 0.0) {
                (true, _) => nominal.gain * kp_scale,
                (false, true) => nominal.gain * kd_scale,
                (false, false) => nominal.gain,
            };
        }
        model.ground.friction = nominal.ground.friction * self.floor_friction_scale;
        model.gravity_mps2 = nominal.gravity_mps2 * self.gravity_scale;
    }
}

/// Model as it was read, and the variation that takes effect at the next restart.
pub(super) struct VariableModel {
    nominal: Model,
    variation: Variation,
    is_due: bool,
}

impl VariableModel {
    pub(super) fn new(model: &Model) -> Self {
        Self { nominal: model.clone(), variation: Variation::none(model), is_due: false }
    }

    /// Sets the variation of the next restart.
    ///
    /// # Panics
    /// If the variation does not have the model's size.
    pub(super) fn set(&mut self, variation: &Variation) {
        let model = &self.nominal;
        assert_eq!(variation.mass_scale.len(), model.bodies.len(), "one mass scale per body is needed");
        assert_eq!(variation.damping_scale.len(), model.hinges.len(), "one damping scale per hinge is needed");
        assert_eq!(variation.armature_scale.len(), model.hinges.len(), "one armature scale per hinge is needed");
        for scales in [&variation.motor_scale, &variation.kp_scale, &variation.kd_scale] {
            assert_eq!(scales.len(), model.motors.len(), "one scale per motor is needed");
        }
        self.variation.clone_from(variation);
        self.is_due = true;
    }

    /// Applies a new variation to model and parameters; the simulation must restart afterwards.
    pub(super) fn apply_if_due(&mut self, model: &mut Model, parameters: &mut Parameters) {
        if std::mem::take(&mut self.is_due) {
            self.variation.apply(&self.nominal, model);
            parameters.set(model, self.variation.floor_friction_scale);
        }
    }
}
