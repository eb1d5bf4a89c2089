//! URDF files.

use nalgebra::{Point3, Vector3};
use proptest::prelude::*;
use treadmill_humanoid::model::Geometry;
use treadmill_humanoid::{EnvironmentConfig, Model, ModelFiles, Physics};

use crate::support::Folder;

/// A pelvis with a sensor that is mounted on it, and one leg.
const ROBOT: &str = r#"<robot name="one leg">
  <material name="blue"><color rgba="0 0 1 1"/></material>
  <link name="pelvis">
    <inertial>
      <origin xyz="0 0 0.1" rpy="0 0 1.5707963267948966"/>
      <mass value="10"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/>
    </inertial>
    <collision><geometry><box size="0.2 0.4 0.1"/></geometry></collision>
    <collision_checking><capsule name="pelvis_0"/></collision_checking>
  </link>
  <joint name="mount" type="fixed"><parent link="pelvis"/><child link="sensor"/><origin xyz="1 0 0.1"/></joint>
  <link name="sensor">
    <inertial><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <joint name="hip" type="revolute">
    <parent link="pelvis"/><child link="thigh"/>
    <origin xyz="0 0.1 -0.05" rpy="0 0 0.5"/>
    <axis xyz="0 2 0"/>
    <limit lower="-1" upper="2" effort="40" velocity="5"/>
    <dynamics damping="0.5" friction="0.2"/>
    <safety_controller k_velocity="1"/>
  </joint>
  <link name="thigh">
    <inertial>
      <origin xyz="0 0 -0.2"/><mass value="3"/>
      <inertia ixx="0.02" ixy="0.001" ixz="0.002" iyy="0.03" iyz="0.003" izz="0.02"/>
    </inertial>
    <collision><origin xyz="0 0 -0.2" rpy="1.5707963267948966 0 0"/><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision>
  </link>
  <joint name="knee" type="continuous">
    <parent link="thigh"/><child link="foot"/>
    <origin xyz="0 0 -0.4"/>
    <axis xyz="0 1 0"/>
    <limit effort="30" velocity="5"/>
  </joint>
  <link name="foot">
    <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <collision><origin xyz="0 0 -0.1"/><geometry><sphere radius="0.04"/></geometry></collision>
  </link>
  <transmission name="one"/><transmission name="two"/><gazebo/>
</robot>"#;

/// Returns the text of the robot with a part of it replaced.
fn with(from: &str, to: &str) -> String {
    assert!(ROBOT.contains(from), "{from}");
    ROBOT.replacen(from, to, 1)
}

fn text(urdf: &str) -> Result<String, String> {
    let folder = Folder::new("urdf");
    folder.write("robot.urdf", urdf);
    folder.read("robot.urdf")
}

fn model(urdf: &str) -> Model {
    Model::from_mjcf(&text(urdf).expect("a robot")).expect("a valid text")
}

fn held(urdf: &str, files: &ModelFiles) -> Model {
    let folder = Folder::new("urdf-held");
    folder.write("robot.urdf", urdf);
    Model::from_mjcf(&folder.read_with("robot.urdf", files).expect("a robot")).expect("a valid text")
}

#[test]
fn masses_hinges_and_shapes_are_those_of_the_file() {
    let model = model(ROBOT);
    let names: Vec<&str> = model.links.iter().map(|link| link.name.as_str()).collect();
    assert_eq!(names, ["pelvis", "sensor", "thigh", "foot"]);
    // A turn by 90° about z exchanges x and y.
    let pelvis = &model.links[0];
    assert!((pelvis.inertia_kgm2.diagonal() - Vector3::new(0.2, 0.1, 0.25)).norm() < 1e-12, "{}", pelvis.inertia_kgm2);
    assert!((pelvis.centre_of_mass_m - Point3::new(0.0, 0.0, 0.1)).norm() < 1e-12);
    // 10 kg at x = 0 and 2 kg at x = 1 m are one body.
    assert_eq!(model.bodies.len(), 3);
    assert!((model.bodies[0].mass_kg - 12.0).abs() < 1e-12);
    assert!((model.bodies[0].centre_of_mass_m - Point3::new(1.0 / 6.0, 0.0, 0.1)).norm() < 1e-12);
    // About the common centre: 0.1 + 0.1 (thin parts of y), and 10 · 2 / 12 · 1².
    let yy = 0.1 + 0.1 + 20.0 / 12.0;
    assert!((model.bodies[0].inertia_kgm2[(1, 1)] - yy).abs() < 1e-12, "{}", model.bodies[0].inertia_kgm2);
    assert!((model.links[2].inertia_kgm2[(0, 2)] - 0.002).abs() < 1e-12);

    let [hip, knee] = &model.hinges[..] else { panic!("two hinges") };
    assert_eq!((hip.min_rad, hip.max_rad, hip.damping_nmsprad, hip.friction_loss_nm), (-1.0, 2.0, 0.5, 0.2));
    assert_eq!(hip.axis.into_inner(), Vector3::y());
    assert!(knee.min_rad == f64::NEG_INFINITY && knee.max_rad == f64::INFINITY);
    assert_eq!([model.effort_nm(0), model.effort_nm(1)], [Some(40.0), Some(30.0)]);
    let turn = model.bodies[1].pose.rotation;
    assert!((turn.euler_angles().2 - 0.5).abs() < 1e-12);

    let Geometry::Cylinder { radius_m, half_length_m, .. } = model.bodies[1].shapes[0].geometry else {
        panic!("a cylinder: {:?}", model.bodies[1].shapes)
    };
    assert_eq!((radius_m, half_length_m), (0.05, 0.15));
    assert_eq!(model.simplifications[0], "not simulated: <gazebo> (1), <safety_controller> (1), <transmission> (2)");
    assert_eq!(model.simplifications[1], "speeds are not limited: the file allows 5 rad/s (`hip`) to 5 rad/s");
}

