//! Policy versions that the newest one descends from.

use serde::{Deserialize, Serialize};
use treadmill_proto::PolicyVersion;

/// Earlier incarnations that are kept; fragments of older ones exceed any allowed lag.
const BRANCHES_MAX: usize = 64;

/// Newest version, and for each earlier incarnation the last version that it descends from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lineage {
    branches: Vec<PolicyVersion>,
    newest: PolicyVersion,
}

/// Relation of a fragment's version to the newest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Descent {
    /// An ancestor, or the newest itself, with the number of versions between them.
    Lag(u64),
    /// Never durable, or not of this run.
    Vanished,
    /// A later version of this learner, which does not exist yet.
    Future,
}

impl Lineage {
    /// Lineage of a new run.
    pub fn new(incarnation: u64) -> Self {
        Self { branches: Vec::new(), newest: PolicyVersion::new(incarnation, 0) }
    }

    /// Newest version.
    pub fn newest(&self) -> PolicyVersion {
        self.newest
    }

    /// Sets the epoch of the newest and all later versions.
    pub fn set_epoch(&mut self, epoch: u64) {
        self.newest.epoch = epoch;
    }

    /// Advances by one update.
    pub fn advance(&mut self) {
        self.newest.number += 1;
    }

    /// Continues under a new incarnation; version numbers continue.
    pub fn resume(&mut self, incarnation: u64) {
        self.branches.push(self.newest);
        if self.branches.len() > BRANCHES_MAX {
            self.branches.remove(0);
        }
        self.newest.incarnation = incarnation;
    }

    /// Returns the relation of `version` to the newest.
    pub fn descent(&self, version: PolicyVersion) -> Descent {
        let last = if version.incarnation == self.newest.incarnation {
            Some(self.newest.number)
        } else {
            let branch = self.branches.iter().rev().find(|branch| branch.incarnation == version.incarnation);
            branch.map(|branch| branch.number)
        };
        match last {
            Some(last) if version.number <= last => Descent::Lag(self.newest.number - version.number),
            _ if version.incarnation == self.newest.incarnation => Descent::Future,
            _ => Descent::Vanished,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn version(incarnation: u64, number: u64) -> PolicyVersion {
        PolicyVersion::new(incarnation, number)
    }

    #[test]
    fn lag_counts_across_a_resume_and_vanished_versions_are_detected() {
        let mut lineage = Lineage::new(7);
        (0..5).for_each(|_| lineage.advance());
        assert_eq!(lineage.descent(version(7, 3)), Descent::Lag(2));
        assert_eq!(lineage.descent(version(7, 6)), Descent::Future);
        // The first learner reached version 8; its successor resumed from the checkpoint of version 5.
        lineage.resume(9);
        lineage.advance();
        assert_eq!(lineage.newest(), version(9, 6));
        assert_eq!(lineage.descent(version(7, 5)), Descent::Lag(1));
        assert_eq!(lineage.descent(version(7, 6)), Descent::Vanished);
        assert_eq!(lineage.descent(version(8, 1)), Descent::Vanished);
    }

    #[test]
    fn memory_is_bounded() {
        let mut lineage = Lineage::new(0);
        (1..200).for_each(|incarnation| lineage.resume(incarnation));
        assert_eq!(lineage.branches.len(), BRANCHES_MAX);
    }
}
