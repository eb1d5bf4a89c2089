//! Facts about this machine, for benchmarks and status reports.

use std::path::Path;

/// Returns the CPU's name, or the architecture if the system does not report one.
pub fn cpu_name() -> String {
    let named = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        text.lines()
            .find(|line| line.starts_with("model name") || line.starts_with("Model"))
            .and_then(|line| line.split_once(':'))
            .map(|(_, name)| name.trim().to_string())
    });
    named.unwrap_or_else(|| format!("{} ({})", std::env::consts::ARCH, std::env::consts::OS))
}

/// Returns the number of cores that this process may use.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, |cores| cores.get())
}

/// Returns the number of threads that a setting or a flag asks for; 0 means one per core.
pub fn threads(wanted: usize) -> usize {
    if wanted == 0 { cores() } else { wanted }
}

/// Returns the memory that this process and its siblings may use together (bytes): that of the machine, or less by a control
/// group of version 2, as in a container. `None` where the system does not report it.
pub fn memory_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let total = line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? * 1024;
    let group = std::fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
    Some(group_limit_bytes(Path::new("/sys/fs/cgroup"), &group).map_or(total, |limit| limit.min(total)))
}

/// Returns the smallest `memory.max` of a process's group and those above it. `group` is the text of `/proc/PID/cgroup`.
fn group_limit_bytes(root: &Path, group: &str) -> Option<u64> {
    let path = group.lines().find_map(|line| line.strip_prefix("0::"))?;
    let own = root.join(path.trim_start_matches('/'));
    let groups = own.ancestors().take_while(|folder| folder.starts_with(root));
    // `max` is no limit.
    let limit = |folder: &Path| std::fs::read_to_string(folder.join("memory.max")).ok()?.trim().parse().ok();
    groups.filter_map(limit).min()
}

/// Returns the host's name, or `unknown`.
pub fn host_name() -> String {
    std::fs::read_to_string("/proc/sys/kernel/hostname")
        .ok()
        .or_else(|| std::env::var("HOSTNAME").ok())
        .map(|name| name.trim().to_string())
        .filter(|name| !name.is_empty())
        .unwrap_or_else(|| "unknown".to_string())
}

/// Returns the resident memory of this process in bytes; zero if the system does not report it.
pub fn resident_bytes() -> u64 {
    std::fs::read_to_string("/proc/self/statm")
        .ok()
        .and_then(|text| text.split_whitespace().nth(1).and_then(|pages| pages.parse::<u64>().ok()))
        .map_or(0, |pages| pages * 4096)
}

/// Returns the seconds since 1970, for display only; learning must not depend on it.
pub fn time_unix_s() -> f64 {
    std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0.0, |since| since.as_secs_f64())
}

/// Returns whether the locale uses UTF-8, so that non-ASCII text can be shown. The first of `LC_ALL`, `LC_CTYPE` and `LANG`
/// that is set decides, as in POSIX.
pub fn is_utf8_locale() -> bool {
    is_utf8(["LC_ALL", "LC_CTYPE", "LANG"].into_iter().filter_map(|name| std::env::var(name).ok()))
}

fn is_utf8(mut set: impl Iterator<Item = String>) -> bool {
    let locale = set.find(|value| !value.is_empty()).unwrap_or_default().to_lowercase();
    locale.contains("utf-8") || locale.contains("utf8")
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_first_variable_that_is_set_decides() {
        let is_utf8 = |set: &[&str]| super::is_utf8(set.iter().map(ToString::to_string));
        assert!(is_utf8(&["", "de_DE.UTF-8", "C"]) && is_utf8(&["C.utf8"]));
        assert!(!is_utf8(&[]) && !is_utf8(&["C", "de_DE.UTF-8"]) && !is_utf8(&["POSIX"]));
    }

    #[test]
    fn the_tightest_control_group_limits_the_memory() {
        let root = tempfile::tempdir().unwrap();
        let own = root.path().join("system/job");
        std::fs::create_dir_all(&own).unwrap();
        let limit = || super::group_limit_bytes(root.path(), "1:cpu:/old\n0::/system/job\n");
        assert_eq!(limit(), None);
        std::fs::write(own.join("memory.max"), "max\n").unwrap();
        std::fs::write(root.path().join("system/memory.max"), "2147483648\n").unwrap();
        assert_eq!(limit(), Some(2 << 30), "of the group above");
        std::fs::write(own.join("memory.max"), "1048576\n").unwrap();
        assert_eq!(limit(), Some(1 << 20));
        assert_eq!(super::group_limit_bytes(root.path(), "1:cpu:/old\n"), None, "version 1");
        assert!(super::memory_bytes().is_none_or(|bytes| bytes > 1 << 20));
    }

    #[test]
    fn the_machine_has_a_name_and_a_core() {
        assert!(!super::cpu_name().is_empty());
        assert!(super::cores() >= 1);
        assert!(!super::host_name().contains('\n'));
    }
}
