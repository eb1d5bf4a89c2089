//! Throughput of plain TCP: the same messages over one loopback connection.

use std::{
    io::{ErrorKind, Read, Write},
    net::{TcpListener, TcpStream},
    time::{Duration, Instant},
};

use anyhow::Context;

use crate::usage;

/// Measurement of plain TCP.
#[derive(Clone, Copy, Debug)]
pub struct Raw {
    pub mb_per_s: f64,
    /// Of both ends together.
    pub cpu_s_per_gb: f64,
}

impl Raw {
    /// Returns the mean of two measurements.
    pub fn mean(self, other: Self) -> Self {
        Self {
            mb_per_s: (self.mb_per_s + other.mb_per_s) / 2.0,
            cpu_s_per_gb: (self.cpu_s_per_gb + other.cpu_s_per_gb) / 2.0,
        }
    }
}

/// Sends messages of this size for `duration`. The receiver reads each into the same buffer.
pub fn measure(message_bytes: usize, duration: Duration) -> anyhow::Result<Raw> {
    let listener = TcpListener::bind("127.0.0.1:0").context("no port on loopback")?;
    let address = listener.local_addr().context("no address on loopback")?;
    let (cpu_before, begun) = (usage::cpu_s(), Instant::now());
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
    let (elapsed_s, cpu_s) = (begun.elapsed().as_secs_f64(), usage::cpu_s() - cpu_before);
    sender.join().map_err(|_| anyhow::anyhow!("the sender panicked"))?.context("loopback cannot be written")?;
    let bytes = (messages * message_bytes as u64) as f64;
    Ok(Raw { mb_per_s: bytes / 1e6 / elapsed_s, cpu_s_per_gb: cpu_s / (bytes / 1e9).max(1e-9) })
}
