//! What the learner declares: the intake of rollouts, the shelf of policies, who is alive, statistics.

use std::{
    collections::{BTreeSet, HashMap},
    sync::{
        Arc, Mutex, RwLock,
        atomic::{AtomicU64, AtomicUsize, Ordering},
        mpsc::{Receiver, SyncSender, TrySendError, sync_channel},
    },
    time::Duration,
};

use bytes::Bytes;
use treadmill_proto::{
    ActorStats, Outcome, PolicyAnnouncement, PolicyVersion, Receipt, ident::check_ident, limits::FRAGMENT_BYTES_MAX,
};
use zenoh::{
    Wait,
    bytes::ZBytes,
    handlers::RingChannel,
    liveliness::LivelinessToken,
    pubsub::{Publisher, Subscriber},
    qos::{CongestionControl, Priority},
    query::{Query, Queryable},
    sample::{Sample, SampleKind},
};

use super::{Bus, BusError, keys};

/// Bytes of fragments that may wait for the learner, whatever their number.
const INTAKE_BYTES_MAX: usize = 128 << 20;
/// A payload in one piece that is smaller than this came over a socket, and would keep a whole buffer of the bus.
const IN_PLACE_BYTES_MIN: usize = 64 << 10;
/// Answers that may wait to be sent to those whose fragments were not taken.
const REFUSALS_QUEUE: usize = 1024;
/// Policy requests that may wait for the shelf's thread.
const SHELF_QUEUE: usize = 4096;
/// Statistics messages that may wait; older ones give way.
const STATS_RING: usize = 1024;

/// A fragment that waits for its receipt. Dropped without one, the sender gets no reply and sends again.
pub struct Delivery {
    /// Who sent it, from the key.
    pub actor: String,
    /// The encoded fragment.
    pub payload: Bytes,
    query: Query,
    queued_bytes: Arc<AtomicUsize>,
}

impl Delivery {
    /// Answers, which gives the sender its credit back.
    pub fn answer(self, receipt: &Receipt) {
        reply(&self.query, receipt);
    }

    /// Lets go of the payload once it is decoded; the answer is still owed.
    pub fn release_payload(&mut self) {
        self.queued_bytes.fetch_sub(self.payload.len(), Ordering::Relaxed);
        self.payload = Bytes::new();
    }
}

impl Drop for Delivery {
    fn drop(&mut self) {
        self.queued_bytes.fetch_sub(self.payload.len(), Ordering::Relaxed);
    }
}

fn reply(query: &Query, receipt: &Receipt) {
    if let Err(why) = query.reply(query.key_expr().clone(), receipt.encode()).wait() {
        // The sender went away or lost its link: it will send again, and the ledger knows the fragment.
        tracing::debug!("a receipt could not be sent: {why}");
    }
}

/// The bounded queue of fragments on their way into the learner.
pub struct RolloutIntake {
    queue: Receiver<Delivery>,
    in_place: Arc<AtomicU64>,
    _queryable: Queryable<()>,
}

impl RolloutIntake {
    /// Begins to take fragments; at most `capacity` wait, the rest is told to come again.
    pub fn open(bus: &Bus, run: &str, capacity: usize) -> Result<Self, BusError> {
        let (sender, queue) = sync_channel(capacity);
        let in_place = Arc::new(AtomicU64::new(0));
        let door = Door {
            queue: sender,
            queued_bytes: Arc::new(AtomicUsize::new(0)),
            in_place: in_place.clone(),
            refusals: refusals()?,
        };
        let queryable = bus
            .session
            .declare_queryable(keys::rollouts(run, "*"))
            .callback(move |query| door.take(query))
            .wait()
            .map_err(BusError::flow("taking rollouts"))?;
        Ok(Self { queue, in_place, _queryable: queryable })
    }

    /// Counts the fragments that came through shared memory.
    pub fn in_place(&self) -> Arc<AtomicU64> {
        self.in_place.clone()
    }

    /// The next fragment, if one comes within `patience`.
    pub fn next(&self, patience: Duration) -> Option<Delivery> {
        // An empty queue and one that nobody fills any more are the same to whoever waits.
        self.queue.recv_timeout(patience).ok()
    }
}

/// Where the bus's receiving thread puts what came.
struct Door {
    queue: SyncSender<Delivery>,
    queued_bytes: Arc<AtomicUsize>,
    in_place: Arc<AtomicU64>,
    refusals: SyncSender<(Query, Receipt)>,
}

