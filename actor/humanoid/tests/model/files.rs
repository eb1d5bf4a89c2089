//! Model files with what they include and name: other texts, meshes and height fields.

use std::path::Path;

use treadmill_humanoid::model::Geometry;
use treadmill_humanoid::{HUMANOID_XML, Model};

use crate::support::Folder;

#[test]
fn included_files_are_inserted() {
    let folder = Folder::new("includes");
    let write = |name: &str, text: &str| folder.write(name, text);
    let (before, worldbody) = HUMANOID_XML.split_once("<worldbody>").expect("a worldbody");
    let (worldbody, motors) = worldbody.split_once("</worldbody>").expect("its end");
    write("robot.xml", &format!("{before}<include file='parts/world.xml'/>{motors}"));
    // Paths are relative to the outermost file.
    write("parts/world.xml", "<mujocoinclude><worldbody><include file='parts/body.xml'/></worldbody></mujocoinclude>");
    write("parts/body.xml", &format!("<mujoco>{worldbody}</mujoco>"));
    let read = || folder.read("robot.xml");
    let model = Model::from_mjcf(&read().expect("all there")).expect("valid");
    assert_eq!(format!("{model:?}"), format!("{:?}", Model::from_mjcf(HUMANOID_XML).expect("valid")));

    write("parts/body.xml", "<mujoco><include file='robot.xml'/></mujoco>");
    assert!(read().expect_err("a circle").contains("`robot.xml` is included twice"));
    std::fs::remove_file(folder.0.join("parts/body.xml")).expect("it exists");
    assert!(read().expect_err("missing").contains("parts/body.xml"));
}

/// Corners of a box, and points within its faces and inside.
const POINTS: [[f32; 3]; 11] = [
    [-1.0, -2.0, -3.0],
    [1.0, -2.0, -3.0],
    [-1.0, 2.0, -3.0],
    [1.0, 2.0, -3.0],
    [-1.0, -2.0, 3.0],
    [1.0, -2.0, 3.0],
    [-1.0, 2.0, 3.0],
    [1.0, 2.0, 3.0],
    [0.0, 0.0, 3.000_01],
    [1.0, 0.3, 0.2],
    [0.1, 0.2, 0.3],
];

