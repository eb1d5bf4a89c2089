//! Approximate responses of links and hinges to forces, at the model's nominal pose.
//!
//! MuJoCo derives the softness of constraints from them (`body_invweight0`, `dof_invweight0`).

use nalgebra::Vector3;

use super::mass_matrix::MassMatrix;
use super::posture::{BodyMasses, Posture};
use super::structure::{ConnectionNode, Coordinate, ROOT_DOFS, Structure, ascending};
use crate::lanes::{Lanes, Scalar, Vec3};
use crate::model::{Connection, Model, Softness};

impl Structure {
    pub(crate) fn new(model: &Model) -> Self {
        let mut structure = Self::without_responses(model);
        let mut responses = Responses::new(model, &structure);
        structure.coordinates = structure.coordinates_of(model, &responses);
        structure.connections = structure.connections_of(model, &responses);
        structure.link_responses = responses.links;
        structure.hinge_responses = responses.dofs.split_off(ROOT_DOFS);
        structure
    }

    fn coordinates_of(&self, model: &Model, responses: &Responses) -> Vec<Coordinate> {
        let none = Coordinate {
            terms: Vec::new(),
            dofs: Vec::new(),
            hinge: None,
            is_fixed: false,
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
            limit_margin: 0.0,
            limit_softness: Softness::default(),
            friction_loss: 0.0,
            friction_softness: Softness::default(),
            response: 0.0,
        };
        let hinges = model.hinges.iter().enumerate().map(|(index, hinge)| Coordinate {
            terms: vec![(ROOT_DOFS + index, 1.0)],
            hinge: Some(index),
            min: hinge.min_rad,
            max: hinge.max_rad,
            limit_margin: hinge.limit_margin_rad,
            limit_softness: hinge.limit_softness,
            friction_loss: hinge.friction_loss_nm,
            friction_softness: hinge.friction_softness,
            response: responses.dofs[ROOT_DOFS + index],
            ..none.clone()
        });
        let tendons = model.tendons.iter().zip(&responses.tendons).filter_map(|(tendon, response)| {
            let [min, max] = tendon.range?;
            Some(Coordinate {
                terms: tendon.terms.iter().map(|(hinge, weight)| (ROOT_DOFS + hinge, *weight)).collect(),
                min,
                max,
                limit_margin: tendon.limit_margin,
                limit_softness: tendon.limit_softness,
                response: *response,
                ..none.clone()
            })
        });
        let root = (0..ROOT_DOFS).filter(|_| model.root.friction_loss > 0.0).map(|dof| Coordinate {
            terms: vec![(dof, 1.0)],
            friction_loss: model.root.friction_loss,
            friction_softness: model.root.friction_softness,
            // MuJoCo takes the mean of translations and of rotations.
            response: responses.dofs[dof / 3 * 3..][..3].iter().sum::<f64>() / 3.0,
            ..none.clone()
        });
        let mut all: Vec<Coordinate> = hinges.chain(tendons).chain(root).collect();
        // One constraint is for the nearer limit; where both may act, the upper one has its own.
        let upper: Vec<_> = all
            .iter_mut()
            .filter(|coordinate| coordinate.max - coordinate.min < 2.0 * coordinate.limit_margin)
            .map(|coordinate| {
                let max = std::mem::replace(&mut coordinate.max, f64::INFINITY);
                Coordinate { hinge: None, min: f64::NEG_INFINITY, max, friction_loss: 0.0, ..coordinate.clone() }
            })
            .collect();
        let couplings = model.couplings.iter().map(|coupling| {
            let mut terms = vec![(ROOT_DOFS + coupling.hinge, 1.0)];
            terms.extend(coupling.follows.map(|(hinge, ratio)| (ROOT_DOFS + hinge, -ratio)));
            // Like MuJoCo, without regard to the ratio.
            let response = terms.iter().map(|(dof, _)| responses.dofs[*dof]).sum();
            let softness = coupling.softness;
            Coordinate {
                terms,
                is_fixed: true,
                min: coupling.offset_rad,
                limit_softness: softness,
                response,
                ..none.clone()
            }
        });
        all.extend(upper.into_iter().chain(couplings));
        for coordinate in &mut all {
            coordinate.dofs = ascending(coordinate.terms.iter().flat_map(|(dof, _)| self.path(*dof)));
        }
        all
    }

    fn connections_of(&self, model: &Model, responses: &Responses) -> Vec<ConnectionNode> {
        let node = |connection: &Connection| {
            let bodies = connection.links.map(|link| model.links[link].body);
            ConnectionNode {
                bodies,
                points_m: connection.points_m.map(|point| point.coords),
                dofs: self.dofs_of_bodies(bodies.into_iter()),
                softness: connection.softness,
                response: connection.links.iter().map(|link| responses.links[*link]).sum(),
            }
        };
        model.connections.iter().map(node).collect()
    }
}

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
