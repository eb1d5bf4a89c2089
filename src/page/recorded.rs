//! Steps of an evaluation, from the file that `eval --trace` wrote, played in real time.

use std::{
    fs::File,
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    thread,
    time::{Duration, Instant},
};

use anyhow::{Context, ensure};
use serde::Deserialize;
use treadmill_actor::poses::{self, is_shown};
use treadmill_humanoid::{Environment, TaskRegistry, mjcf::VisualMesh};
use treadmill_proto::{
    Pose,
    page::{PageFrame, PageScene},
};
use treadmill_runtime::{error_chain, shutdown::Shutdown};

use super::{hub::Hub, player::frame_of, scene, show::short};
use crate::shared::saved_policy;

/// Interval of looking for a request to stop, without a page.
const IDLE_EVERY: Duration = Duration::from_millis(200);
/// Most time by which the playback may be late and still catch up.
const LATE_MAX: Duration = Duration::from_millis(100);

/// Line of a trace, as far as it is shown.
#[derive(Deserialize)]
struct Step {
    episode: u64,
    step: u32,
    qpos: Vec<f64>,
    qvel: Vec<f64>,
    #[serde(default)]
    command: Option<[f64; 3]>,
    #[serde(default)]
    torque: Vec<f64>,
}

/// Trace of a policy's episodes.
pub struct Recorded {
    path: PathBuf,
    name: String,
    environment: Environment,
    visuals: Vec<VisualMesh>,
}

impl Recorded {
    /// Opens a trace of the robot that RUN names.
    ///
    /// # Errors
    /// If RUN or the trace cannot be read, or the first step does not fit the robot.
    pub fn open(tasks: &TaskRegistry, run: &str, path: &Path, visuals: Vec<VisualMesh>) -> anyhow::Result<Self> {
        let saved = saved_policy::load(run, None)?;
        let environment = saved_policy::environment(tasks, run, &saved.policy, &saved.config)?;
        let name = format!("{}, {}", short(run), path.display());
        let mut opened = Self { path: path.to_path_buf(), name, environment, visuals };
        let first = opened.lines()?.next().with_context(|| format!("--trace {}: the file is empty", path.display()))?;
        opened.take(1, first)?;
        Ok(opened)
    }

    /// Plays the trace again and again while a page is open, until the stop.
    pub fn run(mut self, hub: &Hub, shutdown: &Shutdown) {
        let model = self.environment.physics().model();
        hub.show_scene(PageScene {
            title: self.name.clone(),
            robots: vec![scene::robot(&self.name, model, &self.visuals, Vec::new())],
            ground: scene::ground(model),
            ..PageScene::default()
        });
        let (mut shown_s, mut episodes) = (0.0, 0);
        while !shutdown.asked() {
            if !hub.wait_for_page(IDLE_EVERY) {
                continue;
            }
            let played = self.play(hub, shutdown, &mut shown_s, &mut episodes);
            hub.notice(played.err().map(|why| error_chain(&*why)).unwrap_or_default());
            // The file may be empty while it is written anew.
            thread::sleep(IDLE_EVERY);
        }
    }

    /// Plays the trace once, or until no page is open.
    fn play(&mut self, hub: &Hub, shutdown: &Shutdown, shown_s: &mut f64, episodes: &mut u64) -> anyhow::Result<()> {
        let step_s = self.environment.control_step_s();
        let (mut episode, mut start_x_m, mut due) = (None, 0.0, Instant::now());
        for (index, line) in self.lines()?.enumerate() {
            if shutdown.asked() || !hub.has_pages() {
                break;
            }
            let step = self.take(index + 1, line)?;
            if episode != Some(step.episode) {
                (episode, start_x_m) = (Some(step.episode), step.qpos[0]);
                *episodes += 1;
            }
            *shown_s += step_s;
            if is_shown(step.step, step_s) {
                hub.show_frame(self.frame(&step, start_x_m, *shown_s, *episodes));
            }
            due = due.max(Instant::now().checked_sub(LATE_MAX).unwrap_or(due)) + Duration::from_secs_f64(step_s);
            thread::sleep(due.saturating_duration_since(Instant::now()));
        }
        Ok(())
    }

    fn frame(&self, step: &Step, start_x_m: f64, shown_s: f64, episode: u64) -> PageFrame {
        let physics = self.environment.physics();
        let pose = Pose {
            episode,
            time_s: f64::from(step.step) * self.environment.control_step_s(),
            distance_m: (physics.position()[0] - start_x_m) as f32,
            joint_torques_nm: step.torque.iter().map(|torque| *torque as f32).collect(),
            ..poses::body_pose(&self.environment, step.command)
        };
        let velocity = poses::heading_velocity(physics).map(|part| part as f32).to_vec();
        // The controls of this body are not those of the trace.
        PageFrame { shown_s, velocity, rewards_e3: Vec::new(), controls_e2: Vec::new(), ..frame_of(&pose) }
    }

    fn lines(&self) -> anyhow::Result<impl Iterator<Item = std::io::Result<String>> + use<>> {
        let why = || {
            let path = self.path.display();
            format!("--trace {path}: the file cannot be read; write one by `treadmill eval RUN --trace {path}`")
        };
        let file = File::open(&self.path).with_context(why)?;
        let mut reader = BufReader::new(file);
        // A last line without its end is still being written.
        Ok(std::iter::from_fn(move || {
            let mut line = String::new();
            match reader.read_line(&mut line) {
                Ok(_) => line.ends_with('\n').then_some(Ok(line)),
                Err(why) => Some(Err(why)),
            }
        }))
    }

    /// Reads a line and puts the robot where it was then.
    fn take(&mut self, number: usize, line: std::io::Result<String>) -> anyhow::Result<Step> {
        let at = || format!("--trace {}: line {number}", self.path.display());
        let step: Step = serde_json::from_str(&line.with_context(at)?).with_context(at)?;
        let model = self.environment.physics().model();
        let sizes = [model.position_size(), model.velocity_size()];
        let found = [step.qpos.len(), step.qvel.len()];
        ensure!(
            found == sizes,
            "{}: {found:?} numbers in qpos and qvel; this robot has {sizes:?}: name the RUN that wrote the trace",
            at()
        );
        let is_finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        ensure!(
            is_finite(&step.qpos) && is_finite(&step.qvel) && is_finite(&step.torque),
            "{}: a number is not finite",
            at()
        );
        ensure!(step.qpos[3..7].iter().any(|part| *part != 0.0), "{}: the quaternion in qpos is 0", at());
        self.environment.physics_mut().set_state(&step.qpos, &step.qvel);
        Ok(step)
    }
}
