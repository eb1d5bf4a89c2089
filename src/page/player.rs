//! One policy and its environment, played for the page.

use std::{any::Any, fs, time::SystemTime};

use anyhow::Context;
use bytes::Bytes;
use treadmill_actor::{
    agent::{Agent, PolicyAgent},
    poses,
};
use treadmill_config::{ChosenTask, Config, RandomisationConfig};
use treadmill_humanoid::{Environment, Model, Physics, TaskRegistry, task::motion::MotionTask};
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_proto::{
    Pose,
    page::{PageFrame, PageWorld, append_body, append_contact},
    pose::{BODY_NUMBERS, CONTACT_NUMBERS},
};
use treadmill_runtime::{run_folder::RunFolder, seeds};

use crate::shared::{
    saved_policy::{self, Origin, SavedPolicy},
    saved_run,
};

/// What changes with a run's checkpoints.
#[derive(Clone, Copy, PartialEq)]
enum Stamp {
    /// Times of the newest and the best one of a folder.
    Folder([Option<SystemTime>; 2]),
    /// Updates of the newest one of a store.
    Store(u64),
}

/// A store is asked for a newer policy at every this many refreshes.
const STORE_EVERY: u32 = 5;
/// Most contacts of a frame.
const CONTACTS_MAX: usize = 12;

/// Returns the world of a policy without randomisation, on ground of medium difficulty.
fn nominal(config: &Config) -> PageWorld {
    let ground_level = config.ground.levels / 2;
    PageWorld { mass_scale: 1.0, friction_scale: 1.0, motor_scale: 1.0, action_delay_steps: 0, ground_level }
}

/// Policy in an episode.
pub struct Player {
    run: String,
    which: Option<CheckpointChoice>,
    saved: SavedPolicy,
    world: PageWorld,
    /// That of the checkpoint that was read; `None` for a file.
    stamp: Option<Stamp>,
    is_stored: bool,
    refreshes: u32,
    environment: Environment,
    agent: PolicyAgent,
    seed: u64,
    episode: u64,
    step: u32,
    start_x_m: f64,
    observation: Vec<f32>,
    action: Vec<f32>,
    control: Vec<f32>,
    has_ended: bool,
    /// Robot that is where the motion is, for the motion task.
    ghost: Option<Physics>,
}

impl Player {
    /// Loads the policy that RUN names, in a nominal world.
    ///
    /// # Errors
    /// If there is no usable policy, or its task cannot be simulated here.
    pub fn load(tasks: &TaskRegistry, run: &str, which: Option<CheckpointChoice>, seed: u64) -> anyhow::Result<Self> {
        let saved = saved_policy::load(run, which)?;
        let world = nominal(&saved.config);
        let environment = build(tasks, run, &saved, &world)?;
        let agent = PolicyAgent::new(&saved.policy)?;
        let (observation, action) = (vec![0.0; environment.observation_size()], vec![0.0; environment.action_size()]);
        let mut player = Self {
            run: run.to_string(),
            which,
            stamp: None,
            is_stored: saved_run::store_url(run).is_some(),
            refreshes: 0,
            saved,
            world,
            environment,
            agent,
            seed,
            episode: 0,
            step: 0,
            start_x_m: 0.0,
            observation,
            control: action.clone(),
            action,
            has_ended: true,
            ghost: None,
        };
        player.add_ghost()?;
        player.begin_episode();
        Ok(player)
    }

    /// Returns the robot's model, with its ground.
    pub fn model(&self) -> &Model {
        self.environment.physics().model()
    }

    /// Returns the duration of a control step (s).
    pub fn control_step_s(&self) -> f64 {
        self.environment.control_step_s()
    }

    /// Returns the world that is simulated.
    pub fn world(&self) -> PageWorld {
        self.world
    }

    /// Returns the configuration that the policy was trained under.
    pub fn config(&self) -> &Config {
        &self.saved.config
    }

    /// Returns the command that the robot follows now; `None` if its task has none.
    pub fn command(&self) -> Option<[f64; 3]> {
        self.environment.task().command()
    }

    /// Returns the names of [`PageFrame::rewards_e3`].
    pub fn reward_terms(&self) -> Vec<String> {
        let mut names = Vec::new();
        self.environment.task().reward_terms(&mut |name, _| names.push(name.to_string()));
        names
    }

    /// Returns the run that it plays.
    pub fn run(&self) -> &str {
        &self.run
    }

    /// Returns where its policy comes from; `None` for a file that `export` wrote.
    pub fn origin(&self) -> Option<&Origin> {
        self.saved.origin.as_ref()
    }

