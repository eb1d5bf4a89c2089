//! Approximate responses of links and hinges to forces, at the model's nominal pose.
//!
//! MuJoCo derives the softness of constraints from them (`body_invweight0`, `dof_invweight0`).

use nalgebra::Vector3;
use pulp::Scalar;

use super::mass_matrix::MassMatrix;
use super::posture::Posture;
use super::structure::{ROOT_DOFS, Structure};
use super::world::BodyMasses;
use crate::lanes::{Lanes, Vec3};
use crate::model::Model;

/// Responses of a model at its nominal pose.
#[derive(Clone, Debug, Default)]
pub(crate) struct Responses {
    /// Mean acceleration of each link's centre of mass per force on it (1/kg), over three directions.
    pub(crate) links: Vec<f64>,
    /// Acceleration of each degree of freedom per force on it (1/kg or 1/(kg·m²)).
    pub(crate) dofs: Vec<f64>,
    /// Acceleration of each tendon's length per force along it.
    pub(crate) tendons: Vec<f64>,
}

impl Responses {
    pub(crate) fn new(model: &Model, structure: &Structure) -> Self {
        let lanes = |number: f64| Lanes::splat(Scalar, number);
        let position: Vec<_> = model.nominal_position().into_iter().map(lanes).collect();
        let masses: Vec<_> = model
            .bodies
            .iter()
            .map(|body| {
                let own = &body.inertia_kgm2;
                let inertia_kgm2 = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|entry| lanes(own[entry]));
                BodyMasses { mass_kg: lanes(body.mass_kg), inertia_kgm2 }
            })
            .collect();
        let mut posture = Posture::new(Scalar, structure);
        posture.update_kinematics(structure, &position);
        posture.update_inertia(&masses);
        let mut diagonal = vec![lanes(structure.root_armature); structure.dofs()];
        for (entry, hinge) in diagonal[ROOT_DOFS..].iter_mut().zip(&model.hinges) {
            *entry = lanes(hinge.armature_kgm2);
        }
        let mut matrix = MassMatrix::new(Scalar, structure);
        matrix.assemble(structure, &posture, &diagonal);
        matrix.factor(structure);

        let all = 0..structure.dofs();
        let response = |mut rows: Vec<[Lanes<Scalar>; 1]>| {
            matrix.whiten_rows(structure, all.clone(), &mut rows);
            rows.iter().map(|row| row[0].lane(0).powi(2)).sum::<f64>()
        };
        let nothing = vec![[lanes(0.0)]; structure.dofs()];
        let along_terms = |terms: &[(usize, f64)]| {
            let mut rows = nothing.clone();
            for (dof, weight) in terms {
                rows[*dof][0] += lanes(*weight);
            }
            response(rows)
        };
        let dofs = all.clone().map(|dof| along_terms(&[(dof, 1.0)])).collect();
        let tendons = model.tendons.iter().map(|tendon| {
            along_terms(&tendon.terms.iter().map(|(hinge, weight)| (ROOT_DOFS + hinge, *weight)).collect::<Vec<_>>())
        });
        let tendons = tendons.collect();
        let links = model.links.iter().map(|link| {
            let point = posture.origins_m[link.body]
                + posture.rotations[link.body].times_constant(&link.centre_of_mass_m.coords);
            let along = |direction: Vector3<f64>| {
                let mut rows = nothing.clone();
                for dof in structure.path_of_body(link.body) {
                    let moved = posture.axes[*dof as usize].at(&point);
                    rows[*dof as usize] = [moved.dot(&Vec3::splat(Scalar, &direction))];
                }
                response(rows)
            };
            (along(Vector3::x()) + along(Vector3::y()) + along(Vector3::z())) / 3.0
        });
        Self { links: links.collect(), dofs, tendons }
    }
}
