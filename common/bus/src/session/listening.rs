//! Ports that the system chose for endpoints that listen on port 0.

use std::net::IpAddr;

use super::endpoint::without_options;
use crate::error::BusError;

/// Returns protocol, host and port of an endpoint without options, for example `tcp`, `[::1]` and `7447`.
fn parts(endpoint: &str) -> Option<(&str, &str, &str)> {
    let (protocol, address) = without_options(endpoint).0.split_once('/')?;
    let (host, port) = address.rsplit_once(':')?;
    Some((protocol, host, port))
}

/// Returns the ports of endpoints.
pub fn ports(endpoints: &[String]) -> impl Iterator<Item = u16> {
    endpoints.iter().filter_map(|endpoint| parts(endpoint)?.2.parse().ok())
}

fn ip(host: &str) -> Option<IpAddr> {
    host.trim_matches(['[', ']']).parse().ok()
}

/// Replaces port 0 of the endpoints of a session by the ports of its locators, which have resolved hosts.
///
/// # Errors
/// [`BusError::Endpoint`] if no locator is left for one: Zenoh has none for 0.0.0.0 or [::] on a machine that has but the
/// loopback interface.
pub fn with_ports(endpoints: &[String], locators: &[String]) -> Result<Vec<String>, BusError> {
    let named: Vec<&str> = endpoints.iter().filter_map(|endpoint| Some(parts(endpoint)?.2)).collect();
    let mut free: Vec<_> = locators.iter().filter_map(|locator| parts(locator)).collect();
    free.retain(|(_, _, port)| !named.contains(port));
    let mut found = endpoints.to_vec();
    // Names take what is left, since they may stand for any address.
    for round in [0, 1, 2] {
        for (index, endpoint) in endpoints.iter().enumerate() {
            let Some((protocol, host, "0")) = parts(&found[index]) else { continue };
            let fits = |(of, at, _): &&(&str, &str, &str)| {
                *of == protocol
                    && match (ip(host), ip(at)) {
                        (Some(host), Some(at)) if round == 0 => host == at,
                        // Zenoh counts addresses of version 4 among those of [::], and leaves out loopback.
                        (Some(host), Some(at)) if round == 1 => {
                            host.is_unspecified() && !at.is_loopback() && (host.is_ipv6() || at.is_ipv4())
                        }
                        (None, _) => round == 2 || *at == host,
                        _ => false,
                    }
            };
            let Some((_, _, port)) = free.iter().find(fits).copied() else { continue };
            free.retain(|(_, _, other)| *other != port);
            let options = without_options(endpoint).1;
            found[index] = format!("{protocol}/{host}:{port}{options}");
        }
    }
    match found.iter().find(|endpoint| matches!(parts(endpoint), Some((_, _, "0")))) {
        None => Ok(found),
        Some(endpoint) => Err(BusError::Endpoint {
            endpoint: endpoint.clone(),
            why: "no interface of this machine listens on it; give it a port, or name a host".to_string(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(endpoints: &[&str], locators: &[&str]) -> Result<Vec<String>, BusError> {
        let owned = |texts: &[&str]| texts.iter().map(ToString::to_string).collect::<Vec<_>>();
        with_ports(&owned(endpoints), &owned(locators))
    }

    #[test]
    fn each_endpoint_gets_a_port_of_its_own() {
        let locators = ["tcp/[::1]:41", "tls/[::1]:42", "tcp/127.0.0.1:7447", "tcp/127.0.0.1:43", "tcp/127.0.0.1:44"];
        let endpoints = [
            "tcp/127.0.0.1:0",
            "tcp/127.0.0.1:7447",
            "tcp/[::1]:0",
            "tls/localhost:0#tls_handshake_timeout_ms=5",
            "tcp/127.0.0.1:0",
        ];
        assert_eq!(ports(&["tls/localhost:42#tls_handshake_timeout_ms=5".to_string()]).collect::<Vec<_>>(), [42]);
        let mut given = found(&endpoints, &locators).unwrap();
        let rest = ["tcp/127.0.0.1:7447", "tcp/[::1]:41", "tls/localhost:42#tls_handshake_timeout_ms=5"];
        assert_eq!(given[1..4], rest);
        given.retain(|endpoint| !rest.contains(&endpoint.as_str()));
        given.sort();
        assert_eq!(given, ["tcp/127.0.0.1:43", "tcp/127.0.0.1:44"]);
    }

    #[test]
    fn all_addresses_of_the_machine_share_a_port() {
        let locators = ["tcp/10.0.0.1:41", "tcp/10.0.0.2:41", "tcp/127.0.0.1:42"];
        let wanted = ["tcp/0.0.0.0:41", "tcp/127.0.0.1:42"];
        assert_eq!(found(&["tcp/0.0.0.0:0", "tcp/127.0.0.1:0"], &locators).unwrap(), wanted);
        let wanted = ["tcp/localhost:42", "tcp/0.0.0.0:41"];
        assert_eq!(found(&["tcp/localhost:0", "tcp/0.0.0.0:0"], &locators).unwrap(), wanted);
        assert_eq!(found(&["tcp/[::]:0"], &["tcp/10.0.0.1:41"]).unwrap(), ["tcp/[::]:41"]);
        let why = found(&["tcp/127.0.0.1:0", "tcp/0.0.0.0:0"], &["tcp/127.0.0.1:42"]).unwrap_err().to_string();
        assert!(why.contains("tcp/0.0.0.0:0") && why.contains("give it a port"), "{why}");
    }
}
