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

    /// Returns the height of its lowest point, with its body at `body` (m, world).
    #[must_use]
    pub fn lowest_m(&self, body: &Isometry3<f64>) -> f64 {
        // Row of a rotation that gives the height: the world's z axis in the frame of the shape.
        let down = |pose: &Isometry3<f64>| (body * pose).rotation.inverse() * Vector3::z();
        let centre_m = (body * self.centre_m()).z;
        match self {
            Self::Sphere { radius_m, .. } => centre_m - radius_m,
            Self::Capsule { from_m, to_m, radius_m } => (body * from_m).z.min((body * to_m).z) - radius_m,
            Self::Cylinder { pose, radius_m, half_length_m } => {
                let down = down(pose);
                centre_m - half_length_m * down.z.abs() - radius_m * down.x.hypot(down.y)
            }
            Self::Box { pose, half_m } => centre_m - down(pose).abs().dot(half_m),
            Self::Ellipsoid { pose, half_m } => centre_m - down(pose).component_mul(half_m).norm(),
            Self::Hull { vertices_m } => {
                vertices_m.iter().map(|vertex| (body * vertex).z).fold(f64::INFINITY, f64::min)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_point_of_each_shape_is_found() {
        let tilted = Isometry3::new(Vector3::new(0.0, 0.0, 1.0), Vector3::new(0.3, -0.4, 0.2));
        let own = Isometry3::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.5, 0.1, -0.2));
        let half_m = Vector3::new(0.1, 0.2, 0.3);
        // Points on the surface, in the frame of the shape.
        let around = |count: usize| (0..count).map(move |n| 2.0 * std::f64::consts::PI * n as f64 / count as f64);
        let ball: Vec<Vector3<f64>> = around(400)
            .flat_map(|a| around(400).map(move |b| Vector3::new(a.cos() * b.cos(), a.sin() * b.cos(), b.sin())))
            .collect();
        let disc: Vec<Vector3<f64>> = around(2000)
            .flat_map(|a| [-1.0, 1.0].map(|z| Vector3::new(0.1 * a.cos(), 0.1 * a.sin(), 0.3 * z)))
            .collect();
        let corners: Vec<Vector3<f64>> = (0..8)
            .map(|n| half_m.component_mul(&Vector3::from_fn(|axis, _| if n >> axis & 1 == 0 { -1.0 } else { 1.0 })))
            .collect();
        let ellipsoid = ball.iter().map(|point| point.component_mul(&half_m)).collect();
        for (geometry, points) in [
            (Geometry::Cylinder { pose: own, radius_m: 0.1, half_length_m: 0.3 }, disc),
            (Geometry::Box { pose: own, half_m }, corners),
            (Geometry::Ellipsoid { pose: own, half_m }, ellipsoid),
        ] {
            let heights = points.iter().map(|point: &Vector3<f64>| (tilted * own * nalgebra::Point3::from(*point)).z);
            let wanted_m = heights.fold(f64::INFINITY, f64::min);
            assert!((geometry.lowest_m(&tilted) - wanted_m).abs() < 1e-5, "{geometry:?}");
        }
    }
}
