//! Throughput of a fleet without failures: how much of what the actors simulate is learnt from.

use std::time::Duration;

use treadmill_config::LearnerMode;
use treadmill_learner::intake::BatchSize;

use crate::{Case, Learner, world::FleetSettings};

const MODES: [LearnerMode; 2] = [LearnerMode::Sync, LearnerMode::Async];
/// Transitions of a batch, and of one that nothing else limits.
const BATCH: BatchSize = BatchSize { transitions: 1024, transitions_max: 1024 * 16 };
const ENVS: u32 = 4;

/// Throughput over a minute.
struct Measured {
    /// Transitions learnt from.
    learnt: f64,
    /// Transitions simulated and delivered.
    simulated: f64,
}

/// Network without losses, with actors that need `step_ms` for a control step of `envs` environments.
pub fn fleet(step_ms: &[f64], envs: u32) -> FleetSettings {
    FleetSettings {
        seed: 1,
        step_ms: step_ms.to_vec(),
        envs,
        steps: 1,
        pinned_steps: 0,
        in_flight: 1,
        loss_percent: 0,
        delay_ms: 4,
        forgets_accepted: false,
    }
}

/// Fleet of actors that need `step_ms` for a control step, with horizons fitted by the learner.
fn case(mode: LearnerMode, step_ms: &[f64], update_each: Duration) -> Case {
    let size = match mode {
        LearnerMode::Sync => BatchSize { transitions_max: usize::MAX, ..BATCH },
        LearnerMode::Async => BATCH,
    };
    let in_flight = if mode == LearnerMode::Sync { 1 } else { 2 };
    let steps = (BATCH.transitions as u32 / (step_ms.len() as u32 * ENVS)).clamp(8, 128);
    let fleet = FleetSettings { steps, in_flight, ..fleet(step_ms, ENVS) };
    let (max_policy_lag, update) = (8, (Duration::from_millis(10), update_each));
    Case { fleet, mode, max_policy_lag, size, update, learner_deaths_percent: 0, actor_deaths_percent: 0 }
}

/// Fleet of actors that need `fragment_ms` for a fragment of one transition; a batch has `size` of them.
pub fn pinned(mode: LearnerMode, fragment_ms: &[f64], size: usize) -> Case {
    let automatic = case(mode, fragment_ms, Duration::ZERO);
    let fleet = FleetSettings { envs: 1, steps: 1, pinned_steps: 1, in_flight: 1, ..automatic.fleet };
    let transitions_max = if mode == LearnerMode::Sync { usize::MAX } else { size };
    let size = BatchSize { transitions: size, transitions_max };
    Case { fleet, size, update: (Duration::from_millis(150), Duration::ZERO), ..automatic }
}

/// Runs for ten seconds, in which horizons settle, and measures the minute after that.
fn measure(case: &Case) -> Measured {
    let mut learner = Learner::new(case);
    let run_until = |learner: &mut Learner, end_s: u64| {
        while learner.world.borrow().now < Duration::from_secs(end_s) {
            learner.round(false).expect("no failure");
        }
        let effort = learner.intake.fleet.effort();
        (learner.learnt_transitions as f64, effort.env_steps as f64)
    };
    let before = run_until(&mut learner, 10);
    let begun = learner.world.borrow().now;
    let after = run_until(&mut learner, 70);
    let minutes = (learner.world.borrow().now - begun).as_secs_f64() / 60.0;
    Measured { learnt: (after.0 - before.0) / minutes, simulated: (after.1 - before.1) / minutes }
}

#[test]
fn all_that_equal_actors_simulate_is_learnt_from() {
    for mode in MODES {
        for actors in [1, 2, 3, 5, 8, 16, 64] {
            // Actors differ by up to two percent.
            let step_ms: Vec<f64> = (0..actors).map(|i| 10.0 * (1.0 + 0.02 * (i % 7) as f64 / 7.0)).collect();
            let Measured { learnt, simulated } = measure(&case(mode, &step_ms, Duration::from_micros(50)));
            assert!(learnt >= 0.995 * simulated, "{mode:?}, {actors} actors: {learnt} of {simulated}");
        }
    }
}

#[test]
fn slow_actors_contribute_their_share() {
    let mut step_ms = vec![10.0; 6];
    step_ms.extend([20.0, 100.0]);
    let rates: f64 = step_ms.iter().map(|ms| 60e3 / ms * f64::from(ENVS)).sum();
    // An update takes half the time in which the fleet delivers a batch.
    let each = Duration::from_secs_f64(0.5 * 60.0 / rates);
    let Measured { learnt, simulated } = measure(&case(LearnerMode::Async, &step_ms, each));
    assert!(learnt >= 0.98 * rates && learnt >= 0.995 * simulated, "{learnt} of {simulated}, possible are {rates}");
    let Measured { learnt, simulated } = measure(&case(LearnerMode::Sync, &step_ms, each));
    assert!(learnt >= 0.98 * simulated, "sync: {learnt} of {simulated}");
    // No actor simulates during an update: the round takes half as long again.
    assert!(learnt >= 0.9 * rates / 1.5, "sync: {learnt}, possible are {}", rates / 1.5);
}

#[test]
fn more_actors_learn_proportionally_faster_until_the_update_is_the_limit() {
    let each = Duration::from_micros(200);
    let limit = 60.0 / each.as_secs_f64();
    // Each actor delivers a tenth of what the update can take.
    let step_ms = f64::from(ENVS) * 2.0;
    let one = measure(&case(LearnerMode::Async, &[step_ms], each)).learnt;
    let eight = measure(&case(LearnerMode::Async, &[step_ms; 8], each)).learnt;
    assert!(eight >= 7.7 * one, "{eight} and {one}");
    let many = measure(&case(LearnerMode::Async, &[step_ms; 30], each));
    assert!(many.learnt >= 0.97 * limit, "{} of {limit}", many.learnt);
    assert!(many.learnt >= 0.99 * many.simulated, "actors wait: {} of {}", many.learnt, many.simulated);
}

#[test]
fn a_slow_actor_with_a_configured_horizon_costs_at_most_its_own_share() {
    for mode in MODES {
        for slow_ms in [220.0, 450.0, 1000.0, 5000.0] {
            let even = measure(&pinned(mode, &[200.0; 4], 12)).learnt;
            let uneven = measure(&pinned(mode, &[200.0, 200.0, 200.0, slow_ms], 12)).learnt;
            assert!(uneven >= 0.74 * even, "{mode:?}, {slow_ms} ms: {uneven} of {even}");
        }
    }
}

#[test]
fn a_fleet_whose_fragments_fill_many_batches_wastes_none() {
    // A batch has two fragments, and 64 arrive in the time of one.
    let automatic = pinned(LearnerMode::Async, &[200.0; 64], 2);
    let size = BatchSize { transitions_max: 1024, ..automatic.size };
    let case = Case { size, update: (Duration::from_millis(1), Duration::ZERO), ..automatic };
    let Measured { learnt, simulated } = measure(&case);
    assert!(learnt >= 0.995 * simulated, "{learnt} of {simulated}");
}

#[test]
fn asynchronous_mode_learns_from_more_fragments() {
    let [sync, async_] = MODES.map(|mode| measure(&pinned(mode, &[200.0; 2], 4)).learnt);
    assert!(async_ > 1.2 * sync, "{async_} and {sync}");
}
