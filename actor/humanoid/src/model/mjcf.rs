//! Conversion of MJCF text to a [`Model`]; welded bodies are merged into rigid bodies.

use std::collections::BTreeSet;
use std::ops::Range;

use mjcf_rs::body::{Geom, Joint, JointType};
use nalgebra::{Isometry3, Matrix3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::defaults::get;
use super::flatten::{Flat, flatten};
use super::floor::Floor;
use super::inertia::MassProperties;
use super::pairs::{self, ContactRules, Party};
use super::{
    Body, Geometry, Hinge, Link, Model, RootJoint, Shape, collision, geoms, inertia, joints, keyframes, mass, motors,
    tendon,
};
use crate::error::ModelError;

/// Most rigid bodies.
pub const BODIES_MAX: usize = 512;
/// Most hinges.
pub const HINGES_MAX: usize = 1024;
/// Most colliding shapes, so that all pairs of them can be compared.
pub const SHAPES_MAX: usize = 4096;
/// Most bodies of a text, and most geoms, whether they collide or not.
const ALL_BODIES_MAX: usize = 4096;
const GEOMS_MAX: usize = 8192;
/// Most vertices of all hulls.
const HULL_VERTICES_MAX: usize = 1 << 16;

/// Reads and checks a model text.
pub(super) fn read(text: &str) -> Result<Model, ModelError> {
    let flat = flatten(text)?;
    let source = mjcf_rs::Model::from_str(&flat.text, ".").map_err(ModelError::Parse)?;
    let sides = flat.pairs.iter().flat_map(|(_, pair)| [get(pair, "geom1"), get(pair, "geom2")]);
    let paired = sides.flatten().map(str::to_owned).collect();
    check_size(&source)?;
    let mut reader = Reader { flat, paired, ..Reader::default() };
    for (index, entry) in source.bodies.iter().enumerate() {
        match entry.parent {
            None => {
                reader.placements.push(Placement { body: None, offset: Isometry3::identity() });
                reader.read_static(index, "the world", &entry.body.geoms, &Isometry3::identity())?;
            }
            Some(parent) => reader.read_body(index, parent, &entry.body, &source.compiler)?,
        }
    }
    reader.finish(&source)
}

/// Refuses texts that would take minutes to read.
fn check_size(source: &mjcf_rs::Model) -> Result<(), ModelError> {
    let geoms = source.bodies.iter().map(|entry| entry.body.geoms.len()).sum();
    for (count, most, what) in
        [(source.bodies.len(), ALL_BODIES_MAX, "bodies, static ones included"), (geoms, GEOMS_MAX, "geoms")]
    {
        if count > most {
            return Err(ModelError::unsupported("worldbody", format!("it has {count} {what}, but may have {most}")));
        }
    }
    Ok(())
}

/// Rigid body that an MJCF body belongs to, and its pose in that body; `None` is the world.
#[derive(Clone, Copy)]
struct Placement {
    body: Option<usize>,
    offset: Isometry3<f64>,
}

#[derive(Default)]
struct Reader {
    flat: Flat,
    /// Names of the geoms in `<pair>`s.
    paired: BTreeSet<String>,
    /// Placement of each MJCF body.
    placements: Vec<Placement>,
    bodies: Vec<Body>,
    hinges: Vec<Hinge>,
    root: Option<RootJoint>,
    floor: Option<Floor>,
    /// Parts of each rigid body's mass.
    parts: Vec<Vec<MassProperties>>,
    /// Contact parameters and MJCF body of each shape, as `[body][shape]`.
    rules: Vec<Vec<(ContactRules, usize)>>,
    shapes: usize,
    hull_vertices: usize,
    /// MJCF bodies that move.
    links: Vec<Link>,
    simplifications: Vec<String>,
}

impl Reader {
    /// Reads the geoms of static MJCF body number `index`. Only one floor may collide.
    fn read_static(
        &mut self,
        index: usize,
        body: &str,
        geoms: &[Geom],
        offset: &Isometry3<f64>,
    ) -> Result<(), ModelError> {
        for geom in geoms {
            let name = geom.name.as_deref().unwrap_or("geom");
            if !geoms::collides(geom, self.paired.contains(name)) {
                continue;
            }
            let floor = Floor::read(index, body, geom, offset, &self.flat)?;
            if self.floor.replace(floor).is_some() {
                return Err(ModelError::unsupported(name, "there may be only one floor"));
            }
        }
        Ok(())
    }

    fn read_body(
        &mut self,
        index: usize,
        parent: usize,
        body: &mjcf_rs::body::Body,
        compiler: &mjcf_rs::compiler::Compiler,
    ) -> Result<(), ModelError> {
        let name = body.name.clone().unwrap_or_default();
        let Placement { body: owner, offset } = self.placements[parent];
        let pose = offset * isometry(&body.pose);
        let placement = if body.joints.is_empty() {
            Placement { body: owner, offset: pose }
        } else {
            if owner.is_none() {
                self.read_root(&name, parent, &body.joints)?;
            }
            let jointed = self.read_joints(name.clone(), owner, pose, &body.joints, compiler.autolimits)?;
            self.bodies.push(jointed);
            self.parts.push(Vec::new());
            self.rules.push(Vec::new());
            Placement { body: Some(self.bodies.len() - 1), offset: Isometry3::identity() }
        };
        self.placements.push(placement);
        let Some(owner) = placement.body else {
            // MuJoCo would include it in the total.
            if compiler.set_total_mass > 0.0 && !(body.geoms.is_empty() && body.inertial.is_none()) {
                return Err(ModelError::unsupported(&name, "with settotalmass there may be no static body"));
            }
            return self.read_static(index, &format!("`{name}`"), &body.geoms, &placement.offset);
        };
        let first_shape = self.bodies[owner].shapes.len();
        let mut geom_masses = Vec::new();
        for geom in &body.geoms {
            let [first, last] = self.flat.inertia_groups;
            let counts = (first..=last).contains(&geom.group) && mass::uses_geoms(body.inertial.as_ref(), compiler);
            let geom_name = geom.name.as_deref().unwrap_or_default();
            let is_paired = self.paired.contains(geom_name);
            let (mass, shape) = geoms::read(geom, &placement.offset, counts, is_paired, &self.flat.assets)?;
            geom_masses.extend(mass);
            if let Some(shape) = shape {
                self.count(&shape)?;
                let rules = ContactRules::read(geom_name, geom.priority, self.flat.geom(geom_name))?;
                self.note_simplifications(geom, &shape);
                self.rules[owner].push((rules, index));
                self.bodies[owner].shapes.push(shape);
            }
        }
        let parts = mass::parts_of_body(&name, geom_masses, body.inertial.as_ref(), &placement.offset, compiler)?;
        let shapes = first_shape..self.bodies[owner].shapes.len();
        self.links.push(link(name, owner, placement.offset, shapes, &parts));
        self.parts[owner].extend(parts);
        Ok(())
    }

    /// Notes what a colliding shape does more simply than its geom.
    fn note_simplifications(&mut self, geom: &Geom, shape: &Shape) {
        if geom.condim > 3 {
            let note = format!(
                "geom `{}`: condim {} counts as 3, without torsional and rolling friction",
                shape.name, geom.condim
            );
            self.simplifications.push(note);
        }
        if matches!(shape.geometry, Geometry::Ellipsoid { .. }) {
            self.simplifications
                .push(format!("geom `{}`: the ellipsoid touches others as a hull of 146 points", shape.name));
        }
    }

    /// Refuses more shapes, or vertices of hulls, than supported.
    fn count(&mut self, shape: &Shape) -> Result<(), ModelError> {
        self.shapes += 1;
        if let Geometry::Hull { vertices_m } = &shape.geometry {
            self.hull_vertices += vertices_m.len();
        }
        for (count, most, what) in [
            (self.shapes, SHAPES_MAX, "colliding shapes"),
            (self.hull_vertices, HULL_VERTICES_MAX, "vertices of colliding meshes"),
        ] {
            if count > most {
                let problem = format!("there are more than {most} {what}; use fewer or simpler shapes");
                return Err(ModelError::unsupported(&shape.name, problem));
            }
        }
        Ok(())
    }

    fn read_root(&mut self, body: &str, parent: usize, joints: &[Joint]) -> Result<(), ModelError> {
        let [joint] = joints else {
            return Err(ModelError::unsupported(body, "the root must have one free joint and no other joint"));
        };
        if !matches!(joint.type_, JointType::Free) || parent != 0 {
            return Err(ModelError::unsupported(body, "the root, directly below the world, must have a free joint"));
        }
        if !self.bodies.is_empty() {
            return Err(ModelError::unsupported(body, "there may be only one root, above all other bodies"));
        }
        let attributes = self.flat.joint(joint.name.as_deref().unwrap_or_default());
        self.root = Some(joints::read_free(joint, attributes)?);
        Ok(())
    }

    /// Adds a body's hinges. Returns the body without shapes and mass.
    fn read_joints(
        &mut self,
        name: String,
        parent: Option<usize>,
        pose: Isometry3<f64>,
        joints: &[Joint],
        autolimits: bool,
    ) -> Result<Body, ModelError> {
        let first = self.hinges.len();
        if parent.is_some() {
            for joint in joints {
                let attributes = self.flat.joint(joint.name.as_deref().unwrap_or_default());
                self.hinges.push(joints::read_hinge(joint, attributes, autolimits)?);
            }
        }
        Ok(Body {
            name,
            parent,
            pose,
            hinges: first..self.hinges.len(),
            shapes: Vec::new(),
            mass_kg: 0.0,
            centre_of_mass_m: Point3::origin(),
            inertia_kgm2: Matrix3::zeros(),
        })
    }

    fn finish(mut self, source: &mjcf_rs::Model) -> Result<Model, ModelError> {
        let Some(root) = self.root.take() else {
            return Err(ModelError::unsupported("worldbody", "there must be a root body with a free joint"));
        };
        if let Some(body) = self.bodies.get(BODIES_MAX) {
            let problem =
                format!("there are {} moving bodies, but at most {BODIES_MAX} are supported", self.bodies.len());
            return Err(ModelError::unsupported(&body.name, problem));
        }
        if let Some(hinge) = self.hinges.get(HINGES_MAX) {
            let problem = format!("there are {} hinges, but at most {HINGES_MAX} are supported", self.hinges.len());
            return Err(ModelError::unsupported(&hinge.name, problem));
        }
        self.compute_masses(source.compiler.set_total_mass)?;
        let floor = match self.floor.take() {
            Some(floor) => floor,
            None => {
                self.simplifications
                    .push("no floor in the file: a level plane at z = 0 with friction 1 is added".to_owned());
                Floor::added()?
            }
        };
        let exclusions = Self::read_exclusions(source)?;
        let ground = Party { shape: &floor.shape, rules: &floor.rules, origin: floor.body };
        let contacts = pairs::Source {
            bodies: &self.bodies,
            rules: &self.rules,
            ground,
            exclusions: &exclusions,
            explicit: &self.flat.pairs,
        };
        let pairs = contacts.pairs()?;
        let rolling = |condim: &str| matches!(condim.trim(), "4" | "6");
        for (label, _) in self.flat.pairs.iter().filter(|(_, pair)| get(pair, "condim").is_some_and(rolling)) {
            let note = "its condim counts as 3, without torsional and rolling friction";
            self.simplifications.push(format!("{label}: {note}"));
        }
        let autolimits = source.compiler.autolimits;
        let tendons = tendon::read(&source.tendons, &self.flat.tendons, &self.hinges, autolimits)?;
        let motors = motors::read(&source.actuators, &self.flat.actuators, &self.hinges, autolimits)?;
        self.simplifications.extend(motors::shared_limits(&motors, &self.hinges));
        let mut model = Model {
            bodies: self.bodies,
            hinges: self.hinges,
            motors,
            links: self.links,
            tendons,
            pairs,
            root,
            keyframes: Vec::new(),
            gravity_mps2: Vector3::from(source.option.gravity),
            solver: self.flat.solver,
            robot: None,
            simplifications: self.simplifications,
            ground: floor.into_ground(),
        };
        motors::resolve_damping_ratios(&mut model)?;
        model.keyframes = keyframes::read(&model, &self.flat.keys)?;
        if let Some(card) = &self.flat.card {
            card.apply(&mut model)?;
        }
        Ok(model)
    }

    fn compute_masses(&mut self, total_kg: f64) -> Result<(), ModelError> {
        for (body, parts) in self.bodies.iter_mut().zip(&self.parts) {
            let mass =
                inertia::sum(parts).ok_or_else(|| ModelError::unsupported(&body.name, "a moving body needs mass"))?;
            body.mass_kg = mass.mass_kg;
            body.centre_of_mass_m = mass.centre_m;
            body.inertia_kgm2 = mass.inertia_kgm2;
            let least_kgm2 = body.inertia_kgm2.symmetric_eigenvalues().min();
            if !(least_kgm2.is_finite() && least_kgm2 > 0.0) {
                let wanted = "finite and above 0";
                return Err(ModelError::quantity(&body.name, "least principal inertia (kg·m²)", least_kgm2, wanted));
            }
        }
        if total_kg > 0.0 {
            let factor = total_kg / self.bodies.iter().map(|body| body.mass_kg).sum::<f64>();
            for body in &mut self.bodies {
                body.mass_kg *= factor;
                body.inertia_kgm2 *= factor;
            }
            for link in &mut self.links {
                link.mass_kg *= factor;
                link.inertia_kgm2 *= factor;
            }
        }
        Ok(())
    }

    /// Returns pairs of MJCF bodies that never touch.
    fn read_exclusions(source: &mjcf_rs::Model) -> Result<Vec<collision::Exclusion>, ModelError> {
        let find = |exclusion: &str, name: &str| match source.body_id_by_name(name) {
            Some(index) => Ok(index),
            None if name == "world" => Ok(0),
            None => Err(ModelError::unsupported(exclusion, format!("there is no body `{name}`"))),
        };
        let excludes = source.contact.excludes.iter();
        excludes
            .map(|exclude| {
                let label = exclude.name.as_deref().unwrap_or("exclude");
                Ok([find(label, &exclude.body1)?, find(label, &exclude.body2)?])
            })
            .collect()
    }
}

/// Returns the link of one MJCF body; `parts` are the parts of its mass.
fn link(name: String, body: usize, pose: Isometry3<f64>, shapes: Range<usize>, parts: &[MassProperties]) -> Link {
    let mass = inertia::sum(parts).unwrap_or(MassProperties {
        mass_kg: 0.0,
        centre_m: pose * Point3::origin(),
        inertia_kgm2: Matrix3::zeros(),
    });
    Link {
        name,
        body,
        pose,
        shapes,
        mass_kg: mass.mass_kg,
        centre_of_mass_m: mass.centre_m,
        inertia_kgm2: mass.inertia_kgm2,
    }
}

pub(super) fn isometry(pose: &mjcf_rs::Pose) -> Isometry3<f64> {
    let (t, r) = (pose.translation, pose.rotation);
    Isometry3::from_parts(
        Translation3::new(t.x, t.y, t.z),
        UnitQuaternion::new_normalize(Quaternion::new(r.w, r.x, r.y, r.z)),
    )
}
