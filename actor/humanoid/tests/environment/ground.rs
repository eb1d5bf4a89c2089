//! Generated ground, and the velocity task on it.

use std::{collections::BTreeSet, sync::Arc};

use nalgebra::Point3;
use treadmill_humanoid::config::{GroundConfig, GroundKind, VelocityConfig};
use treadmill_humanoid::model::{Geometry, HeightField};
use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, HUMANOID_XML, Physics};

use crate::support::reset;
use crate::velocity::{CARD, environment, walking, with_card};

const ALL: [GroundKind; 5] =
    [GroundKind::Flat, GroundKind::Slope, GroundKind::Stairs, GroundKind::Rough, GroundKind::Stones];

fn settings(kinds: &[GroundKind], start_level: u32) -> GroundConfig {
    GroundConfig { kinds: kinds.to_vec(), start_level, ..GroundConfig::default() }
}

/// The same with a level that does not change.
fn fixed(kinds: &[GroundKind], start_level: u32) -> GroundConfig {
    GroundConfig { curriculum: false, ..settings(kinds, start_level) }
}

fn config(ground: GroundConfig) -> EnvironmentConfig {
    EnvironmentConfig { env: walking(0.0), ground, ..EnvironmentConfig::default() }
}

fn field(environment: &Environment) -> &Arc<HeightField> {
    environment.physics().model().ground.height_field.as_ref().unwrap()
}

/// Controls of the default pose.
fn standing(environment: &Environment) -> Vec<f32> {
    let model = environment.physics().model();
    let default = &model.robot.as_ref().unwrap().default_position;
    model.motors.iter().map(|motor| default[7 + motor.hinge] as f32).collect()
}

/// Ground of all kinds, and the height at a place relative to the middle of a tile.
fn tiles() -> (GroundConfig, impl Fn(u32, GroundKind, f64, f64) -> f64) {
    let settings = fixed(&ALL, 0);
    let (of_tile, field) = (settings.clone(), Arc::clone(field(&environment(&config(settings.clone())))));
    let height_m = move |level: u32, kind: GroundKind, x_m: f64, y_m: f64| {
        let column = ALL.iter().position(|known| *known == kind).unwrap();
        let [middle_x_m, middle_y_m] = of_tile.tile_centre_m(level, column);
        field.height_at(middle_x_m + x_m, middle_y_m + y_m).unwrap()
    };
    (settings, height_m)
}

#[test]
fn the_field_has_a_tile_for_each_kind_and_level_and_a_border() {
    let environment = environment(&config(fixed(&ALL, 0)));
    let field = field(&environment);
    // Ten levels and five kinds of 8 m, 4 m around them, and heights 0.1 m apart.
    assert_eq!((field.columns, field.rows), (881, 481));
    assert!((field.half_x_m - 44.0).abs() < 1e-9 && (field.half_y_m - 24.0).abs() < 1e-9);
    for place in 0..200 {
        let along = f64::from(place) / 200.0;
        for (x_m, y_m) in [(-42.0, 48.0 * along - 24.0), (41.0, 48.0 * along - 24.0), (88.0 * along - 44.0, 22.0)] {
            assert_eq!(field.height_at(x_m, y_m), Some(0.0));
        }
    }
    let (settings, _) = tiles();
    let close =
        |found: [f64; 2], wanted: [f64; 2]| found.iter().zip(wanted).all(|(one, other)| (one - other).abs() < 1e-9);
    assert!(close(settings.tile_centre_m(0, 0), [-36.0, -16.0]) && close(settings.tile_centre_m(9, 4), [36.0, 16.0]));
}

#[test]
fn every_tile_is_level_in_its_middle_and_at_its_rim() {
    let (_, height_m) = tiles();
    for kind in ALL {
        for level in [0, 4, 9] {
            for way in -40..=40 {
                let along_m = 0.1 * f64::from(way);
                for (x_m, y_m) in [(along_m, 4.0), (-4.0, along_m), (along_m / 5.0, 0.75), (0.3, along_m / 5.0)] {
                    let found_m = height_m(level, kind, x_m, y_m);
                    assert!(found_m.abs() < 1e-9, "{kind:?} {level}: {found_m} m at {x_m} {y_m}");
                }
            }
            let is_level = kind == GroundKind::Flat || level == 0;
            let varies = (-39..39).any(|way| height_m(level, kind, 0.1 * f64::from(way), 2.05).abs() > 0.01);
            assert_eq!(varies, !is_level, "{kind:?} {level}");
        }
    }
}

