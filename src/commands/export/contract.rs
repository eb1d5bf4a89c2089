//! Contract of a policy of the velocity or the motion task: what a robot's controller must know to play it.

use anyhow::Context;
use serde_json::{Value, json};
use treadmill_humanoid::{
    Environment, EnvironmentConfig, ObservationTerm,
    config::ChosenTask,
    model::{HingeControl, Robot},
    task::{
        motion::MOTION_OBSERVATION,
        term::{Shown, TermRow},
        velocity::{ACTION_MAX, Calm, HEADING_GAIN, SCAN_GRID, SCAN_MAX_M, SCAN_SPACING_M, STANDING_COMMAND, TERMS},
    },
};
use treadmill_policy::onnx::ForController;
use treadmill_proto::onnx::{OnnxOffset, Ports};

use super::imitated::Imitated;

/// Version of the contract; raised if an old reader would misunderstand a new one.
const FORMAT: u32 = 1;

/// Servo of one hinge.
#[derive(Clone)]
pub(super) struct Joint {
    pub name: String,
    pub default_rad: f64,
    pub kp: f64,
    pub kd: f64,
    pub effort_nm: f64,
    pub armature_kgm2: f64,
    pub action_scale_rad: f64,
    /// Number of its motor in the robot's own software.
    pub motor: usize,
}

/// Term of one observation.
pub(super) struct Term {
    pub name: &'static str,
    pub mjlab_name: &'static str,
    unit: &'static str,
    frame: &'static str,
    /// Its parameters in `deploy.yaml`, for the velocity task.
    pub deploy_params: String,
    pub size: usize,
}

/// What a controller must know.
pub(super) struct Contract {
    pub config: EnvironmentConfig,
    /// Joints of the policy, in the order of the action.
    pub joints: Vec<Joint>,
    /// Joints that stay at a default angle.
    pub held: Vec<Joint>,
    /// Terms of one observation, without those of the past and of the critic.
    pub terms: Vec<Term>,
    base: String,
    /// Rotation from the frame of the file's base to the one that the policy knows, whose x axis points forward.
    forward_wxyz: [f64; 4],
    feet: Vec<String>,
    /// Pairs of bodies that do not touch each other.
    excluded: Vec<[String; 2]>,
    /// Default height and orientation of the base.
    height_m: f64,
    orientation_wxyz: Vec<f64>,
    /// What the policy imitates, for the motion task.
    imitated: Option<Imitated>,
}

impl Contract {
    /// Returns the contract of policies for an environment; `None` if its task is neither the velocity nor the motion task.
    pub fn new(environment: &Environment) -> anyhow::Result<Option<Self>> {
        let config = environment.config();
        if !matches!(config.env.chosen_task(), ChosenTask::Velocity | ChosenTask::Motion) {
            return Ok(None);
        }
        let model = environment.physics().model();
        let robot: &Robot = model.robot.as_ref().context("the task has no robot card")?;
        let joint = |(index, control): (usize, &HingeControl)| Joint {
            name: model.hinges[index].name.clone(),
            default_rad: robot.default_position[7 + index],
            kp: control.kp,
            kd: control.kd,
            // A limit of the file's joint holds too.
            effort_nm: model.effort_nm(index).unwrap_or(control.effort_nm),
            armature_kgm2: model.hinges[index].armature_kgm2,
            action_scale_rad: control.action_scale_rad,
            motor: robot.motor_number(&model.hinges[index].name).unwrap_or(index),
        };
        let of = |is_held: bool| robot.hinges.iter().enumerate().filter(move |(_, hinge)| hinge.is_held == is_held);
        Ok(Some(Self {
            config: config.clone(),
            joints: of(false).map(joint).collect(),
            held: of(true).map(joint).collect(),
            terms: terms(environment)?,
            base: model.links[0].name.clone(),
            forward_wxyz: {
                let turn = robot.forward.turn();
                [turn.w, turn.i, turn.j, turn.k]
            },
            feet: robot.feet.iter().map(|foot| model.links[*foot].name.clone()).collect(),
            excluded: robot.excluded.iter().map(|pair| pair.map(|link| model.links[link].name.clone())).collect(),
            height_m: robot.default_position[2],
            orientation_wxyz: robot.default_position[3..7].to_vec(),
            imitated: Imitated::of(environment),
        }))
    }

