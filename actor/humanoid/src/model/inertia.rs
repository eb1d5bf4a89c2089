//! Mass, centre and inertia of bodies made of overlapping spheres and capsules.
//!
//! Overlaps count twice, as in MuJoCo: the figures are sums over the shapes.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

use super::Shape;

/// Mass properties of a body, in the body's frame.
pub(crate) struct MassProperties {
    /// Mass (kg).
    pub(crate) mass_kg: f64,
    /// Centre of mass (m).
    pub(crate) centre_m: Point3<f64>,
    /// Inertia about the centre of mass (kg·m²).
    pub(crate) inertia_kgm2: Matrix3<f64>,
}

/// Adds up the shapes of one body; `None` if they weigh nothing.
pub(crate) fn of_shapes(shapes: &[Shape]) -> Option<MassProperties> {
    let parts: Vec<MassProperties> = shapes.iter().map(of_shape).collect();
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

/// Inertia of a point mass (kg) about the point that lies `offset` (m) away from it.
fn point_inertia(mass_kg: f64, offset: Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * offset.norm_squared() - offset * offset.transpose()) * mass_kg
}

fn of_shape(shape: &Shape) -> MassProperties {
    let axis = shape.to_m - shape.from_m;
    let (length, radius) = (axis.norm(), shape.radius_m);
    let cylinder_kg = shape.density_kgpm3 * PI * radius.powi(2) * length;
    let ball_kg = shape.density_kgpm3 * 4.0 / 3.0 * PI * radius.powi(3);

    // Along the axis, and across it. Each half ball's centre lies 3/8 r beyond the cylinder's end,
    // which is where the mixed term comes from.
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
        centre_m: nalgebra::center(&shape.from_m, &shape.to_m),
        inertia_kgm2: turn * principal * turn.inverse(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 1e-12;

    fn sphere(centre: [f64; 3], radius_m: f64) -> Shape {
        let centre = Point3::from(centre);
        Shape { from_m: centre, to_m: centre, radius_m, density_kgpm3: 1000.0 }
    }

    #[test]
    fn sphere_has_two_fifths_of_mass_times_radius_squared() {
        let body = of_shapes(&[sphere([0.0; 3], 0.1)]).expect("a sphere has mass");
        // 4/3 π 0.1³ × 1000 = 4.18879 kg; × 0.01 × 0.4 = 0.0167552 kg·m².
        assert!((body.mass_kg - 4.188_790_204_786_391).abs() < TOLERANCE);
        assert!((body.inertia_kgm2 - Matrix3::identity() * 0.016_755_160_819_145_56).norm() < TOLERANCE);
    }

    #[test]
    fn two_spheres_balance_in_the_middle_and_resist_turning_across_their_line() {
        let body = of_shapes(&[sphere([0.0, -0.5, 0.0], 0.1), sphere([0.0, 0.5, 0.0], 0.1)]).expect("mass");
        let one = 4.188_790_204_786_391;
        assert!(body.centre_m.coords.norm() < TOLERANCE);
        assert!((body.inertia_kgm2[(1, 1)] - 2.0 * one * 0.004).abs() < TOLERANCE);
        assert!((body.inertia_kgm2[(0, 0)] - 2.0 * one * (0.004 + 0.25)).abs() < TOLERANCE);
    }

    #[test]
    fn capsule_agrees_with_a_sum_over_thin_discs() {
        let (radius, length, density) = (0.06, 0.34, 1000.0);
        let capsule = Shape {
            from_m: Point3::origin(),
            to_m: Point3::new(length, 0.0, 0.0),
            radius_m: radius,
            density_kgpm3: density,
        };
        let body = of_shapes(&[capsule]).expect("a capsule has mass");
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
    fn shapes_without_density_weigh_nothing() {
        let hollow = Shape { density_kgpm3: 0.0, ..sphere([0.0; 3], 0.1) };
        assert!(of_shapes(&[hollow]).is_none());
        assert!(of_shapes(&[]).is_none());
    }
}
