//! Closes a session without waiting for a dead link.
//!
//! `Session::close` can block for ten seconds or longer on a dead link (eclipse-zenoh/zenoh#2675). Delete when it returns
//! promptly, and call it directly.

use std::time::Duration;

use zenoh::{Session, Wait};

/// Time after which the process goes on without the session being closed.
const CLOSE_TIMEOUT: Duration = Duration::from_secs(2);

/// Closes the session, or abandons the attempt after [`CLOSE_TIMEOUT`].
pub(crate) fn close(session: Session) {
    let (done, closed) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let _ = session.close().wait();
        let _ = done.send(());
    });
    if closed.recv_timeout(CLOSE_TIMEOUT).is_err() {
        tracing::debug!(timeout = ?CLOSE_TIMEOUT, "bus session did not close in time");
    }
}
