//! Observation: one row for each term, with all that is known of it.

use std::f64::consts::TAU;

use super::command::STANDING_COMMAND;
use super::feet::FEET;
use super::rewards::BaseMotion;
use super::scan::{SCAN_MAX_M, SCAN_POINTS, opposite_point};
use super::{ObservationTerm, VelocityTask};
use crate::config::{EnvironmentConfig, VelocityConfig};
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::Physics;
use crate::randomisation::SensorNoise;

/// Term of the observation.
#[derive(Clone, Copy, Debug)]
pub struct TermRow {
    /// Name, as in Isaac Lab and `deploy.yaml`.
    pub name: &'static str,
    /// Name in the metadata of mjlab's ONNX files.
    pub mjlab_name: &'static str,
    /// Unit of its entries.
    pub unit: &'static str,
    /// Frame of its entries.
    pub frame: &'static str,
    /// Returns its parameters in `deploy.yaml`.
    pub deploy_params: fn(&VelocityConfig) -> String,
    /// Whether only the critic sees it.
    is_privileged: bool,
    entries: Entries,
    is_observed: fn(&EnvironmentConfig) -> bool,
    write: Write,
}

/// Passes the entries of a term to the last argument, in order.
type Write = fn(&View<'_>, &mut SensorNoise, &mut dyn FnMut(f64));

/// Entries of a term: their number and their mirror image, with left and right exchanged.
#[derive(Clone, Copy, Debug)]
enum Entries {
    /// Entries that keep their places, and are multiplied by these signs.
    Signs(&'static [f32]),
    /// One for each joint of the action.
    Joints,
    /// One for each foot; the feet exchange places.
    Feet,
    /// Heights of the ground around the base.
    Scan,
}

impl Entries {
    fn count(self, joints: usize) -> usize {
        match self {
            Self::Signs(signs) => signs.len(),
            Self::Joints => joints,
            Self::Feet => FEET,
            Self::Scan => SCAN_POINTS,
        }
    }

    /// Returns the mirror image of entries that begin at `start`, for a robot with this one.
    fn mirrored(self, start: usize, robot: &Mirror) -> SignedPermutation {
        match self {
            Self::Signs(signs) => signs.iter().enumerate().map(|(at, sign)| (start + at, *sign)).collect(),
            Self::Joints => robot.action.iter().map(|(at, sign)| (start + at, *sign)).collect(),
            Self::Feet => (0..FEET).rev().map(|foot| (start + foot, 1.0)).collect(),
            Self::Scan => (0..SCAN_POINTS).map(|point| (start + opposite_point(point), 1.0)).collect(),
        }
    }
}

impl TermRow {
    /// Returns a term that the policy observes.
    const fn new(name: &'static str, unit: &'static str, frame: &'static str, entries: Entries, write: Write) -> Self {
        Self {
            name,
            mjlab_name: name,
            unit,
            frame,
            deploy_params: |_| "{}".to_owned(),
            is_privileged: false,
            entries,
            is_observed: |_| true,
            write,
        }
    }

    /// Shows the term to the critic only.
    const fn privileged(self) -> Self {
        Self { is_privileged: true, ..self }
    }

    /// Leaves the term out of some configurations.
    const fn only_if(self, is_observed: fn(&EnvironmentConfig) -> bool) -> Self {
        Self { is_observed, ..self }
    }

    /// Names the term as mjlab does.
    const fn with_mjlab_name(self, mjlab_name: &'static str) -> Self {
        Self { mjlab_name, ..self }
    }

    const fn with_deploy_params(self, deploy_params: fn(&VelocityConfig) -> String) -> Self {
        Self { deploy_params, ..self }
    }
}

/// Terms in their order: those of the policy, then those of the critic alone. Vectors keep their sign along x and z in the
/// mirror; angular velocities are pseudo-vectors and keep it along y.
pub const TERMS: &[TermRow] = &[
    TermRow::new("base_ang_vel", "rad/s", "base", Entries::Signs(&[-1.0, 1.0, -1.0]), |view, noise, write| {
        view.base.angular_radps.iter().for_each(|rate| write(rate + noise.velocity()));
    }),
    TermRow::new("projected_gravity", "1", "base", Entries::Signs(&[1.0, -1.0, 1.0]), |view, noise, write| {
        view.base.gravity.iter().for_each(|part| write(part + noise.position()));
    }),
    TermRow::new(
        "velocity_commands",
        "m/s, m/s, rad/s",
        "heading",
        Entries::Signs(&[1.0, -1.0, -1.0]),
        |view, _, write| view.task.command.numbers().into_iter().for_each(write),
    )
    .with_mjlab_name("command")
    .with_deploy_params(|_| "{command_name: base_velocity}".to_owned()),
    TermRow::new("joint_pos_rel", "rad", "joint", Entries::Joints, |view, noise, write| {
        for (hinge, default_rad, _) in &view.task.motors {
            let error_rad = view.task.encoder_errors_rad[*hinge] + noise.position();
            write(view.physics.joint_angles()[*hinge] - default_rad + error_rad);
        }
    })
    .with_mjlab_name("joint_pos"),
    TermRow::new("joint_vel_rel", "rad/s", "joint", Entries::Joints, |view, noise, write| {
        for (hinge, _, _) in &view.task.motors {
            write(view.physics.joint_rates()[*hinge] + noise.velocity());
        }
    })
    .with_mjlab_name("joint_vel"),
    TermRow::new("last_action", "action_scale", "joint", Entries::Joints, |view, _, write| {
        view.task.actions.iter().copied().for_each(write);
    })
    .with_mjlab_name("actions"),
    // Half a period later, each foot does what the other one did.
    TermRow::new("gait_phase", "1", "sine and cosine", Entries::Signs(&[-1.0, -1.0]), |view, _, write| {
        let (sin, cos) = match view.task.rested_s() {
            Some(_) => (0.0, 0.0),
            None => (TAU * view.task.time_s() / view.task.config.gait_period_s).sin_cos(),
        };
        [sin, cos].into_iter().for_each(write);
    })
    .with_mjlab_name("phase")
    .with_deploy_params(|config| match config.gait_rests {
        true => format!(
            "{{period: {:?}, command_threshold: {STANDING_COMMAND:?}, command_threshold_delay: {:?}}}",
            config.gait_period_s, config.gait_rests_after_s
        ),
        false => format!("{{period: {:?}}}", config.gait_period_s),
    }),
    TermRow::new("height_scan", "m", "heading", Entries::Scan, |view, noise, write| {
        view.scan().for_each(|height_m| write(height_m + noise.position()));
    })
    .only_if(|config| config.velocity.height_scan),
    TermRow::new("base_lin_vel", "m/s", "heading", Entries::Signs(&[1.0, -1.0, 1.0]), |view, _, write| {
        view.base.velocity_mps.iter().copied().for_each(write);
    })
    .privileged(),
    TermRow::new("base_height", "m", "world", Entries::Signs(&[1.0]), |view, _, write| write(view.base.height_m))
        .privileged(),
    TermRow::new("feet_contact", "1", "foot", Entries::Feet, |view, _, write| {
        view.task.feet.iter().for_each(|foot| write(f64::from(u8::from(foot.stands))));
    })
    .privileged(),
    TermRow::new("feet_air_time", "s", "foot", Entries::Feet, |view, _, write| {
        view.task.feet.iter().for_each(|foot| write(foot.air_s));
    })
    .privileged(),
    TermRow::new("feet_lift", "m", "foot", Entries::Feet, |view, _, write| {
        view.task.feet.iter().for_each(|foot| write(foot.lift_m));
    })
    .privileged(),
    TermRow::new("height_scan", "m", "heading", Entries::Scan, |view, _, write| view.scan().for_each(write))
        .privileged()
        .only_if(|config| !config.ground.kinds.is_empty()),
];

/// What the terms show.
pub(super) struct View<'a> {
    task: &'a VelocityTask,
    physics: &'a Physics,
    base: BaseMotion,
    /// Heights of the ground around the base (m, world).
    around_m: [f64; SCAN_POINTS],
}

impl<'a> View<'a> {
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

    /// Writes what the policy observes, or what only the critic observes. Does not allocate.
    pub(super) fn write_frame(&self, is_privileged: bool, noise: &mut SensorNoise, frame: &mut [f32]) {
        let mut numbers = frame.iter_mut();
        let mut write = |number: f64| *numbers.next().expect("the terms fill the frame") = number as f32;
        for row in self.task.layout.frame(is_privileged) {
            (row.write)(self, noise, &mut write);
        }
    }
}

/// Terms of an observation: those of the policy, once for each frame of the history, then those of the critic alone.
pub(super) struct Layout {
    rows: Vec<&'static TermRow>,
    /// The rows with their places.
    pub terms: Vec<ObservationTerm>,
    history: usize,
}

impl Layout {
    /// Returns the layout that a configuration selects, for a number of joints.
    pub fn new(config: &EnvironmentConfig, joints: usize) -> Self {
        let history = config.velocity.history as usize;
        let observed = |is_privileged: bool| {
            TERMS.iter().filter(move |row| row.is_privileged == is_privileged && (row.is_observed)(config))
        };
        let rows: Vec<_> = (0..history).flat_map(|_| observed(false)).chain(observed(true)).collect();
        let mut end = 0;
        let place = |row: &&TermRow| {
            let start = end;
            end += row.entries.count(joints);
            ObservationTerm { name: row.name.to_owned(), range: start..end, is_privileged: row.is_privileged }
        };
        Self { terms: rows.iter().map(place).collect(), rows, history }
    }

    /// Returns the number of entries that the policy observes.
    pub fn of_policy(&self) -> usize {
        self.terms.iter().filter(|term| !term.is_privileged).map(|term| term.range.len()).sum()
    }

    /// Returns the mirror image of an observation, for a robot with this one.
    pub fn mirrored(&self, robot: &Mirror) -> SignedPermutation {
        let placed = self.rows.iter().zip(&self.terms);
        placed.flat_map(|(row, term)| row.entries.mirrored(term.range.start, robot)).collect()
    }

    /// Returns the rows of one frame of the policy, or of the critic alone.
    fn frame(&self, is_privileged: bool) -> &[&'static TermRow] {
        let of_policy = self.rows.iter().filter(|row| !row.is_privileged).count();
        if is_privileged { &self.rows[of_policy..] } else { &self.rows[..of_policy / self.history] }
    }
}
