//! Mass, centre of mass and inertia of bodies made of shapes.
//!
//! As in MuJoCo, all are sums over the shapes, so that overlaps count twice.

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::geometry::Geometry;
use super::moments::Moments;

/// Default density (kg/m³).
pub(crate) const WATER_KGPM3: f64 = 1000.0;

/// Mass properties of a rigid body or of a part of it, in the rigid body's frame.
#[derive(Clone, Debug)]
pub(crate) struct MassProperties {
    /// Mass (kg).
    pub(crate) mass_kg: f64,
    /// Centre of mass (m).
    pub(crate) centre_m: Point3<f64>,
    /// Inertia about the centre of mass (kg·m²).
    pub(crate) inertia_kgm2: Matrix3<f64>,
}

impl MassProperties {
    /// Returns the same part with mass and inertia multiplied by a factor.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { mass_kg: self.mass_kg * factor, inertia_kgm2: self.inertia_kgm2 * factor, ..self }
    }
}

/// Returns the mass properties of several parts together; `None` if they have no mass.
pub(crate) fn sum(parts: &[MassProperties]) -> Option<MassProperties> {
    let mass_kg: f64 = parts.iter().map(|part| part.mass_kg).sum();
    if mass_kg <= 0.0 {
        return None;
    }
    let moment: Vector3<f64> = parts.iter().map(|part| part.centre_m.coords * part.mass_kg).sum();
    let centre_m = Point3::from(moment / mass_kg);
    let inertia_kgm2 =
        parts.iter().map(|part| part.inertia_kgm2 + point_inertia(part.mass_kg, part.centre_m - centre_m)).sum();
    Some(MassProperties { mass_kg, centre_m, inertia_kgm2 })
}

/// Returns the inertia of a point mass (kg) about a point at distance `offset` (m).
fn point_inertia(mass_kg: f64, offset: Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * offset.norm_squared() - offset * offset.transpose()) * mass_kg
}

/// Returns the mass properties of a solid of uniform density (kg/m³); a flat hull has no mass.
pub(crate) fn of_geometry(geometry: &Geometry, density_kgpm3: f64) -> MassProperties {
    match *geometry {
        Geometry::Sphere { centre_m, radius_m } => of_capsule(&centre_m, &centre_m, radius_m, density_kgpm3),
        Geometry::Capsule { from_m, to_m, radius_m } => of_capsule(&from_m, &to_m, radius_m, density_kgpm3),
        Geometry::Cylinder { pose, radius_m, half_length_m } => {
            let mass_kg = density_kgpm3 * PI * radius_m.powi(2) * 2.0 * half_length_m;
            let across = mass_kg * (radius_m.powi(2) / 4.0 + half_length_m.powi(2) / 3.0);
            from_principal(&pose, mass_kg, Vector3::new(across, across, mass_kg * radius_m.powi(2) / 2.0))
        }
        Geometry::Box { pose, half_m } => {
            let mass_kg = density_kgpm3 * 8.0 * half_m.product();
            from_principal(&pose, mass_kg, sums_of_squares(&half_m) * (mass_kg / 3.0))
        }
        Geometry::Ellipsoid { pose, half_m } => {
            let mass_kg = density_kgpm3 * 4.0 / 3.0 * PI * half_m.product();
            from_principal(&pose, mass_kg, sums_of_squares(&half_m) * (mass_kg / 5.0))
        }
        Geometry::Hull { ref vertices_m } => Moments::of_hull(vertices_m).map_or_else(
            || from_principal(&Isometry3::identity(), 0.0, Vector3::zeros()),
            |moments| moments.mass_properties(density_kgpm3),
        ),
    }
}

