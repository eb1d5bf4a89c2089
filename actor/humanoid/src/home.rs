//! Examination of a robot where its episodes start: what would make a training learn nothing, found before it begins.

mod sag;

use nalgebra::{UnitQuaternion, Vector3};

use self::sag::Sag;
use crate::clearance;
use crate::config::EnvironmentConfig;
use crate::environment::Environment;
use crate::error::ModelError;
use crate::model::{Model, Robot};
use crate::physics::Physics;
use crate::task::TaskRegistry;

/// Time for which the default pose is simulated (s).
const SIMULATED_S: f64 = 1.0;
/// Control steps within which an episode that ends has taught nothing.
const STEPS_MIN: u32 = 5;
/// Depth in the ground that is refused, and above which the ground pushes so hard that it is worth a warning (m).
const DEPTH_MAX_M: f64 = 0.05;
const DEPTH_NOTED_M: f64 = 0.02;
/// Height of a fall onto the ground that is refused, and above which it is worth a warning (m).
const DROP_MAX_M: f64 = 0.5;
const DROP_NOTED_M: f64 = 0.1;
/// How much lower than a foot another part of its leg may be (m).
const BELOW_FOOT_M: f64 = 0.03;
/// Distance of two points that a loop holds together, from which it is open (m).
const OPEN_NOTED_M: f64 = 0.01;
/// Cosine of the angle, 45°, by which up and left may differ from the axes z and y of the base.
const AXIS_COSINE: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Vertical force of a point on the ground that counts (N).
const TOUCH_N: f64 = 0.1;
/// Time after the first contact in which other links than feet must not touch: later the robot may have fallen (s).
const SETTLED_S: f64 = 0.1;

/// What was found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HomePose {
    /// Names of the links that touch the ground in the first second, in the order of the model.
    pub touching: Vec<String>,
    /// Axis of the base that points forward, such as `+x`, by the places of two feet; `None` without them.
    pub forward: Option<&'static str>,
    /// Axis of the base that points up.
    pub up: &'static str,
    /// Faults with which a training would learn nothing, each with its remedy.
    pub faults: Vec<String>,
    /// What is unusual.
    pub warnings: Vec<String>,
}

impl HomePose {
    /// Examines the pose in which episodes start: without noise, on the ground of the model.
    ///
    /// # Errors
    /// [`ModelError`] if there is no such environment, see [`Environment::with_tasks`].
    pub fn of(config: &EnvironmentConfig, model_xml: &str, tasks: &TaskRegistry) -> Result<Self, ModelError> {
        let mut config = config.clone().plain();
        config.env.reset_noise_scale = 0.0;
        config.ground.kinds.clear();
        let mut environment = Environment::with_tasks(&config, model_xml, tasks)?;
        let model = environment.physics().model().clone();
        let mut found = Self::default();
        found.examine_axes(&model, environment.nominal_position());
        found.examine_ground(&model, environment.physics());
        found.examine_loops(&model, environment.physics());
        if let Some(robot) = &model.robot {
            found.examine_feet(&model, robot, environment.physics());
        }
        if found.faults.is_empty() {
            found.simulate(&model, &mut environment);
        }
        Ok(found)
    }

    /// Finds out where the base's axes point.
    fn examine_axes(&mut self, model: &Model, position: &[f64]) {
        let [w, x, y, z] = [position[3], position[4], position[5], position[6]];
        let turn = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        let up = turn.inverse() * Vector3::z();
        self.up = nearest_axis(&up);
        let base = &model.links[0].name;
        if up.z < AXIS_COSINE {
            // Only a robot with a card is to walk; another one may begin as it lies.
            let list = if model.robot.is_some() { &mut self.faults } else { &mut self.warnings };
            list.push(format!(
                "the frame of the base `{base}` has its {} axis up in the default pose, but must have x forward, y left and \
                 z up; turn the frame of this body in the model, or give the pose as a keyframe",
                self.up
            ));
        }
    }

