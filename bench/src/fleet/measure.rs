//! Starts a learner, routers and played actors, sets the rates, and marks the measured window.

use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

use anyhow::Context;
use serde_json::Value;

use super::{
    RUN,
    counts::{Tally, Times},
    figures::{Figures, Mark, update_rate},
    processes::{NICE, Process},
    run_metrics::{LoggedUpdate, RunMetrics},
};
use crate::helper::{Helper, number, numbers};

/// More environment steps than any measurement trains.
const ENDLESS: &str = "1000000000000";
/// Interval at which the learner's metrics are read.
const POLL: Duration = Duration::from_millis(10);
/// Longest wait for an update.
const UPDATE_TIMEOUT: Duration = Duration::from_secs(120);
/// Updates that are not measured when rates change.
const WARMUP_UPDATES: usize = 3;
/// Fewest updates of a measurement.
const UPDATES_MIN: usize = 5;
/// Attempts to read the played actors' counts without an update meanwhile.
const MARK_ATTEMPTS: u32 = 20;

/// Rate of every played actor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlayedRate {
    /// Environment steps per second of each actor.
    Fixed(f64),
    /// The sum of all rates is this multiple of the update's own speed, which is measured first.
    Load(f64),
}

/// Parameters of a measurement.
pub struct MeasurementPlan {
    pub actors: usize,
    pub envs: u32,
    pub rate: PlayedRate,
    /// Factors on the rates of the last actors.
    pub slow: Vec<f64>,
    pub routers: usize,
    pub processes: usize,
    pub calibrate_s: f64,
    pub warmup_s: f64,
    pub seconds: f64,
    /// Flags of the learner: preset and configuration keys.
    pub learner: Vec<String>,
    /// Endpoint of every listening process, with port 0.
    pub listen: &'static str,
    /// Network flags of every process.
    pub network: Vec<String>,
    /// Folder of the run and the learner's log.
    pub folder: PathBuf,
}

impl MeasurementPlan {
    /// Returns each actor's factor on the common rate.
    fn factors(&self) -> Vec<f64> {
        let equal = self.actors - self.slow.len();
        [vec![1.0; equal], self.slow.clone()].concat()
    }

    /// Starts the processes, measures, stops them, and returns all figures by name.
    pub fn measure(&self) -> anyhow::Result<Value> {
        let mut measurement = Measurement::start(self)?;
        let (rates, calibrated) = match self.rate {
            PlayedRate::Fixed(rate) => (self.factors().iter().map(|factor| factor * rate).collect::<Vec<_>>(), None),
            PlayedRate::Load(load) => {
                let update_rate = measurement.calibrate(self.calibrate_s)?;
                let factors = self.factors();
                let each = load * update_rate / factors.iter().sum::<f64>();
                (factors.iter().map(|factor| factor * each).collect(), Some(update_rate))
            }
        };
        measurement.set_rates(&rates)?;
        measurement.wait_for_earlier_fragments()?;
        measurement.wait_for_all_alive()?;
        measurement.wait_for_updates(WARMUP_UPDATES, self.warmup_s)?;
        let begin = measurement.mark()?;
        measurement.fleet.ask("forget")?;
        measurement.wait_for_updates(UPDATES_MIN, self.seconds)?;
        let end = measurement.mark()?;
        let times = measurement.fleet.times()?;
        let final_tally = measurement.fleet.ask("stop")?.0;
        let alive_s = measurement.alive_s;
        let (joined_s, bundle_bytes) = (measurement.fleet.joined_s, measurement.fleet.bundle_bytes);
        let learner_resident_max_mb = measurement.learner.resident_max_mb();
        let updates = measurement.stop()?;
        let figures = Figures {
            rates: &rates,
            envs: self.envs,
            calibrated,
            joined_s,
            alive_s,
            bundle_bytes,
            begin,
            end,
            times,
            final_tally,
            learner_resident_max_mb,
            updates: &updates,
        };
        figures.to_json()
    }
}

/// Running processes of a measurement. Actors end before routers, and routers before the learner.
struct Measurement {
    fleet: PlayedFleet,
    routers: Vec<Process>,
    learner: Process,
    metrics: RunMetrics,
    /// Seconds from the start of the actors until the learner logged all of them as alive.
    alive_s: Option<f64>,
    actors: usize,
    begun: Instant,
}

