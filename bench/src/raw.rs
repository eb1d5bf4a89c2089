//! Throughput of plain TCP: the same messages over one loopback connection.

use std::{
    io::{ErrorKind, Read, Write},
    net::{TcpListener, TcpStream},
    time::{Duration, Instant},
};

use anyhow::Context;

use crate::process::cpu_s;

/// Megabytes per second, and processor time of both ends in seconds per gigabyte.
pub type Raw = [f64; 2];

/// Sends messages of this size for `duration`. The receiver reads each into the same buffer.
pub fn measure(message_bytes: usize, duration: Duration) -> anyhow::Result<Raw> {
    let listener = TcpListener::bind("127.0.0.1:0").context("no port on loopback")?;
    let address = listener.local_addr().context("no address on loopback")?;
    let (cpu_before, begun) = (cpu_s(std::process::id()), Instant::now());
    let sender = std::thread::spawn(move || -> std::io::Result<()> {
        let mut stream = TcpStream::connect(address)?;
        let message = vec![1; message_bytes];
        while begun.elapsed() < duration {
            stream.write_all(&message)?;
        }
        Ok(())
    });
    let (mut stream, _) = listener.accept().context("no connection on loopback")?;
    let (mut message, mut messages) = (vec![0; message_bytes], 0u64);
    loop {
        match stream.read_exact(&mut message) {
            Ok(()) => messages += 1,
            Err(why) if why.kind() == ErrorKind::UnexpectedEof => break,
            Err(why) => return Err(why).context("loopback cannot be read"),
        }
    }
    sender.join().map_err(|_| anyhow::anyhow!("the sender panicked"))?.context("loopback cannot be written")?;
    let (elapsed_s, used_s) = (begun.elapsed().as_secs_f64(), cpu_s(std::process::id()) - cpu_before);
    let megabytes = (messages * message_bytes as u64) as f64 / 1e6;
    Ok([megabytes / elapsed_s, used_s / (megabytes / 1e3).max(1e-9)])
}
