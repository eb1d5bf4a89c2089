//! Masses, poses, hinges and motors of model texts, compared with MuJoCo's values for the same texts.

use nalgebra::{Matrix3, Point3};
use treadmill_humanoid::model::{Body, Geometry, Solver};
use treadmill_humanoid::{HUMANOID_XML, Model};

const G1_LIKE_XML: &str = include_str!("../../assets/g1-like.xml");
const G1_LIKE_SERVOS_XML: &str = include_str!("../../assets/g1-like-servos.xml");

/// Text with classes, frames, all kinds of orientation, all shapes and both kinds of inertia.
const ODD: &str = r"
<mujoco model='odd'>
  <compiler angle='radian' eulerseq='zyx' inertiagrouprange='0 3' balanceinertia='true'/>
  <default class='main'>
    <geom pos='0 0 0.1' density='500' friction='0.7'/>
    <joint damping='2'/>
    <default class='turned'>
      <geom quat='0.5 0.5 0.5 0.5' size='0.1 0.05 0.02'/>
      <default class='case'><geom type='box' mass='0.3'/></default>
    </default>
    <position kp='50' kv='2' ctrlrange='-1 0.5'/>
  </default>
  <worldbody>
    <geom name='floor' type='plane' size='5 5 0.1' pos='0 0 0'/>
    <body name='base' pos='0.1 0.2 1' euler='0.3 0.2 0.1' childclass='turned'>
      <freejoint/>
      <geom type='box'/>
      <geom type='ellipsoid' contype='0' conaffinity='0' pos='0 0.3 0' size='0.2'/>
      <geom type='cylinder' class='main' pos='0 0 0' fromto='0 0 -0.1 0.1 0.2 -0.4' size='0.03' mass='0.7'/>
      <geom type='box' class='main' pos='0 0 0' fromto='0 0.1 -0.1 0.1 0.2 -0.4' size='0.03'/>
      <geom type='ellipsoid' class='main' pos='0 0 0' fromto='0 0.1 0.1 0.1 0.2 -0.4' size='0.03'
            contype='0' conaffinity='0'/>
      <geom class='case' group='4' mass='100' contype='0' conaffinity='0'/>
      <frame pos='0.5 0 0' zaxis='1 0 1'>
        <geom class='case'/>
        <body name='pod' pos='0 0.2 0' xyaxes='0 1 0 -1 0 0.2'>
          <geom class='main' type='sphere' size='0.07'/>
          <body name='tip' axisangle='0 1 1 0.5' pos='0 0 0.3'>
            <inertial pos='0.01 0.02 0.03' quat='0.9 0.1 0.2 0.3' mass='0.5' diaginertia='0.002 0.001 0.0015'/>
            <geom class='case'/>
          </body>
        </body>
        <body name='arm' pos='0 0 -0.4'>
          <joint name='a1' axis='1 2 0' pos='0 0 0.1' range='-1 0.4' stiffness='3' springref='0.2'/>
          <joint name='a2' axis='-2 1 0' pos='0 0 0.1' armature='0.1'/>
          <joint name='a3' axis='0 0 -3' pos='0 0 0.1'/>
          <inertial pos='0 0 -0.1' mass='2' fullinertia='0.02 0.03 0.04 0.001 0.002 -0.003'/>
          <geom class='main' type='capsule' size='0.05 0.2' pos='0 0 -0.2' euler='0.1 0.2 0.3'/>
          <body name='flat' pos='0 0 -0.5'>
            <joint name='f' type='hinge' axis='0 1 0'/>
            <inertial pos='0 0 0' mass='1' diaginertia='0.01 0.01 0.05'/>
          </body>
        </body>
      </frame>
    </body>
  </worldbody>
  <actuator>
    <position name='p' joint='a1' gear='2'/>
    <position joint='f' ctrlrange='-2 2' forcerange='-5 5'/>
  </actuator>
</mujoco>";

