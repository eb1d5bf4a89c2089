//! Replicas and attached models, compared with what MuJoCo makes of the same text; `experiments/fidelity/mjcf_diff.py`
//! compares their motion.

use nalgebra::Point3;
use treadmill_humanoid::Model;

use crate::support::{Folder, changed};

/// Parent with two hands and three fins, defaults and a keyframe.
const PARENT: &str = r"
<mujoco>
  <default><geom size='.1' friction='.7'/><joint armature='.02'/></default>
  <asset><model name='hand' file='parts/hand.xml'/></asset>
  <worldbody>
    <geom type='plane' size='1 1 1'/>
    <body name='base' pos='0 0 2'><freejoint/><geom/>
      <body name='arm' pos='0 0 -.2'><joint name='j'/><geom/>
        <frame pos='0 .1 0' euler='0 0 90'><attach model='hand' body='palm' prefix='l_'/></frame>
        <attach model='hand' body='palm' prefix='r_'/>
      </body>
      <replicate count='3' offset='0 .1 0' euler='0 0 90' sep='-'><body name='fin' pos='.3 0 0'><joint name='fin'/><geom/></body></replicate>
    </body>
  </worldbody>
  <contact><exclude body1='base' body2='fin'/></contact>
  <actuator><motor joint='j'/><motor name='fm' joint='fin' gear='3'/></actuator>
</mujoco>";

const HAND: &str = r"
<mujoco model='any hand'>
  <compiler meshdir='meshes'/>
  <default><geom size='.03'/><joint damping='.3'/><default class='soft'><geom friction='.4'/></default></default>
  <asset><mesh file='tip.stl'/></asset>
  <worldbody>
    <geom name='loose'/>
    <body name='palm' pos='1 0 0'><geom name='p'/>
      <body name='finger' pos='0 0 -.1'><joint name='f' axis='0 1 0'/><geom class='soft'/><geom type='mesh' mesh='tip'/></body>
    </body>
  </worldbody>
  <actuator><motor name='grip' joint='f'/></actuator>
  <keyframe><key name='open' qpos='.5'/></keyframe>
</mujoco>";

fn folder(parent: &str, hand: &str) -> Folder {
    let folder = Folder::new("composed");
    folder.write("robot.xml", parent);
    folder.write("parts/hand.xml", hand);
    folder.write("parts/meshes/tip.stl", tetrahedron());
    folder
}

