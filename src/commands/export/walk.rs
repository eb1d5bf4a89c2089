//! Contract of a policy of Gymnasium's tasks: what a player must know of its robot, its motors and its observation.

use serde_json::{Value, json};
use treadmill_humanoid::{Environment, Model, ObservationTerm, config::ChosenTask};
use treadmill_policy::onnx::ForController;
use treadmill_proto::onnx::Ports;

/// Version of the contract; raised if an old reader would misunderstand a new one.
const FORMAT: u32 = 1;

/// Numbers of a link's inertia and of its motion or wrench, with their units.
const INERTIA: [(&str, &str); 10] = [
    ("inertia xx", "kg·m²"),
    ("inertia yy", "kg·m²"),
    ("inertia zz", "kg·m²"),
    ("inertia xy", "kg·m²"),
    ("inertia xz", "kg·m²"),
    ("inertia yz", "kg·m²"),
    ("mass times offset x", "kg·m"),
    ("mass times offset y", "kg·m"),
    ("mass times offset z", "kg·m"),
    ("mass", "kg"),
];
const MOTION: [(&str, &str); 6] = [
    ("angular velocity x", "rad/s"),
    ("angular velocity y", "rad/s"),
    ("angular velocity z", "rad/s"),
    ("velocity x", "m/s"),
    ("velocity y", "m/s"),
    ("velocity z", "m/s"),
];
const WRENCH: [(&str, &str); 6] = [
    ("moment x", "N·m"),
    ("moment y", "N·m"),
    ("moment z", "N·m"),
    ("force x", "N"),
    ("force y", "N"),
    ("force z", "N"),
];

/// Returns what the ONNX file says, beside what every file says; `None` if the task is not one of Gymnasium's.
pub(super) fn for_player(environment: &Environment) -> Option<ForController> {
    let task = environment.config().env.chosen_task();
    let is_gymnasium = matches!(task, ChosenTask::HumanoidV5 | ChosenTask::HumanoidV4);
    let metadata = vec![("treadmill.contract".to_owned(), contract(environment).to_string())];
    is_gymnasium.then_some(ForController {
        action_limit: None,
        ports: Ports::ANY_BATCH,
        motion: None,
        offset: None,
        metadata,
    })
}

fn contract(environment: &Environment) -> Value {
    let (env, model) = (&environment.config().env, environment.physics().model());
    let limits = |[low, high]: [f64; 2]| low.is_finite().then_some([low, high]);
    let motors: Vec<Value> = model
        .motors
        .iter()
        .map(|motor| {
            json!({
                "name": motor.name,
                "joint": model.hinges[motor.hinge].name,
                "gear": motor.gear_nm,
                "gain": motor.gain,
                "bias": motor.bias,
                "control": motor.control,
                "force": limits(motor.force),
            })
        })
        .collect();
    let observation: Vec<Value> = environment.terms().iter().map(|term| described(term, model)).collect();
    json!({
        "format": FORMAT,
        "task": env.task.name(),
        "control_step_s": env.control_step_s,
        "substeps": env.substeps,
        "base_body": model.links[0].name,
        "bodies": model.links.iter().map(|link| &link.name[..]).collect::<Vec<_>>(),
        "joint_names": model.hinges.iter().map(|hinge| &hinge.name[..]).collect::<Vec<_>>(),
        "motors": motors,
        "observation": observation,
        "start_position": environment.nominal_position(),
        "start_noise": env.reset_noise_scale,
        "healthy_z_range_m": env.healthy_z_range,
        "terminate_when_unhealthy": env.terminate_when_unhealthy,
    })
}

/// Returns a block of the observation with the meaning and unit of each entry.
fn described(term: &ObservationTerm, model: &Model) -> Value {
    let hinges = || model.hinges.iter().map(|hinge| hinge.name.clone());
    let of_base = |what: &str, axes: &str, unit| -> Vec<(String, &'static str)> {
        axes.chars().map(|axis| (format!("base {what}{axis}"), unit)).collect()
    };
    let size = term.range.len();
    let of_links = |parts: &[(&str, &'static str)]| -> Vec<(String, &'static str)> {
        // Gymnasium's v4 has the world's row, of zeros, before the links'.
        let world = (size == parts.len() * (model.links.len() + 1)).then_some("world");
        let names = world.into_iter().chain(model.links.iter().map(|link| &link.name[..]));
        names.flat_map(|link| parts.iter().map(move |(part, unit)| (format!("{link}: {part}"), *unit))).collect()
    };
    let rates = |what: &str, unit| hinges().map(|name| (format!("{what}{name}"), unit)).collect::<Vec<_>>();
    let (frame, entries) = match &term.name[..] {
        "qpos" => {
            let position = [of_base("", "xyz", "m"), of_base("quaternion ", "wxyz", "–"), rates("", "rad")].concat();
            // Without x and y, if they are excluded.
            ("world", position[position.len() - size..].to_vec())
        }
        "qvel" => {
            let base = [of_base("velocity ", "xyz", "m/s"), of_base("angular velocity ", "xyz", "rad/s")].concat();
            ("velocity: world; angular velocity: base", [base, rates("rate of ", "rad/s")].concat())
        }
        "cinert" => ("world's axes, about the centre of mass of the whole robot", of_links(&INERTIA)),
        "cvel" => ("world's axes, at the centre of mass of the whole robot", of_links(&MOTION)),
        "qfrc_actuator" => {
            let all =
                [of_base("force ", "xyz", "N"), of_base("torque ", "xyz", "N·m"), rates("torque of ", "N·m")].concat();
            ("joints", all[all.len() - size..].to_vec())
        }
        "cfrc_ext" => ("world's axes, about the centre of mass of the whole robot", of_links(&WRENCH)),
        _ => ("", Vec::new()),
    };
    let entries: Vec<Value> = entries.iter().map(|(name, unit)| json!({"name": name, "unit": unit})).collect();
    json!({"name": term.name, "size": size, "frame": frame, "entries": entries})
}
