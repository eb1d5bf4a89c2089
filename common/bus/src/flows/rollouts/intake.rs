//! Rollouts: actors submit fragments; the learner queues them and answers with receipts.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, AtomicUsize, Ordering},
        mpsc::{Receiver, SyncSender, TrySendError, sync_channel},
    },
    time::{Duration, Instant},
};

use bytes::Bytes;
use treadmill_proto::{Malformed, Outcome, PolicyVersion, Receipt, ident::check_ident, limits::FRAGMENT_BYTES_MAX};
use zenoh::{bytes::ZBytes, qos::Priority, query::Query};

use super::{
    copies::RolloutCopies,
    received::{ReceivedFragment, incarnation_of},
};
use crate::{
    admission::{Admission, AdmissionPermit, Refusal, rate_limited_log::RateLimitedLog},
    error::BusError,
    flows::{
        shared::{ask, last_part, next_valid, reply, serve, start_thread},
        watched::Watched,
    },
    session::Bus,
};

/// Bytes of fragments that may wait for the learner. Half-precision observations take twice their size in memory.
const INTAKE_BYTES_MAX: usize = 128 << 20;
/// Refusals that may wait to be sent.
const REFUSALS_QUEUE: usize = 1024;
/// Receipts that may wait to be sent: two for each actor of the largest fleet.
const RECEIPTS_QUEUE: usize = 8192;
/// Longest wait for the last receipts to be sent when the intake is closed.
const LAST_RECEIPTS_TIMEOUT: Duration = Duration::from_secs(1);
/// Stands for every invalid name. No actor can have it.
const INVALID_NAME: &str = "?";

/// Returns `treadmill/{run}/rollouts/{actor}`.
fn key(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/rollouts/{actor}")
}

/// Received fragment that waits for its receipt. If it is dropped without one, the sender gets no reply and sends again.
pub struct IncomingFragment {
    /// Sender's name, from the key.
    pub actor: String,
    received: Option<ReceivedFragment>,
    /// Payload as received, if a subscriber wants copies.
    encoded: Option<ZBytes>,
    bytes: usize,
    query: Query,
    receipts: ReceiptQueue,
    queued_bytes: Arc<AtomicUsize>,
    permit: Option<AdmissionPermit>,
}

impl IncomingFragment {
    /// Queues the receipt, which frees the sender's credit; never waits. A sender without a receipt sends the fragment
    /// again.
    pub fn answer(self, receipt: &Receipt) {
        self.receipts.offer(self.query.clone(), receipt);
    }

    /// Returns the policy version that the fragment names, unless it was taken or cannot be decoded.
    pub fn version(&self) -> Option<PolicyVersion> {
        self.received.as_ref()?.fragment.as_ref().ok().map(|fragment| fragment.version)
    }

    /// Takes the fragment, once, and frees its place in the queue. The receipt is still owed.
    pub fn take(&mut self) -> Option<ReceivedFragment> {
        self.free_bytes();
        self.permit = None;
        self.received.take()
    }

    /// Passes on the payload if a subscriber wanted copies when it arrived; never waits.
    pub fn copy_to(&mut self, copies: &RolloutCopies) {
        if let Some(encoded) = self.encoded.take() {
            copies.offer(&self.actor, encoded);
        }
    }

    fn free_bytes(&mut self) {
        self.queued_bytes.fetch_sub(std::mem::take(&mut self.bytes), Ordering::Relaxed);
    }
}

impl Drop for IncomingFragment {
    fn drop(&mut self) {
        self.free_bytes();
    }
}

/// Bounded queue of fragments on their way into the learner.
pub struct RolloutIntake {
    queue: Receiver<IncomingFragment>,
    receipts: ReceiptQueue,
    shared: Arc<AtomicU64>,
}

