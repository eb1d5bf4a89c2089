//! Who listens nearby: asked by multicast, where a network carries it.

use std::time::{Duration, Instant};

use zenoh::{Config, Wait, config::WhatAmI};

use super::{BusOptions, endpoint};
use crate::BusError;

/// One question is repeated for so long before it is asked anew.
const ROUND: Duration = Duration::from_secs(3);
/// After the first answer, others are waited for so long: a learner and its routers answer together.
const OTHERS: Duration = Duration::from_millis(300);

/// Asks until somebody answers whom we may dial; where they listen.
pub(super) fn find(settings: &Config, options: &BusOptions) -> Result<Vec<String>, BusError> {
    let mut refused: Vec<String> = Vec::new();
    loop {
        let answers = zenoh::scout(WhatAmI::Router, settings.clone())
            .wait()
            .map_err(|why| BusError::Open { why: format!("multicast cannot be used: {why}") })?;
        let (mut found, mut until) = (Vec::new(), Instant::now() + ROUND);
        while let Ok(Some(hello)) = answers.recv_timeout(until.saturating_duration_since(Instant::now())) {
            for locator in hello.locators().iter().map(ToString::to_string) {
                if found.contains(&locator) || refused.contains(&locator) {
                    continue;
                }
                match acceptable(&locator, options) {
                    Ok(()) => {
                        tracing::info!("found {locator}");
                        found.push(locator);
                        until = until.min(Instant::now() + OTHERS);
                    }
                    Err(why) => {
                        tracing::warn!("found, and not dialled: {why}");
                        refused.push(locator);
                    }
                }
            }
        }
        if !found.is_empty() {
            return Ok(found);
        }
    }
}

/// Answers come from anybody: they are held to the same rules as what the user gives, and stricter where we have
/// certificates.
fn acceptable(locator: &str, options: &BusOptions) -> Result<(), BusError> {
    if options.credentials.is_some() && !locator.starts_with("tls/") {
        let why = "it is not encrypted, and --tls was given".to_string();
        return Err(BusError::Endpoint { endpoint: locator.to_string(), why });
    }
    endpoint::check(locator, options.insecure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Credentials, Role};

    #[test]
    fn whoever_has_certificates_dials_no_plain_text() {
        let open = BusOptions { insecure: true, ..BusOptions::default() };
        assert!(acceptable("tcp/10.0.0.1:7447", &open).is_ok());
        assert!(acceptable("tcp/10.0.0.1:7447", &BusOptions::default()).is_err());
        let credentials = Credentials { folder: "certs".into(), role: Role::Actor };
        let careful = BusOptions { insecure: true, credentials: Some(credentials), ..BusOptions::default() };
        let why = acceptable("tcp/10.0.0.1:7447", &careful).unwrap_err().to_string();
        assert!(why.contains("tcp/10.0.0.1:7447") && why.contains("--tls"), "{why}");
        assert!(acceptable("tls/10.0.0.1:7447", &careful).is_ok());
    }
}
