//! Learning does not depend on the units of rewards.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_config::PpoConfig;
use treadmill_policy::{
    NetworkShape, Networks, gaussian,
    normaliser::{Normaliser, RunningMoments},
};
use treadmill_ppo::{AcceptedFragment, Ppo, PpoOptions, PpoState, build_batch};
use treadmill_proto::Fragment;

const STEPS: u32 = 32;
const ENVS: u32 = 8;
const PARAMETER_SEED: u64 = 0x5e31_645e_38a6_c541;
const NOISE_SEED: u64 = 0x2a85_5f45_b8c0_d3bc;
const SHUFFLE_SEED: u64 = 0x0d5a_574d_dbcd_853a;

/// Trains with all rewards multiplied by `scale`. Returns the final parameters and the last explained variance.
fn learnt(scale: f32) -> (Vec<f32>, f64) {
    let shape = NetworkShape { observation: 3, action: 2, hidden: vec![16, 8], privileged: 0 };
    let config = PpoConfig { batch: STEPS * ENVS, minibatch: 64, ..PpoConfig::default() };
    let random = Xoshiro256PlusPlus::seed_from_u64;
    let parameters = Networks::from(shape.clone()).initial_parameters(-0.5, &mut random(PARAMETER_SEED));
    let mut state = PpoState::new(shape.into(), parameters, random(SHUFFLE_SEED), &config);
    let ppo = Ppo::new(PpoOptions::on_cpu(1).expect("a thread starts"), &config);
    let mut noise_random = random(NOISE_SEED);
    let mut value_moments = RunningMoments::new(1);
    let mut explained = 0.0;
    for _ in 0..20 {
        let policy = ppo.policy(&state).expect("its own parameters fit");
        let rows = (STEPS * ENVS) as usize;
        let mut normals =
            |count: usize| -> Vec<f32> { (0..count).map(|_| StandardNormal.sample(&mut noise_random)).collect() };
        let (observations, noise) = (normals(rows * 3), normals(rows * 2));
        let (mut means, mut actions) = (vec![0.0; rows * 2], vec![0.0; rows * 2]);
        policy.means(&observations, rows, &mut means);
        for row in 0..rows {
            let span = row * 2..row * 2 + 2;
            gaussian::sample(&means[span.clone()], policy.log_std(), &noise[span.clone()], &mut actions[span]);
        }
        let log_probs = (0..rows)
            .map(|row| gaussian::log_probability(&actions[row * 2..][..2], &means[row * 2..][..2], policy.log_std()))
            .collect();
        // The best action follows the observation. Each step is an episode, so the critic can explain the returns.
        let rewards = (0..rows)
            .map(|row| scale * (observations[row * 3] - (actions[row * 2] - observations[row * 3 + 1]).powi(2)))
            .collect();
        let fragment = Fragment {
            steps: STEPS,
            envs: ENVS,
            observation_size: 3,
            action_size: 2,
            observations,
            actions,
            log_probs,
            rewards,
            flags: vec![treadmill_proto::fragment::TERMINATED; rows],
            ..Fragment::default()
        };
        let accepted = [AcceptedFragment { fragment, lag: 0 }];
        let normaliser = Normaliser::identity(3, 10.0);
        let built = build_batch(&accepted, &policy, &normaliser, &mut value_moments, &config);
        assert_eq!(built.rejected, []);
        explained = ppo.update(&mut state, &built.batch, config.epochs).expect("finite").explained_variance;
    }
    (state.parameters().to_vec(), explained)
}

#[test]
fn scaling_rewards_does_not_change_what_is_learnt() {
    let (wanted, explained) = learnt(1.0);
    assert!(explained > 0.3, "the critic learnt nothing: {explained}");
    for scale in [1e-3, 0.1, 1e3] {
        let (found, explained_here) = learnt(scale);
        let off = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off < 2e-3, "at {scale} parameters are off by {off}");
        assert!((explained_here - explained).abs() < 0.01, "{explained_here} and {explained}");
    }
}