#[test]
fn slopes_have_their_gradient_up_to_the_crest_and_down_again() {
    let (_, height_m) = tiles();
    for (level, gradient) in [(9, 0.3), (3, 0.1)] {
        let slope = |x_m: f64, y_m: f64| height_m(level, GroundKind::Slope, x_m, y_m);
        // The level place ends at 0.8 m, the crest is halfway between it and the rim at 4 m.
        for way_m in [0.05, 0.7, 1.31, 1.6] {
            for found_m in
                [slope(0.8 + way_m, 0.33), slope(-0.8 - way_m, 0.0), slope(0.2, 0.8 + way_m), slope(4.0 - way_m, 0.4)]
            {
                assert!((found_m - gradient * way_m).abs() < 1e-9, "{level}: {found_m} after {way_m}");
            }
        }
    }
}

#[test]
fn stairs_are_three_steps_up_and_three_down() {
    let (_, height_m) = tiles();
    for (level, step_m) in [(9, 0.1), (3, 0.1 / 3.0)] {
        let mut heights: Vec<f64> =
            (8..=40).map(|cell| height_m(level, GroundKind::Stairs, 0.3, -0.1 * f64::from(cell))).collect();
        heights.dedup_by(|one, other| (*one - *other).abs() < 1e-9);
        let wanted = [0, 1, 2, 3, 2, 1, 0].map(|steps| f64::from(steps) * step_m);
        assert_eq!(heights.len(), wanted.len(), "{heights:?}");
        assert!(heights.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-9), "{heights:?}");
        // A stair is level for 0.3 m, with a riser of one cell.
        for (way_m, steps) in [(0.3, 0.0), (0.4, 1.0), (0.7, 1.0), (0.8, 2.0), (1.1, 2.0), (1.2, 3.0), (1.6, 3.0)] {
            let found_m = height_m(level, GroundKind::Stairs, 0.8 + way_m, 0.0);
            assert!((found_m - steps * step_m).abs() < 1e-9, "{found_m} m after {way_m} m");
        }
    }
}

#[test]
fn rough_ground_and_stones_stay_within_their_bounds_and_fill_them() {
    let (_, height_m) = tiles();
    let all = |level: u32, kind: GroundKind| {
        let cells = (-40..=40).flat_map(|x| (-40..=40).map(move |y| (0.1 * f64::from(x), 0.1 * f64::from(y))));
        let heights: Vec<f64> = cells.map(|(x_m, y_m)| height_m(level, kind, x_m, y_m)).collect();
        (heights.iter().copied().fold(0.0, f64::min), heights.iter().copied().fold(0.0, f64::max))
    };
    for (level, share) in [(9, 1.0), (3, 1.0 / 3.0)] {
        let (lowest_m, highest_m) = all(level, GroundKind::Rough);
        for bound_m in [-lowest_m, highest_m] {
            assert!((0.9 * 0.05 * share..=0.05 * share + 1e-9).contains(&bound_m), "{level}: {bound_m}");
        }
        let (lowest_m, highest_m) = all(level, GroundKind::Stones);
        assert!((0.7 * 0.05 * share..=0.05 * share + 1e-9).contains(&highest_m), "{level}: {highest_m}");
        // Gaps narrower than two cells have no bottom: 0.1 m on level 3, 0.3 m on level 9.
        let depth_m = if level == 9 { 0.3 } else { 0.05 * share };
        assert!(-lowest_m <= depth_m + 1e-9 && -lowest_m > 0.7 * depth_m, "{level}: {lowest_m}");
    }
}

#[test]
fn the_seed_alone_decides_about_heights_and_environments_share_them() {
    let of_seed = |seed: u64| config(GroundConfig { seed, ..settings(&ALL, 0) });
    let environments: Vec<Environment> = (0..64).map(|_| environment(&of_seed(7))).collect();
    assert!(environments.iter().all(|other| Arc::ptr_eq(field(other), field(&environments[0]))));
    let kept = field(&environments[0]).heights_m.clone();
    drop(environments);
    assert_eq!(field(&environment(&of_seed(7))).heights_m, kept, "made again");
    assert_ne!(field(&environment(&of_seed(8))).heights_m, kept);
}

