//! `bench policy`: action means for a few rows, as an actor computes them in every control step.

use std::time::Instant;

use clap::Args;
use serde_json::json;
use treadmill_policy::Policy;
use treadmill_runtime::{machine, seeds};

use crate::launch::output::say_result;

use super::{
    network::{self, BenchSymmetry, Widths},
    rounded,
};

/// Calls before the clock starts.
const WARM_UP: u32 = 100;

/// Flags of `bench policy`.
#[derive(Args)]
pub struct PolicyArgs {
    /// Calls to measure.
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    calls: u32,
    /// Observations per call.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    rows: u32,
    /// Widths of the actor's network: observation, then hidden layers.
    #[arg(long, value_name = "WIDTHS", default_value = "45-256-128")]
    network: Widths,
    /// Dense networks, or networks that act mirrored in mirrored states.
    #[arg(long, value_enum, default_value = "equivariant")]
    symmetry: BenchSymmetry,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Runs the measurement and prints its result.
pub fn run(args: &PolicyArgs) -> anyhow::Result<()> {
    let (networks, rows) = (args.network.networks(args.symmetry)?, args.rows as usize);
    let shape = networks.shape().clone();
    let mut random = seeds::stream(1, "bench-policy", &[]);
    let parameters = networks.initial_parameters(-0.5, &mut random);
    let policy = Policy::new(networks, parameters)?;
    let observations = network::normals(rows * shape.observation, &mut random);
    let mut means = vec![0.0; rows * shape.action];
    for _ in 0..WARM_UP {
        policy.means(&observations, rows, &mut means);
    }
    let begun = Instant::now();
    for _ in 0..args.calls {
        policy.means(&observations, rows, &mut means);
    }
    let call_us = begun.elapsed().as_secs_f64() * 1e6 / f64::from(args.calls);
    let result = json!({
        "call_us": (call_us * 100.0).round() / 100.0,
        "rows_per_s": rounded(rows as f64 * 1e6 / call_us),
        "rows": rows,
        "network": format!("{} actor", args.network),
        "threads": 1,
        "cpu": machine::cpu_name(),
        "workload": format!("{} calls with {rows} normalised observations: action means", args.calls),
        "checksum": network::checksum(&means),
    });
    say_result(&result, args.json);
    Ok(())
}
