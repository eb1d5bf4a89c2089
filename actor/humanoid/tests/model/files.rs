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
}

#[test]
fn an_stl_of_text_is_read_and_noted() {
    let folder = robot("text-stl");
    let facet = |corners: [[f32; 3]; 3]| {
        let corners = corners.map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let facets =
        [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|face| facet(face.map(|corner: usize| points[corner])));
    folder.write("parts/skull.stl", format!("solid skull\n{}endsolid skull\n", facets.concat()));
    let model = Model::from_mjcf(&folder.read("robot.xml").expect("all there")).expect("valid");
    assert_eq!(corners(&model, 0).len(), 4);
    let note = "MuJoCo 4.0 does not read the file of mesh `skull`, which is an STL of text";
    assert!(model.simplifications.iter().any(|found| found == note), "{:?}", model.simplifications);
    let binary = Model::from_mjcf(&robot("binary-stl").read("robot.xml").expect("all there")).expect("valid");
    assert!(binary.simplifications.iter().all(|found| !found.contains("MuJoCo")), "{:?}", binary.simplifications);
}

#[test]
fn the_last_folder_of_assets_counts() {
    let folder = robot("folders");
    let read = |compilers: &str| {
        folder.write("changed.xml", ROBOT.replacen("<compiler meshdir='parts' assetdir='unused'/>", compilers, 1));
        folder.read("changed.xml")
    };
    assert!(read("<compiler assetdir='unused'/><compiler meshdir='parts'/>").is_ok());
    let problem = read("<compiler meshdir='parts'/><compiler assetdir='elsewhere'/>").expect_err("no such folder");
    assert!(problem.contains("elsewhere"), "{problem}");
}

#[test]
fn the_mass_of_a_mesh_file_is_that_of_the_whole_mesh() {
    let folder = Folder::new("masses");
    let model = |mesh: &str| {
        let text = format!(
            "<mujoco><asset><mesh name='part' {mesh}/></asset><worldbody><body pos='0 0 2'><freejoint/>
             <geom type='mesh' mesh='part' pos='1 0 0'/></body></worldbody></mujoco>"
        );
        folder.write("robot.xml", text);
        folder.read("robot.xml").map(|text| Model::without_motors(&text).expect("valid"))
    };
    // An L of three unit cubes.
    let outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    let corners = (0..2).flat_map(|z| outline.map(|[x, y]| format!("v {x} {y} {z}\n")));
    let ends = [[1, 2, 3], [1, 3, 4], [1, 4, 5], [1, 5, 6]];
    let ends = ends.iter().flat_map(|[a, b, c]| [[*c, *b, *a], [a + 6, b + 6, c + 6]]);
    let sides = (1..7).flat_map(|a| [[a, a % 6 + 1, a % 6 + 7], [a, a % 6 + 7, a + 6]]);
    let faces: Vec<[i32; 3]> = ends.chain(sides).collect();
    let write = |name: &str, faces: &[[i32; 3]]| {
        let faces = faces.iter().map(|[a, b, c]| format!("f {a} {b} {c}\n"));
        folder.write(name, corners.clone().chain(faces).collect::<String>());
    };
    write("solid.obj", &faces);
    let outline = [[0, 0], [4, 0], [4, 3], [3, 3], [3, 1], [1, 1], [1, 3], [0, 3]];
    let corners_of_arms = (0..2).flat_map(|z| outline.map(|[x, y]| format!("v {x} {y} {z}\n")));
    let ends = [[1, 2, 5], [1, 5, 6], [2, 3, 4], [2, 4, 5], [1, 6, 7], [1, 7, 8]];
    let ends = ends.iter().flat_map(|[a, b, c]| [[*c, *b, *a], [a + 8, b + 8, c + 8]]);
    let sides = (1..9).flat_map(|a| [[a, a % 8 + 1, a % 8 + 9], [a, a % 8 + 9, a + 8]]);
    let faces_of_arms = ends.chain(sides).map(|[a, b, c]| format!("f {a} {b} {c}\n"));
    folder.write("arms.obj", corners_of_arms.chain(faces_of_arms).collect::<String>());
    write("turned.obj", &faces.iter().map(|[a, b, c]| [*c, *b, *a]).collect::<Vec<_>>());
    write("open.obj", &[&faces[..1], &faces[2..]].concat());
    // MuJoCo 4.0's masses (kg), centres (m), and least principal inertias (kg·m²).
    for (mesh, mass_kg, centre, inertia_kgm2) in [
        ("file='solid.obj'", 3000.0, [5.0 / 6.0, 5.0 / 6.0, 0.5], 833.333),
        ("file='solid.obj' inertia='exact'", 3000.0, [5.0 / 6.0, 5.0 / 6.0, 0.5], 833.333),
        ("file='solid.obj' inertia='convex'", 3500.0, [0.9048, 0.9048, 0.5], 1103.175),
        ("file='turned.obj'", 3000.0, [5.0 / 6.0, 5.0 / 6.0, 0.5], 833.333),
        ("file='solid.obj' scale='-1 1 1'", 3000.0, [-5.0 / 6.0, 5.0 / 6.0, 0.5], 833.333),
        ("file='solid.obj' scale='-1 1 1' inertia='exact'", 3000.0, [-5.0 / 6.0, 5.0 / 6.0, 0.5], 833.333),
        // A U, whose centre does not see all of its faces.
        ("file='arms.obj'", 11_177.336_659, [2.0, 1.383_002, 0.5], 8_321.094_671),
        ("file='arms.obj' scale='6 1 1'", 67_034.426_381, [12.0, 1.379_303, 0.5], 49_914.727_537),
        ("file='open.obj' inertia='convex'", 3500.0, [0.9048, 0.9048, 0.5], 1103.175),
        ("file='open.obj'", 2_825.582_751, [0.809_674, 0.856_177, 0.476_748], 784.320_977),
    ] {
        let model = model(mesh).expect(mesh);
        let link = &model.links[0];
        let centre = nalgebra::Point3::from(centre) + nalgebra::Vector3::x();
        assert!((link.mass_kg / mass_kg - 1.0).abs() < 1e-6, "{mesh}: {}", link.mass_kg);
        assert!((link.centre_of_mass_m - centre).norm() < 1e-4, "{mesh}: {}", link.centre_of_mass_m);
        let least = link.inertia_kgm2.symmetric_eigenvalues().min();
        assert!((least / inertia_kgm2 - 1.0).abs() < 2e-6, "{mesh}: {least}");
    }
    for mesh in ["file='turned.obj' inertia='exact'", "file='open.obj' inertia='exact'"] {
        let problem = model(mesh).expect_err(mesh);
        assert!(
            problem.contains("mesh `part`") && problem.contains("leave holes or are turned inside out"),
            "{problem}"
        );
    }

    // Where it gives no mass, a mesh may have holes.
    folder.write(
        "robot.xml",
        "<mujoco><compiler inertiafromgeom='false'/><asset><mesh name='part' file='open.obj'/></asset><worldbody>
         <body pos='0 0 2'><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><geom type='mesh' mesh='part'/>
         <body><geom type='mesh' mesh='part'/></body></body></worldbody></mujoco>",
    );
    assert_eq!(
        Model::without_motors(&folder.read("robot.xml").expect("readable")).expect("valid").links[0].mass_kg,
        1.0
    );

    // A hull of 64 corners of a ball of 1 m would lack several percent of its mass.
    let ball = (0..2000).map(|number| {
        let (z, turn) = (1.0 - (2.0 * f64::from(number) + 1.0) / 2000.0, f64::from(number) * 2.399_963);
        let across = (1.0 - z * z).sqrt();
        format!("v {} {} {z}\n", across * turn.cos(), across * turn.sin())
    });
    folder.write("ball.obj", ball.chain(["f 1 2 3\n".to_owned()]).collect::<String>());
    let model = model("file='ball.obj' inertia='convex' scale='1 1 2'").expect("a ball");
    let share = model.links[0].mass_kg / (4000.0 / 3.0 * std::f64::consts::PI * 2.0);
    assert!((0.995..1.0).contains(&share), "{share}");
    assert_eq!(model.bodies[0].shapes.len(), 1);
}
