//! Mass of an MJCF body: from its `<inertial>` element or its geoms, by the rules of `<compiler>`.

use mjcf_rs::body::{InertiaSpec, Inertial};
use mjcf_rs::compiler::{Compiler, InertiaFromGeom};
use nalgebra::{Isometry3, Matrix3, Point3, SymmetricEigen, Vector3};

use super::inertia::{self, MassProperties};
use super::mjcf::isometry;
use crate::error::ModelError;

/// Relative tolerance of the triangle inequality of principal inertias, since numbers in texts are rounded.
const TRIANGLE_TOLERANCE: f64 = 1e-3;

/// Returns the mass properties of one MJCF body's parts, in the frame of its rigid body; `geoms` are its geoms' masses.
pub(super) fn parts_of_body(
    name: &str,
    geoms: Vec<MassProperties>,
    inertial: Option<&Inertial>,
    offset: &Isometry3<f64>,
    compiler: &Compiler,
) -> Result<Vec<MassProperties>, ModelError> {
    let explicit = match compiler.inertia_from_geom {
        InertiaFromGeom::True => inertial.filter(|_| geoms.is_empty()),
        InertiaFromGeom::False | InertiaFromGeom::Auto => inertial,
    };
    if let Some(inertial) = explicit {
        return Ok(vec![read_inertial(name, inertial, offset, compiler)?]);
    }
    let parts = if compiler.inertia_from_geom == InertiaFromGeom::False { Vec::new() } else { geoms };
    if compiler.bound_mass <= 0.0 && compiler.bound_inertia <= 0.0 {
        return Ok(parts);
    }
    Ok(vec![bounded(inertia::sum(&parts), offset, compiler)])
}

/// Returns whether geoms may count for the mass of a body.
pub(super) fn uses_geoms(inertial: Option<&Inertial>, compiler: &Compiler) -> bool {
    match compiler.inertia_from_geom {
        InertiaFromGeom::True => true,
        InertiaFromGeom::False => false,
        InertiaFromGeom::Auto => inertial.is_none(),
    }
}

fn read_inertial(
    name: &str,
    inertial: &Inertial,
    offset: &Isometry3<f64>,
    compiler: &Compiler,
) -> Result<MassProperties, ModelError> {
    let mass_kg = super::values::not_negative(name, "mass (kg)", inertial.mass)?;
    let pose = offset * isometry(&inertial.pose);
    let (mut principal, axes) = match inertial.inertia {
        InertiaSpec::Diagonal([x, y, z]) => (Vector3::new(x, y, z), Matrix3::identity()),
        InertiaSpec::Full([xx, yy, zz, xy, xz, yz]) => {
            let full = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
            let principal = SymmetricEigen::new(full);
            (principal.eigenvalues, principal.eigenvectors)
        }
    };
    if principal.min() < 0.0 {
        return Err(ModelError::quantity(name, "least principal inertia (kg·m²)", principal.min(), "not negative"));
    }
    principal.apply(|value| *value = value.max(compiler.bound_inertia));
    let slack = 2.0 * principal.max() - principal.sum();
    if slack > TRIANGLE_TOLERANCE * principal.max() {
        if !compiler.balance_inertia {
            let problem = "one principal inertia is larger than the sum of the other two, which is physically impossible; \
                           correct it, or set balanceinertia=\"true\" in <compiler>";
            return Err(ModelError::unsupported(name, problem));
        }
        // As in MuJoCo: all three become their mean.
        principal = Vector3::repeat(principal.sum() / 3.0);
    }
    let turn = pose.rotation.to_rotation_matrix();
    let full = axes * Matrix3::from_diagonal(&principal) * axes.transpose();
    Ok(MassProperties {
        mass_kg: mass_kg.max(compiler.bound_mass),
        centre_m: Point3::from(pose.translation.vector),
        inertia_kgm2: turn * full * turn.inverse(),
    })
}

/// Raises mass and principal inertias to the compiler's lower bounds.
fn bounded(found: Option<MassProperties>, offset: &Isometry3<f64>, compiler: &Compiler) -> MassProperties {
    let found = found.unwrap_or_else(|| inertia::from_principal(offset, 0.0, Vector3::zeros()));
    let mut principal = SymmetricEigen::new(found.inertia_kgm2);
    principal.eigenvalues.apply(|value| *value = value.max(compiler.bound_inertia));
    MassProperties { mass_kg: found.mass_kg.max(compiler.bound_mass), inertia_kgm2: principal.recompose(), ..found }
}
