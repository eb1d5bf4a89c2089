//! The environment adds no allocation to those of the physics engine, neither in a step nor in a reset.
//!
//! One test alone in its process: the count is over all threads.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    sync::atomic::{AtomicU64, Ordering},
};

use treadmill_humanoid::{
    Environment, EnvironmentConfig, HUMANOID_XML, ObservationKind, Randomisation, RewardTask, Variation,
};

struct Counting;

static COUNT: AtomicU64 = AtomicU64::new(0);

// SAFETY: everything is handed to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promises are those that the system's allocator asks for.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as above.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn counted(work: impl FnOnce()) -> u64 {
    let before = COUNT.load(Ordering::Relaxed);
    work();
    COUNT.load(Ordering::Relaxed) - before
}

const STEPS: u64 = 300;
const SEED: u64 = 3;

fn action(step: u64) -> [f32; 17] {
    std::array::from_fn(|motor| 0.4 * ((step * 31 + motor as u64 * 17) as f32).sin())
}

/// Allocations of physics alone: of a start, with a variation where there is one, and of the steps after it.
fn physics_alone(randomisation: Randomisation) -> [u64; 2] {
    let is_varied = randomisation.is_on();
    let mut environment = environment(Randomisation::default());
    let mut observation = vec![0.0; environment.observation_size()];
    let position = environment.physics().model().nominal_position();
    let physics = environment.physics_mut();
    let variation = Variation::none(physics.model());
    physics.step_only(&[0.0; 17]).expect("finite");
    let reset = counted(|| {
        if is_varied {
            physics.set_variation(&variation);
        }
        physics.set_state(&position, &[0.0; 23]);
    });
    // The steps begin where those of the whole environment do.
    environment.reset(SEED, &mut observation);
    let physics = environment.physics_mut();
    let steps = counted(|| {
        for step in 0..STEPS {
            let controls = step.checked_sub(randomisation.action_delay_steps[0].into()).map_or([0.0; 17], action);
            physics.step_only(&controls).expect("finite");
        }
    });
    [reset, steps]
}

fn environment(randomisation: Randomisation) -> Environment {
    let config = EnvironmentConfig {
        terminate_when_unhealthy: false,
        randomisation,
        // The observation that has most to compute.
        observation: ObservationKind::GymnasiumV4,
        ..EnvironmentConfig::default()
    };
    Environment::new(&config, HUMANOID_XML).expect("valid")
}

/// The same, of the environment around it.
fn whole(randomisation: Randomisation) -> [u64; 2] {
    let mut environment = environment(randomisation);
    let mut observation = vec![0.0; environment.observation_size()];
    environment.step(&[0.0; 17], &mut observation);
    let reset = counted(|| environment.reset(SEED, &mut observation));
    let steps = counted(|| {
        for step in 0..STEPS {
            let step = environment.step(&action(step), &mut observation);
            assert!(!step.fault && step.info.entries(RewardTask::HumanoidV5).count() == 11);
        }
    });
    [reset, steps]
}

#[test]
fn the_environment_allocates_no_more_than_its_physics() {
    // What is disturbed in the second case leaves the motion as it is, or known, so that physics does the same work.
    let disturbed = Randomisation {
        sensor_noise_position: 0.01,
        sensor_noise_velocity: 0.01,
        action_delay_steps: [2, 2],
        push_mps: [0.0, 0.5],
        push_interval_s: [1000.0, 1000.0],
        ..Randomisation::default()
    };
    assert!(counted(|| drop(environment(disturbed.clone()))) > 0, "allocations are counted");
    for randomisation in [Randomisation::default(), disturbed] {
        let [alone, found] = [physics_alone(randomisation.clone()), whole(randomisation)];
        // Rapier's own buffers grow a little differently from one world to the next.
        let more = found.iter().zip(alone).map(|(found, alone)| found.saturating_sub(alone)).max();
        assert!(
            more < Some(STEPS / 20),
            "{found:?} allocations of a reset and of {STEPS} steps, {alone:?} without task"
        );
    }
}
