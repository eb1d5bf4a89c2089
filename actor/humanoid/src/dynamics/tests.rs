//! Tests of the dynamics against independent computations.

use nalgebra::{DMatrix, DVector, Rotation3, UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::limits::Limits;
use super::mass_matrix::MassMatrix;
use super::posture::{Posture, integrate};
use super::{ContactPoint, Contacts, Flight, ROOT_DOFS, ROOT_POSITIONS, Tree};
use crate::model::{HUMANOID_XML, Model};

/// A body's centre (m) and orientation.
type CentrePose = (Vector3<f64>, Rotation3<f64>);

/// Returns each body's centre and orientation at a position vector.
fn bodies(tree: &Tree, position: &[f64]) -> Vec<CentrePose> {
    let mut posture = Posture::new(tree);
    posture.update_kinematics(tree, position);
    let root = Vector3::from_column_slice(&position[..3]);
    let rotations = posture.rotations.iter().map(|rotation| Rotation3::from_matrix_unchecked(*rotation));
    posture.centres_m.iter().map(|centre| root + centre).zip(rotations).collect()
}

/// Computes the mass matrix Σ m JᵀJ + J_ωᵀ I J_ω + rotors, with Jacobians from central differences.
fn mass_matrix_by_differences(tree: &Tree, position: &[f64]) -> DMatrix<f64> {
    const STEP: f64 = 1e-5;
    let dofs = tree.dofs();
    let now = bodies(tree, position);
    let shifted: Vec<[Vec<CentrePose>; 2]> = (0..dofs)
        .map(|dof| {
            [-STEP, STEP].map(|by| {
                let (mut direction, mut to) = (vec![0.0; dofs], position.to_vec());
                direction[dof] = 1.0;
                integrate(position, &direction, by, &mut to);
                bodies(tree, &to)
            })
        })
        .collect();
    let mut matrix = DMatrix::zeros(dofs, dofs);
    for (index, node) in tree.nodes.iter().enumerate() {
        let (mut linear, mut angular) = (DMatrix::zeros(3, dofs), DMatrix::zeros(3, dofs));
        for (dof, [before, after]) in shifted.iter().enumerate() {
            linear.set_column(dof, &((after[index].0 - before[index].0) / (2.0 * STEP)));
            let turn = after[index].1 * before[index].1.inverse();
            angular.set_column(dof, &(turn.scaled_axis() / (2.0 * STEP)));
        }
        let inertia = now[index].1 * node.inertia_kgm2 * now[index].1.inverse();
        matrix += linear.transpose() * &linear * node.mass_kg + angular.transpose() * inertia * &angular;
    }
    for (hinge, node) in tree.hinges.iter().enumerate() {
        matrix[(ROOT_DOFS + hinge, ROOT_DOFS + hinge)] += node.armature_kgm2;
    }
    matrix
}

/// Returns the factored mass matrix at a position, with rotors.
fn factored(tree: &Tree, position: &[f64]) -> MassMatrix {
    let (mut posture, mut matrix) = (Posture::new(tree), MassMatrix::new(tree));
    let mut rotors = vec![0.0; tree.dofs()];
    for (rotor, hinge) in rotors[ROOT_DOFS..].iter_mut().zip(&tree.hinges) {
        *rotor = hinge.armature_kgm2;
    }
    posture.update_kinematics(tree, position);
    posture.update_inertia(tree);
    matrix.assemble(tree, &posture);
    matrix.add_diagonal(tree, &rotors);
    matrix.factor(tree);
    matrix
}

fn random_position(model: &Model, random: &mut Xoshiro256PlusPlus) -> Vec<f64> {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::from_fn(|_, _| random.random_range(-3.0..3.0)));
    let mut position = vec![0.3, -0.2, 2.0, turn.w, turn.i, turn.j, turn.k];
    for hinge in &model.hinges {
        position.push(hinge.min_rad + random.random_range(0.1..0.9) * (hinge.max_rad - hinge.min_rad));
    }
    position
}

