//! Links and joints as MJCF text.

use std::collections::BTreeMap;
use std::path::PathBuf;

use nalgebra::{Isometry3, Matrix3, UnitQuaternion};
use roxmltree::Node;
use urdf_rs::{Geometry, Joint, JointType, Link, Robot};

use super::meshes::Search;
use super::tree::{self, Branch, JointMotion, LinkTree};
use crate::error::ModelError;
use crate::mjcf::element::Attribute;
use crate::mjcf::{notices, xml};

/// Settings of MuJoCo's `<compiler>` that a URDF may have.
const COMPILER: [&str; 5] = ["balanceinertia", "boundmass", "boundinertia", "settotalmass", "inertiafromgeom"];

/// Moments of inertia below this (kg·m²) count as 0: a gram at a tenth of a millimetre has 1e-11.
const INERTIA_LEAST_KGM2: f64 = 1e-15;

/// Writes a robot.
pub(super) fn mjcf(
    robot: &Robot,
    tree: &LinkTree<'_>,
    search: &Search<'_>,
    compiler: Option<Node<'_, '_>>,
    notices: Vec<String>,
) -> Result<String, ModelError> {
    let mut writer = Writer {
        robot,
        tree,
        search,
        bodies: String::new(),
        motors: String::new(),
        meshes: BTreeMap::new(),
        speeds_radps: Vec::new(),
        notices,
    };
    let root = tree.links[tree.root];
    if tree.has_world {
        writer.shapes(root)?;
        for branch in tree.below(tree.root) {
            writer.body(branch)?;
        }
    } else {
        writer.open_root(root, UnitQuaternion::identity());
        writer.content(root)?;
        writer.bodies.push_str("</body>\n");
    }
    Ok(writer.finish(compiler))
}

/// Place of the root in the text, which [`super::raised`] replaces.
pub(super) fn root_place(height_m: f64) -> String {
    format!("pos=\"0 0 {height_m}\"><freejoint>")
}

struct Writer<'a> {
    robot: &'a Robot,
    tree: &'a LinkTree<'a>,
    search: &'a Search<'a>,
    bodies: String,
    motors: String,
    /// Name of each file and scale.
    meshes: BTreeMap<(PathBuf, String), String>,
    /// Greatest speed of each hinge, with its name.
    speeds_radps: Vec<(f64, String)>,
    notices: Vec<String>,
}

