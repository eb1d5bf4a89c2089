//! Speed that each part of training would allow alone, and the part that limits.

use std::{collections::HashMap, time::Duration};

use treadmill_config::LearnerMode;
use treadmill_proto::ActorStats;

use super::scalars::PhaseDurations;

/// Updates over which the learner's parts are averaged: older ones lose weight by 1/e over as many new ones.
const UPDATES: f64 = 50.0;

/// Part of training.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TrainingPart {
    /// Name, also the last part of its metric's tag.
    pub name: &'static str,
    /// Advice for a run that it limits.
    pub help: &'static str,
}

/// Parts in the order of the data.
pub const PARTS: [TrainingPart; 8] = [
    TrainingPart { name: "simulation", help: "add actors or cores (--actors), or set env.substeps lower" },
    TrainingPart { name: "inference", help: "add actors (--actors), or set policy.hidden narrower" },
    TrainingPart { name: "encoding", help: "set rollout.observation_precision=f16" },
    TrainingPart { name: "bus", help: "give each actor more environments (--envs), or set learner.mode=async" },
    TrainingPart { name: "batch", help: "set policy.hidden narrower, or learner.threads higher" },
    TrainingPart { name: "update", help: "set ppo.epochs lower, ppo.minibatch larger, or learner.threads higher" },
    TrainingPart { name: "checkpoint", help: "put --run-dir on a faster disk" },
    TrainingPart { name: "publishing", help: "set policy.hidden narrower" },
];

/// Seconds per environment step of each of [`PARTS`]; 0 where unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartTimes {
    seconds: [f64; PARTS.len()],
    /// Seconds per environment step of the whole, and of it without waiting for the bus.
    round_s: f64,
    work_s: f64,
}

impl PartTimes {
    /// Returns the environment steps per second that a part would allow alone; `None` if its time is unknown.
    pub fn steps_per_s(&self, name: &str) -> Option<f64> {
        let seconds = self.seconds[PARTS.iter().position(|part| part.name == name)?];
        (seconds > 0.0).then(|| 1.0 / seconds)
    }

    /// Returns the environment steps per second without waiting for the bus, each part at its own speed: actors and learner
    /// work in turn in mode `sync`, at the same time in mode `async`. `None` before actors have reported.
    pub fn ideal_steps_per_s(&self) -> Option<f64> {
        (self.seconds[0] > 0.0).then(|| 1.0 / self.work_s)
    }

    /// Returns the speed of training, divided by the ideal one.
    pub fn efficiency(&self) -> Option<f64> {
        Some(1.0 / (self.round_s * self.ideal_steps_per_s()?))
    }

    /// Returns the share of each of [`PARTS`] in the time of a round; `None` before actors have reported.
    pub fn shares(&self) -> Option<[f64; PARTS.len()]> {
        (self.seconds[0] > 0.0).then(|| self.seconds.map(|seconds| seconds / self.round_s))
    }

    /// Returns the part that takes most of the time; `None` before actors have reported.
    pub fn limit(&self) -> Option<TrainingPart> {
        let slowest = (0..PARTS.len()).max_by(|a, b| self.seconds[*a].total_cmp(&self.seconds[*b]))?;
        (self.seconds[0] > 0.0).then(|| PARTS[slowest])
    }
}

/// Averages the times of the learner's parts over the last updates.
#[derive(Debug, Default)]
pub struct PartMeter {
    steps: f64,
    round_s: f64,
    /// Batch, update, checkpoint, publishing.
    learner_s: [f64; 4],
}

impl PartMeter {
    /// Adds an update that learnt from `steps` environment steps, in a round that took `round`.
    pub fn add(&mut self, steps: u64, round: Duration, durations: &PhaseDurations) {
        let PhaseDurations { update, learn, checkpoint, publish, .. } = *durations;
        let keep = (-1.0 / UPDATES).exp();
        let parts = [update.saturating_sub(learn), learn, checkpoint, publish];
        for (sum, part) in self.learner_s.iter_mut().zip(parts) {
            *sum = *sum * keep + part.as_secs_f64();
        }
        self.steps = self.steps * keep + steps as f64;
        self.round_s = self.round_s * keep + round.as_secs_f64();
    }

