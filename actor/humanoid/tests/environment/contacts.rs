//! Contact forces in observations: size, sign, order and reference point.

use nalgebra::{Point3, Vector3};
use treadmill_humanoid::{ContactForce, EnvConfig, EnvObservation, HUMANOID_XML, Model, Observation, Physics};

use crate::support::physics;

const IDLE: [f32; 17] = [0.0; 17];

/// `cfrc_ext` as rows of moment and force, one per link.
fn contact_rows(physics: &Physics) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let config = EnvConfig { observation: EnvObservation::GymnasiumV5, ..EnvConfig::default() };
    let observation = Observation::new(&config, physics.model());
    let mut numbers = vec![0.0; observation.size()];
    observation.write(physics, &mut numbers);
    let range = observation.terms().last().expect("cfrc_ext is the last block").range.clone();
    let vector = |part: &[f32]| Vector3::new(part[0].into(), part[1].into(), part[2].into());
    numbers[range].chunks_exact(6).map(|row| (vector(&row[..3]), vector(&row[3..]))).collect()
}

#[test]
fn links_are_the_mjcf_bodies_and_make_up_the_rigid_bodies() {
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let names: Vec<&str> = model.links.iter().map(|link| link.name.as_str()).collect();
    let expected = "torso lwaist pelvis right_thigh right_shin right_foot left_thigh left_shin left_foot \
                    right_upper_arm right_lower_arm left_upper_arm left_lower_arm";
    assert_eq!(names.join(" "), expected);
    for (index, body) in model.bodies.iter().enumerate() {
        let own = || model.links.iter().filter(|link| link.body == index);
        let mass_kg: f64 = own().map(|link| link.mass_kg).sum();
        assert!((mass_kg - body.mass_kg).abs() < 1e-12, "{}", body.name);
        let moment: Vector3<f64> = own().map(|link| link.centre_of_mass_m.coords * link.mass_kg).sum();
        assert!((moment / mass_kg - body.centre_of_mass_m.coords).norm() < 1e-12, "{}", body.name);
        assert_eq!(own().map(|link| link.shapes.len()).sum::<usize>(), body.shapes.len());
        for shape in 0..body.shapes.len() {
            let link = model.link_of_shape(index, shape).expect("every shape belongs to a link");
            assert_eq!(model.links[link].body, index);
        }
    }
    let foot = &model.links[5];
    // 4/3 π 0.075³ × 1000 kg/m³, hanging 0.45 m below the shin's frame.
    assert!((foot.mass_kg - 1.767_145_867_644_258).abs() < 1e-9);
    assert!((foot.pose.translation.vector - Vector3::new(0.0, 0.0, -0.45)).norm() < 1e-12);
    assert!((foot.centre_of_mass_m - Point3::new(0.0, 0.0, -0.35)).norm() < 1e-12);
}

#[test]
fn a_known_force_at_a_known_point_has_the_moment_computed_by_hand() {
    let mut physics = physics(HUMANOID_XML);
    let centre = physics.centre_of_mass();
    let (foot, hand) = (5, 12);
    // 2 m in front of the centre of mass, 100 N upwards on the foot and as much downwards on the hand.
    let force = ContactForce {
        links: [Some(foot), Some(hand)],
        at_m: centre + Vector3::new(2.0, 0.0, 0.0),
        force_n: Vector3::new(0.0, 0.0, 100.0),
    };
    // 1 m to the left and 1 m below, 30 N of friction forwards from the floor.
    let rubbing = ContactForce {
        links: [None, Some(foot)],
        at_m: centre + Vector3::new(0.0, 1.0, -1.0),
        force_n: Vector3::new(-30.0, 0.0, 0.0),
    };
    physics.set_contacts(&[force, rubbing]);
    let rows = contact_rows(&physics);
    for (link, (moment, force)) in rows.iter().enumerate() {
        // (2, 0, 0) × (0, 0, 100) = (0, −200, 0); (0, 1, −1) × (30, 0, 0) = (0, −30, −30).
        let (expected_moment, expected_force) = match link {
            5 => (Vector3::new(0.0, -230.0, -30.0), Vector3::new(30.0, 0.0, 100.0)),
            12 => (Vector3::new(0.0, 200.0, 0.0), Vector3::new(0.0, 0.0, -100.0)),
            _ => (Vector3::zeros(), Vector3::zeros()),
        };
        assert!((moment - expected_moment).norm() < 1e-3, "link {link}: {moment}");
        assert!((force - expected_force).norm() < 1e-3, "link {link}: {force}");
    }
    let squares: f64 = rows.iter().map(|(moment, force)| moment.norm_squared() + force.norm_squared()).sum();
    assert!((physics.squared_contact_wrenches() / squares - 1.0).abs() < 1e-6);
}

