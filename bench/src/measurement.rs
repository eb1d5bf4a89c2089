//! Starts a learner, routers and played actors, sets the rates, and marks the measured window.

use std::{
    fs,
    path::PathBuf,
    time::{Duration, Instant},
};

use anyhow::Context;
use serde_json::Value;

use crate::{
    RUN,
    figures::{Figures, Mark, update_rate},
    played::{counts::Tally, fleet::PlayedFleet},
    process::{Process, flags, sent_bytes},
    run_metrics::{LoggedUpdate, RunMetrics},
};

/// More environment steps than any measurement trains.
const ENDLESS: &str = "1000000000000";
/// Nice value of routers and played actors, so that the learner has the machine as if they ran elsewhere.
const NICE: i32 = 19;
/// Interval at which the learner's metrics are read.
const POLL: Duration = Duration::from_millis(10);
/// Longest wait until the learner listens.
const START_TIMEOUT: Duration = Duration::from_secs(60);
/// Longest wait for an update.
const UPDATE_TIMEOUT: Duration = Duration::from_secs(120);
/// Updates that are not measured when rates change.
const WARMUP_UPDATES: usize = 3;
/// Fewest updates of a measurement.
const UPDATES_MIN: usize = 5;
/// Attempts to read the played actors' counts without an update meanwhile.
const MARK_ATTEMPTS: u32 = 20;

/// Parameters of a measurement.
pub struct MeasurementPlan {
    pub actors: usize,
    pub envs: u32,
    /// Environment steps per second of each actor; by default all together have `load` of the update's own speed.
    pub rate: Option<f64>,
    pub load: f64,
    /// Factors on the rates of the last actors.
    pub slow: Vec<f64>,
    pub routers: usize,
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
    /// Starts the processes, measures, stops them, and returns all figures by name.
    pub fn measure(&self) -> anyhow::Result<Value> {
        let mut measurement = Measurement::start(self)?;
        let factors = [vec![1.0; self.actors - self.slow.len()], self.slow.clone()].concat();
        let before_s = self.seconds / 4.0;
        let each = match self.rate {
            Some(rate) => rate,
            None => self.load * measurement.calibrate(before_s)? / factors.iter().sum::<f64>(),
        };
        let rates: Vec<f64> = factors.iter().map(|factor| factor * each).collect();
        measurement.fleet.set_rates(&rates)?;
        measurement.wait_for_all_alive()?;
        measurement.wait_for_updates(WARMUP_UPDATES, before_s)?;
        let begin = measurement.mark()?;
        measurement.fleet.ask("forget")?;
        measurement.wait_for_updates(UPDATES_MIN, self.seconds)?;
        let end = measurement.mark()?;
        let times = measurement.fleet.times()?;
        let final_tally = measurement.fleet.ask("stop")?;
        let (joined_s, bundle_bytes) = (measurement.fleet.joined_s, measurement.fleet.bundle_bytes);
        let learner_resident_max_mb = measurement.learner.resident_max_mb();
        let updates = measurement.stop()?;
        let (rates, envs, updates) = (&rates[..], self.envs, &updates[..]);
        Figures {
            rates,
            envs,
            joined_s,
            bundle_bytes,
            begin,
            end,
            times,
            final_tally,
            learner_resident_max_mb,
            updates,
        }
        .to_json()
    }
}

/// Running processes of a measurement. Actors end before routers, and routers before the learner.
struct Measurement {
    fleet: PlayedFleet,
    routers: Vec<Process>,
    learner: Process,
    /// Endpoint of the learner.
    endpoint: String,
    metrics: RunMetrics,
    actors: usize,
}

