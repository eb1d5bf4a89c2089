//! Terms of the observation, in the order and with the names of mjlab's tracking task.

use nalgebra::{Isometry3, Matrix3, UnitQuaternion, Vector3};

use super::MotionTask;
use super::links::Compared;
use crate::config::EnvironmentConfig;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::Physics;
use crate::task::term::{AXIAL, Layout, SCALAR, Shown, TermPart, TermRow, VECTOR, unsigned};

/// Noise of where the robot is and how fast, in units of that of its hinges: estimators drift. mjlab's ratios, rounded.
const PLACE_NOISE: f64 = 10.0;
const SPEED_NOISE: f64 = 3.0;
/// Signs in the mirror of the first two columns of a rotation matrix, row by row: entry (i, j) changes its sign if one of i
/// and j is y.
const TURN: &[f32] = &[1.0, -1.0, -1.0, 1.0, 1.0, -1.0];

type Row = TermRow<MotionTask>;

/// Terms in their order: those of the policy, then those of the critic alone.
pub const MOTION_OBSERVATION: &[Row] = &[
    Row::new("command", "rad, rad/s", "joint", SCALAR, |view, _, write| {
        let step = view.task.step;
        let motors = || view.task.motors.iter().map(|(hinge, _, _)| *hinge);
        motors().for_each(|hinge| write(view.task.reference.positions[step][7 + hinge]));
        motors().for_each(|hinge| write(view.task.reference.velocities[step][6 + hinge]));
    })
    .of_each(TermPart::Joint)
    .repeated(|_| 2),
    Row::new("command_future", "rad", "joint", SCALAR, |view, _, write| {
        for step in view.task.further_steps() {
            for (hinge, _, _) in &view.task.motors {
                write(view.task.reference.positions[step][7 + hinge]);
            }
        }
    })
    .of_each(TermPart::Joint)
    .repeated(|config| config.motion.future_steps as usize),
    Row::new("motion_anchor_pos_b", "m", "anchor", VECTOR, |view, noise, write| {
        view.motion_in_anchor.translation.vector.iter().for_each(|part| write(part + PLACE_NOISE * noise.position()));
    })
    .repeated(|config| config.motion.state_estimation.into()),
    Row::new("motion_anchor_ori_b", "1", "anchor", TURN, |view, noise, write| {
        columns(&view.motion_in_anchor.rotation).into_iter().for_each(|part| write(part + noise.position()));
    }),
    Row::new("base_lin_vel", "m/s", "base", VECTOR, |view, noise, write| {
        view.base_velocity().into_iter().for_each(|part| write(part + SPEED_NOISE * noise.velocity()));
    })
    .repeated(|config| config.motion.state_estimation.into()),
    Row::new("base_ang_vel", "rad/s", "base", AXIAL, |view, noise, write| {
        view.physics.velocity()[3..6].iter().for_each(|rate| write(rate + noise.velocity()));
    }),
    Row::new("joint_pos", "rad", "joint", SCALAR, |view, noise, write| {
        for (hinge, default_rad, _) in &view.task.motors {
            let error_rad = view.task.encoder_errors_rad[*hinge] + noise.position();
            write(view.physics.joint_angles()[*hinge] - default_rad + error_rad);
        }
    })
    .of_each(TermPart::Joint),
    Row::new("joint_vel", "rad/s", "joint", SCALAR, |view, noise, write| {
        for (hinge, _, _) in &view.task.motors {
            write(view.physics.joint_rates()[*hinge] + noise.velocity());
        }
    })
    .of_each(TermPart::Joint),
    Row::new("actions", "action_scale", "joint", SCALAR, |view, _, write| {
        view.task.actions.iter().copied().for_each(write);
    })
    .of_each(TermPart::Joint),
    Row::new("motion_anchor_pos_b", "m", "anchor", VECTOR, |view, _, write| {
        view.motion_in_anchor.translation.vector.iter().copied().for_each(write);
    })
    .privileged(),
    Row::new("base_lin_vel", "m/s", "base", VECTOR, |view, _, write| {
        view.base_velocity().into_iter().for_each(write);
    })
    .privileged(),
    Row::new("body_pos", "m", "anchor", VECTOR, |view, _, write| {
        for link in &view.task.reference.compared.links {
            let place = view.from_anchor * view.physics.link_pose(*link);
            place.translation.vector.iter().copied().for_each(&mut *write);
        }
    })
    .of_each(TermPart::Link)
    .privileged(),
    Row::new("body_ori", "1", "anchor", TURN, |view, _, write| {
        for (link, default) in view.task.reference.compared.links.iter().zip(&view.task.default_turns) {
            let turn = view.from_anchor.rotation * view.physics.link_pose(*link).rotation * default;
            columns(&turn).into_iter().for_each(&mut *write);
        }
    })
    .of_each(TermPart::Link)
    .privileged(),
    Row::new("end_contact", "1", "end", SCALAR, |view, _, write| {
        for end in &view.task.reference.compared.ends {
            let link = view.task.reference.compared.links[*end];
            write(f64::from(u8::from(view.physics.contact_wrench(link).0.norm() > 1.0)));
        }
    })
    .of_each(TermPart::End)
    .privileged(),
];

impl Shown for MotionTask {
    type View<'a> = MotionView<'a>;
}

/// What the terms show.
pub struct MotionView<'a> {
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
}

/// Returns the first two columns of a rotation matrix, row by row.
fn columns(turn: &UnitQuaternion<f64>) -> [f64; 6] {
    let matrix: Matrix3<f64> = turn.to_rotation_matrix().into_inner();
    let [x, y] = [matrix.column(0), matrix.column(1)];
    [x[0], y[0], x[1], y[1], x[2], y[2]]
}

/// Returns the layout that a configuration selects, for a number of joints.
pub(super) fn layout(config: &EnvironmentConfig, compared: &Compared, joints: usize) -> Layout<MotionTask> {
    Layout::new(MOTION_OBSERVATION, config, 1, |part| match part {
        TermPart::Joint => joints,
        TermPart::Link => compared.links.len(),
        TermPart::End => compared.ends.len(),
        TermPart::Whole | TermPart::Foot | TermPart::ScanPoint => 1,
    })
}

/// Returns the images of the parts of a robot with this mirror; `None` if the image of a compared link is not compared.
pub(super) fn image(part: TermPart, compared: &Compared, robot: &Mirror) -> Option<SignedPermutation> {
    let Compared { links, ends, .. } = compared;
    let place = |link: &usize| links.iter().position(|other| *other == robot.links[*link]);
    match part {
        TermPart::Joint => Some(robot.action.clone()),
        TermPart::Link => Some(unsigned(links.iter().map(place).collect::<Option<Vec<_>>>()?)),
        TermPart::End => {
            let image = |end: &usize| ends.iter().position(|other| Some(*other) == place(&links[*end]));
            Some(unsigned(ends.iter().map(image).collect::<Option<Vec<_>>>()?))
        }
        TermPart::Whole | TermPart::Foot | TermPart::ScanPoint => Some(unsigned([0])),
    }
}
