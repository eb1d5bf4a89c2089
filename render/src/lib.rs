//! Pictures of a humanoid, without a window or a GPU.
//!
//! Triangles are drawn into a grid of samples, four for each pixel, and once more as the lamp sees them, for shadows. A
//! picture of 640 × 480 pixels takes about 60 ms on one core for a robot of 390,000 triangles, and 45 ms for one of
//! capsules. Pictures are the same on every machine.
//!
//! # Layout
//! - [`look`]: coloured surfaces of a robot: meshes of its file, or its shapes.
//! - [`scene`]: those surfaces at their poses, and the ground.
//! - [`camera`]: pinhole camera.
//! - `raster`: triangles on a grid of samples.
//! - [`picture`]: light, shadow and pixels.
//! - [`text`]: text in pictures.
//! - [`mod@portrait`]: a robot from two sides.
//! - [`film`]: encoding as GIF and PNG.
//! - [`triangles`]: surfaces of shapes, also for viewers that draw on a GPU.

pub mod camera;
pub mod film;
pub mod look;
pub mod picture;
pub mod portrait;
mod raster;
pub mod scene;
pub mod text;
pub mod triangles;

pub use camera::Camera;
pub use film::{FilmError, Gif};
pub use look::Look;
pub use picture::Picture;
pub use portrait::portrait;
pub use scene::Scene;
pub use triangles::TriangleMesh;