    /// Returns the times of all parts in this mode; those of actors are from what they report.
    pub fn times(&self, stats: &HashMap<String, ActorStats>, mode: LearnerMode) -> PartTimes {
        let of_actors = |of: fn(&ActorStats) -> f64| {
            let together: f64 = stats.values().map(of).filter(|rate| rate.is_finite() && *rate > 0.0).sum();
            if together > 0.0 { 1.0 / together } else { 0.0 }
        };
        let steps = self.steps.max(1.0);
        let [simulation, inference, encoding] = [
            of_actors(|stats| stats.simulation_steps_per_s),
            of_actors(|stats| stats.inference_steps_per_s),
            of_actors(|stats| stats.encoding_steps_per_s),
        ];
        let [batch, update, checkpoint, publishing] = self.learner_s.map(|seconds| seconds / steps);
        let round_s = self.round_s / steps;
        let (of_actors, of_learner) = (simulation + inference + encoding, batch + update + checkpoint + publishing);
        let work_s = match mode {
            LearnerMode::Sync => of_actors + of_learner,
            LearnerMode::Async => of_actors.max(of_learner),
        };
        // A shorter round shows that more of the parts overlapped.
        let work_s = work_s.min(round_s);
        let bus = round_s - work_s;
        let seconds = [simulation, inference, encoding, bus, batch, update, checkpoint, publishing];
        PartTimes { seconds, round_s, work_s }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_those_computed_by_hand() {
        let mut meter = PartMeter::default();
        assert_eq!(meter.times(&HashMap::new(), LearnerMode::Sync).limit(), None);
        let ms = Duration::from_millis;
        let durations =
            PhaseDurations { update: ms(30), learn: ms(25), checkpoint: ms(2), publish: ms(3), ..Default::default() };
        (0..3).for_each(|_| meter.add(1000, ms(100), &durations));
        let actor = ActorStats {
            simulation_steps_per_s: 12_500.0,
            inference_steps_per_s: 50_000.0,
            encoding_steps_per_s: 250_000.0,
            ..ActorStats::default()
        };
        let broken = ActorStats { simulation_steps_per_s: f64::NAN, ..ActorStats::default() };
        let stats = [("a", actor.clone()), ("b", actor), ("c", broken)].map(|(name, stats)| (name.to_string(), stats));
        // Per 1,000 steps of two actors: 40, 10 and 2 ms; the learner's parts take 5, 25, 2 and 3 ms, and 13 ms remain.
        let stats = HashMap::from(stats);
        let times = meter.times(&stats, LearnerMode::Sync);
        let close = |found: Option<f64>, expected: f64| {
            let found = found.expect("it is known");
            assert!((found - expected).abs() < 1e-6 * expected, "{found} {expected}");
        };
        close(times.steps_per_s("simulation"), 25_000.0);
        close(times.steps_per_s("bus"), 1e6 / 13.0);
        close(times.steps_per_s("batch"), 200_000.0);
        close(times.ideal_steps_per_s(), 1e6 / 87.0);
        close(times.efficiency(), 0.87);
        close(times.shares().map(|shares| shares[0]), 0.4);
        assert_eq!(times.limit().map(|part| part.name), Some("simulation"));
        assert_eq!(times.steps_per_s("other"), None);
        // At the same time, the actors' 52 ms bind.
        let times = meter.times(&stats, LearnerMode::Async);
        close(times.ideal_steps_per_s(), 1e6 / 52.0);
        close(times.efficiency(), 0.52);
        // Rounds of 70 ms are shorter than 87 ms of work in turn.
        let mut fast = PartMeter::default();
        fast.add(1000, ms(70), &durations);
        close(fast.times(&stats, LearnerMode::Sync).efficiency(), 1.0);
    }
}
