//! The way to an endpoint: its name, its port, and who answers there.

use std::{
    io,
    net::{SocketAddr, TcpStream, ToSocketAddrs},
    time::Duration,
};

use treadmill_bus::Credentials;

use super::{finding::Finding, handshake};

const NAME: &str = "route";

/// How long a machine may take to answer.
const PATIENCE: Duration = Duration::from_secs(5);

/// Goes to one endpoint as a client does; true where somebody answers as it should.
pub fn diagnose(endpoint: &str, credentials: Option<&Credentials>) -> (Vec<Finding>, bool) {
    let Some((protocol, rest)) = endpoint.split_once('/') else { return (Vec::new(), false) };
    let address = rest.split(['?', '#']).next().unwrap_or(rest);
    let stream = match resolve(address).and_then(|found| dial(&found)) {
        Ok(stream) => stream,
        Err(why) => return (vec![unreachable(endpoint, &why)], false),
    };
    let reached = Finding::ok(NAME, format!("somebody listens at {endpoint}"));
    match (protocol, credentials) {
        ("tls", Some(credentials)) => {
            let host = address.rsplit_once(':').map_or(address, |(host, _)| host);
            let shaken = handshake::diagnose(stream, host.trim_matches(['[', ']']), credentials);
            let is_well = shaken.severity != super::Severity::Problem;
            (vec![reached, shaken], is_well)
        }
        ("tls", None) => {
            let finding = Finding::problem(
                NAME,
                format!("{endpoint} wants certificates, and --tls was not given"),
                "give the folder with ca.crt and this part's two files: --tls DIR",
            );
            (vec![finding], false)
        }
        _ => (vec![reached], true),
    }
}

fn resolve(address: &str) -> io::Result<Vec<SocketAddr>> {
    let found: Vec<SocketAddr> = address.to_socket_addrs()?.collect();
    match found.is_empty() {
        true => Err(io::Error::other("the name has no address")),
        false => Ok(found),
    }
}

fn dial(addresses: &[SocketAddr]) -> io::Result<TcpStream> {
    let mut last = io::Error::other("the name has no address");
    for address in addresses {
        match TcpStream::connect_timeout(address, PATIENCE) {
            Ok(stream) => return Ok(stream),
            Err(why) => last = why,
        }
    }
    Err(last)
}

fn unreachable(endpoint: &str, why: &io::Error) -> Finding {
    let (seen, remedy) = match why.kind() {
        io::ErrorKind::ConnectionRefused => (
            format!("nobody listens at {endpoint}"),
            "start the learner, or take the endpoint from endpoint.txt in its run's folder; one that listens on 127.0.0.1 is \
             reached from its own machine alone",
        ),
        io::ErrorKind::TimedOut | io::ErrorKind::HostUnreachable | io::ErrorKind::NetworkUnreachable => (
            format!("no answer from {endpoint}: {why}"),
            "see whether the machine is up and whether a firewall or security group lets this port through",
        ),
        _ => (format!("{endpoint} cannot be reached: {why}"), "see whether the name is right: getent hosts NAME"),
    };
    Finding::problem(NAME, seen, remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_silence_has_its_own_remedy() {
        let remedy = |kind: io::ErrorKind| unreachable("tcp/learner:7447", &kind.into()).remedy.unwrap();
        assert!(remedy(io::ErrorKind::ConnectionRefused).contains("endpoint.txt"));
        assert!(remedy(io::ErrorKind::TimedOut).contains("firewall"));
        assert!(remedy(io::ErrorKind::NotFound).contains("getent"));
    }
}
