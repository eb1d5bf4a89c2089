//! Robot cards: what they change in a model, drafts, and mistakes.

use treadmill_humanoid::card::{Proposal, RobotCard};
use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, Mirror, Model, ModelFiles};

use crate::support::changed;

/// Trunk with two legs of two hinges, of which only one has a servo.
const LEGS: &str = r"<mujoco><compiler angle='radian'/><worldbody>
  <body name='trunk' pos='0 0 1'><freejoint/><geom name='chest' type='box' size='0.1 0.2 0.2' mass='5'/>
    <body name='left_leg' pos='0 0.1 -0.2'><joint name='left_hip' axis='0 1 0' range='-1 1' actuatorfrcrange='-60 60'/>
      <joint name='left_knee' axis='0 1 0' pos='0 0 -0.4' range='0 2' armature='0.02'/>
      <geom name='left_sole' type='capsule' fromto='0 0 0 0 0 -0.7' size='0.05' mass='2'/></body>
    <body name='right_leg' pos='0 -0.1 -0.2'><joint name='right_hip' axis='0 1 0' range='-1 1' actuatorfrcrange='-60 60'/>
      <joint name='right_knee' axis='0 1 0' pos='0 0 -0.4' range='0 2' armature='0.02'/>
      <geom name='right_sole' type='capsule' fromto='0 0 0 0 0 -0.7' size='0.05' mass='2'/></body>
  </body></worldbody>
  <actuator><position name='servo' joint='left_hip' kp='30' kv='3' gear='2' forcerange='-10 10' ctrlrange='-1 1'/></actuator>
  <keyframe><key name='crouch' qpos='0 0 0.9 1 0 0 0 -0.3 0.6 -0.3 0.6' ctrl='0.1'/></keyframe></mujoco>";

const CARD: &str = r"
model = 'legs.xml'
base = 'trunk'
feet = ['left_leg', 'right_leg']
keyframe = 'crouch'
height_m = 0.95

[[hinges]]
names = '*'
kp = 80.0
kd = 4.0

[[hinges]]
names = '*_knee'
kp = 100.0
effort_nm = 90.0
armature_kgm2 = 0.01
action_scale_rad = 0.5

[[hinges]]
names = 'right_knee'
default_rad = 0.7
";

fn applied(text: &str, card: &str) -> Result<Model, String> {
    let mut model = Model::without_motors(text).expect("valid");
    let card = RobotCard::parse(card).map_err(|why| why.to_string())?;
    card.apply(&mut model).map_err(|why| why.to_string())?;
    Ok(model)
}

#[test]
fn a_card_gives_every_hinge_a_servo_and_the_robot_a_pose() {
    let model = applied(LEGS, CARD).expect("it fits");
    let names: Vec<&str> = model.motors.iter().map(|motor| motor.name.as_str()).collect();
    assert_eq!(names, ["left_hip", "left_knee", "right_hip", "right_knee"]);
    let motor = &model.motors[1];
    assert_eq!((motor.gain, motor.bias, motor.force, motor.gear_nm), (100.0, [0.0, -100.0, -4.0], [-90.0, 90.0], 1.0));
    // Four units of 0.5 rad about 0.6 rad.
    assert!((motor.control[0] + 1.4).abs() < 1e-12 && (motor.control[1] - 2.6).abs() < 1e-12, "{:?}", motor.control);
    // The smaller of the limits of the hinge, 60 N·m, and of the motor, 10 × 2.
    assert_eq!((model.motors[0].force, model.motors[2].force), ([-20.0, 20.0], [-60.0, 60.0]));
    assert_eq!(model.hinges.iter().map(|hinge| hinge.armature_kgm2).collect::<Vec<_>>(), [0.0, 0.01, 0.0, 0.01]);
    let robot = model.robot.as_ref().expect("a card was applied");
    assert_eq!(robot.default_position, [0.0, 0.0, 0.95, 1.0, 0.0, 0.0, 0.0, -0.3, 0.6, -0.3, 0.7]);
    assert_eq!(robot.feet, [1, 2]);
    let scales: Vec<f64> = robot.hinges.iter().map(|hinge| hinge.action_scale_rad).collect();
    assert_eq!(scales, [0.25 * 20.0 / 80.0, 0.5, 0.25 * 60.0 / 80.0, 0.5]);
}

#[test]
fn a_held_hinge_is_no_part_of_an_action_and_keeps_its_angle() {
    let card = changed(CARD, "default_rad = 0.7", "default_rad = 0.7\nheld = true\nkp = 4000.0\nkd = 100.0");
    let model = applied(LEGS, &card).expect("it fits");
    assert_eq!(model.motors.iter().map(|motor| motor.hinge).collect::<Vec<_>>(), [0, 1, 2]);
    let hinge = &model.hinges[3];
    assert_eq!((hinge.stiffness_nmprad, hinge.rest_rad, hinge.damping_nmsprad), (4000.0, 0.7, 100.0));
    let config = EnvironmentConfig::from(EnvConfig { healthy_z_range: [0.1, 5.0], ..EnvConfig::default() });
    let text = text_with(&card);
    let mut environment = Environment::new(&config, &text).expect("valid");
    assert_eq!(environment.action_size(), 3);
    let mut observation = vec![0.0; environment.observation_size()];
    environment.reset(1, &mut observation);
    for _ in 0..60 {
        environment.step(&[0.0; 3], &mut observation);
    }
    assert!((environment.physics().joint_angles()[3] - 0.7).abs() < 0.02);
}

