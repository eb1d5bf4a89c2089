//! Figures of the measured window.

use std::{collections::HashMap, time::Instant};

use anyhow::Context;
use serde_json::{Value, json};

use crate::{
    played::counts::{Tally, Times},
    run_metrics::LoggedUpdate,
};

/// Counts right after an update.
pub struct Mark {
    /// Updates so far.
    pub updates: usize,
    pub tally: Tally,
    pub at: Instant,
    pub fleet_cpu_s: f64,
    pub learner_cpu_s: f64,
    pub routers_cpu_s: f64,
    pub sent_bytes: Option<HashMap<String, u64>>,
}

/// Sources of the figures.
pub struct Figures<'a> {
    pub rates: &'a [f64],
    pub envs: u32,
    pub joined_s: f64,
    pub bundle_bytes: f64,
    pub begin: Mark,
    pub end: Mark,
    /// Sorted.
    pub times: Times,
    /// After the actors have stopped.
    pub final_tally: Tally,
    pub learner_resident_max_mb: f64,
    /// Of the whole run.
    pub updates: &'a [LoggedUpdate],
}

impl Figures<'_> {
    /// Returns all figures by name.
    pub fn to_json(&self) -> anyhow::Result<Value> {
        let mut all = serde_json::Map::new();
        for part in [self.training()?, self.fragments()?, self.cost()?] {
            all.extend(part.as_object().cloned().unwrap_or_default());
        }
        Ok(all.into())
    }

    /// Returns the updates of the window, after the one that it begins with.
    fn window(&self) -> anyhow::Result<(&LoggedUpdate, &[LoggedUpdate])> {
        let window = self.updates.get(self.begin.updates - 1..self.end.updates).unwrap_or_default();
        window.split_first().filter(|(_, rest)| !rest.is_empty()).context("no update was measured")
    }

    /// Returns environment steps learnt from, and seconds, from the first to the last update of the window.
    fn trained(&self) -> anyhow::Result<(f64, f64)> {
        let (first, rest) = self.window()?;
        let last = rest.last().unwrap_or(first);
        let passed_s = last.value("time/time_elapsed") - first.value("time/time_elapsed");
        Ok(((last.env_steps - first.env_steps) as f64, passed_s.max(1e-9)))
    }

    fn training(&self) -> anyhow::Result<Value> {
        let ((_, window), (trained, passed_s)) = (self.window()?, self.trained()?);
        let (rate_sum, speed) = (self.rates.iter().sum::<f64>(), update_rate(window));
        let sum = |tag: &str| window.iter().map(|update| update.value(tag)).sum::<f64>();
        let of_all = |of: fn(f64, f64) -> f64, start: f64, tag: &str| {
            window.iter().map(|update| update.value(tag)).fold(start, of)
        };
        let weighted: f64 = window.iter().map(|u| u.value("bus/policy_lag_mean") * u.value("train/batch")).sum();
        let simulated_s = (self.end.tally.simulated_us - self.begin.tally.simulated_us) as f64 / 1e6;
        let played_s = self.end.at.duration_since(self.begin.at).as_secs_f64();
        let mean_ms = |tag: &str| ms(sum(tag) * 1e3 / window.len() as f64);
        Ok(json!({
            "actors": self.rates.len(),
            "envs": self.envs,
            "rate_max": finite(self.rates.iter().copied().fold(0.0, f64::max)),
            "updates": window.len(),
            "trained_steps": trained,
            "trained_steps_per_s": rounded(trained / passed_s),
            "trained_per_rate": finite(share(trained / passed_s / rate_sum)),
            "update_steps_per_s": rounded(speed),
            "trained_per_update": share(trained / passed_s / speed),
            "idle_share": finite(share(1.0 - simulated_s / (played_s * self.rates.len() as f64)))
                .filter(|_| rate_sum.is_finite()),
            "policy_lag_mean": share(weighted / sum("train/batch").max(1.0)),
            "policy_lag_max": of_all(f64::max, 0.0, "bus/policy_lag_max"),
            "actors_alive_min": of_all(f64::min, f64::INFINITY, "actors/alive"),
            "learner_used_share": window.last().and_then(|update| update.values.get("rollout/used_share")),
            "publish_ms": mean_ms("time/publish_s"),
            "serial_ms": mean_ms("time/serial_s"),
        }))
    }

    fn fragments(&self) -> anyhow::Result<Value> {
        let (trained, _) = self.trained()?;
        let (begin, end, all) = (&self.begin.tally, &self.end.tally, &self.final_tally);
        let dropped = (end.dropped_steps - begin.dropped_steps) as f64;
        let trained_in_all = self.updates.last().map_or(0, |last| last.env_steps);
        // Accepted for the next batch when the actors stopped. More than a batch would be lost experience.
        let untrained = all.accepted_steps as i64 - trained_in_all as i64;
        let batch_max = self.updates.iter().map(|update| update.value("train/batch")).fold(0.0, f64::max);
        let lost = (untrained as f64 - batch_max).max(0.0);
        let in_flight_steps = all.produced_steps as i64 - all.accepted_steps as i64 - all.dropped_steps as i64;
        let adds_up = (in_flight_steps == 0) == (all.in_flight() == 0);
        Ok(json!({
            "used_share": trained / (trained + dropped + lost),
            "produced_steps": end.produced_steps - begin.produced_steps,
            "dropped_steps": dropped,
            "nothing_lost": adds_up && lost == 0.0 && untrained >= -in_flight_steps,
            "fragments": all,
            "in_flight": all.in_flight(),
            "trained_in_all_steps": trained_in_all,
            "untrained_steps": untrained,
        }))
    }

    fn cost(&self) -> anyhow::Result<Value> {
        let (begin, end, times) = (&self.begin, &self.end, &self.times);
        let versions = (self.end.updates - self.begin.updates).max(1) as f64;
        let sent = begin.sent_bytes.as_ref().zip(end.sent_bytes.as_ref()).map(|(begin, end)| {
            let of = |(peer, bytes): (&String, &u64)| bytes.saturating_sub(*begin.get(peer).unwrap_or(&0)) as f64;
            end.iter().map(of).sum::<f64>()
        });
        let quantiles = |sorted: &[f64]| [0.5, 0.99].map(|of| ms(quantile(sorted, of)));
        let ([receipt_p50, receipt_p99], [fetch_p50, fetch_p99], [_, late_p99]) =
            (quantiles(&times.receipts_ms), quantiles(&times.fetches_ms), quantiles(&times.late_ms));
        Ok(json!({
            "joined_s": ms(self.joined_s),
            "receipt_p50_ms": receipt_p50,
            "receipt_p99_ms": receipt_p99,
            "policy_fetch_p50_ms": fetch_p50,
            "policy_fetch_p99_ms": fetch_p99,
            "send_late_p99_ms": late_p99,
            "policy_bytes": self.bundle_bytes,
            "learner_sent_mb_per_version": sent.map(|sent| share(sent / versions / 1e6)),
            "learner_resident_max_mb": rounded(self.learner_resident_max_mb),
            "learner_cpu_s": rounded(end.learner_cpu_s - begin.learner_cpu_s),
            "played_cpu_s": rounded(end.fleet_cpu_s - begin.fleet_cpu_s),
            "routers_cpu_s": rounded(end.routers_cpu_s - begin.routers_cpu_s),
        }))
    }
}

