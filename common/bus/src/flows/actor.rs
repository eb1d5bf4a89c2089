//! What actors do on the bus: fetch policies, submit rollouts, tell about themselves.

use std::time::Duration;

use bytes::Bytes;
use treadmill_proto::{Malformed, PolicyAnnouncement, PolicyBundle, Receipt};
use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::Subscriber,
    qos::{CongestionControl, Priority},
    sample::Sample,
};

use crate::{Bus, BusError, keys};

/// Asks for the newest policy of `run`, or of the only run there is. `None` where nobody answered, which says only that
/// nobody could be asked just now.
pub async fn fetch_policy(bus: &Bus, run: Option<&str>, timeout: Duration) -> Result<Option<PolicyBundle>, BusError> {
    let replies = bus
        .session
        .get(keys::policy_latest(run.unwrap_or("*")))
        .timeout(timeout)
        .priority(Priority::DataHigh)
        .congestion_control(CongestionControl::Block)
        .await
        .map_err(BusError::flow("asking for the policy"))?;
    while let Ok(reply) = replies.recv_async().await {
        let Ok(sample) = reply.result() else { continue };
        let bundle: Result<PolicyBundle, Malformed> =
            PolicyBundle::decode(Bytes::from(sample.payload().to_bytes().into_owned()));
        match bundle {
            Ok(bundle) => return Ok(Some(bundle)),
            Err(why) => tracing::warn!("a policy bundle was refused: {why}"),
        }
    }
    Ok(None)
}

/// Sends one encoded fragment and waits for its receipt. `None` where no receipt came: it may or may not have arrived.
pub async fn submit(
    bus: &Bus,
    run: &str,
    actor: &str,
    fragment: Bytes,
    timeout: Duration,
) -> Result<Option<Receipt>, BusError> {
    let replies = bus
        .session
        .get(keys::rollouts(run, actor))
        .payload(fragment)
        .timeout(timeout)
        .priority(Priority::Data)
        .congestion_control(CongestionControl::Block)
        .await
        .map_err(BusError::flow("sending a fragment"))?;
    while let Ok(reply) = replies.recv_async().await {
        let Ok(sample) = reply.result() else { continue };
        match Receipt::decode(&sample.payload().to_bytes()) {
            Ok(receipt) => return Ok(Some(receipt)),
            Err(why) => tracing::warn!("a receipt was refused: {why}"),
        }
    }
    Ok(None)
}

/// Announcements of new policies; only the newest is kept.
pub struct Announcements {
    ring: Subscriber<RingChannelHandler<Sample>>,
}

impl Announcements {
    /// The next announcement; waits for ever if none comes.
    pub async fn next(&self) -> Option<PolicyAnnouncement> {
        let sample = self.ring.recv_async().await.ok()?;
        PolicyAnnouncement::decode(&sample.payload().to_bytes()).ok()
    }
}

/// Begins to listen to announcements.
pub fn watch_announcements(bus: &Bus, run: &str) -> Result<Announcements, BusError> {
    let ring = bus
        .session
        .declare_subscriber(keys::policy_version(run))
        .with(RingChannel::new(1))
        .wait()
        .map_err(BusError::flow("listening to announcements"))?;
    Ok(Announcements { ring })
}

/// Shows that the actor is there for as long as the token is held.
pub fn token(bus: &Bus, run: &str, actor: &str) -> Result<impl Send + Sync + use<>, BusError> {
    bus.session
        .liveliness()
        .declare_token(keys::actor(run, actor))
        .wait()
        .map_err(BusError::flow("declaring the actor's token"))
}

/// A sender of small messages that may be dropped when the link is busy.
pub fn publish_dropping(bus: &Bus, key: String) -> Result<impl Fn(Vec<u8>) + Send + Sync + use<>, BusError> {
    let publisher = bus
        .session
        .declare_publisher(key)
        .congestion_control(CongestionControl::Drop)
        .priority(Priority::DataLow)
        .wait()
        .map_err(BusError::flow("declaring a publisher"))?;
    Ok(move |payload: Vec<u8>| {
        if let Err(why) = publisher.put(payload).wait() {
            tracing::debug!("a message could not be sent: {why}");
        }
    })
}
