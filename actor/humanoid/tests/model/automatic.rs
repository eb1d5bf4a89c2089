//! Cards that are found from a model alone.

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use treadmill_humanoid::card::{BodySize, Proposal, RobotCard};
use treadmill_humanoid::{EnvTask, EnvironmentConfig, HomePose, Mirror, Model, Physics, PhysicsSettings, TaskRegistry};

use crate::support::changed;

/// Leg of six hinges; SIGN is 1 on the left, `-` and 1 on the right.
const LEG: &str = r"
  <body name='SIDE_hip_yaw' pos='0 SIGN0.1 -0.1'><joint name='SIDE_hip_yaw' axis='0 0 1' range='-1 1'/>
    <geom type='sphere' size='0.04' mass='0.5' contype='0' conaffinity='0'/>
    <body name='SIDE_hip_roll'><joint name='SIDE_hip_roll' axis='1 0 0' range='-0.5 0.5'/>
      <geom type='sphere' size='0.04' mass='0.5' contype='0' conaffinity='0'/>
      <body name='SIDE_thigh'><joint name='SIDE_hip_pitch' axis='0 1 0' range='-1.5 1.5'/>
        <geom type='capsule' fromto='0 0 -0.05 0 0 -0.3' size='0.05' mass='3'/>
        <body name='SIDE_shank' pos='0 0 -0.35'><joint name='SIDE_knee' axis='0 1 0' range='0 2.2'/>
          <geom type='capsule' fromto='0 0 -0.05 0 0 -0.28' size='0.04' mass='2'/>
          <body name='SIDE_ankle' pos='0 0 -0.35'><joint name='SIDE_ankle_pitch' axis='0 1 0' range='-0.9 0.9'/>
            <geom type='sphere' size='0.02' mass='0.2' contype='0' conaffinity='0'/>
            <body name='SIDE_foot'><joint name='SIDE_ankle_roll' axis='1 0 0' range='-0.4 0.4'/>
              <geom type='box' size='0.11 0.04 0.02' pos='0.03 0 -0.04' mass='0.8'/></body></body></body></body></body></body>";
/// Arm of one hinge.
const ARM: &str = r"
  <body name='SIDE_arm' pos='0 SIGN0.22 0.3'><joint name='SIDE_shoulder' axis='0 1 0' range='-2 2'/>
    <geom type='capsule' fromto='0 0 -0.06 0 0 -0.4' size='0.03' mass='1.5'/></body>";

/// Returns the text of a biped whose base stands at this pose, with its parts turned back by `back`.
fn biped(pose: &str, back: &str, actuators: &str) -> String {
    let sides = |part: &str| {
        let side = |name: &str, sign: &str| part.replace("SIDE", name).replace("SIGN", sign);
        side("left", "") + &side("right", "-")
    };
    format!(
        r"<mujoco><compiler angle='radian'/><worldbody><geom type='plane' size='5 5 .1'/>
        <body name='pelvis' {pose}><freejoint/><frame quat='{back}'>
        <geom type='box' size='0.09 0.14 0.08' mass='9'/><geom type='box' size='0.09 0.15 0.15' pos='0 0 0.25' mass='9'/>
        {}{}</frame></body></worldbody>{actuators}</mujoco>",
        sides(LEG),
        sides(ARM)
    )
}

pub fn upright() -> String {
    biped("pos='0 0 1'", "1 0 0 0", "")
}

fn found(text: &str) -> (Model, Proposal) {
    let mut model = Model::without_motors(text).expect("valid");
    let proposal = Proposal::of(&model).expect("it can be simulated");
    assert_eq!(proposal.missing, Vec::<String>::new());
    RobotCard::parse(&proposal.card).expect("valid").apply(&mut model).expect("it fits");
    (model, proposal)
}

/// Returns the simulation of a model in its default pose.
fn at_home(model: &Model) -> Physics {
    let mut physics = Physics::new(model.clone(), PhysicsSettings::default()).expect("valid");
    let robot = model.robot.as_ref().expect("it has a card");
    physics.set_state(&robot.default_position, &vec![0.0; model.velocity_size()]);
    physics
}

fn link_pose(physics: &Physics, name: &str) -> Isometry3<f64> {
    let link = physics.model().links.iter().find(|link| link.name == name).expect("a link");
    physics.body_motion(link.body).pose * link.pose
}

