//! Observations: blocks of numbers in Gymnasium's order, under Gymnasium's names.
//!
//! | block | numbers | content, with units |
//! |---|---|---|
//! | `qpos` | 7 + hinges, minus x and y if excluded | root x, y, z (m), root quaternion w, x, y, z, hinge angles (rad) |
//! | `qvel` | 6 + hinges | root velocity in the world frame (m/s), root angular velocity in the root's frame (rad/s), hinge rates (rad/s) |
//! | `cinert` | 10 per link | inertia xx, yy, zz, xy, xz, yz (kg·m²), mass × offset x, y, z (kg·m), mass (kg) |
//! | `cvel` | 6 per link | angular velocity x, y, z (rad/s), velocity x, y, z (m/s) |
//! | `qfrc_actuator` | one per hinge | torque of the hinge's motors (N·m) |
//! | `cfrc_ext` | 6 per link | moment x, y, z (N·m), force x, y, z (N) of the link's contacts |
//!
//! Links are in the model text's order: 13 for the built-in humanoid. `cinert`, `cvel` and `cfrc_ext` are in world axes and
//! about the *centre*, the whole humanoid's centre of mass: the offset is from the centre to the link's centre of mass,
//! and the velocity is that of the link's material point at the centre.
//!
//! | [`EnvObservation`] | blocks | humanoid |
//! |---|---|---|
//! | `Compact` | `qpos`, `qvel` | 45 |
//! | `GymnasiumV5` | all; each of the last four can be excluded | 348 |
//! | `GymnasiumV4` | all, with a row of zeros for the world before the links' rows and six zeros for the root before the torques | 376 |
//!
//! Formulas and order are MuJoCo's (`mj_comPos`, `mj_comVel`, `mj_rnePostConstraint`) and Gymnasium's
//! (`humanoid_v5.py`, `humanoid_v4.py`). Two points differ. All quantities here belong to the end of the control step, while
//! MuJoCo's derived quantities are those of its integrator's last stage. Contact forces are means over the control step,
//! while MuJoCo's are those at its end.
//!
//! With sensor noise, `qpos` and `qvel` are noisy, and all other blocks are computed from these noisy numbers: `cinert` and
//! `cvel` at the sensed state, `qfrc_actuator` as the torques of the present controls there, `cfrc_ext` as exact forces
//! in the frames of the links, which are turned to their sensed orientations. No entry shows what a noisy sensor hides.

mod sensed;
mod spatial;

use std::ops::Range;

pub(crate) use self::sensed::Sensed;
use self::spatial::{SpatialInertia, velocity_about};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

use crate::config::{EnvConfig, EnvObservation};
use crate::dynamics::World;
use crate::model::Model;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::Physics;
use crate::randomisation::SensorNoise;

/// Numbers of the position vector that can be excluded: x and y, because walking must not depend on them.
const EXCLUDABLE: usize = 2;
/// Position of the torso's quaternion, counted from the height; hinge angles, then velocities follow.
const QUATERNION: Range<usize> = 1..5;
/// Degrees of freedom of the root.
const ROOT_FREEDOMS: usize = 6;
/// Numbers of a link's inertia.
const INERTIA_SIZE: usize = 10;
/// Numbers of a link's velocity, and of the wrench on it.
const SPATIAL_SIZE: usize = 6;

/// Consecutive numbers of an observation with one meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObservationTerm {
    /// Name; Gymnasium's in its tasks.
    pub name: String,
    /// Position in the observation.
    pub range: Range<usize>,
    /// Whether only the critic sees it, in training. Such terms come after all others.
    pub is_privileged: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    Position,
    Velocity,
    Inertias,
    Velocities,
    Torques,
    Contacts,
}

/// Motion, torques and contacts that the derived blocks show: the exact ones, or as sensed.
struct View<'a> {
    physics: &'a Physics,
    world: &'a World,
    centre_m: Point3<f64>,
    sensed: Option<&'a Sensed>,
}

/// Layout of an observation for one model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observation {
    /// Blocks under their names in Gymnasium's `observation_structure`.
    terms: Vec<ObservationTerm>,
    /// Quantity that each block shows.
    quantities: Vec<Quantity>,
    /// Whether the blocks include zeros for the world and the root.
    has_world: bool,
    /// Index of the torso's height; the other positions and the velocities follow it.
    height_index: usize,
    /// Number of positions from the height on.
    positions: usize,
    velocities: usize,
}