/// Height of the lowest point of the robot above the ground below it (m).
pub(crate) fn clearance_m(physics: &Physics) -> f64 {
    let mut least_m = f64::INFINITY;
    for (body, motion) in physics.model().bodies.iter().zip(physics.body_motions()) {
        for shape in &body.shapes {
            let (points, radius_m): (Vec<Point3<f64>>, f64) = match &shape.geometry {
                Geometry::Sphere { centre_m, radius_m } => (vec![*centre_m], *radius_m),
                Geometry::Capsule { from_m, to_m, radius_m } => (vec![*from_m, *to_m], *radius_m),
                Geometry::Box { pose, half_m } => {
                    let corner = |sign: usize| {
                        Point3::from(nalgebra::Vector3::from_fn(|axis, _| {
                            half_m[axis] * if sign >> axis & 1 == 0 { 1.0 } else { -1.0 }
                        }))
                    };
                    ((0..8).map(|sign| pose * corner(sign)).collect(), 0.0)
                }
                other => panic!("{other:?}"),
            };
            for point in points {
                let point = motion.pose * point;
                least_m = least_m.min(point.z - radius_m - physics.ground_height_m(point.x, point.y));
            }
        }
    }
    least_m
}

#[test]
fn robots_start_standing_on_their_tile_and_every_heading_occurs() {
    let mut quadrants = [0; 4];
    for kind in ALL {
        for level in [0, 9] {
            let settings = fixed(&[kind], level);
            let mut environment = environment(&EnvironmentConfig { env: walking(0.05), ..config(settings.clone()) });
            for number in 0..6 {
                let seed = number * 100 + 10 * u64::from(level) + kind as u64;
                let mut observation = reset(&mut environment, seed);
                let physics = environment.physics();
                let (place, [x_m, y_m]) = (physics.position().to_vec(), settings.tile_centre_m(level, 0));
                assert!(
                    (place[0] - x_m).abs() <= 0.55 && (place[1] - y_m).abs() <= 0.55,
                    "{kind:?} {level}: {place:?}"
                );
                let clearance_m = clearance_m(physics);
                assert!((-0.005..0.005).contains(&clearance_m), "{kind:?} {level}: {clearance_m} m above the ground");
                let forward = physics.body_motion(0).pose.rotation * nalgebra::Vector3::x();
                quadrants[usize::from(forward.x > 0.0) * 2 + usize::from(forward.y > 0.0)] += 1;
                let action = standing(&environment);
                for _ in 0..20 {
                    let step = environment.step(&action, &mut observation);
                    assert!(!step.fault && !step.terminated, "{kind:?} {level} {seed}");
                }
            }
        }
    }
    assert!(quadrants.iter().all(|count| *count > 4), "{quadrants:?}");
}

#[test]
fn the_scan_shows_the_ground_around_in_the_heading_frame() {
    let ground = fixed(&[GroundKind::Slope], 9);
    let velocity = VelocityConfig { height_scan: true, history: 2, ..VelocityConfig::default() };
    let mut environment = environment(&EnvironmentConfig { velocity, ..config(ground.clone()) });
    let scans: Vec<_> = environment.terms().iter().filter(|term| term.name == "height_scan").cloned().collect();
    assert_eq!(scans.iter().map(|term| term.is_privileged).collect::<Vec<_>>(), [false, false, true]);
    assert!(scans.iter().all(|term| term.range.len() == 77));
    assert_eq!(environment.terms().last(), scans.last());
    reset(&mut environment, 1);
    // On the slope, facing up along y: the ground rises by 0.3 from row to row of x forwards.
    let mut position = environment.nominal_position().to_vec();
    let standing_m = position[2];
    let [x_m, y_m] = ground.tile_centre_m(9, 0);
    position[..3].copy_from_slice(&[x_m, y_m + 1.6, standing_m + 0.3 * 0.8]);
    position[3..7].copy_from_slice(&[0.5f64.sqrt(), 0.0, 0.0, 0.5f64.sqrt()]);
    let still = vec![0.0; environment.physics().velocity().len()];
    environment.physics_mut().set_state(&position, &still);
    let mut observation = vec![0.0; environment.observation_size()];
    environment.observe(&mut observation).unwrap();
    for scan in &scans[1..] {
        for (index, height_m) in observation[scan.range.clone()].iter().enumerate() {
            let forward_m = 0.1 * (index % 11) as f32 - 0.5;
            assert!((height_m - 0.3 * forward_m).abs() < 1e-5, "{index}: {height_m}");
        }
    }
    position[2] += 5.0;
    environment.physics_mut().set_state(&position, &still);
    environment.observe(&mut observation).unwrap();
    assert!(observation[scans[2].range.clone()].iter().all(|height_m| *height_m == -1.0), "clipped");
    let blind = crate::velocity::environment(&config(ground));
    assert_eq!(blind.terms().iter().filter(|term| term.name == "height_scan").count(), 1, "the critic's");
}