/// Returns the default angle of a hinge.
fn home_rad(model: &Model, name: &str) -> f64 {
    let hinge = model.hinges.iter().position(|hinge| hinge.name == name).expect("a hinge");
    model.robot.as_ref().expect("it has a card").default_position[7 + hinge]
}

#[test]
fn a_walker_stands_on_bent_knees_with_flat_feet_below_its_centre_of_mass() {
    let (model, proposal) = found(&upright());
    let physics = at_home(&model);
    let feet = model.robot.as_ref().expect("it has a card").feet.clone();
    let feet: Vec<&str> = feet.iter().map(|foot| model.links[*foot].name.as_str()).collect();
    assert_eq!(feet, ["left_foot", "right_foot"]);
    for side in ["left", "right"] {
        let knee_rad = home_rad(&model, &format!("{side}_knee"));
        // 4 % of two segments of 0.35 m: cos(knee ÷ 2) = 0.96, with the foot 4 cm higher than a straight leg's.
        assert!((knee_rad - 2.0 * 0.96_f64.acos()).abs() < 0.03, "{knee_rad}");
        let foot = link_pose(&physics, &format!("{side}_foot"));
        assert!(foot.rotation.angle() < 0.02, "{side}: {}", foot.rotation.angle());
        // The lower side of the sole is 6 cm below the frame.
        assert!((foot.translation.z - 0.06).abs() < 2e-3, "{}", foot.translation.z);
    }
    // The middle of a sole is 3 cm before its ankle.
    let middle_m = link_pose(&physics, "left_foot").translation.x + 0.03;
    assert!((physics.centre_of_mass().x - middle_m).abs() < 5e-3, "{} {middle_m}", physics.centre_of_mass().x);
    // The policy moves the legs alone.
    let moved: Vec<&str> = model.motors.iter().map(|motor| motor.name.as_str()).collect();
    assert_eq!(moved.len(), 12);
    assert!(moved.iter().all(|name| !name.contains("shoulder")), "{moved:?}");
    assert!(proposal.card.contains("held = true") && proposal.card.contains("guess: "), "{}", proposal.card);
    assert!(Mirror::of(&model).is_ok());
}

#[test]
fn servos_follow_from_weight_and_leg_length() {
    let (model, _) = found(&upright());
    let size = BodySize::of(&model).expect("it stands");
    // 18 + 2 × (7 + 1.5) kg.
    assert!((size.weight_n - 35.0 * 9.81).abs() < 1e-6, "{}", size.weight_n);
    // Straight legs of 0.7 m and a sole 6 cm below the ankle, bent by 4 % of the segments.
    assert!((size.leg_length_m - (0.76 - 0.028)).abs() < 2e-3, "{}", size.leg_length_m);
    let carried_nm = size.weight_n * size.leg_length_m;
    let robot = model.robot.as_ref().expect("it has a card");
    let of = |name: &str| {
        let hinge = model.hinges.iter().position(|hinge| hinge.name == name).expect("a hinge");
        (robot.hinges[hinge].clone(), model.hinges[hinge].armature_kgm2)
    };
    for (name, stiffness, torque) in [
        ("left_hip_roll", 0.4, 0.5),
        ("left_hip_pitch", 0.4, 0.5),
        ("right_knee", 0.45, 0.65),
        ("right_ankle_roll", 0.15, 0.25),
    ] {
        let (control, armature_kgm2) = of(name);
        let near =
            |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 1e-4, "{name}: {found}, not {wanted}");
        near(control.kp, stiffness * carried_nm);
        near(control.kd, 0.04 * (size.leg_length_m / 0.7).sqrt() * control.kp);
        near(control.effort_nm, torque * carried_nm);
        near(armature_kgm2, 1.2e-4 * control.effort_nm);
        assert_eq!((control.action_scale_rad, control.is_held), (0.3, false));
    }
    // A heavy rotor: 3 Hz at a leg of 0.7 m, whose times grow with the root of its length.
    let (heavy, _) = found(&upright().replace("range='0 2.2'", "range='0 2.2' armature='0.5'"));
    let knee = heavy.hinges.iter().position(|hinge| hinge.name == "left_knee").expect("a hinge");
    let kp = heavy.robot.as_ref().expect("it has a card").hinges[knee].kp;
    let wanted = 0.5 * (2.0 * std::f64::consts::PI * 3.0).powi(2) * 0.7 / size.leg_length_m;
    assert!((kp / wanted - 1.0).abs() < 1e-4, "{kp}, not {wanted}");
    // An arm of 1.5 kg, 0.34 m and caps of 3 cm, about its shoulder: kp = J (2π 4 Hz)².
    let (arm, _) = of("left_shoulder");
    let inertia_kgm2 = arm.kp / (2.0 * std::f64::consts::PI * 4.0_f64).powi(2);
    assert!((0.08..0.12).contains(&inertia_kgm2) && arm.is_held, "{inertia_kgm2}");
}

