//! Motion of a policy that imitates one: the tables that its ONNX file gives out, and what a player must know of them.

use std::any::Any;

use serde_json::{Value, json};
use treadmill_humanoid::{Environment, config::MotionConfig, task::motion::MotionTask};
use treadmill_proto::onnx::OnnxMotion;

/// What a policy imitates.
pub(super) struct Imitated {
    /// Row k of each table is what the control step k is to reach, as mjlab's players read it.
    pub tables: OnnxMotion,
    anchor: String,
    bodies: Vec<String>,
    ends: Vec<String>,
    /// Name, first row and rows of each motion, and the state in which it begins.
    motions: Vec<Value>,
}

impl Imitated {
    /// Returns what the policies of an environment imitate; `None` for other tasks.
    pub fn of(environment: &Environment) -> Option<Self> {
        let task: &dyn Any = environment.task();
        let task: &MotionTask = task.downcast_ref()?;
        let model = environment.physics().model();
        let name = |link: usize| model.links[link].name.clone();
        let compared = task.compared();
        let (motors, links) = (model.motors.len(), compared.links.len());
        let mut tables: [Vec<f32>; 6] = Default::default();
        let (mut rows, mut motions) = (0, Vec::new());
        for (motion, steps) in model.motions.iter().zip(task.motions()) {
            let (position, velocity, _) = task.at(steps.start);
            // The policy sees where it is to be after the step, so the first row is the second pose.
            let count = steps.len() - 1;
            motions.push(json!({
                "name": motion.name,
                "first_row": rows,
                "rows": count,
                "start_position": position,
                "start_velocity": velocity,
            }));
            rows += count;
            for step in steps.start + 1..steps.end {
                let (position, velocity, links) = task.at(step);
                let [angles, rates, places, turns, linear, angular] = &mut tables;
                angles.extend(model.motors.iter().map(|motor| position[7 + motor.hinge] as f32));
                rates.extend(model.motors.iter().map(|motor| velocity[6 + motor.hinge] as f32));
                for (link, number) in links.zip(&compared.links) {
                    places.extend(link.pose.translation.vector.iter().map(|part| *part as f32));
                    // Players know the base of the file, see `Robot::forward`.
                    let robot = model.robot.as_ref().filter(|_| *number == 0);
                    let back = robot.map(|robot| robot.forward.turn().inverse()).unwrap_or_default();
                    let turn = link.pose.rotation * back;
                    turns.extend([turn.w, turn.i, turn.j, turn.k].map(|part| part as f32));
                    linear.extend(link.linear_mps.iter().map(|part| *part as f32));
                    angular.extend(link.angular_radps.iter().map(|part| *part as f32));
                }
            }
        }
        let names = ["joint_pos", "joint_vel", "body_pos_w", "body_quat_w", "body_lin_vel_w", "body_ang_vel_w"];
        let shapes = [vec![motors], vec![motors], vec![links, 3], vec![links, 4], vec![links, 3], vec![links, 3]];
        let tables = names.into_iter().zip(shapes).zip(tables).map(|((name, shape), table)| (name, shape, table));
        Some(Self {
            tables: OnnxMotion { rows, tables: tables.collect() },
            anchor: name(compared.anchor),
            bodies: compared.links.iter().map(|link| name(*link)).collect(),
            ends: compared.ends.iter().map(|end| name(compared.links[*end])).collect(),
            motions,
        })
    }

    /// Returns metadata under the names of mjlab's players.
    pub fn metadata(&self) -> Vec<(&'static str, String)> {
        vec![("anchor_body_name", self.anchor.clone()), ("body_names", self.bodies.join(","))]
    }

    /// Returns the part of the contract about the motion.
    pub fn json(&self, config: &MotionConfig) -> Value {
        json!({
            "anchor_body_name": self.anchor,
            "body_names": self.bodies,
            "end_effector_names": self.ends,
            "row": "what the control step is to reach",
            "rows": self.tables.rows,
            "motions": self.motions,
            "residual_action": config.residual_action,
            "future_steps": config.future_steps,
            "anchor_height_max_m": config.anchor_height_max_m,
            "anchor_tilt_max": config.anchor_tilt_max,
            "end_effector_height_max_m": config.end_effector_height_max_m,
            "start_xy_m": config.start_xy_m,
            "start_z_m": config.start_z_m,
            "start_tilt_rad": config.start_tilt_rad,
            "start_yaw_rad": config.start_yaw_rad,
            "start_xy_mps": config.start_xy_mps,
            "start_z_mps": config.start_z_mps,
            "start_tilt_radps": config.start_tilt_radps,
            "start_yaw_radps": config.start_yaw_radps,
            "start_hinge_rad": config.start_hinge_rad,
        })
    }
}
