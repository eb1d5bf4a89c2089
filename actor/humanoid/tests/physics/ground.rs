//! Bodies on height fields.

use std::sync::Arc;

use treadmill_humanoid::model::HeightField;
use treadmill_humanoid::{EnvConfig, HUMANOID_XML, Model, Physics};

use crate::{SPARE_HINGE, SPARE_MOTOR, advance, lift_n, simulation};

const SPHERE: &str = "type=\"sphere\" size=\"0.1\"";
const CAPSULE: &str = "type=\"capsule\" fromto=\"0 -0.12 0 0 0.12 0\" size=\"0.08\"";
const BOX: &str = "type=\"box\" size=\"0.12 0.09 0.06\"";
const LYING: &str = "type=\"cylinder\" fromto=\"0 -0.1 0 0 0.1 0\" size=\"0.09\"";
const UPRIGHT: &str = "type=\"cylinder\" size=\"0.1 0.07\"";
const HULL: &str = "type=\"mesh\" mesh=\"rock\"";
const SOLE: &str = "type=\"mesh\" mesh=\"sole\"";
/// A block that tapers upwards, and a prism over a regular octagon.
const MESHES: &str = r#"<mesh name="rock" vertex="0.12 0.1 -0.06  -0.12 0.1 -0.06  -0.12 -0.1 -0.06  0.12 -0.1 -0.06
    0.06 0.05 0.08  -0.06 0.05 0.08  -0.06 -0.05 0.08  0.06 -0.05 0.08"/>
    <mesh name="sole" vertex="0.1109 0.0459 -0.04  0.0459 0.1109 -0.04  -0.0459 0.1109 -0.04  -0.1109 0.0459 -0.04
    -0.1109 -0.0459 -0.04  -0.0459 -0.1109 -0.04  0.0459 -0.1109 -0.04  0.1109 -0.0459 -0.04
    0.1109 0.0459 0.04  0.0459 0.1109 0.04  -0.0459 0.1109 0.04  -0.1109 0.0459 0.04
    -0.1109 -0.0459 0.04  -0.0459 -0.1109 0.04  0.0459 -0.1109 0.04  0.1109 -0.0459 0.04"/>"#;

/// Body of 2 kg above a field of 17 × 17 heights on 4 m × 4 m: `top_m` times the shape.
fn above(shape: &str, place: [f64; 3], top_m: f64, height: impl Fn(f64, f64) -> f64) -> Physics {
    let mut elevation = String::new();
    // The text begins with the greatest y.
    for (row, column) in (0..17).rev().flat_map(|row| (0..17).map(move |column| (row, column))) {
        elevation += &format!(" {}", height(-2.0 + 0.25 * f64::from(column), -2.0 + 0.25 * f64::from(row)));
    }
    let [x, y, z] = place;
    simulation(&format!(
        r#"<mujoco><asset><hfield name="h" nrow="17" ncol="17" size="2 2 {top_m} 0.1" elevation="{elevation}"/>{MESHES}</asset>
           <worldbody><geom type="hfield" hfield="h" friction="1"/><body pos="{x} {y} {z}"><freejoint/>
           <geom {shape} mass="2"/>{SPARE_HINGE}</body></worldbody>{SPARE_MOTOR}</mujoco>"#
    ))
}

/// Plateau 0.3 m high, 1.5 m wide.
fn on_plateau(shape: &str) -> Physics {
    above(shape, [0.1, 0.07, 0.42], 0.3, |x, y| f64::from(x.abs() <= 0.75 && y.abs() <= 0.75))
}

/// Asserts that the mean lift over 1.5 s is the weight; the points of contact with triangles change, and the force of a
/// single step with them.
fn assert_carried(shape: &str, body: &mut Physics) {
    let steps = 100;
    let mut mean_n = 0.0;
    for _ in 0..steps {
        advance(body, 1, &[0.0]);
        mean_n += lift_n(body) / f64::from(steps);
    }
    assert!((mean_n / (2.0 * 9.81) - 1.0).abs() < 0.01, "{shape}: {mean_n} N");
}

