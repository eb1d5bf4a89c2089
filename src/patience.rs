//! Steps that may take long say so while they do, on standard error; those that are soon over stay silent.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        mpsc::{RecvTimeoutError, Sender, channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

use crate::output::complain;

/// What takes longer than this is worth a word.
const FIRST_AFTER: Duration = Duration::from_secs(2);
/// And another one each time so much has passed.
const EVERY: Duration = Duration::from_secs(10);

/// A step under way; it is over when this is dropped.
pub struct Step {
    what: Arc<Mutex<String>>,
    done: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Step {
    /// Begins a step; `what` goes on in words, as in "loading the checkpoint".
    pub fn begin(what: impl Into<String>) -> Self {
        Self::telling(what.into(), [FIRST_AFTER, EVERY], complain)
    }

    /// The step goes on with something else.
    pub fn goes_on(&self, what: String) {
        *self.what.lock().unwrap_or_else(PoisonError::into_inner) = what;
    }

    fn telling(what: String, [first, every]: [Duration; 2], tell: impl Fn(&str) + Send + 'static) -> Self {
        let what = Arc::new(Mutex::new(what));
        let (done, ended) = channel::<()>();
        let words = what.clone();
        // A step without its thread is silent, and no worse.
        let thread = std::thread::Builder::new().name("patience".to_string()).spawn(move || {
            let (begun, mut pause) = (Instant::now(), first);
            while ended.recv_timeout(pause) == Err(RecvTimeoutError::Timeout) {
                let words = words.lock().unwrap_or_else(PoisonError::into_inner).clone();
                tell(&format!("{words}; {} s so far", begun.elapsed().as_secs()));
                pause = every;
            }
        });
        Self { what, done: Some(done), thread: thread.ok() }
    }
}

impl Drop for Step {
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
    fn a_long_step_tells_what_it_does_until_it_is_over() {
        let (sender, told) = channel();
        let tell = move |line: &str| drop(sender.send(line.to_string()));
        let step = Step::telling("playing episode 1".to_string(), [Duration::ZERO, Duration::from_millis(1)], tell);
        assert_eq!(told.recv().unwrap(), "playing episode 1; 0 s so far");
        step.goes_on("playing episode 2".to_string());
        while told.recv().unwrap() != "playing episode 2; 0 s so far" {}
        drop(step);
        // Whoever tells is gone with the step.
        assert!(told.iter().all(|line| line.starts_with("playing episode 2")));
    }

    #[test]
    fn a_short_step_is_silent() {
        let (sender, told) = channel();
        let hour = Duration::from_secs(3600);
        drop(Step::telling("nothing".to_string(), [hour; 2], move |line: &str| drop(sender.send(line.to_string()))));
        assert_eq!(told.iter().count(), 0);
    }
}
