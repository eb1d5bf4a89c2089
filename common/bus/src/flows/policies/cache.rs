//! Policies in a router: fetches each version once and answers for the actors behind it.
//!
//! A router is asked on a key of its own, `treadmill/{run}/policy/pieces/{node}`. Zenoh would pass a request on a
//! shared key to the router *and* to the learner, because it chooses the best server in each region of the network
//! separately.

use std::{
    collections::HashMap,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use tokio::{sync::mpsc, task::JoinSet};
use treadmill_proto::{PolicyAnnouncement, PolicyBundle, PolicyRequest, PolicyVersion, ident::check_ident};
use zenoh::{Wait, key_expr::KeyExpr, pubsub::Subscriber};

use super::{
    announcements,
    fetch::{FetchedPolicy, fetch_pieces},
    pieces::{self, ActorPolicy, PieceReply, PieceServer, ServedPolicies},
    silences::{Heard, Silences},
};
use crate::{
    error::BusError,
    flows::{presence::is_learner_present, shared::serve},
    session::Bus,
};

/// Runs whose policies are cached. Requests for further runs get no reply, and actors ask the learner.
const RUNS_MAX: usize = 16;
/// Time without a request after which a run may be forgotten.
const IDLE: Duration = Duration::from_secs(60);
/// Requests and announcements that may wait for the cache.
const QUEUE: usize = 4096;
/// Requests of one run that may wait for the learner's answer. Further ones get no reply.
const WAITING_MAX: usize = 4096;
/// Longest wait for the learner.
const FETCH_TIMEOUT: Duration = Duration::from_secs(10);
/// Longest wait for the token of a learner that did not answer.
const TOKEN_TIMEOUT: Duration = Duration::from_secs(1);
/// Time after which the learner is asked whether a policy is still the newest, as announcements may be lost.
const FRESH: Duration = Duration::from_secs(5);
/// Shortest time between two questions about one run, whatever requesters claim to have heard of.
const ASK_INTERVAL: Duration = Duration::from_millis(10);
/// Fetches in a row, because newer versions were announced meanwhile, before waiting requests are answered.
const FETCHES_MAX: u32 = 3;

/// Policies of the runs whose actors asked this router.
pub struct PolicyCache {
    bus: Bus,
    events: mpsc::Receiver<Event>,
    /// Whether an announcement found the queue full.
    missed: Arc<AtomicBool>,
    pieces: PieceServer,
    _subscriber: Subscriber<()>,
}

/// Learner that does not answer, though it should.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SilentLearner {
    /// Its run.
    pub run: String,
    /// Whether any learner has answered on this session.
    pub has_answers: bool,
}

enum Event {
    Request(String, PieceReply),
    Announced(String, PolicyAnnouncement),
}

impl PolicyCache {
    /// Declares the cache on a router's session. [`Self::serve`] must run for requests to be answered.
    pub fn open(bus: &Bus) -> Result<Self, BusError> {
        let (sender, events) = mpsc::channel(QUEUE);
        let missed = Arc::<AtomicBool>::default();
        serve(bus, pieces::key_of("*", &bus.session.zid().to_string()), "serving policies", {
            let sender = sender.clone();
            move |query| {
                let Some(run) = run_of(query.key_expr()) else { return };
                if let Some(reply) = PieceReply::read(query) {
                    drop(sender.try_send(Event::Request(run, reply)));
                }
            }
        })?;
        let subscriber = bus
            .session
            .declare_subscriber(announcements::key("*"))
            .callback({
                let missed = missed.clone();
                move |sample| {
                    let Some(run) = run_of(sample.key_expr()) else { return };
                    let Ok(announcement) = PolicyAnnouncement::decode(&sample.payload().to_bytes()) else { return };
                    if sender.try_send(Event::Announced(run, announcement)).is_err() {
                        missed.store(true, Ordering::Relaxed);
                    }
                }
            })
            .wait()
            .map_err(BusError::flow("listening to announcements"))?;
        let (bus, pieces) = (bus.clone(), PieceServer::start()?);
        Ok(Self { bus, events, missed, pieces, _subscriber: subscriber })
    }

