//! Policies that are played for the page, in real time, while one is open.

use std::{
    borrow::Cow,
    sync::mpsc::Receiver,
    thread,
    time::{Duration, Instant},
};

use treadmill_actor::poses::is_shown;
use treadmill_config::ChosenTask;
use treadmill_humanoid::{TaskRegistry, mjcf::VisualMesh};
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_proto::page::{FromPageKind, PageCommand, PagePush, PageRobot, PageScene};
use treadmill_runtime::{error_chain, run_folder::RunFolder, shutdown::Shutdown};

use super::{curves::RunLog, hub::Hub, player::Player, scene};
use crate::shared::model_file::{ModelSource, meshes};

/// Most policies side by side.
pub const POLICIES_MAX: usize = 4;
/// Most time by which the simulation may be late and still catch up.
const LATE_MAX: Duration = Duration::from_millis(100);
/// Interval of looking for a newer policy and for new metrics, while a page is open.
const REFRESH_EVERY: Duration = Duration::from_secs(2);
/// Interval of looking for a request to stop, without a page.
const IDLE_EVERY: Duration = Duration::from_millis(200);

/// What is shown.
pub struct Show {
    /// Title of the page.
    pub title: String,
    /// RUN of each policy, see [`Player::load`]; none shows only curves.
    pub runs: Vec<String>,
    /// Checkpoint; by default the best or else the newest.
    pub which: Option<CheckpointChoice>,
    /// Seed of the episodes.
    pub seed: u64,
    /// Meshes of the robots; by default those of each run's own file, or the colliding shapes.
    pub visuals: Option<Vec<VisualMesh>>,
    /// Logs of metrics, with the names of their runs.
    pub logs: Vec<(RunFolder, String)>,
    /// Tasks that policies may have.
    pub tasks: TaskRegistry,
}

impl Show {
    /// Simulates while a page is open, until the stop. A policy that is not there yet is waited for.
    pub fn run(self, hub: &Hub, requests: &Receiver<FromPageKind>, shutdown: &Shutdown) {
        let mut logs: Vec<RunLog> =
            self.logs.iter().map(|(folder, run)| RunLog::new(folder.clone(), run.clone())).collect();
        let mut stage: Option<Stage> = None;
        if self.runs.is_empty() {
            hub.show_scene(PageScene { title: self.title.clone(), ..PageScene::default() });
        }
        while !shutdown.asked() {
            if !hub.wait_for_page(IDLE_EVERY) {
                // What was asked for while the last page closed, and its command, end with it.
                requests.try_iter().for_each(drop);
                let _ = hub.take_command();
                stage.iter_mut().for_each(Stage::release);
                continue;
            }
            for log in &mut logs {
                let (points, anew) = log.new_points();
                hub.add_points(log.run(), points, anew);
            }
            if stage.is_none() && !self.runs.is_empty() {
                match Stage::open(&self) {
                    Ok(opened) => {
                        hub.show_scene(opened.scene(&self, hub.steers()));
                        hub.notice("");
                        stage = Some(opened);
                    }
                    Err(why) => hub.notice(format!("nothing to show yet: {}", error_chain(&*why))),
                }
            }
            let until = Instant::now() + REFRESH_EVERY;
            let Some(stage) = &mut stage else {
                thread::sleep(REFRESH_EVERY);
                continue;
            };
            if let Err(why) = stage.play(&self, hub, requests, until, shutdown) {
                hub.notice(error_chain(&*why));
            }
            stage.refresh(hub);
        }
    }
}

/// Returns the last part of a path.
pub fn short(run: &str) -> &str {
    run.trim_end_matches('/').rsplit('/').next().unwrap_or(run)
}

/// Robots that are played.
struct Stage {
    players: Vec<Player>,
    robots: Vec<PageRobot>,
    /// Simulated time of each player (s).
    played_s: Vec<f64>,
    steps: Vec<u32>,
    due: Instant,
    command: Option<[f64; 3]>,
}

impl Stage {
    fn open(show: &Show) -> anyhow::Result<Self> {
        let load = |run: &String| Player::load(&show.tasks, run, show.which, show.seed);
        let players: Vec<Player> = show.runs.iter().map(load).collect::<anyhow::Result<_>>()?;
        let count = players.len();
        let robot = |player: &Player| {
            let own = || meshes(ModelSource::of_run(player.run()));
            let visuals = show.visuals.as_ref().map_or_else(|| Cow::Owned(own()), Cow::Borrowed);
            scene::robot(short(player.run()), player.model(), &visuals, player.reward_terms())
        };
        let robots = players.iter().map(robot).collect();
        Ok(Self {
            players,
            robots,
            played_s: vec![0.0; count],
            steps: vec![0; count],
            due: Instant::now(),
            command: None,
        })
    }

