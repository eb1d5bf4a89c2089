//! One played actor: the delivery and the policies of a real one, without physics.

use std::{
    sync::{Arc, Mutex, MutexGuard},
    time::{Duration, Instant},
};

use anyhow::Context;
use tokio::{
    sync::{mpsc, watch},
    task::block_in_place,
    time::sleep,
};
use treadmill_actor::{
    delivery::Uploader,
    policy_fetcher::{PolicyFetcher, Refresh},
    settings::RunSettings,
};
use treadmill_bus::{
    Bus,
    actor::{fetch_policy, publish_stats, token, watch_announcements},
};
use treadmill_experience::delivery::Attempt;
use treadmill_proto::{ActorStats, Fragment, Outcome, PolicyBundle, PolicyVersion};
use treadmill_runtime::machine;

use super::{
    counts::{Tally, Times, keep_time},
    transitions::Transitions,
};
use crate::RUN;

const FETCH_TIMEOUT: Duration = Duration::from_secs(10);
/// Pause before the policy is asked for again.
const RETRY: Duration = Duration::from_millis(200);
/// Most credits that an actor holds, as `rollout.max_in_flight` allows.
const CREDITS_MAX: usize = 2;

/// What the actors of a process are to do.
#[derive(Clone, Debug, Default)]
pub enum Order {
    /// Hold the first credits.
    #[default]
    Wait,
    /// Simulate at these rates (environment steps per second), one for each actor of the process.
    Simulate(Arc<[f64]>),
    /// Begin no fragment, discard the present one, and deliver the others.
    Stop,
}

/// Parts that the actors of a process share.
pub struct PlayedRun {
    pub settings: RunSettings,
    pub transitions: Transitions,
    /// Of every actor of the process, as admission control reads it from the first bytes of a fragment.
    pub incarnation: u64,
    pub envs: u32,
    pub order: watch::Receiver<Order>,
    /// First error of any actor.
    pub failure: Mutex<Option<String>>,
}

/// Actor that does not simulate.
pub struct PlayedActor {
    run: Arc<PlayedRun>,
    bus: Bus,
    /// Number within the process, for its rate.
    index: usize,
    name: String,
    policies: Arc<PolicyFetcher>,
    uploader: Uploader,
    tally: Mutex<Tally>,
    times: Mutex<Times>,
}

/// Waits for the first policy.
pub async fn first_bundle(bus: &Bus) -> anyhow::Result<PolicyBundle> {
    loop {
        if let Some(bundle) = fetch_policy(bus, Some(RUN), FETCH_TIMEOUT).await? {
            return Ok(bundle);
        }
        sleep(RETRY).await;
    }
}

impl PlayedActor {
    /// Joins the run: fetches the policy, declares the token and starts the actor's tasks.
    pub async fn join(run: Arc<PlayedRun>, bus: Bus, index: usize, name: String) -> anyhow::Result<Arc<Self>> {
        let bundle = first_bundle(&bus).await?;
        let policies = Arc::new(PolicyFetcher::new(bus.clone(), Some(RUN.to_string()), &bundle, Arc::default())?);
        let steps = run.settings.first_fragment_steps(&bundle, run.envs)?;
        let timeout = Duration::from_millis(run.settings.bus.receipt_timeout_ms);
        let uploader = Uploader::new(bus.clone(), RUN, &name, timeout, policies.clone(), steps);
        let (tally, times) = (Mutex::default(), Mutex::default());
        let actor = Arc::new(Self { run, bus, index, name, policies, uploader, tally, times });
        actor.spawn({
            let (actor, token) = (actor.clone(), token(&actor.bus, RUN, &actor.name)?);
            async move {
                let _token = token;
                actor.follow().await
            }
        });
        let producer = actor.clone();
        actor.spawn(async move { producer.produce().await });
        Ok(actor)
    }

    /// Returns the present sums.
    pub fn tally(&self) -> Tally {
        let sums = *self.sums();
        Tally { resent: self.uploader.counts().resent, proven: sums.accepted.min(1), ..sums }
    }

