//! Curricula that the environments of a run have reached, from which new ones begin.

use std::collections::{BTreeMap, VecDeque};

use serde::{Deserialize, Serialize};
use treadmill_proto::{Episode, PolicyBundle};

/// Episodes that are kept of each kind of ground, of factors, and of failures.
const WINDOW: usize = 128;

/// Levels and factors of the last episodes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Curricula {
    /// Levels by kind of ground.
    levels: BTreeMap<u32, VecDeque<u32>>,
    /// Factors on the ranges of commands.
    factors: VecDeque<f32>,
    /// Control steps, counted over all motions, at which they were not imitated.
    failures: VecDeque<u32>,
}

impl Curricula {
    /// Adds the episodes of a fragment.
    pub fn extend<'a>(&mut self, episodes: impl IntoIterator<Item = &'a Episode>) {
        for episode in episodes {
            if let (Some(kind), Some(level)) = (episode.ground_kind, episode.ground_level) {
                push(self.levels.entry(kind).or_default(), level as u32);
            }
            if let Some(factor) = episode.command_factor {
                push(&mut self.factors, factor as f32);
            }
            if let Some(step) = episode.failed_step {
                push(&mut self.failures, step);
            }
        }
    }

    /// Adds them to a bundle, for actors that join.
    #[must_use]
    pub fn in_bundle(&self, bundle: PolicyBundle) -> PolicyBundle {
        let pairs = self.levels.iter().flat_map(|(kind, levels)| levels.iter().map(|level| (*kind, *level)));
        let (curriculum_kinds, curriculum_levels) = pairs.unzip();
        let curriculum_factors = self.factors.iter().copied().collect();
        let curriculum_failures = self.failures.iter().copied().collect();
        PolicyBundle { curriculum_kinds, curriculum_levels, curriculum_factors, curriculum_failures, ..bundle }
    }

    /// Returns the entropy (nat) of the failures over the seconds of all motions, of control steps of this duration; `None`
    /// without failures.
    #[must_use]
    pub fn failure_entropy(&self, control_step_s: f64) -> Option<f64> {
        let mut seconds: BTreeMap<u64, f64> = BTreeMap::new();
        for step in &self.failures {
            *seconds.entry((f64::from(*step) * control_step_s) as u64).or_default() += 1.0 / self.failures.len() as f64;
        }
        (!seconds.is_empty()).then(|| -seconds.values().map(|share| share * share.ln()).sum::<f64>())
    }
}

fn push<T>(window: &mut VecDeque<T>, newest: T) {
    if window.len() == WINDOW {
        window.pop_front();
    }
    window.push_back(newest);
}

#[cfg(test)]
mod tests {
    use treadmill_proto::EndCause;

    use super::*;

    #[test]
    fn the_last_episodes_of_each_kind_are_kept() {
        let episode = |ground_kind, ground_level, command_factor, failed_step| Episode {
            return_sum: 0.0,
            length: 1,
            distance_m: 0.0,
            velocity_mean_mps: 0.0,
            cause: EndCause::Fell,
            ground_kind,
            ground_level,
            command_factor,
            failed_step,
        };
        let mut curricula = Curricula::default();
        curricula.extend(&[episode(None, None, None, None)]);
        assert_eq!(curricula, Curricula::default());
        curricula.extend(&vec![episode(Some(2), Some(7.0), Some(0.5), None); 200]);
        curricula.extend(&[episode(Some(0), Some(3.0), None, None), episode(Some(2), Some(8.0), Some(0.75), None)]);
        let bundle = curricula.in_bundle(PolicyBundle::default());
        assert_eq!(bundle.curriculum_kinds, [&[0][..], &[2; 128]].concat());
        assert_eq!(bundle.curriculum_levels, [&[3][..], &[7; 127], &[8]].concat());
        assert_eq!(bundle.curriculum_factors, [&[0.5; 127][..], &[0.75]].concat());
        assert_eq!(curricula.failure_entropy(0.02), None);
        curricula.extend(&vec![episode(None, None, None, Some(49)); 64]);
        assert_eq!(curricula.failure_entropy(0.02), Some(0.0));
        // Half in the first second, and a quarter in each of two others.
        curricula.extend(
            &[[50, 99], [100, 149]]
                .map(|pair| pair.map(|step| vec![episode(None, None, None, Some(step)); 16]))
                .concat()
                .concat(),
        );
        let entropy = curricula.failure_entropy(0.02).unwrap();
        assert!((entropy - 1.5 * 2.0_f64.ln()).abs() < 1e-12, "{entropy}");
        curricula.extend(&[episode(None, None, None, Some(200))]);
        let bundle = curricula.in_bundle(PolicyBundle::default());
        let failures = [&[49; 63][..], &[50; 16], &[99; 16], &[100; 16], &[149; 16], &[200]].concat();
        assert_eq!(bundle.curriculum_failures, failures);
    }
}
