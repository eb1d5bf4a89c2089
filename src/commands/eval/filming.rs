//! Pictures of an evaluation, for `eval --film` and `eval --png`.

use std::{
    any::Any,
    fs,
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::{ArgGroup, Args};
use nalgebra::Point3;
use treadmill_actor::{evaluation::EvaluationStep, poses::heading_velocity};
use treadmill_humanoid::{
    Physics,
    task::{motion::MotionTask, velocity::BaseMotion},
};
use treadmill_render::{Camera, Look, Picture, Scene, film, look::Colour};
use treadmill_runtime::atomic_file;

use super::film::{Film, size};
use crate::launch::exit_code::Usage;

/// Flags of pictures.
#[derive(Args, Clone)]
#[command(group(ArgGroup::new("pictures").args(["film", "png"]).multiple(true)))]
pub struct FilmArgs {
    /// Write all episodes as an animation, a GIF, or a video if FILE ends in .mp4 (needs ffmpeg); needs no window and
    /// no GPU.
    #[arg(long, visible_alias = "gif", value_name = "FILE")]
    film: Option<PathBuf>,
    /// Write the pictures of all episodes to a folder, as 00000.png, 00001.png, ...
    #[arg(long, value_name = "FOLDER")]
    png: Option<PathBuf>,
    /// Width and height of the pictures, in pixels.
    #[arg(long, value_name = "WxH", default_value = "640x480", requires = "pictures", value_parser = size)]
    size: (u32, u32),
    /// Pictures per second.
    #[arg(
        long, value_name = "N", default_value_t = 25, requires = "pictures",
        value_parser = clap::value_parser!(u32).range(1..=50)
    )]
    fps: u32,
    /// Begin after this many seconds of each episode.
    #[arg(long, value_name = "S", default_value_t = 0.0, requires = "pictures", value_parser = seconds)]
    from_s: f64,
    /// Show this many seconds of each episode; by default until it ends.
    #[arg(long, value_name = "S", requires = "pictures", value_parser = seconds)]
    seconds: Option<f64>,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.0..=3600.0).contains(&seconds) => Ok(seconds),
        _ => Err("expected 0 to 3600 seconds".to_string()),
    }
}

/// Time constant (s) with which the camera follows the robot sideways and up, and of the mean of the actual velocity.
const FOLLOW_S: f64 = 0.5;
/// Direction of the camera from the robot: beside it, a little ahead and above.
const BESIDE: [f64; 3] = [1.3, -3.1, 0.6];
/// Share of the picture's height that a standing robot fills.
const FILLED: f64 = 0.5;
/// Share of the robot's height that its middle is from that of the picture before the camera moves up or down: the ground
/// stands still in the picture while the robot bobs.
const LEVEL: f64 = 0.03;
/// Metres to either side of the robot at which the ground has numbers.
const NUMBERED_M: i64 = 8;

/// Arrows of the commanded and of the actual velocity, the second one above the first.
const ARROWS: [Colour; 2] = [[0.15, 0.70, 0.25], [0.15, 0.35, 0.85]];
/// Length of an arrow per velocity (s).
const ARROW_S: f64 = 0.7;
/// Height of the arrows above the base, in heights of a standing base, and their distance (m).
const ARROWS_ABOVE: f64 = 0.8;
const ARROWS_APART_M: f64 = 0.06;

/// Colour of the motion that a robot imitates, and its distance to the left, away from the camera, in heights of the robot.
const GHOST: Colour = [0.62, 0.70, 0.78];
const GHOST_ASIDE: f64 = 0.75;

/// Recorder of the episodes.
pub struct Filming {
    args: FilmArgs,
    film: Option<Film>,
    control_step_s: f64,
    /// Pictures so far, and those of the present episode.
    taken: u32,
    taken_of_episode: u32,
    look: Look,
    /// Height of the robot in the first picture (m).
    height_m: Option<f64>,
    /// Point that the camera looks at.
    followed_m: Option<[f64; 3]>,
    /// Mean velocity in the heading frame, forward and left (m/s), and yaw rate (rad/s).
    motion: Option<[f64; 3]>,
    /// Robot that is where the motion is.
    ghost: Option<Physics>,
    failed: Option<anyhow::Error>,
}

/// What a picture shows.
struct Shown<'a> {
    physics: &'a Physics,
    time_s: f64,
    command: Option<[f64; 3]>,
    /// Position vector of the motion that the robot imitates.
    wanted: Option<&'a [f64]>,
}