#[test]
fn a_file_s_own_servo_stays_if_it_suits_the_robot() {
    let servo = |kp: &str, kv: &str| format!("<position joint='left_knee' kp='{kp}' kv='{kv}' forcerange='-90 90'/>");
    let with = |servo: &str| found(&biped("pos='0 0 1'", "1 0 0 0", &format!("<actuator>{servo}</actuator>")));
    let knee = |model: &Model| {
        let hinge = model.hinges.iter().position(|hinge| hinge.name == "left_knee").expect("a hinge");
        model.robot.as_ref().expect("it has a card").hinges[hinge].clone()
    };
    // The rule wants about 113 N·m/rad.
    let (kept, _) = with(&servo("150", "5"));
    assert_eq!((knee(&kept).kp, knee(&kept).kd, knee(&kept).effort_nm), (150.0, 5.0, 90.0));
    for (kp, kv, what) in [("1", "0.1", "too soft"), ("900", "9", "too stiff"), ("150", "0", "without damping")] {
        let (other, proposal) = with(&servo(kp, kv));
        assert!((knee(&other).kp / 113.0 - 1.0).abs() < 0.02 && knee(&other).kd > 3.0, "{what}: {:?}", knee(&other));
        assert!(proposal.card.contains(&format!("instead of the file's {kp}")), "{what}: {}", proposal.card);
    }
    // A limit that no motor reaches.
    let (_, proposal) = with("<motor joint='left_knee' gear='50000'/>");
    assert!(proposal.card.contains("the file's 50000.0 is no limit"), "{}", proposal.card);
}

#[test]
fn knees_that_bend_only_backwards_do_so() {
    let (model, _) = found(&upright().replace("range='0 2.2'", "range='-2.2 0'"));
    assert!(home_rad(&model, "left_knee") < -0.3 && home_rad(&model, "right_knee") < -0.3);
    assert!(link_pose(&at_home(&model), "left_foot").rotation.angle() < 0.02);
}

#[test]
fn the_keyframe_that_stands_on_bent_knees_is_the_default_pose() {
    let leg = |pitch: &str, knee: &str, ankle: &str| format!("0 0 {pitch} {knee} {ankle} 0");
    let key = |name: &str, height: &str, leg: &str| {
        // Hinges of both legs, then of both arms.
        format!("<key name='{name}' qpos='0 0 {height} 1 0 0 0 {leg} {leg} 0.4 0.4'/>")
    };
    let keys = key("straight", "0.86", &leg("0", "0", "0")) + &key("crouch", "0.8", &leg("-0.4", "0.8", "-0.4"));
    let text = upright().replace("</mujoco>", &format!("<keyframe>{keys}</keyframe></mujoco>"));
    let (model, proposal) = found(&text);
    assert!(
        (home_rad(&model, "left_knee") - 0.8).abs() < 1e-5 && (home_rad(&model, "left_shoulder") - 0.4).abs() < 1e-5
    );
    assert!(proposal.card.contains("keyframe `crouch`, whose knees are bent"), "{}", proposal.card);
    // The legs of a straight one are bent, and its arms stay.
    let text = upright().replace(
        "</mujoco>",
        &format!("<keyframe>{}</keyframe></mujoco>", key("straight", "0.86", &leg("0", "0", "0"))),
    );
    let (model, _) = found(&text);
    assert!(home_rad(&model, "left_knee") > 0.4 && (home_rad(&model, "left_shoulder") - 0.4).abs() < 1e-5);
}

