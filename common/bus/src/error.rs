//! Errors of the bus.

/// Error of the bus.
#[derive(Debug, thiserror::Error)]
pub enum BusError {
    /// An endpoint is refused.
    #[error("endpoint `{endpoint}`: {why}")]
    Endpoint {
        /// The endpoint as given.
        endpoint: String,
        /// Cause and remedy.
        why: String,
    },
    /// An endpoint cannot be listened on.
    #[error("cannot listen on `{endpoint}`: {why}; choose another port with --listen, or port 0 for any free one")]
    Listen {
        /// The endpoint as given.
        endpoint: String,
        /// The system's error.
        why: String,
    },
    /// The process may open too few files.
    #[error(
        "this process may open {limit} files, but the bus needs {needed}; raise the limit with `ulimit -Hn 4096`, \
         LimitNOFILE=4096 in systemd, or `docker run --ulimit nofile=4096`"
    )]
    OpenFiles {
        /// The limit.
        limit: u64,
        /// The smallest limit that suffices.
        needed: u64,
    },
    /// Zenoh refused a setting.
    #[error("{what}: {why}")]
    Config {
        /// The setting.
        what: String,
        /// Zenoh's error.
        why: String,
    },
    /// The session could not be opened.
    #[error("cannot open the bus: {why}")]
    Open {
        /// Zenoh's error.
        why: String,
    },
    /// A declaration, query or publication failed.
    #[error("{what} failed on the bus: {why}")]
    Flow {
        /// The operation.
        what: String,
        /// Zenoh's error.
        why: String,
    },
}

impl BusError {
    pub(crate) fn flow(what: impl Into<String>) -> impl FnOnce(zenoh::Error) -> Self {
        let what = what.into();
        move |error| Self::Flow { what, why: error.to_string() }
    }
}
