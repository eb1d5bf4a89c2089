//! One actor process: joins a run, collects and delivers fragments, reports on itself, and rejoins when the run is replaced.

mod moving;
mod options;
mod physics_thread;
mod rate_meter;
mod taken_name;

use std::{
    sync::{Arc, PoisonError, atomic::Ordering},
    time::Duration,
};

use tokio::task::JoinSet;
use treadmill_bus::{
    Bus,
    actor::{PosePublisher, publish_episodes, publish_stats, token, watch_announcements},
};
use treadmill_humanoid::task::Reached;
use treadmill_proto::{ActorState, ActorStats, PolicyBundle, PolicyVersion, json::EpisodeReport};
use treadmill_runtime::{epoch::SeenEpoch, seeds, shutdown::Shutdown};

pub use options::{ActorSummary, BehindStandby, WorkerOptions};

use self::{
    moving::Moving,
    physics_thread::{PhysicsThread, ProducedFragment, Progress, Shared},
    rate_meter::RateMeter,
    taken_name::wait_for_name,
};
use crate::{
    ActorError,
    delivery::Uploader,
    environments::{Environments, SeedSource},
    identity::ActorIdentity,
    policy_fetcher::{PolicyFetcher, Refresh, join_run},
    pool::{Deliveries, PoolPlace, Seeker},
    poses::{self, PoseSampler},
    rollout::Collector,
    settings::RunSettings,
};

/// Interval of asking whether the endpoint is a standby's: a learner that leads may be overtaken.
const PLACE_CHECK_EVERY: Duration = Duration::from_secs(10);

/// Longest wait of an actor of a pool for the policy of a run that has admitted it.
const JOIN_TIMEOUT: Duration = Duration::from_secs(5);
/// Longest wait of such an actor for the receipts of an earlier membership in the run.
const SETTLE_TIMEOUT: Duration = Duration::from_secs(5);

/// Reason for which a membership in a run ended.
enum EndReason {
    StopRequested,
    RunReplaced,
    BehindStandby,
    /// Another run has admitted the actor, or its learner is gone for long. Some deliveries may be under way.
    Moves(Option<String>, Deliveries),
}

/// How an actor ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// It was asked to stop.
    Stopped(Option<ActorSummary>),
    /// Its endpoint is a standby's, which passes no fragments on.
    BehindStandby,
}

