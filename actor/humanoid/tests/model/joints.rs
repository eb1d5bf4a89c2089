//! Joints, limited tendons, servos and keyframes, compared with MuJoCo's values.

use treadmill_humanoid::Model;
use treadmill_humanoid::model::Softness;

use crate::support::{Text, changed, problem};

/// Robot with damping ratios, an inherited range, and a free joint with friction.
pub const SERVOS: &str = r"
<mujoco>
  <compiler angle='radian'/>
  <default><position kp='40' dampratio='0.8'/><joint solimpfriction='0.8' margin='0.01'/></default>
  <worldbody>
    <geom type='plane' size='1 1 1'/>
    <body pos='0 0 1' euler='0.3 0.2 0.1'>
      <joint name='root' type='free' armature='0.2' damping='3' frictionloss='0.5'/>
      <geom type='box' size='0.1 0.2 0.3'/>
      <body pos='0.1 0 -0.3' euler='0 0.4 0'>
        <joint name='a' axis='0 1 0' range='-1 0.4' pos='0 0 0.1' frictionloss='0.3' solreffriction='0.05 0.5'/>
        <joint name='b' axis='1 0 0.5' armature='0.1' pos='0 0 0.1'/>
        <geom type='capsule' size='0.05 0.1' pos='0 0 -0.2'/>
        <body pos='0 0 -0.4'>
          <joint name='c' axis='0 1 0' range='-2 0.5' solreflimit='-100 -5' solimplimit='0.7 0.8' margin='0.1'/>
          <geom size='0.06' pos='0.02 0 0'/>
        </body>
      </body>
      <body pos='0 0.3 0'><joint name='d' axis='0 0 1'/><geom size='0.07' pos='0 0.1 0'/></body>
    </body>
  </worldbody>
  <tendon>
    <fixed name='sinew' range='-1 2' margin='0.2' solreflimit='0.03 2' solimplimit='0.8'>
      <joint joint='a' coef='2'/>
    </fixed>
    <fixed name='slack'><joint joint='c' coef='-1'/></fixed>
  </tendon>
  <actuator>
    <position name='p' joint='a' inheritrange='0.9'/>
    <position name='q' joint='b' gear='-3' ctrlrange='-1 1'/>
    <position name='r' joint='c' kv='1.5' gear='-2'/>
    <position name='s' joint='d' dampratio='1.2' kp='7' ctrlrange='-1 1'/>
  </actuator>
  <keyframe>
    <key name='stand' time='3' qpos='0.1 0.2 0.7 0 0 2 0 0.1 -0.2 0.3 -0.4' ctrl='1 2 3 4'/>
    <key qvel='1 2 3 4 5 6 7 8 9 10'/>
  </keyframe>
</mujoco>";

#[test]
fn joints_have_friction_margins_and_softness_of_their_own() {
    let model = Model::from_mjcf(SERVOS).expect("valid");
    let [a, b, c, _] = &model.hinges[..] else { panic!("four hinges") };
    let friction = [0.8, 0.95, 0.001, 0.5, 2.0];
    assert_eq!((a.friction_loss_nm, a.friction_softness.impedance), (0.3, friction));
    // 2 / (0.95 × 0.05).
    assert!((a.friction_softness.damping - 42.105_263_157_894_74).abs() < 1e-9);
    assert_eq!((a.limit_margin_rad, a.limit_softness), (0.01, Softness::default()));
    assert_eq!((b.friction_loss_nm, b.friction_softness.impedance), (0.0, friction));
    assert_eq!(c.limit_margin_rad, 0.1);
    assert_eq!(c.limit_softness.impedance, [0.7, 0.8, 0.001, 0.5, 2.0]);
    // 100 / 0.8² and 5 / 0.8.
    assert!((c.limit_softness.stiffness - 156.25).abs() < 1e-9 && (c.limit_softness.damping - 6.25).abs() < 1e-12);
    let root = &model.root;
    assert_eq!((root.damping, root.friction_loss, root.armature), (3.0, 0.5, 0.2));
    assert_eq!(root.friction_softness.impedance, friction);
}