    /// Returns whether the policy knows another frame of the base than the file.
    pub fn turns_base(&self) -> bool {
        self.forward_wxyz[0] < 1.0
    }

    /// Returns the number of observations that the policy sees together.
    pub fn history(&self) -> u32 {
        if self.imitated.is_some() { 1 } else { self.config.velocity.history }
    }

    /// Returns whether the policy imitates a motion.
    pub fn imitates(&self) -> bool {
        self.imitated.is_some()
    }

    /// Returns the duration of a control step (s).
    pub fn control_step_s(&self) -> f64 {
        self.config.env.control_step_s
    }

    /// Returns the range of each joint's action, and its metadata under the names that mjlab uses.
    pub fn for_controller(&self, ports: Ports) -> anyhow::Result<ForController> {
        let listed = |number: fn(&Joint) -> f64| -> String {
            self.joints.iter().map(|joint| number(joint).to_string()).collect::<Vec<_>>().join(",")
        };
        let names = |names: Vec<&str>| names.join(",");
        let is_single = self.history() == 1;
        let metadata = [
            ("joint_names", names(self.joints.iter().map(|joint| &joint.name[..]).collect())),
            ("joint_stiffness", listed(|joint| joint.kp)),
            ("joint_damping", listed(|joint| joint.kd)),
            ("default_joint_pos", listed(|joint| joint.default_rad)),
            ("action_scale", listed(|joint| joint.action_scale_rad)),
            ("observation_names", names(self.terms.iter().map(|term| term.mjlab_name).collect())),
            ("observation_terms_scale", names(vec!["1"; self.terms.len()])),
            ("observation_terms_clip", names(vec!["-inf;inf"; self.terms.len()])),
            // mjlab lists all frames of a term, then those of the next one, which is another layout than ours.
            (
                "observation_terms_history_length",
                names(vec![if is_single { "0" } else { "whole frames" }; self.terms.len()]),
            ),
            ("command_names", if self.imitated.is_some() { "motion" } else { "base_velocity" }.to_owned()),
            ("history", self.history().to_string()),
            ("control_step_s", self.control_step_s().to_string()),
            ("treadmill.contract", self.json().to_string()),
        ];
        if let Some(joint) = self.joints.iter().find(|joint| joint.name.contains(',')) {
            anyhow::bail!("the joint `{}` has a comma in its name, which separates joints; rename it", joint.name);
        }
        let of_motion = self.imitated.as_ref().map(Imitated::metadata).unwrap_or_default();
        let metadata = metadata.into_iter().chain(of_motion).map(|(key, value)| (key.to_owned(), value)).collect();
        // What mjlab's players of motions ask for.
        let ports = if self.imitated.is_some() { Ports::UNITREE } else { ports };
        let motion = self.imitated.as_ref().map(|imitated| imitated.tables.clone());
        let is_residual = self.imitated.is_some() && self.config.motion.residual_action;
        let of_joints = |number: fn(&Joint) -> f64| self.joints.iter().map(|joint| number(joint) as f32).collect();
        let offset = is_residual.then(|| OnnxOffset {
            centre: of_joints(|joint| joint.default_rad),
            scale: of_joints(|joint| joint.action_scale_rad),
        });
        Ok(ForController { action_limit: Some(ACTION_MAX as f32), ports, motion, offset, metadata })
    }

