//! Records poses in Rerun: body, floor, trail, contacts and curves.

use std::collections::VecDeque;

use rerun::{
    Arrows3D, Boxes3D, Color, EntityPath, LineStrips3D, Points3D, RecordingStream, RecordingStreamResult, Scalars,
    SeriesLines, TextLog, Transform3D, ViewCoordinates, components::FillMode, datatypes::Quaternion,
};
use treadmill_humanoid::{Model, mjcf::VisualMesh};
use treadmill_proto::{
    Pose,
    pose::{BODY_NUMBERS, COMMAND_NUMBERS, CONTACT_NUMBERS},
};

use crate::{
    layout::{self, paths},
    shapes,
};

/// Most points of the trail, one each [`TRAIL_EVERY_S`]: those of 15 s.
const TRAIL_POINTS: usize = 100;
const TRAIL_EVERY_S: f64 = 0.15;
/// Gap between two episodes on the timeline.
const PAUSE_S: f64 = 0.5;
/// Force of an arrow of 1 m.
const NEWTONS_PER_M: f32 = 1500.0;
/// Half side of the drawn floor around the body, whose edge is close to the horizon.
const FLOOR_HALF_M: f32 = 60.0;
/// Half side of the floor's grid of 1 m squares.
const GRID_HALF_M: i32 = 20;
const FLOOR: [u8; 3] = [62, 66, 71];
const LINES: [u8; 3] = [98, 103, 110];
const TRAIL: [u8; 3] = [240, 200, 60];
const CONTACT: [u8; 3] = [235, 70, 70];
const COMMANDED: [u8; 3] = [80, 200, 120];
const ACTUAL: [u8; 3] = [90, 150, 240];
/// Height of the arrows above the base (m), and length of that of 1 m/s (m).
const ARROWS_ABOVE_M: f32 = 0.7;
const ARROW_M: f32 = 0.8;
/// Names of the curves of commands and velocities.
const COMMAND_CURVES: [&str; 6] =
    ["forward, commanded", "left, commanded", "turn, commanded", "forward m/s", "left m/s", "turn rad/s"];
/// Names of the reward's curves.
const REWARD_TERMS: [&str; 5] = ["reward", "forward", "healthy", "control", "contact"];

/// Logs poses to Rerun and keeps the state of its timelines.
pub struct SceneRecorder {
    recording: RecordingStream,
    model: Model,
    /// Shown instead of the shapes, if there are any.
    visuals: Vec<VisualMesh>,
    bodies: Vec<EntityPath>,
    is_body_logged: bool,
    episode: Option<EpisodeKey>,
    /// Start of the episode on the timelines.
    start_s: f64,
    start_step: i64,
    shown_s: f64,
    shown_step: i64,
    trail: VecDeque<[f32; 3]>,
    trail_s: f64,
    square: Option<[i32; 2]>,
}

/// Identity of an episode.
#[derive(Clone, PartialEq)]
struct EpisodeKey {
    actor: String,
    incarnation: u64,
    episode: u64,
}

impl SceneRecorder {
    /// Creates a recorder for a robot, shown by these meshes if there are any.
    pub fn new(recording: RecordingStream, model: Model, visuals: Vec<VisualMesh>) -> Self {
        let name = |(index, body): (usize, &treadmill_humanoid::model::Body)| {
            let name = if body.name.is_empty() { format!("body {index}") } else { body.name.clone() };
            EntityPath::from(vec![paths::WORLD.into(), paths::BODY.into(), name.into()])
        };
        Self {
            bodies: model.bodies.iter().enumerate().map(name).collect(),
            recording,
            model,
            visuals,
            is_body_logged: false,
            episode: None,
            start_s: 0.0,
            start_step: 0,
            shown_s: 0.0,
            shown_step: 0,
            trail: VecDeque::new(),
            trail_s: 0.0,
            square: None,
        }
    }

    /// Returns the duration of the recorded motion on the timeline (s).
    pub fn shown_s(&self) -> f64 {
        self.shown_s
    }