#[test]
fn acceleration_from_torques_matches_the_mass_matrix_by_differences() {
    let xml = HUMANOID_XML.replace("<option ", "<option gravity=\"0 0 0\" ");
    let model = Model::from_mjcf(&xml).expect("valid");
    let tree = Tree::new(&model);
    let (mut flight, mut start) = (Flight::new(&tree), Posture::new(&tree));
    let mut random = Xoshiro256PlusPlus::seed_from_u64(2);
    // So short that the acceleration is constant; velocities still have twelve digits.
    let time_s = 1e-7;
    for _ in 0..6 {
        let position = random_position(&model, &mut random);
        let inverse = mass_matrix_by_differences(&tree, &position).try_inverse().expect("positive definite");
        start.update_kinematics(&tree, &position);
        start.update_inertia(&tree);
        for driven in 0..model.hinges.len() {
            let mut torques = vec![0.0; model.hinges.len()];
            torques[driven] = 30.0;
            flight.advance(&tree, &start, &position, &vec![0.0; tree.dofs()], &torques, time_s);
            let mut forces = DVector::zeros(tree.dofs());
            for (hinge, node) in tree.hinges.iter().enumerate() {
                let spring = -node.stiffness_nmprad * (position[ROOT_POSITIONS + hinge] - node.rest_rad);
                forces[ROOT_DOFS + hinge] = torques[hinge] + spring;
            }
            let wanted = &inverse * forces;
            let found = DVector::from_column_slice(&flight.velocity) / time_s;
            let off = (&found - &wanted).norm() / wanted.norm();
            assert!(off < 1e-4, "{}: relative error {off}", model.hinges[driven].name);
        }
    }
}

#[test]
fn solving_with_the_factored_mass_matrix_inverts_the_dense_one() {
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let tree = Tree::new(&model);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(4);
    for _ in 0..6 {
        let position = random_position(&model, &mut random);
        let matrix = factored(&tree, &position);
        let dense = mass_matrix_by_differences(&tree, &position);
        let wanted = DVector::from_fn(tree.dofs(), |_, _| random.random_range(-1.0..1.0));
        let mut found = (&dense * &wanted).as_slice().to_vec();
        matrix.solve(&tree, &mut found);
        let off = (DVector::from_vec(found) - &wanted).norm();
        // The matrix' condition number magnifies the error of the differences.
        assert!(off < 1e-4, "error {off}");
    }
}

#[test]
fn whitened_velocities_give_the_energy_and_whitened_rows_the_rates() {
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let tree = Tree::new(&model);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    for _ in 0..3 {
        let position = random_position(&model, &mut random);
        let matrix = factored(&tree, &position);
        let dense = mass_matrix_by_differences(&tree, &position);
        let velocity = DVector::from_fn(tree.dofs(), |_, _| random.random_range(-1.0..1.0));
        let jacobian = DVector::from_fn(tree.dofs(), |_, _| random.random_range(-1.0..1.0));
        let (mut whitened, mut row) = (velocity.as_slice().to_vec(), jacobian.as_slice().to_vec());
        matrix.whiten(&tree, &mut whitened);
        matrix.whiten_row(&tree, &mut row);
        let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();

        let energy = velocity.dot(&(&dense * &velocity));
        assert!((of(&whitened, &whitened) / energy - 1.0).abs() < 1e-6, "the energy is twice {energy}");
        assert!((of(&row, &whitened) - jacobian.dot(&velocity)).abs() < 1e-9, "the rate along the direction");
        let response = jacobian.dot(&dense.lu().solve(&jacobian).expect("positive definite"));
        assert!((of(&row, &row) / response - 1.0).abs() < 1e-4, "the direction's response is {response}");
        matrix.unwhiten(&tree, &mut whitened);
        assert!((DVector::from_vec(whitened) - velocity).norm() < 1e-12);
    }
}

/// Box of 2 kg with a small body on a hinge.
const BOX: &str = r#"<mujoco><option gravity="0 0 0"/><worldbody><geom type="plane" size="1 1 1"/>
    <body pos="0 0 0.1"><freejoint/><geom type="box" size="0.2 0.3 0.1" mass="2" contype="0" conaffinity="0"/>
    <body><joint name="j" axis="0 0 1"/><geom size="0.01" mass="1e-6" contype="0" conaffinity="0"/></body>
    </body></worldbody><actuator><motor joint="j"/></actuator></mujoco>"#;

fn on_the_floor(x_m: f64, y_m: f64, friction: f64) -> ContactPoint {
    ContactPoint {
        bodies: [None, Some(0)],
        links: [None, Some(0)],
        position_m: Vector3::new(x_m, y_m, -0.1),
        normal: Vector3::z(),
        gap_m: -1e-4,
        friction,
        impulse_ns: Vector3::zeros(),
    }
}