    /// Finds out how deep in the ground, or how high above it, the lowest link is.
    fn examine_ground(&mut self, model: &Model, physics: &Physics) {
        let lowest = (0..model.links.len()).filter_map(|link| Some((link, clearance::of_link_m(physics, link)?)));
        let Some((link, height_m)) = lowest.min_by(|one, other| one.1.total_cmp(&other.1)) else {
            return self.faults.push(
                "no shape of the robot can touch the ground; check contype, conaffinity and <pair> in the model"
                    .to_string(),
            );
        };
        let name = &model.links[link].name;
        let right_m = physics.position()[2] - height_m;
        let remedy = format!("start with the base at {right_m:.3} m: `height_m` of the card, or the keyframe");
        let (list, what) = if height_m < 0.0 {
            let list = if height_m < -DEPTH_MAX_M { &mut self.faults } else { &mut self.warnings };
            (list, format!("`{name}` starts {:.3} m deep in the ground", -height_m))
        } else {
            let list = if height_m > DROP_MAX_M { &mut self.faults } else { &mut self.warnings };
            (list, format!("`{name}`, the lowest part, starts {height_m:.3} m above the ground"))
        };
        if !(-DEPTH_NOTED_M..=DROP_NOTED_M).contains(&height_m) {
            list.push(format!("{what}; {remedy}"));
        }
    }

    /// Finds loops that are open: their constraints pull them shut at once.
    fn examine_loops(&mut self, model: &Model, physics: &Physics) {
        for connection in &model.connections {
            let point_m = |end: usize| {
                let body = model.links[connection.links[end]].body;
                physics.body_motion(body).pose * connection.points_m[end]
            };
            let apart_m = (point_m(0) - point_m(1)).norm();
            if apart_m > OPEN_NOTED_M {
                self.warnings.push(format!(
                    "the loop `{}` is open by {apart_m:.3} m in the default pose, and is pulled shut at once; give a pose \
                     in which its ends meet: `keyframe` or `default_rad` of the card",
                    connection.name
                ));
            }
        }
    }

    /// Checks the feet of a card, and which way they say that the robot faces.
    fn examine_feet(&mut self, model: &Model, robot: &Robot, physics: &Physics) {
        let name = |link: usize| model.links[link].name.as_str();
        let [left, right] = robot.feet[..] else { return };
        if left == right {
            return self.faults.push(format!("`feet` names `{}` twice; name the left and the right foot", name(left)));
        }
        for foot in [left, right] {
            let Some(height_m) = clearance::of_link_m(physics, foot) else {
                self.faults.push(format!(
                    "foot `{}` has no shape that can touch the ground; name the link that has one, or give it one (contype, \
                     conaffinity, <pair>)",
                    name(foot)
                ));
                continue;
            };
            let below = (0..model.links.len())
                .filter(|link| is_below(model, *link, foot))
                .filter_map(|link| Some((link, clearance::of_link_m(physics, link)?)))
                .min_by(|one, other| one.1.total_cmp(&other.1));
            if let Some((lower, lower_m)) = below.filter(|(_, lower_m)| *lower_m < height_m - BELOW_FOOT_M) {
                self.faults.push(format!(
                    "foot `{}` is {:.2} m above `{}`, the lowest part of its leg; `feet` are the links that stand on the \
                     ground",
                    name(foot),
                    height_m - lower_m,
                    name(lower)
                ));
            }
        }
        if let Some((index, side)) = [left, right].iter().enumerate().find_map(|(index, foot)| {
            let side = side_of(name(*foot))?;
            (side != index).then_some((*foot, ["left", "right"][side]))
        }) {
            return self
                .faults
                .push(format!("`feet` wants the left foot first; `{}` seems to be the {side} one", name(index)));
        }
        let origin_m = |link: usize| physics.link_pose(link).translation.vector;
        let turn = physics.body_motion(0).pose.rotation * model.links[0].pose.rotation;
        let to_left = turn.inverse() * (origin_m(left) - origin_m(right));
        let to_left = Vector3::new(to_left.x, to_left.y, 0.0);
        let Some(to_left) = to_left.try_normalize(0.01) else { return };
        let forward = to_left.cross(&Vector3::z());
        self.forward = Some(nearest_axis(&forward));
        if forward.x < AXIS_COSINE && self.up == "+z" {
            self.faults.push(format!(
                "the robot faces the {} axis of its base `{}`, by the places of its feet `{}` (left) and `{}`; x must point \
                 forward: say `forward = \"{}\"` in its card, or exchange the feet",
                nearest_axis(&forward),
                name(0),
                name(left),
                name(right),
                nearest_axis(&forward)
            ));
        }
    }