/// Binary STL of the corner of a cube of 0.1 m.
fn tetrahedron() -> Vec<u8> {
    let corners = [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1f32]];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mut bytes = vec![0; 80];
    bytes.extend(4u32.to_le_bytes());
    for face in faces {
        bytes.extend([0; 12]);
        bytes.extend(face.iter().flat_map(|corner: &usize| corners[*corner]).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn copies_have_names_places_and_defaults_of_their_own() {
    let model = Model::from_mjcf(&folder(PARENT, HAND).read("robot.xml").expect("readable")).expect("valid");
    let links: Vec<&str> = model.links.iter().map(|link| link.name.as_str()).collect();
    assert_eq!(links, ["base", "arm", "l_palm", "l_finger", "r_palm", "r_finger", "fin-0", "fin-1", "fin-2"]);
    let motors: Vec<&str> = model.motors.iter().map(|motor| motor.name.as_str()).collect();
    assert_eq!(motors, ["j", "l_grip", "r_grip", "fm-0", "fm-1", "fm-2"]);
    let hinge = |name: &str| model.hinges.iter().find(|hinge| hinge.name == name).expect("a hinge");
    // MuJoCo 4.0: neither has the other's defaults.
    assert_eq!((hinge("l_f").armature_kgm2, hinge("l_f").damping_nmsprad), (0.0, 0.3));
    assert_eq!((hinge("fin-2").armature_kgm2, hinge("fin-2").damping_nmsprad), (0.02, 0.0));
    let place = |name: &str| {
        let link = model.links.iter().find(|link| link.name == name).expect("a link");
        let mut at = link.pose * Point3::origin();
        let mut body = link.body;
        while let Some(parent) = model.bodies[body].parent {
            at = model.bodies[body].pose * at;
            body = parent;
        }
        at
    };
    for (name, wanted) in [
        ("l_palm", [0.0, 1.1, -0.2]),
        ("r_palm", [1.0, 0.0, -0.2]),
        ("fin-0", [0.3, 0.0, 0.0]),
        ("fin-1", [0.0, 0.4, 0.0]),
        // Turned by 180° at (0, 0.1, 0) + (−0.1, 0, 0).
        ("fin-2", [-0.4, 0.1, 0.0]),
    ] {
        assert!((place(name) - Point3::from(wanted)).norm() < 1e-12, "{name}: {}", place(name));
    }
    let finger = &model.bodies[model.links[3].body];
    // The sole of `soft`, and the mesh below the other folder, with the child's own friction.
    assert_eq!(finger.shapes.iter().map(|shape| shape.friction).collect::<Vec<_>>(), [0.4, 1.0]);
    let trunk = &model.bodies[0].shapes[0];
    assert_eq!(trunk.friction, 0.7);
    assert!(model.simplifications.iter().any(|note| note.contains("keyframes") && note.contains("l_")));
}

#[test]
fn what_cannot_be_composed_is_refused_by_name() {
    let attach = "<attach model='hand' body='palm' prefix='r_'/>";
    let replicate = "count='3' offset='0 .1 0'";
    for (from, to, parts) in [
        (attach, "<attach model='hand' body='palm'/>", &["palm", "`prefix` is missing"][..]),
        (attach, "<attach model='claw' body='palm' prefix='r_'/>", &["no <model> `claw`"]),
        (attach, "<attach model='hand' body='thumb' prefix='r_'/>", &["no body `thumb`"]),
        (attach, "<attach model='hand' body='palm' frame='x' prefix='r_'/>", &["either `body` or `frame`"]),
        (attach, "<attach prefix='r_'/>", &["give `model`, `body` or `frame`"]),
        (attach, "<attach body='base' prefix='r_'/>", &["base", "<replicate> or <attach> in it"]),
        (attach, "<attach model='hand' body='palm' prefix='r_' wings='2'/>", &["wings"]),
        (attach, "<attach model='hand' body='palm' prefix='l_'/>", &["l_palm", "two"]),
        (replicate, "count='0' offset='0 .1 0'", &["count", "1 to 1024"]),
        (replicate, "count='many'", &["count", "many"]),
        (replicate, "count='1000000'", &["count", "1 to 1024"]),
        ("parts/hand.xml", "parts/claw.xml", &["claw.xml"]),
    ] {
        let message = folder(&changed(PARENT, from, to), HAND)
            .read("robot.xml")
            .and_then(|text| Model::from_mjcf(&text).map(|_| String::new()).map_err(|why| why.to_string()));
        let message = message.expect_err(to);
        assert!(parts.iter().all(|part| message.contains(part)), "{to}: {parts:?} are missing in: {message}");
    }
    let radian = changed(HAND, "<compiler ", "<compiler angle='radian' ");
    let message = folder(PARENT, &radian).read("robot.xml").expect_err("another unit");
    assert!(["`angle`", "parts/hand.xml", "radian", "degree"].iter().all(|part| message.contains(part)), "{message}");
    // A model that attaches itself has no end.
    let endless = changed(PARENT, "parts/hand.xml", "robot.xml");
    let message = folder(&endless, HAND).read("robot.xml").expect_err("endless");
    assert!(message.contains("more than 8 deep"), "{message}");
    // Copies of copies must not fill the memory.
    let mut nested = "<geom size='.1'/>".to_owned();
    for _ in 0..6 {
        nested = format!("<replicate count='1000'>{nested}</replicate>");
    }
    let huge = changed(PARENT, attach, &nested);
    let message = folder(&huge, HAND).read("robot.xml").expect_err("too large");
    assert!(message.contains("16777216"), "{message}");
}

#[test]
fn attached_files_are_found_from_a_relative_path() {
    let folder = folder(PARENT, HAND);
    // Cargo runs tests in the package's folder: the way from there to the temporary one.
    let here = std::env::current_dir().expect("a folder");
    let up: std::path::PathBuf = here.components().skip(1).map(|_| "..").collect();
    let relative = up.join(folder.0.strip_prefix("/").expect("an absolute folder")).join("robot.xml");
    assert!(relative.is_relative());
    let text =
        treadmill_humanoid::read_model_file(&relative, &treadmill_humanoid::ModelFiles::default()).expect("readable");
    assert_eq!(Model::from_mjcf(&text).expect("valid").links.len(), 9);
}

#[test]
fn replicas_turn_and_are_named_as_in_mujoco() {
    let fins = "<replicate count='10' offset='.1 .2 .3' euler='10 20 30'><body name='b' pos='1 0 0'><joint/><geom/></body></replicate>";
    let text = changed(PARENT, "<body name='arm'", &format!("{fins}<body name='arm'"));
    let model = Model::from_mjcf(&folder(&text, HAND).read("robot.xml").expect("readable")).expect("valid");
    let body = model.bodies.iter().find(|body| body.name == "b02").expect("two digits for ten");
    // MuJoCo 4.0's `body_pos`: the second copy has turned by twice the angles.
    let wanted = Point3::new(0.573_039, 1.293_786, 0.615_083);
    assert!((body.pose.translation.vector - wanted.coords).norm() < 2e-6, "{}", body.pose.translation.vector);
}
