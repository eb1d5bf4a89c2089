//! Terms of the reward over a batch.

use std::collections::{BTreeMap, BTreeSet};

use treadmill_ppo::AcceptedFragment;
use treadmill_proto::limits::REWARD_TERMS_MAX;

/// Terms of the reward that a run has logged. Their number is bounded, because actors choose the names.
#[derive(Debug, Default)]
pub struct RewardTerms {
    known: BTreeSet<String>,
}

impl RewardTerms {
    /// Returns the tag of each term and its mean over the transitions of the fragments that have it.
    pub fn of(&mut self, batch: &[AcceptedFragment]) -> Vec<(String, f64)> {
        let mut sums: BTreeMap<&str, (f64, f64)> = BTreeMap::new();
        for accepted in batch {
            let transitions = accepted.fragment.transitions() as f64;
            for term in &accepted.fragment.reward_terms {
                if !self.known.contains(&term.name) {
                    if self.known.len() >= REWARD_TERMS_MAX {
                        continue;
                    }
                    self.known.insert(term.name.clone());
                }
                let (sum, count) = sums.entry(&term.name).or_default();
                *sum += term.mean * transitions;
                *count += transitions;
            }
        }
        sums.into_iter().map(|(name, (sum, count))| (format!("rewards/{name}"), sum / count)).collect()
    }
}

#[cfg(test)]
mod tests {
    use treadmill_proto::{Fragment, RewardTerm};

    use super::*;

    fn accepted(envs: u32, terms: &[(&str, f64)]) -> AcceptedFragment {
        let reward_terms = terms.iter().map(|(name, mean)| RewardTerm { name: (*name).to_owned(), mean: *mean });
        let fragment = Fragment { steps: 2, envs, reward_terms: reward_terms.collect(), ..Fragment::default() };
        AcceptedFragment { fragment, lag: 0 }
    }

    #[test]
    fn means_are_over_the_transitions_that_have_the_term() {
        let batch = [
            accepted(1, &[("alive", 1.0), ("feet_slip", -0.5)]),
            accepted(3, &[("alive", 2.0)]),
            // An actor of an older version.
            accepted(8, &[]),
        ];
        let wanted = [("rewards/alive".to_owned(), 1.75), ("rewards/feet_slip".to_owned(), -0.5)];
        assert_eq!(RewardTerms::default().of(&batch), wanted);
    }

    #[test]
    fn new_names_are_ignored_once_there_are_many() {
        let mut terms = RewardTerms::default();
        for index in 0..2 * REWARD_TERMS_MAX {
            let logged = terms.of(&[accepted(1, &[(&format!("term_{index}"), 1.0), ("term_0", 1.0)])]).len();
            assert_eq!(logged, if index == 0 || index >= REWARD_TERMS_MAX { 1 } else { 2 }, "term {index}");
        }
    }
}
