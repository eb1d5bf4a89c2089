//! Runs whose learners are probably there, but answer none of a router's questions.
//!
//! Zenoh can lose what routers declare to each other (`workarounds/` has the known cases). A new session after a pause
//! is declared to anew.

use std::{
    collections::BTreeMap,
    time::{Duration, Instant},
};

/// Runs that are counted at the same time.
const RUNS_MAX: usize = 16;
/// Least number of questions that say anything: the second one may come long after the first.
const QUESTIONS_MIN: u32 = 3;

/// How a question to a learner ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Heard {
    Answered,
    /// No answer came in time, though the learner holds its token.
    Silent,
    /// No answer came, and the learner's token is missing, though a router or learner is linked.
    Unreachable,
    /// No answer came, and there is no learner.
    Absent,
}

/// Silence of the learners.
#[derive(Debug, Default)]
pub(super) struct Silences {
    /// For each run, the questions in a row without an answer, and when the first of them ended.
    unanswered: BTreeMap<String, (u32, Instant)>,
    /// Whether any learner has answered.
    pub(super) has_answers: bool,
    expects_answers: bool,
}

impl Silences {
    /// Begins a session; with `expects_answers`, as learners answered before, one that cannot be reached counts as silent.
    pub(super) fn new(expects_answers: bool) -> Self {
        Self { expects_answers, ..Self::default() }
    }

    /// Records a question. Returns for how long a learner has been silent; zero before the third question.
    pub(super) fn record(&mut self, run: &str, outcome: Heard, now: Instant) -> Duration {
        self.has_answers |= outcome == Heard::Answered;
        let is_silent = match outcome {
            Heard::Silent => true,
            Heard::Unreachable => self.has_answers || self.expects_answers,
            Heard::Answered | Heard::Absent => false,
        };
        if !is_silent {
            self.unanswered.remove(run);
            return Duration::ZERO;
        }
        if self.unanswered.len() >= RUNS_MAX && !self.unanswered.contains_key(run) {
            return Duration::ZERO;
        }
        let (count, since) = self.unanswered.entry(run.to_string()).or_insert((0, now));
        *count += 1;
        if *count < QUESTIONS_MIN { Duration::ZERO } else { now.duration_since(*since) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_questions_in_a_row_to_a_learner_that_should_answer_count() {
        let (mut silences, begin) = (Silences::default(), Instant::now());
        let mut record = |run: &str, outcome, second| {
            let silence = silences.record(run, outcome, begin + Duration::from_secs(second));
            (silence.as_secs(), silences.has_answers, silences.unanswered.len())
        };
        for (second, outcome, silence, has_answers) in [
            (0, Heard::Silent, 0, false),
            // The next question may come late.
            (100, Heard::Silent, 0, false),
            (101, Heard::Silent, 101, false),
            (102, Heard::Absent, 0, false),
            (103, Heard::Silent, 0, false),
            // None has answered yet: perhaps there is no run.
            (104, Heard::Unreachable, 0, false),
            (105, Heard::Unreachable, 0, false),
            (106, Heard::Unreachable, 0, false),
            (108, Heard::Answered, 0, true),
            (110, Heard::Silent, 0, true),
            (115, Heard::Silent, 0, true),
            (120, Heard::Unreachable, 10, true),
        ] {
            let found = record("walk", outcome, second);
            assert_eq!((found.0, found.1), (silence, has_answers), "after {second} s");
        }
        assert_eq!(record("run", Heard::Silent, 200).0, 0, "each run counts alone");
        for run in 0..100 {
            record(&run.to_string(), Heard::Silent, 200);
        }
        assert_eq!(record("walk", Heard::Silent, 121), (11, true, RUNS_MAX));
    }

    #[test]
    fn a_new_session_expects_answers_if_the_one_before_had_them() {
        let (mut silences, begin) = (Silences::new(true), Instant::now());
        let waited = [0, 1, 9]
            .map(|second| silences.record("walk", Heard::Unreachable, begin + Duration::from_secs(second)).as_secs());
        assert_eq!(waited, [0, 0, 9]);
    }
}
