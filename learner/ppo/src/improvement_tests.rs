//! One bad fragment among good ones changes nothing.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_config::PpoConfig;
use treadmill_policy::{NetworkShape, Networks, gaussian};

use super::*;
use crate::PpoOptions;

const STEPS: u32 = 16;
const ENVS: u32 = 4;
const PARAMETER_SEED: u64 = 0x5e31_645e_38a6_c541;
const SHUFFLE_SEED: u64 = 0x0d5a_574d_dbcd_853a;

fn random(seed: u64) -> Xoshiro256PlusPlus {
    Xoshiro256PlusPlus::seed_from_u64(seed)
}

/// A learner.
struct World {
    ppo: Ppo,
    state: PpoState,
}

impl World {
    fn new() -> Self {
        let shape = NetworkShape { observation: 3, action: 2, hidden: vec![16, 8], privileged: 0 };
        let config = PpoConfig { minibatch: 64, epochs: 2, ..PpoConfig::default() };
        let parameters = Networks::from(shape.clone()).initial_parameters(-0.5, &mut random(PARAMETER_SEED));
        let state = PpoState::new(shape.clone().into(), parameters, random(SHUFFLE_SEED), &config);
        let options = PpoOptions::on_cpu(1).expect("a thread starts");
        Self { ppo: Ppo::new(options, &config), state }
    }

    /// World after updates from good fragments.
    fn trained() -> Self {
        let mut world = Self::new();
        for update in 0..3 {
            let mut fragments = world.fragments(8, update);
            assert_eq!(world.learn(&mut fragments).rejected, []);
        }
        world
    }

    /// Returns fragments that the newest policy acted.
    fn fragments(&self, count: u64, seed: u64) -> Vec<AcceptedFragment> {
        (0..count).map(|i| AcceptedFragment { fragment: self.fragment(seed * 100 + i), lag: 0 }).collect()
    }

    fn fragment(&self, seed: u64) -> Fragment {
        let rows = (STEPS * ENVS) as usize;
        let mut random = random(seed);
        let mut normals =
            |count: usize| -> Vec<f32> { (0..count).map(|_| StandardNormal.sample(&mut random)).collect() };
        let (observations, noise, last_observations) =
            (normals(rows * 3), normals(rows * 2), normals(ENVS as usize * 3));
        let policy = self.ppo.policy(&self.state).expect("its own parameters fit");
        let mut normalised = observations.clone();
        Normaliser::from_moments(&self.state.observation_moments, 10.0).apply(&mut normalised);
        let mut means = vec![0.0; rows * 2];
        policy.means(&normalised, rows, &mut means);
        let mut actions = vec![0.0; rows * 2];
        for row in 0..rows {
            let span = row * 2..row * 2 + 2;
            gaussian::sample(&means[span.clone()], policy.log_std(), &noise[span.clone()], &mut actions[span]);
        }
        Fragment {
            sequence: seed,
            steps: STEPS,
            envs: ENVS,
            observation_size: 3,
            action_size: 2,
            log_probs: gaussian::log_probabilities(&actions, &means, policy.log_std()),
            rewards: (0..rows).map(|row| observations[row * 3] - actions[row * 2].powi(2)).collect(),
            observations,
            actions,
            flags: vec![0; rows],
            last_observations,
            ..Fragment::default()
        }
    }

    fn learn(&mut self, fragments: &mut Vec<AcceptedFragment>) -> Improvement {
        let prepared = self.ppo.prepare(&self.state, fragments).expect("candle runs");
        self.ppo.improve(&mut self.state, 2, fragments, prepared)
    }

    #[track_caller]
    fn assert_same(&self, other: &Self) {
        assert_eq!(self.state, other.state);
    }
}

/// Learns from eight fragments, the sixth of which is changed, and from the other seven in an equal world. Returns the
/// reason why the sixth was rejected.
#[track_caller]
fn assert_left_out(start: fn() -> World, spoil: impl Fn(&mut AcceptedFragment)) -> Implausible {
    let (mut with, mut without) = (start(), start());
    let mut eight = with.fragments(8, 9);
    spoil(&mut eight[5]);
    let mut seven = without.fragments(8, 9);
    seven.remove(5);
    let improvement = with.learn(&mut eight);
    let expected = without.learn(&mut seven);
    assert_eq!(expected.rejected, []);
    assert_eq!(improvement.result.expect("seven are good"), expected.result.expect("seven are good"));
    assert_eq!(
        eight.iter().map(|kept| kept.fragment.sequence).collect::<Vec<_>>(),
        [900, 901, 902, 903, 904, 906, 907]
    );
    with.assert_same(&without);
    let [(fragment, why)] = &improvement.rejected[..] else { panic!("{:?}", improvement.rejected) };
    assert_eq!(fragment.sequence, 905);
    why.clone()
}