impl Writer<'_> {
    fn finish(mut self, compiler: Option<Node<'_, '_>>) -> String {
        self.speeds_radps.sort_by(|one, other| one.0.total_cmp(&other.0));
        if let [(least, slowest), .., (most, _)] = &self.speeds_radps[..] {
            let note = format!("speeds are not limited: the file allows {least} rad/s (`{slowest}`) to {most} rad/s");
            self.notices.push(note);
        }
        let mut text = String::from("<mujoco>\n");
        let given = |name: &str| compiler.and_then(|node| node.attribute(name)).map(|value| attribute(name, value));
        let mut settings = vec![attribute("angle", "radian"), attribute("autolimits", "true")];
        settings.extend(COMPILER.iter().filter_map(|name| given(name)));
        if !settings.iter().any(|(name, _)| name == "inertiafromgeom") {
            // In a URDF, a link without <inertial> has no mass.
            settings.push(attribute("inertiafromgeom", "false"));
        }
        xml::write(&mut text, "compiler", &settings);
        text.push_str("<custom>");
        notices::write(&mut text, "urdf", &self.notices);
        text.push_str("</custom>\n<asset>\n");
        for ((path, scale), name) in &self.meshes {
            let file = path.to_string_lossy();
            xml::write(
                &mut text,
                "mesh",
                &[attribute("name", name), attribute("file", file), attribute("scale", scale)],
            );
        }
        format!(
            "{text}</asset>\n<worldbody>\n{}</worldbody>\n<actuator>\n{}</actuator>\n</mujoco>\n",
            self.bodies, self.motors
        )
    }

    fn body(&mut self, branch: &Branch<'_>) -> Result<(), ModelError> {
        let Branch { joint, pose, motion } = branch;
        let child = self.tree.links[joint.child.link.as_str()];
        if *motion == JointMotion::Free {
            self.open_root(child, pose.rotation);
        } else {
            xml::open(&mut self.bodies, "body", &[vec![attribute("name", &child.name)], place(pose)].concat());
            self.bodies.push('\n');
        }
        if *motion == JointMotion::Hinge {
            self.hinge(joint)?;
        }
        self.content(child)?;
        self.bodies.push_str("</body>\n");
        Ok(())
    }

    fn open_root(&mut self, link: &Link, turn: UnitQuaternion<f64>) {
        let quat = place(&Isometry3::from_parts(Default::default(), turn)).pop();
        let attributes: Vec<Attribute> = [attribute("name", &link.name)].into_iter().chain(quat).collect();
        xml::open(&mut self.bodies, "body", &attributes);
        // The place is the last attribute.
        self.bodies.pop();
        self.bodies.push_str(&format!(" {}</freejoint>\n", root_place(0.0)));
    }

    fn hinge(&mut self, joint: &Joint) -> Result<(), ModelError> {
        let label = format!("joint {}", joint.name);
        let mut attributes = vec![
            attribute("name", &joint.name),
            attribute("type", "hinge"),
            attribute("axis", numbers(tree::axis(joint)?.iter())),
        ];
        if joint.joint_type == JointType::Revolute && joint.limit.lower.is_finite() && joint.limit.upper.is_finite() {
            attributes.push(attribute("range", numbers(&[joint.limit.lower, joint.limit.upper])));
        }
        let dynamics = joint.dynamics.clone().unwrap_or_default();
        for (name, value) in [("damping", dynamics.damping), ("frictionloss", dynamics.friction)] {
            if value != 0.0 {
                attributes.push(attribute(name, value));
            }
        }
        if joint.limit.velocity > 0.0 && joint.limit.velocity.is_finite() {
            self.speeds_radps.push((joint.limit.velocity, joint.name.clone()));
        }
        let effort_nm = joint.limit.effort;
        if effort_nm < 0.0 {
            return Err(ModelError::attribute(&label, "effort", &effort_nm.to_string(), "at least 0 N·m".to_owned()));
        }
        if effort_nm > 0.0 && effort_nm.is_finite() {
            // A control of 1 is the greatest torque.
            let motor = [
                attribute("name", &joint.name),
                attribute("joint", &joint.name),
                attribute("gear", effort_nm),
                attribute("ctrlrange", "-1 1"),
            ];
            xml::write(&mut self.motors, "motor", &motor);
        } else {
            self.notices.push(format!("joint `{}` has no motor, because the file gives it no `effort`", joint.name));
        }
        xml::write(&mut self.bodies, "joint", &attributes);
        Ok(())
    }

    /// Writes what is in and below a link.
    fn content(&mut self, link: &Link) -> Result<(), ModelError> {
        let inertial = &link.inertial;
        let label = format!("link {}", link.name);
        if inertial.mass.value < 0.0 {
            return Err(ModelError::quantity(&label, "mass (kg)", inertial.mass.value, "not negative"));
        }
        if inertial.mass.value > 0.0 {
            let pose = tree::isometry(&inertial.origin);
            let found = &inertial.inertia;
            let own = Matrix3::new(
                found.ixx, found.ixy, found.ixz, found.ixy, found.iyy, found.iyz, found.ixz, found.iyz, found.izz,
            );
            let turn = pose.rotation.to_rotation_matrix();
            let turned = turn * own * turn.transpose();
            // Tools write zeros as rounding errors, whose matrix would have a negative principal inertia.
            let number = |entry| if f64::abs(turned[entry]) < INERTIA_LEAST_KGM2 { 0.0 } else { turned[entry] };
            let full = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(number);
            let inertia = match full {
                // MuJoCo refuses a matrix of zeros, which a fixed link may have, but not the principal inertias.
                [0.0, 0.0, 0.0, 0.0, 0.0, 0.0] => attribute("diaginertia", "0 0 0"),
                full => attribute("fullinertia", numbers(&full)),
            };
            let place = attribute("pos", numbers(pose.translation.vector.iter()));
            xml::write(&mut self.bodies, "inertial", &[place, attribute("mass", inertial.mass.value), inertia]);
        }
        self.shapes(link)?;
        let tree = self.tree;
        tree.below(&link.name).iter().try_for_each(|branch| self.body(branch))
    }

    /// Writes the shapes that touch, and the meshes that are seen.
    fn shapes(&mut self, link: &Link) -> Result<(), ModelError> {
        let label = format!("link {}", link.name);
        for (number, collision) in link.collision.iter().enumerate() {
            let mut attributes = vec![attribute("name", format!("{}_{number}", link.name))];
            attributes.extend(place(&tree::isometry(&collision.origin)));
            let (kind, size) = match &collision.geometry {
                Geometry::Box { size } => ("box", size.map(|side| 0.5 * side).to_vec()),
                Geometry::Cylinder { radius, length } => ("cylinder", vec![*radius, 0.5 * length]),
                Geometry::Capsule { radius, length } => ("capsule", vec![*radius, 0.5 * length]),
                Geometry::Sphere { radius } => ("sphere", vec![*radius]),
                Geometry::Mesh { filename, scale } => {
                    let path = self.search.find(filename).map_err(|tried| missing(&label, filename, &tried))?;
                    attributes.push(attribute("mesh", self.mesh(path, scale.as_deref())));
                    ("mesh", Vec::new())
                }
            };
            if size.contains(&0.0) {
                self.notices.push(format!("a {kind} of link `{}` is left out: it has no size", link.name));
                continue;
            }
            attributes.push(attribute("type", kind));
            if !size.is_empty() {
                attributes.push(attribute("size", numbers(&size)));
            }
            xml::write(&mut self.bodies, "geom", &attributes);
        }
        for visual in &link.visual {
            let Geometry::Mesh { filename, scale } = &visual.geometry else { continue };
            let Ok(path) = self.search.find(filename) else { continue };
            let mesh = self.mesh(path, scale.as_deref());
            let unseen = ["contype", "conaffinity", "mass"].map(|name| attribute(name, 0));
            let mut attributes = vec![attribute("type", "mesh"), attribute("mesh", mesh), attribute("group", 1)];
            attributes.extend(unseen.into_iter().chain(place(&tree::isometry(&visual.origin))));
            let material = visual.material.as_ref();
            // A material is described where it is used, or once for the whole robot.
            let common = |name: &str| self.robot.materials.iter().find(|common| common.name == name);
            let colour = material.and_then(|own| own.color.as_ref().or(common(&own.name)?.color.as_ref()));
            attributes.extend(colour.map(|colour| attribute("rgba", numbers(colour.rgba.iter()))));
            xml::write(&mut self.bodies, "geom", &attributes);
        }
        Ok(())
    }

    /// Returns the name of a mesh.
    fn mesh(&mut self, path: PathBuf, scale: Option<&[f64; 3]>) -> String {
        let next = format!("mesh_{}", self.meshes.len());
        self.meshes.entry((path, numbers(scale.unwrap_or(&[1.0; 3])))).or_insert(next).clone()
    }
}

