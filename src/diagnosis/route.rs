//! Diagnosis of the route to an endpoint: name resolution, port and TLS handshake.

use std::{
    io,
    net::{SocketAddr, TcpStream, ToSocketAddrs},
    time::Duration,
};

use treadmill_bus::Credentials;

use super::{
    finding::{Finding, Severity},
    handshake,
};

const NAME: &str = "route";
const CONNECT_TIMEOUT: Duration = Duration::from_secs(5);

/// Connects to an endpoint as a client does. The flag is true if the bus can be asked there.
pub fn diagnose(endpoint: &str, credentials: Option<&Credentials>) -> (Vec<Finding>, bool) {
    let Some((protocol, rest)) = endpoint.split_once('/') else { return (Vec::new(), false) };
    let address = rest.split(['?', '#']).next().unwrap_or(rest);
    let addresses = match address.to_socket_addrs() {
        Ok(addresses) => addresses,
        Err(why) => {
            let seen = format!("the host of {endpoint} is unknown: {why}");
            return (vec![Finding::problem(NAME, seen, "check the name: getent hosts NAME")], false);
        }
    };
    let stream = match connect(addresses) {
        Ok(stream) => stream,
        Err(why) => return (vec![unreachable(endpoint, &why)], false),
    };
    let reached = Finding::ok(NAME, format!("a process listens at {endpoint}"));
    let (true, Some(credentials)) = (protocol == "tls", credentials) else { return (vec![reached], true) };
    let host = address.rsplit_once(':').map_or(address, |(host, _)| host);
    let handshake = handshake::diagnose(stream, host.trim_matches(['[', ']']), credentials);
    let is_ok = handshake.severity != Severity::Problem;
    (vec![reached, handshake], is_ok)
}

/// Returns the finding about endpoints where a process listens, but does not answer as a learner or a router does.
pub fn not_a_learner(endpoints: &[String]) -> Finding {
    for endpoint in endpoints {
        let Some(address) = endpoint.strip_prefix("tcp/") else { continue };
        let stream = address.to_socket_addrs().and_then(connect);
        if stream.is_ok_and(handshake::speaks_tls) {
            let seen = format!("the process at {endpoint} speaks TLS");
            let remedy = format!("dial tls/{address}, with --tls DIR for the folder of this machine's certificates");
            return Finding::problem(NAME, seen, remedy);
        }
    }
    let endpoints = endpoints.join(", ");
    let seen = format!("a process listens at {endpoints}, but does not speak as a learner or a router does");
    Finding::problem(NAME, seen, "find the process that uses the port: ss -ltnp there; a learner logs where it listens")
}

fn connect(addresses: impl Iterator<Item = SocketAddr>) -> io::Result<TcpStream> {
    let mut last = io::Error::other("the name has no address");
    for address in addresses {
        match TcpStream::connect_timeout(&address, CONNECT_TIMEOUT) {
            Ok(stream) => return Ok(stream),
            Err(why) => last = why,
        }
    }
    Err(last)
}

fn unreachable(endpoint: &str, why: &io::Error) -> Finding {
    let (seen, remedy) = match why.kind() {
        io::ErrorKind::ConnectionRefused => (
            format!("no process listens at {endpoint}"),
            "start the learner, or take the endpoint from endpoint.txt in its run's folder; a learner on 127.0.0.1 is \
             unreachable from other machines",
        ),
        io::ErrorKind::TimedOut | io::ErrorKind::HostUnreachable | io::ErrorKind::NetworkUnreachable => (
            format!("no answer from {endpoint}: {why}"),
            "check that the machine is up, and that no firewall or security group blocks this port",
        ),
        _ => (format!("{endpoint} cannot be reached: {why}"), "check this machine's network"),
    };
    Finding::problem(NAME, seen, remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_failure_has_its_own_remedy() {
        let remedy = |kind: io::ErrorKind| unreachable("tcp/learner:7447", &kind.into()).remedy.unwrap();
        assert!(remedy(io::ErrorKind::ConnectionRefused).contains("endpoint.txt"));
        assert!(remedy(io::ErrorKind::TimedOut).contains("firewall"));
        assert!(remedy(io::ErrorKind::PermissionDenied).contains("network"));
    }
}
