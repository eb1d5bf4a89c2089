//! The bus under the load of several numbers of actors.

use std::{
    path::Path,
    time::{Duration, Instant},
};

use anyhow::Context;
use clap::Args;
use serde_json::{Value, json};
use treadmill_rl::launch::{
    exit_code::Usage,
    output::{say, say_result},
};
use treadmill_runtime::machine;

use crate::{
    figures::{ms, quantile, rounded, share},
    host,
    played::fleet::PlayedFleet,
    process::{Process, certify, flags, number},
    raw::{self, Raw},
};

/// Duration of each measurement of raw TCP.
const RAW_DURATION: Duration = Duration::from_secs(1);
/// Longest wait for the first accepted fragment of every actor.
const FIRST_FRAGMENTS_TIMEOUT: Duration = Duration::from_secs(60);
/// Most times that a measurement may exceed its duration: many actors on a busy machine need longer.
const EXTENSION_MAX: f64 = 6.0;
/// Interval at which accepted fragments are counted.
const POLL: Duration = Duration::from_millis(20);

/// Flags of `bus`.
#[derive(Args)]
pub struct BusArgs {
    /// Numbers of actors, measured one after the other.
    #[arg(
        long, value_name = "N,…", value_delimiter = ',', default_values_t = [1, 10, 50, 100, 200],
        value_parser = clap::value_parser!(u32).range(1..=4000)
    )]
    actors: Vec<u32>,
    /// Duration of each measurement in seconds.
    #[arg(long, value_name = "S", default_value_t = 5.0)]
    seconds: f64,
    /// Size of a fragment.
    #[arg(long, value_name = "MB", default_value_t = 3.0)]
    fragment_mb: f64,
    /// Precision of observations on the wire, as in rollout.observation_precision.
    #[arg(long, default_value = "f32", value_parser = ["f32", "f16"])]
    precision: String,
    /// Policies of 1 MB that the learner sends to all actors at each number of actors.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    broadcasts: u64,
    /// Encrypt every link, with temporary certificates.
    #[arg(long)]
    tls: bool,
    /// Send fragments through shared memory.
    #[arg(long)]
    shared_memory: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Runs the measurement and prints its result.
