//! Lag on purpose: policies that are some versions older than the newest, for experiments with what lag does.

use std::{collections::VecDeque, sync::Arc};

use rand::RngExt;
use treadmill_config::Config;
use treadmill_runtime::seeds::{self, Stream};
use treadmill_proto::PolicyVersion;

/// The policies in use so far, as many as may be asked for.
pub struct Staleness<P> {
    fewest: u32,
    most: u32,
    seen: VecDeque<(PolicyVersion, Arc<P>)>,
    random: Stream,
}

impl<P> Staleness<P> {
    /// As `rollout.stale_versions` says; `start` is the number of this process's start.
    pub fn new(config: &Config, actor: &str, start: u64) -> Self {
        let [fewest, most] = config.rollout.stale_versions;
        let random = seeds::stream(config.run.seed, &format!("staleness/{actor}"), &[start]);
        Self { fewest, most, seen: VecDeque::new(), random }
    }

    /// The policy for the next fragment, given the newest: one that was the newest some versions ago, or the oldest that
    /// was seen.
    pub fn choose(&mut self, version: PolicyVersion, newest: Arc<P>) -> Arc<P> {
        if self.most == 0 {
            return newest;
        }
        if self.seen.front().is_none_or(|(seen, _)| *seen != version) {
            self.seen.push_front((version, newest));
            self.seen.truncate(self.most as usize + 1);
        }
        let behind = self.random.random_range(self.fewest..=self.most) as usize;
        self.seen[behind.min(self.seen.len() - 1)].1.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(stale_versions: [u32; 2]) -> Vec<u64> {
        let mut config = Config::default();
        config.rollout.stale_versions = stale_versions;
        let mut staleness = Staleness::new(&config, "actor-0", 0);
        // Each version is there for two fragments.
        let versions = (0..400).map(|fragment| fragment / 2);
        let choose = |number| {
            let behind = staleness.choose(PolicyVersion { incarnation: 1, number }, Arc::new(number));
            number - *behind
        };
        versions.map(choose).collect()
    }

    #[test]
    fn policies_are_as_old_as_asked_for() {
        assert!(chosen([0, 0]).iter().all(|behind| *behind == 0));
        let behind = chosen([1, 3]);
        // Nothing older is there at first.
        assert_eq!(behind[..2], [0, 0]);
        for wanted in 1..=3 {
            let count = behind.iter().filter(|behind| **behind == wanted).count();
            assert!((90..180).contains(&count), "{count} of 400 are {wanted} versions behind");
        }
        assert!(behind[6..].iter().all(|behind| (1..=3).contains(behind)));
        assert_eq!(chosen([1, 3]), behind, "the same seed draws the same");
    }
}
