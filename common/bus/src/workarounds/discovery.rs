//! Finds endpoints by multicast before the session opens.
//!
//! Zenoh's own discovery does not dial an endpoint again after its link broke. Endpoints found here are configured like
//! those that the user names, and Zenoh redials them. No upstream issue is known. Delete when a client redials discovered
//! endpoints; the session must then check them elsewhere.

use std::time::{Duration, Instant};

use zenoh::{Config, Wait, config::WhatAmI};

use crate::error::BusError;

/// Duration of one scouting round, in which Zenoh repeats the request.
const ROUND: Duration = Duration::from_secs(3);
/// Time to wait for further replies after the first: a learner and its routers reply together.
const FURTHER_REPLIES: Duration = Duration::from_millis(300);
/// Most endpoints that are found, and most that are refused, each with a line in the log. The refused ones are
/// forgotten after a round with as many.
const ENDPOINTS_MAX: usize = 64;

/// Scouts until an endpoint is found that passes `check`. Returns all that were found in that round.
pub(crate) fn find(settings: &Config, check: impl Fn(&str) -> Result<(), BusError>) -> Result<Vec<String>, BusError> {
    let mut refused: Vec<String> = Vec::new();
    loop {
        let replies = zenoh::scout(WhatAmI::Router, settings.clone())
            .wait()
            .map_err(|error| BusError::Open { why: format!("multicast cannot be used: {error}") })?;
        let (mut found, mut until) = (Vec::new(), Instant::now() + ROUND);
        while Instant::now() < until
            && let Ok(Some(hello)) = replies.recv_timeout(until.saturating_duration_since(Instant::now()))
        {
            for locator in hello.locators().iter().map(ToString::to_string) {
                let is_known = found.contains(&locator) || refused.contains(&locator);
                // Any host may send any number of replies.
                if is_known || found.len() == ENDPOINTS_MAX || refused.len() == ENDPOINTS_MAX {
                    continue;
                }
                match check(&locator) {
                    Ok(()) => {
                        tracing::info!(endpoint = %locator, "endpoint found");
                        found.push(locator);
                        until = until.min(Instant::now() + FURTHER_REPLIES);
                    }
                    Err(error) => {
                        tracing::warn!(%error, "endpoint found but not dialled");
                        refused.push(locator);
                    }
                }
            }
        }
        if !found.is_empty() {
            return Ok(found);
        }
        if refused.len() == ENDPOINTS_MAX {
            refused.clear();
        }
    }
}
