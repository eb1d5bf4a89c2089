//! `bench update`: an update on random experience, with forward and backward pass, gradient clipping and Adam.

use std::time::Instant;

use clap::Args;
use serde_json::json;
use treadmill_config::PpoConfig;
use treadmill_policy::{NetworkShape, Networks, gaussian};
use treadmill_ppo::{Batch, Ppo, PpoOptions, PpoState, device::DeviceKind, settings};
use treadmill_runtime::{error_chain, machine, seeds};

use crate::launch::{exit_code::Usage, memory, output::say_result};

use super::{
    network::{self, BenchSymmetry, Widths},
    rounded,
};

/// Flags of `bench update`.
#[derive(Args)]
pub struct UpdateArgs {
    /// Updates to measure, after one for warm-up.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    updates: u32,
    /// Threads of the update; 0 means one per core.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256))]
    threads: u16,
    /// Rows that a thread takes at a time; 0 means what a new run has for so many threads.
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=4096))]
    chunk_rows: u32,
    /// Transitions per gradient step.
    #[arg(long, default_value_t = 2048, value_parser = clap::value_parser!(u32).range(1..=4_194_304))]
    minibatch: u32,
    /// Widths of actor and critic networks: observation, then hidden layers.
    #[arg(long, value_name = "WIDTHS", default_value = "45-256-128")]
    network: Widths,
    /// Dense networks, or networks that act mirrored in mirrored states.
    #[arg(long, value_enum, default_value = "equivariant")]
    symmetry: BenchSymmetry,
    /// Device of the update: cpu, cuda (an NVIDIA GPU), or candle (Candle's tensors on the processor).
    #[arg(long, value_name = "DEVICE", default_value = "cpu")]
    device: DeviceKind,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Runs the measurement and prints its result.
pub fn run(args: &UpdateArgs) -> anyhow::Result<()> {
    memory::keep_freed();
    let device = args.device.open().map_err(|why| Usage(error_chain(&why)))?;
    let networks = args.network.networks(args.symmetry)?;
    let minibatch = args.minibatch;
    let threads = machine::threads(args.threads.into());
    let chunk_rows = match args.chunk_rows {
        0 => settings::chunk_rows(&PpoConfig { minibatch, ..PpoConfig::default() }, threads),
        rows => rows,
    };
    let options = PpoOptions { device, chunk_rows: chunk_rows as usize, ..PpoOptions::on_cpu(threads)? };
    let (samples, samples_per_s, state) = measure(options, networks, minibatch, args.updates)?;
    let result = json!({
        "samples_per_s": rounded(samples_per_s),
        "minibatch": minibatch,
        "network": format!("{} actor and critic", args.network),
        "device": args.device.name(),
        "threads": threads,
        "chunk_rows": chunk_rows,
        "cpu": machine::cpu_name(),
        "workload": format!("{samples} samples: forward, loss, backward, gradient clipping, Adam"),
        "checksum": network::checksum(state.parameters()),
    });
    say_result(&result, args.json);
    Ok(())
}

/// Takes updates of four minibatches after one for warm-up. Returns samples, samples per second, and the state.
pub(crate) fn measure(
    options: PpoOptions,
    networks: Networks,
    minibatch: u32,
    updates: u32,
) -> anyhow::Result<(u64, f64, PpoState)> {
    let config = PpoConfig { minibatch, batch: 4 * minibatch, ..PpoConfig::default() };
    let mut random = seeds::stream(1, "bench-update", &[]);
    let parameters = networks.initial_parameters(-0.5, &mut random);
    let batch = random_batch(networks.shape(), config.batch as usize, &mut random);
    let mut state = PpoState::new(networks, parameters, random, &config);
    let ppo = Ppo::new(options, &config);
    ppo.update(&mut state, &batch, config.epochs)?;
    let begun = Instant::now();
    let mut samples = 0;
    for _ in 0..updates {
        samples += ppo.update(&mut state, &batch, config.epochs)?.samples;
    }
    Ok((samples, samples as f64 / begun.elapsed().as_secs_f64(), state))
}

fn random_batch(shape: &NetworkShape, rows: usize, random: &mut seeds::Stream) -> Batch {
    let mut normals = |count: usize| network::normals(count, random);
    let actions = normals(rows * shape.action);
    let (mean, log_std) = (vec![0.0; shape.action], vec![-0.5; shape.action]);
    Batch {
        observations: normals(rows * shape.observation),
        log_probs: actions
            .chunks_exact(shape.action)
            .map(|action| gaussian::log_probability(action, &mean, &log_std))
            .collect(),
        means: vec![0.0; actions.len()],
        actions,
        weights: vec![1.0; rows],
        advantages: normals(rows),
        returns: normals(rows),
        values: normals(rows),
    }
}
