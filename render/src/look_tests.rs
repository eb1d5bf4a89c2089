use treadmill_humanoid::HUMANOID_XML;

use super::*;

/// A trunk with two legs whose names say no side, of which only the feet have shapes.
const LEGS: &str = r#"<mujoco><worldbody><geom type="plane" size="9 9 1"/><body name="trunk" pos="0 0 1"><freejoint/>
    <inertial pos="0 0 0.2" mass="10" diaginertia="0.1 0.1 0.1"/>
    <body name="ja" pos="0 -0.1 0"><joint name="ja" axis="0 1 0" range="-60 60"/><inertial pos="0 0 -0.2" mass="2" diaginertia="0.01 0.01 0.01"/>
    <body name="ka" pos="0 0 -0.4"><joint name="ka" axis="0 1 0" range="-60 60"/><geom type="sphere" size="0.05" pos="0 0 -0.5" mass="1"/></body></body>
    <body name="jb" pos="0 0.1 0"><joint name="jb" axis="0 1 0" range="-60 60"/><inertial pos="0 0 -0.2" mass="2" diaginertia="0.01 0.01 0.01"/>
    <body name="kb" pos="0 0 -0.4"><joint name="kb" axis="0 1 0" range="-60 60"/><geom type="sphere" size="0.05" pos="0 0 -0.5" mass="1"/></body></body>
    </body></worldbody></mujoco>"#;

#[test]
fn sides_come_from_the_place_and_not_from_the_name() {
    let model = Model::without_motors(LEGS).unwrap();
    let colour = |name: &str| colours(&model)[model.links.iter().position(|link| link.name == name).unwrap()];
    assert_eq!(["trunk", "ja", "ka", "jb", "kb"].map(colour), [MIDDLE, RIGHT, RIGHT, LEFT, LEFT]);
    // Without a mirror image the name decides.
    let skewed =
        LEGS.replace("pos=\"0 0.1 0\"", "pos=\"0.2 0.1 0\"").replace("kb", "l_knee").replace("ka", "RIGHT_knee");
    let model = Model::without_motors(&skewed).unwrap();
    assert_eq!(colours(&model), [MIDDLE, MIDDLE, RIGHT, MIDDLE, LEFT]);
}

#[test]
fn bodies_without_shape_are_capsules_to_the_next_ones() {
    let model = Model::without_motors(LEGS).unwrap();
    let parts = parts(&model, &[]);
    // Two for the trunk, one for each thigh, and the spheres.
    let bodies: Vec<usize> = parts.iter().map(|part| part.body).collect();
    assert_eq!(bodies, [0, 0, 1, 2, 3, 4]);
    let lowest_m = |part: &RobotPart| part.mesh.corners_m.iter().map(|corner| corner[2]).fold(f32::INFINITY, f32::min);
    // A thigh of 2 kg and 0.4 m is 0.04 m thick, and ends at the knee.
    assert!((lowest_m(&parts[2]) + 0.4 + 0.0399).abs() < 1e-3, "{}", lowest_m(&parts[2]));
}

#[test]
fn meshes_of_the_same_robot_replace_its_shapes() {
    let model = Model::from_mjcf(HUMANOID_XML).unwrap();
    let mesh = |link: &str| VisualMesh {
        link: link.to_string(),
        pose: Isometry3::translation(0.0, 0.0, 0.5),
        vertices_m: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        faces: vec![[0, 1, 2]],
        colour: [0.2, 0.2, 0.2, 1.0],
    };
    let found = parts(&model, &[mesh("left_thigh"), mesh("torso"), mesh("of_another_robot")]);
    let [thigh, torso] = &found[..] else { panic!("{} parts", found.len()) };
    assert_eq!((&*model.bodies[thigh.body].name, thigh.colour), ("left_thigh", [0.2; 3]));
    assert_eq!(torso.tinted, torso.colour, "the middle keeps its colour");
    assert!((thigh.tinted[0] - (0.2 + 0.73 * TINT)).abs() < 1e-12, "{:?}", thigh.tinted);
    assert_eq!(thigh.mesh.corners_m[1], [1.0, 0.0, 0.5]);
    let shapes: usize = model.bodies.iter().map(|body| body.shapes.len()).sum();
    assert_eq!(parts(&model, &[mesh("of_another_robot")]).len(), shapes);
}
