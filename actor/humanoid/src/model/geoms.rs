//! Geoms: their masses and their collision shapes.

use mjcf_rs::body::{Geom, GeomType};
use nalgebra::{Isometry3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::inertia::{self, MassProperties};
use super::mjcf::isometry;
use super::{Geometry, Shape};
use crate::error::ModelError;

/// Largest margin (m); a greater one would be a visible gap.
const MARGIN_MAX_M: f64 = 0.01;

/// Reads a geom of a body: its mass if it has one, and its shape if it can collide.
///
/// `offset` is the pose of the MJCF body within its rigid body.
pub(super) fn read(
    geom: &Geom,
    offset: &Isometry3<f64>,
    counts_for_mass: bool,
) -> Result<(Option<MassProperties>, Option<Shape>), ModelError> {
    let name = geom.name.as_deref().unwrap_or("geom");
    let collides = geom.contype != 0 || geom.conaffinity != 0;
    let density_kgpm3 = not_negative(name, "density (kg/m³)", geom.density.unwrap_or(inertia::WATER_KGPM3))?;
    let mass_kg = geom.mass.map(|mass_kg| not_negative(name, "mass (kg)", mass_kg)).transpose()?;
    let weightless = mass_kg.map_or(density_kgpm3 == 0.0, |mass_kg| mass_kg == 0.0) || !counts_for_mass;
    let Some(geometry) = geometry(name, geom, offset)? else {
        if collides {
            let what = describe(geom);
            let problem = format!("{what} cannot collide; use primitive shapes, or contype=\"0\" conaffinity=\"0\"");
            return Err(ModelError::unsupported(name, problem));
        }
        if weightless {
            return Ok((None, None));
        }
        let problem = format!("the mass of {} is unknown; give the body an <inertial>", describe(geom));
        return Err(ModelError::unsupported(name, problem));
    };
    let mass = (!weightless).then(|| match mass_kg {
        // A density of 1 kg/m³ gives the volume.
        Some(mass_kg) => inertia::of_geometry(&geometry, mass_kg / inertia::of_geometry(&geometry, 1.0).mass_kg),
        None => inertia::of_geometry(&geometry, density_kgpm3),
    });
    if !collides {
        return Ok((mass, None));
    }
    if matches!(geometry, Geometry::Ellipsoid { .. }) {
        return Err(ModelError::unsupported(name, "ellipsoids cannot collide; use a capsule or a box"));
    }
    Ok((mass, Some(collision_shape(name, geom, geometry)?)))
}

/// Reads the collision shape of a geom.
pub(super) fn collision_shape(name: &str, geom: &Geom, geometry: Geometry) -> Result<Shape, ModelError> {
    if !(0.0..=MARGIN_MAX_M).contains(&geom.margin) {
        return Err(ModelError::quantity(name, "margin (m)", geom.margin, "between 0 and 0.01"));
    }
    let has_friction = match geom.condim {
        1 => false,
        3 => true,
        other => {
            let problem = "1 or 3: torsional and rolling friction are not simulated";
            return Err(ModelError::attribute(name, "condim", &other.to_string(), problem));
        }
    };
    let friction = not_negative(name, "friction", geom.friction[0])?;
    Ok(Shape {
        name: name.to_owned(),
        geometry,
        friction,
        has_friction,
        margin_m: geom.margin,
        contype: geom.contype,
        conaffinity: geom.conaffinity,
        group: 0,
    })
}

fn describe(geom: &Geom) -> String {
    match (&geom.type_, &geom.mesh, &geom.hfield) {
        (GeomType::Hfield, _, Some(name)) => format!("height field `{name}`"),
        (_, Some(name), _) => format!("mesh `{name}`"),
        (kind, ..) => format!("a geom of type {}", format!("{kind:?}").to_lowercase()),
    }
}

/// Returns the geometry in the rigid body's frame; `None` for meshes, height fields and distance fields.
fn geometry(name: &str, geom: &Geom, offset: &Isometry3<f64>) -> Result<Option<Geometry>, ModelError> {
    if matches!(geom.type_, GeomType::Mesh | GeomType::Hfield | GeomType::Sdf) || geom.mesh.is_some() {
        return Ok(None);
    }
    let size = |index: usize, what: &'static str| positive(name, what, geom.size[index]);
    if let Some(ends) = geom.fromto {
        return between_ends(name, geom, &ends, offset).map(Some);
    }
    let pose = offset * isometry(&geom.pose);
    let on_axis = |z_m: f64| pose * Point3::new(0.0, 0.0, z_m);
    Ok(Some(match geom.type_ {
        GeomType::Sphere => Geometry::Sphere { centre_m: on_axis(0.0), radius_m: size(0, "radius (m)")? },
        GeomType::Capsule => {
            let half_m = size(1, "half length (m)")?;
            Geometry::Capsule { from_m: on_axis(-half_m), to_m: on_axis(half_m), radius_m: size(0, "radius (m)")? }
        }
        GeomType::Cylinder => {
            Geometry::Cylinder { pose, radius_m: size(0, "radius (m)")?, half_length_m: size(1, "half length (m)")? }
        }
        GeomType::Box | GeomType::Ellipsoid => {
            let what = ["first half size (m)", "second half size (m)", "third half size (m)"];
            let half_m = Vector3::new(size(0, what[0])?, size(1, what[1])?, size(2, what[2])?);
            solid(&geom.type_, pose, half_m)
        }
        _ => return Err(ModelError::unsupported(name, "only the world may have a plane")),
    }))
}

/// Returns the geometry of a geom with `fromto`.
fn between_ends(name: &str, geom: &Geom, ends: &[f64; 6], offset: &Isometry3<f64>) -> Result<Geometry, ModelError> {
    if isometry(&geom.pose) != Isometry3::identity() {
        let problem = "`fromto` is in the body's frame: remove position, orientation and <frame>";
        return Err(ModelError::unsupported(name, problem));
    }
    let radius_m = positive(name, "radius (m)", geom.size[0])?;
    let [ax, ay, az, bx, by, bz] = *ends;
    let (from_m, to_m) = (offset * Point3::new(ax, ay, az), offset * Point3::new(bx, by, bz));
    let axis = to_m - from_m;
    let half_length_m = positive(name, "half length (m)", axis.norm() / 2.0)?;
    let turn = Rotation3::rotation_between(&Vector3::z(), &(offset.rotation.inverse() * axis))
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
    let rotation = offset.rotation * UnitQuaternion::from_rotation_matrix(&turn);
    let pose = Isometry3::from_parts(nalgebra::center(&from_m, &to_m).coords.into(), rotation);
    Ok(match geom.type_ {
        GeomType::Capsule => Geometry::Capsule { from_m, to_m, radius_m },
        GeomType::Cylinder => Geometry::Cylinder { pose, radius_m, half_length_m },
        GeomType::Box | GeomType::Ellipsoid => {
            solid(&geom.type_, pose, Vector3::new(radius_m, radius_m, half_length_m))
        }
        _ => return Err(ModelError::unsupported(name, "`fromto` is for capsules, cylinders, boxes and ellipsoids")),
    })
}

fn solid(kind: &GeomType, pose: Isometry3<f64>, half_m: Vector3<f64>) -> Geometry {
    match kind {
        GeomType::Ellipsoid => Geometry::Ellipsoid { pose, half_m },
        _ => Geometry::Box { pose, half_m },
    }
}

fn positive(element: &str, what: &'static str, value: f64) -> Result<f64, ModelError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(ModelError::quantity(element, what, value, "finite and above 0"))
    }
}

pub(super) fn not_negative(element: &str, what: &'static str, value: f64) -> Result<f64, ModelError> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(ModelError::quantity(element, what, value, "finite and not negative"))
    }
}
