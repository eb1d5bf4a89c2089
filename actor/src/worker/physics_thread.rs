//! Physics thread of an actor: collects one fragment per credit with the newest policy.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
        mpsc as std_mpsc,
    },
    thread::{self, JoinHandle},
    time::{Duration, Instant},
};

use tokio::sync::mpsc;
use treadmill_experience::delivery::Attempt;
use treadmill_proto::{EndCause, Episode, Fragment, Precision};

use crate::{ActorError, delivery::Uploader, policy_fetcher::PolicyFetcher, rollout::Collector};

/// Capacity of the channel to the uploader: the most credit that `rollout.max_in_flight` allows.
const CHANNEL_FRAGMENTS: usize = 2;

/// First attempt to deliver a fragment, with the episodes that ended in it.
pub(super) struct ProducedFragment {
    pub(super) first: Attempt,
    pub(super) episodes: Vec<Episode>,
}

/// Counts of the physics thread.
#[derive(Default)]
pub(super) struct Progress {
    pub(super) env_steps: AtomicU64,
    pub(super) episodes: AtomicU64,
    pub(super) faults: AtomicU64,
    /// Environment steps per second that simulation, networks and encoding would each allow alone.
    pub(super) speeds: Mutex<[f64; 3]>,
}

/// Parts of an actor that the physics thread and the async tasks share.
#[derive(Clone)]
pub(super) struct Shared {
    pub(super) policies: Arc<PolicyFetcher>,
    pub(super) uploader: Arc<Uploader>,
    pub(super) progress: Arc<Progress>,
}

/// Handle of the running thread.
pub(super) struct PhysicsThread {
    thread: JoinHandle<()>,
    /// Until it should finish.
    credit: Option<std_mpsc::Sender<()>>,
    finishes: Arc<AtomicBool>,
    produced: mpsc::Receiver<Result<ProducedFragment, ActorError>>,
}

impl PhysicsThread {
    /// Starts the thread with credit for `in_flight` fragments.
    pub(super) fn start(collector: Collector, shared: Shared, in_flight: u32) -> Result<Self, ActorError> {
        let (credit, received_credit) = std_mpsc::channel();
        let (sender, produced) = mpsc::channel(CHANNEL_FRAGMENTS);
        let finishes = Arc::new(AtomicBool::new(false));
        let asked = finishes.clone();
        let thread = thread::Builder::new()
            .name("physics".to_string())
            .spawn(move || collect_fragments(collector, &shared, &asked, &received_credit, &sender))
            .map_err(ActorError::ThreadStart)?;
        let physics = Self { thread, credit: Some(credit), finishes, produced };
        (0..in_flight).for_each(|_| physics.give_credit());
        Ok(physics)
    }

    /// Allows one more fragment.
    pub(super) fn give_credit(&self) {
        // A thread that has ended needs no credit; `next` returns its error.
        let _ = self.credit.as_ref().map(|credit| credit.send(()));
    }

    /// Lets the thread end after its present fragment, which [`Self::next`] still returns.
    pub(super) fn finish(&mut self) {
        self.finishes.store(true, Ordering::Relaxed);
        self.credit = None;
    }

    /// Returns the next fragment; `None` after the last one of a thread that should finish. Cancel-safe.
    pub(super) async fn next(&mut self) -> Result<Option<ProducedFragment>, ActorError> {
        match self.produced.recv().await {
            Some(produced) => produced.map(Some),
            None if self.credit.is_none() => Ok(None),
            None => Err(ActorError::PhysicsEnded),
        }
    }

    /// Waits until the thread has finished its present fragment, which is discarded.
    pub(super) async fn stop(self) -> Result<(), ActorError> {
        let Self { thread, credit, produced, .. } = self;
        drop((credit, produced));
        let joined = tokio::task::spawn_blocking(move || thread.join()).await;
        joined.ok().and_then(Result::ok).ok_or(ActorError::PhysicsPanicked)
    }
}

fn collect_fragments(
    mut collector: Collector,
    shared: &Shared,
    finishes: &AtomicBool,
    credit: &std_mpsc::Receiver<()>,
    sender: &mpsc::Sender<Result<ProducedFragment, ActorError>>,
) {
    let (mut encoding, mut env_steps) = (Duration::ZERO, 0);
    while credit.recv().is_ok() && !finishes.load(Ordering::Relaxed) {
        let policy = shared.policies.current();
        let (steps, settled_through) = (shared.uploader.fragment_steps(), shared.uploader.settled_through());
        let begun = Instant::now();
        let produced = collector.collect(&policy, steps, settled_through).and_then(|mut fragment| {
            let collected = begun.elapsed();
            fragment.collect_s = collected.as_secs_f64();
            env_steps += fragment.transitions();
            let encoded = encode(fragment, collector.precision(), shared);
            encoding += begun.elapsed() - collected;
            let [simulation, inference] = collector.speeds();
            let encoding = env_steps as f64 / encoding.as_secs_f64().max(1e-9);
            *shared.progress.speeds.lock().unwrap_or_else(PoisonError::into_inner) = [simulation, inference, encoding];
            encoded
        });
        let failed = produced.is_err();
        if sender.blocking_send(produced).is_err() || failed {
            return;
        }
    }
}

fn encode(fragment: Fragment, precision: Precision, shared: &Shared) -> Result<ProducedFragment, ActorError> {
    let bytes = fragment.encode_as(precision).map_err(ActorError::Encoding)?;
    let Shared { progress, uploader, .. } = shared;
    progress.env_steps.fetch_add(fragment.transitions() as u64, Ordering::Relaxed);
    progress.episodes.fetch_add(fragment.episodes.len() as u64, Ordering::Relaxed);
    let faults = fragment.episodes.iter().filter(|episode| episode.cause == EndCause::NonFinite).count();
    progress.faults.fetch_add(faults as u64, Ordering::Relaxed);
    let first = uploader.produced(fragment.sequence, bytes.into());
    Ok(ProducedFragment { first, episodes: fragment.episodes })
}
