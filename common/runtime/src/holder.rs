//! Process that has the lock of a run's folder.

use std::{fmt, fs, path::Path};

use serde_json::Value;

/// Process that writes into a run's folder.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Holder {
    /// Its number; `None` if the lock's file does not say.
    pub pid: Option<u32>,
    /// Its host.
    pub host: String,
    /// Endpoint on which it listens, once it does.
    pub endpoint: String,
    /// Its epoch; 0 if the lock's file does not say.
    pub epoch: u64,
    /// Whether it has not said that it ended.
    pub is_left_behind: bool,
}

impl Holder {
    /// Reads the file of a lock. What it does not say has its default.
    pub(crate) fn read(lock: &Path) -> Self {
        // The holder may be writing it now.
        let text = fs::read_to_string(lock).unwrap_or_default();
        let value: Value = serde_json::from_str(&text).unwrap_or_default();
        let text = |key: &str| value[key].as_str().unwrap_or_default().to_string();
        let pid = value["pid"].as_u64().and_then(|pid| u32::try_from(pid).ok());
        let epoch = value["epoch"].as_u64().unwrap_or_default();
        let is_left_behind = value["ended"].as_bool() == Some(false);
        Self { pid, host: text("host"), endpoint: text("endpoint"), epoch, is_left_behind }
    }
}

impl fmt::Display for Holder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(pid) = self.pid else { return write!(f, "another process") };
        write!(f, "process {pid} on host {}", self.host)?;
        if self.endpoint.is_empty() { Ok(()) } else { write!(f, ", which listens on {}", self.endpoint) }
    }
}