    /// Returns the whole contract.
    fn json(&self) -> Value {
        let EnvironmentConfig { env, velocity, randomisation, .. } = &self.config;
        let calm = Calm::of(velocity);
        let mut contract = lists(&self.joints);
        contract["action_scale"] = self.joints.iter().map(|joint| joint.action_scale_rad).collect();
        let terms: Vec<Value> = self
            .terms
            .iter()
            .map(|Term { name, unit, frame, size, .. }| {
                json!({"name": name, "size": size, "unit": unit, "frame": frame})
            })
            .collect();
        let shared = [
            ("format", json!(FORMAT)),
            ("control_step_s", json!(env.control_step_s)),
            ("substeps", json!(env.substeps)),
            ("action_limit", json!(ACTION_MAX)),
            ("held_joints", lists(&self.held)),
            ("base_body", json!(self.base)),
            ("excluded_bodies", json!(self.excluded)),
            ("base_turn_wxyz", json!(self.forward_wxyz)),
            ("feet_bodies", json!(self.feet)),
            ("default_base_height_m", json!(self.height_m)),
            ("default_base_orientation_wxyz", json!(self.orientation_wxyz)),
            ("observation", json!(terms)),
            ("push_interval_s", json!(randomisation.push_interval_s)),
            ("push_mps", json!(randomisation.push_mps)),
        ];
        shared.into_iter().for_each(|(key, value)| contract[key] = value);
        if let Some(imitated) = &self.imitated {
            contract["motion"] = imitated.json(&self.config.motion);
            return contract;
        }
        for (key, value) in [
            (
                "history",
                json!({
                    "frames": velocity.history,
                    "order": "oldest first",
                    "layout": "whole frames, one after the other",
                    "start": "the first observation of an episode fills all frames",
                }),
            ),
            ("gait_period_s", json!(velocity.gait_period_s)),
            // Norm of the command below which the phase is (0, 0).
            ("gait_rests_below", json!(if velocity.gait_rests { STANDING_COMMAND } else { 0.0 })),
            // Time for which it must have been below, and for which the phase comes back when the base turns faster than
            // this; after some time at rest a slower turn is enough.
            ("gait_rests_after_s", json!(velocity.gait_rests_after_s)),
            ("gait_rests_rate_radps", json!(calm.rate_radps)),
            ("gait_rests_settled_s", json!(calm.settled_s)),
            ("gait_rests_settled_rate_radps", json!(calm.settled_rate_radps)),
            (
                "height_scan",
                json!({
                    "points": SCAN_GRID,
                    "spacing_m": SCAN_SPACING_M,
                    "limit_m": SCAN_MAX_M,
                    "order": "rows from right to left, each from back to front, around the base",
                    "value": "height of the ground above the base's height less its default height",
                }),
            ),
            (
                "commands",
                json!({
                    "lin_vel_x_mps": velocity.lin_vel_x_mps,
                    "lin_vel_y_mps": velocity.lin_vel_y_mps,
                    "ang_vel_z_radps": velocity.ang_vel_z_radps,
                    "resampling_s": velocity.resampling_s,
                    "standing_share": velocity.standing_share,
                    "heading_share": velocity.heading_share,
                    "heading_gain_per_s": HEADING_GAIN,
                }),
            ),
            (
                "fall",
                json!({
                    "height_m": velocity.fall_height_share * self.height_m,
                    "tilt_rad": velocity.fall_tilt_rad,
                }),
            ),
        ] {
            contract[key] = value;
        }
        contract
    }
}

/// Returns the lists of joints' properties, in the order of the joints.
fn lists(joints: &[Joint]) -> Value {
    let of = |number: fn(&Joint) -> f64| -> Vec<f64> { joints.iter().map(number).collect() };
    json!({
        "joint_names": joints.iter().map(|joint| &joint.name[..]).collect::<Vec<_>>(),
        "default_joint_pos": of(|joint| joint.default_rad),
        "joint_stiffness": of(|joint| joint.kp),
        "joint_damping": of(|joint| joint.kd),
        "joint_effort": of(|joint| joint.effort_nm),
        "joint_armature": of(|joint| joint.armature_kgm2),
    })
}

/// Returns the terms of one observation of the policy, the newest of its history.
fn terms(environment: &Environment) -> anyhow::Result<Vec<Term>> {
    let of_policy: Vec<_> = environment.terms().iter().filter(|term| !term.is_privileged).collect();
    let config = environment.config();
    match config.env.chosen_task() {
        ChosenTask::Motion => described(MOTION_OBSERVATION, &of_policy, config),
        _ => described(TERMS, &of_policy[..of_policy.len() / config.velocity.history as usize], config),
    }
}

/// Returns what a table says of these terms.
fn described<S: Shown>(
    table: &[TermRow<S>],
    terms: &[&ObservationTerm],
    config: &EnvironmentConfig,
) -> anyhow::Result<Vec<Term>> {
    let of_term = |term: &&ObservationTerm| {
        let row = table.iter().find(|row| row.name == term.name);
        let row = row.with_context(|| format!("the policy observes `{}`, which is no term of the task", term.name))?;
        let TermRow { name, mjlab_name, unit, frame, .. } = *row;
        Ok(Term { name, mjlab_name, unit, frame, deploy_params: (row.deploy_params)(config), size: term.range.len() })
    };
    terms.iter().map(of_term).collect()
}
