//! Feet and legs, found by where the robot is lowest.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use crate::clearance;
use crate::home::side_of;
use crate::model::{BaseAxis, Model};
use crate::physics::Physics;

/// Height by which the foot may be above another part of its leg, such as toes (m).
const TOES_M: f64 = 5e-3;
/// Greatest difference in height between the two feet (m).
const UNEVEN_M: f64 = 0.05;
/// Part of an axis along the base's left from which a hinge swings a leg forwards.
const LATERAL: f64 = 0.8;

/// What a hinge of a leg does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LegRole {
    Hip,
    Knee,
    Ankle,
}

/// Hinge of a leg.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegHinge {
    pub hinge: usize,
    pub role: LegRole,
    /// Sign of the rotation that swings what hangs on it backwards; 0 for a hinge that swings it sideways or turns it.
    pub backwards: f64,
}

/// Two legs, the left one first.
#[derive(Clone, Debug)]
pub(super) struct Legs {
    /// Links of the feet.
    pub feet: [usize; 2],
    /// Hinges from the hip to the foot.
    pub hinges: [Vec<LegHinge>; 2],
    /// Height of the hips above the ground in the pose in which the legs were found (m).
    pub hip_height_m: f64,
}

impl Legs {
    /// Finds the legs of a robot that stands as `physics` has it.
    ///
    /// # Errors
    /// Why there are not two.
    pub fn of(physics: &Physics) -> Result<Self, String> {
        let model = physics.model();
        let mut lows: Vec<(usize, f64)> =
            (0..model.links.len()).filter_map(|link| Some((link, clearance::of_link_m(physics, link)?))).collect();
        lows.sort_by(|one, other| one.1.total_cmp(&other.1));
        let first = lows.first().ok_or("no shape of the robot can touch the ground")?;
        let path_of = |link: usize| path(model, model.links[link].body);
        let is_on_other_leg = |link: usize| {
            let (own, other) = (path_of(first.0), path_of(link));
            !own.contains(&model.links[link].body) && !other.contains(&model.links[first.0].body)
        };
        let second =
            lows.iter().find(|(link, _)| is_on_other_leg(*link)).filter(|(_, low_m)| low_m - first.1 < UNEVEN_M);
        let name = |link: usize| &model.links[link].name;
        let second =
            second.ok_or_else(|| format!("only `{}` is on the ground, and nothing beside it", name(first.0)))?;
        // Feet have toes, and the sole is what the leg ends in.
        let sole = |(low, low_m): (usize, f64)| {
            let upward = path_of(low);
            let near =
                lows.iter().filter(|(link, at_m)| at_m - low_m < TOES_M && upward.contains(&model.links[*link].body));
            near.map(|(link, _)| *link).min_by_key(|link| path_of(*link).len()).unwrap_or(low)
        };
        let mut feet = [sole(*first), sole(*second)];
        if is_right(physics, feet) {
            feet.swap(0, 1);
        }
        let legs = Self::with_feet(physics, feet)?;
        let counts = legs.hinges.each_ref().map(Vec::len);
        if counts[0] < 2 || counts[0] != counts[1] {
            return Err(format!("the legs of `{}` and `{}` have {counts:?} hinges", name(feet[0]), name(feet[1])));
        }
        let is_of_leg = |link: usize| {
            feet.iter().any(|foot| {
                let (own, other) = (path_of(*foot), path_of(link));
                own.contains(&model.links[link].body) || other.contains(&model.links[*foot].body)
            })
        };
        match lows.iter().find(|(link, low_m)| low_m - first.1 < UNEVEN_M && !is_of_leg(*link)) {
            Some((third, _)) => Err(format!("`{}` stands on the ground beside two feet", name(*third))),
            None => Ok(legs),
        }
    }

    /// Returns the legs that end in these feet, the left one first.
    ///
    /// # Errors
    /// If no hinge moves one of them alone.
    pub fn with_feet(physics: &Physics, feet: [usize; 2]) -> Result<Self, String> {
        let model = physics.model();
        let paths = feet.map(|foot| path(model, model.links[foot].body));
        let own = |index: usize| -> Vec<usize> {
            let own = paths[index].iter().filter(|body| !paths[1 - index].contains(body));
            own.flat_map(|body| model.bodies[*body].hinges.clone()).collect()
        };
        let hinges = [own(0), own(1)];
        let [Some(left), Some(right)] = hinges.each_ref().map(|leg| leg.first()) else {
            let names = feet.map(|foot| &model.links[foot].name);
            return Err(format!("no hinge moves `{}` or `{}` alone", names[0], names[1]));
        };
        let hips_m = (anchor_m(physics, *left).z + anchor_m(physics, *right).z) / 2.0;
        let ground = |foot: usize| clearance::of_link_m(physics, foot).unwrap_or_default();
        let hip_height_m = hips_m - ground(feet[0]).min(ground(feet[1]));
        Ok(Self { feet, hinges: hinges.map(|leg| roles(physics, &leg)), hip_height_m })
    }

