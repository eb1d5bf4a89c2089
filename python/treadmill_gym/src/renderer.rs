//! Pictures of a humanoid, for `render`.

use std::{ops::RangeInclusive, sync::OnceLock};

use numpy::{
    PyArray3,
    ndarray::{Array3, ShapeError},
};
use pyo3::{
    exceptions::{PyIndexError, PyRuntimeError},
    prelude::*,
};
use rayon::{ThreadPool, ThreadPoolBuilder};
use treadmill_humanoid::Physics;
use treadmill_render::{Camera, Picture, Scene, camera::BESIDE_M};

use crate::{many::Humanoids, one::Humanoid, settings::Keyword};

/// Accepted width and height in pixels.
const SIDE: RangeInclusive<u32> = 16..=4096;
/// Accepted distance from the body to the camera (m); haze hides a body that is farther away.
const CAMERA_DISTANCE_M: RangeInclusive<f64> = 0.1..=50.0;
/// Time constant with which the camera follows sideways motion (s).
const FOLLOW_TIME_S: f64 = 0.5;

/// Point of the floor that the camera follows, x and y (m): below the torso, smoothed sideways.
#[derive(Clone, Copy, Debug, Default)]
pub struct Followed([f64; 2]);

impl Followed {
    /// Moves the point to the body after a reset.
    pub fn reset(&mut self, physics: &Physics) {
        self.0 = [physics.position()[0], physics.position()[1]];
    }

    /// Follows the body after a step of `control_step_s`.
    pub fn update(&mut self, physics: &Physics, control_step_s: f64) {
        let share = 1.0 - (-control_step_s / FOLLOW_TIME_S).exp();
        // Forward motion is not smoothed, as a running body would leave the picture.
        self.0[0] = physics.position()[0];
        self.0[1] += (physics.position()[1] - self.0[1]) * share;
    }
}

/// Renders pictures of one size from one direction.
#[pyclass(frozen, module = "treadmill_gym._native")]
pub struct Renderer {
    size: (u32, u32),
    /// Offset of the camera from the followed point (m).
    camera_m: [f64; 3],
    /// Started with the first picture. Rayon's global pool would have no threads in a forked process.
    pool: OnceLock<ThreadPool>,
}

#[pymethods]
impl Renderer {
    #[new]
    fn new(width: Bound<'_, PyAny>, height: Bound<'_, PyAny>, camera: Bound<'_, PyAny>) -> PyResult<Self> {
        let width = Keyword { name: "width", value: width }.whole(SIDE)?;
        let height = Keyword { name: "height", value: height }.whole(SIDE)?;
        let keyword = Keyword { name: "camera", value: camera };
        let camera_m = if keyword.value.is_none() { Some(BESIDE_M) } else { keyword.value.extract().ok() };
        // No range contains NaN.
        let is_allowed = |&[x, y, z]: &[f64; 3]| {
            let horizontal_m = x.hypot(y);
            CAMERA_DISTANCE_M.contains(&horizontal_m) && CAMERA_DISTANCE_M.contains(&horizontal_m.hypot(z))
        };
        let camera_m = camera_m.filter(is_allowed).ok_or_else(|| {
            let (low_m, high_m) = (CAMERA_DISTANCE_M.start(), CAMERA_DISTANCE_M.end());
            keyword.refuse(&format!(
                "None, or x, y and z from the body to the camera in m: horizontal distance at least {low_m} m, \
                 distance at most {high_m} m"
            ))
        })?;
        Ok(Self { size: (width, height), camera_m, pool: OnceLock::new() })
    }

    /// Renders a humanoid as `[height, width, 3]`.
    fn picture<'py>(&self, py: Python<'py>, humanoid: PyRef<'_, Humanoid>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (scene, followed) = (Scene::of(humanoid.physics()), humanoid.followed());
        drop(humanoid);
        self.render(py, &scene, followed)
    }

    /// Renders one of several humanoids as `[height, width, 3]`.
    fn picture_of<'py>(
        &self,
        py: Python<'py>,
        humanoids: PyRef<'_, Humanoids>,
        index: usize,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (physics, followed) = humanoids.view(index).ok_or_else(|| PyIndexError::new_err(index))?;
        let scene = Scene::of(physics);
        drop(humanoids);
        self.render(py, &scene, followed)
    }
}

impl Renderer {
    fn render<'py>(&self, py: Python<'py>, scene: &Scene, followed: Followed) -> PyResult<Bound<'py, PyArray3<u8>>> {
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
