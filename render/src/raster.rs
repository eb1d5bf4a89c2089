//! Triangles on a grid of samples, the nearest one first.

use std::{collections::HashMap, sync::Arc};

use nalgebra::{Isometry3, Vector3};

use crate::TriangleMesh;

/// Cosine of the angle between two triangles above which there is an edge between them; below it the surface is round.
const EDGE_COSINE: f32 = 0.75;
/// Share of an edge by which neighbouring triangles overlap, so that no sample falls between them.
const OVERLAP: f32 = 1e-5;

/// Surface with a normal at each corner of each triangle.
#[derive(Clone, Debug)]
pub(crate) struct Skin {
    pub corners_m: Vec<Vector3<f32>>,
    pub triangles: Vec<[u32; 3]>,
    pub normals: Vec<[Vector3<f32>; 3]>,
}

impl Skin {
    /// Joins corners in the same cube of `detail_m`, leaves out triangles that this makes a line, and rounds the normals
    /// between triangles that have no edge between them.
    pub fn of(mesh: &TriangleMesh, detail_m: f32) -> Arc<Self> {
        let (mut corners_m, mut places) = (Vec::new(), HashMap::new());
        let mut joined = |corner: u32| {
            let at = mesh.corners_m[corner as usize];
            *places.entry(at.map(|part| (part / detail_m).round() as i32)).or_insert_with(|| {
                corners_m.push(Vector3::from(at));
                corners_m.len() as u32 - 1
            })
        };
        let triangles = mesh.triangles.iter().map(|corners| corners.map(&mut joined));
        let triangles: Vec<[u32; 3]> = triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        // A normal is as long as its triangle is large, so that the sum at a corner is weighted.
        let normal = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| corners_m[corner as usize]);
            (b - a).cross(&(c - a))
        };
        let own: Vec<Vector3<f32>> = triangles.iter().map(normal).collect();
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); corners_m.len()];
        for (triangle, corners) in triangles.iter().enumerate() {
            corners.iter().for_each(|corner| around[*corner as usize].push(triangle as u32));
        }
        let round = |(triangle, corners): (usize, &[u32; 3])| {
            let flat = own[triangle].try_normalize(0.0).unwrap_or_else(Vector3::z);
            corners.map(|corner| {
                let near = around[corner as usize].iter().map(|other| own[*other as usize]);
                let sum: Vector3<f32> = near.filter(|other| other.dot(&flat) > EDGE_COSINE * other.norm()).sum();
                if mesh.is_faceted { flat } else { sum.try_normalize(0.0).unwrap_or(flat) }
            })
        };
        let normals = triangles.iter().enumerate().map(round).collect();
        Arc::new(Self { corners_m, triangles, normals })
    }

    /// Returns the corners as seen along three axes from a point, with the skin at a pose.
    pub fn seen(&self, pose: &Isometry3<f32>, axes: &[Vector3<f32>; 3], from: &Vector3<f32>) -> Vec<Vector3<f32>> {
        let turn = nalgebra::Matrix3::from_rows(&axes.map(|axis| axis.transpose()));
        let (turn, offset) = (turn * pose.rotation.to_rotation_matrix(), turn * (pose.translation.vector - from));
        self.corners_m.iter().map(|corner| turn * corner + offset).collect()
    }
}

/// Nearness of what is seen at each sample, from which it grows as the distance falls; 0 where nothing is seen.
pub(crate) struct Samples {
    pub width: usize,
    pub height: usize,
    pub nearness: Vec<f32>,
}