pub fn run(args: &BusArgs) -> anyhow::Result<()> {
    if !(args.seconds > 0.0 && args.seconds <= 3600.0) {
        return Err(Usage(format!("--seconds is {}; allowed: above 0, at most 3600", args.seconds)).into());
    }
    if !(args.fragment_mb >= 0.04 && args.fragment_mb <= 30.0) {
        return Err(Usage(format!("--fragment-mb is {}; allowed: 0.04 to 30", args.fragment_mb)).into());
    }
    let folder = tempfile::tempdir().context("cannot create a temporary folder")?;
    let network = network(args, folder.path())?;
    let fragment_bytes = (args.fragment_mb * 1e6) as usize;
    let measure_raw = || raw::measure(fragment_bytes, RAW_DURATION.min(Duration::from_secs_f64(args.seconds)));
    let (mut steps, mut raw) = (Vec::new(), measure_raw()?);
    if !args.json {
        say(&COLUMNS.map(|(_, heading, width)| format!("{heading:>width$}")).join(" "));
    }
    for actors in &args.actors {
        let measured = measure(args, *actors as usize, &network)?;
        let after = measure_raw()?;
        let [mb_per_s, cpu_s_per_gb] = [0, 1].map(|of| (raw[of] + after[of]) / 2.0);
        let step = with_raw(measured, [mb_per_s, cpu_s_per_gb])?;
        if !args.json {
            say(&COLUMNS.map(|(field, _, width)| format!("{:>width$}", step[field].to_string())).join(" "));
        }
        (raw, steps) = (after, [steps, vec![step]].concat());
    }
    say_result(&result(args, steps)?, args.json);
    Ok(())
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

/// Returns the network flags of every process on the bus.
fn network(args: &BusArgs, folder: &Path) -> anyhow::Result<Vec<String>> {
    let mut flags = Vec::new();
    if args.tls {
        flags.extend(certify(folder)?);
    }
    if args.shared_memory {
        flags.push("--shared-memory".to_string());
    }
    Ok(flags)
}

/// Measures one number of actors, in processes of its own, and returns all figures by name.
fn measure(args: &BusArgs, actors: usize, network: &[String]) -> anyhow::Result<Value> {
    let listen = if args.tls { "tls/127.0.0.1:0" } else { "tcp/127.0.0.1:0" };
    let own = flags(&[("--listen", listen.to_string()), ("--precision", args.precision.clone())]);
    let mut host = Process::of_bench("host", &[&own, network].concat(), 0)?;
    let endpoint = host.receive()?["endpoint"].as_str().context("the learner has an endpoint")?.to_string();
    let envs = host::envs((args.fragment_mb * 1e6) as usize, &args.precision);
    let mut fleet = PlayedFleet::start(actors, envs, &[endpoint], network, 0)?;
    // Measures after the first fragment of every actor was accepted, because admission control limits newcomers.
    let begun = Instant::now();
    fleet.set_rates(&vec![f64::INFINITY; actors])?;
    while fleet.ask("mark")?.proven < actors as u64 {
        anyhow::ensure!(begun.elapsed() < FIRST_FRAGMENTS_TIMEOUT, "not every actor could deliver a fragment");
        std::thread::sleep(POLL);
    }
    let first_s = begun.elapsed().as_secs_f64();
    fleet.ask("forget")?;
    let (before, in_place) = (fleet.ask("mark")?, number(&host.ask("mark")?, "in_place")?);
    let (begun, learner_cpu_s, actors_cpu_s) = (Instant::now(), host.cpu_s(), fleet.cpu_s());
    let after = loop {
        std::thread::sleep(POLL);
        let (now, passed_s) = (fleet.ask("mark")?, begun.elapsed().as_secs_f64());
        // At least two of each.
        if passed_s >= args.seconds && now.accepted - before.accepted >= 2 * actors as u64 {
            break now;
        }
        let accepted = now.accepted - before.accepted;
        anyhow::ensure!(
            passed_s < args.seconds * EXTENSION_MAX,
            "after {passed_s:.0} s only {accepted} fragments are accepted; raise --seconds, or lower --actors or \
             --fragment-mb"
        );
    };
    let (measured_s, learner_cpu_s) = (begun.elapsed().as_secs_f64(), host.cpu_s() - learner_cpu_s);
    let actors_cpu_s = fleet.cpu_s() - actors_cpu_s;
    let (times, stopped) = (fleet.times()?, fleet.ask("stop")?);
    let mut policies_ms = Vec::new();
    for policy in 1..=args.broadcasts {
        let published_s = number(&host.ask(&format!("publish {policy}"))?, "time_unix_s")?;
        policies_ms.extend(fleet.arrivals(policy)?.into_iter().map(|time_s| (time_s - published_s) * 1e3));
    }
    policies_ms.sort_by(f64::total_cmp);
    let end = host.ask("mark")?;
    let fragment_bytes = after.produced_bytes / after.produced.max(1);
    let megabytes = (after.accepted - before.accepted) as f64 * fragment_bytes as f64 / 1e6;
    let per_gb = |cpu_s: f64| cpu_s / (megabytes / 1e3).max(1e-9);
    Ok(json!({
        "actors": actors,
        "fragment_bytes": fragment_bytes,
        "policy_bytes": fleet.bundle_bytes,
        "bytes_per_transition": ms(after.produced_bytes as f64 / after.produced_steps.max(1) as f64),
        "accepted_mb_per_s": rounded(megabytes / measured_s),
        "first_of_all_s": share(first_s),
        "through_shared_memory": number(&end, "in_place")? - in_place,
        "receipt_p50_ms": ms(quantile(&times.receipts_ms, 0.5)),
        "receipt_p99_ms": ms(quantile(&times.receipts_ms, 0.99)),
        "policies_fetched": policies_ms.len(),
        "policy_p50_ms": ms(quantile(&policies_ms, 0.5)),
        "policy_p99_ms": ms(quantile(&policies_ms, 0.99)),
        "learner_resident_max_mb": rounded(host.resident_max_mb()),
        "learner_shared_mb": rounded(host.shared_mb()),
        "learner_cpu_s_per_gb": share(per_gb(learner_cpu_s)),
        "actors_cpu_s_per_gb": share(per_gb(actors_cpu_s)),
        "resent": stopped.resent,
        "dropped": stopped.dropped,
        "checksum": end["checksum"],
    }))
}

/// Adds the comparison with plain TCP.
fn with_raw(mut step: Value, [mb_per_s, cpu_s_per_gb]: Raw) -> anyhow::Result<Value> {
    let own_cpu_s_per_gb = number(&step, "learner_cpu_s_per_gb")? + number(&step, "actors_cpu_s_per_gb")?;
    step["raw_tcp_mb_per_s"] = rounded(mb_per_s).into();
    step["ratio_to_raw_tcp"] = share(number(&step, "accepted_mb_per_s")? / mb_per_s).into();
    step["raw_tcp_cpu_s_per_gb"] = share(cpu_s_per_gb).into();
    step["cpu_ratio_to_raw_tcp"] = share(cpu_s_per_gb / own_cpu_s_per_gb.max(1e-9)).into();
    Ok(step)
}

/// Returns the figures of the last step, with those of all steps for `--json`.
fn result(args: &BusArgs, steps: Vec<Value>) -> anyhow::Result<Value> {
    let mut result = steps.last().context("no step was measured")?.clone();
    result["transport"] = match (args.tls, args.shared_memory) {
        (false, false) => "tcp",
        (true, false) => "mutual tls",
        (false, true) => "shared memory",
        (true, true) => "mutual tls, shared memory",
    }
    .into();
    result["cores"] = machine::cores().into();
    result["cpu"] = machine::cpu_name().into();
    if args.json {
        result["steps"] = steps.into();
    }
    Ok(result)
}