/// Returns the environment steps of these updates per second of update.
pub fn update_rate(updates: &[LoggedUpdate]) -> f64 {
    let sum = |tag: &str| updates.iter().map(|update| update.value(tag)).sum::<f64>();
    sum("train/batch") / sum("time/update_s").max(1e-9)
}

/// Returns a finite number; JSON has no others.
fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Rounds to one decimal.
pub fn rounded(rate: f64) -> f64 {
    (rate * 10.0).round() / 10.0
}

/// Rounds milliseconds to two decimals.
pub fn ms(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

/// Rounds ratios and costs to three decimals.
pub fn share(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// Returns a quantile of sorted numbers by rank; zero if there are none.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mark after `updates` updates, at `seconds`; `tally` has produced, accepted and dropped steps.
    fn mark(updates: usize, at: Instant, [produced, accepted, dropped]: [u64; 3]) -> Mark {
        let tally = Tally {
            produced_steps: produced,
            accepted_steps: accepted,
            dropped_steps: dropped,
            simulated_us: produced * 1000,
            ..Tally::default()
        };
        let sent_bytes = Some(HashMap::from([("peer".to_string(), updates as u64 * 3_000_000)]));
        Mark { updates, tally, at, fleet_cpu_s: 0.0, learner_cpu_s: updates as f64, routers_cpu_s: 0.0, sent_bytes }
    }

    fn update(env_steps: u64, elapsed_s: f64, batch: f64) -> LoggedUpdate {
        let values = [
            ("time/time_elapsed", elapsed_s),
            ("time/update_s", 0.5),
            ("time/publish_s", 0.25),
            ("time/serial_s", 0.375),
            ("train/batch", batch),
            ("bus/policy_lag_mean", elapsed_s / 10.0),
            ("bus/policy_lag_max", elapsed_s),
            ("actors/alive", 2.0),
        ];
        LoggedUpdate { env_steps, values: values.map(|(tag, value)| (tag.to_string(), value)).into() }
    }

    fn result(accepted_in_all: u64) -> Value {
        let start = Instant::now();
        let updates = [update(100, 2.0, 100.0), update(400, 4.0, 300.0), update(500, 6.0, 100.0)];
        let final_tally = mark(0, start, [accepted_in_all + 60, accepted_in_all, 60]).tally;
        let figures = Figures {
            rates: &[100.0, 50.0],
            envs: 1,
            joined_s: 0.25,
            bundle_bytes: 1.0,
            begin: mark(1, start, [200, 120, 10]),
            end: mark(3, start + std::time::Duration::from_secs(4), [800, 600, 50]),
            times: Times { receipts_ms: vec![1.0, 2.0, 9.0], ..Times::default() },
            final_tally,
            learner_resident_max_mb: 5.0,
            updates: &updates,
        };
        figures.to_json().unwrap()
    }

    #[test]
    fn figures_are_those_between_the_two_marks() {
        let result = result(560);
        for (figure, expected) in [
            // 500 - 100 steps in 6 - 2 seconds; the rates sum to 150 steps/s.
            ("trained_steps", 400.0),
            ("trained_steps_per_s", 100.0),
            ("trained_per_rate", 0.667),
            // Batches of 300 and 100 in 2 x 0.5 s of update.
            ("update_steps_per_s", 400.0),
            ("trained_per_update", 0.25),
            // 600 ms of simulation by two actors in 4 s.
            ("idle_share", 0.925),
            // (0.4 x 300 + 0.6 x 100) / 400.
            ("policy_lag_mean", 0.45),
            ("policy_lag_max", 6.0),
            ("publish_ms", 250.0),
            ("serial_ms", 375.0),
            ("receipt_p50_ms", 2.0),
            ("receipt_p99_ms", 9.0),
            ("learner_sent_mb_per_version", 3.0),
            ("learner_cpu_s", 2.0),
            // 400 of 400 + 40.
            ("dropped_steps", 40.0),
            ("used_share", 400.0 / 440.0),
            ("untrained_steps", 60.0),
        ] {
            assert_eq!(result[figure].as_f64(), Some(expected), "{figure}: {result}");
        }
        assert_eq!(result["nothing_lost"], true);
    }

    #[test]
    fn accepted_fragments_that_were_never_learnt_from_are_lost() {
        // The largest batch has 300 steps, so 400 of 900 accepted steps without an update are 100 too many.
        let result = result(900);
        assert_eq!(result["nothing_lost"], false);
        assert_eq!(result["used_share"].as_f64(), Some(400.0 / (400.0 + 40.0 + 100.0)));
    }
    #[test]
    fn quantiles_are_ranks() {
        let numbers: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!([0.5, 0.99, 1.0].map(|of| quantile(&numbers, of)), [50.0, 99.0, 100.0]);
        assert_eq!((quantile(&[7.0], 0.5), quantile(&[], 0.5)), (7.0, 0.0));
    }
}
