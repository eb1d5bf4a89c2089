//! Conversion of MJCF text to a [`Model`]; welded bodies are merged into rigid bodies.

use std::ops::Range;

use mjcf_rs::body::{Geom, GeomType, Joint, JointType};
use nalgebra::{Isometry3, Matrix3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::flatten::{Flat, flatten};
use super::inertia::MassProperties;
use super::{Body, Geometry, Hinge, Link, Model, Shape, collision, geoms, inertia, joints, mass, motors, tendon};
use crate::error::ModelError;

/// Most rigid bodies: the collision groups have one bit for each, and one for the floor.
const BODIES_MAX: usize = 31;

/// Reads and checks a model text.
pub(super) fn read(text: &str) -> Result<Model, ModelError> {
    let flat = flatten(text)?;
    let source = mjcf_rs::Model::from_str(&flat.text, ".").map_err(ModelError::Parse)?;
    let mut reader = Reader { flat, ..Reader::default() };
    for (index, entry) in source.bodies.iter().enumerate() {
        match entry.parent {
            None => {
                reader.placements.push(Placement { body: None, offset: Isometry3::identity() });
                reader.read_world("the world", &entry.body.geoms, &Isometry3::identity())?;
            }
            Some(parent) => reader.read_body(index, parent, &entry.body, &source.compiler)?,
        }
    }
    reader.finish(&source)
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
    /// Placement of each MJCF body.
    placements: Vec<Placement>,
    bodies: Vec<Body>,
    hinges: Vec<Hinge>,
    floor: Option<Shape>,
    /// Parts of each rigid body's mass.
    parts: Vec<Vec<MassProperties>>,
    /// MJCF body of each shape, as `[body][shape]`.
    origins: Vec<Vec<usize>>,
    /// MJCF bodies that move.
    links: Vec<Link>,
}

impl Reader {
    /// Reads the geoms of a static body. Only a level floor may collide.
    fn read_world(&mut self, body: &str, geoms: &[Geom], offset: &Isometry3<f64>) -> Result<(), ModelError> {
        for geom in geoms.iter().filter(|geom| geom.contype != 0 || geom.conaffinity != 0) {
            let name = geom.name.as_deref().unwrap_or("geom");
            let pose = offset * isometry(&geom.pose);
            let up = pose.rotation * Vector3::z();
            if !matches!(geom.type_, GeomType::Plane) || pose.translation.z.abs() > 1e-9 || up.z < 1.0 - 1e-9 {
                let problem = format!(
                    "it belongs to {body}, which is static, but only a level plane at z = 0 may collide there; a robot's \
                     root needs a free joint"
                );
                return Err(ModelError::unsupported(name, problem));
            }
            if self.floor.is_some() {
                return Err(ModelError::unsupported(name, "there may be only one floor"));
            }
            let point = Geometry::Sphere { centre_m: Point3::origin(), radius_m: 0.0 };
            self.floor = Some(geoms::collision_shape(name, geom, point)?);
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
                self.check_root(&name, parent, &body.joints)?;
            }
            let jointed = self.read_joints(name.clone(), owner, pose, &body.joints, compiler.autolimits)?;
            self.bodies.push(jointed);
            self.parts.push(Vec::new());
            self.origins.push(Vec::new());
            Placement { body: Some(self.bodies.len() - 1), offset: Isometry3::identity() }
        };
        self.placements.push(placement);
        let Some(owner) = placement.body else {
            // MuJoCo would include it in the total.
            if compiler.set_total_mass > 0.0 && !(body.geoms.is_empty() && body.inertial.is_none()) {
                return Err(ModelError::unsupported(&name, "with settotalmass there may be no static body"));
            }
            return self.read_world(&format!("`{name}`"), &body.geoms, &placement.offset);
        };
        let first_shape = self.bodies[owner].shapes.len();
        let mut geom_masses = Vec::new();
        for geom in &body.geoms {
            let [first, last] = self.flat.inertia_groups;
            let counts = (first..=last).contains(&geom.group) && mass::uses_geoms(body.inertial.as_ref(), compiler);
            let (mass, shape) = geoms::read(geom, &placement.offset, counts)?;
            geom_masses.extend(mass);
            if let Some(shape) = shape {
                self.bodies[owner].shapes.push(shape);
                self.origins[owner].push(index);
            }
        }
        let parts = mass::parts_of_body(&name, geom_masses, body.inertial.as_ref(), &placement.offset, compiler)?;
        let shapes = first_shape..self.bodies[owner].shapes.len();
        self.links.push(link(name, owner, placement.offset, shapes, &parts));
        self.parts[owner].extend(parts);
        Ok(())
    }

    fn check_root(&self, body: &str, parent: usize, joints: &[Joint]) -> Result<(), ModelError> {
        let [joint] = joints else {
            return Err(ModelError::unsupported(body, "the root must have one free joint and no other joint"));
        };
        if !matches!(joint.type_, JointType::Free) || parent != 0 {
            return Err(ModelError::unsupported(body, "the root, directly below the world, must have a free joint"));
        }
        if !self.bodies.is_empty() {
            return Err(ModelError::unsupported(body, "there may be only one root, above all other bodies"));
        }
        joints::check_free(joint)
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
        let mut anchor_m = Point3::origin();
        if parent.is_some() {
            anchor_m = Point3::from(joints[0].pos);
            if joints.iter().any(|joint| Point3::from(joint.pos) != anchor_m) {
                return Err(ModelError::unsupported(&name, "all hinges of a body must be at one point"));
            }
            for joint in joints {
                let torque_nm = joint.name.as_ref().and_then(|joint| self.flat.torque_ranges.get(joint)).copied();
                self.hinges.push(joints::read_hinge(joint, autolimits, torque_nm)?);
            }
        }
        Ok(Body {
            name,
            parent,
            pose,
            anchor_m,
            hinges: first..self.hinges.len(),
            shapes: Vec::new(),
            mass_kg: 0.0,
            centre_of_mass_m: Point3::origin(),
            inertia_kgm2: Matrix3::zeros(),
        })
    }

    fn finish(mut self, source: &mjcf_rs::Model) -> Result<Model, ModelError> {
        if self.bodies.is_empty() {
            return Err(ModelError::unsupported("worldbody", "there must be a root body with a free joint"));
        }
        if self.bodies.len() > BODIES_MAX {
            let problem =
                format!("there are {} moving bodies, but at most {BODIES_MAX} are supported", self.bodies.len());
            return Err(ModelError::unsupported(&self.bodies[BODIES_MAX].name, problem));
        }
        self.compute_masses(source.compiler.set_total_mass)?;
        let floor = self
            .floor
            .take()
            .ok_or_else(|| ModelError::unsupported("worldbody", "a floor is needed: a plane at z = 0 that collides"))?;
        let exclusions = self.read_exclusions(source)?;
        let collision_masks = collision::assign_groups(&mut self.bodies, &self.origins, &floor, &exclusions)?;
        let tendons = tendon::read(&source.tendons, &self.hinges)?;
        let motors = motors::read(&source.actuators, &self.hinges, &source.compiler)?;
        Ok(Model {
            bodies: self.bodies,
            hinges: self.hinges,
            motors,
            links: self.links,
            tendons,
            collision_masks,
            floor_friction: if floor.has_friction { floor.friction } else { 0.0 },
            floor_margin_m: floor.margin_m,
            gravity_mps2: Vector3::from(source.option.gravity),
        })
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
    fn read_exclusions(&self, source: &mjcf_rs::Model) -> Result<Vec<collision::Exclusion>, ModelError> {
        let find = |exclusion: &str, name: &str| match source.body_id_by_name(name) {
            // A static body counts as the world.
            Some(index) => Ok(self.placements[index].body.map(|_| index)),
            None if name == "world" => Ok(None),
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
