//! How high a robot is above the ground.

use crate::physics::Physics;

/// Returns the height above the ground of the lowest point of a link's shapes that can touch it (m); `None` without any.
pub fn of_link_m(physics: &Physics, link: usize) -> Option<f64> {
    above_m(physics, link, |x_m, y_m| physics.ground_height_m(x_m, y_m))
}

/// Returns the height of the lowest point of a robot above ground of the given height at each place (m); `None` if nothing
/// of it can touch the ground.
pub fn of_robot_m(physics: &Physics, ground_m: impl Fn(f64, f64) -> f64 + Copy) -> Option<f64> {
    let links = 0..physics.model().links.len();
    links.filter_map(|link| above_m(physics, link, ground_m)).min_by(f64::total_cmp)
}

fn above_m(physics: &Physics, link: usize, ground_m: impl Fn(f64, f64) -> f64) -> Option<f64> {
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
    heights.min_by(f64::total_cmp)
}
