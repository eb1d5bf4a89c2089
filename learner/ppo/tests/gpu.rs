//! Updates on a GPU equal those on the processor. The GPU is that of `learner/gpu/tests/stand_in`, which runs the kernels,
//! or with TREADMILL_GPU=1 that of the machine.

#[path = "../../gpu/tests/stand_in/mod.rs"]
mod stand_in;

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_config::PpoConfig;
use treadmill_policy::{NetworkShape, Networks, Policy, PolicyMirror, gaussian};
use treadmill_ppo::{Batch, Ppo, PpoOptions, PpoState, UpdateError, UpdateStats, device::DeviceKind};

fn rng(seed: u64) -> Xoshiro256PlusPlus {
    Xoshiro256PlusPlus::seed_from_u64(seed)
}

/// Loads the driver, so that the program finds it by its name.
fn load_driver() {
    static LOADED: std::sync::Once = std::sync::Once::new();
    LOADED.call_once(|| {
        if std::env::var_os("TREADMILL_GPU").is_some() {
            return;
        }
        let folder = tempfile::tempdir().expect("a folder");
        // SAFETY: the library only defines functions.
        let library = unsafe { libloading::Library::new(stand_in::build(folder.path())) }.expect("it loads");
        std::mem::forget(library);
    });
}

/// Options of a device.
fn options(kind: DeviceKind) -> PpoOptions {
    load_driver();
    PpoOptions { device: kind.open().expect("the device opens"), ..PpoOptions::on_cpu(2).expect("threads start") }
}

/// Returns an experience of a policy whose actions, values and units have some noise.
fn batch(state: &PpoState, rows: usize, seed: u64) -> Batch {
    let (shape, mut rng) = (state.shape(), rng(seed));
    let mut normals = |count: usize| -> Vec<f32> { (0..count).map(|_| StandardNormal.sample(&mut rng)).collect() };
    let policy = Policy::new(state.networks().clone(), state.parameters().to_vec()).expect("its parameters fit");
    let (observations, noise) = (normals(rows * shape.observation), normals(rows * shape.action));
    let mut means = vec![0.0; noise.len()];
    policy.means(&observations, rows, &mut means);
    let actions: Vec<f32> = means.iter().zip(&noise).map(|(mean, noise)| mean + 0.7 * noise).collect();
    let mut log_probs = gaussian::log_probabilities(&actions, &means, policy.log_std());
    // Ratios on both sides of the clip range.
    log_probs.iter_mut().zip(normals(rows)).for_each(|(log_prob, noise)| *log_prob += 0.3 * noise);
    let weights = normals(rows).iter().map(|number| 1.0 / (1.0 + number * number)).collect();
    let (advantages, returns, values) = (normals(rows), normals(rows), normals(rows));
    Batch { observations, actions, means, log_probs, weights, advantages, returns, values }
}

fn networks(observation: usize, action: usize, hidden: &[usize], privileged: usize, is_mirrored: bool) -> Networks {
    let shape = NetworkShape { observation, action, hidden: hidden.to_vec(), privileged };
    // Pairs of neighbours change places, every other pair with its sign; the last one alone keeps or changes its sign.
    let mirror = |size: usize| {
        let image = |entry: usize| if entry ^ 1 < size { entry ^ 1 } else { entry };
        (0..size).map(|entry| (image(entry), if entry / 2 % 2 == 0 { 1.0 } else { -1.0 })).collect()
    };
    let mirror = is_mirrored.then(|| PolicyMirror { observation: mirror(observation), action: mirror(action) });
    Networks::new(shape, mirror).expect("the mirror fits")
}

/// Takes updates on the processor and on the GPU. Returns both states, and statistics of the last update.
fn updates(networks: &Networks, config: &PpoConfig, sizes: &[usize]) -> [(PpoState, UpdateStats); 2] {
    let parameters = networks.initial_parameters(-0.4, &mut rng(1));
    let first = PpoState::new(networks.clone(), parameters, rng(2), config);
    let devices = [DeviceKind::Cpu, DeviceKind::Cuda].map(|kind| Ppo::new(options(kind), config));
    devices.map(|ppo| {
        let (mut state, mut stats) = (first.clone(), UpdateStats::default());
        for (seed, rows) in sizes.iter().enumerate() {
            let batch = batch(&first, *rows, seed as u64);
            stats = ppo.update(&mut state, &batch, config.epochs).expect("a sound batch");
        }
        (state, stats)
    })
}

