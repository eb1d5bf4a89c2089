//! Volume of a solid that triangles enclose, with its first and second moments.

use nalgebra::{Matrix3, Point3, Vector3};

use super::hull;
use super::inertia::MassProperties;

/// Moments about the origin of a mesh's geom. With them no other machine needs the triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moments {
    /// Volume (m³).
    volume: f64,
    /// Integral of the position (m⁴).
    first: Vector3<f64>,
    /// Integral of the position times its transpose (m⁵).
    second: Matrix3<f64>,
}

/// How the volumes between the faces and a point inside are summed; MuJoCo's names are `exact` and `legacy`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sum {
    /// With the sign that the direction of a face gives.
    Signed,
    /// As if all were positive.
    Absolute,
}

impl Moments {
    /// Returns the moments of the convex hull of points; `None` if it is flat.
    pub(crate) fn of_hull(points: &[Point3<f64>]) -> Option<Self> {
        Some(Self::of_faces(points, &hull::faces(points)?, Sum::Signed)).filter(|found| found.volume > 0.0)
    }

    /// Returns the sums over the tetrahedra between each face and a point inside: the centre of all faces by their areas.
    /// As in MuJoCo, absolute sums take only the centre of mass from that point, and are then made again about this centre.
    pub(crate) fn of_faces(points: &[Point3<f64>], faces: &[[usize; 3]], sum: Sum) -> Self {
        let (mut area, mut centre) = (0.0, Vector3::zeros());
        for [a, b, c] in faces.iter().map(|face| face.map(|corner| points[corner].coords)) {
            let of_face = (b - a).cross(&(c - a)).norm();
            area += of_face;
            centre += (a + b + c) * (of_face / 3.0);
        }
        let centre = if area > 0.0 { centre / area } else { centre };
        let about_centre = Self::about(&centre, points, faces, sum);
        let whole = about_centre.transformed(&Matrix3::identity(), &centre);
        if sum == Sum::Signed || about_centre.volume == 0.0 {
            return whole;
        }
        let centre = whole.first / whole.volume;
        let about_mass = Self { first: Vector3::zeros(), ..Self::about(&centre, points, faces, sum) };
        about_mass.transformed(&Matrix3::identity(), &centre)
    }

    /// Returns the sums over the faces themselves, with the area instead of the volume: those of a thin shell.
    pub(crate) fn of_shell(points: &[Point3<f64>], faces: &[[usize; 3]]) -> Self {
        faces.iter().fold(Self::default(), |mut moments, face| {
            let [a, b, c] = face.map(|corner| points[corner].coords);
            let (area, total) = ((b - a).cross(&(c - a)).norm() / 2.0, a + b + c);
            moments.volume += area;
            moments.first += total * (area / 3.0);
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            moments.second += (squares + total * total.transpose()) * (area / 12.0);
            moments
        })
    }

    /// Returns the sums over the tetrahedra between each face and `inside`, about that point.
    fn about(inside: &Vector3<f64>, points: &[Point3<f64>], faces: &[[usize; 3]], sum: Sum) -> Self {
        faces.iter().fold(Self::default(), |mut moments, face| {
            let [a, b, c] = face.map(|corner| points[corner].coords - inside);
            let signed = a.dot(&b.cross(&c)) / 6.0;
            let volume = if sum == Sum::Signed { signed } else { signed.abs() };
            let total = a + b + c;
            moments.volume += volume;
            moments.first += total * (volume / 4.0);
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            moments.second += (squares + total * total.transpose()) * (volume / 20.0);
            moments
        })
    }

    /// Returns the moments of the solid after the motion `x → linear x + shift`.
    pub(crate) fn transformed(&self, linear: &Matrix3<f64>, shift: &Vector3<f64>) -> Self {
        let factor = linear.determinant().abs();
        let (volume, first) = (factor * self.volume, linear * self.first * factor);
        let second = linear * self.second * linear.transpose() * factor;
        let mixed = first * shift.transpose();
        Self {
            volume,
            first: first + shift * volume,
            second: second + mixed + mixed.transpose() + shift * shift.transpose() * volume,
        }
    }

    /// Returns the volume (m³), which is negative if the faces are turned inside out.
    pub(crate) fn volume(&self) -> f64 {
        self.volume
    }

    /// Returns the mass properties of the solid at a density (kg/m³).
    pub(crate) fn mass_properties(&self, density_kgpm3: f64) -> MassProperties {
        let centre = self.first / self.volume;
        let about_centre = self.second - centre * centre.transpose() * self.volume;
        MassProperties {
            mass_kg: self.volume * density_kgpm3,
            centre_m: centre.into(),
            inertia_kgm2: (Matrix3::identity() * about_centre.trace() - about_centre) * density_kgpm3,
        }
    }