/// Returns the box's velocity and its contacts' impulses after one step without other forces.
fn solve_contacts(points: &[ContactPoint], velocity: [f64; 3]) -> (Vec<f64>, Vec<Vector3<f64>>) {
    let model = Model::from_mjcf(BOX).expect("valid");
    let tree = Tree::new(&model);
    let position = model.nominal_position();
    let (mut posture, mut matrix) = (Posture::new(&tree), MassMatrix::new(&tree));
    posture.update_kinematics(&tree, &position);
    posture.update_inertia(&tree);
    matrix.assemble(&tree, &posture);
    matrix.factor(&tree);
    let mut before = vec![0.0; tree.dofs()];
    before[..3].copy_from_slice(&velocity);
    let mut after = before.clone();
    let (mut contacts, mut limits) = (Contacts::new(&tree), Limits::new(&tree));
    points.iter().for_each(|point| contacts.push(*point));
    let (posture, matrix, limits) = (&posture, &matrix, &mut limits);
    assert!(contacts.solve(&tree, posture, matrix, limits, &position, &before, &mut after, 0.0075));
    (after, contacts.points.iter().map(|point| point.impulse_ns).collect())
}

#[test]
fn contact_impulses_stay_in_their_cones_and_equal_the_change_of_momentum() {
    let corners = [(0.2, 0.3), (0.2, -0.3), (-0.2, 0.3), (-0.2, -0.3)];
    for friction in [0.0, 0.3, 1.0, 5.0] {
        for velocity in [[0.0, 0.0, -1.0], [2.0, 0.0, -1.0], [-0.5, 3.0, -0.2], [0.1, 0.1, -2.0]] {
            let points = corners.map(|(x_m, y_m)| on_the_floor(x_m, y_m, friction));
            let (after, impulses) = solve_contacts(&points, velocity);
            let mut sum = Vector3::zeros();
            for impulse in &impulses {
                assert!(impulse.z >= 0.0, "contacts must not pull: {impulse}");
                let tangential = impulse.x.hypot(impulse.y);
                assert!(
                    tangential <= friction * impulse.z * (1.0 + 1e-12),
                    "{tangential} N·s at friction {friction}: {impulse}"
                );
                sum += impulse;
            }
            assert!(sum.z > 0.1, "the contacts must stop the box");
            // Friction reduces speed and does not reverse it.
            for axis in 0..2 {
                assert!(
                    sum[axis] * velocity[axis] <= 1e-9 && after[axis] * velocity[axis] >= -1e-9,
                    "{sum}, {after:?}"
                );
            }
            for axis in 0..3 {
                assert!((sum[axis] / 2.000_001 - (after[axis] - velocity[axis])).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn identical_contact_points_share_the_impulse_of_one() {
    // Below the centre and without friction, so that the box does not rotate.
    let one = on_the_floor(0.0, 0.0, 0.0);
    let velocity = [1.0, 0.5, -1.0];
    let (alone, single) = solve_contacts(&[one], velocity);
    for copies in [2, 4] {
        let (together, shared) = solve_contacts(&vec![one; copies], velocity);
        let sum: Vector3<f64> = shared.iter().sum();
        assert!(shared.iter().all(|impulse| impulse.z >= 0.0));
        // Each is soft by itself, so several resist a little more: at most all of the force instead of 95 %.
        let ratio = sum.z / single[0].z;
        assert!((1.0..1.06).contains(&ratio), "{copies} carry {ratio} times as much");
        assert!((together[2] - alone[2]).abs() < 0.06, "{together:?}");
        assert!((together[0] - 1.0).abs() < 1e-12 && (together[1] - 0.5).abs() < 1e-12);
    }
}

#[test]
fn a_contact_in_an_immovable_direction_has_no_impulse() {
    let stuck = ContactPoint { bodies: [Some(0), Some(0)], links: [Some(0), Some(0)], ..on_the_floor(0.1, 0.0, 1.0) };
    let velocity = [1.0, 0.0, -1.0];
    let floor = on_the_floor(0.0, 0.0, 0.0);
    let (after, impulses) = solve_contacts(&[stuck, floor], velocity);
    assert_eq!(impulses[0], Vector3::zeros());
    let (alone, single) = solve_contacts(&[floor], velocity);
    assert_eq!((after, impulses[1]), (alone, single[0]));
}
