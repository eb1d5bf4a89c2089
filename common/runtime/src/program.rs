//! Version of the running program.

use std::sync::OnceLock;

static VERSION: OnceLock<String> = OnceLock::new();

/// Sets the commit that the program was built from; empty if it is unknown. Only the first call counts.
pub fn set_commit(commit: &str) {
    VERSION.get_or_init(|| with_commit(commit));
}

/// Returns the version, with the commit after a plus sign if it is known, as in `0.1.0+1a2b3c4d5`.
pub fn version() -> &'static str {
    VERSION.get_or_init(|| with_commit(""))
}

fn with_commit(commit: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    if commit.is_empty() { version.to_string() } else { format!("{version}+{commit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_commit_counts() {
        set_commit("1a2b3c4d5");
        set_commit("other");
        assert_eq!(version(), format!("{}+1a2b3c4d5", env!("CARGO_PKG_VERSION")));
        assert_eq!(with_commit(""), env!("CARGO_PKG_VERSION"));
    }
}
