//! State in checkpoints of format 3, which is still read.
//!
//! It shares the types that have not changed since. The golden file in `learner/tests/golden/` shows when one of them does.

use serde::Deserialize;
use treadmill_experience::{ledger::Ledger, lineage::Lineage};
use treadmill_ppo::PpoState;

use super::{
    Counters, TrainingState,
    format_5::{ActorState, Shape5},
};
use crate::{intake::FragmentCounts, metrics::episodes::EpisodeWindow};

/// [`TrainingState`] in format 3.
#[derive(Deserialize)]
pub(super) struct State3 {
    run: String,
    config_toml: String,
    model_xml: String,
    shape: Shape5,
    lineage: Lineage,
    ppo: PpoState,
    ledger: Ledger,
    fragment_counts: Counts,
    episodes: EpisodeWindow,
    counters: RunCounters,
    best_return: Option<f64>,
    best_is_evaluated: bool,
    actor_state: Option<ActorState>,
}

/// [`FragmentCounts`] in format 3.
#[derive(Deserialize)]
struct Counts {
    accepted: u64,
    duplicate: u64,
    too_old: u64,
    vanished: u64,
    malformed: u64,
    quarantined: u64,
}

/// [`Counters`] in format 3.
#[derive(Deserialize)]
struct RunCounters {
    env_steps: u64,
    updates: u64,
    gradient_steps: u64,
    undone_updates: u64,
    wall_s: f64,
    restarts: u64,
    resumes: u64,
}

impl From<State3> for TrainingState {
    fn from(state: State3) -> Self {
        let (counts, counters) = (state.fragment_counts, state.counters);
        Self {
            run: state.run,
            config_toml: state.config_toml,
            model_xml: state.model_xml,
            shape: state.shape.into(),
            lineage: state.lineage,
            ppo: state.ppo,
            ledger: state.ledger,
            fragment_counts: FragmentCounts {
                accepted: counts.accepted,
                duplicate: counts.duplicate,
                too_old: counts.too_old,
                vanished: counts.vanished,
                malformed: counts.malformed,
                quarantined: counts.quarantined,
                implausible: 0,
            },
            episodes: state.episodes,
            counters: Counters {
                env_steps: counters.env_steps,
                updates: counters.updates,
                gradient_steps: counters.gradient_steps,
                undone_updates: counters.undone_updates,
                wall_s: counters.wall_s,
                restarts: counters.restarts,
                resumes: counters.resumes,
                env_steps_simulated: counters.env_steps,
                env_steps_undone: 0,
            },
            best_return: state.best_return,
            best_is_evaluated: state.best_is_evaluated,
            actor_state: state.actor_state.map(Into::into),
            physics_version: 0,
        }
    }
}
