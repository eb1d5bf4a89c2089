//! Bodies that differ from their model, and pushes: what an episode can be made harder with.

use std::sync::Arc;

use nalgebra::Vector3;
use rapier3d::prelude::*;

use super::Physics;
use super::world::{World, mass_properties, own_friction};
use crate::dynamics::Tree;
use crate::model::Model;

/// How the simulated body and its surroundings differ from the model: factors, 1 where nothing differs.
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
    /// On the friction coefficient between body and floor, and on that of limbs that rub.
    pub floor_friction_scale: f64,
    /// On gravity.
    pub gravity_scale: f64,
}

impl Variation {
    /// The variation that changes nothing.
    #[must_use]
    pub fn none(model: &Model) -> Self {
        Self {
            mass_scale: vec![1.0; model.bodies.len()],
            damping_scale: vec![1.0; model.hinges.len()],
            armature_scale: vec![1.0; model.hinges.len()],
            motor_scale: vec![1.0; model.motors.len()],
            floor_friction_scale: 1.0,
            gravity_scale: 1.0,
        }
    }

    /// Writes the figures of `nominal`, varied, into `model`, which is a copy of it; allocates nothing.
    fn apply(&self, nominal: &Model, model: &mut Model) {
        for ((body, nominal), scale) in model.bodies.iter_mut().zip(&nominal.bodies).zip(&self.mass_scale) {
            body.mass_kg = nominal.mass_kg * scale;
            body.inertia_kgm2 = nominal.inertia_kgm2 * *scale;
            // The greater friction of a pair counts, so that of the floor alone would change nothing.
            for (shape, nominal) in body.shapes.iter_mut().zip(&nominal.shapes) {
                shape.friction = nominal.friction * self.floor_friction_scale;
            }
        }
        for (link, nominal) in model.links.iter_mut().zip(&nominal.links) {
            let scale = self.mass_scale[link.body];
            link.mass_kg = nominal.mass_kg * scale;
            link.inertia_kgm2 = nominal.inertia_kgm2 * scale;
        }
        for (index, (hinge, nominal)) in model.hinges.iter_mut().zip(&nominal.hinges).enumerate() {
            hinge.damping_nmsprad = nominal.damping_nmsprad * self.damping_scale[index];
            hinge.armature_kgm2 = nominal.armature_kgm2 * self.armature_scale[index];
        }
        for ((motor, nominal), scale) in model.motors.iter_mut().zip(&nominal.motors).zip(&self.motor_scale) {
            motor.gear_nm = nominal.gear_nm * scale;
        }
        model.floor_friction = nominal.floor_friction * self.floor_friction_scale;
        model.gravity_mps2 = nominal.gravity_mps2 * self.gravity_scale;
    }
}

/// The model as it was read, and the variation that takes effect at the next start.
#[derive(Clone)]
pub(super) struct Variable {
    pub(super) nominal: Arc<Model>,
    pub(super) variation: Variation,
    pub(super) is_due: bool,
}

impl Variable {
    pub(super) fn new(model: &Model) -> Self {
        Self { nominal: Arc::new(model.clone()), variation: Variation::none(model), is_due: false }
    }

    /// Brings model, tree and world up to date with the variation; what is simulated must be placed anew afterwards.
    pub(super) fn take_effect(&mut self, model: &mut Model, tree: &mut Tree, world: &mut World) {
        if std::mem::take(&mut self.is_due) {
            self.variation.apply(&self.nominal, model);
            tree.vary(model);
            world.vary(model);
        }
    }
}

impl Physics {
    /// Varies the body, from the next [`Self::set_state`] until another variation: always relative to the model that
    /// this was built from. [`Self::model`] then tells the varied figures.
    ///
    /// # Panics
    /// If the variation is not of the model's size.
    pub fn set_variation(&mut self, variation: &Variation) {
        let model = &self.model;
        assert_eq!(variation.mass_scale.len(), model.bodies.len(), "one mass scale per body is needed");
        assert_eq!(variation.damping_scale.len(), model.hinges.len(), "one damping scale per hinge is needed");
        assert_eq!(variation.armature_scale.len(), model.hinges.len(), "one armature scale per hinge is needed");
        assert_eq!(variation.motor_scale.len(), model.motors.len(), "one motor scale per motor is needed");
        self.variable.variation.clone_from(variation);
        self.variable.is_due = true;
    }

    /// Adds a velocity (m/s, world frame) to the whole body at once, as a blow that turns nothing would.
    pub fn push(&mut self, velocity_mps: Vector3<f64>) {
        if self.is_faulty {
            return;
        }
        for (rate, change) in self.velocity.iter_mut().zip(velocity_mps.iter()) {
            *rate += change;
        }
        self.describe();
    }
}

impl World {
    /// Lays a model's masses and floor over the template, from which the next episode starts.
    pub(super) fn vary(&mut self, model: &Model) {
        for (handle, body) in self.bodies.iter().zip(&model.bodies) {
            if let Some(rigid) = self.template.bodies.get_mut(*handle) {
                rigid.set_additional_mass_properties(mass_properties(body), false);
            }
        }
        if let Some(floor) = self.template.colliders.get_mut(self.floor) {
            floor.set_friction(model.floor_friction as f32);
        }
        for (handle, body, place) in &self.limbs {
            if let Some(limb) = self.template.colliders.get_mut(*handle) {
                limb.set_friction(own_friction(&model.bodies[*body].shapes[*place]));
            }
        }
    }
}
