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
use treadmill_humanoid::{CONTROL_STEP_S, Physics};
use treadmill_render::{Camera, Picture, Scene, camera::BESIDE_M};

use crate::{many::Humanoids, one::Humanoid, settings::Given};

/// Pixels of a side.
const SIDE: RangeInclusive<u32> = 16..=4096;
/// From the body to the camera (m); farther away the haze leaves nothing to be seen.
const AWAY_M: RangeInclusive<f64> = 0.1..=50.0;
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
        // Ahead at once: a running body would leave the picture otherwise.
        self.0[0] = physics.position()[0];
        self.0[1] += (physics.position()[1] - self.0[1]) * share;
    }
}

/// Takes pictures of one size from one side.
#[pyclass(frozen, module = "treadmill_gym._native")]
pub struct Renderer {
    size: (u32, u32),
    /// From the point that is looked at to the camera (m).
    camera_m: [f64; 3],
    /// Of its own, made with the first picture: threads of a pool that all share would be missing in a forked process.
    pool: OnceLock<ThreadPool>,
}

#[pymethods]
impl Renderer {
    #[new]
    fn new(width: Bound<'_, PyAny>, height: Bound<'_, PyAny>, camera: Bound<'_, PyAny>) -> PyResult<Self> {
        let width = Given { name: "width", value: width }.whole(SIDE)?;
        let height = Given { name: "height", value: height }.whole(SIDE)?;
        let given = Given { name: "camera", value: camera };
        let camera_m = if given.value.is_none() { Some(BESIDE_M) } else { given.value.extract().ok() };
        // NaN is in no range either.
        let is_allowed = |&[x, y, z]: &[f64; 3]| {
            let (aside_m, allowed_m) = (x.hypot(y), AWAY_M);
            allowed_m.contains(&aside_m) && allowed_m.contains(&aside_m.hypot(z))
        };
        let camera_m = camera_m.filter(is_allowed).ok_or_else(|| {
            let (low_m, high_m) = (AWAY_M.start(), AWAY_M.end());
            given.refuse(&format!(
                "None, or x, y and z from the body to the camera in m: at least {low_m} m aside and at most {high_m} m away"
            ))
        })?;
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

impl Renderer {
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
