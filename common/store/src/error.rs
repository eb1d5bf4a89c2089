//! Error of a store.

use std::io;

use crate::location::SCHEMES;

/// Why a store did not do what it was asked to.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The URL names no store.
    #[error("`{url}` names no store: {why}; allowed: {SCHEMES}")]
    Url {
        /// The URL, without credentials.
        url: String,
        /// What is wrong with it.
        why: String,
    },
    /// The environment lacks what the store requires, or has something that it refuses.
    #[error(
        "the store `{store}` cannot be opened: {why}; set its variables, as docs/operations/failover.md lists them"
    )]
    Settings {
        /// URL of the store.
        store: String,
        /// What is wrong.
        why: String,
    },
    /// The object does not exist.
    #[error("the store `{store}` has no object `{name}`")]
    Missing {
        /// URL of the store.
        store: String,
        /// Name of the object.
        name: String,
    },
    /// Another writer was first.
    #[error("another process has written `{name}` in the store `{store}`")]
    Conflict {
        /// URL of the store.
        store: String,
        /// Name of the object.
        name: String,
    },
    /// The store cannot be reached, is full, is read-only, refuses the credentials, or answers with another error.
    #[error("the store `{store}` fails for `{name}`: {why}")]
    Failed {
        /// URL of the store.
        store: String,
        /// Name of the object.
        name: String,
        /// The store's own words.
        why: String,
    },
}

impl StoreError {
    pub(crate) fn missing(name: &str) -> Self {
        Self::Missing { store: String::new(), name: name.to_string() }
    }

    pub(crate) fn conflict(name: &str) -> Self {
        Self::Conflict { store: String::new(), name: name.to_string() }
    }

    pub(crate) fn failed(name: &str, why: impl Into<String>) -> Self {
        Self::Failed { store: String::new(), name: name.to_string(), why: why.into() }
    }

    pub(crate) fn of_file(name: &str, why: &io::Error) -> Self {
        match why.kind() {
            io::ErrorKind::NotFound => Self::missing(name),
            _ => Self::failed(name, why.to_string()),
        }
    }

    pub(crate) fn set_store(&mut self, url: &str) {
        match self {
            Self::Url { .. } => {}
            Self::Settings { store, .. }
            | Self::Missing { store, .. }
            | Self::Conflict { store, .. }
            | Self::Failed { store, .. } => *store = url.to_string(),
        }
    }
}