impl FilmArgs {
    /// Returns the flags of a film with the usual size and rate.
    pub fn of_file(path: &Path) -> Self {
        Self { film: Some(path.to_owned()), png: None, size: (640, 480), fps: 25, from_s: 0.0, seconds: None }
    }

    /// Opens the outputs of a robot, whose look is needed only then; returns `None` if no pictures are wanted.
    pub fn begin(&self, control_step_s: f64, look: impl FnOnce() -> Look) -> anyhow::Result<Option<Filming>> {
        if self.film.is_none() && self.png.is_none() {
            return Ok(None);
        }
        let film = self.film.as_deref().map(|path| Film::open(path, self.size, self.fps)).transpose()?;
        if let Some(folder) = &self.png {
            make_empty(folder)?;
        }
        Ok(Some(Filming {
            args: self.clone(),
            film,
            control_step_s,
            taken: 0,
            taken_of_episode: 0,
            look: look(),
            height_m: None,
            followed_m: None,
            motion: None,
            ghost: None,
            failed: None,
        }))
    }
}

fn make_empty(folder: &Path) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("--png {}: cannot create the folder", folder.display()))?;
    let mut entries =
        fs::read_dir(folder).with_context(|| format!("--png {}: cannot read the folder", folder.display()))?;
    if entries.next().is_some() {
        let why = format!("--png {}: the folder is not empty; name a new or an empty one", folder.display());
        return Err(Usage(why).into());
    }
    Ok(())
}

impl Filming {
    /// Records a step of an evaluation.
    pub fn record(&mut self, step: &EvaluationStep) {
        if step.step == 1 {
            (self.taken_of_episode, self.followed_m, self.motion) = (0, None, None);
        }
        let task: &dyn Any = step.environment.task();
        self.show(&Shown {
            physics: step.environment.physics(),
            time_s: f64::from(step.step) * self.control_step_s,
            command: step.start.command,
            wanted: task.downcast_ref().map(MotionTask::wanted_position),
        });
    }

    /// Records a pose at a time (s).
    pub fn record_pose(&mut self, physics: &Physics, time_s: f64) {
        self.show(&Shown { physics, time_s, command: None, wanted: None });
    }

    fn show(&mut self, shown: &Shown<'_>) {
        let now = heading_velocity(shown.physics);
        self.motion = Some(nearer(self.motion, now, [self.control_step_s; 3]));
        if self.failed.is_none()
            && let Err(why) = self.take_picture(shown)
        {
            self.failed = Some(why);
        }
    }

    fn take_picture(&mut self, shown: &Shown<'_>) -> anyhow::Result<()> {
        let time_s = shown.time_s;
        // Takes the step nearest to the time at which a picture is due; several times if steps are longer than pictures.
        let due = self.due_pictures(time_s);
        if due == 0 {
            return Ok(());
        }
        let picture = self.picture(shown, due);
        for _ in 0..due {
            if let Some(film) = &mut self.film {
                film.add(&picture)?;
            }
            if let Some(folder) = &self.args.png {
                let path = folder.join(format!("{:05}.png", self.taken));
                atomic_file::write(&path, &film::png(&picture)?)
                    .with_context(|| format!("cannot write `{}`", path.display()))?;
            }
            self.taken += 1;
            self.taken_of_episode += 1;
        }
        Ok(())
    }

    /// Draws the robot in the middle of the picture.
    fn picture(&mut self, shown: &Shown<'_>, due: usize) -> Picture {
        let Shown { physics, time_s, command, wanted } = *shown;
        let mut scene = Scene::with(&self.look, physics);
        let base_m = [0, 1, 2].map(|axis| physics.position()[axis]);
        let [low, high] = scene.robot_box_m().unwrap_or([base_m.into(); 2]);
        let height_m = *self.height_m.get_or_insert((high.z - low.z).max(0.1));
        let passed_s = due as f64 / f64::from(self.args.fps);
        // Forward motion is followed without delay, because a runner would leave the picture.
        let (middle_m, slack_m) = ((low.z + high.z) / 2.0, LEVEL * height_m);
        let level_m =
            self.followed_m.map_or(middle_m, |before| before[2].clamp(middle_m - slack_m, middle_m + slack_m));
        let now_m = [base_m[0], base_m[1], level_m];
        let followed_m = nearer(self.followed_m, now_m, [f64::INFINITY, passed_s, passed_s]);
        self.followed_m = Some(followed_m);
        if let Some(command) = command {
            add_velocities(&mut scene, physics, command);
        }
        if let Some(wanted) = wanted {
            self.add_ghost(&mut scene, physics, wanted);
        }
        let camera = Camera::framing(followed_m, BESIDE, height_m, FILLED);
        let mut picture = Picture::of(&scene, &camera, self.args.size);
        let (here_m, y_m) = (followed_m[0].round() as i64, followed_m[1] - 0.5 * height_m);
        let numbers = (here_m - NUMBERED_M..=here_m + NUMBERED_M).map(|metre| {
            let x_m = metre as f64;
            (Point3::new(x_m, y_m, scene.ground_m(x_m, y_m)), format!("{metre} m"))
        });
        picture.write_scale(&camera, numbers, 0.5);
        picture.write_line(&line(time_s, command, self.motion.unwrap_or_default()));
        picture
    }

