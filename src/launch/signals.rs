//! Ctrl-C and SIGTERM: the first asks to stop, the second ends the process.

use tokio::signal::unix::{SignalKind, signal};
use treadmill_runtime::shutdown::Shutdown;

use crate::launch::output::complain;

/// Exit code after the second Ctrl-C: 128 + SIGINT, as shells have it.
const EXIT_AT_ONCE: i32 = 130;

/// Asks to stop at the first signal and ends the process at the second.
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
                complain(first);
            }
            shutdown.ask();
        }
    });
    Ok(())
}