    /// Returns what the actors behind this router got.
    #[must_use]
    pub fn served(&self) -> ServedPolicies {
        self.pieces.served()
    }

    /// Answers requests until a learner has been silent for as long as `patience`; `None` after the session is closed.
    /// A learner that cannot be reached is silent, too, if one has answered on this session, or before as
    /// `expects_answers` says.
    pub async fn serve(mut self, patience: Duration, expects_answers: bool) -> Option<SilentLearner> {
        let (mut runs, mut silences) = (CachedRuns::default(), Silences::new(expects_answers));
        let mut fetches: JoinSet<(String, Option<FetchedPolicy>, Heard)> = JoinSet::new();
        loop {
            let steps = tokio::select! {
                Some(event) = self.events.recv() => {
                    if self.missed.swap(false, Ordering::Relaxed) {
                        runs.distrust();
                    }
                    match event {
                        Event::Request(run, reply) => {
                            let request = reply.request;
                            runs.request(&run, &request, reply, Instant::now())
                        }
                        Event::Announced(run, announcement) => runs.announce(&run, announcement, Instant::now()),
                    }
                }
                Some(Ok((run, fetched, outcome))) = fetches.join_next() => {
                    if silences.record(&run, outcome, Instant::now()) >= patience {
                        return Some(SilentLearner { run, has_answers: silences.has_answers });
                    }
                    runs.fetched(&run, fetched, Instant::now())
                }
                else => return None,
            };
            for (reply, policy) in steps.answers {
                self.pieces.send(reply, policy);
            }
            if let Some(Fetch { run, request, delay }) = steps.fetch {
                let bus = self.bus.clone();
                fetches.spawn(async move {
                    tokio::time::sleep(delay).await;
                    let fetched = fetch_pieces(&bus, pieces::key(&run), &request, FETCH_TIMEOUT).await;
                    let fetched = fetched.unwrap_or_else(|error| {
                        tracing::warn!(run, %error, "policy not fetched");
                        None
                    });
                    let outcome = match fetched {
                        Some(_) => Heard::Answered,
                        None if is_learner_present(&bus, &run, TOKEN_TIMEOUT).await.unwrap_or(false) => Heard::Silent,
                        None if bus.is_linked() => Heard::Unreachable,
                        None => Heard::Absent,
                    };
                    (run, fetched, outcome)
                });
            }
        }
    }
}

/// Returns the run in a key if its name is valid.
fn run_of(key: &KeyExpr<'_>) -> Option<String> {
    let run = key.as_str().split('/').nth(1)?;
    check_ident("run", run).is_ok().then(|| run.to_string())
}

/// Cached policies. `W` is a request that waits for its answer.
struct CachedRuns<W> {
    runs: HashMap<String, CachedRun<W>>,
}

impl<W> Default for CachedRuns<W> {
    fn default() -> Self {
        Self { runs: HashMap::new() }
    }
}

struct CachedRun<W> {
    cached: Option<CachedPolicy>,
    /// Newest announcement, until the learner has answered a question that was asked later.
    announced: Option<PolicyAnnouncement>,
    /// Whether it came after the last question.
    is_announcement_new: bool,
    /// When the learner last answered.
    checked: Option<Instant>,
    used: Instant,
    waiting: Vec<W>,
    /// Fetches since the last answer to waiting requests. Zero means that none is under way.
    fetches: u32,
}

struct CachedPolicy {
    policy: Arc<ActorPolicy>,
    /// Configuration and model, which updates lack.
    config: (String, String),
}

/// What to do after an event.
struct Steps<W> {
    answers: Vec<(W, Arc<ActorPolicy>)>,
    fetch: Option<Fetch>,
}

