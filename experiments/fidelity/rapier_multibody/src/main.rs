//! Simulates the humanoid as a multibody of Rapier, for comparison with Treadmill's own physics.
//!
//! Usage: `rapier-multibody < CASES.json`, or `rapier-multibody --speed MODEL.xml [--steps 20000] [--set KEY=VALUE]…`.
//!
//! Input and output are those of `actor/humanoid/examples/open_loop.rs`, without contact forces. A case needs a `model_file`;
//! its `config` holds [`settings::MultibodySettings`].
//!
//! `--speed` steps 64 humanoids in turn with random actions, resets those whose torso is not between 1 m and 2 m high, and
//! prints one JSON object.
//!
//! What Rapier cannot represent:
//!
//! - Soft limits: Rapier corrects a hinge beyond its limit within about one step.
//! - Soft contacts as MuJoCo's: Rapier's defaults remain.
//! - Motors as torques of a hinge: each motor applies opposite torques to both links, about the axis at the step's start.
//! - `condim`: links have no friction among each other, and Rapier's friction on the floor.
//!
//! Springs, damping and rotors are Rapier's own, implicit ones.

// One file makes the worlds of both precisions.
#![allow(clippy::duplicate_mod, clippy::unnecessary_cast, clippy::useless_conversion)]
#![allow(clippy::large_enum_variant)] // Worlds are built once.

mod double;
mod robot;
mod settings;
mod single;

use std::{
    collections::HashMap,
    error::Error,
    fs,
    io::{self, Read},
    time::Instant,
};

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::{
    robot::MultibodyRobot,
    settings::{CONTROL_STEP_S, MultibodySettings},
};

/// Number of humanoids that `--speed` steps in turn, as `treadmill bench env`.
const WORLDS: usize = 64;
const HEALTHY_M: std::ops::Range<f64> = 1.0..2.0;
const RESET_NOISE: f64 = 0.01;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    qpos: Vec<f64>,
    qvel: Vec<f64>,
    actions: Vec<Vec<f64>>,
    model_file: String,
    #[serde(default)]
    config: MultibodySettings,
}

#[derive(Serialize)]
struct State {
    qpos: Vec<f64>,
    qvel: Vec<f64>,
    limit_overshoot_rad: f64,
}

/// World in either precision.
enum World {
    Single(single::MultibodyWorld),
    Double(double::MultibodyWorld),
}

impl World {
    fn new(robot: &MultibodyRobot, settings: MultibodySettings) -> Self {
        if settings.double {
            Self::Double(double::MultibodyWorld::new(robot, settings, CONTROL_STEP_S))
        } else {
            Self::Single(single::MultibodyWorld::new(robot, settings, CONTROL_STEP_S))
        }
    }

    fn set_state(&mut self, qpos: &[f64], qvel: &[f64]) {
        match self {
            Self::Single(world) => world.set_state(qpos, qvel),
            Self::Double(world) => world.set_state(qpos, qvel),
        }
    }

    fn step(&mut self, controls: &[f64]) -> bool {
        match self {
            Self::Single(world) => world.step(controls),
            Self::Double(world) => world.step(controls),
        }
    }

    fn state(&self) -> (Vec<f64>, Vec<f64>) {
        match self {
            Self::Single(world) => world.state(),
            Self::Double(world) => world.state(),
        }
    }