    /// Draws the motion beside the robot.
    fn add_ghost(&mut self, scene: &mut Scene, physics: &Physics, wanted: &[f64]) {
        if self.ghost.is_none() {
            self.ghost = Physics::new(physics.model().clone(), *physics.settings()).ok();
        }
        let Some(ghost) = &mut self.ghost else { return };
        let mut beside = wanted.to_vec();
        beside[1] += GHOST_ASIDE * self.height_m.unwrap_or(1.0);
        ghost.set_state(&beside, &vec![0.0; physics.model().velocity_size()]);
        scene.add_ghost(&self.look, ghost, GHOST);
    }

    /// Returns how many pictures are due after the step at this time of the episode.
    fn due_pictures(&self, time_s: f64) -> usize {
        let FilmArgs { fps, from_s, seconds, .. } = self.args;
        let until_s = seconds.map_or(f64::INFINITY, |seconds| from_s + seconds);
        let due_s = |taken: u32| from_s + f64::from(taken) / f64::from(fps);
        let is_due = |taken: &u32| due_s(*taken) <= time_s + self.control_step_s / 2.0 && due_s(*taken) < until_s;
        (self.taken_of_episode..).take_while(is_due).count()
    }

    /// Completes the files and returns a line that describes them.
    pub fn finish(self) -> anyhow::Result<String> {
        if let Some(why) = self.failed {
            return Err(why);
        }
        if self.taken == 0 {
            let why = format!("--from-s {}: every episode ended before", self.args.from_s);
            return Err(Usage(why).into());
        }
        let mut files = Vec::new();
        if let Some(film) = self.film {
            files.push(film.finish()?);
        }
        files.extend(self.args.png.map(|folder| folder.display().to_string()));
        Ok(format!("{} pictures of {}x{}: {}", self.taken, self.args.size.0, self.args.size.1, files.join(", ")))
    }
}

/// Returns a value that follows another one, with the time that passed since it did (s).
fn nearer(before: Option<[f64; 3]>, now: [f64; 3], passed_s: [f64; 3]) -> [f64; 3] {
    let before = before.unwrap_or(now);
    [0, 1, 2].map(|axis| now[axis] + (before[axis] - now[axis]) * (-passed_s[axis] / FOLLOW_S).exp())
}

/// Returns the line of text of a picture.
fn line(time_s: f64, command: Option<[f64; 3]>, [forward, left, yaw]: [f64; 3]) -> String {
    // Rounding would leave the sign of a zero.
    let [forward, left, yaw] = [forward, left, yaw].map(|value| (value * 100.0).round() / 100.0 + 0.0);
    let Some([x, y, turn]) = command else { return format!("{time_s:.1} s   {:.2} m/s", forward.hypot(left)) };
    format!(
        "{time_s:.1} s   commanded {x:.2}, {y:.2} m/s, {turn:.2} rad/s   actual {forward:.2}, {left:.2} m/s, {yaw:.2} rad/s"
    )
}

/// Draws commanded and actual velocity above the robot.
fn add_velocities(scene: &mut Scene, physics: &Physics, command: [f64; 3]) {
    let (position, velocity) = (physics.position(), physics.velocity());
    let (sin, cos) = BaseMotion::new(position, velocity, 0.0).heading_rad.sin_cos();
    let commanded = [cos * command[0] - sin * command[1], sin * command[0] + cos * command[1]];
    let standing_m = physics.model().robot.as_ref().map_or(1.0, |robot| robot.default_position[2]);
    let mut from_m = [position[0], position[1], position[2] + ARROWS_ABOVE * standing_m];
    for (velocity, colour) in [commanded, [velocity[0], velocity[1]]].into_iter().zip(ARROWS) {
        scene.add_arrow(from_m, velocity.map(|part| part * ARROW_S), colour);
        from_m[2] += ARROWS_APART_M;
    }
}
