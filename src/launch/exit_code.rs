//! Error messages and exit codes: 0 done, 1 failed, 2 wrong usage or configuration.

use std::process::ExitCode;

use treadmill_bus::BusError;
use treadmill_config::ConfigError;
use treadmill_runtime::run_folder::RunFolderError;

/// A mistake in what the user asked for.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

/// Tells the error with all its causes, and what the process exits with.
pub fn exit_code(done: anyhow::Result<()>) -> ExitCode {
    let Err(why) = done else { return ExitCode::SUCCESS };
    crate::launch::output::complain(&format!("error: {}", chain(why.chain())));
    if is_usage(&why) { ExitCode::from(2) } else { ExitCode::from(1) }
}

/// An error and its causes, each message once: some repeat their cause word for word.
pub fn chain(causes: anyhow::Chain) -> String {
    let mut messages: Vec<String> = Vec::new();
    for cause in causes {
        let message = cause.to_string();
        if !messages.iter().any(|told| told.contains(&message)) {
            messages.push(message);
        }
    }
    messages.join(": ")
}

fn is_usage(why: &anyhow::Error) -> bool {
    why.chain().any(|cause| {
        cause.is::<Usage>()
            || cause.is::<ConfigError>()
            || matches!(cause.downcast_ref(), Some(RunFolderError::Missing { .. } | RunFolderError::Taken { .. }))
            || matches!(cause.downcast_ref(), Some(BusError::Endpoint { .. }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usage_is_told_from_failure_and_causes_are_not_repeated() {
        let usage = anyhow::Error::from(ConfigError::SetSyntax { given: "x".into() }).context("while reading flags");
        assert!(is_usage(&usage));
        assert!(chain(usage.chain()).starts_with("while reading flags: `--set x`"));
        assert!(!is_usage(&anyhow::anyhow!("disk full")));
        let repeated = anyhow::anyhow!("disk full").context("cannot save: disk full");
        assert_eq!(chain(repeated.chain()), "cannot save: disk full");
    }
}
