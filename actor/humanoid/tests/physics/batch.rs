//! Several simulations in one pass.

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use treadmill_humanoid::{HUMANOID_XML, Physics, worlds_per_pass};

use crate::{STILL, advance, simulation};

const STEPS: u32 = 200;

/// Simulation number `seed` at its start: standing, lying, or in the air.
fn started(seed: u64) -> Physics {
    let mut physics = simulation(HUMANOID_XML);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut position = physics.model().nominal_position();
    position[2] = [1.4, 0.6, 3.0][seed as usize % 3];
    for part in &mut position[3..] {
        *part += random.random_range(-0.3..0.3);
    }
    let velocity: Vec<f64> = (0..23).map(|_| random.random_range(-2.0..2.0)).collect();
    physics.set_state(&position, &velocity);
    physics
}

fn controls(seed: u64, step: u32) -> [f32; 17] {
    std::array::from_fn(|motor| 0.4 * ((step * 29 + motor as u32 * 13 + seed as u32 * 7) as f32).sin())
}

fn state(physics: &Physics) -> Vec<u64> {
    let wrenches = (0..physics.model().links.len()).flat_map(|link| {
        let (force, moment) = physics.contact_wrench(link);
        [force.x, force.y, force.z, moment.x, moment.y, moment.z]
    });
    let numbers = physics.position().iter().chain(physics.velocity()).chain(physics.joint_torques_nm()).copied();
    // Positive and negative zero are the same number.
    numbers.chain(wrenches).map(|number| (number + 0.0).to_bits()).collect()
}

/// Makes the root's velocity NaN, so that the next step faults.
fn poison(physics: &mut Physics) {
    let (position, mut velocity) = (physics.position().to_vec(), physics.velocity().to_vec());
    velocity[0] = f64::NAN;
    physics.set_state(&position, &velocity);
}

#[test]
fn neighbours_and_lanes_change_no_bit() {
    let alone: Vec<Vec<u64>> = (0..3)
        .map(|seed| {
            let mut physics = started(seed);
            let mut touched = 0;
            for step in 0..STEPS {
                physics.step_only(&controls(seed, step)).expect("finite");
                touched += u32::from(physics.squared_contact_wrenches() > 0.0);
            }
            assert!(touched > STEPS / 4, "simulation {seed}: {touched} steps with contacts");
            state(&physics)
        })
        .collect();
    let lanes = worlds_per_pass();
    // One more than fits into a pass, so that the last one is alone in the second pass.
    let count = lanes as u64 + 1;
    for rotation in 0..count {
        for is_reversed in [false, true] {
            // Neighbours differ with the rotation; number 3 fails after 50 steps, number 4 before the first.
            let seeds: Vec<u64> =
                (0..count).map(|place| if place < 5 { place } else { place + 10 * rotation }).collect();
            let mut all: Vec<(u64, Physics)> = seeds.into_iter().map(|seed| (seed, started(seed))).collect();
            for step in 0..STEPS {
                for (seed, physics) in &mut all {
                    if *seed == 4 || (*seed == 3 && step == 50) {
                        poison(physics);
                    }
                    let _ = physics.set_controls(&controls(*seed, step));
                }
                all.rotate_left(rotation as usize % 3);
                if is_reversed {
                    all.reverse();
                }
                Physics::step_together(&mut all.iter_mut().map(|(_, physics)| physics));
                for (seed, physics) in &mut all {
                    let fails = *seed == 4 || (*seed == 3 && step >= 50);
                    assert_eq!(physics.check_step().is_err(), fails, "simulation {seed}, step {step}");
                }
            }
            for (seed, physics) in all.iter().filter(|(seed, _)| *seed < 3) {
                assert!(state(physics) == alone[*seed as usize], "simulation {seed} of {count}, rotated by {rotation}");
            }
        }
    }
}