    /// Logs the ground and the names of the curves.
    pub fn set_up(&self) -> RecordingStreamResult<()> {
        let rec = &self.recording;
        rec.log_static(paths::WORLD, &ViewCoordinates::RIGHT_HAND_Z_UP())?;
        match &self.model.ground.height_field {
            Some(field) => shapes::log_height_field(rec, format!("{}/field", paths::WORLD), field, colour(LINES))?,
            None => self.log_plane()?,
        }
        rec.log_static(paths::REWARD, &SeriesLines::new().with_names(REWARD_TERMS))?;
        rec.log_static(paths::VELOCITY, &SeriesLines::new().with_names(["forward m/s", "distance / 10 m"]))?;
        rec.log_static(paths::COMMANDS, &SeriesLines::new().with_names(COMMAND_CURVES))?;
        let hinges = self.model.hinges.iter().map(|hinge| hinge.name.as_str());
        rec.log_static(paths::TORQUES, &SeriesLines::new().with_names(hinges))
    }

    fn log_plane(&self) -> RecordingStreamResult<()> {
        let rec = &self.recording;
        let plate = Boxes3D::from_centers_and_half_sizes([[0.0, 0.0, -0.02]], [[FLOOR_HALF_M, FLOOR_HALF_M, 0.018]]);
        let plate = plate.with_colors([colour(FLOOR)]).with_fill_mode(FillMode::Solid);
        rec.log_static(format!("{}/plate", paths::FLOOR), &plate)?;
        let end = GRID_HALF_M as f32;
        let lines = (-GRID_HALF_M..=GRID_HALF_M).map(|at| at as f32);
        let lines = lines.flat_map(|at| [[[-end, at, 0.0], [end, at, 0.0]], [[at, -end, 0.0], [at, end, 0.0]]]);
        let lines = LineStrips3D::new(lines).with_colors([colour(LINES)]).with_radii([0.008]);
        rec.log_static(format!("{}/lines", paths::FLOOR), &lines)
    }

    /// Logs one pose; ignores poses that do not fit the model.
    pub fn show(&mut self, pose: &Pose) -> RecordingStreamResult<()> {
        let body_poses = pose.bodies.as_chunks::<BODY_NUMBERS>().0;
        let [torso, ..] = body_poses else { return Ok(()) };
        if body_poses.len() != self.bodies.len() || pose.joint_torques_nm.len() != self.model.hinges.len() {
            return Ok(());
        }
        self.begin_episode(pose);
        self.shown_s = self.start_s + pose.time_s;
        self.shown_step = self.start_step + i64::from(pose.step);
        let rec = self.recording.clone();
        rec.set_duration_secs(paths::TIME, self.shown_s);
        rec.set_time_sequence(paths::STEP, self.shown_step);
        if !self.is_body_logged {
            for (body, path) in self.bodies.iter().enumerate() {
                match self.visuals.is_empty() {
                    true => shapes::log(&rec, path, &self.model, body)?,
                    false => shapes::log_visuals(&rec, path, &self.model, body, &self.visuals)?,
                }
            }
            self.is_body_logged = true;
        }
        if self.trail.is_empty() {
            let number = pose.version.map_or(0, |version| version.number);
            let text = match pose.actor.as_str() {
                "" => format!("episode {}", pose.episode),
                actor => format!("episode {} of {actor}, policy {number}", pose.episode),
            };
            rec.log(paths::EPISODES, &TextLog::new(text))?;
        }
        for (path, [x, y, z, w, i, j, k]) in self.bodies.iter().zip(body_poses) {
            let rotation = Quaternion::from_xyzw([*i, *j, *k, *w]);
            rec.log(path.clone(), &Transform3D::from_translation_rotation([*x, *y, *z], rotation))?;
        }
        let [x, y, z, ..] = *torso;
        rec.log(paths::FOLLOWED, &Points3D::new(layout::followed_m([x, y])).with_radii([0.0]))?;
        self.move_floor(&rec, [x, y])?;
        self.log_trail(&rec, [x, y, z])?;
        let contacts = pose.contacts.as_chunks::<CONTACT_NUMBERS>().0;
        let points: Vec<[f32; 3]> = contacts.iter().map(|[x, y, z, ..]| [*x, *y, *z]).collect();
        let forces: Vec<[f32; 3]> =
            contacts.iter().map(|[.., x, y, z]| [x / NEWTONS_PER_M, y / NEWTONS_PER_M, z / NEWTONS_PER_M]).collect();
        let arrows = Arrows3D::from_vectors(forces).with_origins(points.clone());
        rec.log(paths::FORCES, &arrows.with_colors([colour(CONTACT)]).with_radii([0.012]))?;
        rec.log(paths::POINTS, &Points3D::new(points).with_colors([colour(CONTACT)]).with_radii([0.025]))?;
        self.log_command(&rec, torso, pose)?;
        let terms = [pose.reward_forward, pose.reward_survive, pose.reward_ctrl, pose.reward_contact];
        let rewards = std::iter::once(terms.iter().sum()).chain(terms).map(f64::from);
        rec.log(paths::REWARD, &Scalars::new(rewards))?;
        rec.log(paths::VELOCITY, &Scalars::new([pose.velocity_mps, pose.distance_m / 10.0].map(f64::from)))?;
        rec.log(paths::TORQUES, &Scalars::new(pose.joint_torques_nm.iter().copied().map(f64::from)))
    }