/// Runs the actor until a request to stop; returns the summary of its last membership, if it joined a run. Also ends
/// if its endpoint is a standby's and [`BehindStandby::End`] is chosen.
pub async fn run(bus: &Bus, options: &WorkerOptions, shutdown: &Shutdown) -> Result<Ending, ActorError> {
    let mut last = None;
    let epochs = Arc::new(SeenEpoch::default());
    let enter = || PoolPlace::enter(bus, &options.name, options.envs);
    let mut pool = options.is_pooled.then(enter).transpose()?;
    let mut admitted = None;
    loop {
        let run = match (&mut pool, admitted.take()) {
            (None, _) => options.run.clone(),
            (Some(_), Some(run)) => Some(run),
            (Some(pool), None) => match pool.find(options.notify, shutdown).await? {
                None => return Ok(Ending::Stopped(last)),
                found => found,
            },
        };
        let joining = join_run(bus, run.as_deref(), &options.explain, &epochs, shutdown);
        let joined = match &mut pool {
            None => joining.await?,
            Some(pool) => {
                pool.settle(run.as_deref().unwrap_or_default(), SETTLE_TIMEOUT).await;
                // The run may have ended since.
                let Ok(joined) = tokio::time::timeout(JOIN_TIMEOUT, joining).await else { continue };
                joined?
            }
        };
        let Some(bundle) = joined else { return Ok(Ending::Stopped(last)) };
        let seeker = pool.as_ref().map(PoolPlace::seeker);
        match (wait_for_name(bus, options, &bundle.run, shutdown).await, seeker) {
            (Ok(true), _) => {}
            (Ok(false), _) => return Ok(Ending::Stopped(last)),
            (Err(why), Some(seeker)) if why.is_of_run() => {
                seeker.refuse(&bundle.run, &why);
                continue;
            }
            (Err(why), _) => return Err(why),
        }
        let membership = match (Membership::new(bus, options, &bundle, epochs.clone(), seeker), seeker) {
            (Err(why), Some(seeker)) if why.is_of_run() => {
                seeker.refuse(&bundle.run, &why);
                continue;
            }
            (membership, _) => membership?,
        };
        // Before anything is simulated, because it might not be delivered.
        if options.behind_standby == BehindStandby::End && membership.shared.policies.is_behind_standby().await? {
            return Ok(Ending::BehindStandby);
        }
        tracing::info!(actor = %options.name, run = %bundle.run, version = bundle.version.number, "joined the run");
        let WorkerOptions { name, envs, .. } = options;
        (options.notify)(&format!("joined run `{}` as `{name}` with {envs} environments", bundle.run));
        let reason = match (membership.run(&bundle, shutdown).await, seeker) {
            (Err(why), Some(seeker)) if why.is_of_run() => {
                seeker.refuse(&bundle.run, &why);
                continue;
            }
            (reason, _) => reason?,
        };
        let summary = membership.summary();
        tracing::info!(actor = %options.name, run = %bundle.run, ?summary, "left the run");
        (options.notify)(&format!("left run `{}`: {}", bundle.run, summary.delivered()));
        last = Some(summary);
        match reason {
            EndReason::StopRequested => return Ok(Ending::Stopped(last)),
            EndReason::BehindStandby => return Ok(Ending::BehindStandby),
            EndReason::Moves(to, deliveries) => {
                admitted = to;
                if let Some(pool) = &mut pool {
                    pool.keep(&bundle.run, deliveries);
                }
            }
            EndReason::RunReplaced => tracing::warn!(
                actor = %options.name,
                run = %bundle.run,
                pending = summary.fragments.in_flight,
                "the learner replaced the run; rejoining without the pending fragments"
            ),
        }
    }
}

/// Membership of an actor in one run, from joining to leaving.
struct Membership<'a> {
    bus: &'a Bus,
    options: &'a WorkerOptions,
    /// Of an actor of a pool.
    seeker: Option<Seeker>,
    settings: RunSettings,
    identity: ActorIdentity,
    shared: Shared,
}

impl<'a> Membership<'a> {
    fn new(
        bus: &'a Bus,
        options: &'a WorkerOptions,
        bundle: &PolicyBundle,
        epochs: Arc<SeenEpoch>,
        seeker: Option<&Seeker>,
    ) -> Result<Self, ActorError> {
        let settings = RunSettings::simulated(bundle)?;
        let incarnation = seeds::unique();
        tracing::info!(incarnation, actor = %options.name, "new incarnation");
        // An actor of a pool follows no learner to another run: that one must admit it.
        let named = if options.is_pooled { Some(bundle.run.clone()) } else { options.run.clone() };
        let policies = Arc::new(PolicyFetcher::new(bus.clone(), named, bundle, epochs)?);
        let receipt_timeout = Duration::from_millis(settings.bus.receipt_timeout_ms);
        let steps = settings.first_fragment_steps(bundle, options.envs)?;
        let uploader = Uploader::new(bus.clone(), &bundle.run, &options.name, receipt_timeout, policies.clone(), steps);
        let uploader = uploader.with_notices(options.notify);
        let identity = ActorIdentity {
            run: bundle.run.clone(),
            actor: options.name.clone(),
            incarnation,
            config_hash: bundle.config_hash,
        };
        let shared = Shared { policies, uploader: Arc::new(uploader), progress: Arc::new(Progress::default()) };
        Ok(Self { bus, options, seeker: seeker.cloned(), settings, identity, shared })
    }