impl RolloutIntake {
    /// Starts to receive the fragments that `admission` admits. At most `capacity` wait; further ones are refused as *busy*.
    /// While `copies` has a subscriber, payloads are kept for it.
    pub fn open(
        bus: &Bus,
        run: &str,
        capacity: usize,
        admission: Arc<Admission>,
        copies: &RolloutCopies,
    ) -> Result<Self, BusError> {
        let (sender, queue) = sync_channel(capacity);
        let shared = Arc::new(AtomicU64::new(0));
        let (receipts, send_receipts) = ReceiptQueue::bounded(RECEIPTS_QUEUE);
        start_thread("receipts", send_receipts)?;
        let (refusals, send_refusals) = ReceiptQueue::bounded(REFUSALS_QUEUE);
        start_thread("refusals", send_refusals)?;
        let receiver = RolloutReceiver {
            admission,
            queue: sender,
            queued_bytes: Arc::default(),
            shared: shared.clone(),
            watched: copies.watched(),
            receipts: receipts.clone(),
            refusals,
            rejection_log: RateLimitedLog::default(),
            quarantine_log: RateLimitedLog::default(),
        };
        serve(bus, key(run, "*"), "taking rollouts", move |query| receiver.receive(query))?;
        Ok(Self { queue, receipts, shared })
    }

    /// Returns the counter of fragments that came through shared memory.
    pub fn shared(&self) -> Arc<AtomicU64> {
        self.shared.clone()
    }

    /// Returns the next fragment, or `None` if none comes within `timeout` or the bus is closed.
    pub fn next(&self, timeout: Duration) -> Option<IncomingFragment> {
        self.queue.recv_timeout(timeout).ok()
    }
}

impl Drop for RolloutIntake {
    /// Waits until the last receipts are sent, because the session may be closed next.
    fn drop(&mut self) {
        self.receipts.flush(LAST_RECEIPTS_TIMEOUT);
    }
}

/// Receives fragments in the bus's threads.
struct RolloutReceiver {
    admission: Arc<Admission>,
    queue: SyncSender<IncomingFragment>,
    queued_bytes: Arc<AtomicUsize>,
    shared: Arc<AtomicU64>,
    watched: Watched,
    receipts: ReceiptQueue,
    /// Separate, so that a flood of refusals takes no place of receipts.
    refusals: ReceiptQueue,
    rejection_log: RateLimitedLog,
    quarantine_log: RateLimitedLog,
}

impl RolloutReceiver {
    /// Checks admission, name, size and space, then decodes the fragment and queues it. It decodes here because the bus has
    /// several receiving threads and the learner's thread has other work.
    fn receive(&self, mut query: Query) {
        // Taken out of the query, which lives until it is answered, so that the bus's buffers are free at once.
        let payload = query.payload_mut().map(std::mem::take).unwrap_or_default();
        let sent_on = query.key_expr().clone();
        let named = check_ident("actor", last_part(sent_on.as_str()));
        let actor = if named.is_ok() { last_part(sent_on.as_str()) } else { INVALID_NAME };
        let size = payload.len();
        let permit = match self.admission.admit(actor, incarnation_of(&payload), size, Instant::now()) {
            Ok(permit) => permit,
            Err(refusal) => return self.refuse_unadmitted(query, actor, refusal),
        };
        if let Some(reason) = unreadable(named, size) {
            self.rejection_log.emit(|| tracing::warn!(%actor, error = %reason, "fragment rejected"));
            if self.admission.record_malformed_unread(permit.sender(), Instant::now()) {
                self.quarantine_log.emit(|| tracing::warn!(%actor, "sender quarantined"));
            }
            return self.refuse(query, Outcome::Malformed, reason);
        }
        if self.queued_bytes.fetch_add(size, Ordering::Relaxed) + size > INTAKE_BYTES_MAX {
            self.queued_bytes.fetch_sub(size, Ordering::Relaxed);
            return self.refuse(query, Outcome::Busy, format!("{INTAKE_BYTES_MAX} bytes of fragments wait already"));
        }
        let incoming = IncomingFragment {
            actor: actor.to_string(),
            received: Some(ReceivedFragment::read(&payload, &self.shared)),
            encoded: self.watched.now().then_some(payload),
            bytes: size,
            query,
            receipts: self.receipts.clone(),
            queued_bytes: self.queued_bytes.clone(),
            permit: Some(permit),
        };
        // After the intake was closed there is no reply, as from no learner.
        if let Err(TrySendError::Full(incoming)) = self.queue.try_send(incoming) {
            self.refuse(incoming.query.clone(), Outcome::Busy, "the intake is full".to_string());
        }
    }