    /// Logs arrows and curves of the commanded and the actual velocity, if the task has commands.
    fn log_command(
        &self,
        rec: &RecordingStream,
        [x, y, z, w, i, j, k]: &[f32; BODY_NUMBERS],
        pose: &Pose,
    ) -> RecordingStreamResult<()> {
        if pose.command.len() != COMMAND_NUMBERS || pose.base_velocity.len() != COMMAND_NUMBERS {
            return Ok(());
        }
        // Direction of the base's x axis on the ground.
        let (sin, cos) = (2.0 * (i * j + w * k)).atan2(1.0 - 2.0 * (j * j + k * k)).sin_cos();
        let in_world = |velocity: &[f32]| {
            [cos * velocity[0] - sin * velocity[1], sin * velocity[0] + cos * velocity[1], 0.0]
                .map(|part| ARROW_M * part)
        };
        let arrows = Arrows3D::from_vectors([in_world(&pose.command), in_world(&pose.base_velocity)]);
        let above = [*x, *y, z + ARROWS_ABOVE_M];
        let arrows = arrows.with_origins([above, [above[0], above[1], above[2] + 0.05]]);
        rec.log(paths::ARROWS, &arrows.with_colors([colour(COMMANDED), colour(ACTUAL)]).with_radii([0.015]))?;
        rec.log(paths::COMMANDS, &Scalars::new(pose.command.iter().chain(&pose.base_velocity).copied().map(f64::from)))
    }

    /// Starts a new episode after the previous one on the timelines.
    fn begin_episode(&mut self, pose: &Pose) {
        let key = EpisodeKey { actor: pose.actor.clone(), incarnation: pose.actor_incarnation, episode: pose.episode };
        if self.episode.as_ref() == Some(&key) {
            return;
        }
        if self.episode.is_some() {
            self.start_s = self.shown_s + PAUSE_S - pose.time_s;
            self.start_step = self.shown_step + 1 - i64::from(pose.step);
        }
        self.episode = Some(key);
        self.trail.clear();
    }

    /// Moves the floor with the body by whole metres, so that its lines seem fixed.
    fn move_floor(&mut self, rec: &RecordingStream, at_m: [f32; 2]) -> RecordingStreamResult<()> {
        let square = at_m.map(|at| at.round() as i32);
        if self.square == Some(square) {
            return Ok(());
        }
        self.square = Some(square);
        rec.log(paths::FLOOR, &Transform3D::from_translation([square[0] as f32, square[1] as f32, 0.0]))
    }

    fn log_trail(&mut self, rec: &RecordingStream, torso_m: [f32; 3]) -> RecordingStreamResult<()> {
        if self.trail.is_empty() || self.shown_s - self.trail_s >= TRAIL_EVERY_S {
            self.trail.push_back(torso_m);
            self.trail_s = self.shown_s;
            if self.trail.len() > TRAIL_POINTS {
                self.trail.pop_front();
            }
        }
        let strip: Vec<[f32; 3]> = self.trail.iter().copied().chain([torso_m]).collect();
        rec.log(paths::TRAIL, &LineStrips3D::new([strip]).with_colors([colour(TRAIL)]).with_radii([0.01]))
    }
}

fn colour([red, green, blue]: [u8; 3]) -> Color {
    Color::from_rgb(red, green, blue)
}
