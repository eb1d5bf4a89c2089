//! What the policy sees: blocks of numbers in Gymnasium's order, under Gymnasium's names.
//!
//! | block | numbers | what, with units |
//! |---|---|---|
//! | `qpos` | 7 + hinges, less x and y where they are left out | root x, y, z (m), root quaternion w, x, y, z, hinge angles (rad) |
//! | `qvel` | 6 + hinges | root velocity in the world frame (m/s), root angular velocity in the root's frame (rad/s), hinge rates (rad/s) |
//! | `cinert` | 10 per link | inertia xx, yy, zz, xy, xz, yz (kg·m²), mass × offset x, y, z (kg·m), mass (kg) |
//! | `cvel` | 6 per link | angular velocity x, y, z (rad/s), velocity x, y, z (m/s) |
//! | `qfrc_actuator` | one per hinge | torque of the hinge's motors (N·m) |
//! | `cfrc_ext` | 6 per link | moment x, y, z (N·m), force x, y, z (N) of what touches the link |
//!
//! Links are the bodies of the model text in its order, also where they are welded together: 13 for the humanoid.
//! The last four blocks are in world axes and about the *centre*: the centre of mass of the whole body. Inertia is that
//! about the centre, the offset is the link's centre of mass as seen from there, and the velocity is that of the
//! point of the link which is at the centre.
//!
//! | [`ObservationKind`] | blocks | humanoid |
//! |---|---|---|
//! | `Compact` | `qpos`, `qvel` | 45 |
//! | `GymnasiumV5` | all; each of the last four can be left out | 348 |
//! | `GymnasiumV4` | all, with a row of zeros for the world before the links' rows and six zeros for the root before the torques | 376 |
//!
//! Formulas and order are MuJoCo's (`mj_comPos`, `mj_comVel`, `mj_rnePostConstraint`) and Gymnasium's
//! (`humanoid_v5.py`, `humanoid_v4.py`). Two readings differ by nature: everything here belongs to the end of the
//! control step, while MuJoCo's derived quantities are those of the last stage of its integrator; and contact forces
//! are means over the control step, while MuJoCo's are those of its last moment.

mod spatial;

use std::ops::Range;

use self::spatial::{SpatialInertia, velocity_about};
use crate::config::{EnvironmentConfig, ObservationKind};
use crate::model::Model;
use crate::physics::Physics;

/// Length of the compact observation of [`crate::HUMANOID_XML`]: 22 position and 23 velocity numbers.
pub const OBSERVATION_SIZE_COMPACT: usize = 45;

/// Numbers of the position vector that are left out: x and y, since walking must not depend on the place.
const HIDDEN: usize = 2;
/// Degrees of freedom of the root.
const ROOT_FREEDOMS: usize = 6;
/// Numbers of a link's inertia.
const INERTIA_SIZE: usize = 10;
/// Numbers of a link's velocity, and of the wrench on it.
const SPATIAL_SIZE: usize = 6;

/// Consecutive numbers of an observation that say one thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Gymnasium's name of it, as in its `observation_structure`.
    pub name: &'static str,
    /// Where it is in the observation.
    pub range: Range<usize>,
    part: Part,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Position,
    Velocity,
    Inertias,
    Velocities,
    Torques,
    Contacts,
}

/// Which numbers an observation consists of, for one model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Observation {
    blocks: Vec<Block>,
    /// Whether world and root, whose numbers are always zero, have their rows.
    has_world: bool,
    /// Numbers before the height of the torso.
    skips: usize,
}

