//! Equalities, polynomial springs and friction, frames around joints, and rotors of actuators, with MuJoCo's values.

use nalgebra::{Point3, Vector3};
use treadmill_humanoid::{Mirror, Model};

use crate::automatic::upright;
use crate::support::{Text, changed};

/// Two arms whose second hinge follows the first, joined at their ends.
const ARMS: &str = r"
<mujoco>
  <compiler angle='radian'/>
  <default><equality solref='0.05 0.8'/></default>
  <worldbody>
    <geom type='plane' size='1 1 1'/>
    <body name='base' pos='0 0 2'><freejoint/><geom size='0.1'/>
      <body name='left' pos='0 0.2 0' euler='0.3 0 0'>
        <joint name='a' axis='0 1 0' ref='0.2' springdamper='0.3 0.7'/>
        <geom type='capsule' fromto='0 0 0 0 0 -0.3' size='0.04'/>
        <site name='tip' pos='0 0 -0.3'/>
        <body name='hand' pos='0 0 -0.3'><geom size='0.03'/></body>
      </body>
      <body name='right' pos='0 -0.2 0'>
        <frame pos='0 0 0.1' euler='1.5707963267948966 0 0'>
          <joint name='b' axis='0 1 0' pos='0 0 0.1' damping='1 2 3' stiffness='4 5 6' armature='0.1'/>
        </frame>
        <geom type='capsule' fromto='0 0 0 0 0 -0.3' size='0.04'/>
        <frame pos='0 0 -0.1'><site name='end' pos='0.01 0 -0.2'/></frame>
      </body>
    </body>
  </worldbody>
  <equality>
    <joint name='mimic' joint1='b' joint2='a' polycoef='0.1 -0.5'/>
    <connect name='rod' body1='hand' body2='right' anchor='0 0.02 -0.05' solimp='0.8'/>
  </equality>
  <actuator><motor name='m' joint='b' gear='3' armature='0.01' damping='0.2 0.3 0.4'/></actuator>
</mujoco>";

#[test]
fn hinges_may_follow_others() {
    let model = Model::from_mjcf(ARMS).expect("valid");
    let [mimic] = &model.couplings[..] else { panic!("one coupling") };
    assert_eq!((mimic.name.as_str(), mimic.hinge, mimic.follows), ("mimic", 1, Some((0, -0.5))));
    // Both count from the pose of the text, where the first is at 0.2: 0 + 0.1 − (−0.5) × 0.2.
    assert!((mimic.offset_rad - 0.2).abs() < 1e-12);
    // 2 / (0.95 × 0.05).
    assert!((mimic.softness.damping - 42.105_263_157_894_74).abs() < 1e-9);
    assert_eq!(model.moved_by(0).as_deref(), Some("follows `b`"), "the other one has the motor");
    assert_eq!(model.moved_by(1), None);
    let alone = changed(ARMS, "joint1='b' joint2='a' polycoef='0.1 -0.5'", "joint1='a' polycoef='0.1 7'");
    let model = Model::from_mjcf(&alone).expect("valid");
    assert_eq!(model.couplings[0].follows, None);
    assert!((model.couplings[0].offset_rad - 0.3).abs() < 1e-12);
}

#[test]
fn points_of_two_bodies_may_stay_together() {
    let model = Model::from_mjcf(ARMS).expect("valid");
    let [rod] = &model.connections[..] else { panic!("one connection") };
    assert_eq!(rod.links.map(|link| model.links[link].name.as_str()), ["hand", "right"]);
    assert!((rod.points_m[0] - Point3::new(0.0, 0.02, -0.35)).norm() < 1e-12, "in the frame of `left`");
    // In the world the anchor is (0, 0.2, 2) + Rx(0.3) (0, 0.02, −0.35).
    let (sin, cos) = 0.3f64.sin_cos();
    let wanted = Point3::new(0.0, 0.4 + 0.02 * cos + 0.35 * sin, 0.02 * sin - 0.35 * cos);
    assert!((rod.points_m[1] - wanted).norm() < 1e-12, "{}", rod.points_m[1]);
    assert_eq!(rod.softness.impedance, [0.8, 0.95, 0.001, 0.5, 2.0]);
    let by_sites = changed(ARMS, "body1='hand' body2='right' anchor='0 0.02 -0.05'", "site1='tip' site2='end'");
    let model = Model::from_mjcf(&by_sites).expect("valid");
    let rod = &model.connections[0];
    assert_eq!(rod.points_m, [Point3::new(0.0, 0.0, -0.3), Point3::new(0.01, 0.0, -0.1 - 0.2)]);
}

