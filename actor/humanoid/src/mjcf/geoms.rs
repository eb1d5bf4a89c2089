//! Geoms: their masses and their collision shapes.

use nalgebra::{Isometry3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::assets::Assets;
use super::element::Element;
use crate::error::ModelError;
use crate::model::inertia::{self, MassProperties};
use crate::model::{Geometry, Shape, length, not_negative};

/// Largest margin (m); a greater one would be a visible gap.
pub(super) const MARGIN_MAX_M: f64 = 0.01;

/// Returns whether a geom may touch others; `is_paired` if a `<pair>` names it.
pub(super) fn collides(geom: &Element, is_paired: bool) -> Result<bool, ModelError> {
    Ok(bits(geom)? != [0, 0] || is_paired)
}

/// Returns `contype` and `conaffinity`.
pub(super) fn bits(geom: &Element) -> Result<[u32; 2], ModelError> {
    Ok([geom.whole("contype", 1)?, geom.whole("conaffinity", 1)?])
}

/// Reads a geom of a body: its mass if it has one, and its shape if it can collide.
///
/// `offset` is the pose of the MJCF body within its rigid body, and `pose` that of the geom within the MJCF body.
pub(super) fn read(
    geom: &Element,
    offset: &Isometry3<f64>,
    pose: &Isometry3<f64>,
    counts_for_mass: bool,
    is_paired: bool,
    assets: &Assets,
) -> Result<(Option<MassProperties>, Option<Shape>), ModelError> {
    let name = &geom.label;
    let collides = collides(geom, is_paired)?;
    let density_kgpm3 = not_negative(name, "density (kg/m³)", geom.number("density").unwrap_or(inertia::WATER_KGPM3))?;
    let mass_kg = geom.number("mass").map(|mass_kg| not_negative(name, "mass (kg)", mass_kg)).transpose()?;
    let weightless = mass_kg.map_or(density_kgpm3 == 0.0, |mass_kg| mass_kg == 0.0) || !counts_for_mass;
    let mesh = geom.get("mesh");
    let found = if collides || !weightless || mesh.is_none() { geometry(geom, offset, pose, assets)? } else { None };
    let Some(geometry) = found else {
        if collides {
            let what = describe(geom);
            return Err(geom.refused(format!(
                "{what} cannot collide without the numbers of its file, which are read with a model file, but not from a \
                 text; use primitive shapes, contype=\"0\" conaffinity=\"0\", or <mesh vertex=\"…\"> with type=\"mesh\""
            )));
        }
        if weightless {
            return Ok((None, None));
        }
        return Err(geom.refused(format!("the mass of {} is unknown; give the body an <inertial>", describe(geom))));
    };
    let of_mesh = match mesh.filter(|_| kind(geom) == "mesh" && !weightless) {
        Some(mesh) => assets.moments(mesh)?,
        None => None,
    };
    let is_shell = geom.is_true("shellinertia", false);
    // A density of 1 kg/m³, or of 1 kg/m², gives the volume or the area.
    let unit = match of_mesh {
        _ if weightless => None,
        Some(_) if is_shell => return Err(geom.refused("the shell of a mesh is `inertia=\"shell\"` of its <mesh>")),
        Some(moments) => {
            let pose = offset * pose;
            let turn = pose.rotation.to_rotation_matrix();
            Some(moments.transformed(turn.matrix(), &pose.translation.vector).mass_properties(1.0))
        }
        None if is_shell => {
            let shell = inertia::of_shell(&geometry, 1.0);
            let problem = || {
                geom.refused(format!("the shell of {} is not computed; give its body an <inertial>", describe(geom)))
            };
            Some(shell.ok_or_else(problem)?)
        }
        None => Some(inertia::of_geometry(&geometry, 1.0)),
    };
    let mass = unit.map(|unit| {
        let whole = unit.mass_kg;
        unit.scaled(mass_kg.map_or(density_kgpm3, |mass_kg| mass_kg / whole))
    });
    Ok((mass, if collides { Some(collision_shape(geom, geometry)?) } else { None }))
}

/// Reads the collision shape of a geom.
pub(super) fn collision_shape(geom: &Element, geometry: Geometry) -> Result<Shape, ModelError> {
    let name = &geom.label;
    let margin_m = geom.number("margin").unwrap_or(0.0);
    if !(0.0..=MARGIN_MAX_M).contains(&margin_m) {
        return Err(ModelError::quantity(name, "margin (m)", margin_m, "between 0 and 0.01"));
    }
    let friction = not_negative(name, "friction", geom.number("friction").unwrap_or(1.0))?;
    Ok(Shape { name: name.clone(), geometry, friction, margin_m })
}

/// Returns whether contacts of a geom or pair have friction. Torsional and rolling friction, of 4 and 6, are left out.
pub(super) fn has_friction(element: &Element) -> Result<bool, ModelError> {
    match element.whole("condim", 3)? {
        1 => Ok(false),
        3 | 4 | 6 => Ok(true),
        _ => Err(element.wrong("condim", "1, 3, 4 or 6")),
    }
}

/// Returns the type of a geom.
pub(super) fn kind(geom: &Element) -> &str {
    geom.get("type").unwrap_or("sphere")
}

fn describe(geom: &Element) -> String {
    match (kind(geom), geom.get("mesh"), geom.get("hfield")) {
        ("hfield", _, Some(name)) => format!("height field `{name}`"),
        (_, Some(name), _) => format!("mesh `{name}`"),
        (kind, ..) => format!("a geom of type {kind}"),
    }
}

/// Returns the geometry in the rigid body's frame; `None` for meshes in files, height fields and distance fields.
fn geometry(
    geom: &Element,
    offset: &Isometry3<f64>,
    pose: &Isometry3<f64>,
    assets: &Assets,
) -> Result<Option<Geometry>, ModelError> {
    let kind = kind(geom);
    let mesh = geom.get("mesh");
    if let Some(mesh) = mesh.filter(|_| kind == "mesh") {
        let (pose, hull) = (offset * pose, assets.hull(mesh)?);
        return Ok(hull.map(|hull| Geometry::Hull { vertices_m: hull.iter().map(|vertex| pose * vertex).collect() }));
    }
    if matches!(kind, "mesh" | "hfield" | "sdf") || mesh.is_some() {
        return Ok(None);
    }
    let sizes = geom.list_over("size", [0.0; 3]);
    let size = |index: usize, what: &'static str| length(&geom.label, what, sizes[index]);
    if geom.get("fromto").is_some() {
        return between_ends(geom, offset, pose, sizes[0]).map(Some);
    }
    let pose = offset * pose;
    let on_axis = |z_m: f64| pose * Point3::new(0.0, 0.0, z_m);
    Ok(Some(match kind {
        "sphere" => Geometry::Sphere { centre_m: on_axis(0.0), radius_m: size(0, "radius (m)")? },
        "capsule" => {
            let half_m = size(1, "half length (m)")?;
            Geometry::Capsule { from_m: on_axis(-half_m), to_m: on_axis(half_m), radius_m: size(0, "radius (m)")? }
        }
        "cylinder" => {
            Geometry::Cylinder { pose, radius_m: size(0, "radius (m)")?, half_length_m: size(1, "half length (m)")? }
        }
        "box" | "ellipsoid" => {
            let what = ["first half size (m)", "second half size (m)", "third half size (m)"];
            let half_m = Vector3::new(size(0, what[0])?, size(1, what[1])?, size(2, what[2])?);
            solid(kind, pose, half_m)
        }
        _ => return Err(geom.refused("only the world may have a plane")),
    }))
}

/// Returns the geometry of a geom with `fromto`.
fn between_ends(
    geom: &Element,
    offset: &Isometry3<f64>,
    pose: &Isometry3<f64>,
    radius_m: f64,
) -> Result<Geometry, ModelError> {
    if *pose != Isometry3::identity() {
        return Err(geom.refused("`fromto` is in the body's frame: remove position, orientation and <frame>"));
    }
    let (name, kind) = (&geom.label, kind(geom));
    let radius_m = length(name, "radius (m)", radius_m)?;
    let [ax, ay, az, bx, by, bz] = geom.list_over("fromto", [0.0; 6]);
    let (from_m, to_m) = (offset * Point3::new(ax, ay, az), offset * Point3::new(bx, by, bz));
    let axis = to_m - from_m;
    let half_length_m = length(name, "half length (m)", axis.norm() / 2.0)?;
    let turn = Rotation3::rotation_between(&Vector3::z(), &(offset.rotation.inverse() * axis))
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
    let rotation = offset.rotation * UnitQuaternion::from_rotation_matrix(&turn);
    let pose = Isometry3::from_parts(nalgebra::center(&from_m, &to_m).coords.into(), rotation);
    Ok(match kind {
        "capsule" => Geometry::Capsule { from_m, to_m, radius_m },
        "cylinder" => Geometry::Cylinder { pose, radius_m, half_length_m },
        "box" | "ellipsoid" => solid(kind, pose, Vector3::new(radius_m, radius_m, half_length_m)),
        _ => return Err(geom.refused("`fromto` is for capsules, cylinders, boxes and ellipsoids")),
    })
}

fn solid(kind: &str, pose: Isometry3<f64>, half_m: Vector3<f64>) -> Geometry {
    match kind {
        "ellipsoid" => Geometry::Ellipsoid { pose, half_m },
        _ => Geometry::Box { pose, half_m },
    }
}
