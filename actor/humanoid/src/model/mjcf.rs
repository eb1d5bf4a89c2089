//! From MJCF text to a [`Model`]: what is read, what is merged, what is refused.

use std::ops::Range;

use mjcf_rs::body::{Geom, GeomType, Joint, JointType};
use mjcf_rs::extras::ActuatorKind;
use nalgebra::{Isometry3, Matrix3, Point3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

use super::{Body, Hinge, Link, Model, Motor, Shape, inertia, tendon};
use crate::error::ModelError;

/// More bodies than this do not fit the collision groups: one bit each, and one for the floor.
const BODIES_MAX: usize = 31;
/// How far from perpendicular two neighbouring hinge axes may be (cosine).
const AXIS_COSINE_MAX: f64 = 1e-3;

/// Reads and checks a model text.
pub(super) fn read(text: &str) -> Result<Model, ModelError> {
    // A model may come from another machine, and the parser would open included files.
    if text.contains("<include") {
        return Err(ModelError::unsupported("include", "a model must be one text; paste the included file into it"));
    }
    let source = mjcf_rs::Model::from_str(text, ".").map_err(ModelError::Parse)?;
    let mut reader = Reader::default();
    for (index, entry) in source.bodies.iter().enumerate() {
        match entry.parent {
            None => reader.read_world(&entry.body.geoms)?,
            Some(parent) => reader.read_body(index, parent, &entry.body, &source.compiler)?,
        }
    }
    let tendons = tendon::read(text, &source, &reader.hinges)?;
    Ok(Model { tendons, ..reader.finish(&source)? })
}

/// Where a body of the text ended up: in which of our bodies, and at which pose inside it.
#[derive(Clone, Copy)]
struct Place {
    body: Option<usize>,
    offset: Isometry3<f64>,
}

#[derive(Default)]
struct Reader {
    places: Vec<Place>,
    bodies: Vec<Body>,
    hinges: Vec<Hinge>,
    links: Vec<Link>,
    floor_friction: Option<f64>,
}

impl Reader {
    fn read_world(&mut self, geoms: &[Geom]) -> Result<(), ModelError> {
        for geom in geoms {
            let name = geom.name.as_deref().unwrap_or("geom of the world");
            let pose = isometry(&geom.pose);
            let up = pose.rotation * Vector3::z();
            if !matches!(geom.type_, GeomType::Plane) || pose.translation.z.abs() > 1e-9 || up.z < 1.0 - 1e-9 {
                return Err(ModelError::unsupported(name, "the world may hold only a level plane at z = 0"));
            }
            self.floor_friction = Some(positive(name, "friction", geom.friction[0])?);
        }
        self.places.push(Place { body: None, offset: Isometry3::identity() });
        Ok(())
    }

    fn read_body(
        &mut self,
        index: usize,
        parent: usize,
        body: &mjcf_rs::body::Body,
        compiler: &mjcf_rs::compiler::Compiler,
    ) -> Result<(), ModelError> {
        let name = body.name.clone().unwrap_or_else(|| format!("body {index}"));
        if body.inertial.is_some() {
            return Err(ModelError::unsupported(&name, "give densities instead of <inertial>"));
        }
        let Place { body: parent, offset } = self.places[parent];
        let pose = offset * isometry(&body.pose);
        let place = if body.joints.is_empty() {
            Place { body: parent, offset: pose }
        } else {
            let joints = self.read_joints(&name, parent.is_none(), &body.joints, compiler)?;
            self.bodies.push(Body {
                name: name.clone(),
                parent,
                pose,
                shapes: Vec::new(),
                mass_kg: 0.0,
                centre_of_mass_m: Point3::origin(),
                inertia_kgm2: Matrix3::zeros(),
                ..joints
            });
            Place { body: Some(self.bodies.len() - 1), offset: Isometry3::identity() }
        };
        self.places.push(place);
        let Some(owner) = place.body else {
            return Err(ModelError::unsupported(&name, "the first body needs a free joint"));
        };
        let first_shape = self.bodies[owner].shapes.len();
        for geom in &body.geoms {
            let shape = read_shape(geom, &name, &place.offset, compiler.inertia_density)?;
            self.bodies[owner].shapes.push(shape);
        }
        let shapes = first_shape..self.bodies[owner].shapes.len();
        self.links.push(link(name, owner, place.offset, shapes, &self.bodies[owner].shapes));
        Ok(())
    }

    /// Adds a body's hinges and returns a body that carries only their figures.
    fn read_joints(
        &mut self,
        body: &str,
        is_root: bool,
        joints: &[Joint],
        compiler: &mjcf_rs::compiler::Compiler,
    ) -> Result<Body, ModelError> {
        let first = self.hinges.len();
        let mut anchor_m = Point3::origin();
        if is_root {
            let free = matches!(joints, [joint] if matches!(joint.type_, JointType::Free));
            if !free || !self.bodies.is_empty() {
                return Err(ModelError::unsupported(body, "there must be one root body with one free joint"));
            }
        } else {
            anchor_m = Point3::from(joints[0].pos);
            if joints.len() > 3 || joints.iter().any(|joint| Point3::from(joint.pos) != anchor_m) {
                return Err(ModelError::unsupported(body, "a body takes at most three hinges, all at one point"));
            }
            for joint in joints {
                self.hinges.push(read_hinge(joint, body, compiler.autolimits)?);
            }
        }
        let hinge_frame = orient_chain(body, &mut self.hinges[first..])?;
        Ok(Body {
            name: String::new(),
            parent: None,
            pose: Isometry3::identity(),
            anchor_m,
            hinges: first..self.hinges.len(),
            hinge_frame,
            shapes: Vec::new(),
            mass_kg: 0.0,
            centre_of_mass_m: Point3::origin(),
            inertia_kgm2: Matrix3::zeros(),
        })
    }

    fn finish(mut self, source: &mjcf_rs::Model) -> Result<Model, ModelError> {
        if self.bodies.is_empty() || self.bodies.len() > BODIES_MAX {
            return Err(ModelError::unsupported(
                "worldbody",
                format!("there must be 1 to {BODIES_MAX} jointed bodies"),
            ));
        }
        for body in &mut self.bodies {
            let mass = inertia::of_shapes(&body.shapes)
                .ok_or_else(|| ModelError::unsupported(&body.name, "a body that moves needs mass"))?;
            body.mass_kg = mass.mass_kg;
            body.centre_of_mass_m = mass.centre_m;
            body.inertia_kgm2 = mass.inertia_kgm2;
        }
        let (motors, control_limit) = read_motors(source, &self.hinges)?;
        Ok(Model {
            bodies: self.bodies,
            hinges: self.hinges,
            motors,
            links: self.links,
            tendons: Vec::new(),
            control_limit,
            floor_friction: self
                .floor_friction
                .ok_or_else(|| ModelError::unsupported("worldbody", "a floor is needed: a plane at z = 0"))?,
            gravity_mps2: Vector3::from(source.option.gravity),
        })
    }
}

/// The part of a rigid body that one body of the text makes; `all` are the rigid body's shapes so far.
fn link(name: String, body: usize, pose: Isometry3<f64>, shapes: Range<usize>, all: &[Shape]) -> Link {
    let mass = inertia::of_shapes(&all[shapes.clone()]).unwrap_or(inertia::MassProperties {
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

fn read_shape(geom: &Geom, body: &str, offset: &Isometry3<f64>, density: f64) -> Result<Shape, ModelError> {
    let name = geom.name.as_deref().unwrap_or(body);
    let radius_m = positive(name, "radius (m)", geom.size[0])?;
    let (from, to) = match (&geom.type_, geom.fromto) {
        (GeomType::Sphere, _) => (Point3::origin(), Point3::origin()),
        (GeomType::Capsule, Some([ax, ay, az, bx, by, bz])) => (Point3::new(ax, ay, az), Point3::new(bx, by, bz)),
        (GeomType::Capsule, None) => (Point3::new(0.0, 0.0, -geom.size[1]), Point3::new(0.0, 0.0, geom.size[1])),
        _ => return Err(ModelError::unsupported(name, "shapes must be spheres or capsules")),
    };
    if geom.mass.is_some() {
        return Err(ModelError::unsupported(name, "give a density instead of a mass"));
    }
    // The ends of a `fromto` capsule are in the body's frame already.
    let place = if geom.fromto.is_some() { *offset } else { offset * isometry(&geom.pose) };
    let density_kgpm3 = geom.density.unwrap_or(density);
    if !(density_kgpm3.is_finite() && density_kgpm3 >= 0.0) {
        return Err(figure(name, "density (kg/m³)", density_kgpm3, "finite and not negative"));
    }
    Ok(Shape { from_m: place * from, to_m: place * to, radius_m, density_kgpm3 })
}

fn read_hinge(joint: &Joint, body: &str, autolimits: bool) -> Result<Hinge, ModelError> {
    let name = joint.name.clone().unwrap_or_else(|| format!("joint of {body}"));
    if !matches!(joint.type_, JointType::Hinge) {
        return Err(ModelError::unsupported(&name, "joints must be hinges"));
    }
    if joint.ref_ != 0.0 || joint.frictionloss != 0.0 || joint.springdamper.is_some() {
        return Err(ModelError::unsupported(&name, "`ref`, `frictionloss` and `springdamper` are not simulated"));
    }
    let axis = Unit::try_new(Vector3::from(joint.axis), 1e-6)
        .ok_or_else(|| ModelError::unsupported(&name, "the axis must not be zero"))?;
    let (min_rad, max_rad) = match joint.range {
        Some([min, max]) if joint.limited.resolve(autolimits, true) => (min, max),
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    };
    if min_rad.is_nan() || max_rad.is_nan() || min_rad >= max_rad {
        return Err(figure(&name, "lower end of the range (rad)", min_rad, "below the upper end"));
    }
    for (what, value) in [
        ("stiffness (N·m/rad)", joint.stiffness),
        ("damping (N·m·s/rad)", joint.damping),
        ("armature (kg·m²)", joint.armature),
    ] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(figure(&name, what, value, "finite and not negative"));
        }
    }
    Ok(Hinge {
        name,
        axis,
        frame_sign: 1.0,
        min_rad,
        max_rad,
        stiffness_nmprad: joint.stiffness,
        rest_rad: joint.springref,
        damping_nmsprad: joint.damping,
        armature_kgm2: joint.armature,
    })
}

/// The right-handed triad of a chain; a third axis that points against it gets `frame_sign` −1.
fn orient_chain(body: &str, hinges: &mut [Hinge]) -> Result<UnitQuaternion<f64>, ModelError> {
    let Some(first) = hinges.first().map(|hinge| hinge.axis.into_inner()) else {
        return Ok(UnitQuaternion::identity());
    };
    let second = match hinges.get(1) {
        Some(hinge) => hinge.axis.into_inner(),
        // Any direction across a single hinge will do; take the coordinate axis farthest from it.
        None => {
            let across = Vector3::ith(first.iamin(), 1.0);
            (across - first * first.dot(&across)).normalize()
        }
    };
    let third = first.cross(&second);
    let skew = first.dot(&second).abs();
    let third_skew = hinges.get(2).map_or(0.0, |hinge| 1.0 - hinge.axis.dot(&third).abs());
    if skew > AXIS_COSINE_MAX || third_skew > AXIS_COSINE_MAX {
        return Err(ModelError::unsupported(body, "hinges of one body must be perpendicular to each other"));
    }
    if let Some(hinge) = hinges.get_mut(2) {
        hinge.frame_sign = hinge.axis.dot(&third).signum();
    }
    let frame = Matrix3::from_columns(&[first, second, third]);
    Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix(&frame)))
}

