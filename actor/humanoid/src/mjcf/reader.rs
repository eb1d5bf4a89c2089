//! Conversion of a tree to a [`Model`]; welded bodies are merged into rigid bodies.

use std::collections::BTreeSet;
use std::ops::Range;

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

use super::element::Element;
use super::equalities::EqualityReader;
use super::floor::Floor;
use super::pairs::{self, ContactRules, Exclusion, Party};
use super::tree::{self, BodyNode, Tree};
use super::{geoms, joints, keyframes, mass, motors, notices, tendons, xml};
use crate::error::ModelError;
use crate::model::inertia::{self, MassProperties};
use crate::model::{Body, Geometry, Hinge, Link, Model, RootJoint, Shape};

/// Most rigid bodies.
const BODIES_MAX: usize = 512;
/// Most hinges.
const HINGES_MAX: usize = 1024;
/// Most colliding shapes, so that all pairs of them can be compared.
const SHAPES_MAX: usize = 4096;
/// Most bodies of a text, and most geoms, whether they collide or not.
const ALL_BODIES_MAX: usize = 4096;
const GEOMS_MAX: usize = 8192;
/// Most vertices of all hulls.
const HULL_VERTICES_MAX: usize = 1 << 16;

/// Reads and checks a model text.
pub(super) fn read(text: &str) -> Result<Model, ModelError> {
    let document = xml::parse_model(text)?;
    let tree = tree::read(&document)?;
    check_size(&tree.bodies)?;
    let mut reader = Reader::new(&tree);
    reader.simplifications = notices::of(&document);
    for (index, body) in tree.bodies.iter().enumerate() {
        reader.read_body(index, body)?;
    }
    reader.finish()
}