impl Observation {
    /// The observation that a configuration asks for.
    #[must_use]
    pub fn new(config: &EnvironmentConfig, model: &Model) -> Self {
        let has_world = config.observation == ObservationKind::GymnasiumV4;
        let all = config.observation != ObservationKind::Compact;
        let rows = model.links.len() + usize::from(has_world);
        let hidden = if config.exclude_current_positions_from_observation { HIDDEN } else { 0 };
        let torques = model.hinges.len() + if has_world { ROOT_FREEDOMS } else { 0 };
        let parts = [
            ("qpos", Part::Position, model.position_size() - hidden, true),
            ("qvel", Part::Velocity, model.velocity_size(), true),
            ("cinert", Part::Inertias, rows * INERTIA_SIZE, all && config.include_cinert_in_observation),
            ("cvel", Part::Velocities, rows * SPATIAL_SIZE, all && config.include_cvel_in_observation),
            ("qfrc_actuator", Part::Torques, torques, all && config.include_qfrc_actuator_in_observation),
            ("cfrc_ext", Part::Contacts, rows * SPATIAL_SIZE, all && config.include_cfrc_ext_in_observation),
        ];
        let mut end = 0;
        let blocks = parts
            .into_iter()
            .filter(|(.., included)| *included)
            .map(|(name, part, size, _)| {
                let start = end;
                end += size;
                Block { name, range: start..end, part }
            })
            .collect();
        Self { blocks, has_world, skips: HIDDEN - hidden }
    }

    /// Length of the observation.
    #[must_use]
    pub fn size(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.range.end)
    }

    /// Its blocks, in order.
    #[must_use]
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Where the height of the torso is: after x and y where they are seen. The rest of positions and velocities follows.
    pub(crate) fn height_at(&self) -> usize {
        self.skips
    }

    /// Writes what is seen of a body as it is now. Allocates nothing.
    ///
    /// # Panics
    /// If `observation` does not have length [`Self::size`], or `physics` simulates another model.
    pub fn write(&self, physics: &Physics, observation: &mut [f32]) {
        assert_eq!(observation.len(), self.size(), "observation buffer has the wrong length");
        for block in &self.blocks {
            let target = &mut observation[block.range.clone()];
            match block.part {
                Part::Position => {
                    let position = physics.position();
                    copy(&position[position.len() - target.len()..], target);
                }
                Part::Velocity => copy(physics.velocity(), target),
                Part::Torques => copy(physics.joint_torques_nm(), self.after_world(target, ROOT_FREEDOMS)),
                Part::Inertias => self.write_inertias(physics, target),
                Part::Velocities => self.write_velocities(physics, target),
                Part::Contacts => self.write_contacts(physics, target),
            }
        }
    }

    /// Fills the world's numbers with zeros, where there are any, and hands out the rest.
    fn after_world<'a>(&self, target: &'a mut [f32], size: usize) -> &'a mut [f32] {
        let (world, rest) = target.split_at_mut(if self.has_world { size } else { 0 });
        world.fill(0.0);
        rest
    }

    fn write_inertias(&self, physics: &Physics, target: &mut [f32]) {
        let centre = physics.centre_of_mass();
        let rows = self.after_world(target, INERTIA_SIZE).chunks_exact_mut(INERTIA_SIZE);
        for (link, row) in physics.model().links.iter().zip(rows) {
            let pose = &physics.body_motions()[link.body].pose;
            copy(&SpatialInertia::of_link(link, pose, &centre).numbers(), row);
        }
    }

    fn write_velocities(&self, physics: &Physics, target: &mut [f32]) {
        let centre = physics.centre_of_mass();
        let model = physics.model();
        let rows = self.after_world(target, SPATIAL_SIZE).chunks_exact_mut(SPATIAL_SIZE);
        for (link, row) in model.links.iter().zip(rows) {
            let motion = &physics.body_motions()[link.body];
            copy(velocity_about(&centre, &model.bodies[link.body], motion).as_slice(), row);
        }
    }

    fn write_contacts(&self, physics: &Physics, target: &mut [f32]) {
        let rows = self.after_world(target, SPATIAL_SIZE).chunks_exact_mut(SPATIAL_SIZE);
        for (link, row) in rows.enumerate() {
            let (force, moment) = physics.contact_wrench(link);
            copy(moment.as_slice(), &mut row[..3]);
            copy(force.as_slice(), &mut row[3..]);
        }
    }
}

fn copy(numbers: &[f64], target: &mut [f32]) {
    debug_assert_eq!(numbers.len(), target.len());
    for (slot, number) in target.iter_mut().zip(numbers) {
        *slot = *number as f32;
    }
}
