//! Policies on trial: every so many steps one is handed to the evaluation actors, and the best by their verdict is kept.

use std::collections::VecDeque;

use bytes::Bytes;
use treadmill_bus::{Bus, BusError, EvaluationServer};
use treadmill_proto::{EvaluationReport, PolicyVersion};

/// Policies whose verdict may still come; older ones are forgotten.
const CANDIDATES: usize = 4;

/// What was evaluated, and what became of it.
#[derive(Debug)]
pub struct Verdict {
    /// The evaluation.
    pub report: EvaluationReport,
    /// Environment steps that the policy had learnt from.
    pub env_steps: u64,
    /// The checkpoint with that policy, encoded.
    pub checkpoint: Vec<u8>,
}

struct Candidate {
    version: PolicyVersion,
    env_steps: u64,
    checkpoint: Vec<u8>,
}

/// Puts policies on trial and gathers verdicts.
pub struct Trial {
    desk: EvaluationServer,
    every_steps: u64,
    due_at_steps: u64,
    candidates: VecDeque<Candidate>,
}

impl Trial {
    /// One policy after every `every_steps` environment steps; the run has `env_steps` already.
    pub fn open(bus: &Bus, run: &str, every_steps: u64, env_steps: u64) -> Result<Self, BusError> {
        let due_at_steps = (env_steps / every_steps + 1) * every_steps;
        Ok(Self { desk: EvaluationServer::open(bus, run)?, every_steps, due_at_steps, candidates: VecDeque::new() })
    }

    /// Evaluates at other intervals from now on.
    pub fn set_every(&mut self, every_steps: u64, env_steps: u64) {
        if every_steps != self.every_steps {
            self.every_steps = every_steps;
            self.due_at_steps = match every_steps {
                0 => u64::MAX,
                every => (env_steps / every + 1) * every,
            };
        }
    }

    /// Whether a policy that has learnt from so many steps is to be put on trial.
    pub fn is_due(&self, env_steps: u64) -> bool {
        env_steps >= self.due_at_steps
    }

    /// Puts a policy on trial, with the checkpoint that it is part of.
    pub fn put(&mut self, version: PolicyVersion, bundle: Bytes, env_steps: u64, checkpoint: Vec<u8>) {
        self.due_at_steps = (env_steps / self.every_steps + 1) * self.every_steps;
        if self.candidates.len() == CANDIDATES {
            self.candidates.pop_front();
        }
        self.candidates.push_back(Candidate { version, env_steps, checkpoint });
        self.desk.put(version, bundle);
    }

    /// The next verdict on a policy that was on trial; each has one.
    pub fn verdict(&mut self) -> Option<Verdict> {
        while let Some(report) = self.desk.next_report() {
            let known = self.candidates.iter().position(|candidate| candidate.version == report.version);
            if let Some(Candidate { env_steps, checkpoint, .. }) = known.and_then(|at| self.candidates.remove(at)) {
                return Some(Verdict { report, env_steps, checkpoint });
            }
        }
        None
    }
}