/// Asserts that numbers are equal to within a part of their root mean square.
#[track_caller]
fn assert_close(found: &[f32], expected: &[f32], tolerance: f32) {
    let square = expected.iter().map(|number| number * number).sum::<f32>() / expected.len() as f32;
    let apart = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(found.len() == expected.len() && apart <= tolerance * square.sqrt(), "{apart} of {}", square.sqrt());
}

#[test]
fn five_updates_are_those_of_the_processor() {
    // Sizes that leave tiles, warps and slices half empty; batches whose minibatches differ by a row; one that is larger
    // than the memory that the session began with.
    let config = PpoConfig {
        minibatch: 150,
        epochs: 2,
        batch: 300,
        batch_max: 500,
        entropy_coefficient: 0.01,
        bounds_coefficient: 0.1,
        bounds_limit: 0.2,
        ..PpoConfig::default()
    };
    for networks in [
        networks(45, 17, &[96, 40], 0, false),
        networks(9, 3, &[16], 4, false),
        networks(5, 2, &[], 0, false),
        networks(45, 17, &[96, 40], 0, true),
        networks(12, 4, &[16, 8, 8], 4, true),
    ] {
        let [(cpu, on_cpu), (gpu, on_gpu)] = updates(&networks, &config, &[300, 301, 299, 2, 700]);
        let before = networks.initial_parameters(-0.4, &mut rng(1));
        let moved = cpu.parameters().iter().zip(&before).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(moved > 1e-3, "the parameters change: {moved}");
        assert_close(gpu.parameters(), cpu.parameters(), 1e-4);
        assert_close(&gpu.optimiser().first_moment, &cpu.optimiser().first_moment, 1e-3);
        assert_close(&gpu.optimiser().second_moment, &cpu.optimiser().second_moment, 1e-3);
        assert_eq!(gpu.gradient_steps(), cpu.gradient_steps());
        let numbers = |s: &UpdateStats| {
            [s.policy_loss, s.value_loss, s.entropy, s.bounds_loss, s.clip_fraction, s.grad_norm, s.std, s.approx_kl]
        };
        for (found, expected) in numbers(&on_gpu).into_iter().zip(numbers(&on_cpu)) {
            assert!((found - expected).abs() < 2e-3 * expected.abs().max(1e-2), "{on_gpu:?} {on_cpu:?}");
        }
        assert_eq!((on_gpu.gradient_steps, on_gpu.samples), (on_cpu.gradient_steps, on_cpu.samples));
        assert_eq!(on_gpu.learning_rate, on_cpu.learning_rate);
    }
}

#[test]
fn a_pass_that_leads_too_far_is_undone_there_too() {
    let config = PpoConfig {
        minibatch: 64,
        epochs: 3,
        target_kl: 1e-3,
        learning_rate: 0.3,
        learning_rate_max: 0.3,
        ..PpoConfig::default()
    };
    let [(cpu, on_cpu), (gpu, on_gpu)] = updates(&networks(6, 2, &[8], 0, false), &config, &[256]);
    assert!(on_cpu.undone_passes > 0, "{on_cpu:?}");
    assert_eq!((on_gpu.undone_passes, on_gpu.learning_rate), (on_cpu.undone_passes, on_cpu.learning_rate));
    assert_eq!(gpu.gradient_steps(), cpu.gradient_steps());
    assert_close(gpu.parameters(), cpu.parameters(), 1e-3);
}

#[test]
fn an_update_that_is_not_finite_is_undone_and_the_next_one_is_sound() {
    let config = PpoConfig { minibatch: 64, epochs: 2, ..PpoConfig::default() };
    let networks = networks(6, 2, &[8], 0, true);
    let mut state = PpoState::new(networks.clone(), networks.initial_parameters(-0.4, &mut rng(1)), rng(2), &config);
    let ppo = Ppo::new(options(DeviceKind::Cuda), &config);
    let (before, sound) = (state.clone(), batch(&state, 128, 1));
    let mut returns = sound.returns.clone();
    returns[77] = 1e30;
    let error = ppo.update(&mut state, &Batch { returns, ..sound.clone() }, 2).unwrap_err();
    assert!(matches!(error, UpdateError::NonFinite { what: "loss" }), "{error}");
    assert_eq!(state.parameters(), before.parameters());
    assert_eq!(state.optimiser(), before.optimiser());
    ppo.update(&mut state, &sound, 2).expect("a sound batch");
    assert_ne!(state.parameters(), before.parameters());
}

#[test]
fn results_do_not_vary_between_runs() {
    let config = PpoConfig { minibatch: 100, epochs: 2, ..PpoConfig::default() };
    let run = || updates(&networks(45, 17, &[32, 16], 0, true), &config, &[400, 333])[1].0.clone();
    assert_eq!(run(), run());
}
