//! Hulls of meshes and height fields, compared with MuJoCo's values.

use nalgebra::{Matrix3, Point3};
use treadmill_humanoid::Model;
use treadmill_humanoid::model::Geometry;

use crate::support::{Text, changed};

/// Robot whose root is a mesh of 12 random vertices, above a height field.
pub const ROCK: &str = r"
<mujoco>
  <default><mesh scale='0.5 0.5 0.5'/></default>
  <asset>
    <mesh name='rock' scale='1 1 1' vertex='2.041 -2.556 0.418 -0.568 -0.453 -0.216 -2.02 -0.232 -0.865 3.323 0.226 -0.353
      -0.281 -0.668 -1.055 -0.391 0.482 -0.239 0.958 -0.2 0.024 1.546 0.545 -0.505 -0.183 0.541 1.935 -0.27 -0.244 1.002
      -0.886 -0.292 0.883 0.58 0.092 0.67'/>
    <mesh name='scaled' refpos='1 0 0' refquat='0.7071067811865476 0 0 0.7071067811865476' scale='2 3 1'
      vertex='0 0 0  1 0 0  0 2 0  0 0 3  0.1 0.1 0.1'/>
    <mesh file='unread.stl'/>
    <hfield name='hill' nrow='2' ncol='3' size='3 2 0.5 0.1' elevation='0 1 2 3 4 7'/>
  </asset>
  <worldbody>
    <geom name='floor' type='hfield' hfield='hill' pos='1 2 0.3' friction='0.6'/>
    <body name='base' pos='0 0 9'>
      <freejoint/>
      <geom name='stone' type='mesh' mesh='rock' pos='0.1 0.2 0.3' quat='0.9 0.1 0.2 0.3'/>
      <body name='arm' pos='5 0 0'>
        <joint name='hinge'/>
        <geom name='horn' type='mesh' mesh='scaled'/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint='hinge'/></actuator>
</mujoco>";

fn assert_mass(model: &Model, body: usize, mass_kg: f64, centre_m: [f64; 3], inertia_kgm2: [[f64; 3]; 3]) {
    let body = &model.bodies[body];
    assert!((body.mass_kg / mass_kg - 1.0).abs() < 1e-7, "{}: {} kg", body.name, body.mass_kg);
    assert!((body.centre_of_mass_m - Point3::from(centre_m)).norm() < 1e-6, "{}", body.centre_of_mass_m);
    let wanted = Matrix3::from(inertia_kgm2);
    assert!((body.inertia_kgm2 - wanted).norm() < 1e-6 * wanted.norm(), "{}", body.inertia_kgm2);
}

#[test]
fn hulls_have_mujocos_mass_and_place() {
    let model = Model::from_mjcf(ROCK).expect("valid");
    // MuJoCo 4.0's values; it keeps vertices in single precision.
    let inertia = [
        [8_605.058_342_428, -2_397.684_847_855, 2_149.413_690_720],
        [-2_397.684_847_855, 11_620.438_283_405, 806.539_926_686],
        [2_149.413_690_720, 806.539_926_686, 12_043.994_182_602],
    ];
    assert_mass(&model, 0, 10_566.321_368_274_8, [0.869502671, 0.242792467, 0.112286304], inertia);
    let Geometry::Hull { vertices_m } = &model.bodies[0].shapes[0].geometry else { panic!("a hull") };
    assert!(vertices_m.len() < 12, "vertices within the hull are dropped");
    let first = Point3::new(3.112_473_616, -0.598_210_602, -0.777_684_226);
    assert!((vertices_m[0] - first).norm() < 1e-6, "{}", vertices_m[0]);
    assert_eq!(model.bodies[0].shapes[0].geometry.hull_faces().len(), 2 * vertices_m.len() - 4);

    let inertia = [[4_050.0, -900.0, 900.0], [-900.0, 5_625.0, -675.0], [900.0, -675.0, 5_625.0]];
    assert_mass(&model, 1, 6_000.0, [1.0, 2.25, 0.75], inertia);
    let heavy = changed(ROCK, "mesh='scaled'", "mesh='scaled' mass='3'");
    let inertia = inertia.map(|row| row.map(|entry| entry / 2000.0));
    assert_mass(&Model::from_mjcf(&heavy).expect("valid"), 1, 3.0, [1.0, 2.25, 0.75], inertia);
}

#[test]
fn the_mass_of_a_hull_also_counts_without_contacts() {
    let text = changed(ROCK, "mesh='scaled'", "mesh='scaled' contype='0' conaffinity='0'");
    let model = Model::from_mjcf(&text).expect("valid");
    assert!((model.bodies[1].mass_kg - 6_000.0).abs() < 1e-6 && model.bodies[1].shapes.is_empty());
}