    async fn run(&self, bundle: &PolicyBundle, shutdown: &Shutdown) -> Result<EndReason, ActorError> {
        let publisher = PosePublisher::open(self.bus, &self.identity.run, &self.identity.actor)?;
        let (sampler, poses) = PoseSampler::new(publisher.watched(), self.identity.clone());
        let collector = self.collector(bundle)?.with_pose_sampler(sampler);
        let in_flight = self.settings.fragments_in_flight;
        let mut physics = PhysicsThread::start(collector, self.shared.clone(), in_flight)?;
        let _token = token(self.bus, &self.identity.run, &self.identity.actor)?;
        // The set aborts its task when it is dropped.
        let mut pose_task = JoinSet::new();
        pose_task.spawn(poses::publish(poses, publisher, self.settings.environment.env.control_step_s));
        let reason = self.deliver_until_end(&mut physics, shutdown).await?;
        physics.stop().await?;
        Ok(reason)
    }

    fn collector(&self, bundle: &PolicyBundle) -> Result<Collector, ActorError> {
        let (settings, options) = (&self.settings, self.options);
        // Another start must not change a deterministic run: before anything is delivered there is no state to restore.
        let start = if settings.run.deterministic { 0 } else { options.start };
        let seeds = SeedSource { run_seed: settings.run.seed, actor: options.name.clone(), start };
        let noise = seeds.noise();
        // The number of threads may change the rounding of actions.
        let threads = match settings.run.deterministic {
            true => 1,
            false => options.threads.unwrap_or(settings.rollout.threads) as usize,
        };
        let environments =
            Environments::new(options.envs as usize, &options.tasks, &settings.environment, &bundle.model_xml, seeds)?;
        let mut environments = environments.with_precision(settings.precision());
        environments.adopt_curricula(&Reached {
            ground_kinds: &bundle.curriculum_kinds,
            ground_levels: &bundle.curriculum_levels,
            command_factors: &bundle.curriculum_factors,
            failed_steps: &bundle.curriculum_failures,
        });
        let wanted = (bundle.observation_size as usize, bundle.action_size as usize);
        let found = (environments.observation_size(), environments.action_size());
        if wanted != found {
            let why = format!("its observation and action sizes are {wanted:?}, the model's are {found:?}");
            return Err(ActorError::Bundle { number: bundle.version.number, why });
        }
        let mut collector = Collector::new(environments, noise, self.identity.clone()).with_threads(threads)?;
        if settings.run.deterministic {
            collector.attach_state();
        }
        if let Some(state) = &bundle.actor_state {
            restore(&mut collector, state, &options.name);
        }
        Ok(collector)
    }

    /// Delivers fragments, publishes reports and fetches policies until the membership ends.
    async fn deliver_until_end(
        &self,
        physics: &mut PhysicsThread,
        shutdown: &Shutdown,
    ) -> Result<EndReason, ActorError> {
        let (run, actor) = (&self.identity.run, &self.identity.actor);
        let announcements = watch_announcements(self.bus, run)?;
        let publish_episode = publish_episodes(self.bus, run, actor)?;
        let publish_stats = publish_stats(self.bus, run, actor)?;
        let mut stats_due = tokio::time::interval(Duration::from_millis(self.settings.bus.stats_every_ms));
        let mut poll_due = tokio::time::interval(self.poll_interval());
        // Deliveries and fetches wait for answers, so they run as tasks: credit and a request to stop must not wait.
        let mut deliveries = JoinSet::new();
        let mut refreshes = JoinSet::new();
        let (mut place_due, mut place_checks) = (tokio::time::interval(PLACE_CHECK_EVERY), JoinSet::new());
        let mut rate = RateMeter::start();
        let mut moving = Moving::new(self.bus, run, actor, self.seeker.as_ref())?;
        loop {
            if moving.has_left(&deliveries) {
                return Ok(EndReason::Moves(moving.to(), deliveries));
            }
            tokio::select! {
                () = shutdown.wait() => return Ok(EndReason::StopRequested),
                // After its present fragment, for which it has the policy.
                is_admitted = moving.next() => {
                    if is_admitted {
                        physics.finish();
                    }
                }
                produced = physics.next(), if moving.simulates() => {
                    let Some(ProducedFragment { first, episodes }) = produced? else {
                        moving.wait_for_receipts();
                        continue;
                    };
                    let uploader = self.shared.uploader.clone();
                    deliveries.spawn(async move { uploader.deliver(first).await });
                    for episode in &episodes {
                        publish_episode(EpisodeReport::new(run, actor, episode).to_json());
                    }
                }
                Some(delivered) = deliveries.join_next() => {
                    if delivered.map_err(ActorError::Delivery)?? == Refresh::OtherRun {
                        return Ok(EndReason::RunReplaced);
                    }
                    physics.give_credit();
                    moving.hear();
                }
                Some(announced) = announcements.next() => {
                    if self.shared.policies.admits(announced.version) {
                        self.shared.policies.record_announcement(announced);
                        self.refresh(Some(announced.version), &mut refreshes);
                    }
                }
                _ = poll_due.tick() => self.refresh(None, &mut refreshes),
                Some(refresh) = refreshes.join_next() => {
                    if refresh.is_ok_and(|refresh| refresh == Refresh::OtherRun) {
                        return Ok(EndReason::RunReplaced);
                    }
                }
                _ = place_due.tick(), if self.options.behind_standby != BehindStandby::Stay && place_checks.is_empty() => {
                    let policies = self.shared.policies.clone();
                    place_checks.spawn(async move { policies.is_behind_standby().await });
                }
                Some(checked) = place_checks.join_next() => {
                    match (checked, self.options.behind_standby) {
                        (Ok(Ok(true)), BehindStandby::End) => return Ok(EndReason::BehindStandby),
                        (Ok(Ok(true)), _) => tracing::warn!(
                            actor = %actor,
                            "the endpoint is a standby's, which may not pass fragments on; add the leader's with --connect"
                        ),
                        _ => {}
                    }
                }
                _ = stats_due.tick() => publish_stats(self.stats(&mut rate).to_bytes()),
            }
        }
    }

