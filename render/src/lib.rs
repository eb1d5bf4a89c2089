//! Ray-cast pictures of a humanoid, without a window or a GPU.
//!
//! Each pixel shows the first shape that its rays hit. A scene has two dozen shapes and one light, so a picture of 320 × 240
//! pixels takes a few milliseconds. Pictures are the same on every machine.
//!
//! # Layout
//! - [`scene`]: coloured shapes of a body, at their poses.
//! - [`camera`]: rays of a pinhole camera.
//! - [`surface`]: the floor, or a height field.
//! - [`solid`]: intersection of a ray with a shape.
//! - [`picture`]: light, shadow and pixels.
//! - [`film`]: encoding as GIF and PNG.
//! - [`triangles`]: surfaces for viewers that draw on a GPU.

pub mod camera;
pub mod film;
pub mod picture;
pub mod scene;
pub mod solid;
pub mod surface;
pub mod triangles;

pub use camera::Camera;
pub use film::{FilmError, Gif};
pub use picture::Picture;
pub use scene::Scene;
pub use triangles::TriangleMesh;
