//! The bus under the load of several numbers of actors.

use std::{path::Path, time::Duration};

use anyhow::Context;
use clap::Args;
use serde_json::{Value, json};
use treadmill_rl::launch::{
    exit_code::Usage,
    output::{say, say_result},
};
use treadmill_runtime::machine;

use crate::{
    helper,
    load_step::{self, LoadStep, Measured},
    raw::{self, Raw},
};

/// Duration of each measurement of raw TCP.
const RAW_DURATION: Duration = Duration::from_secs(1);

/// Flags of `bus`.
#[derive(Args)]
pub struct BusArgs {
    /// Numbers of actors, measured one after the other.
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_values_t = [1, 10, 50, 100, 200], value_parser = clap::value_parser!(u32).range(1..=4000))]
    actors: Vec<u32>,
    /// Duration of each measurement in seconds.
    #[arg(long, value_name = "S", default_value_t = 5.0)]
    seconds: f64,
    /// Size of a fragment.
    #[arg(long, value_name = "MB", default_value_t = 3.0)]
    fragment_mb: f64,
    /// Unacknowledged fragments of each actor.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=16))]
    in_flight: u32,
    /// Pause of each actor after a receipt, in place of simulation; 0 sends as fast as possible.
    #[arg(long, value_name = "MS", default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=60_000))]
    pause_ms: u64,
    /// Precision of observations on the wire, as in rollout.observation_precision.
    #[arg(long, default_value = "f32", value_parser = ["f32", "f16"])]
    precision: String,
    /// Policies of 1 MB that the learner sends to all actors at each number of actors.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    broadcasts: u32,
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
        say(&load_step::heading());
    }
    for actors in &args.actors {
        let step = LoadStep {
            actors: *actors,
            seconds: args.seconds,
            fragment_bytes,
            in_flight: args.in_flight,
            pause_ms: args.pause_ms,
            precision: &args.precision,
            broadcasts: args.broadcasts,
            endpoint: if args.tls { "tls/127.0.0.1:0" } else { "tcp/127.0.0.1:0" },
            network: &network,
        };
        let measured = step.measure()?;
        let after = measure_raw()?;
        if !args.json {
            say(&measured.row(raw.mean(after)));
        }
        steps.push((measured, raw.mean(after)));
        raw = after;
    }
    say_result(&result(args, &steps)?, args.json);
    Ok(())
}

/// Returns the network flags of every process on the bus.
fn network(args: &BusArgs, folder: &Path) -> anyhow::Result<Vec<String>> {
    let mut flags = Vec::new();
    if args.tls {
        flags.extend(helper::certify(folder)?);
    }
    if args.shared_memory {
        flags.push("--shared-memory".to_string());
    }
    Ok(flags)
}

fn result(args: &BusArgs, steps: &[(Measured, Raw)]) -> anyhow::Result<Value> {
    let (last, raw) = steps.last().context("no step was measured")?;
    let mut result = last.fields(*raw);
    let transport = match (args.tls, args.shared_memory) {
        (false, false) => "tcp",
        (true, false) => "mutual tls",
        (false, true) => "shared memory",
        (true, true) => "mutual tls, shared memory",
    };
    let more = json!({
        "transport": transport,
        "fragment_bytes": last.fragment_bytes,
        "policy_bytes": last.bundle_bytes,
        "in_flight": args.in_flight,
        "pause_ms": args.pause_ms,
        "precision": args.precision,
        "cores": machine::cores(),
        "cpu": machine::cpu_name(),
        "workload": format!(
            "{} s at each number of actors, fragments of {} bytes, {} policies of {} bytes to all",
            args.seconds, last.fragment_bytes, args.broadcasts, last.bundle_bytes
        ),
        "checksum": last.checksum,
    });
    let fields = result.as_object_mut().context("fields are an object")?;
    fields.extend(more.as_object().cloned().unwrap_or_default());
    if args.json {
        let all: Vec<Value> = steps.iter().map(|(measured, raw)| measured.fields(*raw)).collect();
        fields.insert("steps".to_string(), all.into());
    }
    Ok(result)
}
