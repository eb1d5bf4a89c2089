//! Light, shadow and floor; pixels.

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::{
    camera::Camera,
    scene::{Colour, Scene},
    solid::Ray,
};

/// Rays through each pixel, in both directions.
const RAYS: u32 = 2;
const SKY: Colour = [0.80, 0.88, 0.95];
/// The floor's squares, of one metre.
const SQUARES: [Colour; 2] = [[0.62, 0.66, 0.70], [0.54, 0.58, 0.62]];
/// Every so many metres there is a line across the way ahead, so that one sees how far it is.
const LINE_EVERY_M: f64 = 5.0;
const LINE_HALF_WIDTH_M: f64 = 0.04;
const LINE: Colour = [0.95, 0.93, 0.85];
/// The floor fades into the sky at about this distance (m).
const HAZE_M: f64 = 16.0;
/// Brightness in the shade, where light comes from below and from above.
const SHADE: [f64; 2] = [0.30, 0.52];
/// What the lamp adds where it shines straight down on a surface.
const LAMP: f64 = 0.62;
/// Shadows begin this far from a surface (m), which would be in its own otherwise.
const LIFT_M: f64 = 1e-6;

/// Pixels, three bytes each (red, green, blue), in rows from the upper left corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `[height][width][3]`.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// A scene as a camera sees it, `size` = width and height. Rows are spread over rayon's threads; no pixel depends on how.
    ///
    /// # Panics
    /// If a side has no pixels.
    #[must_use]
    pub fn of(scene: &Scene, camera: &Camera, size: (u32, u32)) -> Self {
        let (width, height) = size;
        assert!(width > 0 && height > 0, "a picture has pixels");
        let mut rgb = vec![0; width as usize * height as usize * 3];
        let light = Vector3::new(0.35, -0.55, 0.95).normalize();
        rgb.par_chunks_exact_mut(width as usize * 3).enumerate().for_each(|(row, pixels)| {
            for (column, pixel) in pixels.chunks_exact_mut(3).enumerate() {
                let mut sum = [0.0; 3];
                for part in 0..RAYS * RAYS {
                    let offset = |part: u32| (f64::from(part) + 0.5) / f64::from(RAYS);
                    let (x, y) = (column as f64 + offset(part % RAYS), row as f64 + offset(part / RAYS));
                    let colour = colour(scene, &camera.ray(x, y, size), &light);
                    sum.iter_mut().zip(colour).for_each(|(sum, colour)| *sum += colour);
                }
                for (byte, sum) in pixel.iter_mut().zip(sum) {
                    *byte = (sum / f64::from(RAYS * RAYS) * 255.0).round().clamp(0.0, 255.0) as u8;
                }
            }
        });
        Self { width, height, rgb }
    }

    /// Red, green and blue of a pixel.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn pixel(&self, column: u32, row: u32) -> [u8; 3] {
        let at = (row as usize * self.width as usize + column as usize) * 3;
        [self.rgb[at], self.rgb[at + 1], self.rgb[at + 2]]
    }
}

/// What is seen along a ray.
fn colour(scene: &Scene, ray: &Ray, light: &Vector3<f64>) -> Colour {
    if let Some((hit, colour)) = scene.hit(ray) {
        let from = Ray { origin: ray.at(hit.distance_m) + hit.normal * LIFT_M, direction: *light };
        let lamp = hit.normal.dot(light).max(0.0);
        let is_lit = lamp > 0.0 && !scene.is_hit(&from);
        return scaled(colour, shade(hit.normal.z) + if is_lit { LAMP * lamp } else { 0.0 });
    }
    // The floor is the plane z = 0.
    let distance_m = -ray.origin.z / ray.direction.z;
    if !(distance_m > 0.0 && distance_m.is_finite()) {
        return SKY;
    }
    let at = ray.at(distance_m);
    let from = Ray { origin: at + Vector3::z() * LIFT_M, direction: *light };
    let lamp = if scene.is_hit(&from) { 0.0 } else { LAMP * light.z };
    let haze = 1.0 - (-(distance_m / HAZE_M).powi(2)).exp();
    mixed(scaled(floor(at.x, at.y), shade(1.0) + lamp), SKY, haze)
}

/// Brightness in the shade of a surface whose normal has this z.
fn shade(up: f64) -> f64 {
    SHADE[0] + (SHADE[1] - SHADE[0]) * (up + 1.0) / 2.0
}

fn floor(x_m: f64, y_m: f64) -> Colour {
    let to_line_m = (x_m - (x_m / LINE_EVERY_M).round() * LINE_EVERY_M).abs();
    if to_line_m < LINE_HALF_WIDTH_M {
        return LINE;
    }
    let is_odd = (x_m.floor() + y_m.floor()).rem_euclid(2.0) >= 1.0;
    SQUARES[usize::from(is_odd)]
}

fn scaled(colour: Colour, by: f64) -> Colour {
    colour.map(|part| part * by)
}

fn mixed(one: Colour, other: Colour, share: f64) -> Colour {
    [0, 1, 2].map(|part| one[part] + (other[part] - one[part]) * share)
}
