//! Policies: serves the newest bundle, and announces each new version.

use std::sync::{
    Arc, Mutex, RwLock,
    mpsc::{Receiver, sync_channel},
};

use bytes::Bytes;
use treadmill_proto::PolicyAnnouncement;
use zenoh::{
    Wait,
    pubsub::Publisher,
    qos::{CongestionControl, Priority},
    query::{Query, Queryable},
};

use crate::{Bus, BusError, admission::read_throttle::ReadThrottle, keys};

/// Policy requests that may wait for the shelf's thread.
const QUEUE: usize = 4096;
/// Threads that serve policies: one that waits for a reader who does not read keeps only itself.
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
    /// Opens the shelf with its first bundle.
    pub fn open(bus: &Bus, run: &str, bundle: Bytes) -> Result<Self, BusError> {
        let current = Arc::new(RwLock::new(bundle));
        let (sender, requests) = sync_channel::<Query>(QUEUE);
        let (key, requests) = (keys::policy_latest(run), Arc::new(Mutex::new(requests)));
        for number in 0..THREADS {
            let (current, key, requests) = (current.clone(), key.clone(), requests.clone());
            std::thread::Builder::new()
                .name(format!("policy-shelf-{number}"))
                .spawn(move || serve(&current, &key, &requests))
                .map_err(|why| BusError::Flow {
                    what: "starting the policy shelf".to_string(),
                    why: why.to_string(),
                })?;
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

    /// Puts a new bundle on the shelf, then tells everybody.
    pub fn publish(&self, bundle: Bytes, announcement: &PolicyAnnouncement) {
        *self.current.write().expect("no holder of this lock panics") = bundle;
        if let Err(why) = self.announcer.put(announcement.encode()).wait() {
            // Actors also hear of it from receipts, and look by themselves now and then.
            tracing::debug!("a policy announcement could not be sent: {why}");
        }
    }
}

/// Hands out policies for as long as somebody can ask.
fn serve(current: &RwLock<Bytes>, key: &str, requests: &Mutex<Receiver<Query>>) {
    loop {
        // Only whoever holds the lock waits for a request; the answer is sent without it.
        let next = requests.lock().expect("no holder of this lock panics").recv();
        let Ok(query) = next else { return };
        let bundle = current.read().expect("no holder of this lock panics").clone();
        // The answer names the run also where the question left it open.
        if let Err(why) = query.reply(key, bundle).wait() {
            tracing::debug!("a policy bundle could not be sent: {why}");
        }
    }
}