fn read_motors(source: &mjcf_rs::Model, hinges: &[Hinge]) -> Result<(Vec<Motor>, f64), ModelError> {
    let mut motors = Vec::with_capacity(source.actuators.len());
    let mut limit: Option<f64> = None;
    for actuator in &source.actuators {
        let name = actuator.name.clone().or_else(|| actuator.joint.clone()).unwrap_or_default();
        if actuator.kind != ActuatorKind::Motor {
            return Err(ModelError::unsupported(&name, "actuators must be motors"));
        }
        let hinge = hinges
            .iter()
            .position(|hinge| Some(hinge.name.as_str()) == actuator.joint.as_deref())
            .ok_or_else(|| ModelError::unsupported(&name, "the motor names no hinge of this model"))?;
        let [low, high] =
            actuator.ctrl_range.ok_or_else(|| ModelError::unsupported(&name, "the motor needs a control range"))?;
        if low != -high || !(high.is_finite() && high > 0.0) || limit.is_some_and(|limit| limit != high) {
            return Err(ModelError::unsupported(&name, "all motors need one symmetric control range"));
        }
        limit = Some(high);
        let gear_nm = actuator.gear[0];
        if !gear_nm.is_finite() {
            return Err(figure(&name, "gear (N·m)", gear_nm, "finite"));
        }
        motors.push(Motor { name, hinge, gear_nm });
    }
    let limit = limit.ok_or_else(|| ModelError::unsupported("actuator", "at least one motor is needed"))?;
    Ok((motors, limit))
}

fn isometry(pose: &mjcf_rs::Pose) -> Isometry3<f64> {
    let (t, r) = (pose.translation, pose.rotation);
    Isometry3::from_parts(
        Translation3::new(t.x, t.y, t.z),
        UnitQuaternion::new_normalize(Quaternion::new(r.w, r.x, r.y, r.z)),
    )
}

fn positive(element: &str, what: &'static str, value: f64) -> Result<f64, ModelError> {
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err(figure(element, what, value, "finite and above 0")) }
}

fn figure(element: &str, figure: &'static str, value: f64, expected: &'static str) -> ModelError {
    ModelError::Figure { element: element.to_owned(), figure, value, expected }
}