impl<W> Default for Steps<W> {
    fn default() -> Self {
        Self { answers: Vec::new(), fetch: None }
    }
}

/// Question to the learner.
#[derive(Debug, PartialEq)]
struct Fetch {
    run: String,
    request: PolicyRequest,
    delay: Duration,
}

impl<W> CachedRuns<W> {
    /// Answers a request, or lets it wait for the learner. Drops it if too many wait, or if too many runs are in use.
    fn request(&mut self, run: &str, request: &PolicyRequest, waiter: W, now: Instant) -> Steps<W> {
        let Some(entry) = self.entry(run, now) else { return Steps::default() };
        entry.used = now;
        if let Some(cached) = entry.cached.as_ref().filter(|cached| entry.is_newest(cached, request, now)) {
            return Steps { answers: vec![(waiter, cached.policy.clone())], fetch: None };
        }
        if entry.waiting.len() < WAITING_MAX {
            entry.waiting.push(waiter);
        }
        Steps { answers: Vec::new(), fetch: entry.begin_fetch(run, now) }
    }

    /// Records an announcement. The version is fetched at once if the run is in use.
    fn announce(&mut self, run: &str, announcement: PolicyAnnouncement, now: Instant) -> Steps<W> {
        let Some(entry) = self.runs.get_mut(run) else { return Steps::default() };
        if entry.has_overtaken(announcement.version) {
            return Steps::default();
        }
        (entry.announced, entry.is_announcement_new) = (Some(announcement), true);
        let is_new = !entry.has(announcement.version);
        let is_used = now.duration_since(entry.used) < IDLE;
        Steps { answers: Vec::new(), fetch: if is_new && is_used { entry.begin_fetch(run, now) } else { None } }
    }

    /// Takes the learner's answer and answers the waiting requests.
    fn fetched(&mut self, run: &str, fetched: Option<FetchedPolicy>, now: Instant) -> Steps<W> {
        let Some(entry) = self.runs.get_mut(run) else { return Steps::default() };
        let is_answered = match fetched {
            Some(FetchedPolicy::Newer(bundle)) => entry.store(run, *bundle),
            Some(FetchedPolicy::Unchanged) => entry.cached.is_some(),
            None => false,
        };
        if !is_answered {
            // Without an answer they ask the learner themselves.
            (entry.waiting, entry.fetches) = (Vec::new(), 0);
            if entry.cached.is_none() {
                self.runs.remove(run);
            }
            return Steps::default();
        }
        entry.checked = Some(now);
        if !entry.is_announcement_new {
            entry.announced = None;
        }
        // An announcement that came during the fetch may be newer than what was fetched.
        let is_outdated = entry.announced.is_some_and(|announced| !entry.has(announced.version));
        if is_outdated && entry.fetches < FETCHES_MAX {
            let fetches = std::mem::take(&mut entry.fetches);
            let fetch = entry.begin_fetch(run, now);
            entry.fetches += fetches;
            return Steps { answers: Vec::new(), fetch };
        }
        entry.fetches = 0;
        let policy = entry.cached.as_ref().map(|cached| cached.policy.clone());
        let waiting = std::mem::take(&mut entry.waiting);
        let answers = waiting.into_iter().filter_map(|waiter| Some((waiter, policy.clone()?))).collect();
        Steps { answers, fetch: None }
    }

    /// Asks the learner before any policy is handed out again.
    fn distrust(&mut self) {
        self.runs.values_mut().for_each(|entry| entry.checked = None);
    }

    /// Returns the entry of a run. If all are in use, returns `None` for another run.
    fn entry(&mut self, run: &str, now: Instant) -> Option<&mut CachedRun<W>> {
        if !self.runs.contains_key(run) {
            let is_idle = |entry: &CachedRun<W>| entry.fetches == 0 && now.duration_since(entry.used) >= IDLE;
            self.runs.retain(|_, entry| !is_idle(entry));
            if self.runs.len() >= RUNS_MAX {
                return None;
            }
            self.runs.insert(run.to_string(), CachedRun::new(now));
        }
        self.runs.get_mut(run)
    }
}