    /// Loads a newer policy of the same run, if there is one, and plays on with it. Returns whether there was one.
    ///
    /// # Errors
    /// If the checkpoint cannot be read. The old policy plays on.
    pub fn refresh(&mut self) -> anyhow::Result<bool> {
        let Some(old_steps) = self.origin().map(|origin| origin.env_steps) else { return Ok(false) };
        self.refreshes += 1;
        if self.is_stored && !self.refreshes.is_multiple_of(STORE_EVERY) {
            return Ok(false);
        }
        let stamp = stamp(&self.run)?;
        if stamp == self.stamp {
            return Ok(false);
        }
        // The stamp of one that could not be read is not kept, so that it is tried again.
        let saved = saved_policy::load(&self.run, self.which)?;
        self.stamp = stamp;
        if saved.origin.as_ref().is_none_or(|new| new.env_steps == old_steps) {
            return Ok(false);
        }
        anyhow::ensure!(
            saved.policy.shape == self.saved.policy.shape && saved.policy.model_xml == self.saved.policy.model_xml,
            "run `{}` was begun anew with another robot or network; start watch again",
            self.run
        );
        self.agent = PolicyAgent::new(&saved.policy)?;
        self.saved = saved;
        Ok(true)
    }

    /// Builds another world.
    ///
    /// # Errors
    /// If a number of `world` is out of range.
    pub fn build_world(&self, tasks: &TaskRegistry, world: &PageWorld) -> anyhow::Result<Environment> {
        build(tasks, &self.run, &self.saved, world)
    }

    /// Starts anew in a world that was built for it.
    pub fn enter(&mut self, environment: Environment, world: &PageWorld) {
        (self.environment, self.world) = (environment, *world);
        self.begin_episode();
    }

    /// Makes the robot follow a command; `None` gives it its own commands again.
    pub fn steer(&mut self, command: Option<[f64; 3]>) {
        self.environment.steer(command);
    }

    /// Adds a velocity in the heading frame, forward and left (m/s), to all bodies.
    pub fn push(&mut self, [forward_mps, left_mps]: [f64; 2]) {
        let root = self.environment.physics().body_motion(0).pose.rotation;
        let forward = root * nalgebra::Vector3::x();
        let (sin, cos) = forward.y.atan2(forward.x).sin_cos();
        let velocity_mps = [cos * forward_mps - sin * left_mps, sin * forward_mps + cos * left_mps, 0.0];
        self.environment.physics_mut().push(velocity_mps.into());
    }

    /// Plays one step; an episode that has ended begins anew first.
    ///
    /// # Errors
    /// If the policy cannot act.
    pub fn step(&mut self) -> anyhow::Result<()> {
        if self.has_ended {
            self.begin_episode();
        }
        // The observation after the last step does not know a command that came since.
        self.environment.observe(&mut self.observation)?;
        self.agent.act(&self.observation, &mut self.action)?;
        self.environment.action_from_shares(&self.action, &mut self.control);
        let outcome = self.environment.step(&self.control, &mut self.observation);
        self.step += 1;
        self.has_ended = outcome.terminated || outcome.truncated;
        Ok(())
    }

    /// Returns the present frame, for the robot with this number.
    pub fn frame(&mut self, robot: u32, shown_s: f64) -> PageFrame {
        self.place_ghost();
        let physics = self.environment.physics();
        let mut rewards = Vec::new();
        self.environment.task().reward_terms(&mut |_, term| rewards.push(term as f32));
        let rewards_e3 = rounded(&rewards, 1000.0);
        let pose = Pose {
            episode: self.episode,
            time_s: f64::from(self.step) * self.control_step_s(),
            distance_m: (physics.position()[0] - self.start_x_m) as f32,
            ..poses::body_pose(&self.environment, self.command())
        };
        let velocity = poses::heading_velocity(physics).map(|part| part as f32).to_vec();
        let (ghost_base_m, ghost) = self.ghost_bodies();
        PageFrame { robot, shown_s, rewards_e3, velocity, ghost_base_m, ghost, ..frame_of(&pose) }
    }

    /// Adds the robot that shows the motion, if the task has one.
    fn add_ghost(&mut self) -> anyhow::Result<()> {
        if self.saved.config.env.chosen_task() == ChosenTask::Motion {
            let physics = self.environment.physics();
            self.ghost = Some(Physics::new(physics.model().clone(), *physics.settings())?);
        }
        Ok(())
    }

