//! Logs a model's shapes to Rerun, once for each body, in its frame; and the height field of its ground.

use nalgebra::{Point3, UnitQuaternion, Vector3};
use rerun::{
    Boxes3D, Capsules3D, Color, Cylinders3D, Ellipsoids3D, EntityPath, EntityPathPart, Mesh3D, RecordingStream,
    RecordingStreamResult, components::FillMode, datatypes::Quaternion,
};
use treadmill_humanoid::{
    Model,
    mjcf::VisualMesh,
    model::{Geometry, HeightField},
};
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
            Geometry::Hull { ref vertices_m } => {
                let faces = shape.geometry.hull_faces().into_iter().map(|face| face.map(|corner| corner as u32));
                let mesh = Mesh3D::new(vertices_m.iter().map(|vertex| array(&vertex.coords)))
                    .with_triangle_indices(faces)
                    .with_vertex_colors(vec![colours[0]; vertices_m.len()]);
                recording.log_static(at, &mesh)?;
            }
        }
    }
    Ok(())
}

/// Logs the visual meshes of one body below its path.
pub fn log_visuals(
    recording: &RecordingStream,
    path: &EntityPath,
    model: &Model,
    body: usize,
    visuals: &[VisualMesh],
) -> RecordingStreamResult<()> {
    for (number, visual) in visuals.iter().enumerate() {
        let link = model.links.iter().find(|link| link.name == visual.link);
        let Some(link) = link.filter(|link| link.body == body) else { continue };
        let pose = model.pose_in_file(link) * visual.pose;
        let [red, green, blue, _] = visual.colour.map(|share| (share * 255.0) as u8);
        let place = |vertex: &[f32; 3]| array(&(pose * Point3::from(vertex.map(f64::from))).coords);
        let mesh = Mesh3D::new(visual.vertices_m.iter().map(place))
            .with_triangle_indices(visual.faces.iter().copied())
            .with_vertex_normals(normals(visual).iter().map(|normal| array(&(pose.rotation * normal))))
            .with_vertex_colors(vec![Color::from_rgb(red, green, blue); visual.vertices_m.len()]);
        recording.log_static(path / EntityPathPart::new(format!("visual-{number}")), &mesh)?;
    }
    Ok(())
}

/// Returns the normal at each corner of a mesh: the sum of those of its triangles, weighted by their areas.
fn normals(visual: &VisualMesh) -> Vec<Vector3<f64>> {
    let corner = |index: u32| Vector3::from(visual.vertices_m[index as usize].map(f64::from));
    let mut normals = vec![Vector3::zeros(); visual.vertices_m.len()];
    for face in &visual.faces {
        let [one, two, three] = face.map(corner);
        let normal = (two - one).cross(&(three - one));
        face.iter().for_each(|index| normals[*index as usize] += normal);
    }
    normals.iter().map(|normal: &Vector3<f64>| normal.try_normalize(0.0).unwrap_or(Vector3::z())).collect()
}

/// Logs a height field.
pub fn log_height_field(
    recording: &RecordingStream,
    path: String,
    field: &HeightField,
    colour: Color,
) -> RecordingStreamResult<()> {
    let steps_m = [2.0 * field.half_x_m / (field.columns - 1) as f64, 2.0 * field.half_y_m / (field.rows - 1) as f64];
    let height_m = |column: usize, row: usize| field.heights_m[row * field.columns + column];
    let places = (0..field.rows).flat_map(|row| (0..field.columns).map(move |column| (column, row)));
    let points = places.clone().map(|(column, row)| {
        let x_m = field.centre_m.x - field.half_x_m + column as f64 * steps_m[0];
        let y_m = field.centre_m.y - field.half_y_m + row as f64 * steps_m[1];
        [x_m, y_m, field.centre_m.z + height_m(column, row)].map(|number| number as f32)
    });
    let normals = places.map(|(column, row)| {
        let ends = |index: usize, count: usize| (index.saturating_sub(1), (index + 1).min(count - 1));
        let ((left, right), (near, far)) = (ends(column, field.columns), ends(row, field.rows));
        let along_x = (height_m(right, row) - height_m(left, row)) / ((right - left) as f64 * steps_m[0]);
        let along_y = (height_m(column, far) - height_m(column, near)) / ((far - near) as f64 * steps_m[1]);
        array(&Vector3::new(-along_x, -along_y, 1.0).normalize())
    });
    let cells = (0..field.rows - 1).flat_map(|row| (0..field.columns - 1).map(move |column| (column, row)));
    let faces = cells.flat_map(|(column, row)| {
        let corner = |columns: usize, rows: usize| ((row + rows) * field.columns + column + columns) as u32;
        [[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)]]
    });
    let mesh = Mesh3D::new(points).with_vertex_normals(normals).with_triangle_indices(faces);
    recording.log_static(path, &mesh.with_vertex_colors(vec![colour; field.heights_m.len()]))
}

fn array(vector: &Vector3<f64>) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}

fn quaternion(rotation: &UnitQuaternion<f64>) -> Quaternion {
    let parts = rotation.quaternion();
    Quaternion::from_xyzw([parts.i, parts.j, parts.k, parts.w].map(|part| part as f32))
}
