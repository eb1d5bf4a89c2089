//! Actuators under default classes. What is expected is what MuJoCo 4.0 computes from the same texts.

use treadmill_humanoid::model::Motor;
use treadmill_humanoid::{EnvironmentConfig, Model, ModelError, Physics};

use crate::support::Folder;

/// Returns the motor of a model with these defaults, attributes of its hinge, and this actuator.
fn motor(defaults: &str, hinge: &str, actuator: &str) -> Result<Motor, ModelError> {
    let text = format!(
        "<mujoco><compiler angle='radian'/><default>{defaults}</default><worldbody><body pos='0 0 2'><freejoint/><geom size='.1'/>
         <body pos='0 0 -.4'><joint name='j' axis='0 1 0' {hinge}/><geom size='.1'/></body></body></worldbody>
         <actuator>{actuator}</actuator></mujoco>"
    );
    Ok(Model::from_mjcf(&text)?.motors[0].clone())
}

#[test]
fn gains_of_a_class_hold_for_their_kind_and_for_general_actuators() {
    const KINDS: [&str; 4] = ["motor", "position", "velocity", "general"];
    const NONE: (f64, [f64; 3]) = (1.0, [0.0; 3]);
    const POSITION: (f64, [f64; 3]) = (1.0, [0.0, -1.0, 0.0]);
    const VELOCITY: (f64, [f64; 3]) = (1.0, [0.0, 0.0, -1.0]);
    let servo = |gain: f64, damping: f64| (gain, [0.0, -gain, -damping]);
    let brake = |gain: f64| (gain, [0.0, 0.0, -gain]);
    for (defaults, expected) in [
        ("<position kp='50'/>", [NONE, servo(50.0, 0.0), VELOCITY, servo(50.0, 0.0)]),
        ("<position kp='50' kv='3'/>", [NONE, servo(50.0, 3.0), VELOCITY, servo(50.0, 3.0)]),
        ("<velocity kv='7'/>", [NONE, POSITION, brake(7.0), brake(7.0)]),
        ("<general gainprm='9'/>", [NONE, servo(9.0, 0.0), brake(9.0), (9.0, [0.0; 3])]),
        (
            "<general gainprm='9' biasprm='0 -9 -1' biastype='affine'/>",
            [NONE, servo(9.0, 1.0), brake(9.0), servo(9.0, 1.0)],
        ),
        ("<position kp='50'/><motor gear='3'/>", [NONE, POSITION, VELOCITY, NONE]),
        ("<motor gear='3'/><position kp='50'/>", [NONE, servo(50.0, 0.0), VELOCITY, servo(50.0, 0.0)]),
        ("<position kp='50'/><velocity kv='7'/>", [NONE, POSITION, brake(7.0), brake(7.0)]),
        ("<position kp='50'/><general forcerange='-5 5'/>", [NONE, servo(50.0, 0.0), brake(50.0), servo(50.0, 0.0)]),
    ] {
        for (kind, (gain, bias)) in KINDS.into_iter().zip(expected) {
            let actuator = format!("<{kind} joint='j' ctrlrange='-1 1'/>");
            let found = motor(defaults, "", &actuator).unwrap_or_else(|why| panic!("{defaults} {kind}: {why}"));
            assert_eq!((found.gain, found.bias), (gain, bias), "{defaults} {kind}");
            let is_geared = defaults.contains("gear");
            assert_eq!(found.gear_nm, if is_geared { 3.0 } else { 1.0 }, "{defaults} {kind}: all kinds share the gear");
        }
    }
}