/// Plays an episode in which the robot is carried at `share` of the command, 1 m/s forwards, or falls at its end.
fn carry(environment: &mut Environment, seed: u64, share: f64, falls: bool) {
    let mut observation = reset(environment, seed);
    let action = standing(environment);
    let start = environment.physics().position().to_vec();
    let forward = environment.physics().body_motion(0).pose.rotation * nalgebra::Vector3::x();
    for step in 1.. {
        let mut velocity = vec![0.0; environment.physics().velocity().len()];
        let mut position = start.clone();
        let is_last = step == environment.config().env.max_episode_steps;
        position[2] += if falls && is_last { -0.5 } else { 0.0 };
        velocity[..3].copy_from_slice((forward * share).as_slice());
        environment.physics_mut().set_state(&position, &velocity);
        let step = environment.step(&action, &mut observation);
        assert!(!step.fault);
        if step.terminated || step.truncated {
            assert!(is_last && step.terminated == falls);
            return;
        }
    }
}

#[test]
fn the_level_follows_success_and_goes_on_from_a_saved_state() {
    let ground = settings(&[GroundKind::Rough], 3);
    let velocity = VelocityConfig { command_curriculum: true, ..VelocityConfig::default() };
    let config = EnvironmentConfig {
        env: EnvConfig { max_episode_steps: 150, ..config(ground.clone()).env.clone() },
        velocity,
        ..config(ground.clone())
    };
    let mut original = environment(&config);
    original.steer(Some([1.0, 0.0, 0.0]));
    let level = |environment: &Environment| environment.task().difficulty().ground_level.unwrap();
    let mut levels = Vec::new();
    for (seed, share, falls) in
        [(1, 1.0, false), (2, 1.0, false), (3, 0.45, false), (4, 0.1, false), (5, 1.0, true), (6, 1.0, true)]
    {
        carry(&mut original, seed, share, falls);
        levels.push(level(&original));
    }
    assert_eq!(levels, [3.0, 4.0, 5.0, 5.0, 4.0, 3.0]);
    let mut right = reset(&mut original, 7);
    assert_eq!(level(&original), 2.0);
    let x_m = original.physics().position()[0];
    assert!((x_m - ground.tile_centre_m(2, 0)[0]).abs() <= 0.5, "{x_m}");
    let factor = original.task().difficulty().command_factor.unwrap();
    assert!((0.6..0.8).contains(&factor), "{factor}");
    original.steer(None);

    let action = standing(&original);
    let mut left = reset(&mut original, 8);
    for _ in 0..30 {
        original.step(&action, &mut left);
    }
    let state = original.episode_state().unwrap();
    let mut other = environment(&config);
    reset(&mut other, 99);
    other.resume_episode(&state, &mut right).unwrap();
    for seed in 8..12 {
        loop {
            assert!(left.iter().zip(&right).all(|(left, right)| left.to_bits() == right.to_bits()));
            assert_eq!(original.task().difficulty(), other.task().difficulty());
            assert_eq!(original.task().command(), other.task().command());
            let (step, same) = (original.step(&action, &mut left), other.step(&action, &mut right));
            assert_eq!(step.reward.to_bits(), same.reward.to_bits());
            if step.terminated || step.truncated {
                break;
            }
        }
        (left, right) = (reset(&mut original, seed), reset(&mut other, seed));
    }
}

