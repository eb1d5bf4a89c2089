//! Pictures of a humanoid, for `render`.

use std::{ops::RangeInclusive, sync::OnceLock};

use numpy::{
    PyArray3,
    ndarray::{Array3, ShapeError},
};
use pyo3::{
    exceptions::{PyIndexError, PyRuntimeError, PyValueError},
    prelude::*,
};
use rayon::{ThreadPool, ThreadPoolBuilder};
use treadmill_humanoid::{CONTROL_STEP_S, Physics};
use treadmill_render::{Camera, Picture, Scene};

use crate::{many::Humanoids, one::Humanoid};

/// Pixels of a side.
const SIDE: RangeInclusive<u32> = 16..=4096;
/// The camera is at most so far away (m); behind that, the haze leaves nothing to be seen.
const AWAY_MAX_M: f64 = 50.0;
/// How soon the camera follows the torso to the side: after this time (s) it is 1/e of a step aside behind.
const FOLLOW_S: f64 = 0.5;

/// The point of the floor that the camera follows, x and y (m): below the torso, with calm to the side.
#[derive(Clone, Copy, Debug, Default)]
pub struct Followed([f64; 2]);

impl Followed {
    /// The body was put elsewhere.
    pub fn jump(&mut self, physics: &Physics) {
        self.0 = [physics.position()[0], physics.position()[1]];
    }

    /// The body did a step.
    pub fn walk(&mut self, physics: &Physics) {
        let share = 1.0 - (-CONTROL_STEP_S / FOLLOW_S).exp();
        // Ahead at once: whoever runs would be out of the picture otherwise.
        self.0[0] = physics.position()[0];
        self.0[1] += (physics.position()[1] - self.0[1]) * share;
    }
}

/// Takes pictures of one size from one side.
#[pyclass(frozen, module = "treadmill_gym._native")]
pub struct Studio {
    size: (u32, u32),
    /// From the point that is looked at to the camera (m).
    camera_m: [f64; 3],
    /// Of its own, made with the first picture: threads of a pool that all share would be missing in a forked process.
    pool: OnceLock<ThreadPool>,
}

#[pymethods]
impl Studio {
    #[new]
    fn new(width: u32, height: u32, camera: Option<[f64; 3]>) -> PyResult<Self> {
        for (name, side) in [("width", width), ("height", height)] {
            if !SIDE.contains(&side) {
                let (low, high) = (SIDE.start(), SIDE.end());
                let why = format!("{name} is {side}, but must be between {low} and {high} pixels");
                return Err(PyValueError::new_err(why));
            }
        }
        let camera_m = camera.unwrap_or(treadmill_render::camera::BESIDE_M);
        let [x, y, z] = camera_m;
        let away_m = x.hypot(y).hypot(z);
        // NaN is in no range either.
        if !(0.1..=AWAY_MAX_M).contains(&x.hypot(y)) || !(0.1..=AWAY_MAX_M).contains(&away_m) {
            return Err(PyValueError::new_err(format!(
                "camera is ({x}, {y}, {z}), but must be x, y and z from the body to the camera in m: at least 0.1 m aside and \
                 at most {AWAY_MAX_M} m away"
            )));
        }
        Ok(Self { size: (width, height), camera_m, pool: OnceLock::new() })
    }

    /// A picture of a humanoid, `[height, width, 3]`.
    fn picture<'py>(&self, py: Python<'py>, humanoid: PyRef<'_, Humanoid>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (scene, followed) = (Scene::of(humanoid.physics()), humanoid.followed());
        drop(humanoid);
        self.take(py, &scene, followed)
    }

    /// A picture of one of several humanoids, `[height, width, 3]`.
    fn picture_of<'py>(
        &self,
        py: Python<'py>,
        humanoids: PyRef<'_, Humanoids>,
        index: usize,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (physics, followed) = humanoids.seen(index).ok_or_else(|| PyIndexError::new_err(index))?;
        let scene = Scene::of(physics);
        drop(humanoids);
        self.take(py, &scene, followed)
    }
}

impl Studio {
    fn take<'py>(&self, py: Python<'py>, scene: &Scene, followed: Followed) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let pool = self.pool()?;
        let [x_m, y_m] = followed.0;
        let camera = Camera::following(x_m, y_m, self.camera_m);
        let picture = py.detach(|| pool.install(|| Picture::of(scene, &camera, self.size)));
        let shape = (picture.height as usize, picture.width as usize, 3);
        let pixels = Array3::from_shape_vec(shape, picture.rgb);
        let pixels = pixels.map_err(|why: ShapeError| PyRuntimeError::new_err(why.to_string()))?;
        Ok(PyArray3::from_owned_array(py, pixels))
    }

    fn pool(&self) -> PyResult<&ThreadPool> {
        if let Some(pool) = self.pool.get() {
            return Ok(pool);
        }
        let pool = ThreadPoolBuilder::new().thread_name(|index| format!("picture-{index}")).build();
        let pool = pool.map_err(|why| PyRuntimeError::new_err(why.to_string()))?;
        Ok(self.pool.get_or_init(|| pool))
    }
}
