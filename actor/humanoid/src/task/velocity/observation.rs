//! Terms of the observation.

use std::f64::consts::TAU;

use super::VelocityTask;
use super::command::STANDING_COMMAND;
use super::feet::FEET;
use super::rewards::BaseMotion;
use super::scan::{SCAN_MAX_M, SCAN_POINTS, opposite_point};
use crate::config::EnvironmentConfig;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::Physics;
use crate::task::term::{AXIAL, Layout, SCALAR, Shown, TermPart, TermRow, VECTOR, unsigned};

type Row = TermRow<VelocityTask>;

/// Terms in their order: those of the policy, then those of the critic alone. Names are those of Isaac Lab.
pub const TERMS: &[Row] = &[
    Row::new("base_ang_vel", "rad/s", "base", AXIAL, |view, noise, write| {
        view.base.angular_radps.iter().for_each(|rate| write(rate + noise.velocity()));
    }),
    Row::new("projected_gravity", "1", "base", VECTOR, |view, noise, write| {
        view.base.gravity.iter().for_each(|part| write(part + noise.position()));
    }),
    Row::new("velocity_commands", "m/s, m/s, rad/s", "heading", &[1.0, -1.0, -1.0], |view, _, write| {
        view.task.command.numbers().into_iter().for_each(write);
    })
    .with_mjlab_name("command")
    .with_deploy_params(|_| "{command_name: base_velocity}".to_owned()),
    Row::new("joint_pos_rel", "rad", "joint", SCALAR, |view, noise, write| {
        for (hinge, default_rad, _) in &view.task.motors {
            let error_rad = view.task.encoder_errors_rad[*hinge] + noise.position();
            write(view.physics.joint_angles()[*hinge] - default_rad + error_rad);
        }
    })
    .of_each(TermPart::Joint)
    .with_mjlab_name("joint_pos"),
    Row::new("joint_vel_rel", "rad/s", "joint", SCALAR, |view, noise, write| {
        for (hinge, _, _) in &view.task.motors {
            write(view.physics.joint_rates()[*hinge] + noise.velocity());
        }
    })
    .of_each(TermPart::Joint)
    .with_mjlab_name("joint_vel"),
    Row::new("last_action", "action_scale", "joint", SCALAR, |view, _, write| {
        view.task.actions.iter().copied().for_each(write);
    })
    .of_each(TermPart::Joint)
    .with_mjlab_name("actions"),
    // Half a period later, each foot does what the other one did.
    Row::new("gait_phase", "1", "sine and cosine", &[-1.0, -1.0], |view, _, write| {
        let (sin, cos) = match view.task.rested_s() {
            Some(_) => (0.0, 0.0),
            None => (TAU * view.task.time_s() / view.task.config.gait_period_s).sin_cos(),
        };
        [sin, cos].into_iter().for_each(write);
    })
    .with_mjlab_name("phase")
    .with_deploy_params(|config| match &config.velocity {
        config if config.gait_rests => format!(
            "{{period: {:?}, command_threshold: {STANDING_COMMAND:?}, command_threshold_delay: {:?}}}",
            config.gait_period_s, config.gait_rests_after_s
        ),
        config => format!("{{period: {:?}}}", config.gait_period_s),
    }),
    Row::new("height_scan", "m", "heading", SCALAR, |view, noise, write| {
        view.scan().for_each(|height_m| write(height_m + noise.position()));
    })
    .of_each(TermPart::ScanPoint)
    .repeated(|config| config.velocity.height_scan.into()),
    Row::new("base_lin_vel", "m/s", "heading", VECTOR, |view, _, write| {
        view.base.velocity_mps.iter().copied().for_each(write);
    })
    .privileged(),
    Row::new("base_height", "m", "world", SCALAR, |view, _, write| write(view.base.height_m)).privileged(),
    Row::new("feet_contact", "1", "foot", SCALAR, |view, _, write| {
        view.task.feet.iter().for_each(|foot| write(f64::from(u8::from(foot.stands))));
    })
    .of_each(TermPart::Foot)
    .privileged(),
    Row::new("feet_air_time", "s", "foot", SCALAR, |view, _, write| {
        view.task.feet.iter().for_each(|foot| write(foot.air_s));
    })
    .of_each(TermPart::Foot)
    .privileged(),
    Row::new("feet_lift", "m", "foot", SCALAR, |view, _, write| {
        view.task.feet.iter().for_each(|foot| write(foot.lift_m));
    })
    .of_each(TermPart::Foot)
    .privileged(),
    Row::new("height_scan", "m", "heading", SCALAR, |view, _, write| view.scan().for_each(write))
        .of_each(TermPart::ScanPoint)
        .privileged()
        .repeated(|config| (!config.ground.kinds.is_empty()).into()),
];

impl Shown for VelocityTask {
    type View<'a> = VelocityView<'a>;
}

/// What the terms show.
pub struct VelocityView<'a> {
    task: &'a VelocityTask,
    physics: &'a Physics,
    base: BaseMotion,
    /// Heights of the ground around the base (m, world).
    around_m: [f64; SCAN_POINTS],
}

impl<'a> VelocityView<'a> {
    /// Returns what there is to see now.
    pub(super) fn new(task: &'a VelocityTask, physics: &'a Physics) -> Self {
        let (base, around_m) = task.base(physics);
        Self { task, physics, base, around_m }
    }

    /// Returns how much higher the ground around the base is than where the robot would stand in the default pose (m).
    fn scan(&self) -> impl Iterator<Item = f64> {
        let standing_m = self.physics.position()[2] - self.task.body.height_m;
        self.around_m.iter().map(move |ground_m| (ground_m - standing_m).clamp(-SCAN_MAX_M, SCAN_MAX_M))
    }
}

/// Returns the layout that a configuration selects, for a number of joints.
pub(super) fn layout(config: &EnvironmentConfig, joints: usize) -> Layout<VelocityTask> {
    Layout::new(TERMS, config, config.velocity.history as usize, |part| match part {
        TermPart::Joint => joints,
        TermPart::Foot => FEET,
        TermPart::ScanPoint => SCAN_POINTS,
        TermPart::Whole | TermPart::Link | TermPart::End => 1,
    })
}

/// Returns the images of the parts of a robot with this mirror; the feet exchange places.
pub(super) fn image(part: TermPart, robot: &Mirror) -> SignedPermutation {
    match part {
        TermPart::Joint => robot.action.clone(),
        TermPart::Foot => unsigned((0..FEET).rev()),
        TermPart::ScanPoint => unsigned((0..SCAN_POINTS).map(opposite_point)),
        TermPart::Whole | TermPart::Link | TermPart::End => unsigned([0]),
    }
}