/// Returns the text of a model file with a card, as `read_model_file` gives it.
fn text_with(card: &str) -> String {
    read(card).expect("readable")
}

fn read(card: &str) -> Result<String, String> {
    let unique = (std::process::id(), std::thread::current().id());
    let folder = std::env::temp_dir().join(format!("treadmill-cards-{unique:?}"));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("legs.xml"), LEGS).expect("a file");
    std::fs::write(folder.join("card.toml"), card).expect("a file");
    let text = treadmill_humanoid::read_model_file(&folder.join("card.toml"), &ModelFiles::default());
    std::fs::remove_dir_all(&folder).expect("it exists");
    text.map_err(|why| why.to_string())
}

#[test]
fn a_card_travels_in_the_text_of_its_model() {
    let from_text = Model::from_mjcf(&text_with(CARD)).expect("valid");
    assert_eq!(format!("{from_text:?}"), format!("{:?}", applied(LEGS, CARD).expect("it fits")));
    let alone = read(&changed(CARD, "model = 'legs.xml'", "")).expect_err("no file");
    assert!(alone.contains("`model`") && alone.contains("missing"), "{alone}");
    let itself = read(&changed(CARD, "legs.xml", "card.toml")).expect_err("no MJCF file");
    assert!(itself.contains("card.toml") && itself.contains("MJCF"), "{itself}");
    // Episodes start in the card's pose.
    let environment = Environment::new(&EnvironmentConfig::default(), &text_with(CARD)).expect("valid");
    assert_eq!(environment.nominal_position()[2], 0.95);
}

#[test]
fn a_draft_of_a_robot_without_legs_keeps_servos_and_proposes_others() {
    // One leg stands 0.1 m higher, so that the robot has no two feet.
    let uneven = changed(LEGS, "pos='0 -0.1 -0.2'", "pos='0 -0.1 -0.1'");
    let model = Model::from_mjcf(&uneven).expect("valid");
    let proposal = Proposal::of(&model).expect("it can be simulated");
    assert!(proposal.missing[0].contains("`feet` of the card"), "{:?}", proposal.missing);
    let text = proposal.draft("legs \"1\".xml");
    let card = RobotCard::parse(&text).expect("valid");
    assert_eq!((card.model.as_str(), card.keyframe.as_deref()), ("legs \"1\".xml", Some("crouch")));
    let names: Vec<&str> = card.rules.iter().map(|rule| rule.names.as_str()).collect();
    assert_eq!(names, ["left_hip", "*_knee", "right_hip"], "hinges with other numbers have rules of their own");
    // Stiffness and damping of a servo act through its gear twice.
    assert_eq!((card.rules[0].kp, card.rules[0].kd, card.rules[0].effort_nm), (Some(120.0), Some(12.0), Some(20.0)));
    // 10 Hz and twice the critical damping of 0.02 kg·m²: kp = J (2π 10)², kd = 4 J 2π 10.
    let (kp, kd) = (card.rules[1].kp.expect("a proposal"), card.rules[1].kd.expect("a proposal"));
    assert!((kp - 78.9568).abs() < 1e-3 && (kd - 5.026_55).abs() < 1e-4, "{kp} {kd}");
    assert_eq!(card.rules[1].effort_nm, None, "the model has no limit, which the draft says in a comment");
    assert!(text.contains("# effort_nm"), "{text}");
    let missing = applied(&uneven, &text).expect_err("no limit of torque");
    assert!(missing.contains("left_knee") && missing.contains("effort_nm"), "{missing}");
    let complete = text.replace("# effort_nm = 50.0", "effort_nm = 50.0");
    assert_eq!(applied(&uneven, &complete).expect("it fits").motors.len(), 4);
}

