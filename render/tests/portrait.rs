//! Texts, and the portrait of a robot.

use nalgebra::Point3;
use treadmill_humanoid::{EnvironmentConfig, HUMANOID_XML, Model, Physics};
use treadmill_render::{
    Camera, Look, Picture, Scene, portrait,
    text::{INK, Place},
};

const SIZE: (u32, u32) = (320, 240);

fn physics() -> Physics {
    Physics::new(Model::from_mjcf(HUMANOID_XML).unwrap(), &EnvironmentConfig::default()).unwrap()
}

/// Returns the columns and rows that differ between two pictures.
fn changed(one: &Picture, other: &Picture) -> Vec<(u32, u32)> {
    let places = (0..one.height).flat_map(|row| (0..one.width).map(move |column| (column, row)));
    places.filter(|(column, row)| one.pixel(*column, *row) != other.pixel(*column, *row)).collect()
}

/// Whether a pixel has the colour of a left limb (1), of a right one (-1), or another one (0).
fn side([red, _, blue]: [u8; 3]) -> i32 {
    match i32::from(red) - i32::from(blue) {
        45.. => 1,
        ..-40 => -1,
        _ => 0,
    }
}

#[test]
fn a_portrait_shows_the_whole_robot_with_its_sides() {
    let mut physics = physics();
    let model = physics.model().clone();
    // Arms and legs spread as far as they go.
    for share in [0.0, 1.0] {
        let mut position = model.nominal_position();
        for (angle, hinge) in position[7..].iter_mut().zip(&model.hinges) {
            *angle = hinge.min_rad + (hinge.max_rad - hinge.min_rad) * share;
        }
        physics.set_state(&position, &vec![0.0; model.velocity_size()]);
        let picture = portrait(&Look::of(&model, &[]), &physics);
        assert_eq!((picture.width, picture.height), (1280, 720));
        let places = (0..720).flat_map(|row| (0..1280).map(move |column| (column, row)));
        let limbs: Vec<(u32, u32)> = places.filter(|(column, row)| side(picture.pixel(*column, *row)) != 0).collect();
        assert!(limbs.len() > 8000, "{share}: {}", limbs.len());
        for (column, row) in limbs {
            let (column, row) = (f64::from(column % 640), f64::from(row));
            assert!(
                (20.0..620.0).contains(&column) && (70.0..650.0).contains(&row),
                "{share}: limb at {column}, {row}"
            );
        }
    }
}

#[test]
fn left_is_on_the_viewers_right_and_has_its_name() {
    let physics = physics();
    let picture = portrait(&Look::of(physics.model(), &[]), &physics);
    for (wanted, side_of_view) in [(1, 320..640), (-1, 0..320)] {
        let columns: Vec<u32> = (0..720)
            .flat_map(|row| (0..640).map(move |column| (column, row)))
            .filter(|(column, row)| side(picture.pixel(*column, *row)) == wanted)
            .map(|(column, _)| column)
            .collect();
        let mean = columns.iter().sum::<u32>() / columns.len() as u32;
        assert!(side_of_view.contains(&mean), "{wanted}: {mean}");
        // The name stands beside the robot, at the same side.
        let outermost = if wanted == 1 { columns.iter().max() } else { columns.iter().min() };
        assert!(side_of_view.contains(outermost.unwrap()), "{wanted}: {outermost:?}");
    }
}

#[test]
fn numbers_stand_where_their_points_are() {
    let camera = Camera::beside(0.0, 0.0);
    let plain = Picture::of(&Scene::empty(), &camera, SIZE);
    for x_m in [-1.0, -0.5, 0.0] {
        let (point, mut picture) = (Point3::new(x_m, -0.5, 0.0), plain.clone());
        picture.write_scale(&camera, [(point, format!("{x_m} m"))], 0.5);
        let (column, row) = camera.project(&point, SIZE).unwrap();
        let ink = changed(&picture, &plain);
        assert!(ink.len() > 20, "{x_m}: {} pixels", ink.len());
        for (at, line) in ink {
            let (right, down) = (f64::from(at) - column, f64::from(line) - row);
            assert!(right.abs() < 20.0 && down.abs() < 8.0, "{x_m}: ink {right} {down} pixels off");
        }
    }
    // The middle of a number is in the picture, and its left half is not.
    let mut cut = plain.clone();
    let is_inside = |point: &Point3<f64>| camera.project(point, SIZE).is_some_and(|(column, _)| column > 0.0);
    let at_edge = (0..100).map(|part| Point3::new(-0.05 * f64::from(part), -0.5, 0.0)).rfind(is_inside);
    cut.write_scale(&camera, [(at_edge.unwrap(), "-2 m".to_string())], 0.5);
    assert_eq!(cut, plain, "half a number misleads");
    let mut behind = plain.clone();
    behind.write_scale(&camera, [(Point3::new(2.0, -9.0, 0.0), "2 m".to_string())], 0.5);
    assert_eq!(behind, plain, "a point behind the camera has no number");
}

#[test]
fn a_line_of_text_fits_and_small_text_is_left_out() {
    let sky = Picture { width: 320, height: 240, rgb: vec![255; 320 * 240 * 3] };
    let mut long = sky.clone();
    long.write_line(&"a line that is far too long for a picture of this size ".repeat(2));
    assert_eq!(long, sky, "it would be too small to be read");
    let mut fits = sky.clone();
    fits.write_line("1.5 s   commanded 1.00, 0.00 m/s");
    let ink = changed(&fits, &sky);
    assert!(ink.iter().all(|(column, row)| (5..315).contains(column) && *row < 20) && ink.len() > 100, "{}", ink.len());
    let mut cut = sky.clone();
    cut.write("1234567890", Place { column: 315.0, row: 2.0, left_share: 0.0 }, 20.0, INK);
    assert!(!changed(&cut, &sky).is_empty());
}
