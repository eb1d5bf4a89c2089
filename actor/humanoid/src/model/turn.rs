//! Another frame for the base of a robot.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use serde::Deserialize;

use super::{Geometry, Link, Model};

/// Horizontal axis of a base's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum BaseAxis {
    /// +x, where robots face by convention.
    #[default]
    #[serde(rename = "+x")]
    X,
    /// +y.
    #[serde(rename = "+y")]
    Y,
    /// −x.
    #[serde(rename = "-x")]
    MinusX,
    /// −y.
    #[serde(rename = "-y")]
    MinusY,
}

impl BaseAxis {
    /// Axes with their names.
    pub const ALL: [(Self, &'static str); 4] =
        [(Self::X, "+x"), (Self::Y, "+y"), (Self::MinusX, "-x"), (Self::MinusY, "-y")];

    /// Returns the rotation about z from +x to this axis.
    #[must_use]
    pub fn turn(self) -> UnitQuaternion<f64> {
        let angle_rad = match self {
            Self::X => 0.0,
            Self::Y => FRAC_PI_2,
            Self::MinusX => PI,
            Self::MinusY => -FRAC_PI_2,
        };
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle_rad)
    }
}

impl Model {
    /// Turns the frame of the base so that its x axis points where `forward` did. The robot stays as it is.
    pub fn turn_base(&mut self, forward: BaseAxis) {
        if forward == BaseAxis::X {
            return;
        }
        let turn = forward.turn();
        let back = Isometry3::from_parts(nalgebra::Translation3::identity(), turn.inverse());
        let root = &mut self.bodies[0];
        root.pose.rotation *= turn;
        root.shapes.iter_mut().for_each(|shape| shape.geometry.moved_by(&back));
        root.centre_of_mass_m = back * root.centre_of_mass_m;
        let rotation = back.rotation.to_rotation_matrix();
        let turned = |inertia: &nalgebra::Matrix3<f64>| rotation.matrix() * inertia * rotation.matrix().transpose();
        root.inertia_kgm2 = turned(&root.inertia_kgm2);
        for (index, link) in self.links.iter_mut().enumerate().filter(|(_, link)| link.body == 0) {
            // The frame of the base's own link turns with it.
            if index > 0 {
                link.pose = back * link.pose;
            }
            link.centre_of_mass_m = back * link.centre_of_mass_m;
            link.inertia_kgm2 = turned(&link.inertia_kgm2);
        }
        for body in self.bodies.iter_mut().filter(|body| body.parent == Some(0)) {
            body.pose = back * body.pose;
        }
        for connection in &mut self.connections {
            for (link, point_m) in connection.links.into_iter().zip(&mut connection.points_m) {
                if self.links[link].body == 0 {
                    *point_m = back * *point_m;
                }
            }
        }
        for key in &mut self.keyframes {
            if let [w, x, y, z] = key.position[3..7] {
                let moved = Quaternion::new(w, x, y, z) * turn.into_inner();
                key.position[3..7].copy_from_slice(&[moved.w, moved.i, moved.j, moved.k]);
            }
            let rates = back * Vector3::new(key.velocity[3], key.velocity[4], key.velocity[5]);
            key.velocity[3..6].copy_from_slice(rates.as_slice());
        }
    }
}

impl Model {
    /// Returns the pose in its body of the frame that a link has in the file.
    #[must_use]
    pub fn pose_in_file(&self, link: &Link) -> Isometry3<f64> {
        let is_base = link.name == self.links[0].name;
        let turn = self.robot.as_ref().filter(|_| is_base).map(|robot| robot.forward.turn().inverse());
        turn.map_or(link.pose, |turn| link.pose * turn)
    }
}

impl Geometry {
    /// Moves the shape to where `motion` takes it.
    fn moved_by(&mut self, motion: &Isometry3<f64>) {
        match self {
            Self::Sphere { centre_m, .. } => *centre_m = motion * *centre_m,
            Self::Capsule { from_m, to_m, .. } => (*from_m, *to_m) = (motion * *from_m, motion * *to_m),
            Self::Cylinder { pose, .. } | Self::Box { pose, .. } | Self::Ellipsoid { pose, .. } => {
                *pose = motion * *pose
            }
            Self::Hull { vertices_m } => vertices_m.iter_mut().for_each(|vertex| *vertex = motion * *vertex),
        }
    }
}
