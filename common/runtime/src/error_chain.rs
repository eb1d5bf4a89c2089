//! Error messages with their causes.

use std::{error::Error, iter::successors};

/// Joins the message of `error` and of each of its causes with colons.
#[must_use]
pub fn error_chain(error: &dyn Error) -> String {
    let causes = successors(error.source(), |&cause| cause.source());
    causes.fold(error.to_string(), |text, cause| format!("{text}: {cause}"))
}

#[cfg(test)]
mod tests {
    use std::io;

    use super::*;

    #[derive(Debug, thiserror::Error)]
    #[error("cannot save")]
    struct SaveError(#[source] io::Error);

    #[test]
    fn causes_follow_their_error() {
        assert_eq!(error_chain(&SaveError(io::Error::other("disk full"))), "cannot save: disk full");
    }
}