/// Returns the mass properties of a thin shell of uniform density (kg/m²); `None` for ellipsoids and hulls.
pub(crate) fn of_shell(geometry: &Geometry, density_kgpm2: f64) -> Option<MassProperties> {
    let at = |pose: &Isometry3<f64>, z_m: f64| pose * Isometry3::translation(0.0, 0.0, z_m);
    // A tube, and what closes it: mass and inertia across and along its axis, and the distance from the middle.
    let closed_tube = |pose: &Isometry3<f64>, radius_m: f64, half_m: f64, [kg, across, along, centre_m]: [f64; 4]| {
        let tube_kg = density_kgpm2 * TAU * radius_m * 2.0 * half_m;
        let square = radius_m * radius_m;
        let tube_across = tube_kg * (square / 2.0 + half_m * half_m / 3.0);
        let tube = from_principal(pose, tube_kg, Vector3::new(tube_across, tube_across, tube_kg * square));
        let end = |sign: f64| {
            let inertia = Vector3::new(across, across, along) * (kg * square);
            from_principal(&at(pose, sign * centre_m), kg, inertia)
        };
        sum(&[tube, end(1.0), end(-1.0)])
    };
    let half_sphere = |radius_m: f64, half_m: f64| {
        // About its own centre of mass, which is half a radius above its rim: 2/3 − 1/4.
        [density_kgpm2 * TAU * radius_m.powi(2), 5.0 / 12.0, 2.0 / 3.0, half_m + radius_m / 2.0]
    };
    match *geometry {
        Geometry::Sphere { centre_m, radius_m } => {
            let pose = Isometry3::from_parts(centre_m.coords.into(), UnitQuaternion::identity());
            closed_tube(&pose, radius_m, 0.0, half_sphere(radius_m, 0.0))
        }
        Geometry::Capsule { from_m, to_m, radius_m } => {
            let axis = to_m - from_m;
            let half_m = axis.norm() / 2.0;
            let turn = UnitQuaternion::rotation_between(&Vector3::z(), &axis);
            let turn = turn.unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI));
            let pose = Isometry3::from_parts(nalgebra::center(&from_m, &to_m).coords.into(), turn);
            closed_tube(&pose, radius_m, half_m, half_sphere(radius_m, half_m))
        }
        Geometry::Cylinder { pose, radius_m, half_length_m } => {
            let disc = [density_kgpm2 * PI * radius_m.powi(2), 1.0 / 4.0, 1.0 / 2.0, half_length_m];
            closed_tube(&pose, radius_m, half_length_m, disc)
        }
        Geometry::Box { pose, half_m } => {
            let plates = (0..3).flat_map(|axis| {
                let (mut flat, mut place_m) = (half_m, Vector3::zeros());
                flat[axis] = 0.0;
                place_m[axis] = half_m[axis];
                let kg = density_kgpm2 * 4.0 * half_m.product() / half_m[axis];
                [place_m, -place_m].map(|place_m| {
                    let pose = pose * Isometry3::from_parts(place_m.into(), UnitQuaternion::identity());
                    from_principal(&pose, kg, sums_of_squares(&flat) * (kg / 3.0))
                })
            });
            sum(&plates.collect::<Vec<_>>())
        }
        Geometry::Ellipsoid { .. } | Geometry::Hull { .. } => None,
    }
}

/// Returns for each axis the sum of the squares of the other two.
fn sums_of_squares(half_m: &Vector3<f64>) -> Vector3<f64> {
    let [x, y, z] = [half_m.x, half_m.y, half_m.z].map(|half_m| half_m * half_m);
    Vector3::new(y + z, z + x, x + y)
}

/// Returns mass properties with the centre and the principal axes of a pose.
pub(crate) fn from_principal(pose: &Isometry3<f64>, mass_kg: f64, principal_kgm2: Vector3<f64>) -> MassProperties {
    let turn = pose.rotation.to_rotation_matrix();
    MassProperties {
        mass_kg,
        centre_m: Point3::from(pose.translation.vector),
        inertia_kgm2: turn * Matrix3::from_diagonal(&principal_kgm2) * turn.inverse(),
    }
}

