//! Treadmill: pictures of a humanoid, without a window or a GPU.
//!
//! Every pixel asks which shape the ray through it hits first. There are two dozen shapes and one light, so that a picture of
//! 320 × 240 takes some milliseconds, and it is the same on every machine.
//!
//! # Layout
//! - [`scene`]: the body's shapes where the physics has them, with a colour each.
//! - [`camera`]: from where they are seen.
//! - [`solid`]: where a ray meets a shape.
//! - [`picture`]: light, shadow and floor; pixels.
//! - [`film`]: many pictures as one GIF, or as PNG files.

pub mod camera;
pub mod film;
pub mod picture;
pub mod scene;
pub mod solid;

pub use camera::Camera;
pub use film::{FilmError, Gif};
pub use picture::Picture;
pub use scene::Scene;
