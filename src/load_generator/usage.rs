//! What this process has used: processor time and memory.

/// Seconds of processor time, in user and system mode, of all threads.
pub(super) fn cpu_s() -> f64 {
    // SAFETY: an all-zero rusage is a valid value, and the call writes nothing else.
    let used = unsafe {
        let mut used: libc::rusage = std::mem::zeroed();
        libc::getrusage(libc::RUSAGE_SELF, &mut used);
        used
    };
    let seconds = |time: libc::timeval| time.tv_sec as f64 + time.tv_usec as f64 / 1e6;
    seconds(used.ru_utime) + seconds(used.ru_stime)
}

/// The most memory that was in RAM at any time, in MB; zero where the system does not tell.
pub(super) fn resident_max_mb() -> f64 {
    told_mb("VmHWM:")
}

/// Memory in RAM that other processes have too, in MB: that of shared memory.
pub(super) fn shared_mb() -> f64 {
    told_mb("RssShmem:")
}

fn told_mb(what: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(what));
    let kib: Option<f64> = line.and_then(|rest| rest.trim().trim_end_matches("kB").trim().parse().ok());
    kib.unwrap_or(0.0) * 1024.0 / 1e6
}

/// Largest number of descriptors that may be open: hundreds of connections need more than many systems give at first.
pub(super) fn allow_many_connections() {
    // SAFETY: both calls read or write the one struct that they are given.
    unsafe {
        let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
        if libc::getrlimit(libc::RLIMIT_NOFILE, &mut limit) == 0 {
            limit.rlim_cur = limit.rlim_max;
            libc::setrlimit(libc::RLIMIT_NOFILE, &limit);
        }
    }
}
