//! Observations, contact cost and tendons, compared with Gymnasium's environments in the same states.

use treadmill_humanoid::{
    EnvConfig, EnvObservation, EnvTask, EnvironmentConfig, HUMANOID_XML, Model, Observation, Physics, task,
};

use crate::golden::{State, compare, states};
use crate::support::{environment, physics, reset};

const V5: EnvObservation = EnvObservation::GymnasiumV5;
const V4: EnvObservation = EnvObservation::GymnasiumV4;

fn config(observation: EnvObservation) -> EnvironmentConfig {
    EnvironmentConfig::from(EnvConfig { observation, ..EnvConfig::default() })
}

/// The same with x and y of the root.
fn with_place(observation: EnvObservation) -> EnvironmentConfig {
    let exclude_current_positions_from_observation = false;
    EnvConfig { observation, exclude_current_positions_from_observation, ..EnvConfig::default() }.into()
}

fn set_state(physics: &mut Physics, state: &State) {
    physics.set_state(&state.position, &state.velocity);
    physics.set_controls(&state.controls).expect("finite");
    physics.set_contacts(&state.contacts);
}

/// Returns our observation of every golden state.
fn observe(config: &EnvironmentConfig, states: &[State]) -> Vec<Vec<f32>> {
    let mut physics = physics(HUMANOID_XML);
    let observation = Observation::new(&config.env, physics.model());
    let rows = states.iter().map(|state| {
        set_state(&mut physics, state);
        let mut row = vec![f32::NAN; observation.size()];
        observation.write(&physics, &mut row);
        row
    });
    rows.collect()
}

fn expected(kind: EnvObservation, states: &[State]) -> Vec<&[f32]> {
    states.iter().map(|state| if kind == V4 { &state.v4[..] } else { &state.v5[..] }).collect()
}

fn block(observation: &Observation, name: &str) -> std::ops::Range<usize> {
    observation.terms().iter().find(|block| block.name == name).expect("the block is there").range.clone()
}

#[test]
fn every_entry_equals_gymnasiums() {
    let states = states();
    assert_eq!(states.len(), 200);
    assert!(states.iter().filter(|state| state.contacts.is_empty()).count() > 100);
    assert!(states.iter().flat_map(|state| &state.contacts).any(|contact| contact.links.contains(&None)));
    for kind in [V5, V4] {
        compare(&observe(&config(kind), &states), &expected(kind, &states))
            .unwrap_or_else(|mismatch| panic!("{kind:?}: {mismatch:?}"));
    }
}

/// Shows that the comparison detects wrong signs and orders.
#[test]
fn the_comparison_detects_flipped_signs_and_swapped_axes_in_every_block() {
    let states = states();
    for kind in [V5, V4] {
        let right = observe(&config(kind), &states);
        let expected = expected(kind, &states);
        let observation = Observation::new(&config(kind).env, physics(HUMANOID_XML).model());
        let names: Vec<&str> = observation.terms().iter().map(|block| &block.name[..]).collect();
        assert_eq!(names, ["qpos", "qvel", "cinert", "cvel", "qfrc_actuator", "cfrc_ext"]);
        for block in observation.terms() {
            let mut tried = 0;
            for entry in block.range.clone() {
                // The world's rows of v4 are zero.
                if expected.iter().all(|row| row[entry] == 0.0) {
                    assert_eq!(kind, V4);
                    continue;
                }
                let mut flipped = right.clone();
                flipped.iter_mut().for_each(|row| row[entry] = -row[entry]);
                assert!(compare(&flipped, &expected).is_err(), "{} {entry}: sign", block.name);
                let next = entry + 1;
                if block.range.contains(&next) {
                    let mut swapped = right.clone();
                    swapped.iter_mut().for_each(|row| row.swap(entry, next));
                    assert!(compare(&swapped, &expected).is_err(), "{} {entry}: order", block.name);
                }
                tried += 1;
            }
            assert!(tried >= 17, "{}", block.name);
        }
    }
}

#[test]
fn contact_cost_and_tendons_equal_gymnasiums() {
    let states = states();
    let mut physics = physics(HUMANOID_XML);
    let mut charged = 0;
    for state in &states {
        set_state(&mut physics, state);
        let cost = task::contact_cost(&EnvConfig::default(), physics.squared_contact_wrenches());
        assert!((cost - state.contact_cost).abs() <= 1e-3 * state.contact_cost, "{cost}, {}", state.contact_cost);
        charged += u32::from(cost > 0.0);
        for (index, tendon) in physics.model().tendons.iter().enumerate() {
            let length = tendon.sum_over(physics.joint_angles());
            let velocity = tendon.sum_over(physics.joint_rates());
            assert!((length - state.tendon_length_rad[index]).abs() < 1e-4, "{}", tendon.name);
            assert!((velocity - state.tendon_velocity_radps[index]).abs() < 1e-2, "{}", tendon.name);
        }
    }
    assert!(charged > 50);
    assert_eq!(physics.model().tendons.len(), 2);
}