#[test]
fn every_shape_rests_on_a_plateau_at_mujocos_height() {
    // MuJoCo 4.0 with steps of 1 ms.
    for (shape, mujoco_m) in
        [(SPHERE, 0.39963), (CAPSULE, 0.37983), (BOX, 0.35989), (LYING, 0.38985), (UPRIGHT, 0.36943), (HULL, 0.35989)]
    {
        let mut body = on_plateau(shape);
        advance(&mut body, 200, &[0.0]);
        let height_m = body.torso_height_m();
        assert!((height_m - mujoco_m).abs() < 1e-3, "{shape}: {height_m} m instead of {mujoco_m} m");
        assert_carried(shape, &mut body);
        // What can roll moves a little.
        assert!(body.centre_of_mass_velocity().norm() < 0.02, "{shape}: {}", body.centre_of_mass_velocity());
        let moved = body.centre_of_mass() - nalgebra::Point3::new(0.1, 0.07, body.centre_of_mass().z);
        assert!(moved.norm() < 0.03, "{shape} moved by {moved}");
    }
}

#[test]
fn flat_bottoms_hold_on_a_slope() {
    let slope: f64 = 0.15;
    for (shape, half_m) in [(BOX, 0.06), (HULL, 0.06), (UPRIGHT, 0.07)] {
        let mut body = above(shape, [0.1, 0.07, 0.42], 4.0 * slope, |x, _| (x + 2.0) / 4.0);
        advance(&mut body, 134, &[0.0]);
        let before = body.centre_of_mass();
        advance(&mut body, 66, &[0.0]);
        let place = body.body_motion(0).pose.translation;
        let distance_m = (place.z - (0.3 + slope * place.x)) / slope.hypot(1.0);
        // MuJoCo 4.0: within 0.2 mm of the half height.
        assert!((distance_m - half_m).abs() < 1e-3, "{shape}: {distance_m} m from the slope");
        let up = body.body_motion(0).pose.rotation * nalgebra::Vector3::z();
        let normal = nalgebra::Vector3::new(-slope, 0.0, 1.0).normalize();
        assert!(up.angle(&normal) < 0.01, "{shape} tilts by {} rad", up.angle(&normal));
        // Soft friction creeps: by about 0.5 mm/s in MuJoCo 4.0.
        let crept_m = (body.centre_of_mass() - before).norm();
        assert!(crept_m < 1.2e-3, "{shape} crept by {crept_m} m in 1 s");
        assert_carried(shape, &mut body);
    }
}

#[test]
fn round_shapes_rest_in_a_valley_on_both_sides() {
    // MuJoCo 4.0 with steps of 1 ms; the walls rise by 0.3.
    for (shape, radius_m, mujoco_m) in [(SPHERE, 0.1, 0.104_178), (CAPSULE, 0.08, 0.083_443), (LYING, 0.09, 0.093_881)]
    {
        let mut body = above(shape, [0.0, 0.07, 0.13], 0.6, |x, _| x.abs() / 2.0);
        advance(&mut body, 200, &[0.0]);
        let place = body.body_motion(0).pose.translation;
        assert!((place.z - mujoco_m).abs() < 1e-3, "{shape}: {} m instead of {mujoco_m} m", place.z);
        assert!(place.z < radius_m * 0.3f64.hypot(1.0), "{shape} floats at {} m", place.z);
        assert!(place.x.abs() < 1e-3 && (place.y - 0.07).abs() < 2e-3, "{shape} moved to {place}");
        assert_carried(shape, &mut body);
        assert!(body.centre_of_mass_velocity().norm() < 1e-3, "{shape}: {}", body.centre_of_mass_velocity());
    }
}

#[test]
fn nothing_falls_through_a_rugged_field() {
    let rugged = |x: f64, y: f64| 0.5 + 0.25 * ((5.0 * x).sin() + (7.0 * y).cos());
    for shape in [SPHERE, CAPSULE, BOX, LYING, UPRIGHT, HULL] {
        for (place, speed_mps) in [([0.3, -0.2, 0.5], 0.0), ([-0.4, 0.5, 0.7], 4.0)] {
            let mut body = above(shape, place, 0.2, rugged);
            let position = body.position().to_vec();
            body.set_state(&position, &[0.5, 0.0, -speed_mps, 3.0, 2.0, 1.0, 0.0]);
            let field = body.model().ground.height_field.clone().expect("has a field");
            for step in 0..200 {
                advance(&mut body, 1, &[0.0]);
                let centre = body.centre_of_mass();
                // Rolling bodies may leave the field.
                let Some(ground_m) = field.height_at(centre.x, centre.y) else { break };
                assert!(centre.z > ground_m + 0.02, "{shape}: {} m above, step {step}", centre.z - ground_m);
            }
        }
    }
}

