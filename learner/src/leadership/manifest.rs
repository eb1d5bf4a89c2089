//! Manifest: names the newest state of a run and the learner that wrote it.

use serde::{Deserialize, Serialize};
use treadmill_proto::ident::check_ident;

use super::STATES;

/// Version of the manifest's format.
pub const FORMAT: u32 = 1;
/// Largest manifest that is read, in bytes.
const BYTES_MAX: usize = 64 << 10;

/// Status of a leadership.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The leader trains.
    Training,
    /// The leader has ended by a signal: any other learner may take over at once.
    Released,
    /// An operator has stopped the run.
    Stopped,
    /// The run has all its steps.
    Finished,
}

/// Manifest of a run, one JSON object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of this format.
    pub format: u32,
    /// Name of the run.
    pub run: String,
    /// Term of the leader, which grows with each takeover.
    pub epoch: u64,
    /// Number of the leader's process, in hexadecimal digits.
    pub writer: String,
    /// Updates of the state.
    pub updates: u64,
    /// Environment steps of the state.
    pub env_steps: u64,
    /// Name of the state's object.
    pub state: String,
    /// Status of the leadership.
    pub status: Status,
    /// Host of the leader.
    pub host: String,
    /// Process of the leader.
    pub pid: u32,
    /// Version of the leader's program.
    pub program_version: String,
}

impl Manifest {
    /// Encodes as JSON.
    #[must_use]
    pub fn encode(&self) -> Vec<u8> {
        serde_json::to_vec_pretty(self).expect("a manifest has only texts and numbers")
    }

    /// Decodes and checks untrusted JSON.
    ///
    /// # Errors
    /// What is wrong, with the field.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        if bytes.len() > BYTES_MAX {
            return Err(format!("it has {} bytes; allowed: at most {BYTES_MAX}", bytes.len()));
        }
        let manifest: Self = serde_json::from_slice(bytes).map_err(|why| why.to_string())?;
        if manifest.format != FORMAT {
            return Err(format!("`format` is {}; this version reads {FORMAT}", manifest.format));
        }
        check_ident("run", &manifest.run).map_err(|why| why.to_string())?;
        let name = manifest.state.strip_prefix(STATES).and_then(|rest| rest.strip_prefix('/')).unwrap_or_default();
        if name.is_empty() || name.contains('/') || name.starts_with('.') {
            return Err(format!("`state` is `{}`; allowed: an object directly below {STATES}/", manifest.state));
        }
        Ok(manifest)
    }
}