    fn scene(&self, show: &Show, steers: bool) -> PageScene {
        let first = &self.players[0];
        let velocity = &first.config().velocity;
        let ranges = [velocity.lin_vel_x_mps, velocity.lin_vel_y_mps, velocity.ang_vel_z_radps];
        // An own task may have commands without ranges.
        let has_commands = first.config().env.chosen_task() == ChosenTask::Velocity;
        // A command of 0 stands, also where none was trained.
        let ends = |end: fn(f64, f64) -> f64, index: usize| -> Vec<f32> {
            ranges.iter().filter(|_| has_commands).map(|range| end(range[index], 0.0) as f32).collect()
        };
        PageScene {
            title: show.title.clone(),
            robots: self.robots.clone(),
            ground: scene::ground(first.model()),
            command_low: ends(f64::min, 0),
            command_high: ends(f64::max, 1),
            steers,
            ground_levels: if first.config().ground.kinds.is_empty() { 0 } else { first.config().ground.levels },
            world: Some(first.world()),
        }
    }

    /// Plays in real time until a moment, the last page's end or the stop.
    fn play(
        &mut self,
        show: &Show,
        hub: &Hub,
        requests: &Receiver<FromPageKind>,
        until: Instant,
        shutdown: &Shutdown,
    ) -> anyhow::Result<()> {
        while Instant::now() < until && hub.has_pages() && !shutdown.asked() {
            // After a stall or without pages it goes on from now: lost time played fast could not be steered.
            self.due = self.due.max(Instant::now().checked_sub(LATE_MAX).unwrap_or(self.due));
            if let Some(command) = hub.take_command() {
                self.follow(&command);
            }
            for request in requests.try_iter() {
                self.obey(show, hub, &request)?;
            }
            let next_s = self.players.iter().zip(&self.played_s).map(|(player, at_s)| at_s + player.control_step_s());
            let next_s = next_s.fold(f64::INFINITY, f64::min);
            let passed_s = next_s - self.played_s.iter().copied().fold(0.0, f64::max);
            self.advance(hub, next_s)?;
            self.due += Duration::from_secs_f64(passed_s.max(0.0));
            thread::sleep(self.due.saturating_duration_since(Instant::now()));
        }
        Ok(())
    }

    /// Plays all robots up to a time of the simulation.
    fn advance(&mut self, hub: &Hub, until_s: f64) -> anyhow::Result<()> {
        // Without steering, robots side by side follow the commands of the first one.
        let of_first = self.players[0].command();
        for (number, player) in self.players.iter_mut().enumerate() {
            let step_s = player.control_step_s();
            if number > 0 && self.command.is_none() && of_first.is_some() {
                player.steer(of_first);
            }
            // Sums of steps are not exact.
            while self.played_s[number] + 0.5 * step_s < until_s {
                player.step()?;
                self.played_s[number] += step_s;
                self.steps[number] += 1;
                if is_shown(self.steps[number], step_s) {
                    hub.show_frame(player.frame(number as u32, self.played_s[number]));
                }
            }
        }
        Ok(())
    }

    /// Gives the robots their own commands again.
    fn release(&mut self) {
        if self.command.take().is_some() {
            self.players.iter_mut().for_each(|player| player.steer(None));
        }
    }

    fn obey(&mut self, show: &Show, hub: &Hub, request: &FromPageKind) -> anyhow::Result<()> {
        match request {
            FromPageKind::Command(command) => self.follow(command),
            FromPageKind::Push(PagePush { forward_mps, left_mps }) => {
                let push_mps = [*forward_mps, *left_mps].map(|speed| f64::from(speed).clamp(-3.0, 3.0));
                self.players.iter_mut().for_each(|player| player.push(push_mps));
            }
            FromPageKind::World(world) => {
                // All worlds are built before one is entered: where one fails, robots stay side by side in the old one.
                let build = |player: &Player| player.build_world(&show.tasks, world);
                let built: Vec<_> = self.players.iter().map(build).collect::<anyhow::Result<_>>()?;
                for (player, environment) in self.players.iter_mut().zip(built) {
                    player.enter(environment, world);
                    player.steer(self.command);
                }
                hub.show_scene(self.scene(show, true));
            }
        }
        Ok(())
    }

    fn follow(&mut self, command: &PageCommand) {
        let PageCommand { follows, forward_mps, left_mps, yaw_radps } = *command;
        let wanted = [forward_mps, left_mps, yaw_radps].map(f64::from);
        self.command = follows.then(|| self.within_ranges(wanted));
        self.players.iter_mut().for_each(|player| player.steer(self.command));
    }

    fn within_ranges(&self, command: [f64; 3]) -> [f64; 3] {
        let velocity = &self.players[0].config().velocity;
        let ranges = [velocity.lin_vel_x_mps, velocity.lin_vel_y_mps, velocity.ang_vel_z_radps];
        std::array::from_fn(|entry| command[entry].clamp(ranges[entry][0].min(0.0), ranges[entry][1].max(0.0)))
    }

    /// Loads newer policies. One that cannot be read hinders no other.
    fn refresh(&mut self, hub: &Hub) {
        for player in &mut self.players {
            match (player.refresh(), player.origin()) {
                (Ok(true), Some(origin)) => hub.notice(format!("{}: {origin}", short(player.run()))),
                (Ok(_), _) => {}
                (Err(why), _) => hub.notice(error_chain(&*why)),
            }
        }
    }
}