#[test]
fn the_floors_force_turns_a_body_about_its_centre_of_mass() {
    // A ball with a heavy arm along x; the ball touches the floor before the end of the arm does.
    let text = r#"
        <mujoco>
          <worldbody>
            <geom type="plane" size="1 1 1" friction="1 0.1 0.1"/>
            <body name="ball" pos="0 0 0.2">
              <freejoint/>
              <geom type="sphere" size="0.2"/>
              <body name="arm" pos="0.2 0 0">
                <geom type="sphere" pos="0.4 0 0" size="0.1"/>
              </body>
              <body name="tail" pos="-0.25 0 0">
                <joint name="wag" axis="0 0 1"/>
                <geom type="sphere" size="0.02"/>
              </body>
            </body>
          </worldbody>
          <actuator><motor joint="wag" ctrllimited="true" ctrlrange="-1 1"/></actuator>
        </mujoco>"#;
    let mut physics = physics(text);
    physics.step_only(&[0.0]).expect("finite");
    let rows = contact_rows(&physics);
    let (moment, force) = rows[0];
    assert!(force.z > 10.0, "the floor pushes the ball upwards: {force}");
    assert_eq!(rows[1].1.norm(), 0.0, "the arm, welded to the ball, touches nothing");
    // The contact point is below the ball's centre, at the origin.
    let arm = Point3::origin() - physics.centre_of_mass();
    assert!(arm.x < -0.04, "the centre of mass lies in front of the ball's centre");
    let expected = arm.cross(&force);
    assert!((moment - expected).norm() < 0.05 * expected.norm(), "{moment} instead of {expected}");
    assert!(expected.y > 0.4, "pushed up behind its centre of mass, it pitches forward");
}

#[test]
fn limbs_that_touch_push_each_other_apart_with_equal_forces() {
    let mut physics = physics(&HUMANOID_XML.replace("<option ", "<option gravity=\"0 0 0\" "));
    let mut position = physics.model().nominal_position();
    position[2] = 5.0;
    // The right thigh turned inwards through the left one.
    position[10] = 0.5;
    physics.set_state(&position, &[0.0; 23]);
    physics.step_only(&IDLE).expect("finite");
    let rows = contact_rows(&physics);
    let (moments, forces): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let largest = forces.iter().map(|force| force.norm()).fold(0.0, f64::max);
    assert!(largest > 1.0);
    assert!(forces.iter().sum::<Vector3<f64>>().norm() < 1e-3 * largest);
    assert!(moments.iter().sum::<Vector3<f64>>().norm() < 1e-3 * largest);
}

#[test]
fn contact_points_carry_the_body() {
    let mut physics = physics(HUMANOID_XML);
    assert_eq!(physics.contact_points().count(), 0, "no contact before the first step");
    for _ in 0..400 {
        physics.step_only(&IDLE).expect("finite");
    }
    let model = physics.model();
    let weight_n = model.mass_kg() * 9.81;
    let root = Point3::from_slice(&physics.position()[..3]);
    let mut lift_n = 0.0;
    for point in physics.contact_points() {
        assert!((point.at_m - root).norm() < 1.5, "{point:?} is far from the body at {root}");
        let sign = match point.links {
            [Some(_), None] => 1.0,
            [None, Some(_)] => -1.0,
            _ => continue,
        };
        assert!(point.at_m.z.abs() < 0.02, "{point:?}");
        lift_n += sign * point.force_n.z;
    }
    assert!((lift_n / weight_n - 1.0).abs() < 0.2, "the floor carries {lift_n} N of {weight_n} N");
    let (position, velocity) = (physics.position().to_vec(), physics.velocity().to_vec());
    physics.set_state(&position, &velocity);
    assert_eq!(physics.contact_points().count(), 0, "a fresh episode has no contacts");
}
