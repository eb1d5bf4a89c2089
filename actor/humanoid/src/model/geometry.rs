//! Forms of shapes.

use nalgebra::{Isometry3, Point3, Vector3};

use super::hull;

/// Form and position of a shape; lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// Sphere.
    Sphere {
        /// Centre.
        centre_m: Point3<f64>,
        /// Radius.
        radius_m: f64,
    },
    /// All points within a radius of a line segment.
    Capsule {
        /// One end of the segment.
        from_m: Point3<f64>,
        /// Other end.
        to_m: Point3<f64>,
        /// Radius.
        radius_m: f64,
    },
    /// Cylinder along the z axis of its pose.
    Cylinder {
        /// Centre and orientation.
        pose: Isometry3<f64>,
        /// Radius.
        radius_m: f64,
        /// Distance from the centre to either end.
        half_length_m: f64,
    },
    /// Box.
    Box {
        /// Centre and orientation.
        pose: Isometry3<f64>,
        /// Half of each side.
        half_m: Vector3<f64>,
    },
    /// Ellipsoid; touches others as a hull of points on it.
    Ellipsoid {
        /// Centre and orientation.
        pose: Isometry3<f64>,
        /// Semi-axes.
        half_m: Vector3<f64>,
    },
    /// Convex hull of points.
    Hull {
        /// Its corners.
        vertices_m: Vec<Point3<f64>>,
    },
}

impl Geometry {
    /// Returns the centre in the body's frame (m); of a hull, the mean of its vertices.
    #[must_use]
    pub fn centre_m(&self) -> Point3<f64> {
        match self {
            Self::Sphere { centre_m, .. } => *centre_m,
            Self::Capsule { from_m, to_m, .. } => nalgebra::center(from_m, to_m),
            Self::Cylinder { pose, .. } | Self::Box { pose, .. } | Self::Ellipsoid { pose, .. } => {
                Point3::from(pose.translation.vector)
            }
            Self::Hull { vertices_m } => {
                let sum: Vector3<f64> = vertices_m.iter().map(|vertex| vertex.coords).sum();
                Point3::from(sum / vertices_m.len().max(1) as f64)
            }
        }
    }

    /// Returns the triangles of a hull as indices of its vertices, counter-clockwise from outside; none for other shapes.
    #[must_use]
    pub fn hull_faces(&self) -> Vec<[usize; 3]> {
        match self {
            Self::Hull { vertices_m } => hull::faces(vertices_m).unwrap_or_default(),
            _ => Vec::new(),
        }
    }
}
