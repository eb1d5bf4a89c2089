//! An actor that trains somewhere, as it tells its poses on the bus.

use std::time::{Duration, Instant};

use anyhow::Context;
use treadmill_actor::settings;
use treadmill_bus::{Bus, Feed, Role, fetch_policy, keys, observe};
use treadmill_config::ConfigSource;
use treadmill_humanoid::Model;
use treadmill_proto::{PolicyBundle, Pose, ident::check_ident};
use treadmill_rl::{
    launch::{exit_code::Usage, output::say, signals},
    shared::learner_address::{self, ReachArgs},
};
use treadmill_runtime::shutdown::Shutdown;

use crate::{scene_recorder::SceneRecorder, viewer_output::ViewerOutput};

/// Poses that may wait to be drawn: two seconds of them.
const WAITING_POSES: usize = 64;
/// How often it is asked whether to stop.
const LOOK_EVERY: Duration = Duration::from_millis(200);
/// An actor that says nothing for so long is given up for another.
const SILENCE_TIMEOUT: Duration = Duration::from_secs(20);

/// What is to be watched.
pub struct LiveOptions<'a> {
    /// The learner or router to ask.
    pub reach: &'a ReachArgs,
    /// The actor, if not any.
    pub actor: Option<&'a str>,
    /// Seconds of motion after which it ends.
    pub for_s: Option<f64>,
}

/// Joins the bus and draws what comes, until Ctrl-C; `open` makes output and recorder once the robot is known.
pub fn run(
    options: &LiveOptions,
    open: impl FnOnce(&str, Model) -> anyhow::Result<(ViewerOutput, SceneRecorder)>,
) -> anyhow::Result<()> {
    if let Some(actor) = options.actor {
        check_ident("--actor", actor).map_err(|why| Usage(why.to_string()))?;
    }
    learner_address::connect(options.reach, Role::Observer, async |bus, run| {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "").context("signals cannot be caught")?;
        let bundle = ask(&bus, run.as_deref()).await?;
        check_ours(&bundle)?;
        let (output, mut recorder) = open(&format!("{}, live", bundle.run), Model::from_mjcf(&bundle.model_xml)?)?;
        let mut feed = ActorFeed::open(&bus, &bundle.run, options.actor)?;
        say(&format!("waiting for an episode of {} to begin", options.actor.unwrap_or("an actor")));
        while !shutdown.asked() && options.for_s.is_none_or(|limit_s| recorder.shown_s() < limit_s) {
            let Some(pose) = tokio::task::block_in_place(|| feed.next())? else { continue };
            if pose.config_hash != bundle.config_hash {
                anyhow::bail!(
                    "run `{}` was begun anew with another configuration or model; watch it again",
                    bundle.run
                );
            }
            recorder.show(&pose)?;
        }
        // Whoever asked for so many seconds may look at them for as long as they like.
        drop(feed);
        tokio::task::block_in_place(|| output.finish(&shutdown))
    })
}

async fn ask(bus: &Bus, run: Option<&str>) -> anyhow::Result<PolicyBundle> {
    let begun = Instant::now();
    loop {
        if let Some(bundle) = fetch_policy(bus, run, learner_address::ANSWER_TIMEOUT).await? {
            return Ok(bundle);
        }
        if begun.elapsed() >= learner_address::ANSWER_TIMEOUT {
            let whose = run.map_or("no run".to_string(), |run| format!("no run `{run}`"));
            anyhow::bail!("{whose} answers there; is its learner up, and does your certificate let you ask?");
        }
        tokio::time::sleep(LOOK_EVERY).await;
    }
}

/// Only what this program simulates has a body that it knows.
fn check_ours(bundle: &PolicyBundle) -> anyhow::Result<()> {
    let mut source = ConfigSource::default();
    source.text(&bundle.config_toml, "the configuration of the run")?;
    settings::check_supported(&bundle.run, &source.build()?).context("it cannot be watched")
}

/// The poses of one actor at a time.
struct ActorFeed<'a> {
    bus: &'a Bus,
    run: String,
    /// The one that was asked for.
    wanted: Option<String>,
    /// The one that is listened to.
    chosen: Option<String>,
    feed: Feed,
    heard: Instant,
    refused: u64,
}

impl<'a> ActorFeed<'a> {
    fn open(bus: &'a Bus, run: &str, wanted: Option<&str>) -> anyhow::Result<Self> {
        let feed = observe(bus, &keys::poses(run, wanted.unwrap_or("*")), WAITING_POSES)?;
        let wanted = wanted.map(str::to_string);
        Ok(Self { bus, run: run.to_string(), chosen: wanted.clone(), wanted, feed, heard: Instant::now(), refused: 0 })
    }

    fn choose(&mut self, actor: Option<String>) -> anyhow::Result<()> {
        // Before the old feed goes, so that an actor that is chosen out of all sees no moment without anybody watching.
        self.feed = observe(self.bus, &keys::poses(&self.run, actor.as_deref().unwrap_or("*")), WAITING_POSES)?;
        self.chosen = actor;
        self.heard = Instant::now();
        Ok(())
    }

    /// The next pose, if one comes before it is time to look around.
    fn next(&mut self) -> anyhow::Result<Option<Pose>> {
        let Some(message) = self.feed.next(LOOK_EVERY) else {
            if self.wanted.is_none() && self.chosen.is_some() && self.heard.elapsed() >= SILENCE_TIMEOUT {
                say("it is silent; waiting for an actor");
                self.choose(None)?;
            }
            return Ok(None);
        };
        let pose = match Pose::decode_checked(&message.payload) {
            Ok(pose) if pose.run == self.run && keys::last_part(&message.key) == pose.actor => pose,
            Ok(pose) => return Ok(self.refuse(&format!("`{}` speaks for `{}`", message.key, pose.actor))),
            Err(why) => return Ok(self.refuse(&why.to_string())),
        };
        if self.chosen.is_none() {
            say(&format!("watching {} of run `{}`", pose.actor, self.run));
            self.choose(Some(pose.actor.clone()))?;
        }
        if self.chosen.as_ref() != Some(&pose.actor) {
            return Ok(None);
        }
        self.heard = Instant::now();
        Ok(Some(pose))
    }

    /// Says so once: a stranger must not fill the log.
    fn refuse(&mut self, why: &str) -> Option<Pose> {
        self.refused += 1;
        if self.refused == 1 {
            tracing::warn!("a pose was refused, and others may be without a word: {why}");
        }
        None
    }
}
