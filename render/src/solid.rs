//! Intersection of a ray with a shape.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use treadmill_humanoid::model::Geometry;

/// Half-line.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Start (m).
    pub origin: Point3<f64>,
    /// Direction, of length 1.
    pub direction: Vector3<f64>,
}

impl Ray {
    /// Returns the point at a distance (m).
    #[must_use]
    pub fn at(&self, distance_m: f64) -> Point3<f64> {
        self.origin + self.direction * distance_m
    }

    fn in_frame_of(&self, pose: &Isometry3<f64>) -> Self {
        Self {
            origin: pose.inverse_transform_point(&self.origin),
            direction: pose.inverse_transform_vector(&self.direction),
        }
    }
}

/// First intersection of a ray with a surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance from the ray's origin (m).
    pub distance_m: f64,
    /// Outward normal, of length 1.
    pub normal: Vector3<f64>,
}

/// Smallest distance of a hit (m); excludes hits at and behind the ray's origin.
const NEAREST_M: f64 = 1e-9;

/// Shape in the world.
#[derive(Clone, Debug)]
pub struct Solid {
    form: Form,
    pub(crate) bound: Ball,
}

/// Bounding sphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub(crate) centre: Point3<f64>,
    pub(crate) radius_m: f64,
}

impl Ball {
    /// Returns whether a ray enters the sphere before a distance (m).
    pub(crate) fn may_hit(&self, ray: &Ray, before_m: f64) -> bool {
        let towards = self.centre - ray.origin;
        let along = towards.dot(&ray.direction);
        along + self.radius_m > 0.0
            && along - self.radius_m < before_m
            && towards.norm_squared() - along * along <= self.radius_m * self.radius_m
    }
}

#[derive(Clone, Debug)]
enum Form {
    Sphere,
    Capsule {
        from: Point3<f64>,
        to: Point3<f64>,
        radius_m: f64,
    },
    Cylinder {
        pose: Isometry3<f64>,
        radius_m: f64,
        half_length_m: f64,
    },
    Ellipsoid {
        pose: Isometry3<f64>,
        half_m: Vector3<f64>,
    },
    /// Planes of the faces of a hull or a box.
    Hull {
        planes: Vec<Plane>,
    },
}

/// Outward normal of a face, and its position along the normal (m).
pub(crate) type Plane = (Vector3<f64>, f64);

impl Solid {
    /// Returns a shape of a body whose pose is `body`.
    #[must_use]
    pub fn new(geometry: &Geometry, body: &Isometry3<f64>) -> Self {
        let (form, radius_m) = match *geometry {
            Geometry::Sphere { radius_m, .. } => (Form::Sphere, radius_m),
            Geometry::Capsule { from_m, to_m, radius_m } => {
                let (from, to) = (body * from_m, body * to_m);
                (Form::Capsule { from, to, radius_m }, nalgebra::distance(&from, &to) / 2.0 + radius_m)
            }
            Geometry::Cylinder { pose, radius_m, half_length_m } => {
                (Form::Cylinder { pose: body * pose, radius_m, half_length_m }, radius_m.hypot(half_length_m))
            }
            Geometry::Box { pose, half_m } => {
                (Form::Hull { planes: box_planes(&(body * pose), &half_m) }, half_m.norm())
            }
            Geometry::Ellipsoid { pose, half_m } => (Form::Ellipsoid { pose: body * pose, half_m }, half_m.max()),
            Geometry::Hull { ref vertices_m } => {
                let centre = geometry.centre_m();
                let distances = vertices_m.iter().map(|vertex| nalgebra::distance(&centre, vertex));
                (Form::Hull { planes: planes(geometry, vertices_m, body) }, distances.fold(0.0, f64::max))
            }
        };
        Self { form, bound: Ball { centre: body * geometry.centre_m(), radius_m } }
    }

    /// Returns where a ray from outside enters the shape.
    #[must_use]
    pub fn hit(&self, ray: &Ray) -> Option<Hit> {
        match self.form {
            Form::Hull { ref planes } => hull(ray, planes),
            Form::Sphere => sphere(ray, &self.bound.centre, self.bound.radius_m),
            Form::Capsule { from, to, radius_m } => capsule(ray, &from, &to, radius_m),
            Form::Cylinder { pose, radius_m, half_length_m } => {
                to_world(cylinder(&ray.in_frame_of(&pose), radius_m, half_length_m), &pose)
            }
            Form::Ellipsoid { pose, half_m } => to_world(ellipsoid(&ray.in_frame_of(&pose), &half_m), &pose),
        }
    }
}

fn to_world(hit: Option<Hit>, pose: &Isometry3<f64>) -> Option<Hit> {
    hit.map(|hit| Hit { normal: pose * hit.normal, ..hit })
}

fn sphere(ray: &Ray, centre: &Point3<f64>, radius_m: f64) -> Option<Hit> {
    let from_centre = ray.origin - centre;
    let half_b = from_centre.dot(&ray.direction);
    let discriminant = half_b * half_b - from_centre.norm_squared() + radius_m * radius_m;
    let distance_m = -half_b - discriminant.max(0.0).sqrt();
    (discriminant >= 0.0 && distance_m > NEAREST_M)
        .then(|| Hit { distance_m, normal: (ray.at(distance_m) - centre) / radius_m })
}