impl Door {
    /// Runs in the bus's receiving thread: checks the header, hands over, returns.
    fn take(&self, mut query: Query) {
        // Out of the query, which lives until it is answered: the bus's own buffers are free again at once.
        let payload = query.payload_mut().map(std::mem::take).unwrap_or_default();
        let (size, actor) = (payload.len(), keys::last_part(query.key_expr().as_str()).to_string());
        if let Err(why) = check_ident("actor", &actor) {
            return self.refuse(query, Outcome::Malformed, why.to_string());
        }
        if size == 0 || size > FRAGMENT_BYTES_MAX {
            let reason = format!("the payload has {size} bytes; a fragment has 1 to {FRAGMENT_BYTES_MAX}");
            return self.refuse(query, Outcome::Malformed, reason);
        }
        if self.queued_bytes.fetch_add(size, Ordering::Relaxed) + size > INTAKE_BYTES_MAX {
            self.queued_bytes.fetch_sub(size, Ordering::Relaxed);
            return self.refuse(query, Outcome::Busy, format!("{INTAKE_BYTES_MAX} bytes of fragments wait already"));
        }
        let payload = whole(payload, &self.in_place);
        let delivery = Delivery { actor, payload, query, queued_bytes: self.queued_bytes.clone() };
        if let Err(TrySendError::Full(delivery) | TrySendError::Disconnected(delivery)) = self.queue.try_send(delivery)
        {
            self.refuse(delivery.query.clone(), Outcome::Busy, "the intake is full".to_string());
        }
    }

    /// Answers from another thread: a sender that does not read its answers must not hold up what others send. Where too
    /// many wait, there is no answer, and the sender comes again.
    fn refuse(&self, query: Query, outcome: Outcome, reason: String) {
        let receipt = Receipt { outcome, reason, version: PolicyVersion::default(), durable_through: 0 };
        drop(self.refusals.try_send((query, receipt)));
    }
}

/// A thread that answers what was not taken; it ends with the sender that is returned.
fn refusals() -> Result<SyncSender<(Query, Receipt)>, BusError> {
    let (sender, refusals) = sync_channel::<(Query, Receipt)>(REFUSALS_QUEUE);
    std::thread::Builder::new()
        .name("refusals".to_string())
        .spawn(move || refusals.iter().for_each(|(query, receipt)| reply(&query, &receipt)))
        .map_err(|why| BusError::Flow { what: "starting to answer".to_string(), why: why.to_string() })?;
    Ok(sender)
}

/// A payload in one piece. What came over a socket lies in many small buffers of the bus and is copied; what lies in shared
/// memory stays there until it is decoded.
fn whole(payload: ZBytes, in_place: &AtomicU64) -> Bytes {
    struct InPlace(ZBytes);
    impl AsRef<[u8]> for InPlace {
        fn as_ref(&self) -> &[u8] {
            self.0.slices().next().unwrap_or_default()
        }
    }
    if payload.len() >= IN_PLACE_BYTES_MIN && payload.slices().nth(1).is_none() {
        in_place.fetch_add(1, Ordering::Relaxed);
        return Bytes::from_owner(InPlace(payload));
    }
    Bytes::from(payload.to_bytes().into_owned())
}

/// Serves the newest policy bundle and announces it.
pub struct PolicyShelf {
    current: Arc<RwLock<Bytes>>,
    announcer: Publisher<'static>,
    _queryable: Queryable<()>,
}

impl PolicyShelf {
    /// Opens the shelf with its first bundle.
    pub fn open(bus: &Bus, run: &str, bundle: Bytes) -> Result<Self, BusError> {
        let current = Arc::new(RwLock::new(bundle));
        let (sender, requests) = sync_channel::<Query>(SHELF_QUEUE);
        let key = keys::policy_latest(run);
        std::thread::Builder::new()
            .name("policy-shelf".to_string())
            .spawn({
                let (current, key) = (current.clone(), key.clone());
                move || {
                    for query in requests {
                        let bundle = current.read().expect("no holder of this lock panics").clone();
                        // The answer names the run also where the question left it open.
                        let answer = query.reply(key.clone(), bundle);
                        if let Err(why) = answer.wait() {
                            tracing::debug!("a policy bundle could not be sent: {why}");
                        }
                    }
                }
            })
            .map_err(|why| BusError::Flow { what: "starting the policy shelf".to_string(), why: why.to_string() })?;
        let queryable = bus
            .session
            .declare_queryable(key)
            // A request that finds the queue full gets no reply, and its actor asks again.
            .callback(move |query| drop(sender.try_send(query)))
            .wait()
            .map_err(BusError::flow("serving policies"))?;
        let announcer = bus
            .session
            .declare_publisher(keys::policy_version(run))
            .congestion_control(CongestionControl::Drop)
            .priority(Priority::DataHigh)
            .wait()
            .map_err(BusError::flow("declaring the announcement"))?;
        Ok(Self { current, announcer, _queryable: queryable })
    }

