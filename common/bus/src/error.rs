//! Errors of the bus.

/// Why the bus cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum BusError {
    /// An endpoint is not acceptable.
    #[error("endpoint `{endpoint}`: {why}")]
    Endpoint {
        /// As given.
        endpoint: String,
        /// What is wrong and what to do.
        why: String,
    },
    /// An endpoint cannot be listened on.
    #[error("cannot listen on `{endpoint}`: {why}; choose another port with --listen, or port 0 for any free one")]
    Listen {
        /// As given.
        endpoint: String,
        /// What the system said.
        why: String,
    },
    /// The process may open too few files.
    #[error(
        "this process may have {limit} files open, and the bus needs {needed}: raise the limit, as by `ulimit -Hn 4096`, \
         LimitNOFILE=4096 in systemd, or `docker run --ulimit nofile=4096`"
    )]
    OpenFiles {
        /// The limit.
        limit: u64,
        /// What is needed at least.
        needed: u64,
    },
    /// A setting was refused.
    #[error("{what}: {why}")]
    Config {
        /// Which setting.
        what: String,
        /// What the bus said.
        why: String,
    },
    /// The session could not be opened.
    #[error("the bus cannot be opened: {why}")]
    Open {
        /// What the bus said.
        why: String,
    },
    /// A declaration, query or publication failed.
    #[error("{what} failed on the bus: {why}")]
    Flow {
        /// What was tried.
        what: String,
        /// What the bus said.
        why: String,
    },
}

impl BusError {
    pub(crate) fn flow(what: impl Into<String>) -> impl FnOnce(zenoh::Error) -> Self {
        let what = what.into();
        move |why| Self::Flow { what, why: why.to_string() }
    }
}
