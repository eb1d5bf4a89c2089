//! Schedules evaluations: every `eval.every_steps` environment steps, evaluation actors get one policy.

use std::collections::VecDeque;

use bytes::Bytes;
use treadmill_bus::{Bus, BusError, learner::EvaluationServer};
use treadmill_proto::{EvaluationReport, PolicyVersion};

/// Most policies that evaluators may be playing at the same time, and the next one; the oldest ones are dropped.
const CANDIDATES_MAX: usize = 8;

/// Result of an evaluation.
#[derive(Debug)]
pub struct EvaluationResult {
    /// The evaluation actor's report.
    pub report: EvaluationReport,
    /// Environment steps that the policy has learnt from.
    pub env_steps: u64,
    /// Encoded checkpoint with that policy.
    pub checkpoint: Bytes,
}

struct Candidate {
    version: PolicyVersion,
    env_steps: u64,
    checkpoint: Bytes,
}

/// Submits policies for evaluation and matches the results to them.
pub struct EvaluationScheduler {
    server: EvaluationServer,
    every_steps: u64,
    due_at_steps: u64,
    candidates: VecDeque<Candidate>,
}

impl EvaluationScheduler {
    /// Scheduler that evaluates one policy every `every_steps` environment steps; the run has `env_steps` already.
    pub fn open(bus: &Bus, run: &str, every_steps: u64, env_steps: u64) -> Result<Self, BusError> {
        let (server, due_at_steps) = (EvaluationServer::open(bus, run)?, next_due(every_steps, env_steps));
        Ok(Self { server, every_steps, due_at_steps, candidates: VecDeque::new() })
    }

    /// Changes the interval; with 0, no policy is due.
    pub fn set_every(&mut self, every_steps: u64, env_steps: u64) {
        if every_steps != self.every_steps {
            self.every_steps = every_steps;
            self.due_at_steps = next_due(every_steps, env_steps);
        }
    }

    /// Whether a policy that has learnt from `env_steps` is due for evaluation.
    pub fn is_due(&self, env_steps: u64) -> bool {
        env_steps >= self.due_at_steps
    }

    /// Submits a policy for evaluation. `checkpoint` holds the same policy.
    pub fn submit(&mut self, version: PolicyVersion, bundle: Bytes, env_steps: u64, checkpoint: Bytes) {
        self.due_at_steps = next_due(self.every_steps, env_steps);
        if !self.server.put(version, bundle) {
            // No evaluator took it, so no result will come.
            self.candidates.pop_back();
        }
        if self.candidates.len() == CANDIDATES_MAX {
            self.candidates.pop_front();
        }
        self.candidates.push_back(Candidate { version, env_steps, checkpoint });
    }

    /// Returns the next result of a submitted policy; each policy has at most one.
    pub fn next_result(&mut self) -> Option<EvaluationResult> {
        while let Some(report) = self.server.next_report() {
            let known =
                self.candidates.iter().position(|candidate| candidate.version.names_same_policy(report.version));
            if let Some(Candidate { env_steps, checkpoint, .. }) = known.and_then(|at| self.candidates.remove(at)) {
                return Some(EvaluationResult { report, env_steps, checkpoint });
            }
        }
        None
    }
}

/// Returns the first multiple of `every_steps` above `env_steps`.
fn next_due(every_steps: u64, env_steps: u64) -> u64 {
    env_steps.checked_div(every_steps).map_or(u64::MAX, |passed| (passed + 1) * every_steps)
}
