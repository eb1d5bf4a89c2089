//! Rapier's types from and to ours, in single precision.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use rapier3d::math::{Pose, Rotation, Vector};

pub(super) fn to_pose(rotation: &Matrix3<f64>, origin_m: &Vector3<f64>) -> Pose {
    let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    Pose::from_parts(to_vector(origin_m), to_rotation(&quaternion))
}

pub(super) fn to_vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

pub(super) fn to_rotation(r: &UnitQuaternion<f64>) -> Rotation {
    let q = r.quaternion();
    // Rounding to single precision changes the norm by 1e-7, which would accumulate in products.
    Rotation::from_xyzw(q.i as f32, q.j as f32, q.k as f32, q.w as f32).normalize()
}

pub(super) fn from_vector(v: Vector) -> Vector3<f64> {
    Vector3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}
