//! Closes links at once, whatever their other end does.
//!
//! Zenoh sets `SO_LINGER` of each link to 10 s. Closing a link whose other end is cut off then blocks the closing
//! thread until that time is over, and with it all other links of a process that has one thread for them
//! ([`super::threads`]). No upstream issue is known. Delete when Zenoh has a setting for it.
//!
//! Zenoh does not hand out its sockets, and its time is a constant of its build (`option_env!` in `zenoh-link-tcp`),
//! which the shortest value, 1 s, would make a wait for each dead peer in turn. So a thread looks for sockets with
//! exactly Zenoh's time; nothing else here sets that option. A learner with 8 actors (18 sockets) spent 0.3 ms of
//! processor time a second on it.

use std::sync::Once;

/// Starts a thread that takes the option back from new connections. Call it again as often as you like.
pub(crate) fn keep_off() {
    static STARTED: Once = Once::new();
    #[cfg(target_os = "linux")]
    STARTED.call_once(|| {
        if let Err(error) = std::thread::Builder::new().name("linger".to_string()).spawn(linux::keep_off) {
            tracing::debug!(%error, "links may close slowly");
        }
    });
}

#[cfg(target_os = "linux")]
mod linux {
    use std::{collections::HashSet, fs, mem, path::PathBuf, time::Duration};

    /// Interval of looking for new connections: shorter than the lease after which a silent link is closed.
    const EVERY: Duration = Duration::from_secs(1);

    pub(super) fn keep_off() {
        let mut known = HashSet::new();
        loop {
            let open = sockets();
            for (file, socket) in &open {
                if !known.contains(socket) {
                    take_back(*file);
                }
            }
            known = open.into_iter().map(|(_, socket)| socket).collect();
            std::thread::sleep(EVERY);
        }
    }

    /// Returns the number and the name of each open socket of this process.
    pub(super) fn sockets() -> Vec<(libc::c_int, PathBuf)> {
        let entries = fs::read_dir("/proc/self/fd").into_iter().flatten().flatten();
        let socket = |entry: fs::DirEntry| {
            let name = fs::read_link(entry.path()).ok().filter(|name| name.to_string_lossy().starts_with("socket:"))?;
            Some((entry.file_name().to_str()?.parse().ok()?, name))
        };
        entries.filter_map(socket).collect()
    }

    /// Time that Zenoh sets.
    pub(super) const ZENOH_S: libc::c_int = 10;

    /// Clears the option of a socket that has it from Zenoh. Any other file at this number, which may have been closed
    /// meanwhile, refuses.
    pub(super) fn take_back(file: libc::c_int) {
        let mut option = libc::linger { l_onoff: 0, l_linger: 0 };
        let mut size = mem::size_of::<libc::linger>() as libc::socklen_t;
        // SAFETY: the option and its size live until the call returns, and have the types that the option has.
        let read = unsafe {
            libc::getsockopt(file, libc::SOL_SOCKET, libc::SO_LINGER, (&raw mut option).cast(), &raw mut size)
        };
        if read == 0 && option.l_onoff != 0 && option.l_linger == ZENOH_S {
            option = libc::linger { l_onoff: 0, l_linger: 0 };
            // SAFETY: as above.
            unsafe { libc::setsockopt(file, libc::SOL_SOCKET, libc::SO_LINGER, (&raw const option).cast(), size) };
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::{mem, net::TcpListener, net::TcpStream, os::fd::AsRawFd};

    use super::linux::{ZENOH_S, sockets, take_back};

    fn set(stream: &TcpStream, seconds: libc::c_int) {
        let option = libc::linger { l_onoff: 1, l_linger: seconds };
        let size = mem::size_of::<libc::linger>() as libc::socklen_t;
        // SAFETY: the option lives until the call returns, and has the type that the option has.
        let done = unsafe {
            libc::setsockopt(stream.as_raw_fd(), libc::SOL_SOCKET, libc::SO_LINGER, (&raw const option).cast(), size)
        };
        assert_eq!(done, 0);
    }

    fn is_set(stream: &TcpStream) -> bool {
        let mut option = libc::linger { l_onoff: 0, l_linger: 0 };
        let mut size = mem::size_of::<libc::linger>() as libc::socklen_t;
        // SAFETY: as above.
        let done = unsafe {
            libc::getsockopt(
                stream.as_raw_fd(),
                libc::SOL_SOCKET,
                libc::SO_LINGER,
                (&raw mut option).cast(),
                &raw mut size,
            )
        };
        assert_eq!(done, 0);
        option.l_onoff != 0
    }

    #[test]
    fn an_open_connection_loses_the_option() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let stream = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        set(&stream, ZENOH_S + 1);
        take_back(stream.as_raw_fd());
        assert!(is_set(&stream), "a time that is not Zenoh's stays");
        set(&stream, ZENOH_S);
        let found = sockets();
        assert!(found.iter().any(|(file, _)| *file == stream.as_raw_fd()), "{found:?}");
        take_back(stream.as_raw_fd());
        assert!(!is_set(&stream));
        // No socket: nothing happens.
        take_back(std::fs::File::open("/proc/self/stat").unwrap().as_raw_fd());
    }
}
