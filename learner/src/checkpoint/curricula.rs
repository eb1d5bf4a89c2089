//! Curricula that the environments of a run have reached, from which new ones begin.

use std::collections::{BTreeMap, VecDeque};

use serde::{Deserialize, Serialize};
use treadmill_proto::{Episode, PolicyBundle};

/// Episodes that are kept of each kind of ground, and of factors.
const WINDOW: usize = 128;

/// Levels and factors of the last episodes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Curricula {
    /// Levels by kind of ground.
    levels: BTreeMap<u32, VecDeque<u32>>,
    /// Factors on the ranges of commands.
    factors: VecDeque<f32>,
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
        }
    }

    /// Adds them to a bundle, for actors that join.
    #[must_use]
    pub fn in_bundle(&self, bundle: PolicyBundle) -> PolicyBundle {
        let pairs = self.levels.iter().flat_map(|(kind, levels)| levels.iter().map(|level| (*kind, *level)));
        let (curriculum_kinds, curriculum_levels) = pairs.unzip();
        let curriculum_factors = self.factors.iter().copied().collect();
        PolicyBundle { curriculum_kinds, curriculum_levels, curriculum_factors, ..bundle }
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
        let episode = |ground_kind, ground_level, command_factor| Episode {
            return_sum: 0.0,
            length: 1,
            distance_m: 0.0,
            velocity_mean_mps: 0.0,
            cause: EndCause::Fell,
            ground_kind,
            ground_level,
            command_factor,
        };
        let mut curricula = Curricula::default();
        curricula.extend(&[episode(None, None, None)]);
        assert_eq!(curricula, Curricula::default());
        curricula.extend(&vec![episode(Some(2), Some(7.0), Some(0.5)); 200]);
        curricula.extend(&[episode(Some(0), Some(3.0), None), episode(Some(2), Some(8.0), Some(0.75))]);
        let bundle = curricula.in_bundle(PolicyBundle::default());
        assert_eq!(bundle.curriculum_kinds, [&[0][..], &[2; 128]].concat());
        assert_eq!(bundle.curriculum_levels, [&[3][..], &[7; 127], &[8]].concat());
        assert_eq!(bundle.curriculum_factors, [&[0.5; 127][..], &[0.75]].concat());
    }
}
