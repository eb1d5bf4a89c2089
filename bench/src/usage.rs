//! Processor time and memory of this process.

/// Returns the processor time of all threads in seconds, user and system mode.
pub fn cpu_s() -> f64 {
    // SAFETY: an all-zero rusage is a valid value, and the call writes nothing else.
    let used = unsafe {
        let mut used: libc::rusage = std::mem::zeroed();
        libc::getrusage(libc::RUSAGE_SELF, &mut used);
        used
    };
    let seconds = |time: libc::timeval| time.tv_sec as f64 + time.tv_usec as f64 / 1e6;
    seconds(used.ru_utime) + seconds(used.ru_stime)
}

/// Returns the peak of resident memory in MB; zero if unknown.
pub fn resident_max_mb() -> f64 {
    status_mb("VmHWM:")
}

/// Returns the resident shared memory in MB.
pub fn shared_mb() -> f64 {
    status_mb("RssShmem:")
}

fn status_mb(entry: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(entry));
    let kib: Option<f64> = line.and_then(|rest| rest.trim().trim_end_matches("kB").trim().parse().ok());
    kib.unwrap_or(0.0) * 1024.0 / 1e6
}

/// Raises the limit of open files to the maximum, for hundreds of connections.
pub fn allow_many_connections() {
    // A lower limit shows as an error of the connection.
    let _ = rlimit::increase_nofile_limit(u64::MAX);
}