    /// Puts a new bundle on the shelf, then tells everybody.
    pub fn publish(&self, bundle: Bytes, announcement: &PolicyAnnouncement) {
        *self.current.write().expect("no holder of this lock panics") = bundle;
        if let Err(why) = self.announcer.put(announcement.encode()).wait() {
            // Actors also hear of it from receipts, and look by themselves now and then.
            tracing::debug!("a policy announcement could not be sent: {why}");
        }
    }
}

/// Who is alive, by liveliness token.
pub struct Alive {
    actors: Arc<Mutex<BTreeSet<String>>>,
    _subscriber: Subscriber<()>,
    _token: LivelinessToken,
}

impl Alive {
    /// Shows the learner's own token and begins to watch those of actors.
    pub fn watch(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let actors = Arc::new(Mutex::new(BTreeSet::new()));
        let subscriber = bus
            .session
            .liveliness()
            .declare_subscriber(keys::actor(run, "*"))
            .history(true)
            .callback({
                let actors = actors.clone();
                move |sample: Sample| {
                    let actor = keys::last_part(sample.key_expr().as_str()).to_string();
                    let mut actors = actors.lock().expect("no holder of this lock panics");
                    match sample.kind() {
                        SampleKind::Put => actors.insert(actor),
                        SampleKind::Delete => actors.remove(&actor),
                    };
                }
            })
            .wait()
            .map_err(BusError::flow("watching actors"))?;
        let token = bus
            .session
            .liveliness()
            .declare_token(keys::learner(run))
            .wait()
            .map_err(BusError::flow("declaring the learner's token"))?;
        Ok(Self { actors, _subscriber: subscriber, _token: token })
    }

    /// Lets another thread look, too.
    pub fn view(&self) -> AliveView {
        AliveView { actors: self.actors.clone() }
    }

    /// Names of the actors that are alive.
    pub fn actors(&self) -> BTreeSet<String> {
        self.actors.lock().expect("no holder of this lock panics").clone()
    }
}

/// Who is alive, as another thread sees it.
#[derive(Clone)]
pub struct AliveView {
    actors: Arc<Mutex<BTreeSet<String>>>,
}

impl AliveView {
    /// Names of the actors that are alive.
    pub fn actors(&self) -> BTreeSet<String> {
        self.actors.lock().expect("no holder of this lock panics").clone()
    }
}

/// The newest statistics of each actor.
pub struct StatsFeed {
    ring: Subscriber<zenoh::handlers::RingChannelHandler<Sample>>,
    newest: HashMap<String, ActorStats>,
    run: String,
}

impl StatsFeed {
    /// Begins to listen.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let ring = bus
            .session
            .declare_subscriber(keys::stats(run, "*"))
            .with(RingChannel::new(STATS_RING))
            .wait()
            .map_err(BusError::flow("listening to statistics"))?;
        Ok(Self { ring, newest: HashMap::new(), run: run.to_string() })
    }

    /// The next statistics, if some come within `patience`, on the key of whoever they are about.
    pub fn next(&self, patience: Duration) -> Option<ActorStats> {
        let sample = self.ring.recv_timeout(patience).ok().flatten()?;
        let stats = ActorStats::decode_checked(&sample.payload().to_bytes()).ok()?;
        (sample.key_expr().as_str() == keys::stats(&self.run, &stats.actor)).then_some(stats)
    }

    /// Takes what came and forgets who is gone.
    pub fn newest(&mut self, alive: &BTreeSet<String>) -> &HashMap<String, ActorStats> {
        while let Ok(Some(sample)) = self.ring.try_recv() {
            match ActorStats::decode_checked(&sample.payload().to_bytes()) {
                Ok(stats) => drop(self.newest.insert(stats.actor.clone(), stats)),
                Err(why) => tracing::debug!("statistics refused: {why}"),
            }
        }
        self.newest.retain(|actor, _| alive.contains(actor));
        &self.newest
    }
}