    /// Returns the ten numbers of [`Self::from_numbers`].
    pub(crate) fn numbers(&self) -> [f64; 10] {
        let Self { volume, first, second } = self;
        let [xx, yy, zz] = [0, 1, 2].map(|axis| second[(axis, axis)]);
        [*volume, first.x, first.y, first.z, xx, yy, zz, second[(0, 1)], second[(0, 2)], second[(1, 2)]]
    }

    /// Returns the moments of ten numbers; `None` if there are others.
    pub(crate) fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let [volume, x, y, z, xx, yy, zz, xy, xz, yz] = numbers.try_into().ok()?;
        let second = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        Some(Self { volume, first: Vector3::new(x, y, z), second }).filter(|found: &Self| found.volume > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners and faces of an L of three unit cubes, with the height 1.
    fn angle() -> (Vec<Point3<f64>>, Vec<[usize; 3]>) {
        let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let points = [0.0, 1.0].into_iter().flat_map(|z| outline.map(|[x, y]| Point3::new(x, y, z))).collect();
        let ends = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
        let mut faces: Vec<[usize; 3]> =
            ends.iter().flat_map(|[a, b, c]| [[*c, *b, *a], [a + 6, b + 6, c + 6]]).collect();
        for corner in 0..6 {
            let next = (corner + 1) % 6;
            faces.extend([[corner, next, next + 6], [corner, next + 6, corner + 6]]);
        }
        (points, faces)
    }

    #[test]
    fn a_solid_has_the_sums_of_its_cubes() {
        let (points, faces) = angle();
        for sum in [Sum::Signed, Sum::Absolute] {
            let found = Moments::of_faces(&points, &faces, sum).mass_properties(1000.0);
            assert!((found.mass_kg - 3000.0).abs() < 1e-9);
            // Cubes at (½, ½), (3/2, ½), (½, 3/2).
            assert!((found.centre_m - Point3::new(5.0 / 6.0, 5.0 / 6.0, 0.5)).norm() < 1e-12);
            // Each has 1000/6 about its own centre; the offsets' squares are 2 · (1/3)² + (2/3)² along x and along y.
            assert!((found.inertia_kgm2[(0, 0)] - (500.0 + 1000.0 * 2.0 / 3.0)).abs() < 1e-9);
            assert!((found.inertia_kgm2[(2, 2)] - (500.0 + 1000.0 * 4.0 / 3.0)).abs() < 1e-9);
        }
        let turned: Vec<[usize; 3]> = faces.iter().map(|[a, b, c]| [*c, *b, *a]).collect();
        assert!((Moments::of_faces(&points, &turned, Sum::Signed).volume() + 3.0).abs() < 1e-12);
    }

    #[test]
    fn a_shell_has_the_sums_of_its_faces() {
        // Corner of a cube of side 3.
        let points = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]].map(Point3::from);
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let found = Moments::of_shell(&points, &faces).mass_properties(1.0);
        // Three right triangles of 4.5 m² and one of side √18 m.
        let slanted_m2 = 18.0 * 3f64.sqrt() / 4.0;
        assert!((found.mass_kg - (13.5 + slanted_m2)).abs() < 1e-12);
        // Each right triangle has its centre at 1 along two axes, the slanted one at 1 along all three.
        let centre_m = (2.0 * 4.5 + slanted_m2) / found.mass_kg;
        assert!((found.centre_m - Point3::from([centre_m; 3])).norm() < 1e-12, "{}", found.centre_m);
    }

    #[test]
    fn moments_follow_a_motion_and_come_back_from_numbers() {
        let (points, faces) = angle();
        let (linear, shift) =
            (Matrix3::new(0.0, -2.0, 0.1, 1.0, 0.3, 0.0, 0.0, 0.0, 1.5), Vector3::new(3.0, -1.0, 0.2));
        let moved: Vec<Point3<f64>> = points.iter().map(|point| Point3::from(linear * point.coords + shift)).collect();
        let wanted = Moments::of_faces(&moved, &faces, Sum::Signed).numbers();
        let found = Moments::of_faces(&points, &faces, Sum::Signed).transformed(&linear, &shift);
        assert!(found.numbers().iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-9));
        assert_eq!(Moments::from_numbers(&found.numbers()).map(|back| back.numbers()), Some(found.numbers()));
        assert_eq!(Moments::from_numbers(&[0.0; 10]), None);
        assert_eq!(Moments::from_numbers(&[1.0; 9]), None);
    }
}
