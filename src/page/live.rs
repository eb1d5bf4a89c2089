//! Poses of a training actor, from the bus.

use std::time::{Duration, Instant};

use anyhow::Context;
use treadmill_actor::settings::RunSettings;
use treadmill_bus::{
    Bus, Role,
    actor::fetch_policy,
    observer::{Feed, watch_poses},
};
use treadmill_config::EnvTask;
use treadmill_humanoid::{Model, mjcf::VisualMesh};
use treadmill_proto::{PolicyBundle, Pose, ident::check_ident, page::PageScene};
use treadmill_runtime::{error_chain, shutdown::Shutdown};

use super::{OpenPage, Served, fleet, hub::Hub, player::frame_of, scene};
use crate::{
    launch::{exit_code::Usage, output::say, signals},
    shared::learner_address::{self, LearnerLink, ReachArgs},
};

/// Most poses that wait to be shown: those of 2 s.
const POSE_QUEUE: usize = 64;
/// Interval of checks for shutdown.
const POLL_INTERVAL: Duration = Duration::from_millis(200);
/// Time without poses after which another actor is chosen.
const SILENCE_TIMEOUT: Duration = Duration::from_secs(20);
/// Terms of the reward in a pose of Gymnasium's tasks. The second one is the whole reward of any other.
const GYMNASIUMS_TERMS: [&str; 4] = ["survive", "forward", "ctrl", "contact"];

/// Actor to show.
pub struct Live<'a> {
    /// Learner or router to connect to.
    pub reach: &'a ReachArgs,
    /// Name of the actor; any actor if `None`.
    pub actor: Option<&'a str>,
    /// Meshes of the robot's file; by default its colliding shapes.
    pub visuals: Vec<VisualMesh>,
}

impl Live<'_> {
    /// Shows poses while a page is open, until the stop.
    ///
    /// # Errors
    /// If the run cannot be reached or shown.
    pub fn run(&self, served: Served, shutdown: &Shutdown) -> anyhow::Result<()> {
        if let Some(actor) = self.actor {
            check_ident("--actor", actor).map_err(|why| Usage(why.to_string()))?;
        }
        learner_address::connect(self.reach, Role::Observer, async |link| {
            signals::listen(shutdown.clone(), "").context("signals cannot be caught")?;
            let bundle = fetch_bundle(link).await?;
            let settings = RunSettings::shown(&bundle).context("the run cannot be watched")?;
            let is_gymnasiums = matches!(settings.environment.env.task, EnvTask::HumanoidV4 | EnvTask::HumanoidV5);
            let model = Model::from_mjcf(&bundle.model_xml)?;
            let address = served.link.clone();
            let OpenPage { hub, .. } = served.serve(shutdown)?;
            say(&format!("watch at {address}"));
            let terms = if is_gymnasiums { &GYMNASIUMS_TERMS[..] } else { &["reward"] };
            let terms = terms.iter().map(|term| (*term).to_string()).collect();
            let name = format!("{}, live", bundle.run);
            hub.show_scene(PageScene {
                robots: vec![scene::robot(&name, &model, &self.visuals, terms)],
                title: name,
                ground: scene::ground(&model),
                ..PageScene::default()
            });
            let run = Some(bundle.run.clone());
            tokio::spawn(fleet::follow(link.bus.clone(), run, hub.clone(), shutdown.clone(), |_| true));
            tokio::task::block_in_place(|| self.show(link, &bundle, &hub, shutdown, is_gymnasiums))
        })
    }

    fn show(
        &self,
        link: &LearnerLink,
        bundle: &PolicyBundle,
        hub: &Hub,
        shutdown: &Shutdown,
        is_gymnasiums: bool,
    ) -> anyhow::Result<()> {
        while !shutdown.asked() {
            // Actors send poses only while someone subscribes.
            if !hub.wait_for_page(POLL_INTERVAL) {
                continue;
            }
            let mut poses = ActorPoses::open(&link.bus, &bundle.run, self.actor)?;
            hub.notice(format!("waiting for an episode of {} to begin", self.actor.unwrap_or("an actor")));
            let mut shown = Shown::default();
            while hub.has_pages() && !shutdown.asked() {
                let Some(pose) = poses.next(hub)? else { continue };
                if pose.config_hash != bundle.config_hash {
                    anyhow::bail!(
                        "run `{}` was restarted with another configuration or model; start watch again",
                        bundle.run
                    );
                }
                shown.show(hub, &pose, is_gymnasiums);
            }
        }
        Ok(())
    }
}

/// Time of the page, which goes on from episode to episode.
#[derive(Default)]
struct Shown {
    episode: u64,
    key: Option<(String, u64, u64)>,
    begun_s: f64,
    at_s: f64,
}

impl Shown {
    fn show(&mut self, hub: &Hub, pose: &Pose, is_gymnasiums: bool) {
        let key = Some((pose.actor.clone(), pose.actor_incarnation, pose.episode));
        if self.key != key {
            self.key = key;
            self.episode += 1;
            self.begun_s = self.at_s - pose.time_s;
            let number = pose.version.map_or(0, |version| version.number);
            hub.notice(format!("episode {} of {}, policy {number}", pose.episode, pose.actor));
        }
        self.at_s = self.begun_s + pose.time_s;
        let mut frame = frame_of(pose);
        (frame.episode, frame.shown_s) = (self.episode, self.at_s);
        if !is_gymnasiums {
            frame.rewards_e3.truncate(2);
            frame.rewards_e3.remove(0);
        }
        hub.show_frame(frame);
    }
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

    /// Returns the next pose of the current actor; `None` if no pose comes within [`POLL_INTERVAL`].
    fn next(&mut self, hub: &Hub) -> anyhow::Result<Option<Pose>> {
        let Some(message) = self.feed.next(POLL_INTERVAL) else {
            if self.requested.is_none() && self.current.is_some() && self.last_pose.elapsed() >= SILENCE_TIMEOUT {
                hub.notice("the actor sends no poses; waiting for another one");
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