    /// Returns the axis of the base that points forward, by the places of the feet.
    pub fn forward(&self, physics: &Physics) -> BaseAxis {
        let [left, right] = self.feet.map(|foot| in_base(physics, foot));
        let ahead = (left - right).cross(&Vector3::z());
        let along = |axis: BaseAxis| (axis.turn() * Vector3::x()).dot(&ahead);
        let axes = BaseAxis::ALL.map(|(axis, _)| axis);
        axes.into_iter().max_by(|one, other| along(*one).total_cmp(&along(*other))).unwrap_or_default()
    }

    /// Returns the role of a hinge; `None` for one of no leg.
    pub fn role(&self, hinge: usize) -> Option<LegRole> {
        self.hinges.iter().flatten().find(|of| of.hinge == hinge).map(|of| of.role)
    }
}

/// Returns the bodies from the root to `body`, the root first.
fn path(model: &Model, body: usize) -> Vec<usize> {
    let mut path: Vec<usize> = model.upward(body).collect();
    path.reverse();
    path
}

/// Returns whether the first foot is the right one: by the names, or else by the places.
fn is_right(physics: &Physics, feet: [usize; 2]) -> bool {
    let model = physics.model();
    match feet.map(|foot| side_of(&model.links[foot].name)) {
        [Some(0), Some(1)] => false,
        [Some(1), Some(0)] => true,
        _ => {
            let [first, second] = feet.map(|foot| in_base(physics, foot));
            first.y < second.y
        }
    }
}

/// Returns where the frame of a link is, in that of the base (m).
fn in_base(physics: &Physics, link: usize) -> Point3<f64> {
    let place = Point3::from(physics.link_pose(link).translation.vector);
    physics.body_motion(0).pose.inverse_transform_point(&place)
}

/// Returns where a hinge is (m, world).
pub(super) fn anchor_m(physics: &Physics, hinge: usize) -> Point3<f64> {
    let model = physics.model();
    physics.body_motion(model.body_of_hinge(hinge)).pose * model.hinges[hinge].anchor_m
}

/// Returns the axis of a hinge (world).
pub(super) fn axis(physics: &Physics, hinge: usize) -> Vector3<f64> {
    let model = physics.model();
    let body = model.body_of_hinge(hinge);
    // Hinges of one body turn one after the other, so the later ones do not turn the axis.
    let later = (hinge + 1..model.bodies[body].hinges.end).rev();
    let turned = later.fold(UnitQuaternion::identity(), |turned, hinge| {
        UnitQuaternion::from_axis_angle(&model.hinges[hinge].axis, physics.joint_angles()[hinge]) * turned
    });
    physics.body_motion(body).pose.rotation * (turned.inverse() * *model.hinges[hinge].axis)
}

/// Gives the hinges of a leg their roles: of those that swing it forwards, the middle one is the knee.
fn roles(physics: &Physics, leg: &[usize]) -> Vec<LegHinge> {
    let base = physics.body_motion(0).pose.rotation;
    let left = |hinge: usize| (base.inverse() * axis(physics, hinge)).y;
    let swing: Vec<usize> = (0..leg.len()).filter(|at| left(leg[*at]).abs() > LATERAL).collect();
    // A leg without an ankle has two of them.
    let knee = if swing.len() >= 2 { Some(swing[swing.len() / 2]) } else { None };
    let role = |at: usize| match knee {
        Some(knee) if at == knee => LegRole::Knee,
        Some(knee) if at > knee => LegRole::Ankle,
        _ => LegRole::Hip,
    };
    let backwards = |hinge: usize| if left(hinge).abs() > LATERAL { left(hinge).signum() } else { 0.0 };
    leg.iter()
        .enumerate()
        .map(|(at, hinge)| LegHinge { hinge: *hinge, role: role(at), backwards: backwards(*hinge) })
        .collect()
}
