//! Convex hulls of vertices.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Matrix3, Point3, Vector3};
use robust::{Coord3D, orient3d};

/// Least thickness of a hull relative to its extent.
const FLAT: f64 = 1e-6;
/// Least squared sine of the angles between the faces at a corner.
const SMOOTH: f64 = 1e-12;

/// Distance from a simplified hull, relative to its extent, up to which corners are left out.
const SIMPLE: f64 = 2e-3;
/// Most corners of a simplified hull: contact queries visit each.
pub(crate) const CORNERS_MAX: usize = 64;

/// Height of a triangle relative to its longest side up to which rounding decides its normal.
const SLIVER: f64 = 1e-7;

/// Triangle of a hull; its normal points outwards, or is zero if the triangle is nearly a line, which its neighbours cover.
struct Face {
    corners: [usize; 3],
    normal: Vector3<f64>,
    /// Position of its plane along the normal.
    offset: f64,
}

impl Face {
    fn new(points: &[Point3<f64>], corners: [usize; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| points[corner]);
        let longest = [b - a, c - b, a - c].iter().map(Vector3::norm_squared).fold(0.0, f64::max);
        let normal = (b - a).cross(&(c - a)).try_normalize(longest * SLIVER).unwrap_or_else(Vector3::zeros);
        Self { corners, normal, offset: normal.dot(&a.coords) }
    }

    /// Returns whether a point is in front of the face, without rounding: files round what should lie in a plane to 32 bits,
    /// and a hull stays closed only if each such point is on the same side of a plane whenever it is asked.
    /// (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates".)
    fn is_seen_from(&self, points: &[Point3<f64>], point: &Point3<f64>) -> bool {
        let [a, b, c, d] = [points[self.corners[0]], points[self.corners[1]], points[self.corners[2]], *point]
            .map(|point| Coord3D { x: point.x, y: point.y, z: point.z });
        orient3d(a, b, c, d) < 0.0
    }

    /// Returns the distance of a point in front of the face.
    fn distance(&self, point: &Point3<f64>) -> f64 {
        self.normal.dot(&point.coords) - self.offset
    }
}

/// Returns the faces of the convex hull as indices of vertices, counter-clockwise from outside; `None` if it is flat.
pub(crate) fn faces(points: &[Point3<f64>]) -> Option<Vec<[usize; 3]>> {
    let first = first_tetrahedron(points, extent(points) * FLAT)?;
    let [a, b, c, d] = first;
    let mut faces: Vec<Face> =
        [[a, b, c], [a, d, b], [b, d, c], [c, d, a]].into_iter().map(|corners| Face::new(points, corners)).collect();
    for (index, point) in points.iter().enumerate().filter(|(index, _)| !first.contains(index)) {
        let mut edges = BTreeSet::new();
        faces.retain(|face| {
            let is_hidden = !face.is_seen_from(points, point);
            if !is_hidden {
                let [a, b, c] = face.corners;
                edges.extend([(a, b), (b, c), (c, a)]);
            }
            is_hidden
        });
        // The edges between removed and remaining faces surround the new ones.
        let outline = edges.iter().filter(|(from, to)| !edges.contains(&(*to, *from)));
        faces.extend(outline.map(|(from, to)| Face::new(points, [*from, *to, index])));
    }
    Some(faces.into_iter().map(|face| face.corners).collect())
}

/// Returns the corners of the convex hull, in their order; `None` if it is flat.
pub(crate) fn vertices(points: &[Point3<f64>]) -> Option<Vec<Point3<f64>>> {
    // The normals around a corner span all three directions, unlike those around a point within a face or an edge.
    let mut spans: BTreeMap<usize, Matrix3<f64>> = BTreeMap::new();
    for corners in faces(points)? {
        let normal = Face::new(points, corners).normal;
        for corner in corners {
            *spans.entry(corner).or_default() += normal * normal.transpose();
        }
    }
    let is_corner = |span: &Matrix3<f64>| span.symmetric_eigenvalues().min() > SMOOTH;
    Some(spans.iter().filter(|(_, span)| is_corner(span)).map(|(corner, _)| points[*corner]).collect())
}

