//! Model texts that are refused, and why; texts that are not the built-in one.

use treadmill_humanoid::{CONTROL_STEP_S, Environment, EnvironmentConfig, HUMANOID_XML, Model};

/// The humanoid with one spot of its text changed.
fn changed(from: &str, to: &str) -> String {
    assert!(HUMANOID_XML.contains(from), "the model no longer contains {from}");
    HUMANOID_XML.replacen(from, to, 1)
}

#[test]
fn what_cannot_be_simulated_is_refused_by_name() {
    let cases = [
        ("<worldbody>", "<worldbody><include file=\"/etc/passwd\"/>", "include"),
        ("<joint name=\"root\" type=\"free\"", "<joint name=\"root\" type=\"ball\"", "torso"),
        ("type=\"sphere\" pos=\"0 0 0.19\"", "type=\"box\" pos=\"0 0 0.19\"", "head"),
        ("axis=\"0 1 0\" range=\"-75 30\"", "axis=\"0 1 1\" range=\"-75 30\"", "lwaist"),
        ("range=\"-75 30\"", "range=\"30 -75\"", "abdomen_y"),
        ("size=\"0.09\"", "size=\"-0.09\"", "head"),
        ("joint=\"left_elbow\" gear", "joint=\"left_wing\" gear", "left_elbow"),
        ("<motor name=\"abdomen_x\"", "<position name=\"abdomen_x\"", "abdomen_x"),
        ("type=\"plane\"", "type=\"plane\" pos=\"0 0 1\"", "floor"),
        ("ctrlrange=\"-0.4 0.4\"", "ctrlrange=\"-0.4 0.5\"", "abdomen_y"),
        ("stiffness=\"20\"", "stiffness=\"-20\"", "abdomen_z"),
    ];
    for (from, to, element) in cases {
        let error = Model::from_mjcf(&changed(from, to)).expect_err(to).to_string();
        assert!(error.contains(element), "`{to}` is blamed on: {error}");
    }
    assert!(Model::from_mjcf("<mujoco>").is_err());
    assert!(Model::from_mjcf("").is_err());
}

#[test]
fn tendons_that_would_act_are_refused_by_name() {
    let fixed = "<fixed name=\"left_hipknee\">";
    let with = |attributes: &str| fixed.replace('>', &format!(" {attributes}>"));
    let cases = [
        (fixed, with("stiffness=\"3\""), ["left_hipknee", "stiffness"]),
        (fixed, with("stiffness=\"0 0 1\""), ["left_hipknee", "stiffness"]),
        (fixed, with("stiffness=\"much\""), ["left_hipknee", "stiffness"]),
        (fixed, with("damping=\"0.1\""), ["left_hipknee", "damping"]),
        (fixed, with("frictionloss=\"1\""), ["left_hipknee", "frictionloss"]),
        (fixed, with("armature=\"1\""), ["left_hipknee", "armature"]),
        (fixed, with("range=\"-1 1\""), ["left_hipknee", "range"]),
        (fixed, with("limited=\"true\" range=\"-1 1\""), ["left_hipknee", "range"]),
        ("joint=\"left_knee\" coef", "joint=\"left_wing\" coef".to_owned(), ["left_hipknee", "left_wing"]),
        ("joint=\"left_knee\" coef=\"1\"", "joint=\"left_knee\" coef=\"nan\"".to_owned(), ["left_hipknee", "coef"]),
        ("<joint joint=\"left_knee\" coef", "<joint name=\"left_knee\" coef".to_owned(), ["left_hipknee", "joint"]),
        ("<tendon>", "<tendon><fixed name=\"slack\"/>".to_owned(), ["slack", "at least one joint"]),
        (
            "<tendon>",
            "<tendon><spatial name=\"cable\"><site site=\"a\"/><site site=\"b\"/></spatial>".to_owned(),
            ["cable", "spatial"],
        ),
        ("<default>", "<default><tendon stiffness=\"2\"/>".to_owned(), ["default tendon", "stiffness"]),
        (
            "<tendon>",
            "<equality><tendon tendon1=\"left_hipknee\"/></equality><tendon>".to_owned(),
            ["left_hipknee", "equality"],
        ),
    ];
    for (from, to, words) in cases {
        let error = Model::from_mjcf(&changed(from, &to)).expect_err(&to).to_string();
        assert!(words.iter().all(|word| error.contains(word)), "`{to}` is refused with: {error}");
    }
    let crowd: String = (0..17).map(|_| "<fixed><joint joint=\"left_knee\"/></fixed>").collect();
    assert!(Model::from_mjcf(&changed("<tendon>", &format!("<tendon>{crowd}"))).is_err());
}

#[test]
fn tendons_that_only_measure_are_accepted() {
    let harmless = "<fixed name=\"left_hipknee\" limited=\"false\" range=\"-1 1\" stiffness=\"0\" damping=\"0.0\">";
    let model = Model::from_mjcf(&changed("<fixed name=\"left_hipknee\">", harmless)).expect("it does nothing");
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
fn settings_out_of_range_are_refused() {
    let config = EnvironmentConfig { substeps: 0, ..EnvironmentConfig::default() };
    let error = Environment::new(&config, HUMANOID_XML).err().expect("no step at all is refused");
    assert!(error.to_string().contains("substeps"));
}

#[test]
fn another_body_has_its_own_sizes() {
    // A pendulum of two bodies on a floating root: one hinge, one motor.
    let text = r#"
        <mujoco>
          <worldbody>
            <geom type="plane" size="1 1 1"/>
            <body name="base" pos="0 0 1.5">
              <freejoint/>
              <geom type="sphere" size="0.2"/>
              <body name="rod" pos="0 0 -0.3">
                <joint name="swing" axis="0 1 0"/>
                <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.05"/>
              </body>
            </body>
          </worldbody>
          <actuator><motor joint="swing" gear="2" ctrllimited="true" ctrlrange="-1 1"/></actuator>
        </mujoco>"#;
    let mut environment = Environment::new(&EnvironmentConfig::default(), text).expect("a simple body is accepted");
    assert_eq!(environment.observation_size(), 13);
    assert_eq!(environment.action_size(), 1);
    assert_eq!(environment.action_limit(), 1.0);
    let mut observation = [0.0; 13];
    environment.reset(0, &mut observation);
    let swing_before = observation[12];
    let step = environment.step(&[1.0], &mut observation);
    assert!(!step.fault);
    assert!(observation[12] > swing_before + (2.0 * CONTROL_STEP_S / 0.2) as f32);
}
