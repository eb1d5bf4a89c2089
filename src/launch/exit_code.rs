//! Error messages and exit codes: 0 done, 1 failed, 2 wrong usage or configuration.

use std::{path::Path, process::ExitCode};

use treadmill_bus::BusError;
use treadmill_config::ConfigError;
use treadmill_runtime::{atomic_file, error_chain, run_folder::RunFolderError};

use crate::launch::output::say_error;

/// Mistake in arguments or configuration.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

impl Usage {
    /// Returns an error if the file of a flag cannot be written. Work that takes long asks first.
    pub fn unless_writable(flag: &str, path: Option<&Path>) -> Result<(), Self> {
        let refused = |path: &Path, why| Self(format!("{flag} {}: it cannot be written: {why}", path.display()));
        path.map_or(Ok(()), |path| atomic_file::check(path).map_err(|why| refused(path, why)))
    }
}

/// Prints an error with all its causes, and returns the exit code of the process.
pub fn exit_code(done: anyhow::Result<()>) -> ExitCode {
    let Err(why) = done else { return ExitCode::SUCCESS };
    say_error(&format!("error: {}", error_chain(why.as_ref())));
    if is_usage(&why) { ExitCode::from(2) } else { ExitCode::from(1) }
}

fn is_usage(why: &anyhow::Error) -> bool {
    why.chain().any(|cause| {
        cause.is::<Usage>()
            || cause.is::<ConfigError>()
            || matches!(
                cause.downcast_ref(),
                Some(
                    RunFolderError::Missing { .. }
                        | RunFolderError::Unreadable { .. }
                        | RunFolderError::Taken { .. }
                        | RunFolderError::InUse { .. }
                )
            )
            || matches!(cause.downcast_ref(), Some(BusError::Endpoint { .. }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usage_errors_are_recognised_below_their_context() {
        let usage = anyhow::Error::from(ConfigError::SetSyntax { given: "x".into() }).context("cannot read flags");
        assert!(is_usage(&usage));
        assert!(!is_usage(&anyhow::anyhow!("disk full").context("cannot save")));
    }
}