#[test]
fn an_episode_ends_like_a_time_limit_near_the_edge() {
    let ground = fixed(&[GroundKind::Flat], 9);
    let mut environment = environment(&config(ground));
    let mut observation = reset(&mut environment, 1);
    let action = standing(&environment);
    // 44 m from the middle to the edge along x.
    for (x_m, ends) in [(42.9, false), (43.1, true)] {
        let mut position = environment.nominal_position().to_vec();
        position[0] = x_m;
        let still = vec![0.0; environment.physics().velocity().len()];
        environment.physics_mut().set_state(&position, &still);
        let step = environment.step(&action, &mut observation);
        assert_eq!((step.truncated, step.terminated), (ends, false), "{x_m}");
    }
}

#[test]
fn the_edge_of_a_models_own_ground_ends_an_episode_like_a_time_limit() {
    let flat = vec!["0.5"; 25].join(" ");
    let field =
        format!("<asset><hfield name=\"h\" nrow=\"5\" ncol=\"5\" size=\"6 3 0.1 0.1\" elevation=\"{flat}\"/></asset>");
    let text = HUMANOID_XML.replacen("<worldbody>", &(field + "<worldbody>"), 1);
    let start = text.find("<geom name=\"floor\"").expect("the floor");
    let end = start + text[start..].find("/>").expect("its end") + 2;
    let text = format!("{}<geom type=\"hfield\" hfield=\"h\" pos=\"1 0 0\"/>{}", &text[..start], &text[end..]);
    let mut environment = Environment::new(&EnvironmentConfig::default(), &text).unwrap();
    let mut observation = vec![0.0; environment.observation_size()];
    let action = vec![0.0; environment.action_size()];
    // Along x from -5 m to 7 m, along y from -3 m to 3 m; a quarter of half a side, at most 1 m, is the edge.
    for (place_m, ends) in
        [([5.9, 0.0], false), ([6.1, 0.0], true), ([-4.1, 0.0], true), ([0.0, 2.2], false), ([0.0, 2.3], true)]
    {
        environment.reset(1, &mut observation);
        let mut position = environment.nominal_position().to_vec();
        position[..2].copy_from_slice(&place_m);
        let still = vec![0.0; environment.physics().velocity().len()];
        environment.physics_mut().set_state(&position, &still);
        let step = environment.step(&action, &mut observation);
        assert_eq!((step.truncated, step.terminated), (ends, false), "{place_m:?}");
    }
}

#[test]
fn curricula_begin_with_small_commands_and_the_first_level() {
    let velocity = VelocityConfig { command_curriculum: true, standing_share: 0.0, ..VelocityConfig::default() };
    let config = EnvironmentConfig { velocity, ..config(settings(&[GroundKind::Flat], 0)) };
    for (config, fastest_mps, levels) in
        [(config.clone(), 0.3..=0.4, 0..1), (config.without_curricula(), 0.9..=1.0, 0..10)]
    {
        let mut environment = environment(&config);
        let (mut fastest, mut found) = (0.0f64, BTreeSet::new());
        for seed in 0..100 {
            reset(&mut environment, seed);
            fastest = fastest.max(environment.task().command().unwrap()[0]);
            found.insert(environment.task().difficulty().ground_level.unwrap() as u32);
        }
        assert!(fastest_mps.contains(&fastest), "{fastest}");
        assert_eq!(found, levels.collect(), "without curricula each episode draws a level");
    }
}

#[test]
fn ground_that_cannot_be_made_is_refused() {
    let refusal = |config: &EnvironmentConfig, xml: &str| Environment::new(config, xml).err().unwrap().to_string();
    let large = GroundConfig { tile_m: 12.0, ..settings(&ALL, 0) };
    let why = refusal(&config(large), &with_card(CARD));
    assert!(why.contains("ground.tile_m") && why.contains("12") && why.contains("larger cells"), "{why}");
    let why = refusal(&config(fixed(&ALL, 10)), &with_card(CARD));
    assert!(why.contains("ground.start_level") && why.contains("10"), "{why}");
    let gymnasium = EnvironmentConfig { env: EnvConfig::default(), ..config(settings(&ALL, 0)) };
    let why = refusal(&gymnasium, HUMANOID_XML);
    assert!(why.contains("ground.kinds") && why.contains("velocity task"), "{why}");
    let steep = GroundConfig { slope_max: f64::NAN, ..settings(&ALL, 0) };
    assert!(refusal(&config(steep), &with_card(CARD)).contains("ground.slope_max"));
}