fn body<'a>(model: &'a Model, name: &str) -> &'a Body {
    model.bodies.iter().find(|body| body.name == name).expect(name)
}

/// Asserts mass, centre of mass, and inertia as xx, yy, zz, xy, xz, yz.
fn assert_mass(body: &Body, mass_kg: f64, centre_m: [f64; 3], [xx, yy, zz, xy, xz, yz]: [f64; 6]) {
    let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    assert!((body.mass_kg - mass_kg).abs() < 1e-8, "{}: {} kg", body.name, body.mass_kg);
    assert!((body.centre_of_mass_m - Point3::from(centre_m)).norm() < 1e-8, "{}: {}", body.name, body.centre_of_mass_m);
    assert!((body.inertia_kgm2 - inertia).norm() < 1e-8, "{}: {}", body.name, body.inertia_kgm2);
}

#[test]
fn an_unusual_text_has_mujocos_values() {
    let model = Model::from_mjcf(ODD).expect("valid");
    assert_eq!(model.bodies.len(), 3, "welded bodies are part of the base");
    // MuJoCo 4.0's bodies `base`, `pod` and `tip`, summed up in the base's frame.
    let inertia = [0.170268958, 0.494041838, 0.406460223, -0.021655906, -0.137874378, -0.000930685];
    let centre = [0.256664227, 0.147534822, -0.047586212];
    assert_mass(body(&model, "base"), 4.123974831, centre, inertia);
    assert_mass(body(&model, "arm"), 2.0, [0.0, 0.0, -0.1], [0.02, 0.03, 0.04, 0.001, 0.002, -0.003]);
    assert_mass(body(&model, "flat"), 1.0, [0.0; 3], [0.07 / 3.0, 0.07 / 3.0, 0.07 / 3.0, 0.0, 0.0, 0.0]);

    let arm = &body(&model, "arm").pose;
    let (place, turn) = (arm.translation.vector, arm.rotation.quaternion());
    assert!((place.x - 0.217157288).abs() < 1e-8 && (place.z + 0.282842712).abs() < 1e-8);
    assert!((turn.w - 0.923879533).abs() < 1e-8 && (turn.j - 0.382683432).abs() < 1e-8);
    let base = body(&model, "base").pose.rotation;
    let wanted = [0.983347443, 0.034270799, 0.106020511, 0.143572175];
    let found = [base.w, base.i, base.j, base.k];
    assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-8), "{found:?}");

    let first = &model.hinges[0];
    assert_eq!((first.name.as_str(), first.min_rad, first.max_rad), ("a1", -1.0, 0.4));
    assert_eq!((first.stiffness_nmprad, first.rest_rad, first.damping_nmsprad), (3.0, 0.2, 2.0));
    assert!((first.axis.y - 0.894427191).abs() < 1e-8);
    assert_eq!(model.hinges[1].armature_kgm2, 0.1);
    assert_eq!(model.motors[0].control, [-1.0, 0.5]);
    assert_eq!((model.motors[1].control, model.motors[1].force), ([-2.0, 2.0], [-5.0, 5.0]));
}

#[test]
fn the_compilers_mass_rules_are_mujocos() {
    let with = |change: &str| {
        let text = ODD.replacen("balanceinertia='true'", &format!("balanceinertia='true' {change}"), 1);
        Model::from_mjcf(&text).expect(change)
    };
    // Bounds first, then balance: (0.02 + 0.02 + 0.05) / 3. The capsule of 0.05 m and 0.4 m weighs 500 × 0.0036652 m³.
    let bound = with("boundmass='3' boundinertia='0.02'");
    assert_mass(body(&bound, "flat"), 3.0, [0.0; 3], [0.03, 0.03, 0.03, 0.0, 0.0, 0.0]);
    assert_eq!(body(&bound, "arm").mass_kg, 3.0);
    let scaled = with("settotalmass='20'");
    let factor = 20.0 / 7.123974831206716;
    assert!((scaled.mass_kg() - 20.0).abs() < 1e-9);
    assert!((body(&scaled, "flat").inertia_kgm2[(0, 0)] - factor * 0.07 / 3.0).abs() < 1e-8);
    let by_shapes = with("inertiafromgeom='true'");
    assert!((body(&by_shapes, "arm").mass_kg - 1.832_595_714_594).abs() < 1e-9);
    assert_eq!(body(&by_shapes, "flat").mass_kg, 1.0, "without geoms its <inertial> counts");
    let never = ODD.replacen("angle='radian'", "angle='radian' inertiafromgeom='false'", 1);
    assert!((Model::from_mjcf(&never).expect("valid").bodies[0].mass_kg - 0.5).abs() < 1e-12, "only the tip's counts");
}

