//! The learner serves the newest policy and announces each version.
//!
//! Actors get pieces of a bundle without the critic ([`super::pieces`]). Other programs may ask for the whole bundle, in
//! one reply on `policy/latest`.

use std::sync::{
    Arc, Mutex, RwLock, Weak,
    mpsc::{Receiver, sync_channel},
};

use bytes::Bytes;
use treadmill_proto::{Malformed, PolicyAnnouncement, PolicyBundle};
use zenoh::{
    Wait,
    pubsub::Publisher,
    qos::{CongestionControl, Priority},
    query::Query,
};

use super::{
    announcements,
    pieces::{self, ActorPolicy, PieceReply, PieceServer, ServedPolicies},
};
use crate::{
    error::BusError,
    flows::shared::{reply_on, serve, start_thread},
    session::Bus,
};

/// Requests for a whole bundle that may wait for a thread. Further ones get no reply.
const QUEUE: usize = 1024;
/// Threads that send whole bundles.
const THREADS: usize = 2;

/// What fails, in errors.
const SERVING: &str = "serving policies";

/// Policy as the learner publishes it.
#[derive(Debug)]
pub struct PublishedPolicy {
    bundle: Bytes,
    for_actors: Arc<ActorPolicy>,
    announcement: PolicyAnnouncement,
}

impl PublishedPolicy {
    /// Encodes a bundle, and `for_actors`, the same bundle with the weights of the actor only.
    pub fn new(bundle: &PolicyBundle, for_actors: &PolicyBundle) -> Result<Self, Malformed> {
        let (version, checksum) = (bundle.version, bundle.checksum);
        let announcement = PolicyAnnouncement { version, checksum, actor_checksum: for_actors.checksum };
        Ok(Self { bundle: bundle.encode()?.into(), for_actors: Arc::new(ActorPolicy::new(for_actors)?), announcement })
    }

    /// Returns the encoded bundle with actor and critic.
    #[must_use]
    pub fn bundle(&self) -> Bytes {
        self.bundle.clone()
    }
}

/// Serves the newest policy and announces it.
pub struct PolicyServer {
    current: Arc<RwLock<PublishedPolicy>>,
    pieces: PieceServer,
    announcer: Publisher<'static>,
}

impl PolicyServer {
    /// Starts to serve `policy`, and announces it: a learner that takes over must be heard before it has learnt anything.
    pub fn open(bus: &Bus, policy: PublishedPolicy) -> Result<Self, BusError> {
        let (run, announcement) = (policy.for_actors.run.clone(), policy.announcement.encode());
        let current = Arc::new(RwLock::new(policy));
        let pieces = PieceServer::start()?;
        let serve_pieces = |key| {
            let (current, pieces) = (Arc::downgrade(&current), pieces.clone());
            serve(bus, key, SERVING, move |query| {
                let Some(current) = current.upgrade() else { return };
                let policy = current.read().expect("no holder of this lock panics").for_actors.clone();
                if let Some(reply) = PieceReply::read(query) {
                    pieces.send(reply, policy);
                }
            })
        };
        serve_pieces(pieces::key(&run))?;
        serve_pieces(pieces::key_of(&run, &bus.session.zid().to_string()))?;
        serve_bundles(bus, &run, &current)?;
        let announcer = bus
            .session
            .declare_publisher(announcements::key(&run))
            .congestion_control(CongestionControl::Drop)
            .priority(Priority::DataHigh)
            .wait()
            .map_err(BusError::flow("declaring the announcement"))?;
        let server = Self { current, pieces, announcer };
        server.announce(announcement);
        Ok(server)
    }

    /// Serves `policy` from now on, and announces it.
    pub fn publish(&self, policy: PublishedPolicy) {
        let announcement = policy.announcement.encode();
        *self.current.write().expect("no holder of this lock panics") = policy;
        self.announce(announcement);
    }

    fn announce(&self, announcement: Vec<u8>) {
        if let Err(error) = self.announcer.put(announcement).wait() {
            // Receipts carry the version, too, and actors poll now and then.
            tracing::debug!(%error, "policy announcement not sent");
        }
    }

    /// Returns what actors and routers got since the start.
    #[must_use]
    pub fn served(&self) -> ServedPolicies {
        self.pieces.served()
    }
}

/// Returns `treadmill/{run}/policy/latest`: the whole newest bundle.
fn latest_key(run: &str) -> String {
    format!("treadmill/{run}/policy/latest")
}

/// Serves whole bundles on threads of their own. A large bundle may wait for space on a link, and pieces must not.
fn serve_bundles(bus: &Bus, run: &str, current: &Arc<RwLock<PublishedPolicy>>) -> Result<(), BusError> {
    let (sender, requests) = sync_channel::<Query>(QUEUE);
    let (key, requests) = (latest_key(run), Arc::new(Mutex::new(requests)));
    for number in 0..THREADS {
        let (current, key, requests) = (Arc::downgrade(current), key.clone(), requests.clone());
        start_thread(&format!("policy-bundles-{number}"), move || send_bundles(&current, &key, &requests))?;
    }
    serve(bus, key, SERVING, move |query| drop(sender.try_send(query)))
}

/// Answers requests until there is no policy, or the queue is closed.
fn send_bundles(current: &Weak<RwLock<PublishedPolicy>>, key: &str, requests: &Mutex<Receiver<Query>>) {
    loop {
        // The lock is held only while waiting for a request, not while replying.
        let next = requests.lock().expect("no holder of this lock panics").recv();
        let (Ok(query), Some(current)) = (next, current.upgrade()) else { return };
        let bundle = current.read().expect("no holder of this lock panics").bundle.clone();
        // The reply's key names the run even if the request did not.
        reply_on(&query, key, bundle, "policy bundle");
    }
}