/// Replaces the plane by a flat field with this many rows and columns.
fn flatten(model: &mut Model, sides: [usize; 2], halves_m: [f64; 2]) {
    let field = HeightField::from_fn(sides, halves_m, nalgebra::Point3::origin(), |_, _| 0.0).expect("valid");
    model.ground.height_field = Some(Arc::new(field));
}

/// Model of a body of 2 kg on the plane.
fn on_plane(place: &str, shape: &str) -> Model {
    let text = format!(
        r#"<mujoco><asset>{MESHES}</asset><worldbody><geom type="plane" size="1 1 1"/><body {place}><freejoint/>
           <geom {shape} mass="2"/>{SPARE_HINGE}</body></worldbody>{SPARE_MOTOR}</mujoco>"#
    );
    Model::from_mjcf(&text).expect("valid")
}

#[test]
fn a_flat_field_equals_the_plane() {
    let humanoid = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let pebble = |shape: &str| on_plane("pos=\"0.1 0.2 0.2\"", shape);
    // Rapier computes in single precision, and a lying cylinder slowly rolls away.
    let tolerance = |shape| if shape == LYING { 0.03 } else { 2e-3 };
    let bodies =
        [SPHERE, CAPSULE, BOX, LYING, UPRIGHT, HULL, SOLE].map(|shape| (shape, pebble(shape), 40, tolerance(shape)));
    for (name, model, steps, tolerance) in bodies.into_iter().chain([("humanoid", humanoid, 25, 5e-3)]) {
        let mut plane = Physics::new(model.clone(), &EnvConfig::default()).expect("valid");
        let mut field_model = model;
        // The bodies stand on edges between its triangles.
        flatten(&mut field_model, [9, 9], [6.0, 6.0]);
        let mut field = Physics::new(field_model, &EnvConfig::default()).expect("valid");
        let idle = vec![0.0; plane.model().motors.len()];
        let mut touched = 0;
        for step in 0..steps {
            advance(&mut plane, 1, &idle);
            advance(&mut field, 1, &idle);
            touched += u32::from(lift_n(&plane) > 0.0);
            let off = plane.position().iter().zip(field.position()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < tolerance, "{name}: off by {off} after step {step}");
        }
        assert!(touched > 5, "{name}: {touched}");
        if steps == 40 {
            let off_m = plane.torso_height_m() - field.torso_height_m();
            assert!(off_m.abs() < 5e-4, "{name}: {off_m} m apart at rest");
        }
    }
}

#[test]
fn the_points_under_a_foot_span_its_sole() {
    // Heights 5 and 10 cm apart: the sole lies on many triangles.
    for sides in [[81, 81], [41, 41]] {
        for number in 0..40 {
            let (place, turn) = (0.01 * f64::from(number), 9 * number);
            let place = format!(r#"pos="{place} {place} 0.0085" euler="0 0 {turn}""#);
            let mut model = on_plane(&place, r#"type="box" size="0.09 0.03 0.008""#);
            flatten(&mut model, sides, [4.0, 4.0]);
            let mut foot = Physics::new(model, &EnvConfig::default()).expect("valid");
            advance(&mut foot, 20, &[0.0]);
            let pose = foot.body_motion(0).pose;
            for (x, y) in [(0.09, 0.03), (-0.09, 0.03), (0.09, -0.03), (-0.09, -0.03)] {
                let apart_m = |at_m| pose.inverse() * at_m - nalgebra::Point3::new(x, y, -0.008);
                let nearest_m = foot.contact_points().map(|point| apart_m(point.at_m).norm()).fold(1.0, f64::min);
                assert!(nearest_m < 2e-3, "{sides:?} {turn}°: {nearest_m} m from a corner");
            }
        }
    }
}
