//! Observation: one row for each term, in the order and with the names of mjlab's tracking task.

use nalgebra::{Isometry3, Matrix3, UnitQuaternion, Vector3};

use super::MotionTask;
use super::links::Compared;
use crate::config::MotionConfig;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::Physics;
use crate::randomisation::SensorNoise;
use crate::task::ObservationTerm;

/// Noise of where the robot is and how fast, in units of that of its hinges: estimators drift. mjlab's ratios, rounded.
const PLACE_NOISE: f64 = 10.0;
const SPEED_NOISE: f64 = 3.0;
/// Signs in the mirror of the first two columns of a rotation matrix, row by row: entry (i, j) changes its sign if one of i
/// and j is y.
const TURN_SIGNS: [f32; 6] = [1.0, -1.0, -1.0, 1.0, 1.0, -1.0];
/// Signs of a vector, and of an angular velocity.
const VECTOR_SIGNS: [f32; 3] = [1.0, -1.0, 1.0];
const AXIAL_SIGNS: [f32; 3] = [-1.0, 1.0, -1.0];

/// Term of the observation.
#[derive(Clone, Copy, Debug)]
pub struct MotionTerm {
    /// Name in mjlab's tracking task.
    pub name: &'static str,
    /// Unit of its entries.
    pub unit: &'static str,
    /// Frame of its entries.
    pub frame: &'static str,
    /// Whether only the critic sees it.
    is_privileged: bool,
    entries: Entries,
    is_observed: fn(&MotionConfig) -> bool,
    write: Write,
}