    /// Returns the interval of polling for a policy, with jitter: actors that joined together do not poll together.
    fn poll_interval(&self) -> Duration {
        let jitter = 0.8 + 0.4 * (self.identity.incarnation % 1000) as f64 / 1000.0;
        Duration::from_secs_f64(self.settings.bus.policy_poll_ms as f64 / 1e3 * jitter)
    }

    /// Starts to fetch the newest policy, unless a fetch is under way.
    fn refresh(&self, version: Option<PolicyVersion>, refreshes: &mut JoinSet<Refresh>) {
        if refreshes.is_empty() {
            let policies = self.shared.policies.clone();
            refreshes.spawn(async move { policies.refresh(version).await });
        }
    }

    fn summary(&self) -> ActorSummary {
        ActorSummary {
            incarnation: self.identity.incarnation,
            fragments: self.shared.uploader.counts(),
            settled_through: self.shared.uploader.settled_through(),
            env_steps: self.shared.progress.env_steps.load(Ordering::Relaxed),
        }
    }

    fn stats(&self, rate: &mut RateMeter) -> ActorStats {
        let progress = &self.shared.progress;
        let env_steps = progress.env_steps.load(Ordering::Relaxed);
        let [simulation_steps_per_s, inference_steps_per_s, encoding_steps_per_s] =
            *progress.speeds.lock().unwrap_or_else(PoisonError::into_inner);
        ActorStats {
            simulation_steps_per_s,
            inference_steps_per_s,
            encoding_steps_per_s,
            incarnation: self.identity.incarnation,
            envs: self.options.envs,
            env_steps_per_s: rate.update(env_steps),
            env_steps,
            episodes: progress.episodes.load(Ordering::Relaxed),
            faults: progress.faults.load(Ordering::Relaxed),
            ..self.shared.uploader.stats()
        }
    }
}

/// Continues from the state that a checkpoint holds, or begins new episodes if that does not fit.
fn restore(collector: &mut Collector, state: &ActorState, actor: &str) {
    match collector.restore_state(state) {
        Ok(()) => tracing::info!(%actor, "continuing from the actor state in the checkpoint"),
        Err(reason) => tracing::warn!(
            %actor,
            %reason,
            "the actor state in the checkpoint does not fit: the actor begins new episodes, and the run is not bit-identical"
        ),
    }
}
