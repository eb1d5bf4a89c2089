//! Mass of an MJCF body: from its `<inertial>` element or its geoms, by the rules of `<compiler>`.

use nalgebra::{Isometry3, Matrix3, Point3, SymmetricEigen, Vector3};

use super::element::Element;
use super::tree::{BodyNode, Compiler};
use crate::error::ModelError;
use crate::model::inertia::{self, MassProperties};
use crate::model::not_negative;

/// Relative rounding of principal inertias that a matrix gives. MuJoCo refuses what a text rounds.
const TRIANGLE_TOLERANCE: f64 = 1e-12;

/// Returns the mass properties of one MJCF body's parts, in the frame of its rigid body; `geoms` are its geoms' masses.
pub(super) fn parts_of_body(
    body: &BodyNode,
    geoms: Vec<MassProperties>,
    offset: &Isometry3<f64>,
    compiler: &Compiler,
) -> Result<Vec<MassProperties>, ModelError> {
    let ignores_inertial = compiler.inertia_from_geoms == Some(true) && !geoms.is_empty();
    if let Some((inertial, pose)) = body.inertial.as_ref().filter(|_| !ignores_inertial) {
        return Ok(vec![read_inertial(&body.name, inertial, &(offset * pose.isometry()), compiler)?]);
    }
    let parts = if compiler.inertia_from_geoms == Some(false) { Vec::new() } else { geoms };
    if compiler.bound_mass <= 0.0 && compiler.bound_inertia <= 0.0 {
        return Ok(parts);
    }
    Ok(vec![bounded(inertia::sum(&parts), offset, compiler)])
}

/// Returns whether geoms may count for the mass of a body.
pub(super) fn uses_geoms(body: &BodyNode, compiler: &Compiler) -> bool {
    compiler.inertia_from_geoms.unwrap_or(body.inertial.is_none())
}

fn read_inertial(
    name: &str,
    inertial: &Element,
    pose: &Isometry3<f64>,
    compiler: &Compiler,
) -> Result<MassProperties, ModelError> {
    let mass_kg = not_negative(name, "mass (kg)", inertial.number("mass").unwrap_or(0.0))?;
    let (mut principal, axes) = if inertial.get("fullinertia").is_some() {
        let [xx, yy, zz, xy, xz, yz] = inertial.list_over("fullinertia", [0.0; 6]);
        let principal = SymmetricEigen::new(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz));
        (principal.eigenvalues, principal.eigenvectors)
    } else {
        (Vector3::from(inertial.list_over("diaginertia", [0.0; 3])), Matrix3::identity())
    };
    if principal.min() < 0.0 {
        return Err(ModelError::quantity(name, "least principal inertia (kg·m²)", principal.min(), "not negative"));
    }
    principal.apply(|value| *value = value.max(compiler.bound_inertia));
    let slack = 2.0 * principal.max() - principal.sum();
    if slack > TRIANGLE_TOLERANCE * principal.max() {
        if !compiler.balances_inertia {
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