#[test]
fn hinges_have_polynomials_frames_and_rotors() {
    let model = Model::from_mjcf(ARMS).expect("valid");
    let [a, b] = &model.hinges[..] else { panic!("two hinges") };
    // Rx(π/2) (0, 1, 0), and (0, 0, 0.1) + Rx(π/2) (0, 0, 0.1).
    assert!((b.axis.into_inner() - Vector3::z()).norm() < 1e-12);
    assert!((b.anchor_m - Point3::new(0.0, -0.1, 0.1)).norm() < 1e-12);
    assert_eq!((b.stiffness_nmprad, b.stiffness_powers), (4.0, [5.0, 6.0]));
    // Those of the joint, and nine times those of the actuator.
    assert!((b.damping_nmsprad - 2.8).abs() < 1e-12 && (b.armature_kgm2 - 0.19).abs() < 1e-12);
    assert!((Vector3::from_row_slice(&[b.damping_powers[0] - 4.7, b.damping_powers[1] - 6.6, 0.0])).norm() < 1e-12);
    // MuJoCo 4.0's `jnt_stiffness` and `dof_damping` of this text.
    assert!((a.stiffness_nmprad / 0.318_236_382_083_542_77 - 1.0).abs() < 2e-6, "{}", a.stiffness_nmprad);
    assert!((a.damping_nmsprad / 0.093_561_496_332_561_57 - 1.0).abs() < 2e-6, "{}", a.damping_nmsprad);
}

#[test]
fn impossible_equalities_are_refused_by_name() {
    let mimic = "joint1='b' joint2='a' polycoef='0.1 -0.5'";
    let rod = "body1='hand' body2='right' anchor='0 0.02 -0.05'";
    Text(ARMS).assert_refused(&[
        (mimic, "joint2='a'", &["mimic", "`joint1` is missing"]),
        (mimic, "joint1='b' joint2='wing'", &["mimic", "`joint2` `wing`"]),
        (mimic, "joint1='b' joint2='b'", &["mimic", "the same"]),
        (mimic, "joint1='b' joint2='a' polycoef='0 1 0.5'", &["mimic", "polycoef", "0 1 0.5", "proportion"]),
        (mimic, "joint1='b' joint2='a' active='maybe'", &["mimic", "active", "maybe"]),
        (mimic, "joint1='b' joint2='a' wings='2'", &["mimic", "wings"]),
        (rod, "body1='hand'", &["rod", "`body1`, `body2` and `anchor`, or `site1` and `site2`"]),
        (rod, "body1='hand' anchor='0 0 0'", &["rod", "`world` does not move"]),
        (rod, "body1='hand' body2='left' anchor='0 0 0'", &["rod", "one rigid body"]),
        (rod, "body1='hand' body2='wing' anchor='0 0 0'", &["rod", "no body `wing`"]),
        (rod, "site1='tip' site2='wing'", &["rod", "no site `wing`"]),
        (rod, "site1='tip' site2='end' solref='0.1 -1'", &["rod", "solref"]),
        ("<equality>", "<equality><weld body1='hand' body2='right'/>", &["hand", "<equality><weld>", "connect, joint"]),
        ("<equality>", "<equality><tendon tendon1='t'/>", &["<equality><tendon>", "connect, joint"]),
        ("damping='1 2 3'", "damping='1 -2 3'", &["b", "damping", "-2"]),
        ("damping='0.2 0.3 0.4'", "damping='-0.2'", &["m", "damping", "-0.2"]),
        ("armature='0.01'", "armature='-0.01'", &["m", "armature", "-0.01"]),
        ("armature='0.01'", "delay='0.01'", &["m", "delay"]),
        ("<body name='hand'", "<body name='hand' gravcomp='1'", &["hand", "welded", "gravcomp"]),
        ("<freejoint/>", "<joint type='free' springdamper='1 1'/>", &["springdamper", "root"]),
        ("<freejoint/>", "<joint type='free' damping='1 2'/>", &["damping", "one number"]),
    ]);
    let idle = changed(ARMS, mimic, "joint1='b' joint2='a' polycoef='0 1 0.5' active='false'");
    assert!(Model::from_mjcf(&idle).expect("inactive equalities have no effect").couplings.is_empty());
    let by_class = changed(ARMS, "<site name='tip' pos='0 0 -0.3'/>", "<site name='tip'/>");
    let by_class = changed(&by_class, rod, "site1='tip' site2='end'");
    assert!(crate::support::problem(&by_class).contains("give the site its own `pos`"));
}

#[test]
fn a_loop_needs_a_mirror_image() {
    let mirror = |left: &str, right: &str| {
        let rod = |side: &str, at: &str| {
            format!("<connect name='{side}' body1='{side}_shank' body2='{side}_foot' anchor='{at}'/>")
        };
        let rods = format!("<equality>{}{}</equality></mujoco>", rod("left", left), rod("right", right));
        Mirror::of(&Model::without_motors(&changed(&upright(), "</mujoco>", &rods)).expect("valid"))
    };
    assert!(mirror("-0.05 0.02 -0.35", "-0.05 -0.02 -0.35").is_ok());
    let problem =
        mirror("-0.05 0.02 -0.35", "-0.05 0.02 -0.35").expect_err("both rods are on the left of their shanks");
    assert_eq!(problem, "the equality `left` has no mirror image");
}