impl Measurement {
    fn start(plan: &MeasurementPlan) -> anyhow::Result<Self> {
        let run = plan.folder.join(RUN);
        let mut args: Vec<String> =
            ["learner", "--run", RUN, "--steps", ENDLESS, "--no-progress", "--listen", plan.listen, "--run-dir"]
                .map(str::to_string)
                .to_vec();
        args.push(run.display().to_string());
        args.extend(plan.learner.iter().chain(&plan.network).cloned());
        let learner = Process::learner(&args, &run, plan.folder.join("learner.log"))?;
        let routers: Vec<Process> = (0..plan.routers)
            .map(|_| Process::router(plan.listen, &learner.endpoint, &plan.network))
            .collect::<anyhow::Result<_>>()?;
        let endpoints: Vec<&str> = match routers.is_empty() {
            true => vec![&learner.endpoint],
            false => routers.iter().map(|router| router.endpoint.as_str()).collect(),
        };
        let begun = Instant::now();
        let fleet = PlayedFleet::start(plan, &endpoints)?;
        let metrics = RunMetrics::follow(run.join("metrics.jsonl"));
        Ok(Self { fleet, routers, learner, metrics, alive_s: None, actors: plan.actors, begun })
    }

    fn set_rates(&mut self, rates: &[f64]) -> anyhow::Result<()> {
        self.fleet.set_rates(rates)
    }

    /// Measures the update's own speed while the actors deliver as fast as they can.
    fn calibrate(&mut self, seconds: f64) -> anyhow::Result<f64> {
        self.set_rates(&vec![f64::INFINITY; self.actors])?;
        self.wait_for_updates(WARMUP_UPDATES, 0.0)?;
        let before = self.poll()?.len();
        self.wait_for_updates(UPDATES_MIN, seconds)?;
        Ok(update_rate(&self.poll()?[before..]))
    }

    fn poll(&mut self) -> anyhow::Result<&[LoggedUpdate]> {
        let (actors, passed_s) = (self.actors as f64, self.begun.elapsed().as_secs_f64());
        let updates = self.metrics.poll()?;
        if self.alive_s.is_none() && updates.last().is_some_and(|last| last.value("actors/alive") >= actors) {
            self.alive_s = Some(passed_s);
        }
        Ok(updates)
    }

    /// Waits for `count` more updates, and for `seconds`.
    fn wait_for_updates(&mut self, count: usize, seconds: f64) -> anyhow::Result<()> {
        let (begun, wanted) = (Instant::now(), self.poll()?.len() + count);
        let (mut known, mut newest) = (0, begun);
        loop {
            let updates = self.poll()?.len();
            if updates >= wanted && begun.elapsed().as_secs_f64() >= seconds {
                return Ok(());
            }
            if updates > known {
                (known, newest) = (updates, Instant::now());
            }
            self.learner.check_runs()?;
            anyhow::ensure!(newest.elapsed() < UPDATE_TIMEOUT, "the learner made no update for {UPDATE_TIMEOUT:?}");
            std::thread::sleep(POLL);
        }
    }

    /// Waits until the learner has logged all actors as alive.
    fn wait_for_all_alive(&mut self) -> anyhow::Result<()> {
        let begun = Instant::now();
        while self.alive_s.is_none() {
            anyhow::ensure!(begun.elapsed() < UPDATE_TIMEOUT, "not all actors are alive after {UPDATE_TIMEOUT:?}");
            self.wait_for_updates(1, 0.0)?;
        }
        Ok(())
    }

    /// Waits until no fragment of other rates is in flight.
    fn wait_for_earlier_fragments(&mut self) -> anyhow::Result<()> {
        let begun = Instant::now();
        while self.fleet.ask("mark")?.0.before_rates > 0 {
            anyhow::ensure!(begun.elapsed() < UPDATE_TIMEOUT, "fragments have no receipt after {UPDATE_TIMEOUT:?}");
            std::thread::sleep(POLL);
        }
        Ok(())
    }

    /// Waits for an update and reads every count right after it.
    fn mark(&mut self) -> anyhow::Result<Mark> {
        self.wait_for_updates(1, 0.0)?;
        let mut updates = self.poll()?.len();
        for _ in 0..MARK_ATTEMPTS {
            let (tally, fleet_cpu_s) = self.fleet.ask("mark")?;
            let after = self.poll()?.len();
            if after == updates {
                return Ok(self.mark_of(updates, tally, fleet_cpu_s));
            }
            updates = after;
        }
        let (tally, fleet_cpu_s) = self.fleet.ask("mark")?;
        Ok(self.mark_of(updates, tally, fleet_cpu_s))
    }