#[test]
fn a_base_that_faces_another_way_is_turned_and_nothing_else_moves() {
    for (pose, back, forward) in [
        ("pos='0 0 1' quat='0 0 0 1'", "0 0 0 -1", "-x"),
        ("pos='0 0 1' quat='0.70710678 0 0 0.70710678'", "0.70710678 0 0 -0.70710678", "-y"),
        ("pos='0 0 1' quat='0.70710678 0 0 -0.70710678'", "0.70710678 0 0 0.70710678", "+y"),
    ] {
        let text = biped(pose, back, "");
        let (model, proposal) = found(&text);
        assert!(proposal.card.contains(&format!("forward = \"{forward}\"")), "{}", proposal.card);
        // The robot is the same as one whose base faces forward.
        let (straight, _) = found(&upright());
        let (turned, plain) = (at_home(&model), at_home(&straight));
        for name in ["left_foot", "right_arm", "pelvis"] {
            let (one, other) = (link_pose(&turned, name), link_pose(&plain, name));
            assert!((one.translation.vector - other.translation.vector).norm() < 1e-4, "{name} {forward}");
            assert!(one.rotation.angle_to(&other.rotation) < 1e-3, "{name} {forward}");
        }
        assert!((turned.centre_of_mass() - plain.centre_of_mass()).norm() < 1e-4);
        let inertia = |model: &Model| model.bodies[0].inertia_kgm2;
        assert!((inertia(&model) - inertia(&straight)).norm() < 1e-6, "{forward}");
        // In the file's own frame, the base has the file's orientation.
        let file = Model::without_motors(&text).expect("valid");
        let in_file = |position: &[f64]| {
            UnitQuaternion::from_quaternion(Quaternion::new(position[3], position[4], position[5], position[6]))
        };
        let turn = model.robot.as_ref().expect("it has a card").forward.turn();
        let of_card = in_file(&model.robot.as_ref().expect("it has a card").default_position);
        assert!((of_card * turn.inverse()).angle_to(&in_file(&file.nominal_position())) < 1e-6);
    }
}

#[test]
fn only_legs_touch_each_other_and_not_where_their_shapes_overlap_at_home() {
    // Thighs so thick that they reach into each other.
    let text = upright().replace("fromto='0 0 -0.05 0 0 -0.3' size='0.05'", "fromto='0 0 -0.05 0 0 -0.3' size='0.11'");
    let (model, proposal) = found(&text);
    assert!(proposal.card.contains("exclude = ["), "{}", proposal.card);
    let excluded = &model.robot.as_ref().expect("it has a card").excluded;
    let names: Vec<[&str; 2]> = excluded.iter().map(|pair| pair.map(|link| model.links[link].name.as_str())).collect();
    for pair in [["left_thigh", "right_thigh"], ["left_thigh", "left_arm"], ["pelvis", "right_foot"]] {
        assert!(names.contains(&pair), "{pair:?} in {names:?}");
    }
    let between = model.pairs.iter().filter_map(|pair| {
        let links = pair.second.map(|second| [pair.first, second].map(|of| model.link_of_shape(of.body, of.shape)));
        links.map(|links| links.map(|link| model.links[link.expect("a link")].name.as_str()))
    });
    let mut between: Vec<_> = between.collect();
    between.sort_unstable();
    // The thigh, shank and foot of one leg with those of the other, but the two thighs.
    assert_eq!(between.len(), 8, "{between:?}");
    assert!(between.iter().all(|[one, other]| one.starts_with("left") && other.starts_with("right")), "{between:?}");
    assert!(!between.contains(&["left_thigh", "right_thigh"]));
    let unknown = RobotCard::parse("exclude = [['pelvis', 'left_wing']]").expect("valid");
    let why = unknown.apply(&mut Model::without_motors(&text).expect("valid")).expect_err("no such body").to_string();
    assert!(why.contains("`exclude`") && why.contains("left_wing"), "{why}");
}

#[test]
fn what_is_no_biped_says_which_key_is_missing() {
    let one_leg = upright()
        .replace("<body name='right_hip_yaw' pos='0 -0.1 -0.1'>", "<body name='right_hip_yaw' pos='0 -0.1 0.5'>");
    let model = Model::without_motors(&one_leg).expect("valid");
    let proposal = Proposal::of(&model).expect("it can be simulated");
    assert!(proposal.missing[0].contains("`feet` of the card"), "{:?}", proposal.missing);
    assert!(proposal.card.contains("# feet = [\"left_foot\", \"right_foot\"]  # not found"), "{}", proposal.card);
}

