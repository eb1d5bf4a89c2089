//! Updates the parameters from a batch.

use std::{
    error::Error,
    time::{Duration, Instant},
};

use treadmill_config::Config;
use treadmill_ppo::{AcceptedFragment, Improvement, Ppo, PpoOptions, UpdateError, UpdateStats};
use treadmill_runtime::{error_chain, machine};

use super::{Trainer, TrainingError, TrainingOptions, load_adaptation::LoadAdaptation};
use crate::checkpoint::TrainingState;

/// Learning part of a [`Trainer`].
pub(super) struct Learning {
    pub(super) ppo: Ppo,
    pub(super) load: LoadAdaptation,
    undone_in_a_row: u32,
    /// Duration of the last update's gradient steps.
    pub(super) learn: Duration,
}

impl Learning {
    /// Starts the threads of the update.
    pub(super) fn new(
        state: &TrainingState,
        config: &Config,
        options: &TrainingOptions,
    ) -> Result<Self, TrainingError> {
        let invalid = |why: &dyn Error| TrainingError::State { why: error_chain(why) };
        let threads = match config.learner.threads {
            0 => machine::cores(),
            threads => threads as usize,
        };
        let ppo_options = PpoOptions {
            device: options.device.clone(),
            mirror: options.mirror.clone(),
            observation_clip: config.policy.observation_clip as f32,
            ..PpoOptions::on_cpu(state.shape.clone(), threads).map_err(|why| invalid(&why))?
        };
        let ppo = Ppo::new(ppo_options, &config.ppo);
        ppo.policy(&state.ppo).map_err(|why| invalid(&why))?;
        Ok(Self { ppo, load: LoadAdaptation::new(config), undone_in_a_row: 0, learn: Duration::ZERO })
    }
}

impl Trainer {
    /// Updates the parameters from the fragments of a batch. Implausible fragments are reported and removed. Returns
    /// `None` if the update was undone.
    pub(super) fn update(
        &mut self,
        fragments: &mut Vec<AcceptedFragment>,
    ) -> Result<Option<UpdateStats>, TrainingError> {
        let Self { state, learning, config, reporting, .. } = self;
        let epochs = learning.load.epochs();
        let prepared = learning.ppo.prepare(&state.ppo, fragments).map_err(TrainingError::Inference)?;
        let begun = Instant::now();
        let Improvement { result, rejected } = learning.ppo.improve(&mut state.ppo, epochs, fragments, prepared);
        learning.learn = begun.elapsed();
        let validator = &mut self.serving.intake.validator;
        for (fragment, why) in &rejected {
            validator.report_implausible(fragment, why, Instant::now());
        }
        fragments.iter().for_each(|accepted| validator.report_learnt(&accepted.fragment));
        self.serving.heartbeat.beat();
        match result {
            Ok(stats) => {
                learning.undone_in_a_row = 0;
                state.counters.gradient_steps += stats.gradient_steps;
                Ok(Some(stats))
            }
            // The senders are at fault, so this does not end the run.
            Err(UpdateError::Empty) => {
                tracing::warn!(rejected = rejected.len(), "update undone: no fragment of the batch is plausible");
                state.counters.undone_updates += 1;
                Ok(None)
            }
            Err(source) => {
                tracing::warn!(error = %error_chain(&source), "update undone");
                reporting.alarms.record_undone(&error_chain(&source), Instant::now());
                learning.undone_in_a_row += 1;
                state.counters.undone_updates += 1;
                if learning.undone_in_a_row >= config.learner.undone_max {
                    return Err(TrainingError::Undone { updates: learning.undone_in_a_row, source });
                }
                Ok(None)
            }
        }
    }

    /// Advances the state by the update from `fragments`, also if it was undone.
    pub(super) fn advance(&mut self, fragments: &[AcceptedFragment], is_undone: bool) {
        let state = &mut self.state;
        state.lineage.advance();
        state.counters.updates += 1;
        for AcceptedFragment { fragment, .. } in fragments {
            state.counters.env_steps += fragment.transitions() as u64;
            state.counters.env_steps_undone += if is_undone { fragment.transitions() as u64 } else { 0 };
            state.episodes.extend(&fragment.episodes);
        }
        state.actor_state = fragments.last().and_then(|accepted| accepted.fragment.actor_state.clone());
        state.counters.env_steps_simulated =
            self.reporting.simulated_before + self.serving.intake.fleet.effort().env_steps;
        state.counters.wall_s = self.reporting.wall_s();
        state.counters.restarts = self.reporting.restarts();
    }
}