#[test]
fn a_fixed_link_may_have_mass_without_inertia() {
    let lens = r#"<link name="lens"><inertial><mass value="0.01"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>
        </inertial></link><joint name="glued" type="fixed"><parent link="pelvis"/><child link="lens"/></joint></robot>"#;
    let urdf = ROBOT.replacen("</robot>", lens, 1);
    assert!((model(&urdf).bodies[0].mass_kg - 12.01).abs() < 1e-12);
    // MuJoCo 4.0 refuses `fullinertia` of zeros.
    assert!(text(&urdf).expect("a robot").contains(r#"mass="0.01" diaginertia="0 0 0""#));
}

#[test]
fn a_robot_stands_on_the_ground() {
    let model = model(ROBOT);
    // The foot's lowest point is 0.05 + 0.4 + 0.1 + 0.04 m below the pelvis.
    assert!((model.nominal_position()[2] - 0.59).abs() < 1e-6, "{:?}", model.nominal_position());
    let physics = Physics::new(model, &EnvironmentConfig::default()).expect("a world");
    assert_eq!(physics.body_motions().count(), 3);
}

#[test]
fn a_joint_to_the_world_frees_the_robot_below_it() {
    let free = |kind: &str| {
        let joint = format!(
            "<link name='world'/><joint name='free' type='{kind}'><parent link='world'/><child link='pelvis'/>\
             <origin rpy='0 0 1' xyz='5 5 5'/></joint><material name='blue'>"
        );
        with("<material name=\"blue\">", &joint)
    };
    let floating = model(&free("floating"));
    assert_eq!((floating.links[0].name.as_str(), floating.bodies.len()), ("pelvis", 3));
    assert!((floating.bodies[0].pose.rotation.angle() - 1.0).abs() < 1e-12);
    assert!((floating.nominal_position()[2] - 0.59).abs() < 1e-6);
    let planar = model(&free("planar"));
    assert!(planar.simplifications.iter().any(|note| note.contains("not only in a plane: `free`")));
    // A fixed base is a robot's first link, like any other.
    assert_eq!(model(&free("fixed")).links[0].name, "world");
    let inside = with("name=\"knee\" type=\"continuous\"", "name=\"knee\" type=\"floating\"");
    assert!(text(&inside).expect_err("a loose foot").contains("joint knee`"));
}

#[test]
fn joints_that_cannot_move_are_held_and_named() {
    let mimic = model(&with("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><mimic joint=\"hip\" offset=\"0.3\"/>"));
    assert_eq!((mimic.hinges.len(), mimic.bodies.len()), (1, 2));
    assert!(mimic.simplifications.iter().any(|note| note == "held still, because they mimic other joints: `knee`"));
    let foot = mimic.links.iter().find(|link| link.name == "foot").expect("a foot");
    assert!((foot.pose.rotation.euler_angles().1 - 0.3).abs() < 1e-12, "held where it is with the other joint at zero");

    let locked = model(&with("lower=\"-1\" upper=\"2\"", "lower=\"0.2\" upper=\"0.2\""));
    assert_eq!(locked.hinges.len(), 1);
    assert!((locked.links[2].pose.rotation * Vector3::x()).z < -0.19, "{}", locked.links[2].pose);

    let slide = with("name=\"hip\" type=\"revolute\"", "name=\"hip\" type=\"prismatic\"");
    assert!(
        text(&slide).expect_err("a slide").contains("joint hip`: it slides, which is not simulated; `--hold-slides`")
    );
    let held = held(&slide, &ModelFiles { holds_slides: true, ..ModelFiles::default() });
    assert!(held.simplifications.iter().any(|note| note == "held still, because they slide: `hip`"));

    let light = model(&with("<mass value=\"1\"/>", "<mass value=\"0\"/>"));
    assert_eq!(light.hinges.len(), 1);
    assert!(light.simplifications.iter().any(|note| note == "held still, because they move no mass: `knee`"));

    let weak = model(&with("effort=\"30\"", "effort=\"0\""));
    assert_eq!((weak.motors.len(), weak.hinges.len()), (1, 2));
    assert!(weak.simplifications.iter().any(|note| note.contains("joint `knee` has no motor")));
}

#[test]
fn faults_are_named_with_their_remedy() {
    for (from, to, problem) in [
        ("effort=\"40\"", "effort=\"strong\"", "joint hip`: `effort` is \"strong\", but must be a finite number"),
        ("xyz=\"0 0.1 -0.05\"", "xyz=\"0 0.1\"", "joint hip`: `xyz` is \"0 0.1\", but must be 3 finite numbers"),
        ("value=\"10\"", "value=\"nan\"", "link pelvis`: `value` is \"nan\""),
        ("value=\"10\"", "value=\"-10\"", "link pelvis`: mass (kg) is -10"),
        ("value=\"10\"", "value=\"${mass}\"", "xacro"),
        ("<axis xyz=\"0 2 0\"/>", "<axis xyz=\"0 0 0\"/>", "joint hip`: `xyz`"),
        ("lower=\"-1\" upper=\"2\"", "lower=\"1\" upper=\"-2\"", "its range ends at -2 rad"),
        ("<link name=\"sensor\">", "<link name=\"thigh\">", "link thigh`: there are two"),
        ("<child link=\"thigh\"/>", "<child link=\"shin\"/>", "joint hip`: its child, link `shin`, is missing"),
        ("<child link=\"sensor\"/>", "<child link=\"thigh\"/>", "hangs from joint `"),
        (
            "<parent link=\"pelvis\"/><child link=\"thigh\"/>",
            "<parent link=\"foot\"/><child link=\"thigh\"/>",
            "in a ring",
        ),
        ("<joint name=\"mount\"", "<link name=\"spare\"/><joint name=\"mount\"", "links `pelvis` and `spare`"),
        ("<limit lower=\"-1\" upper=\"2\" effort=\"40\" velocity=\"5\"/>", "", "joint hip`: it has no <limit>"),
        (
            "upper=\"2\" effort=\"40\" velocity=\"5\"",
            "upper=\"2\" effort=\"40\"",
            "joint hip`: its <limit> has no `velocity`",
        ),
        ("<mass value=\"10\"/>", "", "link pelvis`: its <inertial> has no <mass>"),
        ("type=\"continuous\"", "type=\"spherical\"", "joint knee`: ball joints"),
        ("type=\"continuous\"", "type=\"screw\"", "joint knee`: `type` is \"screw\""),
        ("<child link=\"foot\"/>", "<child/>", "joint knee`: its <child> has no `link`"),
        ("<robot name", "<robot version=\"1.2\" name", "joint hip`: its <limit> has one side only"),
        ("<axis xyz=\"0 2 0\"/>", "<origin quat_xyzw=\"0 0 1 0\"/>", "joint hip`: `quat_xyzw` is of version 1.1"),
        ("name=\"mount\"", "", "a <joint> of the URDF has no `name`"),
    ] {
        let mut changed = with(from, to);
        if to.contains("version") {
            changed = changed.replace("upper=\"2\"", "");
        }
        let found = text(&changed).expect_err(to);
        assert!(found.contains(problem), "{to}: {found}");
    }
}

/// Corners of a box with sides of 2, 4 and 6.
const OBJ: &str = "v -1 -2 -3\nv 1 -2 -3\nv -1 2 -3\nv 1 2 -3\nv -1 -2 3\nv 1 -2 3\nv -1 2 3\nv 1 2 3\n\
                   f 1 2 3\nf 4 5 6\nf 6 7 8\n";

#[test]
fn meshes_are_found_by_their_packages() {
    let folder = Folder::new("urdf-meshes");
    let robot = |file: &str| {
        with("<sphere radius=\"0.04\"/>", &format!("<mesh filename=\"{file}\" scale=\"0.01 0.01 0.02\"/>"))
    };
    folder.write("share/legs/robots/one.urdf", robot("package://legs/meshes/foot.obj"));
    let read = |files: &ModelFiles| folder.read_with("share/legs/robots/one.urdf", files);
    let problem = read(&ModelFiles::default()).expect_err("no file");
    assert!(
        problem.contains("link foot`: the file of its colliding mesh, `package://legs/meshes/foot.obj`, is missing")
    );
    assert!(problem.contains("--package legs=FOLDER") && problem.contains("share/legs/meshes/foot.obj"), "{problem}");

    let hull = |text: &str| match &Model::from_mjcf(text).expect("valid").bodies[2].shapes[0].geometry {
        Geometry::Hull { vertices_m } => vertices_m.iter().map(|vertex| vertex.z).fold(f64::NEG_INFINITY, f64::max),
        other => panic!("{other:?}"),
    };
    folder.write("elsewhere/meshes/foot.obj", OBJ);
    let named = ModelFiles { packages: vec![("legs".to_owned(), folder.0.join("elsewhere"))], ..ModelFiles::default() };
    // 3 · 0.02 above a centre that is 0.1 m below the joint.
    assert!((hull(&read(&named).expect("a file")) + 0.04).abs() < 1e-6);
    // Upward from the file, the folder of the package.
    folder.write("share/legs/meshes/foot.obj", OBJ);
    let text = read(&ModelFiles::default()).expect("a file");
    assert!(!text.contains("file="), "a run carries no files: {text}");

    folder.write("beside.urdf", robot("share/legs/meshes/foot.obj"));
    folder.read("beside.urdf").expect("a path from the file's own folder");
    let stripped = robot("package://gone/foot.obj")
        .replace("<material", "<mujoco><compiler meshdir=\"elsewhere/meshes\"/></mujoco><material");
    folder.write("stripped.urdf", stripped);
    folder.read("stripped.urdf").expect("a path without its folders, as MuJoCo reads it");
}

#[test]
fn masses_that_the_compiler_gives_count() {
    let light = ROBOT.replacen("<mass value=\"1\"/>", "<mass value=\"0\"/>", 1);
    let with_compiler =
        |settings: &str| light.replace("<material", &format!("<mujoco><compiler {settings}/></mujoco><material"));
    assert_eq!(model(&with_compiler("boundmass=\"0.1\" boundinertia=\"0.01\"")).hinges.len(), 2);
    let by_shapes = model(&with_compiler("inertiafromgeom=\"auto\""));
    // A ball of 4 cm has 0.268 kg.
    assert!((by_shapes.bodies[2].mass_kg - 0.268).abs() < 1e-3, "{}", by_shapes.bodies[2].mass_kg);
}

#[test]
fn collada_files_have_their_unit() {
    let folder = Folder::new("urdf-collada");
    let numbers = "-1 -2 -3 1 -2 -3 -1 2 -3 1 2 -3 -1 -2 3 1 -2 3 -1 2 3 1 2 3";
    let dae = format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
        <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
        <library_geometries><geometry id="box"><mesh>
        <source id="places"><float_array id="numbers" count="24">{numbers}</float_array><technique_common>
        <accessor source="#numbers" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
        <param name="Z" type="float"/></accessor></technique_common></source>
        <vertices id="corners"><input semantic="POSITION" source="#places"/></vertices>
        <triangles count="3"><input semantic="VERTEX" source="#corners" offset="0"/><p>0 1 2 3 4 5 5 6 7</p></triangles>
        </mesh></geometry></library_geometries>
        <library_visual_scenes><visual_scene id="scene"><node id="node"><instance_geometry url="#box"/></node>
        </visual_scene></library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>"##
    );
    folder.write("foot.dae", &dae);
    folder.write("robot.urdf", with("<sphere radius=\"0.04\"/>", "<mesh filename=\"foot.dae\"/>"));
    let model = Model::from_mjcf(&folder.read("robot.urdf").expect("a robot")).expect("valid");
    // Half of the height, 3 cm, below a centre that is 0.55 m below the pelvis.
    assert!((model.nominal_position()[2] - 0.58).abs() < 1e-6, "{:?}", model.nominal_position());
    for (from, to, problem) in [
        ("0 1 2 3 4 5 5 6 7", "0 1 2 3 4 5 5 6 99", "its indices and arrays do not fit"),
        ("<node id=", "<node><instance_geometry url=\"#box\"/></node><node id=", "it places a geometry twice"),
        ("<node id=", "<node><instance_node url=\"#part\"/></node><node id=", "<instance_node> is not read"),
    ] {
        folder.write("foot.dae", dae.replacen(from, to, 1));
        let found = folder.read("robot.urdf").expect_err(to);
        assert!(found.contains(problem), "{found}");
    }
}

proptest! {
    #[test]
    fn changed_texts_are_read_or_refused(
        cuts in prop::collection::vec((0..ROBOT.len(), 0..40_usize, "[-0-9a-z<>/\"= .]{0,3}"), 1..4)
    ) {
        let mut changed = ROBOT.to_owned();
        for (start, length, with) in cuts {
            let (start, end) = (start.min(changed.len()), (start + length).min(changed.len()));
            changed.replace_range(start..end, &with);
        }
        if let Ok(text) = text(&changed) {
            prop_assert!(Model::without_motors(&text).is_ok(), "{}", text);
        }
    }
}