fn of_capsule(from_m: &Point3<f64>, to_m: &Point3<f64>, radius: f64, density_kgpm3: f64) -> MassProperties {
    let axis = to_m - from_m;
    let length = axis.norm();
    let cylinder_kg = density_kgpm3 * PI * radius.powi(2) * length;
    let ball_kg = density_kgpm3 * 4.0 / 3.0 * PI * radius.powi(3);

    // The mixed term of `across`: the centre of each half ball lies 3/8 r beyond the cylinder's end.
    let along = cylinder_kg * radius.powi(2) / 2.0 + ball_kg * radius.powi(2) * 2.0 / 5.0;
    let across = cylinder_kg * (radius.powi(2) / 4.0 + length.powi(2) / 12.0)
        + ball_kg * (radius.powi(2) * 2.0 / 5.0 + length.powi(2) / 4.0 + length * radius * 3.0 / 8.0);
    let turn = if length > 0.0 {
        Rotation3::rotation_between(&Vector3::z(), &axis)
            .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), PI))
    } else {
        Rotation3::identity()
    };
    let principal = Matrix3::from_diagonal(&Vector3::new(across, across, along));
    MassProperties {
        mass_kg: cylinder_kg + ball_kg,
        centre_m: nalgebra::center(from_m, to_m),
        inertia_kgm2: turn * principal * turn.inverse(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 1e-12;

    fn sphere(centre: [f64; 3], radius_m: f64) -> MassProperties {
        of_geometry(&Geometry::Sphere { centre_m: Point3::from(centre), radius_m }, 1000.0)
    }

    #[test]
    fn sphere_has_two_fifths_of_mass_times_radius_squared() {
        let body = sum(&[sphere([0.0; 3], 0.1)]).expect("a sphere has mass");
        // 4/3 π 0.1³ × 1000 = 4.18879 kg; × 0.01 × 0.4 = 0.0167552 kg·m².
        assert!((body.mass_kg - 4.188_790_204_786_391).abs() < TOLERANCE);
        assert!((body.inertia_kgm2 - Matrix3::identity() * 0.016_755_160_819_145_56).norm() < TOLERANCE);
    }

    #[test]
    fn two_spheres_have_their_centre_of_mass_in_the_middle() {
        let body = sum(&[sphere([0.0, -0.5, 0.0], 0.1), sphere([0.0, 0.5, 0.0], 0.1)]).expect("mass");
        let one = 4.188_790_204_786_391;
        assert!(body.centre_m.coords.norm() < TOLERANCE);
        assert!((body.inertia_kgm2[(1, 1)] - 2.0 * one * 0.004).abs() < TOLERANCE);
        assert!((body.inertia_kgm2[(0, 0)] - 2.0 * one * (0.004 + 0.25)).abs() < TOLERANCE);
    }

    #[test]
    fn capsule_agrees_with_a_sum_over_thin_discs() {
        let (radius, length, density) = (0.06, 0.34, 1000.0);
        let capsule =
            Geometry::Capsule { from_m: Point3::origin(), to_m: Point3::new(length, 0.0, 0.0), radius_m: radius };
        let body = of_geometry(&capsule, density);
        let (mut mass, mut along, mut across) = (0.0, 0.0, 0.0);
        let slices = 100_000;
        let thickness = (length + 2.0 * radius) / f64::from(slices);
        for slice in 0..slices {
            let x = -radius - length / 2.0 + (f64::from(slice) + 0.5) * thickness;
            let beyond = (x.abs() - length / 2.0).max(0.0);
            let squared = radius * radius - beyond * beyond;
            let disc = density * PI * squared * thickness;
            mass += disc;
            along += disc * squared / 2.0;
            across += disc * (squared / 4.0 + x * x);
        }
        assert!((body.mass_kg / mass - 1.0).abs() < 1e-6);
        assert!((body.inertia_kgm2[(0, 0)] / along - 1.0).abs() < 1e-6);
        assert!((body.inertia_kgm2[(1, 1)] / across - 1.0).abs() < 1e-6);
        assert!((body.inertia_kgm2[(2, 2)] / across - 1.0).abs() < 1e-6);
    }

    #[test]
    fn parts_without_mass_have_no_mass_properties() {
        let hollow = of_geometry(&Geometry::Sphere { centre_m: Point3::origin(), radius_m: 0.1 }, 0.0);
        assert!(sum(&[hollow]).is_none());
        assert!(sum(&[]).is_none());
    }

    #[test]
    fn a_grid_of_points_is_a_box() {
        // 5 × 4 × 3 points of a box of 2 m × 3 m × 4 m, most of them within faces and edges.
        let points: Vec<Point3<f64>> = (0..60)
            .map(|index| [f64::from(index % 5) / 2.0, f64::from(index / 5 % 4), 2.0 * f64::from(index / 20)].into())
            .collect();
        let body = Moments::of_hull(&points).expect("solid").mass_properties(10.0);
        assert!((body.mass_kg - 240.0).abs() < 1e-9);
        assert!((body.centre_m - Point3::new(1.0, 1.5, 2.0)).norm() < 1e-12);
        let inertia = Matrix3::from_diagonal(&Vector3::new(500.0, 400.0, 260.0));
        assert!((body.inertia_kgm2 - inertia).norm() < 1e-9, "{}", body.inertia_kgm2);
        let corners = super::super::hull::vertices(&points).expect("solid");
        assert_eq!(corners.len(), 8);
        assert!(
            (Moments::of_hull(&corners).expect("solid").mass_properties(10.0).inertia_kgm2 - inertia).norm() < 1e-9
        );
    }

    #[test]
    fn solids_agree_with_a_sum_over_small_cubes() {
        let half_m = Vector3::new(0.2, 0.1, 0.3);
        let pose = Isometry3::translation(0.5, 0.0, 0.0);
        type Inside = fn(Vector3<f64>) -> bool;
        let round: Inside = |p| p.x.hypot(p.y) < 0.2 && p.z.abs() < 0.3;
        let oval: Inside = |p| (p.x / 0.2).powi(2) + (p.y / 0.1).powi(2) + (p.z / 0.3).powi(2) < 1.0;
        let cases: [(Geometry, Inside); 3] = [
            (Geometry::Box { pose, half_m }, |p| p.x.abs() < 0.2 && p.y.abs() < 0.1 && p.z.abs() < 0.3),
            (Geometry::Ellipsoid { pose, half_m }, oval),
            (Geometry::Cylinder { pose, radius_m: 0.2, half_length_m: 0.3 }, round),
        ];
        let (cells, side) = (120, 0.6 / 120.0);
        for (geometry, inside) in cases {
            let (mut mass, mut inertia) = (0.0, Matrix3::zeros());
            for index in 0..cells * cells * cells {
                let cell = [index % cells, index / cells % cells, index / cells / cells];
                let at = Vector3::from(cell.map(|cell: i32| (f64::from(cell) + 0.5) * side - 0.3));
                if inside(at) {
                    mass += side.powi(3);
                    inertia += point_inertia(side.powi(3), at);
                }
            }
            let body = of_geometry(&geometry, 1.0);
            assert!((body.mass_kg / mass - 1.0).abs() < 0.01, "{geometry:?}: {} against {mass}", body.mass_kg);
            assert!((body.inertia_kgm2 - inertia).norm() < 0.01 * inertia.norm(), "{geometry:?}");
            assert_eq!(body.centre_m, Point3::new(0.5, 0.0, 0.0));
        }
    }
}
