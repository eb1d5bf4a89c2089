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
        move |error| Self::Flow { what, why: in_words(&error) }
    }
}

/// Returns Zenoh's error without the places in its source, `at FILE:LINE.`, which follow each cause.
pub(crate) fn in_words(error: &zenoh::Error) -> String {
    let text = error.to_string();
    let mut words = String::with_capacity(text.len());
    let mut rest = &text[..];
    while let Some(at) = rest.find(" at ") {
        let (before, place) = (&rest[..at], &rest[at + 4..]);
        words.push_str(before);
        let end = place.find(".rs:").map(|file| file + 4).filter(|&line| !place[..line].contains(' '));
        rest = match end {
            Some(line) => place[line..].trim_start_matches(|c: char| c.is_ascii_digit()).trim_start_matches('.'),
            None => {
                words.push_str(" at ");
                place
            }
        };
    }
    words + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_do_not_name_source_files() {
        let error = zenoh::key_expr::KeyExpr::new("a//b").unwrap_err();
        assert!(error.to_string().contains(".rs:"), "{error}");
        let words = in_words(&error);
        assert!(!words.contains(".rs:") && words.contains("a//b"), "{words}");
        let text = "first cause at /a/b.rs:12. - Caused by second at noon at /c-1.0/d.rs:3.";
        assert_eq!(in_words(&text.into()), "first cause - Caused by second at noon");
    }
}
