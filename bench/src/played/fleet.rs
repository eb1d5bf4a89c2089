//! Processes of played actors, as the measuring process sees them.

use anyhow::Context;

use super::counts::{Tally, Times};
use crate::process::{Process, flags, number};

/// Processes that the actors are spread over.
const PROCESSES: usize = 2;

/// Processes of played actors.
pub struct PlayedFleet {
    processes: Vec<Process>,
    /// Actors of each process.
    sizes: Vec<usize>,
    /// Seconds until every actor had its policy and its token.
    pub joined_s: f64,
    pub bundle_bytes: f64,
}

impl PlayedFleet {
    /// Starts `actors` actors of `envs` environments, at this nice value, and waits until they have joined.
    pub fn start(
        actors: usize,
        envs: u32,
        endpoints: &[String],
        network: &[String],
        nice: i32,
    ) -> anyhow::Result<Self> {
        let count = PROCESSES.min(actors);
        let sizes: Vec<usize> =
            (0..count).map(|process| actors / count + usize::from(process < actors % count)).collect();
        let (mut first, mut processes) = (0, Vec::new());
        for size in &sizes {
            let mut args =
                flags(&[("--first", first.to_string()), ("--actors", size.to_string()), ("--envs", envs.to_string())]);
            args.extend(endpoints.iter().flat_map(|endpoint| flags(&[("--connect", endpoint.clone())])));
            args.extend_from_slice(network);
            processes.push(Process::of_bench("played", &args, nice)?);
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

    /// Lets the actors simulate at these rates (environment steps per second).
    pub fn set_rates(&mut self, rates: &[f64]) -> anyhow::Result<()> {
        let mut rest = rates;
        for (process, size) in self.processes.iter_mut().zip(&self.sizes) {
            let (own, others) = rest.split_at(*size);
            process.ask(&format!("rates {}", own.iter().map(f64::to_string).collect::<Vec<_>>().join(",")))?;
            rest = others;
        }
        Ok(())
    }

    /// Sends a command to every process. Returns the sums of the counts.
    pub fn ask(&mut self, command: &str) -> anyhow::Result<Tally> {
        self.processes.iter_mut().try_for_each(|process| process.send(command))?;
        let mut sum = Tally::default();
        for process in &mut self.processes {
            sum.add(serde_json::from_value(process.receive()?).context("not the counts")?);
        }
        Ok(sum)
    }

    /// Returns the durations of all actors, sorted.
    pub fn times(&mut self) -> anyhow::Result<Times> {
        let mut times = Times::default();
        for process in &mut self.processes {
            times.add(&serde_json::from_value(process.ask("times")?).context("not the times")?);
        }
        for kind in [&mut times.receipts_ms, &mut times.fetches_ms, &mut times.late_ms] {
            kind.sort_by(f64::total_cmp);
        }
        Ok(times)
    }

    /// Waits until every actor has policy `number`. Returns the Unix times of the arrivals.
    pub fn arrivals(&mut self, number: u64) -> anyhow::Result<Vec<f64>> {
        self.processes.iter_mut().try_for_each(|process| process.send(&format!("arrived {number}")))?;
        let mut times = Vec::new();
        for process in &mut self.processes {
            let answer = process.receive()?;
            times.extend(answer["times_unix_s"].as_array().into_iter().flatten().filter_map(serde_json::Value::as_f64));
        }
        Ok(times)
    }

    /// Returns the processor time of all processes in seconds.
    pub fn cpu_s(&self) -> f64 {
        self.processes.iter().map(Process::cpu_s).sum()
    }
}
