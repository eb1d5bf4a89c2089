//! Geoms: their masses and their collision shapes.

use mjcf_rs::body::{Geom, GeomType};
use nalgebra::{Isometry3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::assets::Assets;
use super::inertia::{self, MassProperties};
use super::mjcf::isometry;
use super::values::{length, not_negative};
use super::{Geometry, Shape};
use crate::error::ModelError;

/// Largest margin (m); a greater one would be a visible gap.
pub(super) const MARGIN_MAX_M: f64 = 0.01;

/// Returns whether a geom may touch others; `is_paired` if a `<pair>` names it.
pub(super) fn collides(geom: &Geom, is_paired: bool) -> bool {
    geom.contype != 0 || geom.conaffinity != 0 || is_paired
}

/// Reads a geom of a body: its mass if it has one, and its shape if it can collide.
///
/// `offset` is the pose of the MJCF body within its rigid body.
pub(super) fn read(
    geom: &Geom,
    offset: &Isometry3<f64>,
    counts_for_mass: bool,
    is_paired: bool,
    assets: &Assets,
) -> Result<(Option<MassProperties>, Option<Shape>), ModelError> {
    let name = geom.name.as_deref().unwrap_or("geom");
    let collides = collides(geom, is_paired);
    let density_kgpm3 = not_negative(name, "density (kg/m³)", geom.density.unwrap_or(inertia::WATER_KGPM3))?;
    let mass_kg = geom.mass.map(|mass_kg| not_negative(name, "mass (kg)", mass_kg)).transpose()?;
    let weightless = mass_kg.map_or(density_kgpm3 == 0.0, |mass_kg| mass_kg == 0.0) || !counts_for_mass;
    let needed = collides || !weightless;
    let found = if needed || geom.mesh.is_none() { geometry(name, geom, offset, assets)? } else { None };
    let Some(geometry) = found else {
        if collides {
            let what = describe(geom);
            let problem = format!(
                "{what} cannot collide without the numbers of its file, which are read with a model file, but not from a \
                 text; use primitive shapes, contype=\"0\" conaffinity=\"0\", or <mesh vertex=\"…\"> with type=\"mesh\""
            );
            return Err(ModelError::unsupported(name, problem));
        }
        if weightless {
            return Ok((None, None));
        }
        let problem = format!("the mass of {} is unknown; give the body an <inertial>", describe(geom));
        return Err(ModelError::unsupported(name, problem));
    };
    if let Some(mesh) = geom.mesh.as_deref().filter(|mesh| !weightless && !assets.is_convex(mesh)) {
        let problem = format!(
            "its mass depends on the faces of mesh `{mesh}`; remove `face`, set inertia=\"convex\" in <mesh>, or give the \
             body an <inertial>"
        );
        return Err(ModelError::unsupported(name, problem));
    }
    let mass = (!weightless).then(|| {
        // A density of 1 kg/m³ gives the volume.
        let unit = inertia::of_geometry(&geometry, 1.0);
        let volume_m3 = unit.mass_kg;
        unit.scaled(mass_kg.map_or(density_kgpm3, |mass_kg| mass_kg / volume_m3))
    });
    if !collides {
        return Ok((mass, None));
    }
    Ok((mass, Some(collision_shape(name, geom, geometry)?)))
}

/// Reads the collision shape of a geom.
pub(super) fn collision_shape(name: &str, geom: &Geom, geometry: Geometry) -> Result<Shape, ModelError> {
    if !(0.0..=MARGIN_MAX_M).contains(&geom.margin) {
        return Err(ModelError::quantity(name, "margin (m)", geom.margin, "between 0 and 0.01"));
    }
    let has_friction = has_friction(name, &geom.condim.to_string())?;
    let friction = not_negative(name, "friction", geom.friction[0])?;
    Ok(Shape {
        name: name.to_owned(),
        geometry,
        friction,
        has_friction,
        margin_m: geom.margin,
        contype: geom.contype,
        conaffinity: geom.conaffinity,
    })
}

/// Returns whether contacts with this `condim` have friction. Torsional and rolling friction, of 4 and 6, are left out.
pub(super) fn has_friction(name: &str, condim: &str) -> Result<bool, ModelError> {
    match condim.trim() {
        "1" => Ok(false),
        "3" | "4" | "6" => Ok(true),
        other => Err(ModelError::attribute(name, "condim", other, "1, 3, 4 or 6")),
    }
}

fn describe(geom: &Geom) -> String {
    match (&geom.type_, &geom.mesh, &geom.hfield) {
        (GeomType::Hfield, _, Some(name)) => format!("height field `{name}`"),
        (_, Some(name), _) => format!("mesh `{name}`"),
        (kind, ..) => format!("a geom of type {}", format!("{kind:?}").to_lowercase()),
    }
}

/// Returns the geometry in the rigid body's frame; `None` for meshes in files, height fields and distance fields.
fn geometry(name: &str, geom: &Geom, offset: &Isometry3<f64>, assets: &Assets) -> Result<Option<Geometry>, ModelError> {
    if let (GeomType::Mesh, Some(mesh)) = (&geom.type_, &geom.mesh) {
        let pose = offset * isometry(&geom.pose);
        let hull = assets.hull(mesh)?;
        return Ok(hull.map(|hull| Geometry::Hull { vertices_m: hull.iter().map(|vertex| pose * vertex).collect() }));
    }
    if matches!(geom.type_, GeomType::Mesh | GeomType::Hfield | GeomType::Sdf) || geom.mesh.is_some() {
        return Ok(None);
    }
    let size = |index: usize, what: &'static str| length(name, what, geom.size[index]);
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
    let radius_m = length(name, "radius (m)", geom.size[0])?;
    let [ax, ay, az, bx, by, bz] = *ends;
    let (from_m, to_m) = (offset * Point3::new(ax, ay, az), offset * Point3::new(bx, by, bz));
    let axis = to_m - from_m;
    let half_length_m = length(name, "half length (m)", axis.norm() / 2.0)?;
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