impl Measurement {
    fn start(plan: &MeasurementPlan) -> anyhow::Result<Self> {
        let run = plan.folder.join(RUN);
        let mut args = flags(&[
            ("--run", RUN.to_string()),
            ("--steps", ENDLESS.to_string()),
            ("--listen", plan.listen.to_string()),
            ("--run-dir", run.display().to_string()),
        ]);
        args.extend(plan.learner.iter().chain(&plan.network).cloned());
        args.push("--no-progress".to_string());
        let mut learner = Process::of_treadmill("learner", &args, 0, Some(plan.folder.join("learner.log")))?;
        let (file, begun) = (run.join("endpoint.txt"), Instant::now());
        let endpoint = loop {
            learner.check_runs()?;
            match fs::read_to_string(&file) {
                Ok(text) if text.ends_with('\n') => break text.trim().to_string(),
                _ => std::thread::sleep(POLL),
            }
            anyhow::ensure!(begun.elapsed() < START_TIMEOUT, "the learner does not listen");
        };
        let (mut routers, mut endpoints) = (Vec::new(), Vec::new());
        let own = flags(&[("--listen", plan.listen.to_string()), ("--connect", endpoint.clone())]);
        for _ in 0..plan.routers {
            let mut router = Process::of_treadmill("router", &[&own[..], &plan.network].concat(), NICE, None)?;
            let line = router.line()?;
            endpoints.push(line.strip_prefix("listening ").context("a router does not listen")?.trim().to_string());
            routers.push(router);
        }
        if endpoints.is_empty() {
            endpoints.push(endpoint.clone());
        }
        let fleet = PlayedFleet::start(plan.actors, plan.envs, &endpoints, &plan.network, NICE)?;
        let metrics = RunMetrics::follow(run.join("metrics.jsonl"));
        Ok(Self { fleet, routers, learner, endpoint, metrics, actors: plan.actors })
    }

    /// Measures the update's own speed while the actors deliver as fast as they can.
    fn calibrate(&mut self, seconds: f64) -> anyhow::Result<f64> {
        self.fleet.set_rates(&vec![f64::INFINITY; self.actors])?;
        self.wait_for_updates(WARMUP_UPDATES, 0.0)?;
        let before = self.metrics.poll()?.len();
        self.wait_for_updates(UPDATES_MIN, seconds)?;
        Ok(update_rate(&self.metrics.poll()?[before..]))
    }

    /// Waits for `count` more updates, and for `seconds`.
    fn wait_for_updates(&mut self, count: usize, seconds: f64) -> anyhow::Result<()> {
        let (begun, wanted) = (Instant::now(), self.metrics.poll()?.len() + count);
        let (mut known, mut newest) = (0, begun);
        loop {
            let updates = self.metrics.poll()?.len();
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
        while self.metrics.poll()?.last().is_none_or(|last| last.value("actors/alive") < self.actors as f64) {
            anyhow::ensure!(begun.elapsed() < UPDATE_TIMEOUT, "not all actors are alive after {UPDATE_TIMEOUT:?}");
            self.wait_for_updates(1, 0.0)?;
        }
        Ok(())
    }

    /// Waits for an update and reads every count right after it.
    fn mark(&mut self) -> anyhow::Result<Mark> {
        self.wait_for_updates(1, 0.0)?;
        let mut updates = self.metrics.poll()?.len();
        let mut tally = Tally::default();
        for _ in 0..MARK_ATTEMPTS {
            tally = self.fleet.ask("mark")?;
            let before = std::mem::replace(&mut updates, self.metrics.poll()?.len());
            if before == updates {
                break;
            }
        }
        Ok(Mark {
            updates,
            tally,
            at: Instant::now(),
            fleet_cpu_s: self.fleet.cpu_s(),
            learner_cpu_s: self.learner.cpu_s(),
            routers_cpu_s: self.routers.iter().map(Process::cpu_s).sum(),
            sent_bytes: sent_bytes(&self.endpoint),
        })
    }

    /// Ends all processes and returns the updates of the whole run.
    fn stop(self) -> anyhow::Result<Vec<LoggedUpdate>> {
        let Self { fleet, routers, learner, mut metrics, .. } = self;
        drop((fleet, routers));
        learner.stop()?;
        Ok(metrics.poll()?.to_vec())
    }
}