impl Observation {
    /// Returns the layout that a configuration selects.
    #[must_use]
    pub fn new(config: &EnvConfig, model: &Model) -> Self {
        let has_world = config.observation == EnvObservation::GymnasiumV4;
        let all = config.observation != EnvObservation::Compact;
        let rows = model.links.len() + usize::from(has_world);
        let excluded = if config.exclude_current_positions_from_observation { EXCLUDABLE } else { 0 };
        let torques = model.hinges.len() + if has_world { ROOT_FREEDOMS } else { 0 };
        let quantities = [
            ("qpos", Quantity::Position, model.position_size() - excluded, true),
            ("qvel", Quantity::Velocity, model.velocity_size(), true),
            ("cinert", Quantity::Inertias, rows * INERTIA_SIZE, all && config.include_cinert_in_observation),
            ("cvel", Quantity::Velocities, rows * SPATIAL_SIZE, all && config.include_cvel_in_observation),
            ("qfrc_actuator", Quantity::Torques, torques, all && config.include_qfrc_actuator_in_observation),
            ("cfrc_ext", Quantity::Contacts, rows * SPATIAL_SIZE, all && config.include_cfrc_ext_in_observation),
        ];
        let mut end = 0;
        let (terms, quantities) = quantities
            .into_iter()
            .filter(|(.., included)| *included)
            .map(|(name, quantity, size, _)| {
                let start = end;
                end += size;
                (ObservationTerm { name: name.to_owned(), range: start..end, is_privileged: false }, quantity)
            })
            .unzip();
        Self {
            terms,
            quantities,
            has_world,
            height_index: EXCLUDABLE - excluded,
            positions: model.position_size() - EXCLUDABLE,
            velocities: model.velocity_size(),
        }
    }

    /// Returns the length of the observation.
    #[must_use]
    pub fn size(&self) -> usize {
        self.terms.last().map_or(0, |term| term.range.end)
    }

    /// Returns the blocks, in order.
    #[must_use]
    pub fn terms(&self) -> &[ObservationTerm] {
        &self.terms
    }

    /// Returns the mirror image of an observation, for a robot with this one. Along x and z, vectors keep their sign;
    /// moments and angular velocities, which are pseudo-vectors, keep it along y.
    #[must_use]
    pub fn mirrored(&self, robot: &Mirror) -> SignedPermutation {
        const INERTIA: [f32; INERTIA_SIZE] = [1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, 1.0];
        const SPATIAL: [f32; SPATIAL_SIZE] = [-1.0, 1.0, -1.0, 1.0, -1.0, 1.0];
        let of_links = |signs: &[f32]| -> SignedPermutation {
            let world = usize::from(self.has_world);
            let rows = (0..world).chain(robot.links.iter().map(|link| world + link));
            rows.flat_map(|row| signs.iter().enumerate().map(move |(at, sign)| (row * signs.len() + at, *sign)))
                .collect()
        };
        let without = |reflection: &SignedPermutation, first: usize| -> SignedPermutation {
            reflection[first..].iter().map(|(at, sign)| (at - first, *sign)).collect()
        };
        let image = |(quantity, range): (Quantity, Range<usize>)| {
            let of_block = match quantity {
                Quantity::Position => without(&robot.position, robot.position.len() - range.len()),
                Quantity::Velocity => robot.velocity.clone(),
                Quantity::Inertias => of_links(&INERTIA),
                Quantity::Velocities | Quantity::Contacts => of_links(&SPATIAL),
                Quantity::Torques => without(&robot.velocity, robot.velocity.len() - range.len()),
            };
            of_block.into_iter().map(move |(at, sign)| (range.start + at, sign))
        };
        self.blocks().flat_map(image).collect()
    }

    /// Returns quantity and position of each block, in order.
    fn blocks(&self) -> impl Iterator<Item = (Quantity, Range<usize>)> {
        self.quantities.iter().copied().zip(self.terms.iter().map(|term| term.range.clone()))
    }

    /// Writes an observation of the present state. Allocates nothing.
    ///
    /// # Panics
    /// If `observation` does not have length [`Self::size`], or `physics` simulates another model.
    pub fn write(&self, physics: &Physics, observation: &mut [f32]) {
        assert_eq!(observation.len(), self.size(), "observation buffer has the wrong length");
        let view = View { physics, world: physics.world(), centre_m: physics.centre_of_mass(), sensed: None };
        for (quantity, range) in self.blocks() {
            let target = &mut observation[range];
            match quantity {
                Quantity::Position => {
                    let position = physics.position();
                    copy(&position[position.len() - target.len()..], target);
                }
                Quantity::Velocity => copy(physics.velocity(), target),
                derived => self.write_derived(derived, &view, target),
            }
        }
    }

    /// Adds sensor noise to the positions and velocities, except x and y; [`Self::write_sensed`] then computes the
    /// other blocks from them.
    pub(crate) fn add_noise(&self, noise: &mut SensorNoise, observation: &mut [f32]) {
        let observation = &mut observation[self.height_index..];
        if noise.has_positions() {
            let height = 0..QUATERNION.start;
            for index in height.chain(QUATERNION.end..self.positions) {
                observation[index] += noise.position() as f32;
            }
            let rotation_rad = Vector3::from_fn(|_, _| noise.position());
            rotate(&mut observation[QUATERNION], rotation_rad);
        }
        if noise.has_velocities() {
            for entry in &mut observation[self.positions..][..self.velocities] {
                *entry += noise.velocity() as f32;
            }
        }
    }

