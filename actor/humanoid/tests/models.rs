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
