//! Lag on purpose: policies that are some versions older than the newest, for experiments with what lag does.

use std::{collections::VecDeque, sync::Arc};

use rand::RngExt;
use treadmill_common::{
    config::Config,
    seeds::{self, Stream},
};

use crate::acting::ActingPolicy;

/// The policies in use so far, as many as may be asked for.
pub struct Staleness {
    fewest: u32,
    most: u32,
    seen: VecDeque<Arc<ActingPolicy>>,
    random: Stream,
}

impl Staleness {
    /// As `rollout.stale_versions` says; `start` is the number of this process's start.
    pub fn new(config: &Config, actor: &str, start: u64) -> Self {
        let [fewest, most] = config.rollout.stale_versions;
        let random = seeds::stream(config.run.seed, &format!("staleness/{actor}"), &[start]);
        Self { fewest, most, seen: VecDeque::new(), random }
    }

    /// The policy for the next fragment, given the newest: that of some fragments with other policies ago, or the oldest
    /// there is.
    pub fn choose(&mut self, newest: Arc<ActingPolicy>) -> Arc<ActingPolicy> {
        if self.most == 0 {
            return newest;
        }
        if self.seen.front().is_none_or(|seen| seen.version != newest.version) {
            self.seen.push_front(newest);
            self.seen.truncate(self.most as usize + 1);
        }
        let behind = self.random.random_range(self.fewest..=self.most) as usize;
        self.seen[behind.min(self.seen.len() - 1)].clone()
    }
}
