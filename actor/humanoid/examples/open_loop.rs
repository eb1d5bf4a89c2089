//! Simulates given actions from given states and prints every following state, for comparison with other simulators.
//!
//! Usage: `open_loop [CASES.json]`; without a file, the cases come from standard input.
//!
//! Input: a JSON list of cases, each `{"qpos": [24], "qvel": [23], "actions": [[17], …], "model_file": "x.xml or card.toml",
//! "config": {"substeps": 2, "control_step_s": 0.015, "self_collision": true}}`. The last two entries and each setting are
//! optional. Vectors are MuJoCo's: see `treadmill_humanoid::physics`.
//!
//! Output: a JSON list with one list per case, one object per control step: `{"qpos", "qvel", "limit_overshoot_rad",
//! "bodies_in_contact", "contact_force_n"}`. The force is the sum over links of the magnitude of the mean contact force
//! during the step. A case ends early when its physics is not finite.

use std::{
    error::Error,
    fs,
    io::{self, BufWriter, Read, Write},
    path::Path,
};

use serde::{Deserialize, Serialize};
use treadmill_humanoid::{HUMANOID_XML, Model, ModelFiles, Physics, PhysicsSettings, read_model_file};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    qpos: Vec<f64>,
    qvel: Vec<f64>,
    actions: Vec<Vec<f32>>,
    #[serde(default)]
    model_file: Option<String>,
    #[serde(default)]
    config: Overrides,
}

/// Settings that replace the defaults.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Overrides {
    substeps: Option<u32>,
    control_step_s: Option<f64>,
    self_collision: Option<bool>,
}

#[derive(Serialize)]
struct State {
    qpos: Vec<f64>,
    qvel: Vec<f64>,
    limit_overshoot_rad: f64,
    bodies_in_contact: usize,
    contact_force_n: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let text = match std::env::args().nth(1) {
        Some(path) => fs::read_to_string(&path).map_err(|why| format!("cannot read `{path}`: {why}"))?,
        None => {
            let mut text = String::new();
            io::stdin().read_to_string(&mut text)?;
            text
        }
    };
    let cases: Vec<Case> = serde_json::from_str(&text).map_err(|why| format!("the cases are unreadable: {why}"))?;
    let states = cases
        .iter()
        .enumerate()
        .map(|(index, case)| simulate(case).map_err(|why| format!("case {index}: {why}").into()))
        .collect::<Result<Vec<_>, Box<dyn Error>>>()?;
    let mut out = BufWriter::new(io::stdout().lock());
    serde_json::to_writer(&mut out, &states)?;
    writeln!(out)?;
    Ok(out.flush()?)
}

fn simulate(case: &Case) -> Result<Vec<State>, Box<dyn Error>> {
    let xml = match &case.model_file {
        Some(path) => read_model_file(Path::new(path), &ModelFiles::default())?,
        None => HUMANOID_XML.to_string(),
    };
    let mut physics = Physics::new(Model::from_mjcf(&xml)?, case.config.settings())?;
    let model = physics.model();
    let (positions, velocities, motors) = (model.position_size(), model.velocity_size(), model.motors.len());
    check_length("qpos", case.qpos.len(), positions)?;
    check_length("qvel", case.qvel.len(), velocities)?;
    case.actions.iter().try_for_each(|action| check_length("an action", action.len(), motors))?;
    physics.set_state(&case.qpos, &case.qvel);
    let states = case.actions.iter().map_while(|action| physics.step_only(action).is_ok().then(|| state(&physics)));
    Ok(states.collect())
}

fn check_length(what: &str, found: usize, expected: usize) -> Result<(), String> {
    if found == expected { Ok(()) } else { Err(format!("{what} has {found} numbers; the model needs {expected}")) }
}

fn state(physics: &Physics) -> State {
    let forces = (0..physics.model().links.len()).map(|link| physics.contact_wrench(link).0.norm());
    State {
        qpos: physics.position().to_vec(),
        qvel: physics.velocity().to_vec(),
        limit_overshoot_rad: physics.limit_overshoot_rad(),
        bodies_in_contact: forces.clone().filter(|force_n| *force_n > 0.0).count(),
        contact_force_n: forces.sum(),
    }
}

impl Overrides {
    fn settings(&self) -> PhysicsSettings {
        let defaults = PhysicsSettings::default();
        PhysicsSettings {
            substeps: self.substeps.unwrap_or(defaults.substeps),
            control_step_s: self.control_step_s.unwrap_or(defaults.control_step_s),
            self_collision: self.self_collision.unwrap_or(defaults.self_collision),
        }
    }
}