impl Samples {
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, nearness: vec![0.0; width * height] }
    }

    /// Draws a triangle whose corners have a column, a row and a nearness. Calls `show` for each sample at which it is the
    /// nearest so far, with the shares of its corners.
    pub fn draw(&mut self, [a, b, c]: [&Vector3<f32>; 3], mut show: impl FnMut(usize, [f32; 3])) {
        // Samples are in the middle of their cells.
        let within = |axis: usize, most: usize| {
            let (low, high) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
            // The conversion rounds down, and turns what is below 0 into 0.
            ((low + 0.5) as usize)..((high + 0.5) as usize).min(most)
        };
        let (columns, rows) = (within(0, self.width), within(1, self.height));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let by = 1.0 / ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
        if !by.is_finite() {
            return;
        }
        for row in rows {
            let y = row as f32 + 0.5;
            for column in columns.clone() {
                let x = column as f32 + 0.5;
                let of_a = ((b.x - x) * (c.y - y) - (c.x - x) * (b.y - y)) * by;
                let of_b = ((c.x - x) * (a.y - y) - (a.x - x) * (c.y - y)) * by;
                let of_c = 1.0 - of_a - of_b;
                let nearness = of_a * a.z + of_b * b.z + of_c * c.z;
                let place = row * self.width + column;
                if of_a >= -OVERLAP && of_b >= -OVERLAP && of_c >= -OVERLAP && nearness > self.nearness[place] {
                    self.nearness[place] = nearness;
                    show(place, [of_a, of_b, of_c]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_triangle_is_seen_and_neighbours_leave_no_gap() {
        let corner = |x: f32, y: f32, near: f32| Vector3::new(x, y, near);
        let mut samples = Samples::new(9, 7);
        let mut seen = vec![0; 63];
        let quad = [corner(-2.0, -3.0, 1.0), corner(12.3, -1.0, 1.0), corner(11.0, 9.7, 1.0), corner(-4.0, 8.0, 1.0)];
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            samples.draw([&quad[a], &quad[b], &quad[c]], |place, _| seen[place] = 1);
        }
        assert_eq!(seen, [1; 63]);
        let near = [corner(0.0, 0.0, 2.0), corner(4.0, 0.0, 2.0), corner(0.0, 4.0, 4.0)];
        samples.draw([&near[0], &near[1], &near[2]], |place, shares| {
            seen[place] = 2;
            assert!((shares.iter().sum::<f32>() - 1.0).abs() < 1e-6);
        });
        // Samples with column + row + 1 <= 4 lie in the triangle.
        let wanted = |place: usize| if place % 9 + place / 9 <= 3 { 2 } else { 1 };
        assert_eq!(seen, (0..63).map(wanted).collect::<Vec<_>>());
        assert!((samples.nearness[9 + 1] - 2.75).abs() < 1e-6, "a quarter and an eighth of the way to nearness 4");
        samples.draw([&quad[0], &quad[1], &quad[2]], |_, _| panic!("it is as near as what is seen already"));
    }

    #[test]
    fn round_surfaces_have_round_normals_and_edges_stay() {
        let ball = treadmill_humanoid::model::Geometry::Sphere { centre_m: [0.0; 3].into(), radius_m: 0.5 };
        let skin = Skin::of(&TriangleMesh::of(&ball), 1e-6);
        for (corners, normals) in skin.triangles.iter().zip(&skin.normals) {
            for (corner, normal) in corners.iter().zip(normals) {
                let off = (skin.corners_m[*corner as usize].normalize() - normal).norm();
                assert!(off < 0.1 || normal.norm() == 1.0 && off < 0.3, "{off}");
            }
        }
        let die = treadmill_humanoid::model::Geometry::Box {
            pose: Isometry3::identity(),
            half_m: Vector3::new(0.1, 0.2, 0.3),
        };
        let unmarked = TriangleMesh { is_faceted: false, ..TriangleMesh::of(&die) };
        for normal in Skin::of(&unmarked, 1e-6).normals.as_flattened() {
            assert!((normal.amax() - 1.0).abs() < 1e-6, "{normal}");
        }
        // With cubes as large as the die only corners remain that are in different ones.
        let coarse = Skin::of(&unmarked, 0.3);
        assert!(coarse.corners_m.len() < 8 && coarse.triangles.len() < 12, "{coarse:?}");
    }
}
