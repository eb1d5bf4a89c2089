//! Rendering: light, shadow and pixels.

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::{
    camera::Camera,
    scene::{Colour, Scene},
    solid::Ray,
};

/// Rays per pixel in each direction.
const RAYS: u32 = 2;
const SKY: Colour = [0.80, 0.88, 0.95];
/// Colours of the floor's squares of 1 m.
const SQUARES: [Colour; 2] = [[0.62, 0.66, 0.70], [0.54, 0.58, 0.62]];
/// Distance of lines across the x axis (m), which show the distance walked.
const LINE_EVERY_M: f64 = 5.0;
const LINE_HALF_WIDTH_M: f64 = 0.04;
const LINE: Colour = [0.95, 0.93, 0.85];
/// Distance at which the floor fades into the sky (m).
const HAZE_M: f64 = 16.0;
/// Ambient brightness of surfaces that face down and up.
const AMBIENT: [f64; 2] = [0.30, 0.52];
/// Brightness that the lamp adds at perpendicular incidence.
const LAMP: f64 = 0.62;
/// Distance of shadow rays' origins from the surface (m), which avoids self-shadowing.
const LIFT_M: f64 = 1e-6;

/// RGB pixels, three bytes each, in rows from the upper left corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Pixels as `[height][width][3]`.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// Renders a scene; `size` is width and height. Uses rayon's threads, whose number does not affect the pixels.
    ///
    /// # Panics
    /// If width or height is 0.
    #[must_use]
    pub fn of(scene: &Scene, camera: &Camera, size: (u32, u32)) -> Self {
        let (width, height) = size;
        assert!(width > 0 && height > 0, "width and height must be positive");
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

    /// Returns red, green and blue of a pixel.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    #[must_use]
    pub fn pixel(&self, column: u32, row: u32) -> [u8; 3] {
        let at = (row as usize * self.width as usize + column as usize) * 3;
        [self.rgb[at], self.rgb[at + 1], self.rgb[at + 2]]
    }
}

/// Returns the colour along a ray.
fn colour(scene: &Scene, ray: &Ray, light: &Vector3<f64>) -> Colour {
    if let Some((hit, colour)) = scene.hit(ray) {
        let from = Ray { origin: ray.at(hit.distance_m) + hit.normal * LIFT_M, direction: *light };
        let lamp = hit.normal.dot(light).max(0.0);
        let is_lit = lamp > 0.0 && !scene.is_hit(&from);
        return scaled(colour, ambient(hit.normal.z) + if is_lit { LAMP * lamp } else { 0.0 });
    }
    let Some(hit) = scene.surface().hit(ray) else { return SKY };
    let at = ray.at(hit.distance_m);
    let from = Ray { origin: at + hit.normal * LIFT_M, direction: *light };
    let is_lit = !(scene.is_hit(&from) || scene.surface().shades(&from));
    let lamp = if is_lit { LAMP * hit.normal.dot(light).max(0.0) } else { 0.0 };
    let haze = 1.0 - (-(hit.distance_m / HAZE_M).powi(2)).exp();
    mixed(scaled(floor(at.x, at.y), ambient(hit.normal.z) + lamp), SKY, haze)
}

/// Returns the ambient brightness of a surface whose normal has this z.
fn ambient(up: f64) -> f64 {
    AMBIENT[0] + (AMBIENT[1] - AMBIENT[0]) * (up + 1.0) / 2.0
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