#[test]
fn sides_without_names_match_by_their_places() {
    // As in Berkeley Humanoid, LL and LR are the left and the right leg.
    let text = upright().replace("left_", "ll_").replace("right_", "lr_");
    let (model, _) = found(&text);
    let mirror = Mirror::of(&model).expect("it is symmetric");
    let hinge = |name: &str| model.hinges.iter().position(|hinge| hinge.name == name).expect("a hinge");
    // Rolls and yaws change their sign in the mirror, pitches do not.
    for (name, other, sign) in
        [("ll_knee", "lr_knee", 1.0), ("lr_hip_roll", "ll_hip_roll", -1.0), ("ll_hip_yaw", "lr_hip_yaw", -1.0)]
    {
        assert_eq!(mirror.position[7 + hinge(name)], (7 + hinge(other), sign), "{name}");
    }
    assert!(mirror.apart_m < 1e-9);
    let near = changed(&text, "pos='0 -0.1 -0.1'", "pos='0 -0.104 -0.1'");
    let (model, _) = found(&near);
    assert!((Mirror::of(&model).expect("nearly symmetric").apart_m - 0.004).abs() < 1e-9);
}

/// A point of the turned base is where it was.
#[test]
fn shapes_of_a_turned_base_stay_where_they_were() {
    let text = biped("pos='0 0 1' quat='0 0 0 1'", "0 0 0 -1", "");
    let file = Model::without_motors(&text).expect("valid");
    let mut turned = file.clone();
    turned.turn_base(treadmill_humanoid::model::BaseAxis::MinusX);
    let place = |model: &Model, shape: usize| {
        let position = model.nominal_position();
        let rotation =
            UnitQuaternion::from_quaternion(Quaternion::new(position[3], position[4], position[5], position[6]));
        let base =
            Isometry3::from_parts(Translation3::from(Vector3::new(position[0], position[1], position[2])), rotation);
        base * model.bodies[0].shapes[shape].geometry.centre_m()
    };
    for shape in 0..file.bodies[0].shapes.len() {
        let (before, after): (Point3<f64>, Point3<f64>) = (place(&file, shape), place(&turned, shape));
        assert!((before - after).norm() < 1e-12);
    }
}

#[test]
fn a_robot_that_looks_along_y_stands_above_its_feet_too() {
    // The root's frame is the world's, and all parts are turned to the left by 90°.
    let (model, proposal) = found(&biped("pos='0 0 1'", "0.70710678 0 0 0.70710678", ""));
    assert!(proposal.card.contains("forward = \"+y\""), "{}", proposal.card);
    let physics = at_home(&model);
    let middle_m = link_pose(&physics, "left_foot") * Point3::new(0.03, 0.0, 0.0);
    assert!((physics.centre_of_mass().y - middle_m.y).abs() < 5e-3, "{} {middle_m}", physics.centre_of_mass());
    assert!((home_rad(&model, "left_knee") - 2.0 * 0.96_f64.acos()).abs() < 0.03);
}

#[test]
fn legs_without_ankles_bend_too() {
    let ankles = [
        "<joint name='SIDE_ankle_pitch' axis='0 1 0' range='-0.9 0.9'/>",
        "<joint name='SIDE_ankle_roll' axis='1 0 0' range='-0.4 0.4'/>",
    ];
    let stilts = ankles.iter().fold(upright(), |text, ankle| {
        ["left", "right"].iter().fold(text, |text, side| changed(&text, &ankle.replace("SIDE", side), ""))
    });
    let (model, proposal) = found(&stilts);
    assert!(home_rad(&model, "left_knee") > 0.3, "{}", proposal.card);
    assert!(proposal.card.contains("by inverse kinematics"), "{}", proposal.card);
}

#[test]
fn a_keyframe_that_lies_does_not_hide_a_pose_that_stands() {
    let lying = "<keyframe><key name='lying' qpos='0 0 0.2 0.70710678 0 0.70710678 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0'/></keyframe></mujoco>";
    let (_, proposal) = found(&changed(&upright(), "</mujoco>", lying));
    assert!(!proposal.card.contains("keyframe = "), "{}", proposal.card);
}

