//! Rollouts: the learner's bounded queue of received fragments, and their receipts.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering},
        mpsc::{Receiver, SyncSender, TrySendError, sync_channel},
    },
    time::{Duration, Instant},
};

use treadmill_proto::{Outcome, PolicyVersion, Receipt, ident::check_ident, limits::FRAGMENT_BYTES_MAX};
use zenoh::{
    Wait,
    bytes::ZBytes,
    query::{Query, Queryable},
};

use super::received::claimed;
use crate::{
    Bus, BusError, ReceivedFragment, RolloutCopies,
    admission::{Admission, AdmissionPermit, Refusal, rate_limited_log::RateLimitedLog, read_throttle::ReadThrottle},
    keys,
};

/// Bytes of fragments that may wait for the learner, whatever their number. In memory observations that came in half
/// precision take twice theirs.
const INTAKE_BYTES_MAX: usize = 128 << 20;
/// Answers that may wait to be sent to those whose fragments were not taken.
const REFUSALS_QUEUE: usize = 1024;
/// Rate of fragments refused unread above which the link is throttled.
const REFUSALS_PER_S: f64 = 100.0;
/// Stands for every name that is none. No actor can be called that.
const NO_NAME: &str = "?";

/// A fragment that waits for its receipt. Dropped without one, the sender gets no reply and sends again.
pub struct IncomingFragment {
    /// Who sent it, from the key.
    pub actor: String,
    received: Option<ReceivedFragment>,
    /// As it came, where somebody wants copies.
    encoded: Option<ZBytes>,
    bytes: usize,
    query: Query,
    queued_bytes: Arc<AtomicUsize>,
    /// Room in the queue.
    permit: Option<AdmissionPermit>,
}

impl IncomingFragment {
    /// Answers, which gives the sender its credit back.
    pub fn answer(self, receipt: &Receipt) {
        reply(&self.query, receipt);
    }

    /// The fragment, once, which does not count as waiting any more; the answer is still owed.
    pub fn take(&mut self) -> Option<ReceivedFragment> {
        self.leave();
        self.permit = None;
        self.received.take()
    }

    /// Hands on the fragment as it came, if somebody wanted copies when it did; never waits.
    pub fn copy_to(&mut self, copies: &RolloutCopies) {
        if let Some(encoded) = self.encoded.take() {
            copies.offer(&self.actor, encoded);
        }
    }

    fn leave(&mut self) {
        self.queued_bytes.fetch_sub(std::mem::take(&mut self.bytes), Ordering::Relaxed);
    }
}

impl Drop for IncomingFragment {
    fn drop(&mut self) {
        self.leave();
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
    queue: Receiver<IncomingFragment>,
    shared: Arc<AtomicU64>,
    _queryable: Queryable<()>,
}

impl RolloutIntake {
    /// Begins to take fragments from whom `admission` lets in; at most `capacity` wait, the rest is told to come again. While
    /// somebody wants `copies`, fragments are also kept as they came.
    pub fn open(
        bus: &Bus,
        run: &str,
        capacity: usize,
        admission: Arc<Admission>,
        copies: &RolloutCopies,
    ) -> Result<Self, BusError> {
        let (sender, queue) = sync_channel(capacity);
        let (shared, is_watched) = (Arc::new(AtomicU64::new(0)), copies.watch());
        let receiver = RolloutReceiver {
            admission,
            queue: sender,
            queued_bytes: Arc::default(),
            shared: shared.clone(),
            is_watched,
            answers: refusals()?,
            refusals: RateLimitedLog::default(),
            quarantines: RateLimitedLog::default(),
            throttle: ReadThrottle::new(REFUSALS_PER_S),
        };
        let queryable = bus
            .session
            .declare_queryable(keys::rollouts(run, "*"))
            .callback(move |query| receiver.take(query))
            .wait()
            .map_err(BusError::flow("taking rollouts"))?;
        Ok(Self { queue, shared, _queryable: queryable })
    }

    /// Counts the fragments that came through shared memory.
    pub fn shared(&self) -> Arc<AtomicU64> {
        self.shared.clone()
    }

