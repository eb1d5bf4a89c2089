//! Serves policies to actors, piece by piece, as a learner and as a router.
//!
//! A piece fits into one batch of the bus, and a requester asks for few at a time. So a server thread never waits: where a
//! requester does not read, the bus drops its pieces ([`crate::session`]), and all others get theirs.

use std::sync::{
    Arc, Mutex,
    atomic::{AtomicU64, Ordering},
    mpsc::{Receiver, SyncSender, sync_channel},
};

use bytes::Bytes;
use treadmill_proto::{Malformed, PolicyBundle, PolicyPiece, PolicyRequest, PolicyVersion};
use zenoh::{bytes::ZBytes, query::Query};

use crate::{
    error::BusError,
    flows::shared::{reply, reply_on, start_thread},
};

/// Requests that may wait for a thread. Further ones get no reply, and their actors ask again.
const QUEUE: usize = 4096;
/// Threads that send pieces.
const THREADS: usize = 2;

/// Returns the key of the newest policy for actors, from the learner.
pub(super) fn key(run: &str) -> String {
    format!("treadmill/{run}/policy/pieces")
}

/// Returns the key of the same from the learner or router with the Zenoh ID `node`.
pub(super) fn key_of(run: &str, node: &str) -> String {
    format!("treadmill/{run}/policy/pieces/{node}")
}

/// Newest policy as actors get it: without the critic.
#[derive(Debug)]
pub(super) struct ActorPolicy {
    pub(super) run: String,
    pub(super) version: PolicyVersion,
    pub(super) config_hash: u64,
    /// Encoded with configuration and model, for actors that join.
    pub(super) for_joining: Bytes,
    /// Encoded without them, for actors with the same configuration.
    update: Bytes,
}

impl ActorPolicy {
    /// Encodes a bundle that has configuration and model, and the weights of the actor only.
    pub(super) fn new(bundle: &PolicyBundle) -> Result<Self, Malformed> {
        Ok(Self {
            run: bundle.run.clone(),
            version: bundle.version,
            config_hash: bundle.config_hash,
            for_joining: bundle.encode()?.into(),
            update: bundle.without_config().encode()?.into(),
        })
    }

    /// Returns the piece that a requester gets.
    pub(super) fn piece(&self, request: &PolicyRequest) -> PolicyPiece {
        if request.known.is_some_and(|known| known.names_same_policy(self.version)) {
            return PolicyPiece::unchanged(&self.run, self.version);
        }
        let bundle = if request.config_hash == self.config_hash { &self.update } else { &self.for_joining };
        PolicyPiece::cut(&self.run, self.version, bundle, request.offset)
    }
}

/// Counts of replies to actors and routers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ServedPolicies {
    /// Policies whose first piece was sent.
    pub policies: u64,
    /// Replies to requesters that had the newest version.
    pub unchanged: u64,
    /// Bytes of all replies.
    pub bytes: u64,
}

/// Request that waits for its piece.
pub(super) struct PieceReply {
    query: Query,
    pub(super) request: PolicyRequest,
}

impl PieceReply {
    /// Reads the request in a query. An invalid one gets no reply.
    pub(super) fn read(query: Query) -> Option<Self> {
        let payload = query.payload().map(ZBytes::to_bytes).unwrap_or_default();
        match PolicyRequest::decode(&payload) {
            Ok(request) => Some(Self { request, query }),
            Err(error) => {
                tracing::debug!(%error, "policy request rejected");
                None
            }
        }
    }
}

/// Threads that send pieces.
#[derive(Clone)]
pub(super) struct PieceServer {
    queue: SyncSender<(PieceReply, Arc<ActorPolicy>)>,
    counters: Arc<Counters>,
}

#[derive(Default)]
struct Counters {
    policies: AtomicU64,
    unchanged: AtomicU64,
    bytes: AtomicU64,
}

impl PieceServer {
    /// Starts the threads. They end when every clone of the server is dropped.
    pub(super) fn start() -> Result<Self, BusError> {
        let (queue, requests) = sync_channel(QUEUE);
        let (requests, counters) = (Arc::new(Mutex::new(requests)), Arc::<Counters>::default());
        for number in 0..THREADS {
            let (requests, counters) = (requests.clone(), counters.clone());
            start_thread(&format!("policy-pieces-{number}"), move || send_pieces(&requests, &counters))?;
        }
        Ok(Self { queue, counters })
    }

    /// Queues a reply, or drops the request if too many wait.
    pub(super) fn send(&self, reply: PieceReply, policy: Arc<ActorPolicy>) {
        drop(self.queue.try_send((reply, policy)));
    }

    pub(super) fn served(&self) -> ServedPolicies {
        let Counters { policies, unchanged, bytes } = &*self.counters;
        let [policies, unchanged, bytes] = [policies, unchanged, bytes].map(|counter| counter.load(Ordering::Relaxed));
        ServedPolicies { policies, unchanged, bytes }
    }
}

fn send_pieces(requests: &Mutex<Receiver<(PieceReply, Arc<ActorPolicy>)>>, counters: &Counters) {
    loop {
        // The lock is held only while waiting for a request, not while replying.
        let next = requests.lock().expect("no holder of this lock panics").recv();
        let Ok((PieceReply { query, request }, policy)) = next else { return };
        let piece = policy.piece(&request);
        let encoded = piece.encode();
        counters.bytes.fetch_add(encoded.len() as u64, Ordering::Relaxed);
        if piece.is_unchanged() {
            counters.unchanged.fetch_add(1, Ordering::Relaxed);
        } else if piece.offset == 0 {
            counters.policies.fetch_add(1, Ordering::Relaxed);
            tracing::debug!(run = policy.run, version = policy.version.number, "policy served");
        }
        // The reply's key names the run even if the request did not.
        match query.key_expr().is_wild() {
            true => reply_on(&query, &key(&policy.run), encoded, "piece of a policy"),
            false => reply(&query, encoded, "piece of a policy"),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) const VERSION: PolicyVersion = PolicyVersion::new(7, 3);

    pub(crate) fn bundle(version: PolicyVersion) -> PolicyBundle {
        let weights = Bytes::from(vec![version.number as u8; 100_000]);
        PolicyBundle {
            run: "walk".into(),
            version,
            observation_size: 1,
            action_size: 1,
            hidden: vec![1],
            checksum: treadmill_runtime::seeds::checksum(&[&weights]),
            weights,
            observation_mean: vec![0.0],
            observation_inverse_std: vec![1.0],
            observation_clip: 10.0,
            config_hash: 9,
            config_toml: "[run]".into(),
            model_xml: "<mujoco/>".into(),
            ..PolicyBundle::default()
        }
    }

    #[test]
    fn a_reply_holds_what_the_requester_lacks() {
        let policy = ActorPolicy::new(&bundle(VERSION)).unwrap();
        let older = Some(PolicyVersion { number: 2, ..VERSION });
        let total = |request: PolicyRequest| policy.piece(&request).total_bytes as usize;
        let joining = PolicyRequest::default();
        assert_eq!(total(joining), policy.for_joining.len());
        assert_eq!(total(PolicyRequest { known: older, config_hash: 9, ..joining }), policy.update.len());
        assert_eq!(total(PolicyRequest { known: older, config_hash: 8, ..joining }), policy.for_joining.len());
        assert_eq!(total(PolicyRequest { known: Some(VERSION), config_hash: 9, ..joining }), 0);
        assert!(policy.update.len() < policy.for_joining.len());
        let second = policy.piece(&PolicyRequest { offset: 30_000, ..joining });
        assert_eq!(second.data, policy.for_joining[30_000..60_000]);
    }
}