#[test]
fn a_base_at_the_soles_and_four_legs_are_asked_about() {
    let missing =
        |text: &str| Proposal::of(&Model::without_motors(text).expect("valid")).expect("valid").missing.join("; ");
    // Hips, pelvis and arms 0.86 m above the frame of the root.
    let at_soles = changed(&upright(), "<frame quat='1 0 0 0'>", "<frame pos='0 0 0.86'>");
    assert!(missing(&at_soles).contains("base `pelvis` is at or below the ground"), "{}", missing(&at_soles));
    let legs = |text: &str| {
        text.replace("SIGN", "").replace("pos='0 0.1 -0.1'", "pos='-0.4 0.1 -0.1'").replace("SIDE", "hind")
    };
    let four = changed(&upright(), "</frame>", &(legs(LEG) + "</frame>"));
    assert!(missing(&four).contains("`hind_foot` stands on the ground beside two feet"), "{}", missing(&four));
}

#[test]
fn servos_that_cannot_hold_the_robot_are_named_with_a_gain_that_can() {
    let (_, proposal) = found(&upright());
    let knee = proposal.card.split("[[hinges]]").find(|rule| rule.contains("*_knee")).expect("a rule").to_owned();
    let examined = |key: &str, value: &str| {
        let line = knee.lines().find(|line| line.starts_with(key)).expect("a line");
        let weak = proposal.card.replace(&knee, &knee.replace(line, &format!("{key} = {value}")));
        let text = treadmill_humanoid::mjcf::with_card(&upright(), &weak).expect("valid");
        let mut config = EnvironmentConfig::default();
        config.env.task = EnvTask::Velocity;
        HomePose::of(&config, &text, &TaskRegistry::default()).expect("valid").warnings.join("\n")
    };
    let good = examined("kp", "120.0");
    assert!(!good.contains("knee"), "{good}");
    let soft = examined("kp", "8.0");
    assert!(soft.contains("hinge `left_knee` sags by") && soft.contains("8.000 N·m/rad"), "{soft}");
    let feeble = examined("effort_nm", "2.0");
    assert!(feeble.contains("`right_knee` gives all of its effort of 2.000 N·m"), "{feeble}");
}

#[test]
fn hinges_that_follow_others_have_no_servo() {
    let mimic =
        "<equality><joint joint1='right_shoulder' joint2='left_shoulder' polycoef='0.2 -1'/></equality></mujoco>";
    let (model, proposal) = found(&changed(&upright(), "</mujoco>", mimic));
    assert!(proposal.card.contains("held = true  # follows `left_shoulder`"), "{}", proposal.card);
    let robot = model.robot.as_ref().expect("it has a card");
    let right = model.hinges.iter().position(|hinge| hinge.name == "right_shoulder").expect("a hinge");
    let control = &robot.hinges[right];
    assert_eq!((control.kp, control.kd, control.is_held), (0.0, 0.0, true));
    assert_eq!((model.hinges[right].stiffness_nmprad, model.hinges[right].damping_nmsprad), (0.0, 0.0));
    assert!((home_rad(&model, "right_shoulder") - (0.2 - home_rad(&model, "left_shoulder"))).abs() < 1e-6);
    let mut physics = at_home(&model);
    let controls: Vec<f32> = model.motors.iter().map(|motor| robot.default_position[7 + motor.hinge] as f32).collect();
    for _ in 0..40 {
        physics.step_only(&controls).expect("finite");
    }
    let sprung = changed(
        &upright(),
        "<joint name='right_shoulder'",
        "<joint name='right_shoulder' stiffness='7' springref='0.1'",
    );
    let (sprung, _) = found(&changed(&sprung, "</mujoco>", mimic));
    assert_eq!((sprung.hinges[right].stiffness_nmprad, sprung.hinges[right].rest_rad), (7.0, 0.1), "its spring stays");
    let [left, right] = ["left_shoulder", "right_shoulder"]
        .map(|name| physics.joint_angles()[model.hinges.iter().position(|hinge| hinge.name == name).expect("a hinge")]);
    assert!((right - (0.2 - left)).abs() < 0.01, "{left} {right}");
    // The mirror image is the same equality, but not if the ratio is another one.
    assert!(Mirror::of(&model).is_ok());
    let (lopsided, _) = found(&changed(&upright(), "</mujoco>", &mimic.replace("0.2 -1", "0.2 0.5")));
    let problem = Mirror::of(&lopsided).expect_err("one side follows the other");
    assert!(problem.contains("the equality `right_shoulder` has no mirror image"), "{problem}");
}
