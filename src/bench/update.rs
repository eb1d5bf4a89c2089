//! The update on made-up experience: forward, loss, backward, gradient clipping, Adam.

use std::{sync::Arc, time::Instant};

use clap::Args;
use rand_distr::{Distribution, StandardNormal};
use serde_json::json;
use treadmill_common::{
    config::PpoConfig,
    machine,
    policy::{NetworkShape, gaussian, init::initial_parameters},
    seeds,
};
use treadmill_learner::ppo::{Batch, Updater};

use super::{rounded, tell};

/// Flags of `bench update`.
#[derive(Args)]
pub struct UpdateArgs {
    /// Updates to measure over, after one that warms up.
    #[arg(long, default_value_t = 10)]
    updates: u32,
    /// Threads; 0 means one per core.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Transitions of one gradient step.
    #[arg(long, default_value_t = 2048)]
    minibatch: u32,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Measures and tells.
pub fn run(args: &UpdateArgs) -> anyhow::Result<()> {
    let shape = NetworkShape { observation: 45, action: 17, hidden: vec![256, 128] };
    let minibatch = args.minibatch.max(1);
    let config = PpoConfig { minibatch, batch: minibatch.saturating_mul(4), ..PpoConfig::default() };
    let mut random = seeds::stream(1, "bench-update", &[]);
    let parameters = initial_parameters(&shape, -0.5, &mut random);
    let batch = made_up(&shape, config.batch as usize, &mut random);
    let threads = if args.threads == 0 { machine::cores() } else { args.threads };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let mut updater = Updater::new(shape, parameters, &config, Arc::new(pool))?;
    updater.update(&batch, &mut random)?;
    let begun = Instant::now();
    let mut samples = 0;
    for _ in 0..args.updates.max(1) {
        samples += updater.update(&batch, &mut random)?.samples;
    }
    let samples_per_s = samples as f64 / begun.elapsed().as_secs_f64();
    let parameters: Vec<u8> = updater.parameters().iter().flat_map(|number| number.to_le_bytes()).collect();
    let result = json!({
        "samples_per_s": rounded(samples_per_s),
        "minibatch": minibatch,
        "network": "45-256-128 actor and critic",
        "threads": threads,
        "cpu": machine::cpu_name(),
        "workload": format!("{samples} samples: forward, loss, backward, gradient clipping, Adam"),
        "checksum": format!("{:016x}", seeds::checksum(&[&parameters])),
    });
    tell(&result, args.json);
    Ok(())
}

fn made_up(shape: &NetworkShape, rows: usize, random: &mut seeds::Stream) -> Batch {
    let mut normals = |count: usize| -> Vec<f32> { (0..count).map(|_| StandardNormal.sample(random)).collect() };
    let actions = normals(rows * shape.action);
    let (mean, log_std) = (vec![0.0; shape.action], vec![-0.5; shape.action]);
    Batch {
        observations: normals(rows * shape.observation),
        log_probs: actions
            .chunks_exact(shape.action)
            .map(|action| gaussian::log_probability(action, &mean, &log_std))
            .collect(),
        actions,
        weights: vec![1.0; rows],
        advantages: normals(rows),
        returns: normals(rows),
        values: normals(rows),
    }
}
