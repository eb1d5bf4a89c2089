//! Thread for the work that no actor waits for: logs, tables, and numbered checkpoints.

use std::{
    io,
    sync::mpsc::{Receiver, SyncSender, sync_channel},
    thread::JoinHandle,
};

use super::TrainingError;
use crate::metrics::MetricsReport;

/// Most jobs that wait. Training waits for the thread beyond that, such as while the disk is full.
const QUEUE: usize = 8;

type Job = Box<dyn FnOnce(&mut MetricsReport) -> Result<(), TrainingError> + Send>;

/// The thread, which owns the outputs of metrics.
pub(super) struct Background {
    jobs: SyncSender<Job>,
    errors: Receiver<TrainingError>,
    thread: JoinHandle<MetricsReport>,
}

impl Background {
    /// Starts the thread.
    pub(super) fn start(mut report: MetricsReport) -> io::Result<Self> {
        let (jobs, queue) = sync_channel::<Job>(QUEUE);
        let (failed, errors) = sync_channel(1);
        let work = move || {
            for job in queue {
                if let Err(why) = job(&mut report) {
                    // Training ends by the first error.
                    let _ = failed.try_send(why);
                }
            }
            report
        };
        let thread = std::thread::Builder::new().name("logs".to_string()).spawn(work)?;
        Ok(Self { jobs, errors, thread })
    }

    /// Queues a job. Its error is returned by [`Self::check`].
    pub(super) fn submit(&self, job: impl FnOnce(&mut MetricsReport) -> Result<(), TrainingError> + Send + 'static) {
        // The thread ends only by a panic, which `finish` passes on.
        let _ = self.jobs.send(Box::new(job));
    }

    /// Returns the error of a job, once.
    pub(super) fn check(&self) -> Result<(), TrainingError> {
        self.errors.try_recv().map_or(Ok(()), Err)
    }

    /// Ends the thread after the last job. Returns the outputs, and the error of a job if one failed.
    pub(super) fn finish(self) -> (MetricsReport, Result<(), TrainingError>) {
        drop(self.jobs);
        let report = self.thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        (report, self.errors.try_recv().map_or(Ok(()), Err))
    }
}
