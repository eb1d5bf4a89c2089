//! Floods a learner to measure its resistance: `hostile_client ENDPOINT RUN KIND SECONDS [COUNT] [CERTIFICATES]`.
//!
//! KIND is one of those in `tests/hostile/attacks.rs`, or `idle` for silent connections; COUNT bounds the messages. With a
//! folder of certificates the client is an actor. Prints one JSON object. `experiments/security/measure.py` runs it.

#[path = "../tests/hostile/attacks.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod attacks;

use std::{
    io::Write,
    net::TcpStream,
    path::PathBuf,
    time::{Duration, Instant},
};

use attacks::{Attacker, Flood, TIMEOUT};

fn main() -> Result<(), String> {
    let mut args = std::env::args().skip(1);
    let mut next = |what: &str| args.next().ok_or(format!("{what} is missing"));
    let (endpoint, run, kind, seconds) = (next("ENDPOINT")?, next("RUN")?, next("KIND")?, next("SECONDS")?);
    let count: u64 = next("COUNT").map_or(Ok(u64::MAX), |text| text.parse()).map_err(|_| "COUNT is not a number")?;
    let certificates = next("CERTIFICATES").ok().map(PathBuf::from);
    let seconds: f64 = seconds.parse().map_err(|_| "SECONDS is not a number")?;
    let begun = Instant::now();
    let until = begun + Duration::from_secs_f64(seconds);
    let sent = if kind == "idle" {
        idle(&endpoint, count, until)
    } else {
        let known = Flood::ALL.iter().find(|(name, _)| *name == kind);
        let (_, flood) = known.ok_or(format!("unknown KIND `{kind}`"))?;
        let tls = certificates.as_deref().map(|folder| (folder, "actor"));
        let attacker = Attacker::join(&endpoint, &run, tls, TIMEOUT).ok_or("the learner refused the connection")?;
        attacker.flood(*flood, "good", count, until, &attacker.policy())
    };
    let wall_s = begun.elapsed().as_secs_f64();
    let line = format!("{{\"kind\":\"{kind}\",\"sent\":{sent},\"wall_s\":{wall_s:.3}}}\n");
    std::io::stdout().write_all(line.as_bytes()).map_err(|why| why.to_string())
}

/// Opens connections that stay silent. Returns their number.
fn idle(endpoint: &str, count: u64, until: Instant) -> u64 {
    let address = endpoint.split_once('/').map_or(endpoint, |(_, address)| address);
    let (mut opened, mut held) = (0, std::collections::VecDeque::new());
    while opened < count && Instant::now() < until {
        match TcpStream::connect(address) {
            Ok(stream) => {
                held.push_back(stream);
                opened += 1;
            }
            Err(_) => std::thread::sleep(Duration::from_millis(10)),
        }
        if held.len() > 800 {
            held.pop_front();
        }
    }
    opened
}
