//! Equalities: hinges that follow others, and points of two links that stay together.

use nalgebra::Point3;

use super::Model;
use super::softness::Softness;

/// Hinge that follows another one: angle = offset + ratio × angle of the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// Name in the text.
    pub name: String,
    /// Index into [`super::Model::hinges`].
    pub hinge: usize,
    /// Index of the other hinge, and the ratio; `None` if the angle is constant.
    pub follows: Option<(usize, f64)>,
    /// Angle where that of the other hinge is 0 (rad).
    pub offset_rad: f64,
    /// Softness in both directions.
    pub softness: Softness,
}

/// Point of a link that stays at a point of another link.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// Name in the text.
    pub name: String,
    /// Indices into [`super::Model::links`], of different rigid bodies.
    pub links: [usize; 2],
    /// The points in the frames of the links' rigid bodies (m).
    pub points_m: [Point3<f64>; 2],
    /// Softness in each direction.
    pub softness: Softness,
}

impl Model {
    /// Returns what moves a hinge that needs no motor: the hinge that it follows, or the loop that it is part of. `None` for
    /// any other hinge.
    #[must_use]
    pub fn moved_by(&self, hinge: usize) -> Option<String> {
        let has_motor = |hinge: usize| self.motors.iter().any(|motor| motor.hinge == hinge);
        if has_motor(hinge) {
            return None;
        }
        let follows = |coupling: &Coupling| match coupling.follows {
            None => (coupling.hinge == hinge).then(|| "kept at one angle by an equality".to_owned()),
            Some((other, _)) => {
                let leads = if coupling.hinge == hinge { other } else { coupling.hinge };
                let is_of_it = coupling.hinge == hinge || (other == hinge && has_motor(leads));
                is_of_it.then(|| format!("follows `{}`", self.hinges[leads].name))
            }
        };
        let body = self.body_of_hinge(hinge);
        let loops = |connection: &Connection| {
            let [one, other] =
                connection.links.map(|link| self.upward(self.links[link].body).any(|above| above == body));
            (one != other && !self.motors.is_empty()).then(|| format!("part of the loop `{}`", connection.name))
        };
        self.couplings.iter().find_map(follows).or_else(|| self.connections.iter().find_map(loops))
    }

    /// Gives each hinge that follows another one the angle that its equality asks for; of two, the one without a motor
    /// follows.
    pub(crate) fn apply_couplings(&self, position: &mut [f64]) {
        let has_motor = |hinge: usize| self.motors.iter().any(|motor| motor.hinge == hinge);
        // Hinges may follow in a chain, in any order.
        for coupling in self.couplings.iter().flat_map(|_| &self.couplings) {
            match coupling.follows {
                Some((other, ratio)) if has_motor(coupling.hinge) && !has_motor(other) && ratio != 0.0 => {
                    position[7 + other] = (position[7 + coupling.hinge] - coupling.offset_rad) / ratio;
                }
                follows => {
                    let of_other = follows.map_or(0.0, |(other, ratio)| ratio * position[7 + other]);
                    position[7 + coupling.hinge] = coupling.offset_rad + of_other;
                }
            }
        }
    }
}