#[test]
fn a_freejoint_element_has_no_defaults() {
    // As in MuJoCo 4.0, whose `dof_damping` of such a joint is 0.
    let class = "<joint solimpfriction='0.8' margin='0.01' damping='3' frictionloss='1'/>";
    let text = changed(SERVOS, "<joint solimpfriction='0.8' margin='0.01'/>", class);
    let free = "<joint name='root' type='free' armature='0.2' damping='3' frictionloss='0.5'/>";
    let model = Model::from_mjcf(&changed(&text, free, "<freejoint/>")).expect("valid");
    assert_eq!((model.root.damping, model.root.friction_loss, model.root.armature), (0.0, 0.0, 0.0));
    let model = Model::from_mjcf(&changed(&text, free, "<joint type='free'/>")).expect("valid");
    assert_eq!((model.root.damping, model.root.friction_loss, model.root.armature), (3.0, 1.0, 0.0));
    assert_eq!(model.hinges[3].damping_nmsprad, 3.0);
    let sprung = changed(SERVOS, "type='free'", "type='free' stiffness='1'");
    assert!(problem(&sprung).contains("stiffness of a free joint"));
}

#[test]
fn three_slides_and_a_ball_are_a_free_joint() {
    let root = "<body pos='0 0 1' euler='0.3 0.2 0.1'>";
    let free = "<joint name='root' type='free' armature='0.2' damping='3' frictionloss='0.5'/>";
    let text = changed(SERVOS, root, "<body pos='0.1 0 1'>");
    let slides: String = ["1 0 0", "0 1 0", "0 0 1"]
        .iter()
        .map(|axis| format!("<joint type='slide' axis='{axis}' margin='0'/>"))
        .collect();
    let model =
        Model::from_mjcf(&changed(&text, free, &format!("{slides}<joint type='ball' margin='0'/>"))).expect("valid");
    assert_eq!(model.root, treadmill_humanoid::model::RootJoint::default());
    // Keyframes count from the pose of the text; those of the second one are left out.
    for (key, wanted) in model.keyframes.iter().zip([[0.2, 0.2, 1.7], [0.1, 0.0, 1.0]]) {
        assert!(
            key.position[..3].iter().zip(wanted).all(|(one, other)| (one - other).abs() < 1e-12),
            "{:?}",
            key.position
        );
    }
    assert!(model.simplifications.iter().any(|note| note.contains("count as a free joint")));
    let sprung = format!("{slides}<joint type='ball' margin='0' damping='1'/>");
    assert!(problem(&changed(&text, free, &sprung)).contains("<freejoint/>"));
}

#[test]
fn degrees_do_not_apply_to_margins_and_tendons() {
    let model = Model::from_mjcf(&changed(SERVOS, "angle='radian'", "angle='degree'")).expect("valid");
    // MuJoCo 4.0's `jnt_margin` and `tendon_range`.
    assert!((model.hinges[2].min_rad + 2f64.to_radians()).abs() < 1e-12);
    assert_eq!(model.hinges[2].limit_margin_rad, 0.1);
    assert_eq!(model.tendons[0].range, Some([-1.0, 2.0]));
}

#[test]
fn tendons_may_have_limits() {
    let model = Model::from_mjcf(SERVOS).expect("valid");
    let [sinew, slack] = &model.tendons[..] else { panic!("two tendons") };
    assert_eq!((sinew.range, sinew.limit_margin), (Some([-1.0, 2.0]), 0.2));
    assert_eq!(sinew.limit_softness.impedance, [0.8, 0.95, 0.001, 0.5, 2.0]);
    // 2 / (0.95 × 0.03).
    assert!((sinew.limit_softness.damping - 70.175_438_596_491_23).abs() < 1e-9);
    assert_eq!((slack.range, slack.limit_softness), (None, Softness::default()));
    let free = Model::from_mjcf(&changed(SERVOS, "range='-1 2'", "range='-1 2' limited='false'")).expect("valid");
    assert_eq!(free.tendons[0].range, None);
    let by_class = changed(SERVOS, "<default>", "<default><tendon range='-3 3' margin='0.3'/>");
    let model = Model::from_mjcf(&by_class).expect("valid");
    assert_eq!(
        model.tendons.iter().map(|tendon| tendon.range).collect::<Vec<_>>(),
        [Some([-1.0, 2.0]), Some([-3.0, 3.0])]
    );
    let manual = changed(SERVOS, "angle='radian'", "angle='radian' autolimits='false'");
    let manual = manual.replace("range='-1 0.4'", "").replace("range='-2 0.5'", "");
    assert!(problem(&manual).contains("sinew") && problem(&manual).contains("autolimits"));
}

