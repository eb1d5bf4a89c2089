//! How high a robot is above the ground.

use crate::physics::Physics;

/// Returns the height above the ground of the lowest point of a link's shapes that can touch it (m); `None` without any.
pub fn of_link_m(physics: &Physics, link: usize) -> Option<f64> {
    above_m(physics, link, &|x_m, y_m| physics.ground_height_m(x_m, y_m))
}

/// Returns the height above the ground of the lowest point of a robot (m); `None` if nothing of it can touch the ground.
pub fn of_robot_m(physics: &Physics) -> Option<f64> {
    lowest((0..physics.model().links.len()).filter_map(|link| of_link_m(physics, link)))
}

/// As [`of_robot_m`], above a level ground at height 0.
pub fn of_robot_above_zero_m(physics: &Physics) -> Option<f64> {
    lowest((0..physics.model().links.len()).filter_map(|link| above_m(physics, link, &|_, _| 0.0)))
}

fn above_m(physics: &Physics, link: usize, ground_m: &dyn Fn(f64, f64) -> f64) -> Option<f64> {
    let model = physics.model();
    let of = &model.links[link];
    let pose = physics.body_motion(of.body).pose;
    let on_ground = model.pairs.iter().filter(|pair| pair.second.is_none() && pair.first.body == of.body);
    let shapes = on_ground.map(|pair| pair.first.shape).filter(|shape| of.shapes.contains(shape));
    let heights = shapes.map(|shape| {
        let geometry = &model.bodies[of.body].shapes[shape].geometry;
        let centre = pose * geometry.centre_m();
        geometry.lowest_m(&pose) - ground_m(centre.x, centre.y)
    });
    lowest(heights)
}

fn lowest(heights: impl Iterator<Item = f64>) -> Option<f64> {
    heights.min_by(f64::total_cmp)
}
