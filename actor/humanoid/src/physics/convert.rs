//! Conversion between nalgebra in double precision, which model and task use, and Rapier's types.

use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};
use rapier3d::math::{Matrix, Rotation, Vector};

pub(super) fn to_vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

pub(super) fn to_point(p: &Point3<f64>) -> Vector {
    to_vector(&p.coords)
}

pub(super) fn to_rotation(r: &UnitQuaternion<f64>) -> Rotation {
    let q = r.quaternion();
    // Rounding to single precision changes the norm by 1e-7, which would accumulate in products.
    Rotation::from_xyzw(q.i as f32, q.j as f32, q.k as f32, q.w as f32).normalize()
}

pub(super) fn to_matrix(m: &Matrix3<f64>) -> Matrix {
    Matrix::from_cols(to_vector(&m.column(0).into()), to_vector(&m.column(1).into()), to_vector(&m.column(2).into()))
}

pub(super) fn from_vector(v: Vector) -> Vector3<f64> {
    Vector3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}
