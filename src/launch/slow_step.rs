//! Notices on standard error about a step that takes long.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        mpsc::{RecvTimeoutError, Sender, channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

/// Time after which the first notice is printed.
const FIRST_AFTER: Duration = Duration::from_secs(2);
/// Time between two notices.
const EVERY: Duration = Duration::from_secs(10);

/// Step in progress, which ends when this is dropped.
pub struct SlowStepNotice {
    what: Arc<Mutex<String>>,
    done: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl SlowStepNotice {
    /// Begins a step. `what` describes it, for instance "loading the checkpoint".
    pub fn begin(what: impl Into<String>) -> Self {
        Self::with_output(what.into(), [FIRST_AFTER, EVERY], |notice| tracing::warn!("{notice}"))
    }

    /// Changes the description of the step.
    pub fn update(&self, what: String) {
        *self.what.lock().unwrap_or_else(PoisonError::into_inner) = what;
    }

    fn with_output(what: String, [first, every]: [Duration; 2], print: impl Fn(&str) + Send + 'static) -> Self {
        let what = Arc::new(Mutex::new(what));
        let (done, ended) = channel::<()>();
        let description = what.clone();
        // If the thread cannot be started, the step stays silent, which does no harm.
        let thread = std::thread::Builder::new().name("slow-step".to_string()).spawn(move || {
            let (begun, mut pause) = (Instant::now(), first);
            while ended.recv_timeout(pause) == Err(RecvTimeoutError::Timeout) {
                let what = description.lock().unwrap_or_else(PoisonError::into_inner).clone();
                print(&format!("{what}; {} s so far", begun.elapsed().as_secs()));
                pause = every;
            }
        });
        Self { what, done: Some(done), thread: thread.ok() }
    }
}

impl Drop for SlowStepNotice {
    fn drop(&mut self) {
        self.done = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_step_prints_notices_until_it_ends() {
        let (sender, printed) = channel();
        let print = move |line: &str| drop(sender.send(line.to_string()));
        let step = SlowStepNotice::with_output(
            "playing episode 1".to_string(),
            [Duration::ZERO, Duration::from_millis(1)],
            print,
        );
        assert_eq!(printed.recv().unwrap(), "playing episode 1; 0 s so far");
        step.update("playing episode 2".to_string());
        while printed.recv().unwrap() != "playing episode 2; 0 s so far" {}
        drop(step);
        assert!(printed.iter().all(|line| line.starts_with("playing episode 2")));
    }

    #[test]
    fn a_short_step_is_silent() {
        let (sender, printed) = channel();
        let hour = Duration::from_secs(3600);
        drop(SlowStepNotice::with_output("nothing".to_string(), [hour; 2], move |line: &str| {
            drop(sender.send(line.to_string()))
        }));
        assert_eq!(printed.iter().count(), 0);
    }
}