#[test]
fn damping_ratios_refer_to_mujocos_effective_inertia() {
    let model = Model::from_mjcf(SERVOS).expect("valid");
    // MuJoCo 4.0's `actuator_biasprm`.
    let damping = [-5.486_056_586_387_164, -1.993_619_194_978_904, -1.5, -0.750_928_961_113_683];
    for (motor, damping) in model.motors.iter().zip(damping) {
        assert!((motor.bias[2] / damping - 1.0).abs() < 2e-6, "{}: {:?}", motor.name, motor.bias);
    }
    assert_eq!(model.motors.iter().map(|motor| motor.gain).collect::<Vec<_>>(), [40.0, 40.0, 40.0, 7.0]);
    // A positive damping of a general actuator is a ratio too.
    let general = "<general name='s' gainprm='7' biastype='affine' biasprm='0 -7 1.2' joint='d'";
    let text = changed(SERVOS, "<position kp='40' dampratio='0.8'/>", "");
    let text = changed(&text, "<position name='s' joint='d' dampratio='1.2' kp='7'", general);
    let model = Model::from_mjcf(&text).expect("valid");
    assert!((model.motors[3].bias[2] / damping[3] - 1.0).abs() < 2e-6);
}

#[test]
fn position_servos_take_their_joints_range() {
    let model = Model::from_mjcf(SERVOS).expect("valid");
    // MuJoCo 4.0's `actuator_ctrlrange`: 0.9 times the half of [-1, 0.4] on both sides of its middle.
    let inherited = model.motors[0].control;
    assert!((inherited[0] + 0.93).abs() < 1e-12 && (inherited[1] - 0.33).abs() < 1e-12, "{inherited:?}");
    // Without any range: the targets for the hinge's range of [-2, 0.5] under a gear of -2.
    assert_eq!(model.motors[2].control, [-1.0, 4.0]);
    // The setting nearest to the element counts, as in MuJoCo.
    let by_class = changed(SERVOS, "dampratio='0.8'", "dampratio='0.8' inheritrange='0.5'");
    let by_class = changed(&by_class, "axis='1 0 0.5'", "axis='1 0 0.5' range='0 1'");
    let model = Model::from_mjcf(&by_class).expect("valid");
    assert_eq!(model.motors[1].control, [-1.0, 1.0]);
    assert_eq!(model.motors[2].control, [-1.375, -0.125]);
    let unlimited = changed(SERVOS, "joint='d' dampratio='1.2' kp='7' ctrlrange='-1 1'", "joint='d'");
    assert!(problem(&unlimited).contains("`s`") && problem(&unlimited).contains("ctrlrange"));
}

#[test]
fn keyframes_are_states_with_controls() {
    let model = Model::from_mjcf(SERVOS).expect("valid");
    let [stand, other] = &model.keyframes[..] else { panic!("two keyframes") };
    assert_eq!(stand.name, "stand");
    // MuJoCo 4.0 normalises the quaternion too.
    assert_eq!(stand.position, [0.1, 0.2, 0.7, 0.0, 0.0, 1.0, 0.0, 0.1, -0.2, 0.3, -0.4]);
    assert_eq!((stand.velocity.clone(), &stand.controls[..]), (vec![0.0; 10], &[1.0, 2.0, 3.0, 4.0][..]));
    assert_eq!(other.position, model.nominal_position());
    assert_eq!((other.velocity[9], &other.controls[..]), (10.0, &[0.0; 4][..]));
    // A list that ends early leaves the rest as it is.
    let short = Model::from_mjcf(&changed(SERVOS, "qvel='1 ", "qvel='7'/><key qvel='1 ")).expect("valid");
    assert_eq!(short.keyframes[1].velocity, [&[7.0][..], &[0.0; 9]].concat());
    Text(SERVOS).assert_refused(&[
        ("qpos='0.1 ", "qpos='0 0.1 ", &["stand", "`qpos` has 12 numbers", "has 11"]),
        ("qpos='0.1 ", "qpos='nan ", &["stand", "qpos", "finite"]),
        ("0 0 2 0 0.1", "0 0 0 0 0.1", &["stand", "quaternion", "zero"]),
        ("qvel='1 ", "qvel='0 1 ", &["key 2", "`qvel` has 11 numbers", "has 10"]),
        ("ctrl='1 ", "ctrl='0 1 ", &["stand", "`ctrl` has 5 numbers", "has 4"]),
        ("<key qvel", "<key name='stand' qvel", &["stand", "two elements <key>"]),
        ("<key qvel", "<key act='1' qvel", &["key 2", "act", "not supported"]),
        ("<key qvel", "<lock/><key qvel", &["keyframe", "<lock>", "not supported"]),
    ]);
}