    /// Returns the measured times, which the actor shares with its tasks.
    pub fn times(&self) -> MutexGuard<'_, Times> {
        self.times.lock().expect("no holder of this lock panics")
    }

    fn sums(&self) -> MutexGuard<'_, Tally> {
        self.tally.lock().expect("no holder of this lock panics")
    }

    /// Starts a task and keeps the first error.
    fn spawn(&self, task: impl Future<Output = anyhow::Result<()>> + Send + 'static) {
        let (run, name) = (self.run.clone(), self.name.clone());
        tokio::spawn(async move {
            if let Err(why) = task.await {
                let mut failure = run.failure.lock().expect("no holder of this lock panics");
                failure.get_or_insert(format!("{name}: {why:#}"));
            }
        });
    }

    /// Simulates one fragment for each credit, in ideal time: a timer that fires late delays no later simulation.
    async fn produce(self: Arc<Self>) -> anyhow::Result<()> {
        let (run, mut order) = (&self.run, self.run.order.clone());
        order.wait_for(|order| !matches!(order, Order::Wait)).await?;
        let (credit, mut credits) = mpsc::channel(CREDITS_MAX);
        let mut free_at = Instant::now();
        for _ in 0..run.settings.fragments_in_flight {
            credit.try_send(free_at)?;
        }
        let (mut sequence, mut env_steps) = (0, 0);
        loop {
            let credit_at = tokio::select! {
                credit = credits.recv() => credit.context("this task has a sender")?,
                () = stopped(&mut order) => return Ok(()),
            };
            let (policy, steps) = (self.policies.current(), self.uploader.fragment_steps());
            // While the simulation would run.
            let prepared = block_in_place(|| run.transitions.fragment(&policy, steps))?;
            let Order::Simulate(rates) = order.borrow().clone() else { return Ok(()) };
            let transitions = u64::from(steps) * u64::from(run.envs);
            let simulated = Duration::from_secs_f64(transitions as f64 / rates[self.index]);
            free_at = free_at.max(credit_at) + simulated;
            tokio::select! {
                biased;
                () = stopped(&mut order) => return Ok(()),
                () = tokio::time::sleep_until(free_at.into()) => {}
            }
            (sequence, env_steps) = (sequence + 1, env_steps + transitions);
            let bytes = prepared.under(&Fragment {
                actor: self.name.clone(),
                actor_incarnation: run.incarnation,
                sequence,
                settled_through: self.uploader.settled_through(),
                env_steps,
                collect_s: simulated.as_secs_f64(),
                ..Fragment::default()
            });
            self.sums().add(Tally {
                produced: 1,
                produced_steps: transitions,
                produced_bytes: bytes.len() as u64,
                simulated_us: simulated.as_micros() as u64,
                ..Tally::default()
            });
            let first = self.uploader.produced(sequence, bytes.into());
            let (actor, credit, ready) = (self.clone(), credit.clone(), free_at);
            self.spawn(async move {
                actor.deliver(first, transitions, ready).await?;
                // Without a receiver, the actor has stopped.
                let _ = credit.try_send(Instant::now());
                Ok(())
            });
        }
    }

    /// Delivers one fragment, then fetches the policy that its receipt names.
    async fn deliver(&self, first: Attempt, transitions: u64, ready: Instant) -> anyhow::Result<()> {
        keep_time(&mut self.times().late_ms, ready.elapsed());
        let begun = Instant::now();
        let receipt = self.uploader.settle(first).await?;
        anyhow::ensure!(receipt.outcome != Outcome::Malformed, "the learner rejects a fragment: {}", receipt.reason);
        keep_time(&mut self.times().receipts_ms, begun.elapsed());
        self.sums().add(match receipt.outcome {
            Outcome::Accepted | Outcome::Duplicate => {
                Tally { accepted: 1, accepted_steps: transitions, ..Tally::default() }
            }
            _ => Tally { dropped: 1, dropped_steps: transitions, ..Tally::default() },
        });
        self.timed(async { Ok(self.uploader.adopt(&receipt).await?) }).await
    }

    /// Measures how long it takes to get a newer policy.
    async fn timed(&self, refresh: impl Future<Output = anyhow::Result<Refresh>>) -> anyhow::Result<()> {
        let begun = Instant::now();
        match refresh.await? {
            Refresh::Unchanged => {}
            Refresh::Replaced => {
                let (number, mut times) = (self.policies.current().version.number, self.times());
                keep_time(&mut times.fetches_ms, begun.elapsed());
                times.arrivals.insert(number, machine::time_unix_s());
            }
            Refresh::OtherRun => anyhow::bail!("the learner trains another run"),
        }
        Ok(())
    }

    /// Fetches the newest policy, unless the `known` newest version is already here.
    async fn refresh(&self, known: Option<PolicyVersion>) -> anyhow::Result<()> {
        self.timed(async { Ok(self.policies.refresh(known).await) }).await
    }

    /// Fetches policies that are announced, polls for others, and publishes statistics.
    async fn follow(&self) -> anyhow::Result<()> {
        let config = &self.run.settings.bus;
        let announcements = watch_announcements(&self.bus, RUN)?;
        let jitter = 0.8 + 0.4 * ((self.index * 7) % 10) as f64 / 10.0;
        let mut poll_due = tokio::time::interval(Duration::from_secs_f64(config.policy_poll_ms as f64 / 1e3 * jitter));
        let mut stats_due = tokio::time::interval(Duration::from_millis(config.stats_every_ms));
        let publish_stats = publish_stats(&self.bus, RUN, &self.name)?;
        let (mut since, mut env_steps) = (Instant::now(), 0);
        // Announcements and polls start no fetch while another one of theirs is under way, as in an actor.
        let mut asked = None;
        loop {
            tokio::select! {
                Some(announcement) = announcements.next(), if asked.is_none() => {
                    self.policies.record_announcement(announcement);
                    asked = Some(Box::pin(self.refresh(Some(announcement.version))));
                }
                _ = poll_due.tick(), if asked.is_none() => asked = Some(Box::pin(self.refresh(None))),
                fetched = async { asked.as_mut().expect("the branch has a condition").await }, if asked.is_some() => {
                    asked = None;
                    fetched?;
                }
                _ = stats_due.tick() => {
                    let (before, passed_s) = (env_steps, since.elapsed().as_secs_f64().max(1e-9));
                    (since, env_steps) = (Instant::now(), self.sums().produced_steps);
                    publish_stats(self.stats(env_steps, (env_steps - before) as f64 / passed_s).to_bytes());
                }
            }
        }
    }

    fn stats(&self, env_steps: u64, env_steps_per_s: f64) -> ActorStats {
        let PlayedRun { incarnation, envs, .. } = *self.run;
        ActorStats { incarnation, envs, env_steps, env_steps_per_s, ..self.uploader.stats() }
    }
}

/// Waits until the actors are to stop.
async fn stopped(order: &mut watch::Receiver<Order>) {
    // Without a sender, the process is ending.
    let _ = order.wait_for(|order| matches!(order, Order::Stop)).await;
}