/// Built-in humanoid in the notation of Gymnasium's file: other defaults, visual elements, inert tendons.
fn in_gymnasiums_notation() -> String {
    [
        ("<joint type=\"hinge\" limited=\"true\" damping=\"1\" armature=\"1\"/>", "<joint armature=\"1\" damping=\"1\" limited=\"true\"/>"),
        (
            "<geom type=\"capsule\" density=\"1000\" condim=\"1\" margin=\"0.001\"/>",
            "<geom conaffinity=\"1\" condim=\"1\" contype=\"1\" margin=\"0.001\" material=\"skin\" rgba=\"0.8 0.6 .4 1\" type=\"capsule\"/>",
        ),
        ("ctrlrange=\"-0.4 0.4\"", "ctrlrange=\"-.4 .4\""),
        (
            "<option timestep=\"0.003\" solver=\"PGS\"/>",
            "<option integrator=\"RK4\" iterations=\"50\" solver=\"PGS\" timestep=\"0.003\"><!-- no flags --></option>\
             <size nkey=\"5\" nuser_geom=\"1\"/><visual><map fogend=\"5\" fogstart=\"3\"/></visual>\
             <asset><texture builtin=\"gradient\" height=\"10\" width=\"10\" type=\"skybox\"/>\
             <material name=\"skin\" reflectance=\"0.5\" texuniform=\"true\"/></asset>",
        ),
        ("<joint name=\"root\" type=\"free\" limited=\"false\"", "<joint name=\"root\" pos=\"0 0 0\" stiffness=\"0\" type=\"free\" limited=\"false\""),
        ("<geom name=\"head\"", "<camera mode=\"trackcom\" name=\"track\" pos=\"0 -4 0\" xyaxes=\"1 0 0 0 0 1\"/><geom user=\"258\" name=\"head\""),
    ]
    .into_iter()
    .fold(HUMANOID_XML.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "the model no longer contains {from}");
        text.replacen(from, to, 1)
    })
}

#[test]
fn the_solver_is_newtons_unless_the_text_says_pgs() {
    let solver =
        |name: &str| Model::from_mjcf(&HUMANOID_XML.replacen("solver=\"PGS\"", name, 1)).map(|model| model.solver);
    assert_eq!(solver("").unwrap(), Solver::Newton);
    assert_eq!(solver("solver=\"CG\"").unwrap(), Solver::Newton);
    assert_eq!(solver("solver=\"PGS\"").unwrap(), Solver::GaussSeidel);
    let why = solver("solver=\"pgs\"").unwrap_err().to_string();
    assert!(why.contains("solver") && why.contains("pgs") && why.contains("Newton, CG or PGS"), "{why}");
}

#[test]
fn gymnasiums_notation_gives_the_built_in_humanoid() {
    let built_in = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let other = Model::from_mjcf(&in_gymnasiums_notation()).expect("valid");
    assert_eq!(format!("{built_in:?}"), format!("{other:?}"));
    // MuJoCo 4.0's values for Gymnasium's own file.
    let chest = [0.173148828, 0.154010141, 0.041211852, 0.0, -0.003498385, 0.0];
    assert_mass(body(&other, "torso"), 8.907462370, [-0.002539384, 0.0, 0.034662591], chest);
    let thigh = [0.074951654, 0.074893984, 0.008285101, 0.0, 0.0, 0.001960781];
    assert_mass(body(&other, "right_thigh"), 4.751750929, [0.0, 0.005, -0.17], thigh);
    let lower_arm = [0.009318673, 0.009318673, 0.009318673, 0.004348556, -0.004348556, 0.004348556];
    assert_mass(body(&other, "left_lower_arm"), 1.229540193, [0.109623134, -0.109623134, 0.109623134], lower_arm);
}

