//! Results on a GPU equal those on the processor. Built only with `--features cuda`; without a GPU, the tests only check
//! the error message.

use std::sync::Arc;

use rand_distr::{Distribution, StandardNormal};
use treadmill_config::PpoConfig;
use treadmill_policy::{
    NetworkShape, Policy,
    device::{Device, DeviceKind},
    gaussian,
    init::initial_parameters,
};
use treadmill_ppo::{Batch, Ppo, PpoOptions, PpoState};
use treadmill_runtime::{error_chain, seeds};

const ROWS: usize = 4096;

/// Opens the GPU; `None` if the machine has none, after checking the error message.
fn gpu() -> Option<Device> {
    match DeviceKind::Cuda.open() {
        Ok(device) => Some(device),
        Err(why) => {
            let why = error_chain(&why);
            assert!(why.starts_with("no CUDA device can be used") && why.contains("use --device cpu"), "{why}");
            eprintln!("SKIPPED: {why}");
            None
        }
    }
}

fn shape() -> NetworkShape {
    NetworkShape { observation: 45, action: 17, hidden: vec![256, 128], privileged: 0 }
}

fn pool() -> Arc<rayon::ThreadPool> {
    Arc::new(rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap())
}

fn normals(count: usize, random: &mut seeds::Stream) -> Vec<f32> {
    (0..count).map(|_| StandardNormal.sample(random)).collect()
}

fn batch(random: &mut seeds::Stream) -> Batch {
    let actions = normals(ROWS * 17, random);
    let log_probs = actions.chunks_exact(17).map(|a| gaussian::log_probability(a, &[0.0; 17], &[-0.5; 17])).collect();
    Batch {
        observations: normals(ROWS * 45, random),
        log_probs,
        means: vec![0.0; actions.len()],
        actions,
        weights: vec![1.0; ROWS],
        advantages: normals(ROWS, random),
        returns: normals(ROWS, random),
        values: normals(ROWS, random),
    }
}

/// Returns the largest error relative to the root mean square of `expected`.
fn largest_error(found: &[f32], expected: &[f32]) -> f32 {
    let square = expected.iter().map(|e| e * e).sum::<f32>() / expected.len() as f32;
    found.iter().zip(expected).map(|(f, e)| (f - e).abs()).fold(0.0, f32::max) / square.sqrt()
}

#[test]
fn a_gpu_gives_the_means_and_values_of_the_processor() {
    let Some(device) = gpu() else { return };
    let mut random = seeds::stream(1, "cuda", &[]);
    let parameters =
        Networks::from(shape()).initial_parameters(-0.5, &mut random).iter().map(|p| p * 2.0).collect::<Vec<_>>();
    let observations = normals(ROWS * 45, &mut random);
    let [there, here] = [&device, &Device::Cpu].map(|device| {
        let policy = Policy::with_pool(shape(), parameters.clone(), pool(), device).unwrap();
        let mut means = vec![0.0; ROWS * 17];
        policy.means(&observations, ROWS, &mut means).unwrap();
        (means, policy.values(&observations, ROWS).unwrap())
    });
    assert!(largest_error(&there.0, &here.0) < 1e-4);
    assert!(largest_error(&there.1, &here.1) < 1e-4);
}

#[test]
fn an_update_on_a_gpu_is_that_of_the_processor() {
    let Some(device) = gpu() else { return };
    let mut random = seeds::stream(2, "cuda", &[]);
    let parameters = Networks::from(shape()).initial_parameters(-0.5, &mut random);
    let batch = batch(&mut random);
    let config = PpoConfig { batch: ROWS as u32, ..PpoConfig::default() };
    let [there, here] = [&device, &Device::Cpu].map(|device| {
        let options =
            PpoOptions { shape: shape(), device: device.clone(), pool: pool(), mirror: None, observation_clip: 10.0 };
        let mut state = PpoState::new(&shape(), parameters.clone(), seeds::stream(3, "order", &[]), &config);
        let stats = Ppo::new(options, &config).update(&mut state, &batch, config.epochs).unwrap();
        (state.parameters().to_vec(), stats)
    });
    assert!(largest_error(&here.0, &parameters) > 1e-2, "the parameters changed");
    assert!(largest_error(&there.0, &here.0) < 1e-3);
    for (found, expected) in [
        (there.1.value_loss, here.1.value_loss),
        (there.1.approx_kl, here.1.approx_kl),
        (there.1.grad_norm, here.1.grad_norm),
        (there.1.std, here.1.std),
    ] {
        assert!((found - expected).abs() < 1e-3 * expected.abs().max(1e-3), "{found} {expected}");
    }
}