#[test]
fn sizes_equal_gymnasiums() {
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let size = |config: &EnvironmentConfig| Observation::new(&config.env, &model).size();
    for (kind, expected) in [(EnvObservation::Compact, 45), (V5, 348), (V4, 376)] {
        assert_eq!(size(&config(kind)), expected);
        assert_eq!(size(&with_place(kind)), expected + 2);
        assert_eq!(environment(&config(kind)).observation_size(), expected);
    }
}

#[test]
fn each_flag_removes_only_its_block() {
    type Switch = fn(&mut EnvironmentConfig);
    let cases: [(&str, usize, Switch); 4] = [
        ("cinert", 130, |c| c.env.include_cinert_in_observation = false),
        ("cvel", 78, |c| c.env.include_cvel_in_observation = false),
        ("qfrc_actuator", 17, |c| c.env.include_qfrc_actuator_in_observation = false),
        ("cfrc_ext", 78, |c| c.env.include_cfrc_ext_in_observation = false),
    ];
    let states = states();
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let whole = observe(&config(V5), &states);
    for (name, size, switch) in cases {
        let mut without = config(V5);
        switch(&mut without);
        let out = block(&Observation::new(&config(V5).env, &model), name);
        assert_eq!(out.len(), size);
        assert!(Observation::new(&without.env, &model).terms().iter().all(|block| block.name != name));
        for (whole, part) in whole.iter().zip(observe(&without, &states)) {
            assert_eq!(part, [&whole[..out.start], &whole[out.end..]].concat(), "{name}");
        }
    }
    for ((state, whole), placed) in states.iter().zip(&whole).zip(observe(&with_place(V5), &states)) {
        assert!((f64::from(placed[0]) - state.position[0]).abs() < 1e-5);
        assert!((f64::from(placed[1]) - state.position[1]).abs() < 1e-5);
        assert_eq!(placed[2..], whole[..]);
    }
}

#[test]
fn compact_is_the_beginning_of_v5() {
    let states = states();
    for (compact, whole) in observe(&config(EnvObservation::Compact), &states).iter().zip(observe(&config(V5), &states))
    {
        assert_eq!(compact[..], whole[..45]);
    }
}

#[test]
fn a_reset_clears_torques_and_contacts() {
    let mut environment = environment(&config(V5));
    let range = block(&Observation::new(&environment.config().env, environment.physics().model()), "qfrc_actuator")
        .start..environment.observation_size();
    let mut observation = reset(&mut environment, 1);
    for _ in 0..100 {
        environment.step(&[0.4; 17], &mut observation);
    }
    let changed = observation[range.clone()].iter().filter(|number| **number != 0.0).count();
    assert!(changed > 17, "torques and contacts must be present: {changed}");
    environment.reset(2, &mut observation);
    assert!(observation[range].iter().all(|number| *number == 0.0));
}

#[test]
fn observe_repeats_the_observation_of_the_last_step() {
    let mut environment = environment(&config(V4));
    let mut observation = reset(&mut environment, 3);
    environment.step(&[0.3; 17], &mut observation);
    let mut again = vec![f32::NAN; observation.len()];
    environment.observe(&mut again).expect("the length is right");
    assert_eq!(observation, again);
}

#[test]
fn each_task_has_its_own_info() {
    for (task, names, on_reset) in [(EnvTask::HumanoidV5, 11, 5), (EnvTask::HumanoidV4, 9, 0)] {
        let mut environment = environment(&EnvironmentConfig::from(EnvConfig { task, ..EnvConfig::default() }));
        let mut observation = reset(&mut environment, 4);
        assert_eq!(environment.info().unwrap().reset_entries(task).count(), on_reset);
        environment.step(&[0.1; 17], &mut observation);
        assert_eq!(environment.info().unwrap().entries(task).count(), names);
        let (position, centre) = (environment.physics().position(), environment.physics().centre_of_mass());
        let [x_m, y_m] = if task == EnvTask::HumanoidV5 { [position[0], position[1]] } else { [centre.x, centre.y] };
        let info = environment.info().unwrap();
        let place = [info.x_position_m, info.y_position_m, info.distance_from_origin_m];
        assert_eq!(place, [x_m, y_m, x_m.hypot(y_m)]);
        // −1 × hip + 1 × knee, left before right.
        let hinge = |name: &str| {
            let model = environment.physics().model();
            let index = model.hinges.iter().position(|hinge| hinge.name == name).expect("is a hinge");
            (position[7 + index], environment.physics().velocity()[6 + index])
        };
        for (index, side) in ["left", "right"].into_iter().enumerate() {
            let (hip, knee) = (hinge(&format!("{side}_hip_y")), hinge(&format!("{side}_knee")));
            assert!((info.tendon_length_rad.as_slice()[index] - (knee.0 - hip.0)).abs() < 1e-12);
            assert!((info.tendon_velocity_radps.as_slice()[index] - (knee.1 - hip.1)).abs() < 1e-12);
        }
    }
}