impl<W> CachedRun<W> {
    fn new(now: Instant) -> Self {
        Self {
            cached: None,
            announced: None,
            is_announcement_new: false,
            checked: None,
            used: now,
            waiting: Vec::new(),
            fetches: 0,
        }
    }

    fn version(&self) -> Option<PolicyVersion> {
        self.cached.as_ref().map(|cached| cached.policy.version)
    }

    fn has(&self, version: PolicyVersion) -> bool {
        self.version().is_some_and(|cached| cached.names_same_policy(version))
    }

    /// Returns whether a version is of a learner that another one has overtaken, as far as this router has heard.
    fn has_overtaken(&self, version: PolicyVersion) -> bool {
        let known = [self.version(), self.announced.map(|announced| announced.version)];
        version.epoch != 0 && known.into_iter().flatten().any(|known| known.epoch > version.epoch)
    }

    /// Returns whether the cached policy is the newest, as far as this router and the requester have heard.
    fn is_newest(&self, cached: &CachedPolicy, request: &PolicyRequest, now: Instant) -> bool {
        let version = cached.policy.version;
        let announced = self.announced.map(|announced| announced.version);
        let is_fresh = self.checked.is_some_and(|checked| now.duration_since(checked) < FRESH);
        let has = |other: PolicyVersion| other.names_same_policy(version) || other.is_before(version);
        let is_behind = request.known.is_some_and(|known| version.is_before(known));
        is_fresh && !is_behind && [announced, request.announced].into_iter().flatten().all(has)
    }

    /// Returns the question to the learner, unless one is under way.
    fn begin_fetch(&mut self, run: &str, now: Instant) -> Option<Fetch> {
        if self.fetches > 0 {
            return None;
        }
        (self.fetches, self.is_announcement_new) = (1, false);
        let request = match &self.cached {
            Some(CachedPolicy { policy, .. }) => PolicyRequest {
                known: Some(policy.version),
                announced: None,
                config_hash: policy.config_hash,
                offset: 0,
            },
            None => PolicyRequest::default(),
        };
        let since_checked = self.checked.map_or(ASK_INTERVAL, |checked| now.duration_since(checked));
        Some(Fetch { run: run.to_string(), request, delay: ASK_INTERVAL.saturating_sub(since_checked) })
    }

    /// Stores a fetched policy. Returns whether it passed the checks.
    fn store(&mut self, run: &str, mut bundle: PolicyBundle) -> bool {
        let agrees = self.announced.is_none_or(|announced| announced.agrees_with(&bundle));
        if self.has_overtaken(bundle.version) {
            tracing::warn!(run, epoch = bundle.version.epoch, "policy rejected: its learner was overtaken");
            return false;
        }
        if bundle.run != run || !agrees || treadmill_runtime::seeds::checksum(&[&bundle.weights]) != bundle.checksum {
            tracing::warn!(run, version = bundle.version.number, "policy rejected: wrong run or checksum");
            return false;
        }
        let cached = self.cached.as_ref().filter(|cached| cached.policy.config_hash == bundle.config_hash);
        if let Some(CachedPolicy { config: (config_toml, model_xml), .. }) = cached
            && bundle.config_toml.is_empty()
            && bundle.model_xml.is_empty()
        {
            (bundle.config_toml, bundle.model_xml) = (config_toml.clone(), model_xml.clone());
        }
        match ActorPolicy::new(&bundle) {
            Ok(policy) => {
                let config = (bundle.config_toml, bundle.model_xml);
                self.cached = Some(CachedPolicy { policy: Arc::new(policy), config });
                true
            }
            Err(error) => {
                tracing::warn!(run, %error, "policy rejected");
                false
            }
        }
    }
}

#[cfg(test)]
#[path = "cache_tests.rs"]
mod tests;
