//! The training loop: collect, update, save, publish, log.
//!
//! # Layout
//! - Here: [`train`] and its loop. `Trainer` has three parts: learning, serving and reporting.
//! - `options`: [`TrainingOptions`] and [`TrainingSummary`]; `error`: [`TrainingError`].
//! - `alarms`: conditions that need an operator.
//! - `background`: thread for the work that no actor waits for.
//! - `start`: prepares a `Trainer` for its first batch.
//! - `learning`: updates the parameters from a batch.
//! - `serving`: collects batches, saves checkpoints, publishes policies, takes evaluation results.
//! - `reporting`: logs each update.
//! - `commands`: applies control commands and publishes the run's status.
//! - [`control`]: queues commands for the training thread and answers status requests.
//! - [`evaluation`]: schedules evaluations during training.
//! - [`load_adaptation`]: adapts batch size and passes to the load.

mod alarms;
mod background;
mod commands;
pub mod control;
mod error;
pub mod evaluation;
mod learning;
pub mod load_adaptation;
mod options;
mod reporting;
mod serving;
mod start;

use std::time::Instant;

use treadmill_bus::Bus;
use treadmill_config::Config;
use treadmill_runtime::shutdown::Shutdown;

pub use self::commands::is_changeable;
pub use self::error::TrainingError;
pub use self::options::{TrainingOptions, TrainingSummary};
use self::{learning::Learning, reporting::Reporting, serving::Serving};
use crate::{checkpoint::TrainingState, leadership::Leadership, metrics::scalars::PhaseDurations, waiting::Retry};

/// Trains until the run has all its steps or shutdown is requested. Blocks, so it needs its own thread. With
/// `leadership`, the state is in a store; without, in the run's folder.
pub fn train(
    bus: &Bus,
    state: TrainingState,
    leadership: Option<Leadership>,
    options: &TrainingOptions,
    shutdown: &Shutdown,
) -> Result<TrainingSummary, TrainingError> {
    let (begun, steps_before) = (Instant::now(), state.counters.env_steps);
    let mut trainer = Trainer::start(bus, state, leadership, options, shutdown)?;
    // A successor ends every wait, so whatever failed then is not the cause.
    let outcome = run(&mut trainer).map_err(|why| trainer.check_leadership().err().unwrap_or(why));
    let (state, history, stopped) = trainer.finish(outcome)?;
    Ok(TrainingSummary {
        wall_s: begun.elapsed().as_secs_f64(),
        env_steps: state.counters.env_steps - steps_before,
        stopped,
        history,
        state,
    })
}

/// Collects, updates, saves, publishes and logs until the last step. Returns whether shutdown was requested before it.
fn run(trainer: &mut Trainer) -> Result<bool, TrainingError> {
    while trainer.state.counters.env_steps < trainer.config.run.steps {
        let begun = Instant::now();
        let Some(mut batch) = trainer.collect()? else { return Ok(true) };
        let collect = begun.elapsed();
        let stats = trainer.update(&mut batch.fragments)?;
        let update = begun.elapsed() - collect;
        trainer.advance(&batch.fragments, stats.is_none());
        let evaluation = trainer.take_evaluation()?;
        let saved = trainer.save()?;
        let checkpoint = begun.elapsed() - collect - update;
        trainer.publish(&saved)?;
        trainer.keep(saved);
        let publish = begun.elapsed() - collect - update;
        let serial = trainer.reporting.serial(update, trainer.serving.intake.idle());
        let learn = trainer.learning.learn;
        let durations = PhaseDurations { collect, update, learn, checkpoint, publish, serial };
        trainer.log(stats.as_ref(), &batch.fragments, durations, evaluation.as_ref())?;
        trainer.learning.load.adapt(&batch);
        trainer.publish_status(true);
    }
    Ok(false)
}

/// One run in progress.
struct Trainer {
    state: TrainingState,
    config: Config,
    shutdown: Shutdown,
    retry: Retry,
    /// Whether an operator has stopped the run.
    is_stopped: bool,
    learning: Learning,
    serving: Serving,
    reporting: Reporting,
}
