//! Measurement with one number of actors, in processes of its own.

use std::time::Duration;

use anyhow::Context;
use serde_json::{Value, json};

use crate::{
    helper::{Helper, number, numbers},
    raw::Raw,
    rounded,
};

/// Most processes that the actors are spread over.
const LOAD_PROCESSES: u32 = 4;
/// Most times that a measurement may exceed its duration: many actors on a busy machine need longer.
const EXTENSION_MAX: f64 = 6.0;
/// Interval at which the number of accepted fragments is polled.
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// Parameters of a measurement.
pub struct LoadStep<'a> {
    pub actors: u32,
    pub seconds: f64,
    pub fragment_bytes: usize,
    pub in_flight: u32,
    pub pause_ms: u64,
    pub precision: &'a str,
    pub broadcasts: u32,
    pub endpoint: &'a str,
    pub network: &'a [String],
}

/// Result of a measurement.
pub struct Measured {
    actors: u32,
    pub fragment_bytes: u64,
    pub bundle_bytes: u64,
    pub checksum: String,
    fragments: f64,
    in_place: f64,
    elapsed_s: f64,
    /// Time until a fragment of every actor was accepted, if all begin at once.
    first_s: f64,
    receipts_ms: Vec<f64>,
    policies_ms: Vec<f64>,
    bytes_per_transition: f64,
    busy: f64,
    silent: f64,
    refused: f64,
    learner_cpu_s: f64,
    actors_cpu_s: f64,
    resident_mb: f64,
    resident_max_mb: f64,
    shared_mb: f64,
}