    fn mark_of(&self, updates: usize, tally: Tally, fleet_cpu_s: f64) -> Mark {
        Mark {
            updates,
            tally,
            at: Instant::now(),
            fleet_cpu_s,
            learner_cpu_s: self.learner.cpu_s(),
            routers_cpu_s: self.routers.iter().map(Process::cpu_s).sum(),
            training_thread_s: self.learner.training_thread_s(),
            sent_bytes: self.learner.sent_bytes(),
        }
    }

    /// Ends all processes and returns the updates of the whole run.
    fn stop(self) -> anyhow::Result<Vec<LoggedUpdate>> {
        let Self { fleet, routers, mut learner, mut metrics, .. } = self;
        drop((fleet, routers));
        learner.stop()?;
        Ok(metrics.poll()?.to_vec())
    }
}

/// Processes of played actors.
struct PlayedFleet {
    processes: Vec<Helper>,
    /// Actors of each process.
    sizes: Vec<usize>,
    /// Seconds until every actor had its policy and its token.
    joined_s: f64,
    bundle_bytes: f64,
}

impl PlayedFleet {
    fn start(plan: &MeasurementPlan, endpoints: &[&str]) -> anyhow::Result<Self> {
        let count = plan.processes.min(plan.actors);
        let sizes: Vec<usize> =
            (0..count).map(|process| plan.actors / count + usize::from(process < plan.actors % count)).collect();
        let mut first = 0;
        let mut processes = Vec::new();
        for size in &sizes {
            let mut args = vec!["fleet-actors".to_string()];
            for (flag, value) in [("--first", first as u64), ("--actors", *size as u64), ("--envs", plan.envs.into())] {
                args.extend([flag.to_string(), value.to_string()]);
            }
            args.extend(endpoints.iter().flat_map(|endpoint| ["--connect".to_string(), (*endpoint).to_string()]));
            args.extend(plan.network.iter().cloned());
            processes.push(Helper::start(&args, NICE)?);
            first += size;
        }
        let (mut joined_s, mut bundle_bytes) = (0.0f64, 0.0);
        for process in &mut processes {
            let joined = process.receive()?;
            joined_s = joined_s.max(number(&joined, "joined_s")?);
            bundle_bytes = number(&joined, "bundle_bytes")?;
        }
        Ok(Self { processes, sizes, joined_s, bundle_bytes })
    }

    fn set_rates(&mut self, rates: &[f64]) -> anyhow::Result<()> {
        let mut rest = rates;
        for (process, size) in self.processes.iter_mut().zip(&self.sizes) {
            let (own, others) = rest.split_at(*size);
            process.ask(&format!("rates {}", own.iter().map(f64::to_string).collect::<Vec<_>>().join(",")))?;
            rest = others;
        }
        Ok(())
    }

    /// Sends a command to every process. Returns the sums of the counts and the processor time in seconds.
    fn ask(&mut self, command: &str) -> anyhow::Result<(Tally, f64)> {
        self.processes.iter_mut().try_for_each(|process| process.send(command))?;
        let (mut sum, mut cpu_s) = (Tally::default(), 0.0);
        for process in &mut self.processes {
            let answer = process.receive()?;
            sum.add(Tally::from_json(&answer)?);
            cpu_s += number(&answer, "cpu_s")?;
        }
        Ok((sum, cpu_s))
    }

    /// Returns the times of all actors, sorted.
    fn times(&mut self) -> anyhow::Result<Times> {
        let mut times = Times::default();
        for process in &mut self.processes {
            let answer = process.ask("times").context("the measured times are lost")?;
            times.receipts_ms.extend(numbers(&answer["receipts_ms"]));
            times.fetches_ms.extend(numbers(&answer["fetches_ms"]));
            times.late_ms.extend(numbers(&answer["late_ms"]));
        }
        for kind in [&mut times.receipts_ms, &mut times.fetches_ms, &mut times.late_ms] {
            kind.sort_by(f64::total_cmp);
        }
        Ok(times)
    }
}