/// Binary STL file with every triple of neighbours as a triangle.
fn stl(points: &[[f32; 3]]) -> Vec<u8> {
    let triangles: Vec<[[f32; 3]; 3]> = points.windows(3).map(|three| [three[0], three[1], three[2]]).collect();
    let mut bytes = vec![0; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        let numbers = [0.0; 3].into_iter().chain(triangle.into_iter().flatten());
        bytes.extend(numbers.flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

fn obj(points: &[[f32; 3]]) -> String {
    let vertices = points.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = (1..points.len() - 1).map(|first| format!("f {} {} {}\n", first, first + 1, first + 2));
    vertices.chain(faces).collect()
}

const ROBOT: &str = r"<mujoco><compiler meshdir='parts' assetdir='unused'/>
  <default><mesh scale='0.1 0.1 0.1'/>
    <default class='visual'><geom type='mesh' contype='0' conaffinity='0' density='0'/></default>
    <default class='solid'><geom type='mesh'/></default></default>
  <asset><mesh file='skull.stl'/><mesh name='shell' file='missing.obj'/><mesh name='foot' file='sole.OBJ' scale='0.2 0.1 0.1'/>
    <hfield name='hill' file='hill.png' size='3 2 0.5 0.1'/></asset>
  <worldbody><geom name='floor' type='hfield' hfield='hill'/>
    <body name='head' pos='0 0 5'><freejoint/><inertial pos='0 0 0' mass='3' diaginertia='0.1 0.1 0.1'/>
      <geom class='visual' mesh='shell'/><geom name='skull' class='solid' mesh='skull'/>
      <body name='leg'><joint name='neck'/><inertial pos='0 0 0' mass='1' diaginertia='0.1 0.1 0.1'/>
        <geom class='visual' name='foot' mesh='foot'/></body></body></worldbody>
  <contact><pair geom1='foot' geom2='floor'/></contact>
  <actuator><motor joint='neck'/></actuator></mujoco>";

/// Folder with all files of [`ROBOT`] that its motion depends on.
fn robot(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("robot.xml", ROBOT);
    folder.write("parts/skull.stl", stl(&POINTS));
    folder.write("parts/sole.OBJ", obj(&POINTS));
    let mut image = Vec::new();
    let mut encoder = png::Encoder::new(&mut image, 3, 2);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[10, 20, 30, 40, 50, 110]).expect("pixels");
    writer.finish().expect("complete");
    folder.write("parts/hill.png", image);
    folder
}

fn corners(model: &Model, body: usize) -> Vec<[f64; 3]> {
    let Geometry::Hull { vertices_m } = &model.bodies[body].shapes[0].geometry else { panic!("a hull") };
    let mut corners: Vec<[f64; 3]> = vertices_m.iter().map(|corner| [corner.x, corner.y, corner.z]).collect();
    corners.sort_by(|one, other| one.partial_cmp(other).expect("finite"));
    corners
}

#[test]
fn colliding_meshes_and_height_fields_travel_in_the_text() {
    let text = robot("meshes").read("robot.xml").expect("all there");
    // The folder is gone: nothing but the text is needed.
    let model = Model::from_mjcf(&text).expect("valid");
    let (skull, foot) = (corners(&model, 0), corners(&model, 1));
    assert_eq!((skull.len(), foot.len()), (8, 8), "points within or almost within faces are dropped");
    for (found, scale) in [(skull, [0.1, 0.1, 0.1]), (foot, [0.2, 0.1, 0.1])] {
        let size: [f64; 3] = std::array::from_fn(|axis| (axis + 1) as f64 * scale[axis]);
        assert!(found.iter().flatten().zip(size.iter().cycle()).all(|(entry, size)| (entry.abs() - size).abs() < 1e-6));
    }
    assert_eq!(model.bodies[0].shapes.len(), 1, "a visual mesh costs nothing");
    let field = model.ground.height_field.expect("a height field");
    assert_eq!((field.rows, field.columns), (2, 3));
    // The first row of the image is that of the greatest y; heights are shares of 0.5 m.
    let wanted = [0.3, 0.4, 1.0, 0.0, 0.1, 0.2].map(|share| share * 0.5);
    assert!(field.heights_m.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-12));
}

#[test]
fn a_round_mesh_becomes_a_hull_of_few_corners() {
    let folder = robot("round");
    // 2,000 points of a ball on a spiral.
    let ball: Vec<[f32; 3]> = (0..2000)
        .map(|index| {
            let (z, turn) = (1.0 - (index as f32 + 0.5) / 1000.0, index as f32 * 2.399_963);
            let radius = (1.0 - z * z).sqrt();
            [radius * turn.cos(), radius * turn.sin(), z]
        })
        .collect();
    folder.write("parts/skull.stl", stl(&ball));
    let model = Model::from_mjcf(&folder.read("robot.xml").expect("all there")).expect("valid");
    let found = corners(&model, 0);
    assert_eq!(found.len(), 64);
    let far = |direction: [f64; 3]| {
        found.iter().map(|at| (0..3).map(|axis| at[axis] * direction[axis]).sum::<f64>()).fold(0.0, f64::max)
    };
    for direction in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.0, -0.8], [0.0, 0.8, 0.6]] {
        assert!((0.09..0.100_001).contains(&far(direction)), "{direction:?}: {}", far(direction));
    }
}

#[test]
fn files_that_cannot_be_used_are_named() {
    let folder = robot("bad");
    for (name, bytes, parts) in [
        ("skull.stl", b"solid".to_vec(), &["mesh `skull`", "skull.stl"][..]),
        ("skull.stl", stl(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), &["mesh `skull`", "plane"]),
        ("skull.stl", stl(&[[f32::NAN; 3]; 9]), &["mesh `skull`", "plane"]),
        ("hill.png", b"GIF89a".to_vec(), &["height field `hill`", "hill.png", "not a PNG"]),
    ] {
        let path = format!("parts/{name}");
        let before = std::fs::read(folder.0.join(&path)).expect("it exists");
        folder.write(&path, bytes);
        let problem = folder.read("robot.xml").expect_err("useless");
        assert!(parts.iter().all(|part| problem.contains(part)), "{parts:?} are missing in: {problem}");
        folder.write(&path, before);
    }
    let with = |from: &str, to: &str| {
        assert!(ROBOT.contains(from), "{from}");
        folder.write("changed.xml", ROBOT.replacen(from, to, 1));
        folder.read("changed.xml")
    };
    let problem = with("skull.stl", "skull.msh").expect_err("a format of MuJoCo alone");
    assert!(problem.contains("mesh `skull`") && problem.contains("neither STL, OBJ nor DAE"), "{problem}");
    let problem = with("sole.OBJ", "gone.obj").expect_err("missing");
    assert!(problem.contains(Path::new("parts").join("gone.obj").to_str().expect("text")), "{problem}");
    // Without an <inertial> the mass would be that of the faces.
    let text = with("<inertial pos='0 0 0' mass='3' diaginertia='0.1 0.1 0.1'/>", "").expect("readable");
    let problem = Model::from_mjcf(&text).expect_err("unknown mass").to_string();
    assert!(problem.contains("faces of mesh `skull`") && problem.contains("<inertial>"), "{problem}");
}
