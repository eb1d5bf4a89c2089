//! Ports for processes that are to listen later.

use std::{
    iter::repeat_with,
    net::TcpListener,
    ops::Range,
    process,
    sync::atomic::{AtomicU32, Ordering},
};

/// Ports that systems do not give to connections: a connection of another test, or of a process that dials the port before
/// another one listens there, would keep that from it.
const PORTS: Range<u32> = 12_000..32_000;

/// Returns a free port of loopback, another one at each call.
pub fn free_port() -> u16 {
    static NEXT: AtomicU32 = AtomicU32::new(0);
    // Test programs that run at the same time begin far apart.
    let begin = process::id().wrapping_mul(7919);
    let mut ports = repeat_with(|| {
        let number = begin.wrapping_add(NEXT.fetch_add(1, Ordering::Relaxed));
        (PORTS.start + number % (PORTS.end - PORTS.start)) as u16
    });
    ports.find(|port| TcpListener::bind(("127.0.0.1", *port)).is_ok()).expect("a free port")
}

/// Returns free endpoints, which differ.
pub fn free_endpoints<const N: usize>(protocol: &str) -> [String; N] {
    [(); N].map(|()| format!("{protocol}/127.0.0.1:{}", free_port()))
}