    /// Simulates the default pose with its servos at rest there.
    fn simulate(&mut self, model: &Model, environment: &mut Environment) {
        let action: Vec<f32> = match &model.robot {
            Some(robot) => model.motors.iter().map(|motor| robot.default_position[7 + motor.hinge] as f32).collect(),
            None => vec![0.0; model.motors.len()],
        };
        let mut observation = vec![0.0; environment.observation_size()];
        environment.reset(0, &mut observation);
        let step_s = environment.control_step_s();
        let (mut touches, mut others) = (vec![false; model.links.len()], Vec::new());
        let mut first_contact_s = None;
        let mut sag = Sag::new(model);
        let steps = (SIMULATED_S / step_s).ceil() as u32;
        for step in 1..=steps {
            let outcome = environment.step(&action, &mut observation);
            let now_s = f64::from(step) * step_s;
            let on_ground = environment.physics().contact_points().filter(|contact| contact.force_n.z.abs() > TOUCH_N);
            let on_ground = on_ground.filter_map(|contact| match contact.links {
                [Some(link), None] | [None, Some(link)] => Some(link),
                _ => None,
            });
            for link in on_ground {
                if std::mem::replace(&mut touches[link], true) {
                    continue;
                }
                let since_s = now_s - *first_contact_s.get_or_insert(now_s);
                let is_part = model.robot.as_ref().is_some_and(|robot| !robot.feet.contains(&link));
                if since_s <= SETTLED_S && is_part {
                    others.push(model.links[link].name.as_str());
                }
            }
            sag.observe(model, environment.physics());
            if outcome.terminated {
                if step <= STEPS_MIN {
                    let height_m = environment.physics().torso_height_m();
                    self.faults.push(format!(
                        "an episode ends after {step} steps, although the robot only keeps its default pose, with the base \
                         `{}` at {height_m:.3} m; see velocity.fall_height_share, velocity.fall_tilt_rad, \
                         env.healthy_z_range, and the start's height",
                        model.links[0].name
                    ));
                }
                break;
            }
        }
        self.touching =
            (0..touches.len()).filter(|link| touches[*link]).map(|link| model.links[link].name.clone()).collect();
        self.warnings.extend(sag.warnings(model));
        if !others.is_empty() {
            self.warnings.push(format!(
                "`{}` touches the ground in the default pose, but is no foot; raise it, or add it to `feet`",
                others.join("`, `")
            ));
        }
        for foot in model.robot.iter().flat_map(|robot| &robot.feet) {
            if !touches[*foot] {
                self.faults.push(format!(
                    "foot `{}` does not touch the ground within {SIMULATED_S} s of the default pose; correct the pose, or \
                     `feet`",
                    model.links[*foot].name
                ));
            }
        }
    }
}

/// Returns the axis of a frame, with its sign, to which a vector in it is nearest.
fn nearest_axis(vector: &Vector3<f64>) -> &'static str {
    const NAMES: [[&str; 2]; 3] = [["-x", "+x"], ["-y", "+y"], ["-z", "+z"]];
    let axis = vector.iamax();
    NAMES[axis][usize::from(vector[axis] > 0.0)]
}

/// Returns the side in a name: 0 for left, 1 for right.
pub(crate) fn side_of(name: &str) -> Option<usize> {
    let name = name.to_lowercase();
    let is = |word: &str, letter: &str| {
        name.contains(word) || name.split(|c: char| !c.is_ascii_alphanumeric()).any(|part| part == letter)
    };
    match (is("left", "l"), is("right", "r")) {
        (true, false) => Some(0),
        (false, true) => Some(1),
        _ => None,
    }
}

