//! Peers whose connections this process has just closed, by Linux's table of TCP connections.
//!
//! Zenoh does not name the peer of a rejected connection. No upstream issue is known.

use std::{
    net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr},
    sync::Mutex,
};

/// Ports on which this process listens.
static LISTENING: Mutex<Vec<u16>> = Mutex::new(Vec::new());
/// States of the kernel's `tcp_states.h` in which the end that closed first waits: FIN_WAIT1 for an answer, the others, by a
/// timer of their own, for the other end or until nothing is on its way any more.
const FIN_WAIT1: &str = "04";
const WAITING: [&str; 2] = ["05", "06"];
const WAIT_TIMER: &str = "03";
/// Hundredths of a second that a closed connection stays in the table, and for which it counts as just closed.
const CLOSED_TICKS: u64 = 6000;
const JUST_TICKS: u64 = 100;
/// Peers that are named.
const PEERS_MAX: usize = 4;

/// Notes ports on which this process listens.
pub fn listen_on(ports: impl Iterator<Item = u16>) {
    LISTENING.lock().expect("no holder of this lock panics").extend(ports);
}

/// Returns the peers whose connections to this process were closed by it within the last second, the last one first, one of
/// each host, where the system says so.
pub fn just_closed() -> Vec<String> {
    let ports = LISTENING.lock().expect("no holder of this lock panics").clone();
    let mut closed = closed(&ports);
    closed.sort_by_key(|(left_ticks, _)| std::cmp::Reverse(*left_ticks));
    let mut peers: Vec<SocketAddr> = Vec::new();
    for (_, peer) in closed {
        if peers.iter().all(|known| known.ip() != peer.ip()) {
            peers.push(peer);
        }
    }
    peers.iter().take(PEERS_MAX).map(ToString::to_string).collect()
}

fn closed(ports: &[u16]) -> Vec<(u64, SocketAddr)> {
    let tables = ["/proc/self/net/tcp", "/proc/self/net/tcp6"];
    tables.iter().flat_map(|path| in_table(&std::fs::read_to_string(path).unwrap_or_default(), ports)).collect()
}

/// Returns the peers of a table, each with the time that is left to it.
///
/// Columns: Linux, `Documentation/networking/proc_net_tcp.rst`.
fn in_table(table: &str, ports: &[u16]) -> Vec<(u64, SocketAddr)> {
    let peer = |line: &str| {
        let mut fields = line.split_whitespace().skip(1);
        let (local, remote, state) = (address(fields.next()?)?, address(fields.next()?)?, fields.next()?);
        // Of "timer:when".
        let (timer, left) = fields.nth(1)?.split_once(':')?;
        let left_ticks = u64::from_str_radix(left, 16).ok()?;
        let (left_ticks, is_new) = match state {
            // The end was not sent again yet.
            FIN_WAIT1 => (CLOSED_TICKS, u64::from_str_radix(fields.next()?, 16).ok()? == 0),
            _ if WAITING.contains(&state) && timer == WAIT_TIMER => {
                (left_ticks, left_ticks + JUST_TICKS >= CLOSED_TICKS)
            }
            _ => return None,
        };
        (is_new && ports.contains(&local.port())).then_some((left_ticks, remote))
    };
    table.lines().filter_map(peer).collect()
}

/// Returns an address that is written as hexadecimal words, each in the order of bytes of this machine, and a port.
fn address(text: &str) -> Option<SocketAddr> {
    let (words, port) = text.split_once(':')?;
    let word = |index: usize| u32::from_str_radix(words.get(8 * index..8 * index + 8)?, 16).ok().map(u32::to_ne_bytes);
    let host = match words.len() {
        8 => IpAddr::V4(Ipv4Addr::from(word(0)?)),
        32 => {
            let mut bytes = [0; 16];
            for (index, part) in bytes.as_chunks_mut::<4>().0.iter_mut().enumerate() {
                *part = word(index)?;
            }
            IpAddr::V6(Ipv6Addr::from(bytes)).to_canonical()
        }
        _ => return None,
    };
    Some(SocketAddr::new(host, u16::from_str_radix(port, 16).ok()?))
}

#[cfg(all(test, target_endian = "little"))]
mod tests {
    use super::*;

    #[test]
    fn connections_that_we_closed_just_now_are_found() {
        let row = |local: &str, remote: &str, state: &str, timer: &str| {
            format!(
                "   2: {local} {remote} {state} 00000000:00000000 {timer} 00000000     0        0 39327 2 0000000010 20 4 1 34 -1\n"
            )
        };
        let table = [
            "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"
                .to_string(),
            row("0100007F:1D17", "00000000:0000", "0A", "00:00000000"),
            row("0100007F:1D17", "0200000A:A49E", "06", "03:0000176F"),
            row("0100007F:1D17", "0300000A:A49E", "06", "03:00001700"),
            row("0100007F:1D18", "0400000A:A49E", "06", "03:0000176F"),
            row("0100007F:1D17", "0500000A:A49E", "01", "00:00000000"),
            row("0100007F:1D17", "0600000A:A49E", "05", "03:00001770"),
            row("0100007F:1D17", "0700000A:A49E", "05", "02:00001770"),
            row("0100007F:1D17", "0800000A:A49E", "04", "01:00000014"),
            row("0100007F:1D17", "0900000A:A49E", "04", "01:00000014").replace("00000000     0", "00000002     0"),
            "garbage\n".to_string(),
        ];
        let found = in_table(&table.concat(), &[7447]);
        let of = |host: u8| SocketAddr::from(([10, 0, 0, host], 42142));
        assert_eq!(found, [(0x176f, of(2)), (0x1770, of(6)), (CLOSED_TICKS, of(8))]);
    }

    #[test]
    fn addresses_of_both_versions_are_read() {
        let read = |text: &str| address(text).map(|address| address.to_string());
        assert_eq!(read("0100007F:1D17").as_deref(), Some("127.0.0.1:7447"));
        assert_eq!(read("0000000000000000FFFF00000100007F:1D17").as_deref(), Some("127.0.0.1:7447"));
        assert_eq!(read("B80D0120000000000000000001000000:0050").as_deref(), Some("[2001:db8::1]:80"));
        assert_eq!((read("0100007F"), read("01:02"), read("0100007F:10000")), (None, None, None));
    }

    #[test]
    fn a_connection_of_this_process_is_seen_when_it_ends() {
        let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let client = std::net::TcpStream::connect(address).unwrap();
        let (accepted, peer) = listener.accept().unwrap();
        let is_seen = || closed(&[address.port()]).iter().any(|(_, found)| *found == peer);
        assert!(!is_seen());
        drop(accepted);
        assert_eq!(is_seen(), cfg!(target_os = "linux"));
        listen_on([address.port()].into_iter());
        assert!(LISTENING.lock().unwrap().contains(&address.port()));
        drop(client);
    }
}