/// Returns where a ray enters a capsule: its wall between the end planes, or the ball at either end.
fn capsule(ray: &Ray, from: &Point3<f64>, to: &Point3<f64>, radius_m: f64) -> Option<Hit> {
    let axis = to - from;
    let length_m = axis.norm();
    if length_m > 0.0
        && let Some((distance_m, along_m)) = wall(ray, from, &(axis / length_m), radius_m)
        && (0.0..=length_m).contains(&along_m)
    {
        let nearest = from + axis * (along_m / length_m);
        return Some(Hit { distance_m, normal: (ray.at(distance_m) - nearest) / radius_m });
    }
    let ends = [from, to].map(|end| sphere(ray, end, radius_m));
    ends.into_iter().flatten().min_by(|one, other| one.distance_m.total_cmp(&other.distance_m))
}

/// Returns the distance at which a ray enters an infinite tube, and the position along the axis, which has length 1.
fn wall(ray: &Ray, from: &Point3<f64>, axis: &Vector3<f64>, radius_m: f64) -> Option<(f64, f64)> {
    let start = ray.origin - from;
    let (across, start_across) = (ray.direction - axis * ray.direction.dot(axis), start - axis * start.dot(axis));
    let (a, half_b) = (across.norm_squared(), across.dot(&start_across));
    let discriminant = half_b * half_b - a * (start_across.norm_squared() - radius_m * radius_m);
    if a < 1e-18 || discriminant < 0.0 {
        return None;
    }
    let distance_m = (-half_b - discriminant.sqrt()) / a;
    (distance_m > NEAREST_M).then(|| (distance_m, (start + ray.direction * distance_m).dot(axis)))
}

fn cylinder(ray: &Ray, radius_m: f64, half_length_m: f64) -> Option<Hit> {
    if let Some((distance_m, along_m)) = wall(ray, &Point3::origin(), &Vector3::z(), radius_m)
        && along_m.abs() <= half_length_m
    {
        let at = ray.at(distance_m);
        return Some(Hit { distance_m, normal: Vector3::new(at.x, at.y, 0.0) / radius_m });
    }
    // The end plane that faces the ray.
    let up = -ray.direction.z.signum();
    let distance_m = (up * half_length_m - ray.origin.z) / ray.direction.z;
    let at = ray.at(distance_m);
    (distance_m > NEAREST_M && at.x.hypot(at.y) <= radius_m)
        .then(|| Hit { distance_m, normal: Vector3::new(0.0, 0.0, up) })
}

/// Returns the planes of a hull's faces in the world.
fn planes(geometry: &Geometry, vertices_m: &[Point3<f64>], body: &Isometry3<f64>) -> Vec<Plane> {
    let plane = |corners: [usize; 3]| {
        let [a, b, c] = corners.map(|corner| body * vertices_m[corner]);
        let normal = (b - a).cross(&(c - a)).normalize();
        (normal, normal.dot(&a.coords))
    };
    geometry.hull_faces().into_iter().map(plane).collect()
}

/// Returns the planes of a box's faces in the world.
pub(crate) fn box_planes(pose: &Isometry3<f64>, half_m: &Vector3<f64>) -> Vec<Plane> {
    let axes = Matrix3::identity();
    let plane = |(axis, side): (usize, f64)| {
        let normal = pose * (axes.column(axis) * side);
        (normal, normal.dot(&pose.translation.vector) + half_m[axis])
    };
    (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]).map(plane).collect()
}

fn hull(ray: &Ray, planes: &[Plane]) -> Option<Hit> {
    let (enters, leaves, normal) = passage(ray, planes)?;
    (enters <= leaves && enters > NEAREST_M).then_some(Hit { distance_m: enters, normal })
}

/// Returns where a ray enters the last and leaves the first of the spaces behind planes, and the normal where it enters;
/// `None` if it stays before a plane.
pub(crate) fn passage(ray: &Ray, planes: &[Plane]) -> Option<(f64, f64, Vector3<f64>)> {
    let (mut enters, mut leaves, mut normal) = (f64::NEG_INFINITY, f64::INFINITY, Vector3::zeros());
    for (outwards, offset) in planes {
        let (height, rate) = (outwards.dot(&ray.origin.coords) - offset, outwards.dot(&ray.direction));
        if rate == 0.0 {
            if height > 0.0 {
                return None;
            }
        } else if rate > 0.0 {
            leaves = leaves.min(-height / rate);
        } else if -height / rate > enters {
            (enters, normal) = (-height / rate, *outwards);
        }
    }
    Some((enters, leaves, normal))
}

/// Returns where a ray enters an ellipsoid, which is a unit sphere when all lengths are divided by the semi-axes.
fn ellipsoid(ray: &Ray, half_m: &Vector3<f64>) -> Option<Hit> {
    let scaled = ray.direction.component_div(half_m);
    let stretch = scaled.norm();
    let origin = Point3::from(ray.origin.coords.component_div(half_m));
    let hit = sphere(&Ray { origin, direction: scaled / stretch }, &Point3::origin(), 1.0)?;
    Some(Hit { distance_m: hit.distance_m / stretch, normal: hit.normal.component_div(half_m).normalize() })
}

#[cfg(test)]
#[path = "solid_tests.rs"]
mod tests;