/// Returns whether `link` hangs on the rigid body of `above`, directly or by hinges.
fn is_below(model: &Model, link: usize, above: usize) -> bool {
    link != above && model.upward(model.links[link].body).any(|body| body == model.links[above].body)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FEET: &str = r#"
        <body name="SIDE_thigh" pos="0 PLACE -.1"><joint name="SIDE_hip" axis="0 1 0" range="-1 1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -.35" size=".05" mass="3"/>
          <body name="SIDE_foot" pos="0 0 -.4"><joint name="SIDE_ankle" axis="0 1 0" range="-.6 .6"/>
            <geom type="box" size=".1 .04 .02" pos=".03 0 -.03" mass="1"/></body></body>"#;

    /// Returns the model of a biped whose base has this orientation, while its parts stay upright.
    fn biped(quaternion: &str, back: &str, height_m: &str, feet: &str) -> String {
        let leg = |side: &str, place: &str| FEET.replace("SIDE", side).replace("PLACE", place);
        let legs = leg("left", ".1") + &leg("right", "-.1");
        let card = format!(
            "feet = [{feet}]\n[[hinges]]\nnames = \"*\"\nkp = 150.0\nkd = 5.0\neffort_nm = 100.0\ndefault_rad = 0.0\n"
        );
        let text = format!(
            r#"<mujoco><compiler angle="radian"/><worldbody><geom type="plane" size="5 5 .1"/>
            <body name="pelvis" pos="0 0 {height_m}" quat="{quaternion}"><freejoint/><frame quat="{back}">
            <geom type="box" size=".1 .12 .08" mass="8"/>{legs}</frame></body></worldbody></mujoco>"#
        );
        crate::mjcf::card_text::with_card(&text, &card).unwrap()
    }

    fn examine(text: &str) -> HomePose {
        let mut config = EnvironmentConfig::default();
        config.env.task = crate::config::EnvTask::Velocity;
        HomePose::of(&config, text, &TaskRegistry::default()).unwrap()
    }

    const FEET_NAMES: &str = "\"left_foot\", \"right_foot\"";
    const UPRIGHT: [&str; 2] = ["1 0 0 0", "1 0 0 0"];
    const HEIGHT: &str = "0.55";

    #[test]
    fn a_robot_on_its_feet_is_in_order() {
        let found = examine(&biped(UPRIGHT[0], UPRIGHT[1], HEIGHT, FEET_NAMES));
        assert_eq!((found.forward, found.up), (Some("+x"), "+z"));
        assert_eq!(found.touching, ["left_foot", "right_foot"]);
        assert_eq!((found.faults, found.warnings), (Vec::new(), Vec::new()));
    }

    #[test]
    fn faults_name_bodies_and_remedies() {
        let turned = |quaternion: &str, back: &str| biped(quaternion, back, HEIGHT, FEET_NAMES);
        let named = |feet: &str| biped(UPRIGHT[0], UPRIGHT[1], HEIGHT, feet);
        let at = |height_m: &str| biped(UPRIGHT[0], UPRIGHT[1], height_m, FEET_NAMES);
        for (text, parts) in [
            (turned("0 0 0 1", "0 0 0 -1"), ["faces the -x axis", "`pelvis`"]),
            (turned("0.7071 0 0 0.7071", "0.7071 0 0 -0.7071"), ["faces the -y axis", "`left_foot`"]),
            (turned("0.7071 0.7071 0 0", "0.7071 -0.7071 0 0"), ["its +y axis up", "`pelvis`"]),
            (named("\"left_foot\", \"left_foot\""), ["`left_foot` twice", "right foot"]),
            (named("\"left_thigh\", \"right_thigh\""), ["`left_thigh` is", "above `left_foot`"]),
            (named("\"right_foot\", \"left_foot\""), ["left foot first", "`right_foot` seems"]),
            (at("0.35"), ["deep in the ground", "0.550 m"]),
            (at("2.0"), ["1.450 m above the ground", "0.550 m"]),
        ] {
            let found = examine(&text);
            let all = found.faults.join("\n");
            assert!(parts.iter().all(|part| all.contains(part)), "{parts:?} in {all}");
        }
        let smooth =
            named(FEET_NAMES).replace(r#"size=".1 .04 .02""#, r#"size=".1 .04 .02" contype="0" conaffinity="0""#);
        assert!(examine(&smooth).faults[0].contains("no shape that can touch the ground"), "{smooth}");
        let above = examine(&at("0.7"));
        assert!(above.faults.is_empty() && above.warnings[0].contains("0.150 m above"), "{above:?}");
    }

    #[test]
    fn a_loop_that_is_open_at_home_is_named() {
        let strut =
            r#"<equality><connect name="strut" body1="pelvis" body2="left_foot" anchor="0 .1 -.5"/></equality>"#;
        let looped =
            biped(UPRIGHT[0], UPRIGHT[1], HEIGHT, FEET_NAMES).replace("</mujoco>", &format!("{strut}</mujoco>"));
        assert_eq!(examine(&looped).warnings, Vec::<String>::new());
        // The foot hangs 0.4 m below a hip that is turned by 0.1.
        let bent = looped.replace("default_rad = 0.0", "default_rad = 0.1");
        let warnings = examine(&bent).warnings;
        assert!(warnings.iter().any(|warning| warning.contains("`strut` is open by 0.040 m")), "{warnings:?}");
    }

    #[test]
    fn thresholds_of_another_robot_end_every_episode() {
        let mut config = EnvironmentConfig::default();
        config.env.healthy_z_range = [0.2, 0.9];
        let found = HomePose::of(&config, crate::HUMANOID_XML, &TaskRegistry::default()).unwrap();
        assert!(
            found.faults[0].contains("ends after 1 steps") && found.faults[0].contains("healthy_z_range"),
            "{found:?}"
        );
        config.env.healthy_z_range = [1.0, 2.0];
        let found = HomePose::of(&config, crate::HUMANOID_XML, &TaskRegistry::default()).unwrap();
        assert_eq!((found.faults, found.up), (Vec::new(), "+z"));
    }
}