#[test]
fn a_faulty_simulation_keeps_its_last_state() {
    let (mut one, mut other) = (started(0), started(1));
    for step in 0..10 {
        for (seed, physics) in [(0, &mut one), (1, &mut other)] {
            physics.set_controls(&controls(seed, step)).expect("finite");
        }
        Physics::step_together(&mut [&mut one, &mut other].into_iter());
    }
    poison(&mut one);
    let before = one.position().to_vec();
    Physics::step_together(&mut [&mut one, &mut other].into_iter());
    assert!(one.check_step().is_err() && other.check_step().is_ok());
    assert_eq!(one.position(), before);
    // Afterwards it takes no part.
    Physics::step_together(&mut [&mut one, &mut other].into_iter());
    assert_eq!(one.position(), before);
    let position = one.model().nominal_position();
    one.set_state(&position, &STILL);
    Physics::step_together(&mut [&mut one, &mut other].into_iter());
    assert!(one.check_step().is_ok());
}

/// Four limbs of one hinge each, solved by Newton's method: b hangs from a and d from c, or b and c hang from a.
fn limbs(is_in_chain: bool) -> Physics {
    let limb = |name: &str, inner: &str| {
        let aside_m = if name == "c" { 0.5 } else { 0.0 };
        format!(
            "<body pos=\"0.3 {aside_m} 0\"><joint name=\"{name}\" axis=\"0 1 0\" damping=\"0.1\"/>\
             <geom type=\"capsule\" fromto=\"0 0 0 0.3 0 0\" size=\"0.05\"/>{inner}</body>"
        )
    };
    // Paths to the root are 1, 2, 1, 2 hinges long, or 1, 2, 2, 1.
    let limbs = if is_in_chain {
        limb("a", &limb("b", "")) + &limb("c", &limb("d", ""))
    } else {
        limb("a", &(limb("b", "") + &limb("c", ""))) + &limb("d", "")
    };
    let text = format!(
        "<mujoco><worldbody><geom name=\"floor\" type=\"plane\" size=\"1 1 1\"/><body pos=\"0 0 1\"><freejoint/>\
         <geom type=\"sphere\" size=\"0.1\"/>{limbs}</body></worldbody><actuator>\
         <motor joint=\"a\" gear=\"1\" ctrlrange=\"-1 1\"/></actuator></mujoco>"
    );
    simulation(&text)
}

/// The limbs at this height (m), with hinges that move.
fn limbs_at(height_m: f64) -> Physics {
    let mut physics = limbs(true);
    let mut position = physics.model().nominal_position();
    position[2] = height_m;
    physics.set_state(&position, &[0.3; 10]);
    physics
}

#[test]
fn a_world_without_constraints_keeps_every_bit_beside_one_that_has_some() {
    let [mut alone, mut flying, mut lying] = [50.0, 50.0, 0.1].map(limbs_at);
    for physics in [&mut flying, &mut lying] {
        physics.set_controls(&[0.5]).expect("finite");
    }
    for _ in 0..20 {
        alone.step_only(&[0.5]).expect("finite");
        Physics::step_together(&mut [&mut flying, &mut lying].into_iter());
        assert!(flying.check_step().is_ok() && lying.check_step().is_ok());
    }
    assert!(lying.squared_contact_wrenches() > 0.0 && flying.squared_contact_wrenches() == 0.0);
    assert_eq!(state(&flying), state(&alone));
}

#[test]
fn another_model_of_the_same_size_leaves_nothing_behind() {
    let fallen = |is_first_other: bool| {
        let walk = move || {
            if is_first_other {
                limbs(false).step_only(&[0.5]).expect("finite");
            }
            let mut physics = limbs_at(0.1);
            advance(&mut physics, 20, &[0.5]);
            state(&physics)
        };
        // Workspaces belong to threads.
        std::thread::spawn(walk).join().expect("no panic")
    };
    assert_eq!(fallen(true), fallen(false));
}
