//! One played actor: real messages in real order, without physics.

use std::{
    collections::VecDeque,
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicU32, Ordering},
    },
    time::{Duration, Instant},
};

use anyhow::Context;
use bytes::Bytes;
use tokio::{
    sync::{mpsc, watch},
    time::sleep,
};
use treadmill_bus::{
    Bus,
    actor::{Announcements, fetch_policy, publish_stats, submit, token, watch_announcements},
};
use treadmill_config::RolloutConfig;
use treadmill_experience::delivery::{Attempt, Event};
use treadmill_proto::{ActorStats, Fragment, Outcome, PolicyVersion, Receipt};
use treadmill_runtime::{machine, seeds};

use super::{
    RUN,
    counts::{ActorCounts, keep_time},
    pace::{Pace, duration},
    policy::{PlayedPolicies, PlayedPolicy},
};

const FETCH_TIMEOUT: Duration = Duration::from_secs(10);
/// Pause before the policy is asked for again.
const RETRY: Duration = Duration::from_millis(200);
/// Most credits that an actor holds, as `rollout.max_in_flight` allows.
const CREDITS_MAX: usize = 2;
/// Policies that an actor remembers: a simulation may have begun a moment before the newest arrived.
const POLICIES_MAX: usize = 4;

/// What the actors of a process are to do.
#[derive(Clone, Debug, Default)]
pub enum Order {
    /// Hold the first credits.
    #[default]
    Wait,
    /// Simulate at these rates (environment steps per second), one for each actor of the process.
    Simulate(Arc<Vec<f64>>),
    /// Begin no fragment, discard the present one, and deliver the others.
    Stop,
}

/// Parts that the actors of a process share.
#[derive(Clone)]
pub struct FleetShared {
    pub policies: Arc<PlayedPolicies>,
    pub order: watch::Receiver<Order>,
    /// First error of any actor.
    pub failure: Arc<Mutex<Option<String>>>,
    pub envs: u32,
}

/// Policy with the time of its arrival.
type Arrived = (Instant, Arc<PlayedPolicy>);

/// Actor that does not simulate.
pub struct PlayedActor {
    shared: FleetShared,
    bus: Bus,
    /// Number within the process, for its rate.
    index: usize,
    name: String,
    incarnation: u64,
    /// The newest last.
    policies: Mutex<VecDeque<Arrived>>,
    fetching: tokio::sync::Mutex<()>,
    /// Control steps that the newest receipt asks for; 0 if it does not.
    steps_asked: AtomicU32,
    counts: Mutex<ActorCounts>,
}

impl PlayedActor {
    /// Joins the run: fetches the policy, declares the token and starts the actor's tasks.
    pub async fn join(shared: FleetShared, bus: Bus, index: usize, name: String) -> anyhow::Result<Arc<Self>> {
        let policy = loop {
            if let Some(bundle) = fetch_policy(&bus, Some(RUN), FETCH_TIMEOUT).await? {
                break shared.policies.get(bundle)?;
            }
            sleep(RETRY).await;
        };
        let learner = policy.version().incarnation;
        let policies = Mutex::new(VecDeque::from([(Instant::now(), policy)]));
        let incarnation = seeds::unique();
        let (fetching, steps_asked) = (tokio::sync::Mutex::default(), AtomicU32::new(0));
        let counts = Mutex::new(ActorCounts::new(learner));
        let actor = Arc::new(Self { shared, bus, index, name, incarnation, policies, fetching, steps_asked, counts });
        let (token, announcements) = (token(&actor.bus, RUN, &actor.name)?, watch_announcements(&actor.bus, RUN)?);
        actor.spawn({
            let actor = actor.clone();
            async move {
                let _token = token;
                actor.follow(&announcements).await
            }
        });
        let producer = actor.clone();
        actor.spawn(async move { producer.produce().await });
        Ok(actor)
    }