/// Passes the entries of a term to the last argument, in order.
type Write = fn(&MotionView<'_>, &mut SensorNoise, &mut dyn FnMut(f64));

/// Entries of a term: their number and their mirror image.
#[derive(Clone, Copy, Debug)]
enum Entries {
    /// Entries that keep their places, and are multiplied by these signs.
    Signs(&'static [f32]),
    /// So many for each joint of the action: all joints once, then all again.
    Joints(usize),
    /// One for each joint and further step of the motion.
    Future,
    /// Entries of each compared link, with their signs.
    Links(&'static [f32]),
    /// One for each end of a limb.
    Ends,
}

const fn term(
    name: &'static str,
    unit: &'static str,
    frame: &'static str,
    entries: Entries,
    write: Write,
) -> MotionTerm {
    MotionTerm { name, unit, frame, is_privileged: false, entries, is_observed: |_| true, write }
}

impl MotionTerm {
    const fn privileged(self) -> Self {
        Self { is_privileged: true, ..self }
    }

    const fn only_if(self, is_observed: fn(&MotionConfig) -> bool) -> Self {
        Self { is_observed, ..self }
    }
}

/// Terms in their order: those of the policy, then those of the critic alone.
pub const MOTION_OBSERVATION: &[MotionTerm] = &[
    term("command", "rad, rad/s", "joint", Entries::Joints(2), |view, _, write| {
        let step = view.task.step;
        let motors = || view.task.motors.iter().map(|(hinge, _, _)| *hinge);
        motors().for_each(|hinge| write(view.task.reference.positions[step][7 + hinge]));
        motors().for_each(|hinge| write(view.task.reference.velocities[step][6 + hinge]));
    }),
    term("command_future", "rad", "joint", Entries::Future, |view, _, write| {
        for step in view.task.further_steps() {
            for (hinge, _, _) in &view.task.motors {
                write(view.task.reference.positions[step][7 + hinge]);
            }
        }
    })
    .only_if(|config| config.future_steps > 0),
    term("motion_anchor_pos_b", "m", "anchor", Entries::Signs(&VECTOR_SIGNS), |view, noise, write| {
        view.motion_in_anchor.translation.vector.iter().for_each(|part| write(part + PLACE_NOISE * noise.position()));
    })
    .only_if(|config| config.state_estimation),
    term("motion_anchor_ori_b", "1", "anchor", Entries::Signs(&TURN_SIGNS), |view, noise, write| {
        columns(&view.motion_in_anchor.rotation).into_iter().for_each(|part| write(part + noise.position()));
    }),
    term("base_lin_vel", "m/s", "base", Entries::Signs(&VECTOR_SIGNS), |view, noise, write| {
        view.base_velocity().into_iter().for_each(|part| write(part + SPEED_NOISE * noise.velocity()));
    })
    .only_if(|config| config.state_estimation),
    term("base_ang_vel", "rad/s", "base", Entries::Signs(&AXIAL_SIGNS), |view, noise, write| {
        view.physics.velocity()[3..6].iter().for_each(|rate| write(rate + noise.velocity()));
    }),
    term("joint_pos", "rad", "joint", Entries::Joints(1), |view, noise, write| {
        for (hinge, default_rad, _) in &view.task.motors {
            let error_rad = view.task.encoder_errors_rad[*hinge] + noise.position();
            write(view.physics.joint_angles()[*hinge] - default_rad + error_rad);
        }
    }),
    term("joint_vel", "rad/s", "joint", Entries::Joints(1), |view, noise, write| {
        for (hinge, _, _) in &view.task.motors {
            write(view.physics.joint_rates()[*hinge] + noise.velocity());
        }
    }),
    term("actions", "action_scale", "joint", Entries::Joints(1), |view, _, write| {
        view.task.actions.iter().copied().for_each(write);
    }),
    term("motion_anchor_pos_b", "m", "anchor", Entries::Signs(&VECTOR_SIGNS), |view, _, write| {
        view.motion_in_anchor.translation.vector.iter().copied().for_each(write);
    })
    .privileged(),
    term("base_lin_vel", "m/s", "base", Entries::Signs(&VECTOR_SIGNS), |view, _, write| {
        view.base_velocity().into_iter().for_each(write);
    })
    .privileged(),
    term("body_pos", "m", "anchor", Entries::Links(&VECTOR_SIGNS), |view, _, write| {
        for link in &view.task.reference.compared.links {
            let place = view.from_anchor * view.physics.link_pose(*link);
            place.translation.vector.iter().copied().for_each(&mut *write);
        }
    })
    .privileged(),
    term("body_ori", "1", "anchor", Entries::Links(&TURN_SIGNS), |view, _, write| {
        for (link, default) in view.task.reference.compared.links.iter().zip(&view.task.default_turns) {
            let turn = view.from_anchor.rotation * view.physics.link_pose(*link).rotation * default;
            columns(&turn).into_iter().for_each(&mut *write);
        }
    })
    .privileged(),
    term("end_contact", "1", "end", Entries::Ends, |view, _, write| {
        for end in &view.task.reference.compared.ends {
            let link = view.task.reference.compared.links[*end];
            write(f64::from(u8::from(view.physics.contact_wrench(link).0.norm() > 1.0)));
        }
    })
    .privileged(),
];

/// What the terms show.
pub(super) struct MotionView<'a> {
    task: &'a MotionTask,
    physics: &'a Physics,
    /// From the world to the frame of the robot's anchor.
    from_anchor: Isometry3<f64>,
    /// The motion's anchor in that frame.
    motion_in_anchor: Isometry3<f64>,
}

impl<'a> MotionView<'a> {
    /// Returns what there is to see now.
    pub(super) fn new(task: &'a MotionTask, physics: &'a Physics) -> Self {
        let from_anchor = physics.link_pose(task.reference.compared.anchor).inverse();
        let motion_in_anchor = from_anchor * task.reference.anchor(task.step).pose;
        Self { task, physics, from_anchor, motion_in_anchor }
    }

    /// Returns the velocity of the base's origin in its frame (m/s).
    fn base_velocity(&self) -> [f64; 3] {
        let linear_mps = Vector3::from_column_slice(&self.physics.velocity()[..3]);
        (self.physics.body_motion(0).pose.rotation.inverse() * linear_mps).into()
    }

    /// Writes what the policy observes, and what only the critic observes. Does not allocate.
    pub(super) fn write(&self, noise: &mut SensorNoise, observation: &mut [f32]) {
        let mut numbers = observation.iter_mut();
        let mut write = |number: f64| *numbers.next().expect("the terms fill the observation") = number as f32;
        for row in &self.task.layout.rows {
            (row.write)(self, noise, &mut write);
        }
    }
}

/// Returns the first two columns of a rotation matrix, row by row.
fn columns(turn: &UnitQuaternion<f64>) -> [f64; 6] {
    let matrix: Matrix3<f64> = turn.to_rotation_matrix().into_inner();
    let [x, y] = [matrix.column(0), matrix.column(1)];
    [x[0], y[0], x[1], y[1], x[2], y[2]]
}

/// Terms of an observation, with their places.
pub(super) struct MotionLayout {
    rows: Vec<&'static MotionTerm>,
    /// The rows with their places.
    pub terms: Vec<ObservationTerm>,
    joints: usize,
    further_steps: usize,
}

impl MotionLayout {
    /// Returns the layout that the settings select, for a number of joints.
    pub fn new(config: &MotionConfig, compared: &Compared, joints: usize) -> Self {
        let further_steps = config.future_steps as usize;
        let rows: Vec<_> = MOTION_OBSERVATION.iter().filter(|row| (row.is_observed)(config)).collect();
        let mut end = 0;
        let place = |row: &&MotionTerm| {
            let start = end;
            end += match row.entries {
                Entries::Signs(signs) => signs.len(),
                Entries::Joints(times) => times * joints,
                Entries::Future => further_steps * joints,
                Entries::Links(signs) => signs.len() * compared.links.len(),
                Entries::Ends => compared.ends.len(),
            };
            ObservationTerm { name: row.name.to_owned(), range: start..end, is_privileged: row.is_privileged }
        };
        Self { terms: rows.iter().map(place).collect(), rows, joints, further_steps }
    }

    /// Returns the mirror image of an observation, for a robot with this one; `None` if the mirror image of a compared link
    /// is not compared.
    pub fn mirrored(&self, compared: &Compared, robot: &Mirror) -> Option<SignedPermutation> {
        let Compared { links, ends, .. } = compared;
        let image = |link: &usize| links.iter().position(|other| *other == robot.links[*link]);
        let images: Vec<usize> = links.iter().map(image).collect::<Option<_>>()?;
        let end_images: Vec<usize> =
            ends.iter().map(|end| ends.iter().position(|other| *other == images[*end])).collect::<Option<_>>()?;
        let mut mirrored = SignedPermutation::new();
        for (row, term) in self.rows.iter().zip(&self.terms) {
            let start = term.range.start;
            let joints = |times: usize| {
                (0..times).flat_map(move |time| {
                    robot.action.iter().map(move |(at, sign)| (start + time * self.joints + at, *sign))
                })
            };
            match row.entries {
                Entries::Signs(signs) => {
                    mirrored.extend(signs.iter().enumerate().map(|(at, sign)| (start + at, *sign)));
                }
                Entries::Joints(times) => mirrored.extend(joints(times)),
                Entries::Future => mirrored.extend(joints(self.further_steps)),
                Entries::Links(signs) => mirrored.extend(images.iter().flat_map(|image| {
                    signs.iter().enumerate().map(move |(at, sign)| (start + image * signs.len() + at, *sign))
                })),
                Entries::Ends => mirrored.extend(end_images.iter().map(|image| (start + image, 1.0))),
            }
        }
        Some(mirrored)
    }
}
