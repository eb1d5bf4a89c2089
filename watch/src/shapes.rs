//! Logs a model's shapes to Rerun: once for each body, in its frame.

use nalgebra::{UnitQuaternion, Vector3};
use rerun::{
    Boxes3D, Capsules3D, Color, Cylinders3D, Ellipsoids3D, EntityPath, EntityPathPart, RecordingStream,
    RecordingStreamResult, components::FillMode, datatypes::Quaternion,
};
use treadmill_humanoid::{Model, model::Geometry};
use treadmill_render::scene;

/// Logs the shapes of one body below its path.
pub fn log(recording: &RecordingStream, path: &EntityPath, model: &Model, body: usize) -> RecordingStreamResult<()> {
    for (number, shape) in model.bodies[body].shapes.iter().enumerate() {
        let link = model.link_of_shape(body, number).map_or(&model.bodies[body].name, |link| &model.links[link].name);
        let [red, green, blue] = scene::colour(link).map(|share| (share * 255.0) as u8);
        let colours = [Color::from_rgb(red, green, blue)];
        let at = path / EntityPathPart::new(format!("shape-{number}"));
        match shape.geometry {
            Geometry::Sphere { centre_m, radius_m } => {
                let ball = Ellipsoids3D::from_centers_and_radii([array(&centre_m.coords)], [radius_m as f32]);
                recording.log_static(at, &ball.with_colors(colours).with_fill_mode(FillMode::Solid))?;
            }
            Geometry::Capsule { from_m, to_m, radius_m } => {
                let axis = to_m - from_m;
                // Rerun's capsule extends from its translation along z.
                let rotation = UnitQuaternion::rotation_between(&Vector3::z(), &axis)
                    .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
                let capsule = Capsules3D::from_lengths_and_radii([axis.norm() as f32], [radius_m as f32])
                    .with_translations([array(&from_m.coords)])
                    .with_quaternions([quaternion(&rotation)]);
                recording.log_static(at, &capsule.with_colors(colours).with_fill_mode(FillMode::Solid))?;
            }
            Geometry::Cylinder { pose, radius_m, half_length_m } => {
                let cylinder = Cylinders3D::from_lengths_and_radii([2.0 * half_length_m as f32], [radius_m as f32])
                    .with_centers([array(&pose.translation.vector)])
                    .with_quaternions([quaternion(&pose.rotation)]);
                recording.log_static(at, &cylinder.with_colors(colours).with_fill_mode(FillMode::Solid))?;
            }
            Geometry::Box { pose, half_m } => {
                let cuboid = Boxes3D::from_centers_and_half_sizes([array(&pose.translation.vector)], [array(&half_m)])
                    .with_quaternions([quaternion(&pose.rotation)]);
                recording.log_static(at, &cuboid.with_colors(colours).with_fill_mode(FillMode::Solid))?;
            }
            Geometry::Ellipsoid { pose, half_m } => {
                let ellipsoid =
                    Ellipsoids3D::from_centers_and_half_sizes([array(&pose.translation.vector)], [array(&half_m)])
                        .with_quaternions([quaternion(&pose.rotation)]);
                recording.log_static(at, &ellipsoid.with_colors(colours).with_fill_mode(FillMode::Solid))?;
            }
        }
    }
    Ok(())
}

fn array(vector: &Vector3<f64>) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}

fn quaternion(rotation: &UnitQuaternion<f64>) -> Quaternion {
    let parts = rotation.quaternion();
    Quaternion::from_xyzw([parts.i, parts.j, parts.k, parts.w].map(|part| part as f32))
}