/// Returns corners of the convex hull, such that all points are within [`SIMPLE`] of the hull of these corners, but at most
/// [`CORNERS_MAX`]; `None` if it is flat. Each corner is the farthest outside of the hull of those before.
///
pub(crate) fn simplified(points: &[Point3<f64>]) -> Option<Vec<Point3<f64>>> {
    let near = extent(points) * SIMPLE;
    let mut corners: Vec<Point3<f64>> = first_tetrahedron(points, near)?.map(|index| points[index]).into();
    let mut outside = points.to_vec();
    while corners.len() < CORNERS_MAX {
        let faces: Vec<Face> = faces(&corners)?.into_iter().map(|indices| Face::new(&corners, indices)).collect();
        let distance = |point: &Point3<f64>| faces.iter().map(|face| face.distance(point)).fold(0.0, f64::max);
        let mut farthest = (near, None);
        // A growing hull keeps what is within.
        outside.retain(|point| {
            let distance = distance(point);
            if distance > farthest.0 {
                farthest = (distance, Some(*point));
            }
            distance > near
        });
        let Some(corner) = farthest.1 else { break };
        corners.push(corner);
    }
    Some(corners)
}

/// Returns the longest side of the box around all points.
fn extent(points: &[Point3<f64>]) -> f64 {
    let side = |axis: usize| {
        let ends = points.iter().map(|point| point[axis]);
        ends.clone().fold(f64::NEG_INFINITY, f64::max) - ends.fold(f64::INFINITY, f64::min)
    };
    (0..3).map(side).fold(0.0, f64::max)
}

/// Returns four vertices far from each other, the first three clockwise from the fourth; `None` if all are within
/// `thickness` of a plane.
fn first_tetrahedron(points: &[Point3<f64>], thickness: f64) -> Option<[usize; 4]> {
    let farthest = |distance: &dyn Fn(&Point3<f64>) -> f64| {
        let distances = points.iter().map(distance).enumerate();
        let (index, distance) = distances.fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
        (distance > thickness).then_some(index)
    };
    let a = *points.first()?;
    let first = farthest(&|point| nalgebra::distance(&a, point))?;
    let a = points[first];
    let second = farthest(&|point| nalgebra::distance(&a, point))?;
    let along = (points[second] - a).normalize();
    let third = farthest(&|point| (point - a).cross(&along).norm())?;
    let normal = along.cross(&(points[third] - a)).normalize();
    let fourth = farthest(&|point| (point - a).dot(&normal).abs())?;
    // Seen from the fourth, the face of the others must be turned away.
    let is_above = (points[fourth] - a).dot(&normal) > 0.0;
    Some(if is_above { [first, third, second, fourth] } else { [first, second, third, fourth] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn flat_and_missing_hulls_are_none() {
        let flat = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [0.3, 0.4, 1.0 + 1e-8]];
        assert!(faces(&flat.map(Point3::from)).is_none());
        assert!(faces(&[]).is_none());
        assert!(faces(&[Point3::origin(); 9]).is_none());
        let line: Vec<Point3<f64>> = (0..9).map(|x| Point3::new(f64::from(x), 0.0, 0.0)).collect();
        assert!(faces(&line).is_none());
    }

    proptest! {
        #[test]
        fn hulls_contain_all_points(points in prop::collection::vec(prop::array::uniform3(-4i8..4), 4..60)) {
            let points: Vec<Point3<f64>> =
                points.into_iter().map(|point| Point3::from(point.map(|entry| f64::from(entry) * 0.1))).collect();
            // A grid has many coplanar, collinear and equal points.
            let is_flat = first_tetrahedron(&points, 1e-6).is_none();
            let Some(found) = faces(&points) else { prop_assert!(is_flat); return Ok(()); };
            for corners in &found {
                let face = Face::new(&points, *corners);
                prop_assert!(points.iter().all(|point| face.distance(point) < 1e-8));
            }
            let corners = vertices(&points).expect("solid");
            prop_assert!(faces(&corners).is_some());
        }
    }
}