#[test]
fn impossible_meshes_are_refused_by_name() {
    let solid = "vertex='0 0 0  1 0 0  0 2 0  0 0 3  0.1 0.1 0.1'";
    let many = format!("vertex='{}'", "1 2 3 ".repeat(4097));
    Text(ROCK).assert_refused(&[
        (solid, "vertex='0 0 0 1 0 0 0 1 0 1 1 0'", &["mesh `scaled`", "plane", "thin box"]),
        (solid, "vertex='0 0 0 1 0 0 0 1 0'", &["mesh `scaled`", "vertex", "12 to 12288"]),
        (solid, "vertex='0 0 0 1 0 0 0 1 0 1 1 1 1'", &["mesh `scaled`", "13 numbers", "three"]),
        (solid, "vertex='0 0 0 1 0 0 0 1 0 0 0 inf'", &["mesh `scaled`", "vertex", "inf"]),
        (solid, &many, &["mesh `scaled`", "vertex", "12288"]),
        (solid, "file='horn.obj'", &["horn", "mesh `scaled`", "its file"]),
        ("scale='2 3 1'", "scale='2 3 1e9'", &["mesh `scaled`", "scale"]),
        ("scale='2 3 1'", "scale='2 3 0'", &["mesh `scaled`", "plane"]),
        ("scale='2 3 1'", "inertia='hull'", &["mesh `scaled`", "inertia", "hull"]),
        ("scale='2 3 1'", "maxhullvert='8'", &["mesh `scaled`", "maxhullvert"]),
        ("scale='2 3 1'", "face='0 1 9'", &["mesh `scaled`", "`face`", "below 5"]),
        ("scale='2 3 1'", "face='0 1 2 3'", &["mesh `scaled`", "`face`", "three"]),
        (
            "scale='2 3 1'",
            "inertia='exact' face='0 1 2 0 1 3 1 2 3 0 3 2'",
            &["mesh `scaled`", "leave holes or are turned"],
        ),
        ("scale='2 3 1'", "wings='2'", &["mesh `scaled`", "wings"]),
        ("refquat='0.7071067811865476 0 0 0.7071067811865476'", "refquat='0 0 0 0'", &["scaled", "refquat"]),
        ("name='scaled'", "name='rock'", &["mesh `rock`", "two of this name"]),
        ("type='mesh' mesh='scaled'", "type='box' mesh='scaled'", &["horn", "mesh `scaled`"]),
    ]);
}

#[test]
fn height_fields_are_mujocos() {
    let model = Model::from_mjcf(ROCK).expect("valid");
    let field = model.ground.height_field.clone().expect("a height field");
    assert_eq!((field.rows, field.columns, field.half_x_m, field.half_y_m), (2, 3, 3.0, 2.0));
    assert_eq!((field.centre_m, model.ground.friction), (Point3::new(1.0, 2.0, 0.3), 0.6));
    // MuJoCo 4.0's `hfield_data` times 0.5 m: the first row of the text is that of the greatest y.
    let wanted = [0.428_571_43, 0.571_428_6, 1.0, 0.0, 0.142_857_15, 0.285_714_3].map(|share| share * 0.5);
    assert!(field.heights_m.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-7));
    assert!((field.height_at(-1.999_999, 0.000_001).expect("inside") - 0.3 - wanted[0]).abs() < 1e-5);

    let flat = changed(ROCK, "elevation='0 1 2 3 4 7'", "elevation='3 3 3 3 3 3'");
    let flat = Model::from_mjcf(&flat).expect("valid").ground.height_field.expect("a height field");
    assert_eq!(flat.heights_m, [0.0; 6]);
    let level = Model::from_mjcf(&changed(ROCK, "elevation='0 1 2 3 4 7'", "")).expect("valid");
    assert_eq!(level.ground.height_field.as_ref(), Some(&flat));
}

#[test]
fn impossible_height_fields_are_refused_by_name() {
    Text(ROCK).assert_refused(&[
        ("hfield='hill'", "hfield='dale'", &["height field `dale`", "no such"]),
        ("elevation='0 1 2 3 4 7'", "file='hill.png'", &["height field `hill`", "its file", "elevation"]),
        ("elevation='0 1 2 3 4 7'", "elevation='0 1 2 3 4'", &["height field `hill`", "5 numbers", "2 × 3"]),
        ("elevation='0 ", "elevation='nan ", &["height field `hill`", "elevation"]),
        ("nrow='2'", "nrow='1'", &["height field `hill`", "nrow", "from 2 to 1024"]),
        ("ncol='3'", "ncol='2000'", &["height field `hill`", "ncol", "from 2 to 1024"]),
        ("ncol='3'", "ncol='2.5'", &["height field `hill`", "ncol", "whole"]),
        ("size='3 2 0.5 0.1'", "size='3 2 -0.5 0.1'", &["height field `hill`", "greatest height"]),
        ("size='3 2 0.5 0.1'", "size='3 2 0.5'", &["height field `hill`", "size", "4 finite"]),
        ("pos='1 2 0.3'", "pos='1 2 0.3' euler='0 0 30'", &["floor", "not turned"]),
        (
            "<body name='base'",
            "<geom name='plate' type='plane' size='1 1 1'/><body name='base'",
            &["plate", "one floor"],
        ),
    ]);
}
