//! Pictures compared with the physics.

use nalgebra::Point3;
use treadmill_humanoid::{EnvironmentConfig, HUMANOID_XML, Model, Physics};
use treadmill_render::{Camera, Picture, Scene};

const SIZE: (u32, u32) = (160, 120);

fn physics() -> Physics {
    Physics::new(Model::from_mjcf(HUMANOID_XML).unwrap(), &EnvironmentConfig::default()).unwrap()
}

/// Returns the centre of every shape in the world.
fn centres(physics: &Physics) -> Vec<Point3<f64>> {
    let bodies = physics.model().bodies.iter().zip(physics.body_motions());
    bodies
        .flat_map(|(body, motion)| body.shapes.iter().map(move |shape| motion.pose * shape.geometry.centre_m()))
        .collect()
}

#[test]
fn the_picture_shows_the_body_at_its_position() {
    let mut physics = physics();
    let mut position = physics.position().to_vec();
    (position[0], position[1]) = (12.0, -3.0);
    let velocity = physics.velocity().to_vec();
    physics.set_state(&position, &velocity);
    for (step, control) in [0.0, 0.4, -0.4, 0.4].into_iter().enumerate() {
        let controls = vec![control; physics.model().motors.len()];
        (0..10).for_each(|_| physics.step_only(&controls).unwrap());
        let camera = Camera::beside(12.0, -3.0);
        let (with, without) =
            (Picture::of(&Scene::of(&physics), &camera, SIZE), Picture::of(&Scene::empty(), &camera, SIZE));
        for centre in centres(&physics) {
            let (column, row) = camera.project(&centre, SIZE).unwrap();
            let (column, row) = (column as u32, row as u32);
            assert_ne!(with.pixel(column, row), without.pixel(column, row), "{step}: nothing is drawn at {centre}");
        }
        // Body and shadow, which falls away from the camera, change less than half of the columns.
        let changed =
            (0..SIZE.0).filter(|column| (0..SIZE.1).any(|row| with.pixel(*column, row) != without.pixel(*column, row)));
        assert!(changed.clone().count() < SIZE.0 as usize / 2, "{step}: {:?}", changed.collect::<Vec<_>>());
    }
}

#[test]
fn pictures_are_reproducible_and_change_with_a_step() {
    let mut physics = physics();
    let camera = Camera::beside(0.0, 0.0);
    let picture = |physics: &Physics| Picture::of(&Scene::of(physics), &camera, SIZE);
    let first = picture(&physics);
    assert_eq!(first, picture(&physics));
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(first, one_thread.install(|| picture(&physics)), "the number of threads must not matter");
    physics.step_only(&vec![0.4; physics.model().motors.len()]).unwrap();
    physics.step_only(&vec![0.4; physics.model().motors.len()]).unwrap();
    assert_ne!(first, picture(&physics));
}

#[test]
fn the_floor_moves_with_the_camera() {
    let seen = |x_m: f64| Picture::of(&Scene::empty(), &Camera::beside(x_m, 0.0), SIZE);
    let largest = |one: &Picture, other: &Picture| one.rgb.iter().zip(&other.rgb).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(largest(&seen(0.0), &seen(0.3)) > Some(20));
    // With squares of 1 m and a wide line every 5 m, the pattern repeats after 10 m.
    assert!(largest(&seen(1.0), &seen(11.0)) <= Some(1));
}

#[test]
fn shadows_lie_on_the_floor() {
    let (physics, camera) = (physics(), Camera::beside(0.0, 0.0));
    let (with, without) =
        (Picture::of(&Scene::of(&physics), &camera, SIZE), Picture::of(&Scene::empty(), &camera, SIZE));
    // The body darkens some points on the floor around it.
    let mut darker = 0;
    for step in 0..40 {
        let at = Point3::new(-1.0 + f64::from(step % 8) * 0.15, 0.1 + f64::from(step / 8) * 0.25, 0.0);
        let (column, row) = camera.project(&at, SIZE).unwrap();
        let brightness =
            |picture: &Picture| picture.pixel(column as u32, row as u32).map(u32::from).iter().sum::<u32>();
        darker += usize::from(brightness(&with) + 30 < brightness(&without));
    }
    assert!(darker > 3, "{darker} points are in the shadow");
}
