//! Whether `--discover` could find anybody: whether multicast comes back to this machine.

use std::{
    io,
    net::{Ipv4Addr, UdpSocket},
    time::Duration,
};

use super::finding::Finding;

const NAME: &str = "multicast";

/// The bus's own group, on a port that nobody else listens to.
const GROUP: Ipv4Addr = Ipv4Addr::new(224, 0, 0, 224);
const PATIENCE: Duration = Duration::from_millis(500);

/// Asks itself; `is_wanted` where `--discover` was given.
pub fn diagnose(is_wanted: bool) -> Finding {
    assess(hear(), is_wanted)
}

fn assess(heard: io::Result<()>, is_wanted: bool) -> Finding {
    match (heard, is_wanted) {
        (Ok(()), _) => Finding::ok(NAME, "works on this machine; whether the network carries it, --discover shows"),
        (Err(why), true) => Finding::problem(
            NAME,
            format!("does not come back to this machine: {why}"),
            "name endpoints by --connect instead of --discover; most clouds and containers carry no multicast",
        ),
        (Err(why), false) => Finding::note(
            NAME,
            format!("does not come back to this machine: {why}"),
            "nothing, unless you use --discover; --connect needs none",
        ),
    }
}

fn hear() -> io::Result<()> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0))?;
    socket.join_multicast_v4(&GROUP, &Ipv4Addr::UNSPECIFIED)?;
    socket.set_multicast_loop_v4(true)?;
    socket.set_multicast_ttl_v4(0)?;
    socket.set_read_timeout(Some(PATIENCE))?;
    let word = std::process::id().to_le_bytes();
    socket.send_to(&word, (GROUP, socket.local_addr()?.port()))?;
    let mut heard = [0; 4];
    loop {
        socket.recv_from(&mut heard)?;
        if heard == word {
            return Ok(());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn silence_matters_to_those_who_want_to_be_found() {
        let silence = || Err(io::ErrorKind::WouldBlock.into());
        assert_eq!(assess(Ok(()), true).severity, Severity::Ok);
        assert_eq!(assess(silence(), false).severity, Severity::Note);
        let found = assess(silence(), true);
        assert!(found.severity == Severity::Problem && found.remedy.unwrap().contains("--connect"));
    }
}
