//! Model texts that are refused, and the names in the refusals.

use nalgebra::{Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;
use treadmill_humanoid::{Environment, EnvironmentConfig, HUMANOID_XML, Model, Physics};

use crate::assets::ROCK;
use crate::contacts::TOUCH;
use crate::joints::SERVOS;
use crate::support::{Text, changed, problem};

/// Body with an arm above a floor; each test changes one place.
const ARM: &str = r"
<mujoco>
  <compiler angle='radian'/>
  <option timestep='0.002'/>
  <default><default class='limb'/></default>
  <worldbody>
    <geom name='floor' type='plane' size='1 1 1'/>
    <body name='base' pos='0 0 1.5'>
      <freejoint name='root'/>
      <geom name='trunk' type='sphere' size='0.2'/>
      <body name='upper' pos='0 0 -0.3' childclass='limb'>
        <joint name='shoulder' axis='0 1 0' range='-1 1'/>
        <geom name='humerus' type='capsule' fromto='0 0 0 0 0 -0.3' size='0.05'/>
        <body name='lower' pos='0 0 -0.4'>
          <joint name='elbow' axis='0 1 0'/>
          <inertial pos='0 0 -0.1' mass='0.5' diaginertia='0.01 0.01 0.001'/>
        </body>
      </body>
    </body>
  </worldbody>
  <tendon><fixed name='sinew'><joint joint='elbow' coef='2'/></fixed></tendon>
  <actuator><motor name='biceps' joint='elbow' gear='2' ctrlrange='-1 1'/></actuator>
</mujoco>";

#[test]
fn errors_in_the_built_in_text_name_the_element() {
    Text(HUMANOID_XML).assert_refused(&[
        ("<worldbody>", "<worldbody><include file=\"/etc/passwd\"/>", &["include"]),
        ("<joint name=\"root\" type=\"free\"", "<joint name=\"root\" type=\"ball\"", &["torso"]),
        ("range=\"-75 30\"", "range=\"30 -75\"", &["abdomen_y"]),
        ("size=\"0.09\"", "size=\"-0.09\"", &["head"]),
        ("size=\"0.09\"", "size=\"1e19\"", &["head"]),
        ("joint=\"left_elbow\" gear", "joint=\"left_wing\" gear", &["left_elbow"]),
        ("type=\"plane\"", "type=\"plane\" pos=\"0 0 1\"", &["floor"]),
        ("ctrlrange=\"-0.4 0.4\"", "ctrlrange=\"0.5 -0.4\"", &["abdomen_y"]),
        ("stiffness=\"20\"", "stiffness=\"-20\"", &["abdomen_z"]),
    ]);
}

#[test]
fn a_text_must_be_one_whole_mjcf_document() {
    assert!(problem("").contains("empty"));
    assert!(problem("solid steel").contains("not valid MJCF"));
    assert!(problem("<mujoco><worldbody>").contains("not valid MJCF"));
    assert!(problem("<robot name='r2'/>").contains("<mujoco>"));
    assert!(problem("<mujoco/>").contains("free joint"));
    assert!(problem(&format!("<mujoco>{}", " ".repeat(16 << 20))).contains("16777216"));
    assert!(problem(&"<body>".repeat(100_000)).contains("nested"));
    Text(ARM).assert_refused(&[
        ("<worldbody>", "<worldbody><include file='legs.xml'/>", &["include", "legs.xml", "pasted"]),
        ("</worldbody>", "</worldbody><include file='hands.xml'/>", &["include", "hands.xml"]),
        ("</worldbody>", "</worldbody><extension/>", &["<extension> is not supported"]),
        ("</worldbody>", "</worldbody><deformable/>", &["<deformable> is not supported"]),
    ]);
}

#[test]
fn the_tree_must_be_one_robot_on_a_floor() {
    let second = "<worldbody><body name='ball' pos='2 0 1'><freejoint/><geom size='0.1'/></body>";
    Text(ARM).assert_refused(&[
        ("<freejoint name='root'/>", "<joint name='root' axis='0 0 1'/>", &["base", "free joint"]),
        ("<freejoint name='root'/>", "", &["trunk", "`base`", "free joint"]),
        ("<freejoint name='root'/>", "<joint type='free'/><joint/>", &["base", "one free joint"]),
        ("<freejoint name='root'/>", "<joint name='root' type='free' damping='-1'/>", &["root", "damping", "is -1"]),
        ("<worldbody>", second, &["base", "only one root"]),
        ("<joint name='elbow' axis='0 1 0'/>", "<freejoint name='elbow'/>", &["elbow", "only the root"]),
        ("type='plane'", "type='plane' euler='0.1 0 0'", &["floor", "level"]),
        ("<worldbody>", "<worldbody><geom name='rug' type='plane' size='1 1 1'/>", &["floor", "only one"]),
        ("<worldbody>", "<worldbody><geom name='step' type='box' size='1 1 1'/>", &["step", "level plane"]),
        ("<worldbody>", "<worldbody><body name='cart' mocap='true'/>", &["cart", "mocap"]),
        ("name='lower'", "name='upper'", &["upper", "two"]),
        ("name='elbow' axis", "name='shoulder' axis", &["shoulder", "two"]),
        ("name='humerus'", "name='trunk'", &["trunk", "two"]),
    ]);
}

#[test]
fn bodies_hinges_and_shapes_are_bounded() {
    let with = |more: &str| changed(ARM, "<body name='upper'", &format!("{more}<body name='upper'"));
    let fingers = |count: usize| with(&"<body><joint/><geom size='0.1'/></body>".repeat(count));
    assert_eq!(Model::from_mjcf(&fingers(509)).expect("512 bodies").bodies.len(), 512);
    let message = problem(&fingers(510));
    assert!(message.contains("513 moving bodies") && message.contains("at most 512"), "{message}");
    let message = problem(&with(&format!("<body>{}<geom size='0.1'/></body>", "<joint/>".repeat(1023))));
    assert!(message.contains("1025 hinges") && message.contains("at most 1024"), "{message}");
    let message = problem(&with(&"<geom size='0.1'/>".repeat(4095)));
    assert!(message.contains("more than 4096 colliding shapes"), "{message}");
    // Two bodies of 400 shapes each.
    let shapes = "<geom size='0.1'/>".repeat(400);
    let message = problem(&with(&format!("<body><joint/>{shapes}</body><body><joint/>{shapes}</body>")));
    assert!(message.contains("more than 131072 pairs") && message.contains("contype"), "{message}");
}

#[test]
fn masses_and_sizes_must_be_physically_possible() {
    Text(ARM).assert_refused(&[
        ("mass='0.5'", "mass='-0.5'", &["lower", "mass", "-0.5"]),
        ("mass='0.5'", "mass='0'", &["lower", "needs mass"]),
        ("mass='0.5' ", "", &["inertial of lower", "mass"]),
        ("diaginertia='0.01 0.01 0.001'", "", &["inertial of lower", "diaginertia"]),
        ("diaginertia='0.01 0.01 0.001'", "diaginertia='0.01 0.01 0.1'", &["lower", "balanceinertia"]),
        ("diaginertia='0.01 0.01 0.001'", "diaginertia='0 0 0'", &["lower", "inertia"]),
        ("diaginertia='0.01 0.01 0.001'", "fullinertia='1 1 1 5 0 0'", &["lower", "principal inertia"]),
        ("type='sphere' size='0.2'", "type='sphere' size='0.2' mass='-1'", &["trunk", "mass", "-1"]),
        ("type='sphere' size='0.2'", "type='sphere' size='0.2' density='0'", &["base", "needs mass"]),
        ("size='0.2'", "size='nan'", &["trunk", "size", "nan", "finite"]),
        ("size='0.2'", "size='0.2' pos='0 inf 0'", &["trunk", "pos", "inf"]),
        ("size='0.2'", "size='0.2' pos='0 0'", &["trunk", "pos", "3 finite numbers"]),
        ("size='0.2'", "size='0.2' quat='0 0 0 0'", &["trunk", "quat"]),
        ("size='0.2'", "size='0'", &["trunk", "radius", "is 0"]),
        ("range='-1 1'", "range='1 -1'", &["shoulder", "range", "1 -1"]),
        ("range='-1 1'", "limited='true'", &["shoulder", "no `range`"]),
        ("angle='radian'", "autolimits='false'", &["shoulder", "limited"]),
        ("angle='radian'", "eulerseq='xyzw'", &["eulerseq", "xyzw"]),
        ("axis='0 1 0' range", "axis='0 0 0' range", &["shoulder", "axis"]),
    ]);
}

#[test]
fn what_mujoco_refuses_is_noted() {
    for (from, to, part) in [
        ("timestep='0.002'", "timestep='0.002' apirate='100'", "<option> has `apirate`"),
        ("timestep='0.002'", "timestep='0.002' collision='all'", "<option> has `collision`"),
        ("timestep='0.002'/>", "timestep='0.002'><flag sensornoise='enable'/></option>", "<flag> has `sensornoise`"),
        ("angle='radian'", "angle='radian' convexhull='true'", "<compiler> has `convexhull`"),
        ("ctrlrange='-1 1'", "ctrlrange='-1 1' actlimited='false'", "<motor> has `actlimited`"),
        ("class='limb'/>", "class='limb'><geom/><joint/><geom/></default>", "class `limb` has <geom> twice"),
    ] {
        let notes = Model::from_mjcf(&changed(ARM, from, to)).expect(to).simplifications;
        let is_noted = |note: &String| note.contains("MuJoCo 4.0 refuses this file") && note.contains(part);
        assert!(notes.iter().any(is_noted), "{to}: {notes:?}");
    }
    assert!(Model::from_mjcf(ARM).expect("valid").simplifications.is_empty());
}

#[test]
fn unsupported_physics_is_refused_by_name() {
    Text(ARM).assert_refused(&[
        ("axis='0 1 0' range", "type='slide' axis='0 1 0' range", &["shoulder", "slide"]),
        ("axis='0 1 0' range", "type='ball' range", &["shoulder", "ball"]),
        ("range='-1 1'", "range='-1 1' frictionloss='-0.1'", &["shoulder", "frictionloss", "-0.1"]),
        ("range='-1 1'", "range='-1 1' margin='-0.1'", &["shoulder", "margin", "-0.1"]),
        ("range='-1 1'/>", "range='-1 1' ref='0.1'/><joint name='twist' axis='1 0 0'/>", &["shoulder", "`ref`"]),
        ("range='-1 1'", "range='-1 1' solreflimit='0.01 -1'", &["shoulder", "solreflimit", "damping ratio"]),
        ("range='-1 1'", "range='-1 1' solimpfriction='1 2 3 4 5 6'", &["shoulder", "solimpfriction", "1 to 5"]),
        ("class='limb'/>", "class='limb'><joint frictionloss='-1'/></default>", &["shoulder", "frictionloss"]),
        ("class='limb'/>", "class='limb'><joint wings='1'/></default>", &["default limb", "wings"]),
        ("childclass='limb'", "childclass='wing'", &["upper", "wing"]),
        ("size='0.2'", "size='0.2' solref='-100'", &["trunk", "solref", "-100 1"]),
        ("size='0.2'", "size='0.2' solmix='-1'", &["trunk", "solmix"]),
        ("size='0.2'", "size='0.2' condim='5'", &["trunk", "condim", "1, 3, 4 or 6"]),
        ("size='0.2'", "size='0.2' priority='1.5'", &["trunk", "priority", "whole"]),
        ("size='0.2'", "size='0.2' margin='0.1'", &["trunk", "margin"]),
        ("size='0.2'", "size='0.2' margin='-0.001'", &["trunk", "margin", "-0.001"]),
        ("type='plane'", "type='plane' margin='0.011'", &["floor", "margin", "0.011", "0.01"]),
        ("size='0.2'", "size='0.2' fromto='0 0 0 0 0 1'", &["trunk", "fromto"]),
        ("type='sphere' size='0.2'", "type='mesh' mesh='skull'", &["trunk", "mesh `skull`", "its file"]),
        (
            "type='sphere' size='0.2'",
            "type='mesh' mesh='skull' contype='0' conaffinity='0'",
            &["trunk", "skull", "<inertial>"],
        ),
        ("type='sphere' size='0.2'", "type='hfield' hfield='hill'", &["trunk", "height field `hill`"]),
        ("timestep='0.002'", "wind='1 0 0'", &["option", "wind"]),
        ("timestep='0.002'", "density='1.2'", &["option", "density"]),
        ("timestep='0.002'/>", "timestep='0.002'><flag contact='disable'/></option>", &["flag", "contact"]),
        ("<body name='lower'", "<flexcomp/><body name='lower'", &["upper", "flexcomp"]),
        ("<tendon>", "<contact><exclude body1='base' body2='wing'/></contact><tendon>", &["exclude", "wing"]),
        ("<fixed name='sinew'>", "<fixed name='sinew' stiffness='5'>", &["sinew", "stiffness"]),
        ("<fixed name='sinew'>", "<fixed name='sinew' range='1 0'>", &["sinew", "range", "1 0"]),
        ("<fixed name='sinew'>", "<fixed name='sinew' limited='true'>", &["sinew", "limited", "range"]),
        ("<fixed name='sinew'>", "<fixed name='sinew' solreflimit='1 0'>", &["sinew", "solreflimit"]),
        ("<joint joint='elbow'", "<joint joint='knee'", &["sinew", "knee"]),
        ("<tendon>", "<tendon><spatial name='rope'/>", &["rope", "spatial"]),
    ]);
}

#[test]
fn motors_must_exist_and_have_a_strength() {
    Text(ARM).assert_refused(&[
        ("<motor name='biceps' joint='elbow' gear='2' ctrlrange='-1 1'/>", "", &["actuator", "at least one"]),
        ("joint='elbow' gear", "joint='knee' gear", &["biceps", "hinge"]),
        ("joint='elbow' gear", "joint='root' gear", &["biceps", "hinge"]),
        ("joint='elbow' gear", "tendon='sinew' gear", &["biceps", "tendon"]),
        ("ctrlrange='-1 1'", "ctrlrange='1 -1'", &["biceps", "ctrlrange", "1 -1"]),
        ("ctrlrange='-1 1'", "ctrllimited='true'", &["biceps", "ctrlrange"]),
        ("gear='2'", "gear='0'", &["biceps", "gear"]),
        ("<motor name", "<muscle name", &["biceps", "muscle"]),
        ("<motor name='biceps'", "<position dampratio='-1' name='biceps'", &["biceps", "dampratio", "-1"]),
        ("<motor name='biceps'", "<position dampratio='1' kv='2' name='biceps'", &["biceps", "either `kv`"]),
        ("<motor name='biceps'", "<position inheritrange='1' name='biceps'", &["biceps", "either `ctrlrange`"]),
        ("<motor name='biceps'", "<motor dampratio='1' name='biceps'", &["biceps", "dampratio"]),
        ("<motor name='biceps'", "<position kv='-1' name='biceps'", &["biceps", "damping", "-1"]),
        ("<motor name='biceps'", "<position kp='-5' name='biceps'", &["biceps", "stiffness", "-5"]),
        ("<motor name='biceps'", "<general dyntype='filter' name='biceps'", &["biceps", "dyntype"]),
        ("<default class='limb'/>", "<position kp='5'/>", &["limb"]),
    ]);
    let open_ended = changed(ARM, "<motor name='biceps'", "<position kp='5' name='biceps'");
    assert!(problem(&changed(&open_ended, "ctrlrange='-1 1'", "")).contains("range of its targets"));
    let inherited = changed(&open_ended, "ctrlrange='-1 1'", "inheritrange='0.9'");
    assert!(problem(&inherited).contains("`range` of its joint"));
}

#[test]
fn a_robot_without_a_floor_gets_one() {
    let bare = changed(ARM, "<geom name='floor' type='plane' size='1 1 1'/>", "");
    let (mut model, whole) = (Model::from_mjcf(&bare).expect("valid"), Model::from_mjcf(ARM).expect("valid"));
    assert!(matches!(&model.simplifications[..], [note] if note.contains("no floor")));
    model.simplifications.clear();
    assert_eq!(format!("{model:?}"), format!("{whole:?}"));
}

#[test]
fn visual_elements_are_accepted() {
    let dressed = [
        ("<tendon>", "<visual><map fogend='5'/></visual><statistic extent='2'/><size nkey='5'/><tendon>"),
        ("<tendon>", "<sensor><gyro site='imu'/></sensor><keyframe/><custom/><tendon>"),
        ("<tendon>", "<asset><texture builtin='flat'/><material name='m'/><mesh file='no.stl'/></asset><tendon>"),
        ("<worldbody>", "<worldbody><light/><camera name='c'/><site name='home'/>"),
        ("size='0.2'", "size='0.2' rgba='1 0 0 1' material='m' group='1' user='258'"),
        ("<inertial", "<geom type='mesh' mesh='no' contype='0' conaffinity='0'/><site name='imu'/><inertial"),
        ("<compiler", "<compiler meshdir='meshes'"),
    ];
    let plain = Model::from_mjcf(ARM).expect("valid");
    let text = dressed.iter().fold(ARM.to_owned(), |text, (from, to)| changed(&text, from, to));
    let dressed = Model::from_mjcf(&text).expect("only visual elements were added");
    assert_eq!(format!("{plain:?}"), format!("{dressed:?}"));
}

/// Returns the range of each attribute's value in a text.
fn values(text: &str) -> Vec<std::ops::Range<usize>> {
    let quote = if text == HUMANOID_XML { '"' } else { '\'' };
    let quotes: Vec<usize> = text.match_indices(quote).map(|(index, _)| index).collect();
    quotes.chunks_exact(2).map(|pair| pair[0] + 1..pair[1]).collect()
}

proptest! {
    #[test]
    fn a_corrupted_text_never_panics(
        place in any::<prop::sample::Index>(), value in r#"-?[0-9]{0,3}(\.[0-9]{1,9})?(e[0-9]{1,3})?|nan|inf|true|free|[ -~&&[^"'<]]{0,9}"#,
        cut in any::<prop::sample::Index>(), length in 0..60usize,
    ) {
        let config = EnvironmentConfig::default();
        for text in [ARM, HUMANOID_XML] {
            let all = values(text);
            let mut corrupted = text.to_owned();
            corrupted.replace_range(all[place.index(all.len())].clone(), &value);
            // An accepted model must also step.
            if let Ok(mut environment) = Environment::new(&config, &corrupted) {
                let mut observation = vec![0.0; environment.observation_size()];
                let action = vec![1.0; environment.action_size()];
                environment.reset(1, &mut observation);
                environment.step(&action, &mut observation);
            }
            let start = cut.index(text.len() - length);
            if text.is_char_boundary(start) && text.is_char_boundary(start + length) {
                let _ = Model::from_mjcf(&[&text[..start], &text[start + length..]].concat());
            }
        }
        for text in [TOUCH, SERVOS, ROCK] {
            let all = values(text);
            let mut corrupted = text.to_owned();
            corrupted.replace_range(all[place.index(all.len())].clone(), &value);
            if let Ok(model) = Model::from_mjcf(&corrupted) {
                let pairs = model.pairs.iter().map(|pair| pair.softness);
                let all = pairs.chain(model.hinges.iter().map(|hinge| hinge.limit_softness));
                prop_assert!(all.clone().all(|softness| softness.stiffness.is_finite() && softness.damping.is_finite()));
                prop_assert!(all.flat_map(|softness| softness.impedance[..2].to_vec()).all(|share| (0.0..=1.0).contains(&share)));
                prop_assert!(model.motors.iter().all(|motor| motor.bias.iter().all(|number| number.is_finite())));
            }
        }
    }
}

#[test]
fn tendons_that_exert_force_are_refused_by_name() {
    let fixed = "<fixed name=\"left_hipknee\">";
    Text(HUMANOID_XML).assert_refused(&[
        (fixed, "<fixed name='left_hipknee' stiffness='3'>", &["left_hipknee", "stiffness"]),
        (fixed, "<fixed name='left_hipknee' stiffness='0 0 1'>", &["left_hipknee", "stiffness"]),
        (fixed, "<fixed name='left_hipknee' stiffness='much'>", &["left_hipknee", "stiffness"]),
        (fixed, "<fixed name='left_hipknee' damping='0.1'>", &["left_hipknee", "damping"]),
        (fixed, "<fixed name='left_hipknee' frictionloss='1'>", &["left_hipknee", "frictionloss"]),
        (fixed, "<fixed name='left_hipknee' armature='1'>", &["left_hipknee", "armature"]),
        (fixed, "<fixed name='left_hipknee' range='-1'>", &["left_hipknee", "range"]),
        (fixed, "<fixed name='left_hipknee' limited='perhaps' range='-1 1'>", &["left_hipknee", "limited"]),
        ("joint=\"left_knee\" coef", "joint='left_wing' coef", &["left_hipknee", "left_wing"]),
        ("joint=\"left_knee\" coef=\"1\"", "joint='left_knee' coef='nan'", &["left_hipknee", "coef"]),
        ("<joint joint=\"left_knee\" coef", "<joint name='left_knee' coef", &["left_hipknee", "name"]),
        ("<tendon>", "<tendon><fixed name='slack'/>", &["slack", "at least one joint"]),
        ("<tendon>", "<tendon><spatial name='cable'><site site='a'/><site site='b'/></spatial>", &["cable", "spatial"]),
        ("<default>", "<default><tendon stiffness='2'/>", &["left_hipknee", "stiffness"]),
        ("<tendon>", "<equality><tendon tendon1='left_hipknee'/></equality><tendon>", &["tendon", "equality"]),
    ]);
    let crowd: String = (0..17).map(|_| "<fixed><joint joint=\"left_knee\"/></fixed>").collect();
    assert!(Model::from_mjcf(&changed(HUMANOID_XML, "<tendon>", &format!("<tendon>{crowd}"))).is_err());
}

#[test]
fn tendons_that_only_measure_are_accepted() {
    let harmless = "<fixed name=\"left_hipknee\" limited=\"false\" range=\"-1 1\" stiffness=\"0\" damping=\"0.0\">";
    let model = Model::from_mjcf(&changed(HUMANOID_XML, "<fixed name=\"left_hipknee\">", harmless)).expect("no force");
    let names: Vec<&str> = model.tendons.iter().map(|tendon| tendon.name.as_str()).collect();
    assert_eq!(names, ["left_hipknee", "right_hipknee"]);
    let hinge = |name: &str| model.hinges.iter().position(|hinge| hinge.name == name).expect("is a hinge");
    assert_eq!(model.tendons[0].terms, [(hinge("left_hip_y"), -1.0), (hinge("left_knee"), 1.0)]);
    assert_eq!(model.tendons[1].terms, [(hinge("right_hip_y"), -1.0), (hinge("right_knee"), 1.0)]);
    let mut angles = vec![0.0; 17];
    angles[hinge("left_hip_y")] = 0.25;
    angles[hinge("left_knee")] = -1.0;
    assert_eq!(model.tendons[0].sum_over(&angles), -1.25);
    assert_eq!(model.tendons[1].sum_over(&angles), 0.0);
}

#[test]
fn a_body_may_have_many_skew_hinges() {
    let axes = [[0.0, 1.0, 0.0], [0.0, 1.0, 0.5], [1.0, 0.0, 0.0], [0.3, 0.2, 1.0]];
    let more: String = axes[..3].iter().map(|[x, y, z]| format!("<joint axis='{x} {y} {z}'/>")).collect();
    let last = format!("{more}<joint name='elbow' axis='0.3 0.2 1'");
    let text = changed(ARM, "<joint name='elbow' axis='0 1 0'", &last);
    let mut physics =
        Physics::new(Model::from_mjcf(&text).expect("valid"), &EnvironmentConfig::default()).expect("valid");
    let angles = [0.3, -0.9, 0.5, 1.1];
    let mut position = physics.position().to_vec();
    position[8..].copy_from_slice(&angles);
    let velocity = vec![0.0; physics.velocity().len()];
    physics.set_state(&position, &velocity);
    // Each hinge turns the following ones: the product of all rotations, from the parent on.
    let turned = axes.iter().zip(angles).fold(UnitQuaternion::identity(), |turned, (axis, angle_rad)| {
        turned * UnitQuaternion::from_axis_angle(&Unit::new_normalize(Vector3::from(*axis)), angle_rad)
    });
    let [parent, child] = [1, 2].map(|body| physics.body_motion(body).pose.rotation);
    let found = parent.inverse() * child;
    assert!(found.angle_to(&turned) < 2e-7, "{found} instead of {turned}");
}