/// Returns the error of a colliding mesh without a file.
fn missing(label: &str, name: &str, tried: &[PathBuf]) -> ModelError {
    let paths: Vec<String> = tried.iter().map(|path| format!("`{}`", path.display())).collect();
    let within = ["package://", "model://"].iter().find_map(|scheme| name.strip_prefix(scheme));
    let remedy = match within.and_then(|path| path.split('/').next()) {
        Some(package) => format!("; name the folder of its package: --package {package}=FOLDER"),
        None => String::new(),
    };
    let problem =
        format!("the file of its colliding mesh, `{name}`, is missing{remedy} (looked for {})", paths.join(", "));
    ModelError::unsupported(label, problem)
}

fn attribute(name: &str, value: impl ToString) -> Attribute {
    (name.to_owned(), value.to_string())
}

fn place(pose: &Isometry3<f64>) -> Vec<Attribute> {
    let turn = pose.rotation;
    let quat = numbers(&[turn.w, turn.i, turn.j, turn.k]);
    vec![attribute("pos", numbers(pose.translation.vector.iter())), attribute("quat", quat)]
}

fn numbers<'a>(all: impl IntoIterator<Item = &'a f64>) -> String {
    let all: Vec<String> = all.into_iter().map(f64::to_string).collect();
    all.join(" ")
}
