//! Picture of a robot from two sides.

use nalgebra::Point3;
use treadmill_humanoid::Physics;

use crate::{
    Camera, Look, Picture, Scene,
    look::{LEFT, RIGHT},
    text::{INK, Place},
};

/// Width and height of each view, in pixels.
const VIEW: (u32, u32) = (640, 720);
/// Share of a view that the robot fills.
const SHARE: f64 = 0.68;
/// Height of the camera above the robot's middle, as a share of its distance.
const ABOVE: f64 = 0.14;

/// Returns a robot at its present pose, whole: from the front, with its sides named, and from its right, with a scale of
/// heights. Numbers stand at distances on the ground.
#[must_use]
pub fn portrait(look: &Look, physics: &Physics) -> Picture {
    let scene = Scene::with(look, physics);
    let [low, high] = scene.robot_box_m().unwrap_or([Point3::origin(), Point3::new(0.1, 0.1, 0.1)]);
    let (middle, height_m) = (nalgebra::center(&low, &high), high.z - low.z);
    let aspect = f64::from(VIEW.0) / f64::from(VIEW.1);
    let step_m = if height_m > 0.8 { 0.5 } else { 0.1 };
    let gap_m = 0.12 * height_m;
    let marks = |point: &dyn Fn(f64) -> Point3<f64>, range: [f64; 2]| -> Vec<(Point3<f64>, String)> {
        let steps = (range[0] / step_m).ceil() as i64..=(range[1] / step_m).floor() as i64;
        steps.map(|step| step as f64 * step_m).map(|at_m| (point(at_m), format!("{at_m:.1} m"))).collect()
    };
    let view = |direction: [f64; 3]| {
        let camera = Camera::around([low, high], direction, aspect, SHARE);
        (camera, Picture::of(&scene, &camera, VIEW))
    };

    let (camera, mut front) = view([1.0, 0.0, ABOVE]);
    let ground = |x_m: f64, y_m: f64| Point3::new(x_m, y_m, scene.ground_m(x_m, y_m));
    let across = marks(&|y_m| ground(high.x + gap_m, y_m), [-0.75 * height_m, 0.75 * height_m]);
    front.write_scale(&camera, across, 0.5);
    let text_height = 1.4 * front.text_height();
    for (name, y_m, left_share, colour) in [("left", high.y, 0.0, LEFT), ("right", low.y, 1.0, RIGHT)] {
        let point = Point3::new(middle.x, y_m, middle.z + 0.2 * height_m);
        let Some((column, row)) = camera.project(&point, VIEW) else { continue };
        let column = column + (1.0 - 2.0 * left_share) * text_height;
        front.write(name, Place { column, row, left_share }, text_height, colour.map(|part| part * 0.75));
    }

    let (camera, mut side) = view([0.0, -1.0, ABOVE]);
    let along = marks(&|x_m| ground(x_m, low.y - gap_m), [-0.75 * height_m, 0.75 * height_m]);
    side.write_scale(&camera, along, 0.5);
    let at_height = |z_m: f64| Point3::new(low.x - gap_m, middle.y, z_m);
    let up = marks(&at_height, [0.0, high.z - 0.04 * height_m]).into_iter();
    let up = up.chain([(at_height(high.z), format!("{:.2} m", high.z))]);
    side.write_scale(&camera, up.map(|(point, text)| (point, text + " –")), 1.0);

    for (picture, name) in [(&mut front, "front"), (&mut side, "right side")] {
        let place = Place { column: f64::from(VIEW.0) / 2.0, row: 1.5 * text_height, left_share: 0.5 };
        picture.write(name, place, text_height, INK);
    }
    front.side_by_side(&side)
}
