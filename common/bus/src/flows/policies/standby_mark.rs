//! Lets actors find out that they dialled a learner that only follows.
//!
//! With encrypted links such a learner passes small messages on, but drops large fragments: it has one thread for all links
//! ([`crate::workarounds::threads`]), which cannot wait for space on one of them. So actors look for another way to the
//! leader.

use std::{sync::Arc, time::Duration};

use treadmill_proto::PolicyRequest;
use zenoh::{Wait, qos::Priority};

use super::pieces;
use crate::{
    error::BusError,
    flows::shared::{ask, serve},
    session::Bus,
};

/// Error with which a standby answers requests for its policy.
const FOLLOWS: &[u8] = b"this learner follows";
/// Longest wait for the answer.
const TIMEOUT: Duration = Duration::from_secs(2);

/// Answers requests for the policy of a learner that follows with an error, until it is dropped.
pub struct StandbyMark {
    _follows: Arc<()>,
}

impl StandbyMark {
    /// Declares the mark, for all runs, on the session of a learner.
    pub fn open(bus: &Bus) -> Result<Self, BusError> {
        let follows = Arc::new(());
        let mark = Arc::downgrade(&follows);
        serve(bus, pieces::key_of("*", &bus.session.zid().to_string()), "serving policies", move |query| {
            if mark.strong_count() > 0
                && let Err(error) = query.reply_err(FOLLOWS).wait()
            {
                tracing::debug!(%error, "standby's answer not sent");
            }
        })?;
        Ok(Self { _follows: follows })
    }
}

/// Returns whether the process that this client dialled is a learner that follows. `request` names the policy that the
/// client has, so that a router or the leader need not send it.
///
/// # Errors
/// If the bus fails.
pub async fn is_behind_standby(bus: &Bus, run: &str, request: &PolicyRequest) -> Result<bool, BusError> {
    for node in bus.session.info().routers_zid().wait() {
        let (key, what) = (pieces::key_of(run, &node.to_string()), "asking whether a learner follows");
        let replies = ask(bus, key, request.encode(), TIMEOUT, Priority::Data, what)?;
        while let Ok(reply) = replies.recv_async().await {
            if reply.result().is_err_and(|error| error.payload().to_bytes().as_ref() == FOLLOWS) {
                return Ok(true);
            }
        }
    }
    Ok(false)
}
