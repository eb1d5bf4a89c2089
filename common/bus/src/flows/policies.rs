//! Policies: the learner serves the newest bundle and announces each version; actors watch and fetch.

use std::{
    sync::{
        Arc, Mutex, RwLock,
        mpsc::{Receiver, sync_channel},
    },
    time::Duration,
};

use bytes::Bytes;
use treadmill_proto::{PolicyAnnouncement, PolicyBundle};
use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::{Publisher, Subscriber},
    qos::{CongestionControl, Priority},
    query::{Query, Queryable},
    sample::Sample,
};

use super::{first_valid, start_thread};
use crate::{Bus, BusError, admission::read_throttle::ReadThrottle, keys};

/// Policy requests that may wait for a server thread.
const QUEUE: usize = 4096;
/// Threads that serve policies. A requester that does not read its reply blocks only one of them.
const THREADS: usize = 4;
/// Rate of policy requests above which the link is throttled.
const REQUESTS_PER_S: f64 = 1000.0;

/// Serves the newest policy bundle and announces it.
pub struct PolicyServer {
    current: Arc<RwLock<Bytes>>,
    announcer: Publisher<'static>,
    _queryable: Queryable<()>,
}

impl PolicyServer {
    /// Starts to serve `bundle`.
    pub fn open(bus: &Bus, run: &str, bundle: Bytes) -> Result<Self, BusError> {
        let current = Arc::new(RwLock::new(bundle));
        let (sender, requests) = sync_channel::<Query>(QUEUE);
        let (key, requests) = (keys::policy_latest(run), Arc::new(Mutex::new(requests)));
        for number in 0..THREADS {
            let (current, key, requests) = (current.clone(), key.clone(), requests.clone());
            start_thread(&format!("policy-server-{number}"), move || serve(&current, &key, &requests))?;
        }
        let throttle = ReadThrottle::new(REQUESTS_PER_S);
        let queryable = bus
            .session
            .declare_queryable(key)
            // A request that finds the queue full gets no reply, and its actor asks again.
            .callback(move |query| {
                throttle.pass();
                drop(sender.try_send(query));
            })
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

    /// Serves `bundle` from now on, and announces it.
    pub fn publish(&self, bundle: Bytes, announcement: &PolicyAnnouncement) {
        *self.current.write().expect("no holder of this lock panics") = bundle;
        if let Err(error) = self.announcer.put(announcement.encode()).wait() {
            // Receipts carry the version, too, and actors poll now and then.
            tracing::debug!(%error, "policy announcement not sent");
        }
    }
}

/// Serves requests until the queue is closed.
fn serve(current: &RwLock<Bytes>, key: &str, requests: &Mutex<Receiver<Query>>) {
    loop {
        // The lock is held only while waiting for a request, not while replying.
        let next = requests.lock().expect("no holder of this lock panics").recv();
        let Ok(query) = next else { return };
        let bundle = current.read().expect("no holder of this lock panics").clone();
        // The reply's key names the run even if the request did not.
        if let Err(error) = query.reply(key, bundle).wait() {
            tracing::debug!(what = "policy bundle", %error, "reply not sent");
        }
    }
}

/// Fetches the newest policy of `run`, or of the only run. `None` if no answer came; the learner may still be running.
pub async fn fetch_policy(bus: &Bus, run: Option<&str>, timeout: Duration) -> Result<Option<PolicyBundle>, BusError> {
    let replies = bus
        .session
        .get(keys::policy_latest(run.unwrap_or("*")))
        .timeout(timeout)
        .priority(Priority::DataHigh)
        .congestion_control(CongestionControl::Block)
        .await
        .map_err(BusError::flow("asking for the policy"))?;
    Ok(first_valid(replies, "policy bundle", PolicyBundle::decode).await)
}

/// Announcements of new policies; only the newest is kept.
pub struct Announcements {
    ring: Subscriber<RingChannelHandler<Sample>>,
}

impl Announcements {
    /// Waits for the next announcement. `None` if it is invalid or the session is closed.
    pub async fn next(&self) -> Option<PolicyAnnouncement> {
        let sample = self.ring.recv_async().await.ok()?;
        PolicyAnnouncement::decode(&sample.payload().to_bytes()).ok()
    }
}

/// Subscribes to announcements.
pub fn watch_announcements(bus: &Bus, run: &str) -> Result<Announcements, BusError> {
    let ring = bus
        .session
        .declare_subscriber(keys::policy_version(run))
        .with(RingChannel::new(1))
        .wait()
        .map_err(BusError::flow("listening to announcements"))?;
    Ok(Announcements { ring })
}
