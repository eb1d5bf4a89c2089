//! State in checkpoints of formats 4 and 5, which are still read. They differ in the checksum only.
//!
//! It shares the types that have not changed since. The golden file in `learner/tests/golden/` shows when one of them does.

use serde::Deserialize;
use treadmill_experience::{ledger::Ledger, lineage::Lineage};
use treadmill_policy::NetworkShape;
use treadmill_ppo::PpoState;

use super::{Counters, TrainingState};
use crate::{intake::FragmentCounts, metrics::episodes::EpisodeWindow};

/// [`TrainingState`] in formats 4 and 5.
#[derive(Deserialize)]
pub(super) struct State5 {
    run: String,
    config_toml: String,
    model_xml: String,
    shape: Shape5,
    lineage: Lineage,
    ppo: PpoState,
    ledger: Ledger,
    fragment_counts: FragmentCounts,
    episodes: EpisodeWindow,
    counters: Counters,
    best_return: Option<f64>,
    best_is_evaluated: bool,
    actor_state: Option<ActorState>,
    physics_version: u32,
}

/// [`NetworkShape`] up to format 5.
#[derive(Deserialize)]
pub(super) struct Shape5 {
    observation: usize,
    action: usize,
    hidden: Vec<usize>,
}

/// [`treadmill_proto::ActorState`] up to format 5.
#[derive(Deserialize)]
pub(super) struct ActorState {
    actor: String,
    start: u64,
    noise: Vec<u64>,
    episodes: Vec<u64>,
    lengths: Vec<u32>,
    progress: Vec<f64>,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    observations: Vec<f32>,
    past_actions: Vec<f32>,
    steps_to_push: Vec<u32>,
    streams: Vec<u64>,
}

impl From<Shape5> for NetworkShape {
    fn from(Shape5 { observation, action, hidden }: Shape5) -> Self {
        Self { observation, action, hidden, privileged: 0 }
    }
}

impl From<ActorState> for treadmill_proto::ActorState {
    fn from(state: ActorState) -> Self {
        Self {
            actor: state.actor,
            start: state.start,
            noise: state.noise,
            episodes: state.episodes,
            lengths: state.lengths,
            progress: state.progress,
            positions: state.positions,
            velocities: state.velocities,
            observations: state.observations,
            past_actions: state.past_actions,
            steps_to_push: state.steps_to_push,
            streams: state.streams,
            task: Vec::new(),
        }
    }
}

impl From<State5> for TrainingState {
    fn from(state: State5) -> Self {
        Self {
            run: state.run,
            config_toml: state.config_toml,
            model_xml: state.model_xml,
            shape: state.shape.into(),
            lineage: state.lineage,
            ppo: state.ppo,
            ledger: state.ledger,
            fragment_counts: state.fragment_counts,
            episodes: state.episodes,
            counters: state.counters,
            best_return: state.best_return,
            best_is_evaluated: state.best_is_evaluated,
            actor_state: state.actor_state.map(Into::into),
            physics_version: state.physics_version,
        }
    }
}