#[test]
fn the_robot_of_29_hinges_has_mujocos_values() {
    let model = Model::from_mjcf(G1_LIKE_XML).expect("valid");
    assert_eq!((model.bodies.len(), model.hinges.len(), model.motors.len()), (30, 29, 29));
    assert!((model.mass_kg() - 34.3).abs() < 1e-9);
    // MuJoCo 4.0's values.
    let chest = [0.103119241, 0.090472690, 0.039705448, 0.0, -0.001862069, 0.0];
    assert_mass(body(&model, "torso"), 8.7, [0.001379310, 0.0, 0.184827586], chest);
    let shin = [0.013608806, 0.013608806, 0.001462776, 0.0, 0.0, 0.0];
    assert_mass(body(&model, "left_shin"), 1.9, [0.0, 0.0, -0.125], shin);
    let hip = [0.001188958, 0.001316250, 0.001188958, 0.0, 0.0, 0.0];
    assert_mass(body(&model, "right_hip_pitch"), 1.3, [0.0, -0.015, 0.0], hip);
    for left in model.hinges.iter().filter(|hinge| hinge.name.starts_with("left_")) {
        let name = left.name.replace("left_", "right_");
        let right = model.hinges.iter().find(|hinge| hinge.name == name).expect("each left hinge has a right one");
        let mirrored = left.axis.x != 0.0 || left.axis.z != 0.0;
        let range = if mirrored { [-left.max_rad, -left.min_rad] } else { [left.min_rad, left.max_rad] };
        assert_eq!([right.min_rad, right.max_rad], range, "{name}");
    }
    let soles = model.bodies.iter().filter(|body| body.name.ends_with("_foot"));
    assert!(soles.flat_map(|foot| &foot.shapes).all(|shape| matches!(shape.geometry, Geometry::Box { .. })));
}

#[test]
fn the_robot_with_servos_is_the_same_on_bumps() {
    let (plain, model) = (Model::from_mjcf(G1_LIKE_XML), Model::from_mjcf(G1_LIKE_SERVOS_XML));
    let (plain, model) = (plain.expect("valid"), model.expect("valid"));
    assert_eq!((&model.bodies, &model.pairs), (&plain.bodies, &plain.pairs));
    assert_eq!(model.pairs.len(), 113, "as in MuJoCo 4.0");
    for (motor, hinge) in model.motors.iter().map(|motor| (motor, &model.hinges[motor.hinge])) {
        assert_eq!((hinge.armature_kgm2, hinge.friction_loss_nm > 0.0), (0.01, true), "{}", hinge.name);
        let [low, high] = motor.control;
        assert!((low - hinge.min_rad).abs() < 1e-12 && (high - hinge.max_rad).abs() < 1e-12, "{}", motor.name);
        assert!(motor.bias[1] == -motor.gain && motor.bias[2] < 0.0 && motor.force[1] > 0.0);
    }
    let knee = model.motors.iter().find(|motor| motor.name == "left_knee").expect("a knee");
    assert_eq!((knee.gain, knee.bias, knee.force), (150.0, [0.0, -150.0, -4.0], [-140.0, 140.0]));
    let [stand] = &model.keyframes[..] else { panic!("one keyframe") };
    assert_eq!((stand.name.as_str(), stand.position[2], stand.controls.len()), ("stand", 0.777, 29));
    assert!(
        model.motors.iter().zip(&stand.controls).all(|(motor, control)| stand.position[7 + motor.hinge] == *control)
    );
    let field = model.ground.height_field.expect("bumps");
    assert_eq!((field.rows, field.columns, field.half_x_m, field.half_y_m), (33, 33, 8.0, 8.0));
    assert_eq!(field.height_at(0.0, 0.0), Some(0.0));
    let highest_m = field.heights_m.iter().copied().fold(0.0, f64::max);
    assert!((highest_m - 0.04).abs() < 1e-12 && field.heights_m.iter().all(|height_m| *height_m >= 0.0));
}

