//! What the system tells of itself below `/proc` and `/sys`, and what a container may use of it.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// Where `/proc` and `/sys` are.
pub struct System {
    root: PathBuf,
}

impl System {
    /// Of this machine.
    pub fn here() -> Self {
        Self::at(Path::new("/"))
    }

    /// Below another folder, for tests.
    pub fn at(root: &Path) -> Self {
        Self { root: root.to_path_buf() }
    }

    fn read(&self, path: impl AsRef<Path>) -> Option<String> {
        let text = fs::read_to_string(self.root.join(path)).ok()?;
        Some(text.trim().to_string())
    }

    /// Memory that programs could have, in bytes.
    pub fn memory_available(&self) -> Option<u64> {
        let text = self.read("proc/meminfo")?;
        let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
        let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
        Some(kilobytes * 1024)
    }

    /// Processor time that this process's control groups allow, in cores; `None` where there is no limit.
    pub fn cpu_quota(&self) -> Option<f64> {
        let of_two = |text: &str| -> Option<f64> {
            let (quota, period) = text.split_once(' ')?;
            Some(quota.parse::<f64>().ok()? / period.parse::<f64>().ok()?)
        };
        let second = self.unified().into_iter().filter_map(|group| of_two(&self.read(group.join("cpu.max"))?));
        let first = self.controller("cpu").into_iter().filter_map(|group| {
            let number = |file: &str| self.read(group.join(file))?.parse::<f64>().ok();
            // No limit is written as -1.
            let quota = number("cpu.cfs_quota_us").filter(|quota| *quota > 0.0)?;
            Some(quota / number("cpu.cfs_period_us")?)
        });
        second.chain(first).filter(|quota| quota.is_finite()).reduce(f64::min)
    }

    /// Memory that this process's control groups still allow, in bytes; `None` where there is no limit.
    pub fn memory_left_to_group(&self) -> Option<u64> {
        let left = |group: PathBuf, limit: &str, used: &str| -> Option<u64> {
            let number = |file: &str| self.read(group.join(file))?.parse::<u64>().ok();
            // What stands for no limit in the first version is more than any machine has.
            let limit = number(limit).filter(|limit| *limit < 1 << 50)?;
            Some(limit.saturating_sub(number(used).unwrap_or(0)))
        };
        let second = self.unified().into_iter().filter_map(|group| left(group, "memory.max", "memory.current"));
        let first = self
            .controller("memory")
            .into_iter()
            .filter_map(|group| left(group, "memory.limit_in_bytes", "memory.usage_in_bytes"));
        second.chain(first).min()
    }

    /// This process's group of version 2 and all above it; each may have a limit.
    fn unified(&self) -> Vec<PathBuf> {
        self.groups("sys/fs/cgroup", |controllers| controllers.is_empty())
    }

    /// The same of one controller of version 1.
    fn controller(&self, name: &str) -> Vec<PathBuf> {
        let folder = format!("sys/fs/cgroup/{name}");
        self.groups(&folder, |controllers| controllers.split(',').any(|controller| controller == name))
    }

    /// Lines are like `0::/a/b` and `4:memory:/a/b`.
    fn groups(&self, folder: &str, is_it: impl Fn(&str) -> bool) -> Vec<PathBuf> {
        let text = self.read("proc/self/cgroup").unwrap_or_default();
        let mut parts = text.lines().filter_map(|line| {
            let mut fields = line.splitn(3, ':').skip(1);
            Some((fields.next()?, fields.next()?))
        });
        let Some((_, path)) = parts.find(|(controllers, _)| is_it(controllers)) else { return Vec::new() };
        let own = Path::new(path.trim_start_matches('/'));
        own.ancestors().map(|ancestor| Path::new(folder).join(ancestor)).collect()
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A machine made of files.
    pub fn made_of(files: &[(&str, &str)]) -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        for (path, text) in files {
            let path = root.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, format!("{text}\n")).unwrap();
        }
        root
    }

    #[test]
    fn the_tightest_limit_of_all_groups_above_counts() {
        let root = made_of(&[
            ("proc/self/cgroup", "0::/pod/box"),
            ("sys/fs/cgroup/pod/cpu.max", "50000 100000"),
            ("sys/fs/cgroup/pod/box/cpu.max", "max 100000"),
            ("sys/fs/cgroup/pod/memory.max", "max"),
            ("sys/fs/cgroup/pod/box/memory.max", "104857600"),
            ("sys/fs/cgroup/pod/box/memory.current", "4857600"),
        ]);
        let system = System::at(root.path());
        assert_eq!((system.cpu_quota(), system.memory_left_to_group()), (Some(0.5), Some(100_000_000)));
    }

    #[test]
    fn the_first_version_of_control_groups_is_read_too() {
        let root = made_of(&[
            ("proc/self/cgroup", "4:memory:/box\n3:cpu,cpuacct:/box\n0::/"),
            ("sys/fs/cgroup/cpu/box/cpu.cfs_quota_us", "150000"),
            ("sys/fs/cgroup/cpu/box/cpu.cfs_period_us", "100000"),
            ("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1"),
            ("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712"),
            ("sys/fs/cgroup/memory/box/memory.limit_in_bytes", "1000"),
            ("sys/fs/cgroup/memory/box/memory.usage_in_bytes", "1200"),
        ]);
        let system = System::at(root.path());
        assert_eq!((system.cpu_quota(), system.memory_left_to_group()), (Some(1.5), Some(0)));
    }

    #[test]
    fn a_machine_that_tells_nothing_has_no_limits() {
        let root = made_of(&[("proc/meminfo", "MemTotal: 10 kB\nMemAvailable:    2048 kB")]);
        let system = System::at(root.path());
        assert_eq!((system.cpu_quota(), system.memory_left_to_group()), (None, None));
        assert_eq!(system.memory_available(), Some(2 << 20));
    }
}
