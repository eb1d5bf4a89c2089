//! Live view of a training actor, from the poses that it publishes on the bus.

use std::time::{Duration, Instant};

use anyhow::Context;
use treadmill_actor::settings::RunSettings;
use treadmill_bus::{
    Bus, Role,
    actor::fetch_policy,
    observer::{Feed, watch_poses},
};
use treadmill_config::EnvTask;
use treadmill_humanoid::Model;
use treadmill_proto::{PolicyBundle, Pose, ident::check_ident};
use treadmill_rl::{
    launch::{exit_code::Usage, output::say, signals},
    shared::learner_address::{self, LearnerLink, ReachArgs},
};
use treadmill_runtime::{error_chain, shutdown::Shutdown};

use crate::{Shown, scene_recorder::SceneRecorder, viewer_output::ViewerOutput};

/// Most poses that wait to be drawn: those of 2 s.
const POSE_QUEUE: usize = 64;
/// Interval of checks for shutdown.
const POLL_INTERVAL: Duration = Duration::from_millis(200);
/// Time without poses after which another actor is chosen.
const SILENCE_TIMEOUT: Duration = Duration::from_secs(20);

/// Options of the live view.
pub struct LiveOptions<'a> {
    /// Learner or router to connect to.
    pub reach: &'a ReachArgs,
    /// Name of the actor; any actor if `None`.
    pub actor: Option<&'a str>,
    /// Duration of motion after which the view ends (s).
    pub for_s: Option<f64>,
}

/// Connects to the bus and records poses until Ctrl-C; `open` creates output and recorder for the run's robot.
pub fn run(
    options: &LiveOptions,
    open: impl FnOnce(&str, Shown) -> anyhow::Result<(ViewerOutput, SceneRecorder)>,
) -> anyhow::Result<()> {
    if let Some(actor) = options.actor {
        check_ident("--actor", actor).map_err(|why| Usage(why.to_string()))?;
    }
    learner_address::connect(options.reach, Role::Observer, async |link| {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "").context("signals cannot be caught")?;
        let bundle = fetch_bundle(link).await?;
        let settings = RunSettings::shown(&bundle).context("the run cannot be watched")?;
        let model = Model::from_mjcf(&bundle.model_xml)?;
        let has_commands = settings.environment.env.task == EnvTask::Velocity;
        let shown = Shown { model, control_step_s: settings.environment.env.control_step_s, has_commands };
        let (output, mut recorder) = open(&format!("{}, live", bundle.run), shown)?;
        let mut poses = ActorPoses::open(&link.bus, &bundle.run, options.actor)?;
        say(&format!("waiting for an episode of {} to begin", options.actor.unwrap_or("an actor")));
        while !shutdown.asked() && options.for_s.is_none_or(|limit_s| recorder.shown_s() < limit_s) {
            let Some(pose) = tokio::task::block_in_place(|| poses.next())? else { continue };
            if pose.config_hash != bundle.config_hash {
                anyhow::bail!(
                    "run `{}` was restarted with another configuration or model; start the viewer again",
                    bundle.run
                );
            }
            recorder.show(&pose)?;
        }
        // With --for-s the viewer stays open; it needs no further poses.
        drop(poses);
        tokio::task::block_in_place(|| output.finish(&shutdown))
    })
}

async fn fetch_bundle(link: &LearnerLink) -> anyhow::Result<PolicyBundle> {
    let start = Instant::now();
    loop {
        if let Some(bundle) = fetch_policy(&link.bus, link.run.as_deref(), learner_address::ANSWER_TIMEOUT).await? {
            return Ok(bundle);
        }
        if start.elapsed() >= learner_address::ANSWER_TIMEOUT {
            return Err(link.silence().await);
        }
        tokio::time::sleep(POLL_INTERVAL).await;
    }
}

/// Poses of one actor at a time.
struct ActorPoses<'a> {
    bus: &'a Bus,
    run: String,
    /// Requested actor.
    requested: Option<String>,
    /// Current actor.
    current: Option<String>,
    feed: Feed,
    last_pose: Instant,
    refused: u64,
}

impl<'a> ActorPoses<'a> {
    fn open(bus: &'a Bus, run: &str, requested: Option<&str>) -> anyhow::Result<Self> {
        let feed = watch_poses(bus, run, requested, POSE_QUEUE)?;
        let (requested, last_pose) = (requested.map(str::to_string), Instant::now());
        Ok(Self { bus, run: run.to_string(), current: requested.clone(), requested, feed, last_pose, refused: 0 })
    }

    /// Subscribes to one actor, or to all if `None`.
    fn subscribe(&mut self, actor: Option<String>) -> anyhow::Result<()> {
        // The old subscription ends after the new one began, so that the actor always has a subscriber.
        self.feed = watch_poses(self.bus, &self.run, actor.as_deref(), POSE_QUEUE)?;
        self.current = actor;
        self.last_pose = Instant::now();
        Ok(())
    }

    /// Returns the next pose of the current actor; `None` if there is none within [`POLL_INTERVAL`].
    fn next(&mut self) -> anyhow::Result<Option<Pose>> {
        let Some(message) = self.feed.next(POLL_INTERVAL) else {
            if self.requested.is_none() && self.current.is_some() && self.last_pose.elapsed() >= SILENCE_TIMEOUT {
                say("the actor sends no poses; waiting for another one");
                self.subscribe(None)?;
            }
            return Ok(None);
        };
        let pose = match Pose::decode_checked(&message.payload) {
            Ok(pose) if pose.run == self.run && message.last_part() == pose.actor => pose,
            Ok(pose) => return Ok(self.refuse(&format!("key `{}` with actor `{}`", message.key, pose.actor))),
            Err(why) => return Ok(self.refuse(&error_chain(&why))),
        };
        if self.current.is_none() {
            say(&format!("watching {} of run `{}`", pose.actor, self.run));
            self.subscribe(Some(pose.actor.clone()))?;
        }
        if self.current.as_ref() != Some(&pose.actor) {
            return Ok(None);
        }
        self.last_pose = Instant::now();
        Ok(Some(pose))
    }

    /// Counts a refused pose and logs the first one.
    fn refuse(&mut self, why: &str) -> Option<Pose> {
        self.refused += 1;
        if self.refused == 1 {
            tracing::warn!(reason = why, "pose refused; further refusals are not logged");
        }
        None
    }
}
