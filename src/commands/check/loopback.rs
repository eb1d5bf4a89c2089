//! Whether processes of this machine reach each other: `train` talks to its actors over loopback.

use std::{
    io::{self, Read, Write},
    net::{SocketAddr, TcpListener, TcpStream},
    time::Duration,
};

use super::finding::Finding;

const NAME: &str = "loopback";

const PATIENCE: Duration = Duration::from_secs(3);

/// Talks to itself.
pub fn diagnose() -> Finding {
    assess(talk())
}

fn assess(talked: io::Result<SocketAddr>) -> Finding {
    match talked {
        Ok(_) => Finding::ok(NAME, "127.0.0.1 carries what is sent"),
        Err(why) => Finding::problem(
            NAME,
            format!("processes of this machine do not reach each other by 127.0.0.1: {why}"),
            "`train` needs that: bring the interface up (ip link set lo up), and let firewalls leave it alone",
        ),
    }
}

fn talk() -> io::Result<SocketAddr> {
    let listener = TcpListener::bind("127.0.0.1:0")?;
    let address = listener.local_addr()?;
    let mut one = TcpStream::connect_timeout(&address, PATIENCE)?;
    let (mut other, _) = listener.accept()?;
    one.write_all(b"treadmill")?;
    other.set_read_timeout(Some(PATIENCE))?;
    let mut heard = [0; 9];
    other.read_exact(&mut heard)?;
    match &heard {
        b"treadmill" => Ok(address),
        _ => Err(io::Error::other("what arrived was not what was sent")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn a_machine_that_does_not_reach_itself_is_told_how_to() {
        let found = assess(Err(io::ErrorKind::AddrNotAvailable.into()));
        assert!(found.severity == Severity::Problem && found.remedy.unwrap().contains("ip link set lo up"));
    }
}