    fn height(&self) -> f64 {
        match self {
            Self::Single(world) => world.height(),
            Self::Double(world) => world.height(),
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let result = match arguments.first().map(String::as_str) {
        None => play()?,
        Some("--speed") => speed(&arguments[1..])?,
        Some(other) => return Err(format!("unknown argument `{other}`").into()),
    };
    println!("{result}");
    Ok(())
}

fn play() -> Result<Value, Box<dyn Error>> {
    let mut text = String::new();
    io::stdin().read_to_string(&mut text)?;
    let cases: Vec<Case> = serde_json::from_str(&text).map_err(|why| format!("the cases are unreadable: {why}"))?;
    let mut robots = HashMap::new();
    let mut played = Vec::new();
    for case in &cases {
        if !robots.contains_key(&case.model_file) {
            robots.insert(case.model_file.clone(), read(&case.model_file)?);
        }
        played.push(simulate(&robots[&case.model_file], case));
    }
    Ok(serde_json::to_value(played)?)
}

fn read(path: &str) -> Result<MultibodyRobot, String> {
    let xml = fs::read_to_string(path).map_err(|why| format!("cannot read `{path}`: {why}"))?;
    MultibodyRobot::from_mjcf(&xml)
}

/// Returns the states after each control step; they end early when the state is not finite.
fn simulate(robot: &MultibodyRobot, case: &Case) -> Vec<State> {
    let mut world = World::new(robot, case.config);
    world.set_state(&case.qpos, &case.qvel);
    let states = case.actions.iter().map_while(|action| world.step(action).then(|| state(robot, &world)));
    states.collect()
}

fn state(robot: &MultibodyRobot, world: &World) -> State {
    let (qpos, qvel) = world.state();
    let beyond = robot.hinges.iter().zip(&qpos[7..]).filter_map(|(link, angle)| {
        let [low, high] = robot.links[*link].hinge?.range?;
        Some((low - angle).max(angle - high))
    });
    let limit_overshoot_rad = beyond.fold(0.0, f64::max);
    State { qpos, qvel, limit_overshoot_rad }
}

fn speed(arguments: &[String]) -> Result<Value, Box<dyn Error>> {
    let path = arguments.first().ok_or("--speed needs a model file")?;
    let robot = read(path)?;
    let (mut steps, mut given) = (20_000, serde_json::Map::new());
    for pair in arguments[1..].chunks(2) {
        match pair {
            [flag, value] if flag == "--steps" => steps = value.parse()?,
            [flag, value] if flag == "--set" => {
                let (key, value) = value.split_once('=').ok_or("--set needs KEY=VALUE")?;
                given.insert(key.to_string(), serde_json::from_str(value)?);
            }
            _ => return Err(format!("unknown or incomplete flag `{}`", pair[0]).into()),
        }
    }
    let settings: MultibodySettings = serde_json::from_value(Value::Object(given))?;
    let mut random = Random(1);
    let mut worlds: Vec<World> = (0..WORLDS).map(|_| World::new(&robot, settings)).collect();
    worlds.iter_mut().for_each(|world| reset(world, &robot, &mut random));
    let actions: Vec<Vec<f64>> = (0..64 * WORLDS)
        .map(|_| robot.motors.iter().map(|motor| random.between(motor.control[0], motor.control[1])).collect())
        .collect();
    let rounds = usize::div_ceil(steps, WORLDS);
    let (mut resets, mut faults) = (0, 0);
    let begun = Instant::now();
    for round in 0..rounds {
        for (index, world) in worlds.iter_mut().enumerate() {
            let finite = world.step(&actions[(round * WORLDS + index) % actions.len()]);
            if !finite {
                // A world with numbers that are not finite may keep some of them.
                *world = World::new(&robot, settings);
                faults += 1;
            }
            if !finite || !HEALTHY_M.contains(&world.height()) {
                reset(world, &robot, &mut random);
                resets += 1;
            }
        }
    }
    let per_s = (rounds * WORLDS) as f64 / begun.elapsed().as_secs_f64();
    Ok(json!({"steps_per_s": per_s, "steps": rounds * WORLDS, "resets": resets, "faults": faults}))
}

/// Starts an episode: nominal pose with the task's reset noise.
fn reset(world: &mut World, robot: &MultibodyRobot, random: &mut Random) {
    let nominal = [0.0, 0.0, robot.height, 1.0, 0.0, 0.0, 0.0].into_iter().chain(robot.hinges.iter().map(|_| 0.0));
    let mut noise = || random.between(-RESET_NOISE, RESET_NOISE);
    let qpos: Vec<f64> = nominal.map(|number| number + noise()).collect();
    let qvel: Vec<f64> = (0..qpos.len() - 1).map(|_| noise()).collect();
    world.set_state(&qpos, &qvel);
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        low + (high - low) * ((bits >> 11) as f64 / (1u64 << 53) as f64)
    }
}