    /// Computes all derived blocks again from the positions and velocities in `observation`, which have sensor noise.
    pub(crate) fn write_sensed(&self, physics: &Physics, sensed: &mut Sensed, observation: &mut [f32]) {
        for (quantity, range) in self.blocks() {
            let entries = &observation[range];
            match quantity {
                Quantity::Position => {
                    let excluded = sensed.position.len() - entries.len();
                    sensed.position[..excluded].copy_from_slice(&physics.position()[..excluded]);
                    widen(entries, &mut sensed.position[excluded..]);
                }
                Quantity::Velocity => widen(entries, &mut sensed.velocity),
                _ => {}
            }
        }
        sensed.update(physics);
        let view =
            View { physics, world: &sensed.world, centre_m: sensed.world.centre_of_mass(), sensed: Some(sensed) };
        for (quantity, range) in self.blocks() {
            self.write_derived(quantity, &view, &mut observation[range]);
        }
    }

    /// Returns whether there is any block besides positions and velocities.
    pub(crate) fn has_derived_blocks(&self) -> bool {
        self.quantities.iter().any(|quantity| !matches!(quantity, Quantity::Position | Quantity::Velocity))
    }

    /// Writes a block unless it is the positions or the velocities.
    fn write_derived(&self, quantity: Quantity, view: &View<'_>, target: &mut [f32]) {
        match quantity {
            Quantity::Position | Quantity::Velocity => {}
            Quantity::Torques => copy(&view.world.torques_nm, self.after_world(target, ROOT_FREEDOMS)),
            Quantity::Inertias => self.write_inertias(view, target),
            Quantity::Velocities => self.write_velocities(view, target),
            Quantity::Contacts => self.write_contacts(view, target),
        }
    }

    /// Sets the world's numbers to zero, if there are any, and returns the rest.
    fn after_world<'a>(&self, target: &'a mut [f32], size: usize) -> &'a mut [f32] {
        let (world, rest) = target.split_at_mut(if self.has_world { size } else { 0 });
        world.fill(0.0);
        rest
    }

    fn write_inertias(&self, view: &View<'_>, target: &mut [f32]) {
        let rows = self.after_world(target, INERTIA_SIZE).chunks_exact_mut(INERTIA_SIZE);
        for (link, row) in view.physics.model().links.iter().zip(rows) {
            let pose = &view.world.body_motion(link.body).pose;
            copy(&SpatialInertia::of_link(link, pose, &view.centre_m).numbers(), row);
        }
    }

    fn write_velocities(&self, view: &View<'_>, target: &mut [f32]) {
        let model = view.physics.model();
        let rows = self.after_world(target, SPATIAL_SIZE).chunks_exact_mut(SPATIAL_SIZE);
        for (link, row) in model.links.iter().zip(rows) {
            let motion = &view.world.body_motion(link.body);
            copy(velocity_about(&view.centre_m, &model.bodies[link.body], motion).as_slice(), row);
        }
    }

    fn write_contacts(&self, view: &View<'_>, target: &mut [f32]) {
        let rows = self.after_world(target, SPATIAL_SIZE).chunks_exact_mut(SPATIAL_SIZE);
        for (link, row) in rows.enumerate() {
            let (force, moment) = match view.sensed {
                Some(sensed) => sensed.contact_wrench(view.physics, link),
                None => view.physics.contact_wrench(link),
            };
            copy(moment.as_slice(), &mut row[..3]);
            copy(force.as_slice(), &mut row[3..]);
        }
    }
}

/// Rotates a quaternion w, x, y, z by a rotation vector (rad) in the body's frame, without changing its sign.
fn rotate(entries: &mut [f32], rotation_rad: Vector3<f64>) {
    let [w, x, y, z] = [0, 1, 2, 3].map(|index| f64::from(entries[index]));
    let rotated = Quaternion::new(w, x, y, z) * UnitQuaternion::from_scaled_axis(rotation_rad).into_inner();
    for (entry, part) in entries.iter_mut().zip([rotated.w, rotated.i, rotated.j, rotated.k]) {
        *entry = part as f32;
    }
}

fn widen(numbers: &[f32], target: &mut [f64]) {
    debug_assert_eq!(numbers.len(), target.len());
    for (slot, number) in target.iter_mut().zip(numbers) {
        *slot = f64::from(*number);
    }
}

fn copy(numbers: &[f64], target: &mut [f32]) {
    debug_assert_eq!(numbers.len(), target.len());
    for (slot, number) in target.iter_mut().zip(numbers) {
        *slot = *number as f32;
    }
}