#[test]
fn a_bad_fragment_among_eight_is_named_and_the_others_are_learnt_from() {
    for start in [World::new as fn() -> World, World::trained] {
        let why = assert_left_out(start, |bad| bad.fragment.log_probs.fill(-1e30));
        assert!(matches!(why, Implausible::LogProbability { row: 0, .. }), "{why}");
        let why = assert_left_out(start, |bad| {
            bad.lag = 1;
            bad.fragment.log_probs[7] = -1e30;
        });
        assert!(matches!(why, Implausible::OutOfRange { row: 7, .. }), "{why}");
        let why = assert_left_out(start, |bad| bad.fragment.rewards[40] = 3e38);
        assert!(matches!(why, Implausible::Magnitude { quantity: "scaled reward", row: 40, .. }), "{why}");
        let why = assert_left_out(start, |bad| bad.fragment.rewards.fill(-3e38));
        assert!(matches!(why, Implausible::Magnitude { quantity: "scaled reward", row: 0, .. }), "{why}");
        let why = assert_left_out(start, |bad| bad.fragment.actions[3] = 1e30);
        assert!(matches!(why, Implausible::Action { row: 1, .. }), "{why}");
        // Another policy's actions with that policy's log-probabilities.
        let why = assert_left_out(start, |bad| bad.fragment.log_probs.iter_mut().for_each(|l| *l += 0.5));
        assert!(matches!(why, Implausible::LogProbability { .. }), "{why}");
    }
}

#[test]
fn absurd_observations_change_little() {
    let (mut with, mut without) = (World::trained(), World::trained());
    let mut spoilt = with.fragments(8, 9);
    // The critic sees them, clipped; the actor did not act on them.
    spoilt[5].fragment.last_observations.fill(1e30);
    let mut good = without.fragments(8, 9);
    for (world, fragments) in [(&mut with, &mut spoilt), (&mut without, &mut good)] {
        let improvement = world.learn(fragments);
        assert_eq!(improvement.rejected, []);
        improvement.result.expect("it is finite");
    }
    assert_eq!(with.state.observation_moments, without.state.observation_moments);

    // An actor that sees absurd numbers and acts on them, as the policy says.
    let mut world = World::trained();
    let before = world.state.observation_moments.clone();
    let mut fragments = world.fragments(8, 9);
    let policy = world.ppo.policy(&world.state).expect("its own parameters fit");
    let fragment = &mut fragments[2].fragment;
    fragment.observations[5] = 1e30;
    let mut seen = fragment.observations[3..6].to_vec();
    Normaliser::from_moments(&world.state.observation_moments, 10.0).apply(&mut seen);
    let mut mean = [0.0; 2];
    policy.means(&seen, 1, &mut mean);
    fragment.actions[2..4].copy_from_slice(&mean);
    fragment.log_probs[1] = gaussian::log_probability(&mean, &mean, policy.log_std());
    let improvement = world.learn(&mut fragments);
    assert_eq!(improvement.rejected, []);
    improvement.result.expect("it is finite");
    // 512 rows join 1,536; one of them is 20 standard deviations away.
    assert!(
        (world.state.observation_moments.mean[2] - before.mean[2]).abs() < 0.1,
        "{:?}",
        world.state.observation_moments
    );
    assert!(
        (world.state.observation_moments.variance()[2] - before.variance()[2]).abs() < 0.4,
        "{:?}",
        world.state.observation_moments
    );
}

#[test]
fn nothing_is_learnt_from_bad_fragments_alone() {
    let (mut world, untouched) = (World::trained(), World::trained());
    let mut fragments = world.fragments(2, 9);
    fragments.iter_mut().for_each(|bad| bad.fragment.log_probs.fill(-1e30));
    let improvement = world.learn(&mut fragments);
    assert!(matches!(improvement.result, Err(UpdateError::Empty)));
    assert_eq!((improvement.rejected.len(), fragments.len()), (2, 0));
    world.assert_same(&untouched);
}

#[test]
fn a_fragment_that_makes_an_update_infinite_is_found() {
    // The checks leave no way to send one, so it is put behind them.
    let (mut with, mut without) = (World::trained(), World::trained());
    let mut eight = with.fragments(8, 9);
    let mut seven = without.fragments(8, 9);
    seven.remove(5);
    let mut prepared = with.ppo.prepare(&with.state, &mut eight).expect("candle runs");
    prepared.batch.returns[5 * (STEPS * ENVS) as usize] = 3e30;
    eight[5].fragment.rewards[0] = 3e38;
    let improvement = with.ppo.improve(&mut with.state, 2, &mut eight, prepared);
    let expected = without.learn(&mut seven);
    assert_eq!(improvement.result.expect("seven are good"), expected.result.expect("seven are good"));
    let [(fragment, Implausible::NonFinite)] = &improvement.rejected[..] else { panic!("{:?}", improvement.rejected) };
    assert_eq!(fragment.sequence, 905);
    with.assert_same(&without);
}

#[test]
fn an_update_that_is_infinite_for_every_fragment_is_undone_and_names_no_sender() {
    let (mut world, mut untouched) = (World::trained(), World::trained());
    for world in [&mut world, &mut untouched] {
        world.state.learning_rate = 1e300;
    }
    let mut fragments = world.fragments(8, 9);
    let improvement = world.learn(&mut fragments);
    assert!(matches!(improvement.result, Err(UpdateError::NonFinite { .. })));
    assert_eq!((improvement.rejected.len(), fragments.len()), (0, 8));
    assert_ne!(world.state.shuffle, untouched.state.shuffle);
    untouched.state.shuffle = world.state.shuffle.clone();
    world.assert_same(&untouched);
}
