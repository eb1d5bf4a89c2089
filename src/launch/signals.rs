//! Ctrl-C and SIGTERM: the first requests a stop, the second ends the process.

use tokio::signal::unix::{SignalKind, signal};
use treadmill_runtime::shutdown::Shutdown;

use crate::launch::output::say_error;

/// Exit code after the second signal: 128 + SIGINT, the convention of shells.
const EXIT_AT_ONCE: i32 = 130;

/// Requests a stop at the first signal, and prints `first` unless it is empty. Ends the process at the second signal.
pub fn listen(shutdown: Shutdown, first: &'static str) -> std::io::Result<()> {
    let mut interrupt = signal(SignalKind::interrupt())?;
    let mut terminate = signal(SignalKind::terminate())?;
    tokio::spawn(async move {
        let mut asked = false;
        loop {
            tokio::select! {
                _ = interrupt.recv() => {}
                _ = terminate.recv() => {}
            }
            if asked {
                std::process::exit(EXIT_AT_ONCE);
            }
            asked = true;
            if !first.is_empty() {
                say_error(first);
            }
            shutdown.ask();
        }
    });
    Ok(())
}