impl LoadStep<'_> {
    /// Starts the processes and measures.
    pub fn measure(&self) -> anyhow::Result<Measured> {
        let strings = |args: &[&str]| args.iter().map(|arg| (*arg).to_string()).collect::<Vec<_>>();
        let mut host =
            Helper::start(&[strings(&["bus-host", "--listen", self.endpoint]), self.network.to_vec()].concat(), 0)?;
        let started = host.receive()?;
        let endpoint = started["endpoint"].as_str().context("the learner has an endpoint")?.to_string();
        let mut loads = self.start_loads(&endpoint)?;
        let (mut fragment_bytes, mut bytes_per_transition) = (0, 0.0);
        for load in &mut loads {
            let ready = load.receive()?;
            fragment_bytes = number(&ready, "fragment_bytes")? as u64;
            bytes_per_transition = number(&ready, "bytes_per_transition")?;
        }
        // Measures after the first fragment of every actor was accepted, and then at least two of each.
        let begun = host.ask("mark")?;
        send_to_all(&mut loads, "send")?;
        let mut known = 0.0;
        for load in &mut loads {
            known += number(&load.receive()?, "taken_of_actors")?;
        }
        anyhow::ensure!(
            known == f64::from(self.actors),
            "only {known} of {} actors could deliver a fragment",
            self.actors
        );
        let before = host.ask("mark")?;
        send_to_all(&mut loads, "measure")?;
        let after = self.wait_for(&mut host, &before, 2.0 * f64::from(self.actors * self.in_flight), self.seconds)?;
        send_to_all(&mut loads, "stop")?;
        let difference = |field| Ok::<_, anyhow::Error>(number(&after, field)? - number(&before, field)?);
        let mut measured = Measured {
            actors: self.actors,
            fragment_bytes,
            bundle_bytes: number(&started, "bundle_bytes")? as u64,
            checksum: String::new(),
            fragments: difference("accepted")?,
            in_place: difference("in_place")?,
            elapsed_s: difference("at_s")?,
            first_s: number(&before, "at_s")? - number(&begun, "at_s")?,
            receipts_ms: Vec::new(),
            policies_ms: Vec::new(),
            bytes_per_transition,
            busy: 0.0,
            silent: 0.0,
            refused: 0.0,
            learner_cpu_s: difference("cpu_s")?,
            actors_cpu_s: 0.0,
            resident_mb: 0.0,
            resident_max_mb: 0.0,
            shared_mb: 0.0,
        };
        measured.add_outcomes(&mut loads)?;
        self.broadcast(&mut host, &mut loads, &mut measured)?;
        let end = host.ask("mark")?;
        measured.checksum = end["checksum"].as_str().unwrap_or_default().to_string();
        measured.resident_mb = number(&end, "resident_mb")?;
        measured.shared_mb = number(&end, "shared_mb")?;
        measured.resident_max_mb = number(&end, "resident_max_mb")?;
        measured.receipts_ms.sort_by(f64::total_cmp);
        measured.policies_ms.sort_by(f64::total_cmp);
        Ok(measured)
    }

    /// Publishes policies and measures how long each actor takes to fetch them.
    fn broadcast(&self, host: &mut Helper, loads: &mut [Helper], measured: &mut Measured) -> anyhow::Result<()> {
        for policy in 1..=self.broadcasts {
            send_to_all(loads, &format!("expect {policy}"))?;
            let published_s = number(&host.ask(&format!("publish {policy}"))?, "time_unix_s")?;
            for load in &mut *loads {
                let times = load.receive()?;
                measured.policies_ms.extend(numbers(&times["times_unix_s"]).map(|time_s| (time_s - published_s) * 1e3));
            }
        }
        Ok(())
    }

    /// Waits until `fragments` more were accepted and `seconds` have passed, with a limit.
    fn wait_for(&self, host: &mut Helper, since: &Value, fragments: f64, seconds: f64) -> anyhow::Result<Value> {
        loop {
            let now = host.ask("mark")?;
            let passed_s = number(&now, "at_s")? - number(since, "at_s")?;
            let accepted = number(&now, "accepted")? - number(since, "accepted")?;
            if passed_s >= seconds && accepted >= fragments {
                return Ok(now);
            }
            anyhow::ensure!(
                passed_s < self.seconds * EXTENSION_MAX,
                "after {passed_s:.0} s only {accepted} of {fragments} fragments are accepted; raise --seconds, or lower \
                 --actors, --fragment-mb or --pause-ms"
            );
            std::thread::sleep(POLL_INTERVAL);
        }
    }

    fn start_loads(&self, endpoint: &str) -> anyhow::Result<Vec<Helper>> {
        let processes = LOAD_PROCESSES.min(self.actors);
        let mut first = 0;
        (0..processes)
            .map(|process| {
                let actors = self.actors / processes + u32::from(process < self.actors % processes);
                let mut args = vec!["bus-load".to_string(), "--connect".to_string(), endpoint.to_string()];
                for (flag, value) in [
                    ("--first", u64::from(first)),
                    ("--actors", actors.into()),
                    ("--in-flight", self.in_flight.into()),
                    ("--fragment-bytes", self.fragment_bytes as u64),
                    ("--pause-ms", self.pause_ms),
                ] {
                    args.extend([flag.to_string(), value.to_string()]);
                }
                args.extend(["--precision".to_string(), self.precision.to_string()]);
                args.extend_from_slice(self.network);
                first += actors;
                Helper::start(&args, 0)
            })
            .collect()
    }
}

fn send_to_all(loads: &mut [Helper], line: &str) -> anyhow::Result<()> {
    loads.iter_mut().try_for_each(|load| load.send(line))
}

impl Measured {
    /// Adds the answers to `stop`.
    fn add_outcomes(&mut self, loads: &mut [Helper]) -> anyhow::Result<()> {
        for load in loads {
            let outcomes = load.receive()?;
            self.receipts_ms.extend(numbers(&outcomes["receipts_ms"]));
            self.busy += number(&outcomes, "busy")?;
            self.silent += number(&outcomes, "silent")?;
            self.refused += number(&outcomes, "refused")?;
            self.actors_cpu_s += number(&outcomes, "cpu_s")?;
        }
        Ok(())
    }