    /// The next fragment, if one comes within `patience`.
    pub fn next(&self, patience: Duration) -> Option<IncomingFragment> {
        // An empty queue and one that nobody fills any more are the same to whoever waits.
        self.queue.recv_timeout(patience).ok()
    }
}

/// Where fragments come in.
struct RolloutReceiver {
    admission: Arc<Admission>,
    queue: SyncSender<IncomingFragment>,
    queued_bytes: Arc<AtomicUsize>,
    shared: Arc<AtomicU64>,
    is_watched: Arc<AtomicBool>,
    answers: SyncSender<(Query, Receipt)>,
    refusals: RateLimitedLog,
    quarantines: RateLimitedLog,
    throttle: ReadThrottle,
}

impl RolloutReceiver {
    /// Runs in the bus's receiving thread: looks at name, size and first bytes, and whether there is room, before it reads the
    /// fragment and hands it over. It is read here because here are several threads, and the learner's has other work.
    fn take(&self, mut query: Query) {
        // Out of the query, which lives until it is answered: the bus's own buffers are free again at once.
        let payload = query.payload_mut().map(std::mem::take).unwrap_or_default();
        let key = query.key_expr().clone();
        let named = check_ident("actor", keys::last_part(key.as_str()));
        let actor = if named.is_ok() { keys::last_part(key.as_str()) } else { NO_NAME };
        let size = payload.len();
        let permit = match self.admission.admit(actor, claimed(&payload), size, Instant::now()) {
            Ok(permit) => permit,
            Err(Refusal::Quarantined) => {
                let reason = format!("too many refused fragments in a row from `{actor}`; wait a minute");
                return self.refuse(query, Outcome::Quarantined, reason);
            }
            Err(Refusal::Busy) => {
                let reason = format!("as many fragments of `{actor}` as may wait do so already");
                return self.refuse(query, Outcome::Busy, reason);
            }
            Err(Refusal::Flood) => {
                self.throttle.pass();
                return self.refusals.warn(|| {
                    "senders that have delivered nothing yet send more fragments than are looked at".to_string()
                });
            }
        };
        let wrong = match named {
            Err(why) => Some(why.to_string()),
            Ok(()) if size == 0 || size > FRAGMENT_BYTES_MAX => {
                Some(format!("the payload has {size} bytes; a fragment has 1 to {FRAGMENT_BYTES_MAX}"))
            }
            Ok(()) => None,
        };
        if let Some(why) = wrong {
            self.refusals.warn(|| format!("a fragment from `{actor}` was refused: {why}"));
            if self.admission.failed_unread(permit.sender(), Instant::now()) {
                self.quarantines.warn(|| format!("`{actor}` is put in quarantine"));
            }
            return self.refuse(query, Outcome::Malformed, why);
        }
        if self.queued_bytes.fetch_add(size, Ordering::Relaxed) + size > INTAKE_BYTES_MAX {
            self.queued_bytes.fetch_sub(size, Ordering::Relaxed);
            return self.refuse(query, Outcome::Busy, format!("{INTAKE_BYTES_MAX} bytes of fragments wait already"));
        }
        let received = ReceivedFragment::read(&payload, &self.shared);
        let delivery = IncomingFragment {
            actor: actor.to_string(),
            received: Some(received),
            encoded: self.is_watched.load(Ordering::Relaxed).then_some(payload),
            bytes: size,
            query,
            queued_bytes: self.queued_bytes.clone(),
            permit: Some(permit),
        };
        if let Err(TrySendError::Full(delivery) | TrySendError::Disconnected(delivery)) = self.queue.try_send(delivery)
        {
            self.refuse(delivery.query.clone(), Outcome::Busy, "the intake is full".to_string());
        }
    }

    /// Answers from another thread: a sender that does not read its answers must not hold up what others send. Where too
    /// many wait, there is no answer, and the sender comes again.
    fn refuse(&self, query: Query, outcome: Outcome, reason: String) {
        self.throttle.pass();
        let receipt = Receipt { outcome, reason, version: PolicyVersion::default(), durable_through: 0 };
        drop(self.answers.try_send((query, receipt)));
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