    /// Returns the counts, which the actor shares with its tasks.
    pub fn counts(&self) -> MutexGuard<'_, ActorCounts> {
        self.counts.lock().expect("no holder of this lock panics")
    }

    /// Starts a task and keeps the first error.
    fn spawn(&self, task: impl Future<Output = anyhow::Result<()>> + Send + 'static) {
        let (failure, name) = (self.shared.failure.clone(), self.name.clone());
        tokio::spawn(async move {
            if let Err(why) = task.await {
                let mut failure = failure.lock().expect("no holder of this lock panics");
                failure.get_or_insert(format!("{name}: {why:#}"));
            }
        });
    }

    /// Simulates one fragment for each credit, in ideal time.
    async fn produce(self: Arc<Self>) -> anyhow::Result<()> {
        let mut order = self.shared.order.clone();
        order.wait_for(|order| !matches!(order, Order::Wait)).await?;
        let (credit, mut credits) = mpsc::channel(CREDITS_MAX);
        let now = Instant::now();
        for _ in 0..self.shared.policies.config.fragments_in_flight() {
            credit.try_send(now)?;
        }
        let mut pace = Pace::new(now);
        let mut env_steps = 0;
        loop {
            let credit_at = tokio::select! {
                credit = credits.recv() => credit.context("this task has a sender")?,
                () = stopped(&mut order) => return Ok(()),
            };
            let begun = pace.begin(credit_at);
            let policy = self.policy_at(begun);
            if !policy.is_prepared() {
                // Evaluates the networks while the simulation would run; the delivery returns an error.
                let policy = policy.clone();
                tokio::task::spawn_blocking(move || policy.transitions().is_ok());
            }
            let steps = self.fragment_steps(&policy);
            let transitions = u64::from(steps) * u64::from(self.shared.envs);
            let Order::Simulate(rates) = order.borrow().clone() else { return Ok(()) };
            let simulated = duration(transitions, rates[self.index]);
            let ready = pace.finish(begun, transitions, rates[self.index]);
            tokio::select! {
                biased;
                () = stopped(&mut order) => return Ok(()),
                () = tokio::time::sleep_until(ready.into()) => {}
            }
            env_steps += transitions;
            let (sequence, settled_through) = {
                let mut counts = self.counts();
                let settled_through = counts.settled_through();
                (counts.produce(transitions, simulated), settled_through)
            };
            let header = Fragment {
                actor: self.name.clone(),
                actor_incarnation: self.incarnation,
                sequence,
                steps,
                envs: self.shared.envs,
                settled_through,
                env_steps,
                collect_s: simulated.as_secs_f64(),
                ..Fragment::default()
            };
            let (actor, credit) = (self.clone(), credit.clone());
            self.spawn(async move { actor.deliver(&policy, &header, ready, &credit).await });
        }
    }

    /// Returns the newest policy that had arrived at `time`.
    fn policy_at(&self, time: Instant) -> Arc<PlayedPolicy> {
        let policies = self.policies.lock().expect("no holder of this lock panics");
        let arrived = policies.iter().rev().find(|(at, _)| *at <= time).or(policies.front());
        arrived.expect("the policy of the join is there").1.clone()
    }

    fn newest_policy(&self) -> Arc<PlayedPolicy> {
        let policies = self.policies.lock().expect("no holder of this lock panics");
        policies.back().expect("the policy of the join is there").1.clone()
    }

    fn fragment_steps(&self, policy: &PlayedPolicy) -> u32 {
        let configured = self.shared.policies.config.rollout.fragment_steps;
        let asked = [self.steps_asked.load(Ordering::Relaxed), policy.fragment_steps(), configured];
        asked.into_iter().find(|steps| *steps > 0).unwrap_or(RolloutConfig::STEPS_MAX)
    }

    /// Delivers one fragment, then fetches the policy that its receipt names, then returns the credit.
    async fn deliver(
        &self,
        policy: &PlayedPolicy,
        header: &Fragment,
        ready: Instant,
        credit: &mpsc::Sender<Instant>,
    ) -> anyhow::Result<()> {
        let bytes = Bytes::from(policy.transitions()?.encode(header)?);
        let first = self.counts().begin_delivery(header.sequence, bytes);
        keep_time(&mut self.counts().times.late_ms, ready.elapsed());
        let begun = Instant::now();
        let receipt = self.send_until_settled(first).await?;
        anyhow::ensure!(receipt.outcome != Outcome::Malformed, "the learner rejects a fragment: {}", receipt.reason);
        keep_time(&mut self.counts().times.receipts_ms, begun.elapsed());
        self.steps_asked.store(receipt.fragment_steps, Ordering::Relaxed);
        self.refresh(Some(receipt.version)).await?;
        let adopted = Event::Adopted { incarnation: self.newest_policy().version().incarnation };
        let again = self.counts().handle(adopted);
        for attempt in again {
            self.send_until_settled(attempt).await?;
        }
        // The channel has space for every credit.
        let _ = credit.try_send(Instant::now());
        Ok(())
    }

    async fn send_until_settled(&self, first: Attempt) -> anyhow::Result<Receipt> {
        let timeout = Duration::from_millis(self.shared.policies.config.bus.receipt_timeout_ms);
        let mut next = first;
        loop {
            let Attempt { sequence, bytes, pause } = next;
            sleep(pause).await;
            let receipt = submit(&self.bus, RUN, &self.name, bytes, timeout, |_| true).await?;
            let event = match &receipt {
                Some(receipt) => Event::Answered { sequence, receipt: receipt.clone() },
                None => Event::Silent { sequence },
            };
            match (self.counts().handle(event).pop(), receipt) {
                (Some(attempt), _) => next = attempt,
                (None, receipt) => return receipt.context("only a receipt settles a fragment"),
            }
        }
    }

    /// Fetches policies that are announced, polls for others, and publishes statistics.
    async fn follow(&self, announcements: &Announcements) -> anyhow::Result<()> {
        let config = &self.shared.policies.config.bus;
        let jitter = 0.8 + 0.4 * (self.incarnation % 1000) as f64 / 1000.0;
        let mut poll_due = tokio::time::interval(Duration::from_secs_f64(config.policy_poll_ms as f64 / 1e3 * jitter));
        let mut stats_due = tokio::time::interval(Duration::from_millis(config.stats_every_ms));
        let publish_stats = publish_stats(&self.bus, RUN, &self.name)?;
        let (mut since, mut env_steps) = (Instant::now(), 0);
        // Announcements and polls start no fetch while another one of theirs is under way, as in an actor.
        let mut asked = None;
        loop {
            tokio::select! {
                Some(announcement) = announcements.next() => if asked.is_none() {
                    asked = Some(Box::pin(self.refresh(Some(announcement.version))));
                },
                _ = poll_due.tick() => if asked.is_none() {
                    asked = Some(Box::pin(self.refresh(None)));
                },
                fetched = async { asked.as_mut().expect("the branch has a condition").await }, if asked.is_some() => {
                    asked = None;
                    fetched?;
                }
                _ = stats_due.tick() => {
                    let mut stats = self.stats();
                    let passed_s = since.elapsed().as_secs_f64().max(1e-9);
                    stats.env_steps_per_s = (stats.env_steps - env_steps) as f64 / passed_s;
                    (since, env_steps) = (Instant::now(), stats.env_steps);
                    publish_stats(stats.to_bytes());
                }
            }
        }
    }

    /// Fetches the newest policy, unless the `known` newest version is already here.
    async fn refresh(&self, known: Option<PolicyVersion>) -> anyhow::Result<()> {
        let _one_at_a_time = self.fetching.lock().await;
        let version = self.newest_policy().version();
        if known == Some(version) {
            return Ok(());
        }
        let begun = Instant::now();
        let Some(bundle) = fetch_policy(&self.bus, Some(RUN), FETCH_TIMEOUT).await? else { return Ok(()) };
        keep_time(&mut self.counts().times.fetches_ms, begun.elapsed());
        if bundle.version != version {
            let policy = self.shared.policies.get(bundle)?;
            let mut policies = self.policies.lock().expect("no holder of this lock panics");
            policies.push_back((Instant::now(), policy));
            let old = policies.len().saturating_sub(POLICIES_MAX);
            policies.drain(..old);
        }
        Ok(())
    }

    fn stats(&self) -> ActorStats {
        let (tally, awaiting_durability) = {
            let counts = self.counts();
            (counts.tally(), counts.awaiting_durability())
        };
        ActorStats {
            actor: self.name.clone(),
            incarnation: self.incarnation,
            host: machine::host_name(),
            pid: std::process::id(),
            version: Some(self.newest_policy().version().into()),
            envs: self.shared.envs,
            env_steps: tally.produced_steps,
            produced: tally.produced,
            accepted: tally.accepted,
            dropped_by_rule: tally.dropped,
            in_flight: tally.in_flight,
            resent: tally.resent,
            awaiting_durability,
            resident_bytes: machine::resident_bytes(),
            program_version: env!("CARGO_PKG_VERSION").to_string(),
            ..ActorStats::default()
        }
    }
}

/// Waits until the actors are to stop.
async fn stopped(order: &mut watch::Receiver<Order>) {
    // Without a sender, the process is ending.
    let _ = order.wait_for(|order| matches!(order, Order::Stop)).await;
}