#[test]
fn ranges_of_zero_switch_off_those_of_a_class() {
    let servo = |hinge: &str, own: &str| {
        motor("<position kp='50' ctrlrange='-.2 .2'/>", hinge, &format!("<position joint='j' {own}/>")).expect("valid")
    };
    // Nothing is inherited, so the range of the class stays.
    assert_eq!(servo("range='-1.5 .5'", "inheritrange='0'").control, [-0.2, 0.2]);
    assert_eq!(servo("range='-1.5 .5'", "inheritrange='1'").control, [-1.5, 0.5]);
    // Without a range of its own a servo's targets are those of its hinge.
    assert_eq!(servo("range='-1.5 .5'", "ctrlrange='0 0'").control, [-1.5, 0.5]);

    let hinge = |attributes: &str| {
        let text = format!(
            "<mujoco><default><joint range='-10 10'/></default><worldbody><body pos='0 0 2'><freejoint/><geom size='.1'/>
             <body pos='0 0 -.4'><joint name='j' axis='0 1 0' {attributes}/><geom size='.1'/></body></body></worldbody>
             <actuator><motor joint='j'/></actuator></mujoco>"
        );
        Model::from_mjcf(&text).map(|model| [model.hinges[0].min_rad, model.hinges[0].max_rad])
    };
    assert!(hinge("").expect("limited")[0].is_finite());
    assert_eq!(hinge("range='0 0'").expect("unlimited"), [f64::NEG_INFINITY, f64::INFINITY]);
    let problem = hinge("range='0 0' limited='true'").expect_err("an empty range").to_string();
    assert!(problem.contains("`range` is \"0 0\""), "{problem}");
}

#[test]
fn a_hinge_with_a_reference_has_that_angle_in_the_pose_of_the_text() {
    let of = |hinge: &str| {
        let text = format!(
            "<mujoco><worldbody><body pos='0 0 2'><freejoint/><geom size='.1'/><body pos='0 0 -.4' euler='0 0 30'>
             <joint axis='0 1 0' pos='0 0 .1' {hinge}/><geom size='.1' pos='.3 0 0'/></body></body></worldbody></mujoco>"
        );
        Model::without_motors(&text).expect("valid")
    };
    let (plain, referred) = (of(""), of("ref='20' range='-60 60' springref='5' stiffness='1'"));
    assert_eq!(plain.nominal_position()[7], 0.0);
    assert!((referred.nominal_position()[7] - 20_f64.to_radians()).abs() < 1e-12);
    // Range and spring count from the angle 0, which is 20° before the pose of the text.
    assert!((referred.hinges[0].max_rad - 60_f64.to_radians()).abs() < 1e-12);
    assert!((referred.hinges[0].rest_rad - 5_f64.to_radians()).abs() < 1e-12);
    let place = |model: Model| {
        let mut physics = Physics::new(model.clone(), &EnvironmentConfig::default()).expect("a world");
        physics.set_state(&model.nominal_position(), &vec![0.0; model.velocity_size()]);
        physics.body_motion(1).pose
    };
    let (plain, referred) = (place(plain), place(referred));
    assert!((plain.translation.vector - referred.translation.vector).norm() < 1e-6, "{plain} {referred}");
    assert!(plain.rotation.angle_to(&referred.rotation) < 1e-6, "{plain} {referred}");
}

#[test]
fn impossible_inertias_are_those_that_mujoco_refuses() {
    let of = |compiler: &str, third: &str| {
        let text = format!(
            "<mujoco><compiler {compiler}/><worldbody><body pos='0 0 2'><freejoint/>
             <inertial pos='0 0 0' mass='1' diaginertia='1 1 {third}'/></body></worldbody></mujoco>"
        );
        Model::without_motors(&text).map(|model| model.links[0].inertia_kgm2[(2, 2)])
    };
    assert_eq!(of("", "2").expect("a flat body"), 2.0);
    assert!(of("", "2.0001").expect_err("impossible").to_string().contains("balanceinertia"));
    // All three become their mean.
    let mean = of("balanceinertia='true'", "2.001").expect("balanced");
    assert!((mean - 4.001 / 3.0).abs() < 1e-12, "{mean}");
}

#[test]
fn all_vertices_of_an_obj_file_count_by_their_first_three_numbers() {
    let folder = Folder::new("obj");
    folder.write(
        "robot.xml",
        "<mujoco><asset><mesh file='part.obj' inertia='convex'/></asset><worldbody><body pos='0 0 2'><freejoint/>
         <geom type='mesh' mesh='part' mass='1'/></body></worldbody></mujoco>",
    );
    // A tetrahedron whose last corner no face names.
    folder.write("part.obj", "v 0 0 0 2\nv 1 0 0 2\nv 0 1 0\nv 0 0 1 0.5\nf 1 2 3\n");
    let text = folder.read("robot.xml").expect("a solid");
    let centre = Model::without_motors(&text).expect("valid").links[0].centre_of_mass_m;
    assert!((centre.coords - nalgebra::Vector3::repeat(0.25)).norm() < 1e-6, "{centre}");
}
