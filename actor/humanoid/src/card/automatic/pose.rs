//! Home pose: knees bent, feet flat, the centre of mass over their middle.

use nalgebra::{DMatrix, DVector, Isometry3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::legs::{LegHinge, LegRole, Legs, anchor_m, axis};
use crate::clearance;
use crate::physics::Physics;

/// Share of its length that a leg reaches at most: a straight leg cannot push its foot further down.
const REACH_MAX: f64 = 0.985;
/// Share of a leg's length by which bent knees lower the hips: knees of 0.57 rad.
const LOWERED: f64 = 0.04;
/// Bend of the knee at which the search begins (rad), and the least range on one side that a knee bends to.
const KNEE_RAD: f64 = 0.5;
/// Most error of a foot's place, as a share of the leg's length, and of its orientation (rad) in the pose that was found.
const PLACE_MAX: f64 = 0.01;
const TURN_MAX_RAD: f64 = 0.03;
/// Steps of the search, and its damping, as a share of the leg's length.
const STEPS: usize = 200;
const DAMPING: f64 = 0.05;
/// Times that the feet are moved below the centre of mass.
const SHIFTS: usize = 6;
/// Share of a hinge's range, at each end, that the pose stays away from.
const MARGIN: f64 = 0.02;

/// Home pose.
pub(super) struct Home {
    /// Position vector.
    pub position: Vec<f64>,
    /// Where it is from.
    pub reason: String,
}

/// Returns the home pose of a robot that stands as `physics` has it; `keyframe` names the pose, if it is one.
pub(super) fn home(physics: &mut Physics, legs: &Legs, keyframe: Option<&str>) -> Home {
    let start = physics.position().to_vec();
    let from =
        keyframe.map_or("all other hinges at zero".to_owned(), |name| format!("other hinges as in keyframe `{name}`"));
    let (mut position, reason) = if is_bent(physics, legs) {
        (
            start,
            keyframe.map_or("pose of the file".to_owned(), |name| format!("keyframe `{name}`, whose knees are bent")),
        )
    } else {
        match bent(physics, legs) {
            Some(position) => {
                (position, format!("legs bent by inverse kinematics, feet flat below the centre of mass; {from}"))
            }
            None => (start, format!("the legs cannot bend with flat feet, so they stay straight; {from}")),
        }
    };
    physics.model().apply_couplings(&mut position);
    stand(physics, &mut position);
    Home { position, reason }
}

/// Returns whether both legs can push their feet further down.
pub(super) fn is_bent(physics: &Physics, legs: &Legs) -> bool {
    (0..2).all(|side| reach(physics, legs, side) < REACH_MAX)
}

/// Puts the lowest part of the robot on the ground.
fn stand(physics: &mut Physics, position: &mut [f64]) {
    set(physics, position);
    if let Some(height_m) = clearance::of_robot_m(physics, |_, _| 0.0) {
        position[2] -= height_m;
    }
    set(physics, position);
}

fn set(physics: &mut Physics, position: &[f64]) {
    let rest = vec![0.0; physics.model().velocity_size()];
    physics.set_state(position, &rest);
}

/// Returns the length of a leg along its hinges (m), to the frame of its foot.
fn length_m(physics: &Physics, legs: &Legs, side: usize) -> f64 {
    let hinges = legs.hinges[side].iter().map(|of| anchor_m(physics, of.hinge));
    let places: Vec<_> = hinges.chain([foot_m(physics, legs, side)]).collect();
    places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// Returns the distance from the first hinge that swings a leg to the last one, as a share of the way by the knee.
fn reach(physics: &Physics, legs: &Legs, side: usize) -> f64 {
    let swing: Vec<_> =
        legs.hinges[side].iter().filter(|of| of.backwards != 0.0).map(|of| anchor_m(physics, of.hinge)).collect();
    // Legs without an ankle end in their feet.
    let swing: Vec<_> =
        if swing.len() == 2 { swing.into_iter().chain([foot_m(physics, legs, side)]).collect() } else { swing };
    let way_m: f64 = swing.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    match swing[..] {
        [first, .., last] if swing.len() > 2 && way_m > 0.0 => (last - first).norm() / way_m,
        _ => 0.0,
    }
}

fn foot_m(physics: &Physics, legs: &Legs, side: usize) -> Point3<f64> {
    Point3::from(physics.link_pose(legs.feet[side]).translation.vector)
}

/// Returns the pose with bent legs; `None` if the hinges do not allow it.
fn bent(physics: &mut Physics, legs: &Legs) -> Option<Vec<f64>> {
    let start = physics.position().to_vec();
    let upright = legs.feet.map(|foot| physics.link_pose(foot));
    let length_m = [0, 1].map(|side| length_m(physics, legs, side));
    let base = physics.body_motion(0).pose.rotation * Vector3::x();
    let ahead = Vector3::new(base.x, base.y, 0.0).try_normalize(1e-6)?;
    let mut seed = start.clone();
    for of in legs.hinges.iter().flatten().filter(|of| of.backwards != 0.0) {
        let hinge = &physics.model().hinges[of.hinge];
        let share = match of.role {
            LegRole::Knee => 1.0,
            LegRole::Hip | LegRole::Ankle => -0.5,
        };
        let angle_rad = start[7 + of.hinge] + share * KNEE_RAD * of.backwards * knee_sign(physics, legs, of, &start);
        seed[7 + of.hinge] = angle_rad.max(hinge.min_rad).min(hinge.max_rad);
    }
    let mut forward_m = 0.0;
    let mut position = seed;
    for shift in 0..=SHIFTS {
        for side in 0..2 {
            let mut target = upright[side];
            target.translation.z += LOWERED * length_m[side];
            target.translation.vector += forward_m * ahead;
            approach(physics, &mut position, legs, side, &target, length_m[side])?;
        }
        set(physics, &position);
        if shift < SHIFTS {
            forward_m += physics.centre_of_mass().coords.dot(&ahead) - middle_of_feet_m(physics, legs, ahead);
        }
    }
    Some(position)
}

/// Returns 1 for legs whose knees bend as those of humans do, else -1.
fn knee_sign(physics: &Physics, legs: &Legs, of: &LegHinge, start: &[f64]) -> f64 {
    let knee = legs.hinges.iter().find(|leg| leg.iter().any(|other| other.hinge == of.hinge));
    let Some(knee) = knee.and_then(|leg| leg.iter().find(|other| other.role == LegRole::Knee)) else { return 1.0 };
    let (hinge, now_rad) = (&physics.model().hinges[knee.hinge], start[7 + knee.hinge]);
    let (up_rad, down_rad) = (hinge.max_rad - now_rad, now_rad - hinge.min_rad);
    let [ahead_rad, back_rad] = if knee.backwards > 0.0 { [up_rad, down_rad] } else { [down_rad, up_rad] };
    if ahead_rad < KNEE_RAD && back_rad > ahead_rad { -1.0 } else { 1.0 }
}

/// Moves a foot to a pose by damped least squares (Wampler 1986; Nakamura and Hanafusa 1986).
fn approach(
    physics: &mut Physics,
    position: &mut [f64],
    legs: &Legs,
    side: usize,
    target: &Isometry3<f64>,
    length_m: f64,
) -> Option<()> {
    let leg = &legs.hinges[side];
    let has_ankle = leg.iter().any(|of| of.role == LegRole::Ankle);
    let mut error = DVector::zeros(6);
    for _ in 0..STEPS {
        set(physics, position);
        let now = physics.link_pose(legs.feet[side]);
        let place = (target.translation.vector - now.translation.vector) / length_m;
        let turn = (target.rotation * now.rotation.inverse()).scaled_axis();
        error.fixed_rows_mut::<3>(0).copy_from(&place);
        // A leg without an ankle holds its foot as it can.
        error.fixed_rows_mut::<3>(3).copy_from(&if has_ankle { turn } else { Vector3::zeros() });
        let jacobian = DMatrix::from_fn(6, leg.len(), |row, column| {
            let hinge = leg[column].hinge;
            let axis = axis(physics, hinge);
            let arm = now.translation.vector - anchor_m(physics, hinge).coords;
            match row {
                0..3 => axis.cross(&arm)[row] / length_m,
                _ if has_ankle => axis[row - 3],
                _ => 0.0,
            }
        });
        let square = &jacobian * jacobian.transpose() + DMatrix::identity(6, 6) * (DAMPING * DAMPING);
        let step = jacobian.transpose() * square.cholesky()?.solve(&error);
        for (of, change_rad) in leg.iter().zip(step.iter()) {
            let hinge = &physics.model().hinges[of.hinge];
            let angle_rad = &mut position[7 + of.hinge];
            let margin_rad = MARGIN * (hinge.max_rad - hinge.min_rad).min(1.0);
            // A start that is nearer to an end may stay there.
            let (low_rad, high_rad) = (hinge.min_rad + margin_rad, hinge.max_rad - margin_rad);
            *angle_rad = (*angle_rad + change_rad).clamp(low_rad.min(*angle_rad), high_rad.max(*angle_rad));
        }
    }
    let place_share = error.fixed_rows::<3>(0).norm();
    let turn_rad = error.fixed_rows::<3>(3).norm();
    (place_share < PLACE_MAX && turn_rad < TURN_MAX_RAD).then_some(())
}

/// Returns the middle between the foremost and the hindmost point of the feet (m, along `ahead`).
fn middle_of_feet_m(physics: &Physics, legs: &Legs, ahead: Vector3<f64>) -> f64 {
    let model = physics.model();
    // Turned so that this direction points down, the lowest point is the outermost one.
    let outermost = |down: Vector3<f64>| -> f64 {
        let turn = Rotation3::rotation_between(&down, &-Vector3::z()).unwrap_or_else(Rotation3::identity);
        let turn =
            Isometry3::from_parts(nalgebra::Translation3::identity(), UnitQuaternion::from_rotation_matrix(&turn));
        let of_foot = |foot: &usize| {
            let link = &model.links[*foot];
            let pose = turn * physics.body_motion(link.body).pose;
            let shapes = &model.bodies[link.body].shapes[link.shapes.clone()];
            -shapes.iter().map(|shape| shape.geometry.lowest_m(&pose)).fold(f64::INFINITY, f64::min)
        };
        legs.feet.iter().map(of_foot).sum::<f64>() / legs.feet.len() as f64
    };
    (outermost(ahead) - outermost(-ahead)) / 2.0
}

/// Returns the inertia that a hinge feels of what is on the lighter side of it, with its rotor (kg·m²).
pub(super) fn felt_inertia_kgm2(physics: &Physics, hinge: usize) -> f64 {
    let model = physics.model();
    let root = model.body_of_hinge(hinge);
    let (place, axis) = (anchor_m(physics, hinge), axis(physics, hinge));
    let is_below = |body: usize| model.upward(body).any(|at| at == root);
    let mut sides = [0.0; 2];
    for (index, body) in model.bodies.iter().enumerate() {
        let pose = physics.body_motion(index).pose;
        let arm = pose * body.centre_of_mass_m - place;
        let away = arm - axis * axis.dot(&arm);
        let turned = pose.rotation.inverse() * axis;
        let own = turned.dot(&(body.inertia_kgm2 * turned));
        sides[usize::from(is_below(index))] += own + body.mass_kg * away.norm_squared();
    }
    sides[0].min(sides[1]) + model.hinges[hinge].armature_kgm2
}