/// Refuses texts that would take minutes to read.
fn check_size(bodies: &[BodyNode]) -> Result<(), ModelError> {
    let geoms = bodies.iter().map(|body| body.geoms.len()).sum();
    for (count, most, what) in
        [(bodies.len(), ALL_BODIES_MAX, "bodies, static ones included"), (geoms, GEOMS_MAX, "geoms")]
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

struct Reader<'a> {
    tree: &'a Tree,
    /// Names of the geoms in `<pair>`s.
    paired: BTreeSet<&'a str>,
    /// Placement of each MJCF body.
    placements: Vec<Placement>,
    bodies: Vec<Body>,
    hinges: Vec<Hinge>,
    root: Option<RootJoint>,
    /// Where the root is at the position 0 of the text (m).
    root_place_m: Vector3<f64>,
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

impl<'a> Reader<'a> {
    fn new(tree: &'a Tree) -> Self {
        let sides = tree.pairs.iter().flat_map(|pair| [pair.get("geom1"), pair.get("geom2")]);
        Self {
            tree,
            paired: sides.flatten().collect(),
            placements: Vec::new(),
            bodies: Vec::new(),
            hinges: Vec::new(),
            root: None,
            root_place_m: Vector3::zeros(),
            floor: None,
            parts: Vec::new(),
            rules: Vec::new(),
            shapes: 0,
            hull_vertices: 0,
            links: Vec::new(),
            simplifications: Vec::new(),
        }
    }

    fn read_body(&mut self, index: usize, body: &BodyNode) -> Result<(), ModelError> {
        let name = &body.name;
        let placement = self.place(index, body)?;
        self.placements.push(placement);
        let Some(owner) = placement.body else {
            // MuJoCo would include it in the total.
            let is_empty = body.geoms.is_empty() && body.inertial.is_none();
            if self.tree.compiler.total_mass_kg > 0.0 && index > 0 && !is_empty {
                return Err(ModelError::unsupported(name, "with settotalmass there may be no static body"));
            }
            return self.read_static(index, body, &placement.offset);
        };
        let compiler = &self.tree.compiler;
        let first_shape = self.bodies[owner].shapes.len();
        let mut geom_masses = Vec::new();
        for (geom, pose) in &body.geoms {
            let [first, last] = compiler.inertia_groups;
            let counts = (first..=last).contains(&geom.whole("group", 0)?) && mass::uses_geoms(body, compiler);
            let is_paired = self.paired.contains(geom.label.as_str());
            let pose = pose.isometry();
            let (mass, shape) = geoms::read(geom, &placement.offset, &pose, counts, is_paired, &self.tree.assets)?;
            geom_masses.extend(mass);
            if let Some(shape) = shape {
                self.count(&shape)?;
                self.note_simplifications(geom, &shape)?;
                self.rules[owner].push((ContactRules::read(geom)?, index));
                self.bodies[owner].shapes.push(shape);
            }
        }
        let parts = mass::parts_of_body(body, geom_masses, &placement.offset, compiler)?;
        if body.gravity_compensation != self.bodies[owner].gravity_compensation && !parts.is_empty() {
            let problem = "bodies that are welded together must have the same `gravcomp`";
            return Err(ModelError::unsupported(name, problem));
        }
        let shapes = first_shape..self.bodies[owner].shapes.len();
        self.links.push(link(name.clone(), owner, placement.offset, shapes, &parts));
        self.parts[owner].extend(parts);
        Ok(())
    }

    /// Returns where a body belongs; one with joints becomes a rigid body.
    fn place(&mut self, index: usize, body: &BodyNode) -> Result<Placement, ModelError> {
        if index == 0 {
            return Ok(Placement { body: None, offset: Isometry3::identity() });
        }
        let Placement { body: parent, offset } = self.placements[body.parent];
        let mut pose = offset * body.pose.isometry();
        if body.joints.is_empty() {
            return Ok(Placement { body: parent, offset: pose });
        }
        let first = self.hinges.len();
        if parent.is_none() {
            self.root = Some(self.read_root(body)?);
        } else {
            for (joint, frame) in &body.joints {
                self.hinges.push(joints::read_hinge(joint, frame, &self.tree.compiler)?);
            }
            pose *= joints::from_nominal(&self.hinges[first..])?;
        }
        self.bodies.push(Body {
            name: body.name.clone(),
            parent,
            pose,
            hinges: first..self.hinges.len(),
            shapes: Vec::new(),
            mass_kg: 0.0,
            centre_of_mass_m: Point3::origin(),
            inertia_kgm2: Matrix3::zeros(),
            gravity_compensation: body.gravity_compensation,
        });
        self.parts.push(Vec::new());
        self.rules.push(Vec::new());
        Ok(Placement { body: Some(self.bodies.len() - 1), offset: Isometry3::identity() })
    }

    fn read_root(&mut self, body: &BodyNode) -> Result<RootJoint, ModelError> {
        let refuse = |problem: &str| Err(ModelError::unsupported(&body.name, problem));
        if !self.bodies.is_empty() {
            return refuse("there may be only one root, above all other bodies");
        }
        if body.parent == 0 && joints::are_free(body) {
            let place = body.pose.isometry().translation.vector;
            self.root_place_m = place;
            self.simplifications.push(format!(
                "root `{}`: its slides and ball count as a free joint, whose place is {:?} in the pose of the text, not 0",
                body.name,
                place.as_slice()
            ));
            return Ok(RootJoint::default());
        }
        let [(joint, _)] = &body.joints[..] else {
            return refuse("the root must have one free joint and no other joint; give it <freejoint/> instead");
        };
        if !joints::is_free(joint) || body.parent != 0 {
            return refuse("the root, directly below the world, must have a free joint");
        }
        joints::read_free(joint)
    }

    /// Reads the geoms of a static body. Only one floor may collide.
    fn read_static(&mut self, index: usize, body: &BodyNode, offset: &Isometry3<f64>) -> Result<(), ModelError> {
        for (geom, pose) in &body.geoms {
            if !geoms::collides(geom, self.paired.contains(geom.label.as_str()))? {
                continue;
            }
            let owner = if index == 0 { "the world".to_owned() } else { format!("`{}`", body.name) };
            let floor = Floor::read(index, &owner, geom, &(offset * pose.isometry()), &self.tree.assets)?;
            if self.floor.replace(floor).is_some() {
                return Err(geom.refused("there may be only one floor"));
            }
        }
        Ok(())
    }

    /// Notes what a colliding shape does more simply than its geom.
    fn note_simplifications(&mut self, geom: &Element, shape: &Shape) -> Result<(), ModelError> {
        let condim = geom.whole("condim", 3)?;
        if condim > 3 {
            let note =
                format!("geom `{}`: condim {condim} counts as 3, without torsional and rolling friction", shape.name);
            self.simplifications.push(note);
        }
        if matches!(shape.geometry, Geometry::Ellipsoid { .. }) {
            self.simplifications
                .push(format!("geom `{}`: the ellipsoid touches others as a hull of 146 points", shape.name));
        }
        Ok(())
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

    fn finish(mut self) -> Result<Model, ModelError> {
        let (tree, autolimits) = (self.tree, self.tree.compiler.autolimits);
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
        self.compute_masses(tree.compiler.total_mass_kg)?;
        let floor = match self.floor.take() {
            Some(floor) => floor,
            None => {
                self.simplifications
                    .push("no floor in the file: a level plane at z = 0 with friction 1 is added".to_owned());
                Floor::added()
            }
        };
        let exclusions = self.read_exclusions()?;
        let ground = Party { shape: &floor.shape, rules: &floor.rules, origin: floor.body };
        let contacts = pairs::Source {
            bodies: &self.bodies,
            rules: &self.rules,
            ground,
            exclusions: &exclusions,
            explicit: &tree.pairs,
        };
        let pairs = contacts.pairs()?;
        for pair in tree.pairs.iter().filter(|pair| matches!(pair.get("condim").map(str::trim), Some("4" | "6"))) {
            let note = "its condim counts as 3, without torsional and rolling friction";
            self.simplifications.push(format!("{}: {note}", pair.label));
        }
        let offsets: Vec<_> = self.placements.iter().map(|placed| placed.body.map(|_| placed.offset)).collect();
        let parts = EqualityReader { tree, hinges: &self.hinges, links: &self.links, offsets: &offsets };
        let (couplings, connections) = parts.read()?;
        let tendons = tendons::read(&tree.tendons, &self.hinges, autolimits)?;
        let motors = tree.actuators.iter().map(|actuator| motors::read(actuator, &self.hinges, autolimits));
        let motors = motors.collect::<Result<Vec<_>, _>>()?;
        self.simplifications.extend(motors::shared_limits(&motors, &self.hinges));
        let mut model = Model {
            bodies: self.bodies,
            hinges: self.hinges,
            motors,
            links: self.links,
            tendons,
            couplings,
            connections,
            pairs,
            root,
            keyframes: Vec::new(),
            gravity_mps2: tree.gravity_mps2,
            solver: tree.solver,
            robot: None,
            motions: Vec::new().into(),
            simplifications: self.simplifications,
            ground: floor.into_ground(),
        };
        for (actuator, motor) in tree.actuators.iter().zip(&model.motors) {
            motors::add_rotor(actuator, motor, &mut model.hinges[motor.hinge])?;
        }
        let joints = tree.bodies.iter().flat_map(|body| &body.joints).map(|(joint, _)| joint);
        joints::resolve_spring_dampers(joints, &mut model);
        motors::resolve_damping_ratios(&mut model)?;
        model.keyframes = keyframes::read(&model, &tree.keys, self.root_place_m)?;
        if let Some(card) = &tree.card {
            card.apply(&mut model)?;
        }
        let names: Vec<String> = model.hinges.iter().map(|hinge| hinge.name.clone()).collect();
        let motions = tree.motions.iter().map(|motion| motion.in_order_of(&names));
        model.motions = motions.collect::<Result<_, _>>().map_err(|why| ModelError::Motion(why.to_string()))?;
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
                let problem = format!(
                    "its least principal inertia is {least_kgm2} kg·m², but must be finite and above 0; correct it, or set \
                     boundinertia=\"1e-5\" in <compiler>"
                );
                return Err(ModelError::unsupported(&body.name, problem));
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
    fn read_exclusions(&self) -> Result<Vec<Exclusion>, ModelError> {
        let find = |exclusion: &Element, side: &str| {
            let name = exclusion.get(side).unwrap_or_default();
            let found = self.tree.bodies.iter().skip(1).position(|body| body.name == name).map(|index| index + 1);
            let found = found.or((name == "world").then_some(0));
            found.ok_or_else(|| exclusion.refused(format!("there is no body `{name}`")))
        };
        self.tree.exclusions.iter().map(|exclude| Ok([find(exclude, "body1")?, find(exclude, "body2")?])).collect()
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