    fn megabytes(&self) -> f64 {
        self.fragments * self.fragment_bytes as f64 / 1e6
    }

    fn mb_per_s(&self) -> f64 {
        self.megabytes() / self.elapsed_s
    }

    /// Returns all figures by name.
    pub fn fields(&self, raw: Raw) -> Value {
        let (fragments, gb) = (self.fragments.max(1.0), (self.megabytes() / 1e3).max(1e-9));
        let cpu_s_per_gb = (self.learner_cpu_s + self.actors_cpu_s) / gb;
        json!({
            "actors": self.actors,
            "accepted_mb_per_s": rounded(self.mb_per_s()),
            "accepted_fragments": self.fragments,
            "measured_s": rounded(self.elapsed_s),
            "first_of_all_s": share(self.first_s),
            "bytes_per_transition": ms(self.bytes_per_transition),
            "policies_fetched": self.policies_ms.len(),
            "through_shared_memory": self.in_place,
            "raw_tcp_mb_per_s": rounded(raw.mb_per_s),
            "ratio_to_raw_tcp": share(self.mb_per_s() / raw.mb_per_s),
            "receipt_p50_ms": ms(quantile(&self.receipts_ms, 0.5)),
            "receipt_p99_ms": ms(quantile(&self.receipts_ms, 0.99)),
            "policy_p50_ms": ms(quantile(&self.policies_ms, 0.5)),
            "policy_p99_ms": ms(quantile(&self.policies_ms, 0.99)),
            "policy_max_ms": ms(quantile(&self.policies_ms, 1.0)),
            "learner_resident_mb": rounded(self.resident_mb),
            "learner_resident_max_mb": rounded(self.resident_max_mb),
            "learner_shared_mb": rounded(self.shared_mb),
            "learner_cpu_s_per_gb": share(self.learner_cpu_s / gb),
            "actors_cpu_s_per_gb": share(self.actors_cpu_s / gb),
            "raw_tcp_cpu_s_per_gb": share(raw.cpu_s_per_gb),
            "cpu_ratio_to_raw_tcp": share(raw.cpu_s_per_gb / cpu_s_per_gb.max(1e-9)),
            "learner_cpu_ms_per_fragment": share(self.learner_cpu_s * 1e3 / fragments),
            "busy": self.busy,
            "silent": self.silent,
            "refused": self.refused,
        })
    }

    /// Returns the row of the table.
    pub fn row(&self, raw: Raw) -> String {
        let fields = self.fields(raw);
        COLUMNS.map(|(field, _, width)| format!("{:>width$}", fields[field].to_string())).join(" ")
    }
}

/// Field, heading and width of each column.
const COLUMNS: [(&str, &str, usize); 11] = [
    ("actors", "actors", 6),
    ("accepted_mb_per_s", "MB/s", 8),
    ("raw_tcp_mb_per_s", "raw MB/s", 9),
    ("ratio_to_raw_tcp", "ratio", 6),
    ("receipt_p50_ms", "p50 ms", 9),
    ("receipt_p99_ms", "p99 ms", 9),
    ("policy_p99_ms", "policy p99", 10),
    ("learner_resident_max_mb", "max MB", 8),
    ("learner_cpu_s_per_gb", "learner s/GB", 12),
    ("actors_cpu_s_per_gb", "actors s/GB", 11),
    ("cpu_ratio_to_raw_tcp", "CPU ratio", 9),
];

/// Returns the head of the table.
pub fn heading() -> String {
    COLUMNS.map(|(_, heading, width)| format!("{heading:>width$}")).join(" ")
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

    #[test]
    fn quantiles_are_ranks() {
        let numbers: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(quantile(&numbers, 0.5), 50.0);
        assert_eq!(quantile(&numbers, 0.99), 99.0);
        assert_eq!(quantile(&numbers, 1.0), 100.0);
        assert_eq!(quantile(&[7.0], 0.5), 7.0);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }
}
