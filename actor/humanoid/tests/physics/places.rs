//! Robots far from the world's origin, as at it.

use nalgebra::Vector3;
use treadmill_humanoid::{HUMANOID_XML, Physics};

use crate::{humanoid_text, simulation};

/// Powers of two, so that adding them to places changes no bit of the place on a height field.
const FAR_M: [f64; 3] = [2048.0, -1024.0, 64.0];

fn controls(step: u32) -> [f32; 17] {
    std::array::from_fn(|motor| 0.3 * ((step * 31 + motor as u32 * 17) as f32).sin())
}

/// Moves a simulation that just started.
fn displace(physics: &mut Physics, by_m: [f64; 3]) {
    let (mut position, velocity) = (physics.position().to_vec(), physics.velocity().to_vec());
    for (number, offset_m) in position.iter_mut().zip(by_m) {
        *number += offset_m;
    }
    physics.set_state(&position, &velocity);
}

/// Steps both and asserts that they differ by a displacement, up to `tolerance`, after every step.
fn assert_same_motion([near, far]: [&mut Physics; 2], by_m: [f64; 3], steps: u32, tolerance: f64) {
    let mut touched = 0;
    for step in 0..steps {
        for physics in [&mut *near, &mut *far] {
            physics.step_only(&controls(step)).expect("finite");
        }
        let by_m = by_m.into_iter().chain(std::iter::repeat(0.0));
        let places = near.position().iter().zip(by_m).map(|(number, offset_m)| number + offset_m).zip(far.position());
        let rates = near.velocity().iter().copied().zip(far.velocity());
        for (index, (one, other)) in places.chain(rates).enumerate() {
            assert!((one - other).abs() <= tolerance, "step {step}, number {index}: {one} and {other}");
        }
        touched += u32::from(near.squared_contact_wrenches() > 0.0);
    }
    assert!(touched > steps / 2, "{touched} steps with contacts");
    let [one, other] = [near, far].map(|physics| physics.contact_points().next().expect("it touches").at_m);
    assert!((other - one - Vector3::from(by_m)).norm() <= tolerance.max(1e-9));
}

#[test]
fn a_robot_two_kilometres_away_moves_as_at_the_origin() {
    let [mut near, mut far] = [(); 2].map(|()| simulation(HUMANOID_XML));
    let by_m = [2000.0, -1300.0, 0.0];
    displace(&mut far, by_m);
    // Doubles resolve 2 km to 2e-13 m.
    assert_same_motion([&mut near, &mut far], by_m, 200, 1e-10);
    assert_eq!(near.velocity(), far.velocity());
}

#[test]
fn a_robot_on_a_distant_hill_moves_as_at_the_origin() {
    let bump =
        |place: u32| format!(" {}", 0.5 + 0.5 * (f64::from(place % 33) * 1.3).sin() * f64::from(place / 33).cos());
    let elevation: String = (0..33 * 33).map(bump).collect();
    let field = format!(
        "<asset><hfield name=\"h\" nrow=\"33\" ncol=\"33\" size=\"4 4 0.1 0.1\" elevation=\"{elevation}\"/></asset><worldbody>"
    );
    let ground = |[x, y, z]: [f64; 3]| format!("type=\"hfield\" hfield=\"h\" pos=\"{x} {y} {z}\"");
    let [mut near, mut far] = [[0.0; 3], FAR_M].map(|at_m| {
        let plane = "type=\"plane\" size=\"20 20 0.125\"";
        simulation(&humanoid_text(&[(plane, &ground(at_m)), ("<worldbody>", &field)]))
    });
    displace(&mut near, [0.0, 0.0, 0.1]);
    displace(&mut far, [FAR_M[0], FAR_M[1], FAR_M[2] + 0.1]);
    assert_same_motion([&mut near, &mut far], FAR_M, 100, 1e-9);
}
