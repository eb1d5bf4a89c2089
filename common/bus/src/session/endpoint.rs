//! Checks endpoints that the user gives, before Zenoh sees them.

use std::net::{IpAddr, TcpListener};

use crate::error::BusError;

/// Refuses a malformed endpoint, plain text beyond this machine unless `insecure` allows it, and TLS without certificates.
pub fn check(endpoint: &str, insecure: bool, has_certificates: bool) -> Result<(), BusError> {
    let refuse = |why: &str| Err(BusError::Endpoint { endpoint: endpoint.to_string(), why: why.to_string() });
    let Some((protocol, rest)) = endpoint.split_once('/') else {
        return refuse("it has no protocol; write tcp/HOST:PORT");
    };
    let shown = if protocol == "tls" { "tls" } else { "tcp" };
    let Some((host, port)) = without_options(rest).0.rsplit_once(':') else {
        return refuse(&format!("it has no port; write {shown}/HOST:PORT"));
    };
    if host.is_empty() || port.parse::<u16>().is_err() {
        return refuse(&format!("host or port is not valid; write {shown}/HOST:PORT with a port from 0 to 65535"));
    }
    match protocol {
        "tls" if has_certificates => Ok(()),
        "tls" => refuse(
            "links to it are encrypted, and --tls is missing; name the folder with this machine's certificates: --tls DIR \
             (`treadmill certs DIR` makes them)",
        ),
        "tcp" if insecure || is_loopback(host) => Ok(()),
        "tcp" => refuse(
            "plain tcp beyond loopback can be read and forged by any host on the network; use tls/HOST:PORT with \
             --tls DIR (certificates: `treadmill certs DIR`), or --insecure on a trusted network",
        ),
        _ => refuse("the protocol must be tcp or tls"),
    }
}

/// Refuses plain text where certificates decide what a client may do.
pub fn check_encrypted(endpoint: &str) -> Result<(), BusError> {
    match endpoint.strip_prefix("tcp/") {
        None => Ok(()),
        Some(address) => Err(BusError::Endpoint {
            endpoint: endpoint.to_string(),
            why: format!("with --tls, clients without a certificate may do nothing; write tls/{address}"),
        }),
    }
}

fn is_loopback(host: &str) -> bool {
    let bare = host.trim_start_matches('[').trim_end_matches(']');
    bare == "localhost" || bare.parse::<IpAddr>().is_ok_and(|address| address.is_loopback())
}

/// Splits Zenoh's options, from `?` or `#` on, off an endpoint.
pub fn without_options(endpoint: &str) -> (&str, &str) {
    endpoint.split_at(endpoint.find(['?', '#']).unwrap_or(endpoint.len()))
}

/// Checks that the port of an endpoint is free, so that the error names it.
pub fn check_free(endpoint: &str) -> Result<(), BusError> {
    let address = without_options(endpoint.split_once('/').map_or(endpoint, |(_, address)| address)).0;
    match TcpListener::bind(address) {
        Ok(_) => Ok(()),
        Err(error) => Err(BusError::Listen { endpoint: endpoint.to_string(), why: error.to_string() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_text_beyond_this_machine_is_refused() {
        for fine in ["tcp/127.0.0.1:7447", "tcp/localhost:0", "tcp/[::1]:7447", "tls/learner:7447"] {
            assert!(check(fine, false, true).is_ok(), "{fine}");
        }
        let refused = |endpoint| check(endpoint, false, false).unwrap_err().to_string();
        assert!(refused("tcp/0.0.0.0:7447").contains("--insecure"));
        assert!(refused("tls/learner:7447").contains("--tls DIR"));
        assert!(refused("tls/learner").contains("write tls/HOST:PORT"));
        assert!(refused("tcp/learner").contains("write tcp/HOST:PORT"));
        assert!(check("tcp/0.0.0.0:7447", true, false).is_ok());
        let why = check_encrypted("tcp/127.0.0.1:7447").unwrap_err().to_string();
        assert!(why.contains("write tls/127.0.0.1:7447"), "{why}");
        assert!(check_encrypted("tls/127.0.0.1:7447").is_ok());
        for bad in ["learner:7447", "tcp/learner", "tcp/:1", "tcp/h:99999", "udp/127.0.0.1:1"] {
            assert!(check(bad, true, true).is_err(), "{bad}");
        }
    }

    #[test]
    fn the_error_names_a_taken_port() {
        let taken = TcpListener::bind("127.0.0.1:0").unwrap();
        let endpoint = format!("tcp/{}", taken.local_addr().unwrap());
        let why = check_free(&endpoint).unwrap_err().to_string();
        assert!(why.contains(&endpoint) && why.contains("--listen"), "{why}");
        check_free("tls/127.0.0.1:0#tls_handshake_timeout_ms=5000").unwrap();
    }
}