    /// Puts the robot that shows the motion where that is.
    fn place_ghost(&mut self) {
        let task: &dyn Any = self.environment.task();
        if let (Some(ghost), Some(task)) = (&mut self.ghost, task.downcast_ref::<MotionTask>()) {
            let rest = vec![0.0; ghost.model().velocity_size()];
            ghost.set_state(task.wanted_position(), &rest);
        }
    }

    /// Returns base and bodies of the robot that shows the motion, as [`PageFrame`] has them; empty without one.
    fn ghost_bodies(&self) -> (Vec<f32>, Bytes) {
        let Some(ghost) = &self.ghost else { return Default::default() };
        let numbers = poses::bodies(ghost);
        let bodies = numbers.as_chunks::<BODY_NUMBERS>().0;
        let base_m = bodies.first().map_or([0.0; 3], |[x, y, z, ..]| [*x, *y, *z]);
        let mut packed = Vec::new();
        bodies.iter().for_each(|body| append_body(&mut packed, base_m, body));
        (base_m.to_vec(), packed.into())
    }

    fn begin_episode(&mut self) {
        self.episode += 1;
        self.step = 0;
        self.has_ended = false;
        let seed = seeds::derive(self.seed, "evaluation", &[self.episode - 1]);
        self.environment.choose_start(self.episode - 1);
        self.environment.reset(seed, &mut self.observation);
        self.start_x_m = self.environment.physics().position()[0];
        self.agent.episode_ended();
    }
}

/// Returns what a pose says, with the terms of Gymnasium's reward.
#[must_use]
pub fn frame_of(pose: &Pose) -> PageFrame {
    let poses = pose.bodies.as_chunks::<BODY_NUMBERS>().0;
    let base_m = poses.first().map_or([0.0; 3], |[x, y, z, ..]| [*x, *y, *z]);
    let (mut bodies, mut contacts) = (Vec::new(), Vec::new());
    poses.iter().for_each(|body| append_body(&mut bodies, base_m, body));
    let touching = pose.contacts.as_chunks::<CONTACT_NUMBERS>().0.iter().take(CONTACTS_MAX);
    touching.for_each(|contact| append_contact(&mut contacts, base_m, contact));
    PageFrame {
        robot: 0,
        episode: pose.episode,
        time_s: pose.time_s,
        shown_s: pose.time_s,
        base_m: base_m.to_vec(),
        bodies: bodies.into(),
        contacts: contacts.into(),
        angles_mrad: rounded(&pose.joint_angles_rad, 1000.0),
        torques_cnm: rounded(&pose.joint_torques_nm, 100.0),
        rewards_e3: rounded(&[pose.reward_survive, pose.reward_forward, pose.reward_ctrl, pose.reward_contact], 1000.0),
        command: pose.command.clone(),
        velocity: pose.base_velocity.clone(),
        distance_m: pose.distance_m,
        centre_of_mass_m: pose.centre_of_mass_m.clone(),
        ghost_base_m: Vec::new(),
        ghost: Bytes::new(),
        controls_e2: rounded(&pose.joint_controls, 100.0),
    }
}

fn rounded(numbers: &[f32], units: f32) -> Vec<i32> {
    numbers.iter().map(|number| (number * units).round() as i32).collect()
}

/// Returns the stamp of a run's checkpoints; `None` for a file.
///
/// # Errors
/// If its store cannot be read.
fn stamp(run: &str) -> anyhow::Result<Option<Stamp>> {
    if let Some(url) = saved_run::store_url(run) {
        return Ok(saved_run::stored_updates(&url)?.map(Stamp::Store));
    }
    let Ok(folder) = RunFolder::open(run) else { return Ok(None) };
    let written = |name| fs::metadata(folder.checkpoints().join(name)).and_then(|file| file.modified()).ok();
    Ok(Some(Stamp::Folder(["latest.bundle", "best.bundle"].map(written))))
}

fn build(tasks: &TaskRegistry, run: &str, saved: &SavedPolicy, world: &PageWorld) -> anyhow::Result<Environment> {
    let mut config = saved.config.clone();
    let alike = |scale: f32| [f64::from(scale); 2];
    config.randomisation = RandomisationConfig {
        mass_scale: alike(world.mass_scale),
        floor_friction_scale: alike(world.friction_scale),
        motor_scale: alike(world.motor_scale),
        action_delay_steps: [world.action_delay_steps; 2],
        ..RandomisationConfig::default()
    };
    config.ground.curriculum = false;
    config.ground.start_level = world.ground_level.min(config.ground.levels - 1);
    config.check().context("the world of the page")?;
    saved_policy::environment(tasks, run, &saved.policy, &config)
}
