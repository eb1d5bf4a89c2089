//! Versions of a policy.

use crate::Malformed;

pub use crate::wire::PolicyVersion;

impl PolicyVersion {
    /// Version of an unknown epoch.
    #[must_use]
    pub const fn new(incarnation: u64, number: u64) -> Self {
        Self { incarnation, number, epoch: 0 }
    }

    /// Whether both name the same policy, which incarnation and number identify: a checkpoint does not hold the epoch.
    #[must_use]
    pub const fn names_same_policy(self, other: Self) -> bool {
        self.incarnation == other.incarnation && self.number == other.number
    }

    /// Whether this version is certainly older than the other one: of a lower term, or of a lower number in the same term.
    #[must_use]
    pub const fn is_before(self, other: Self) -> bool {
        let is_known = self.epoch != 0 && other.epoch != 0;
        is_known && (self.epoch < other.epoch || self.epoch == other.epoch && self.number < other.number)
    }
}

/// Refuses a message without its version.
pub(crate) fn required(version: Option<PolicyVersion>) -> Result<PolicyVersion, Malformed> {
    version.ok_or_else(|| Malformed::field("version", "missing", "a policy version"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_versions_of_known_terms_have_an_order() {
        let version = |epoch, number| PolicyVersion { epoch, ..PolicyVersion::new(1, number) };
        assert!(version(2, 5).is_before(version(2, 6)) && version(2, 9).is_before(version(3, 1)));
        for (one, other) in [((2, 6), (2, 6)), ((2, 6), (2, 5)), ((3, 1), (2, 9)), ((0, 1), (2, 9)), ((2, 1), (0, 9))] {
            assert!(!version(one.0, one.1).is_before(version(other.0, other.1)), "{one:?} {other:?}");
        }
    }
}
