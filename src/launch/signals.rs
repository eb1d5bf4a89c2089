//! Ctrl-C, SIGTERM, and SIGHUP from a terminal that was closed: the first requests a stop, the second ends the process.

use std::time::{Duration, Instant};

use tokio::signal::unix::{Signal, SignalKind, signal};
use treadmill_runtime::shutdown::Shutdown;

use crate::launch::output::{self, say_error};

/// Exit code after the second signal: 128 + SIGINT, the convention of shells.
const EXIT_AT_ONCE: i32 = 130;

/// Time in which signals of different kinds are one request.
const SAME_REQUEST: Duration = Duration::from_secs(2);

/// Returns SIGHUP, unless this process was started to ignore it, as by `nohup`.
pub fn hangup() -> std::io::Result<Option<Signal>> {
    // SAFETY: all bytes 0 is a valid value; the call only writes to it.
    let is_ignored = unsafe {
        let mut present: libc::sigaction = std::mem::zeroed();
        libc::sigaction(libc::SIGHUP, std::ptr::null(), &raw mut present) == 0 && present.sa_sigaction == libc::SIG_IGN
    };
    if is_ignored { Ok(None) } else { signal(SignalKind::hangup()).map(Some) }
}

/// Waits for a signal; for ever without one.
pub async fn received(signal: &mut Option<Signal>) {
    match signal {
        Some(signal) => drop(signal.recv().await),
        None => std::future::pending().await,
    }
}

/// Requests a stop at the first signal, and prints `first` unless it is empty. Ends the process at the second signal, unless
/// it is of another kind and follows at once.
pub fn listen(shutdown: Shutdown, first: &'static str) -> std::io::Result<()> {
    let mut interrupt = signal(SignalKind::interrupt())?;
    let mut terminate = signal(SignalKind::terminate())?;
    let mut hangup = hangup()?;
    tokio::spawn(async move {
        let mut asked: Option<(SignalKind, Instant)> = None;
        loop {
            let kind = tokio::select! {
                _ = interrupt.recv() => SignalKind::interrupt(),
                _ = terminate.recv() => SignalKind::terminate(),
                () = received(&mut hangup) => {
                    output::terminal_is_gone();
                    // The shell may send one more, and so may the system.
                    hangup = None;
                    tracing::warn!("the terminal was closed: stopping");
                    SignalKind::hangup()
                }
            };
            match asked {
                // Whatever ends a service signals each of its processes, and its main process passes that on.
                Some((first, at)) if first != kind && at.elapsed() < SAME_REQUEST => continue,
                Some(_) => std::process::exit(EXIT_AT_ONCE),
                None => asked = Some((kind, Instant::now())),
            }
            if !first.is_empty() {
                say_error(first);
            }
            shutdown.ask();
        }
    });
    Ok(())
}