    fn refuse_unadmitted(&self, query: Query, actor: &str, refusal: Refusal) {
        match refusal {
            Refusal::Quarantined => {
                self.refuse(query, Outcome::Quarantined, format!("`{actor}` is in quarantine for up to 60 s"));
            }
            Refusal::Busy => self.refuse(query, Outcome::Busy, format!("too many fragments of `{actor}` wait already")),
            Refusal::Flood => {
                self.rejection_log.emit(|| tracing::warn!("unproven senders exceed their rate; fragments ignored"));
            }
        }
    }

    /// Queues a refusal. If too many wait there is no reply, and the sender sends again.
    fn refuse(&self, query: Query, outcome: Outcome, reason: String) {
        let receipt =
            Receipt { outcome, reason, version: PolicyVersion::default(), durable_through: 0, fragment_steps: 0 };
        self.refusals.offer(query, &receipt);
    }
}

/// Returns why a fragment need not be decoded: its sender's name or its size is invalid.
fn unreadable(named: Result<(), Malformed>, size: usize) -> Option<String> {
    match named {
        Err(error) => Some(error.to_string()),
        Ok(()) if size == 0 || size > FRAGMENT_BYTES_MAX => {
            Some(format!("the payload has {size} bytes; a fragment has 1 to {FRAGMENT_BYTES_MAX}"))
        }
        Ok(()) => None,
    }
}

/// Queue of a thread that sends receipts, so that no other thread waits for a link.
#[derive(Clone)]
struct ReceiptQueue(SyncSender<Outgoing>);

enum Outgoing {
    Receipt(Query, Vec<u8>),
    /// Everything queued before was sent.
    Flush(SyncSender<()>),
}

impl ReceiptQueue {
    /// Returns the queue and the work of its thread, which ends when every clone of the queue is dropped.
    fn bounded(capacity: usize) -> (Self, impl FnOnce() + Send + use<>) {
        let (sender, queue) = sync_channel(capacity);
        let send = move || {
            for outgoing in queue {
                match outgoing {
                    Outgoing::Receipt(query, receipt) => reply(&query, receipt, "receipt"),
                    Outgoing::Flush(done) => drop(done.try_send(())),
                }
            }
        };
        (Self(sender), send)
    }

    /// Queues a receipt, or drops it if the queue is full.
    fn offer(&self, query: Query, receipt: &Receipt) {
        drop(self.0.try_send(Outgoing::Receipt(query, receipt.encode())));
    }

    fn flush(&self, timeout: Duration) {
        let (done, is_done) = sync_channel(1);
        if self.0.try_send(Outgoing::Flush(done)).is_ok() {
            let _ = is_done.recv_timeout(timeout);
        }
    }
}

/// Sends one encoded fragment and waits for a receipt that `settles` it, as a learner that was overtaken may answer
/// beside its successor. Without one, returns the last receipt. `None` if no receipt came: the fragment may have
/// arrived or not.
pub async fn submit(
    bus: &Bus,
    run: &str,
    actor: &str,
    fragment: Bytes,
    timeout: Duration,
    settles: impl Fn(&Receipt) -> bool,
) -> Result<Option<Receipt>, BusError> {
    let replies = ask(bus, key(run, actor), fragment, timeout, Priority::Data, "sending a fragment")?;
    let mut last = None;
    while let Some(receipt) = next_valid(&replies, "receipt", |payload| Receipt::decode(&payload)).await {
        if settles(&receipt) {
            return Ok(Some(receipt));
        }
        last = Some(receipt);
    }
    Ok(last)
}
