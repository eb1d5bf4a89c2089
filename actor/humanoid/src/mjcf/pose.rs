//! Positions and orientations, which MJCF writes in five ways.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Quaternion, Unit, UnitQuaternion, Vector3};

use super::element::{Attribute, Element};

/// Shortest axis, and cross product of axes, that is not zero.
const LEAST: f64 = 1e-15;

/// Unit of angles and sequence of Euler angles in a text.
#[derive(Clone, Debug)]
pub(super) struct Angles {
    pub(super) are_degrees: bool,
    /// Three of the letters xyzXYZ; capitals turn about the axes of the parent.
    pub(super) sequence: String,
}

impl Angles {
    /// Returns an angle of the text in radians.
    pub(super) fn radians(&self, angle: f64) -> f64 {
        if self.are_degrees { angle * PI / 180.0 } else { angle }
    }

    /// Returns the pose of an element within the one around it.
    pub(super) fn pose(&self, element: &Element) -> Pose {
        Pose { place_m: element.list_over("pos", [0.0; 3]).into(), turn: self.orientation(element) }
    }

    fn orientation(&self, element: &Element) -> Quaternion<f64> {
        if element.get("quat").is_some() {
            let [w, x, y, z] = element.list_over("quat", [0.0; 4]);
            return normalized(Quaternion::new(w, x, y, z));
        }
        if element.get("axisangle").is_some() {
            let [x, y, z, angle] = element.list_over("axisangle", [0.0; 4]);
            let axis = Vector3::new(x, y, z);
            return match axis.norm() {
                length if length <= LEAST => Quaternion::identity(),
                length => about(axis / length, self.radians(angle)),
            };
        }
        if element.get("euler").is_some() {
            let angles = element.list_over("euler", [0.0; 3]).map(|angle| self.radians(angle));
            return self.of_euler(angles);
        }
        if element.get("xyaxes").is_some() {
            let [x, y, z, other_x, other_y, other_z] = element.list_over("xyaxes", [0.0; 6]);
            return of_axes(Vector3::new(x, y, z), Vector3::new(other_x, other_y, other_z));
        }
        of_z_axis(element.list_over("zaxis", [0.0; 3]).into())
    }

    /// Returns the pose at a place (m) with these Euler angles, which are in the unit of the text.
    pub(super) fn turned_at(&self, place_m: Vector3<f64>, angles: [f64; 3]) -> Pose {
        Pose { place_m, turn: self.of_euler(angles.map(|angle| self.radians(angle))) }
    }

    fn of_euler(&self, angles: [f64; 3]) -> Quaternion<f64> {
        let turned = self.sequence.chars().zip(angles).fold(Quaternion::identity(), |turned, (letter, angle)| {
            let axis = match letter.to_ascii_lowercase() {
                'x' => Vector3::x(),
                'y' => Vector3::y(),
                _ => Vector3::z(),
            };
            let turn = about(axis, angle);
            if letter.is_ascii_lowercase() { turned * turn } else { turn * turned }
        });
        normalized(turned)
    }
}

/// Position (m) and orientation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    place_m: Vector3<f64>,
    turn: Quaternion<f64>,
}

impl Pose {
    pub(super) const IDENTITY: Self =
        Self { place_m: Vector3::new(0.0, 0.0, 0.0), turn: Quaternion::new(1.0, 0.0, 0.0, 0.0) };

    /// Returns the pose of what has the pose `inner` in a frame of this pose.
    pub(super) fn times(&self, inner: &Self) -> Self {
        let (scalar, vector, place_m) = (self.turn.w, self.turn.imag(), &inner.place_m);
        let turned_m = place_m * (scalar * scalar - vector.dot(&vector))
            + vector * (place_m.dot(&vector) * 2.0)
            + vector.cross(place_m) * (scalar * 2.0);
        Self { place_m: self.place_m + turned_m, turn: self.turn * inner.turn }
    }

    /// Returns the attributes that give this pose.
    pub(super) fn attributes(&self) -> Vec<Attribute> {
        let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let Quaternion { coords: turn } = self.turn;
        let place = ("pos".to_owned(), list(self.place_m.as_slice()));
        vec![place, ("quat".to_owned(), list(&[turn.w, turn.x, turn.y, turn.z]))]
    }

    pub(super) fn isometry(&self) -> Isometry3<f64> {
        Isometry3::from_parts(self.place_m.into(), UnitQuaternion::new_normalize(self.turn))
    }
}

