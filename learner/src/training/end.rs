//! Ends a run.

use treadmill_runtime::error_chain;

use super::{Reporting, Trainer, TrainingError};
use crate::{checkpoint::TrainingState, intake::ledger_report, leadership::Status, metrics::History};

impl Trainer {
    /// Ends the run: answers waiting senders and writes the last logs. `outcome` is whether the run was stopped before
    /// its last step. Returns the state, what it has reached, and the outcome.
    pub(super) fn finish(
        mut self,
        outcome: Result<bool, TrainingError>,
    ) -> Result<(TrainingState, History, bool), TrainingError> {
        self.serving.leave_pool();
        self.serving.intake.stop(&self.state.lineage);
        self.serving.storage.end_leadership(match outcome {
            Ok(false) => Status::Finished,
            Ok(true) if self.is_stopped => Status::Stopped,
            _ => Status::Released,
        });
        let Reporting { background, history, ledger_report, .. } = self.reporting;
        let (mut report, written) = background.finish();
        let outcome = outcome.and_then(|stopped| written.map(|()| stopped));
        report.end(outcome.as_ref().ok().copied());
        let stopped = outcome?;
        // The ledger of the last checkpoint, without fragments accepted since. The run is saved, whatever becomes of these.
        if let Err(why) = ledger_report::write(&ledger_report, &self.state.ledger) {
            tracing::warn!(file = %ledger_report.display(), error = %error_chain(&why), "the accounts cannot be written");
        }
        if let Err(why) = report.finish(&history) {
            tracing::warn!(error = %error_chain(&why), "the last logs cannot be written");
        }
        Ok((self.state, history, stopped))
    }
}