#[test]
fn names_of_the_sides_give_the_mirror_image() {
    let renamed = |text: &str, left: &str, right: &str| text.replace("left_", left).replace("right_", right);
    for (left, right) in [("Left_", "Right_"), ("l_", "r_"), ("L_", "R_"), ("the_left_", "the_right_"), ("l", "r")] {
        let card = renamed(CARD, left, right).replace("*_knee", "*knee");
        let model = applied(&renamed(LEGS, left, right), &card).expect("it fits");
        let mirror = Mirror::of(&model).map(|mirror| mirror.position[7..].to_vec());
        assert_eq!(mirror, Ok(vec![(9, 1.0), (10, 1.0), (7, 1.0), (8, 1.0)]), "{left}");
    }
    // Names without sides: the places decide.
    let (text, card) = (renamed(LEGS, "LL_", "LR_"), renamed(CARD, "LL_", "LR_"));
    let mirror = Mirror::of(&applied(&text, &card).expect("it fits")).expect("by the places");
    assert_eq!(mirror.position[7..], [(9, 1.0), (10, 1.0), (7, 1.0), (8, 1.0)]);
    let apart = changed(&text, "pos='0 -0.1 -0.2'", "pos='0 -0.15 -0.2'");
    let why = Mirror::of(&applied(&apart, &card).expect("it fits")).expect_err("5 cm apart");
    assert!(why.contains("LL_hip"), "{why}");
    let card = changed(&card, "height_m", "symmetry = [['LL_*', 'LR_*']]\nheight_m");
    let model = applied(&text, &card).expect("it fits");
    assert_eq!(Mirror::of(&model).expect("by the card").position[7..], [(9, 1.0), (10, 1.0), (7, 1.0), (8, 1.0)]);
}

#[test]
fn a_card_says_how_the_robots_software_numbers_its_motors() {
    let order = "motors = ['right_knee', 'left_knee', '', 'right_hip', 'left_hip']\nheight_m";
    let robot = applied(LEGS, &changed(CARD, "height_m", order)).expect("it fits").robot.expect("it has a card");
    assert_eq!([robot.motor_number("left_hip"), robot.motor_number("left_knee")], [Some(4), Some(1)]);
    let robot = applied(LEGS, CARD).expect("it fits").robot.expect("it has a card");
    assert_eq!(robot.motor_number("left_hip"), None);
}

#[test]
fn mistakes_in_a_card_are_named() {
    for (from, to, parts) in [
        ("names = '*_knee'", "names = '*_ankle'", &["*_ankle", "no hinge", "left_hip"][..]),
        ("names = 'right_knee'", "names = 'right_kne'", &["right_kne", "right_knee"]),
        ("base = 'trunk'", "base = 'torso'", &["`base`", "torso", "trunk"]),
        ("'right_leg'", "'right_foot'", &["`feet`", "right_foot"]),
        ("'crouch'", "'stand'", &["keyframe `stand`", "crouch"]),
        ("height_m = 0.95", "height_m = -1.0", &["height_m", "-1"]),
        ("height_m = 0.95", "height_m = inf", &["height_m", "inf"]),
        ("default_rad = 0.7", "default_rad = 2.5", &["right_knee", "default_rad", "2.5", "0.0000 to 2.0000"]),
        ("default_rad = 0.7", "default_rad = nan", &["right_knee", "default_rad"]),
        ("kp = 80.0", "kp = -80.0", &["kp", "-80"]),
        ("kp = 80.0", "kp = 1e-9", &["kp", "1e-6"]),
        ("kp = 80.0", "kp = 2e6", &["kp", "2000000", "1e6"]),
        ("names = '*'", &format!("names = '*{}'", "a".repeat(256)), &["257 bytes", "256"]),
        ("kp = 80.0\n", "", &["right_hip", "kp"]),
        ("effort_nm = 90.0\n", "", &["left_knee", "effort_nm"]),
        ("effort_nm = 90.0", "effort_nm = 0.0", &["*_knee", "effort_nm", "0"]),
        ("kp = 100.0", "kp = 0.0\nhelt = true", &["helt"]),
        ("action_scale_rad = 0.5", "kp_max = 1", &["kp_max"]),
        ("kp = 80.0", "kp = 'high'", &["kp"]),
        ("kp = 80.0", "held = true\nkp = 80.0", &["every hinge is held"]),
        ("height_m", "symmetry = [['up_*', 'down_*']]\nheight_m", &["symmetry", "up_*"]),
        ("height_m", "symmetry = [['left_*', 'down_*']]\nheight_m", &["symmetry", "down_hip"]),
        ("height_m", "motors = ['left_hop']\nheight_m", &["motors", "left_hop"]),
        ("height_m", "motors = ['left_hip', '', 'left_hip']\nheight_m", &["motors", "`left_hip` 2 times"]),
        ("height_m", "motors = ['left_hip']\nheight_m", &["motors", "`left_knee` 0 times"]),
    ] {
        let why = applied(LEGS, &changed(CARD, from, to)).expect_err(to);
        assert!(parts.iter().all(|part| why.contains(part)), "`{to}`: {parts:?} are missing in: {why}");
    }
    let stiff = changed(
        CARD,
        "kp = 100.0\neffort_nm = 90.0\narmature_kgm2 = 0.01\naction_scale_rad = 0.5",
        "kp = 0.0\neffort_nm = 9.0",
    );
    let why = applied(LEGS, &stiff).expect_err("no scale");
    assert!(why.contains("left_knee") && why.contains("action_scale_rad"), "{why}");
}