#[test]
fn a_motor_without_control_range_derives_it_from_its_limits() {
    let range_of = |motor: &str, joint: &str| {
        let text = format!(
            r"<mujoco><worldbody><geom type='plane' size='1 1 1'/><body pos='0 0 1'><freejoint/><geom size='0.1'/>
               <body><joint name='hinge' {joint}/><geom size='0.1'/></body></body></worldbody>
               <actuator><motor joint='hinge' {motor}/></actuator></mujoco>"
        );
        Model::from_mjcf(&text).expect("valid").motors[0].control
    };
    assert_eq!(range_of("ctrlrange='-0.1 3'", ""), [-0.1, 3.0]);
    assert_eq!(range_of("ctrlrange='-0.1 3' ctrllimited='false'", ""), [-1.0, 1.0]);
    assert_eq!(range_of("forcerange='-20 30'", ""), [-20.0, 30.0]);
    assert_eq!(range_of("gear='-10'", "actuatorfrcrange='-20 30'"), [-3.0, 2.0]);
    assert_eq!(range_of("gear='10'", ""), [-1.0, 1.0]);
}

#[test]
fn a_servo_rests_at_its_target() {
    let target_rad = |actuator: &str, control: f64| {
        let text = format!(
            r"<mujoco><worldbody><geom type='plane' size='1 1 1'/><body><freejoint/><geom size='0.1'/><body>
               <joint name='a'/><geom size='0.1'/></body></body></worldbody><actuator>{actuator}</actuator></mujoco>"
        );
        Model::from_mjcf(&text).expect("valid").motors[0].target_rad(control)
    };
    assert_eq!(target_rad("<motor joint='a' gear='60'/>", 0.5), None);
    assert_eq!(target_rad("<position joint='a' kp='50' ctrlrange='-1 1'/>", 0.25), Some(0.25));
    assert_eq!(target_rad("<position joint='a' kp='50' ctrlrange='-1 1'/>", 3.0), Some(1.0));
    // Its length is twice the angle, and 4 · 0.5 + 1 = 8 · 2 · 0.1875.
    let general = "<general joint='a' gear='2' gainprm='4' biastype='affine' biasprm='1 -8 0' ctrlrange='-1 1'/>";
    assert_eq!(target_rad(general, 0.5), Some(0.1875));
}

#[test]
fn actuators_that_share_a_servos_limit_are_noted() {
    let notes = |actuators: &str| {
        let model = Model::from_mjcf(&format!(
            r"<mujoco><worldbody><geom type='plane' size='1 1 1'/><body><freejoint/><geom size='0.1'/><body>
               <joint name='a'/><geom size='0.1'/><body><joint name='b'/><geom size='0.1'/></body></body></body></worldbody>
               <actuator>{actuators}</actuator></mujoco>"
        ));
        model.expect("valid").simplifications
    };
    let limited = "<position joint='a' kp='50' ctrlrange='-1 1' forcerange='-5 5'/>";
    let damped = format!("{limited}<velocity joint='a' kv='3' ctrlrange='-1 1'/>");
    assert!(matches!(&notes(&damped)[..], [note] if note.contains("joint `a`") && note.contains("narrowest servo")));
    let apart = format!("{limited}<motor joint='b'/>");
    let unlimited = "<position joint='a' kp='50' ctrlrange='-1 1'/><motor joint='a' forcerange='-5 5'/>";
    for none in [limited, &apart[..], unlimited] {
        assert_eq!(notes(none), [""; 0], "{none}");
    }
}