fn normalized(quaternion: Quaternion<f64>) -> Quaternion<f64> {
    let Quaternion { coords: all } = quaternion;
    let squared = all.x * all.x + all.y * all.y + all.z * all.z + all.w * all.w;
    if squared <= LEAST * LEAST { Quaternion::identity() } else { quaternion * (1.0 / squared.sqrt()) }
}

/// Returns a rotation about an axis of length 1.
fn about(axis: Vector3<f64>, angle_rad: f64) -> Quaternion<f64> {
    UnitQuaternion::from_axis_angle(&Unit::new_unchecked(axis), angle_rad).into_inner()
}

/// Returns the shortest rotation of the z axis to another one.
fn of_z_axis(axis: Vector3<f64>) -> Quaternion<f64> {
    let length = axis.norm();
    if length <= LEAST {
        return Quaternion::identity();
    }
    let axis = axis / length;
    if axis.z.abs() <= 1.0 - 2.0 * f64::EPSILON {
        let across = Vector3::z().cross(&axis);
        normalized(Quaternion::from_parts(1.0 + axis.z, across))
    } else if axis.z > 0.0 {
        Quaternion::identity()
    } else {
        about(Vector3::y(), PI)
    }
}

/// Returns the orientation of a frame with a given x axis and the y axis in the plane of both.
fn of_axes(x: Vector3<f64>, y: Vector3<f64>) -> Quaternion<f64> {
    if x.norm() <= LEAST {
        return Quaternion::identity();
    }
    let x = x / x.norm();
    let z = x.cross(&y);
    if z.norm() <= LEAST {
        return Quaternion::identity();
    }
    let z = z / z.norm();
    let y = z.cross(&x);
    // Of four times w, x, y and z, each times the largest of them.
    let (difference, sum) = (y.y - x.x, y.y + x.x);
    let (squared, [i, j, k, w]) = match (z.z <= 0.0, difference <= 0.0, sum <= 0.0) {
        (true, true, _) => {
            let squared = 1.0 - z.z - difference;
            (squared, [squared, x.y + y.x, x.z + z.x, y.z - z.y])
        }
        (true, false, _) => {
            let squared = 1.0 - z.z + difference;
            (squared, [x.y + y.x, squared, y.z + z.y, z.x - x.z])
        }
        (false, _, true) => {
            let squared = 1.0 + z.z - sum;
            (squared, [x.z + z.x, y.z + z.y, squared, x.y - y.x])
        }
        (false, _, false) => {
            let squared = 1.0 + z.z + sum;
            (squared, [y.z - z.y, z.x - x.z, x.y - y.x, squared])
        }
    };
    normalized(Quaternion::new(w, i, j, k) * (0.5 / squared.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(attribute: &str, value: &str, vector: [f64; 3]) -> [f64; 3] {
        let attributes = vec![(attribute.to_owned(), value.to_owned())];
        let element = Element { tag: "body".to_owned(), label: "part".to_owned(), attributes };
        let angles = Angles { are_degrees: true, sequence: "xyz".to_owned() };
        (angles.pose(&element).isometry().rotation * Vector3::from(vector)).into()
    }

    #[test]
    fn all_ways_of_writing_an_orientation_agree() {
        // A quarter turn about x: y becomes z.
        for (attribute, value) in [
            ("quat", "2 2 0 0"),
            ("axisangle", "3 0 0 90"),
            ("euler", "90 0 0"),
            ("xyaxes", "2 0 0 1 0 4"),
            ("zaxis", "0 -1 0"),
        ] {
            let found = turned(attribute, value, [0.0, 1.0, 0.0]);
            assert!((Vector3::from(found) - Vector3::z()).norm() < 1e-12, "{attribute}: {found:?}");
        }
    }

    #[test]
    fn axes_in_all_directions_become_the_frame() {
        for (x, y) in
            [("1 0 0", "0 1 0"), ("-1 0 0", "0 1 0"), ("0 0 1", "0 1 0"), ("1 0 0", "0 -1 0"), ("-1 0 0", "0 -1 0")]
        {
            let [wanted_x, wanted_y] = [x, y].map(|axis| super::super::element::numbers(axis).expect("numbers"));
            let found = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|axis| turned("xyaxes", &format!("{x} {y}"), axis));
            for (found, wanted) in found.iter().zip([wanted_x, wanted_y]) {
                assert!(
                    found.iter().zip(&wanted).all(|(one, other)| (one - other).abs() < 1e-12),
                    "{x} {y}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn an_opposite_z_axis_is_half_a_turn() {
        assert!((Vector3::from(turned("zaxis", "0 0 -3", [0.0, 0.0, 1.0])) + Vector3::z()).norm() < 1e-12);
    }
}
