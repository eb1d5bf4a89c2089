//! Rendering: light, shadow and pixels.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use crate::{
    camera::Camera,
    look::Colour,
    raster::Samples,
    scene::{PlacedSkin, Scene},
};

/// Samples per pixel in each direction.
const SAMPLES: usize = 2;
const SKY: Colour = [0.84, 0.90, 0.96];
/// Colours of the floor's squares of 1 m, and of the lines between them.
const SQUARES: [Colour; 2] = [[0.66, 0.69, 0.72], [0.58, 0.61, 0.65]];
const LINE: Colour = [0.93, 0.94, 0.95];
/// Half of the width of a line, and of every fifth one across the x axis, which shows the distance walked (m).
const LINE_HALF_WIDTH_M: [f64; 2] = [0.007, 0.02];
const WIDE_EVERY_M: f64 = 5.0;
/// Distance beyond the robot at which the floor fades into the sky (m).
const HAZE_M: f64 = 16.0;
/// Nearest distance from the camera of what is seen (m).
const NEAREST_M: f32 = 0.05;
/// Ambient brightness of surfaces that face down and up.
const AMBIENT: [f64; 2] = [0.36, 0.56];
/// Brightness that the lamp adds at perpendicular incidence, and where it is mirrored.
const LAMP: f64 = 0.58;
const GLOSS: f64 = 0.10;
/// Direction to the lamp.
const TO_LAMP: Vector3<f64> = Vector3::new(0.30, -0.48, 0.82);
/// Samples of the map of what the lamp sees, in each direction.
const SHADOW_SAMPLES: usize = 640;
/// Depth below what the lamp sees from which a point is in the shadow (m); a surface must not shade itself.
const SHADOW_DEPTH_M: f32 = 0.012;

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
        let (width, height) = (size.0 as usize, size.1 as usize);
        assert!(width > 0 && height > 0, "width and height must be positive");
        let (seen, lit) = rayon::join(|| Seen::by(camera, scene, size), || Lit::of(scene));
        let painter = Painter { scene, camera, size, seen, lit, to_lamp: TO_LAMP.normalize() };
        let mut rgb = vec![0; width * height * 3];
        rgb.par_chunks_exact_mut(width * 3).enumerate().for_each(|(row, pixels)| {
            for (column, pixel) in pixels.chunks_exact_mut(3).enumerate() {
                let colour = painter.pixel(column, row);
                pixel.iter_mut().zip(colour).for_each(|(byte, part)| *byte = byte_of(part));
            }
        });
        Self { width: size.0, height: size.1, rgb }
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

    /// Returns two pictures of the same height as one, side by side.
    ///
    /// # Panics
    /// If their heights differ.
    #[must_use]
    pub fn side_by_side(&self, other: &Self) -> Self {
        assert_eq!(self.height, other.height, "the heights must be the same");
        let rows = |picture: &Self| -> Vec<Vec<u8>> {
            picture.rgb.chunks_exact(picture.width as usize * 3).map(<[u8]>::to_vec).collect()
        };
        let rgb = rows(self).into_iter().zip(rows(other)).flat_map(|(one, other)| [one, other].concat()).collect();
        Self { width: self.width + other.width, height: self.height, rgb }
    }
}

pub(crate) fn byte_of(part: f64) -> u8 {
    (part * 255.0).round().clamp(0.0, 255.0) as u8
}

/// What the camera sees at each sample.
struct Seen {
    samples: Samples,
    /// Normal, in parts of `i16::MAX`, and index of the surface.
    found: Vec<([i16; 3], u16)>,
}

impl Seen {
    fn by(camera: &Camera, scene: &Scene, size: (u32, u32)) -> Self {
        let (width, height) = (size.0 as usize * SAMPLES, size.1 as usize * SAMPLES);
        let mut samples = Samples::new(width, height);
        let mut found = vec![([0; 3], 0); width * height];
        let scale = height as f32 / (2.0 * camera.half_height as f32);
        let (axes, eye) = (camera.axes.map(|axis| axis.cast()), camera.eye.coords.cast());
        for (index, PlacedSkin { skin, pose, .. }) in scene.placed.iter().enumerate() {
            let project = |point: Vector3<f32>| {
                let near = if point.z > NEAREST_M { 1.0 / point.z } else { f32::NAN };
                Vector3::new(
                    width as f32 / 2.0 + point.x * scale * near,
                    height as f32 / 2.0 - point.y * scale * near,
                    near,
                )
            };
            let corners: Vec<Vector3<f32>> = skin.seen(pose, &axes, &eye).into_iter().map(project).collect();
            for (triangle, normals) in skin.triangles.iter().zip(&skin.normals) {
                let of_triangle = triangle.map(|corner| &corners[corner as usize]);
                if of_triangle.iter().any(|corner| corner.z.is_nan()) {
                    continue;
                }
                samples.draw(of_triangle, |place, [a, b, c]| {
                    let normal = pose.rotation * (normals[0] * a + normals[1] * b + normals[2] * c);
                    let unit = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
                    found[place] = (unit.map(|part| (part * f32::from(i16::MAX)) as i16).into(), index as u16);
                });
            }
        }
        Self { samples, found }
    }
}

/// What the lamp sees: where it lights.
struct Lit {
    /// Nearness grows by 1 for each metre towards the lamp.
    samples: Samples,
    axes: [Vector3<f32>; 3],
    /// Middle of what is seen (m), the distance from it to the edges (m), and samples per metre.
    middle: Vector3<f32>,
    reach_m: f32,
    scale: f32,
}

impl Lit {
    fn of(scene: &Scene) -> Self {
        let to_lamp: Vector3<f32> = TO_LAMP.normalize().cast();
        let right = Vector3::z().cross(&to_lamp).normalize();
        let axes = [right, to_lamp.cross(&right), to_lamp];
        let solid = scene.placed.iter().filter(|placed| placed.is_solid);
        let seen = solid.map(|placed| (placed, placed.skin.seen(&placed.pose, &axes, &Vector3::zeros())));
        let corners: Vec<(&PlacedSkin, Vec<Vector3<f32>>)> = seen.collect();
        let all = corners.iter().flat_map(|(_, corners)| corners);
        let around = all.fold(None, |around: Option<[Vector3<f32>; 2]>, corner| {
            Some(around.map_or([*corner; 2], |[low, high]| [low.inf(corner), high.sup(corner)]))
        });
        let [low, high] = around.unwrap_or_default();
        let (middle, reach_m) = ((low + high) / 2.0, (high - low).amax() / 2.0 + 0.05);
        let scale = SHADOW_SAMPLES as f32 / (2.0 * reach_m);
        let mut samples = Samples::new(SHADOW_SAMPLES, SHADOW_SAMPLES);
        for (placed, corners) in &corners {
            let place = |corner: &Vector3<f32>| {
                let near = corner - middle + Vector3::repeat(reach_m);
                Vector3::new(near.x * scale, near.y * scale, near.z + 1.0)
            };
            let corners: Vec<Vector3<f32>> = corners.iter().map(place).collect();
            for triangle in &placed.skin.triangles {
                samples.draw(triangle.map(|corner| &corners[corner as usize]), |_, _| {});
            }
        }
        Self { samples, axes, middle, reach_m, scale }
    }

    /// Returns the share of the lamp that lights a point with this normal: a mean of the four nearest samples.
    fn share(&self, point: &Point3<f64>, normal: &Vector3<f64>) -> f64 {
        let point: Vector3<f32> = (point.coords + normal * f64::from(1.5 / self.scale)).cast();
        let [x, y, z] = self.axes.map(|axis| axis.dot(&point));
        let near = Vector3::new(x, y, z) - self.middle + Vector3::repeat(self.reach_m);
        let (x, y, nearness) = (near.x * self.scale - 0.5, near.y * self.scale - 0.5, near.z + 1.0 + SHADOW_DEPTH_M);
        let most = (SHADOW_SAMPLES - 2) as f32;
        if !(0.0..most).contains(&x) || !(0.0..most).contains(&y) {
            return 1.0;
        }
        let (column, row) = (x as usize, y as usize);
        let lit = |columns: usize, rows: usize| {
            let seen = self.samples.nearness[(row + rows) * SHADOW_SAMPLES + column + columns];
            if seen > nearness { 0.0 } else { 1.0 }
        };
        let (right, down) = (x - column as f32, y - row as f32);
        let mixed = |rows: usize| lit(0, rows) + (lit(1, rows) - lit(0, rows)) * right;
        f64::from(mixed(0) + (mixed(1) - mixed(0)) * down)
    }
}

/// Colours pixels.
struct Painter<'a> {
    scene: &'a Scene,
    camera: &'a Camera,
    size: (u32, u32),
    seen: Seen,
    lit: Lit,
    to_lamp: Vector3<f64>,
}

impl Painter<'_> {
    /// Returns the mean colour of the samples of a pixel.
    fn pixel(&self, column: usize, row: usize) -> Colour {
        let (mut sum, mut far) = ([0.0; 3], 0.0);
        for part in 0..SAMPLES * SAMPLES {
            let (column, row) = (column * SAMPLES + part % SAMPLES, row * SAMPLES + part / SAMPLES);
            let place = row * self.seen.samples.width + column;
            if self.seen.samples.nearness[place] > 0.0 {
                sum = added(sum, self.surface(place, column, row), 1.0);
            } else {
                far += 1.0;
            }
        }
        if far > 0.0 {
            sum = added(sum, self.behind(column, row), far);
        }
        sum.map(|part| part / (SAMPLES * SAMPLES) as f64)
    }

    /// Returns the colour of the surface at a sample.
    fn surface(&self, place: usize, column: usize, row: usize) -> Colour {
        let (normal, index) = self.seen.found[place];
        let sides = SAMPLES as f64;
        let towards = self.camera.direction((column as f64 + 0.5) / sides, (row as f64 + 0.5) / sides, self.size);
        let point = self.camera.eye + towards / f64::from(self.seen.samples.nearness[place]);
        let normal = Vector3::from(normal.map(f64::from)) / f64::from(i16::MAX);
        // A surface may be seen from inside.
        let normal = if normal.dot(&towards) > 0.0 { -normal } else { normal };
        match self.scene.placed[index as usize].colour {
            Some(colour) => self.shaded(colour, &point, &normal, &towards),
            None => self.ground(&point, &normal, &towards),
        }
    }

    fn shaded(&self, colour: Colour, point: &Point3<f64>, normal: &Vector3<f64>, towards: &Vector3<f64>) -> Colour {
        let lamp = normal.dot(&self.to_lamp);
        let lamp_share = if lamp > 0.0 { self.lit.share(point, normal) } else { 0.0 };
        let half = (self.to_lamp - towards.normalize()).normalize();
        let gloss = GLOSS * lamp_share * normal.dot(&half).max(0.0).powi(24);
        colour.map(|part| part * (ambient(normal.z) + LAMP * lamp.max(0.0) * lamp_share) + gloss)
    }

    /// Returns the colour of level ground or sky in the middle of a pixel.
    fn behind(&self, column: usize, row: usize) -> Colour {
        let towards = self.camera.direction(column as f64 + 0.5, row as f64 + 0.5, self.size);
        let distance = -self.camera.eye.z / towards.z;
        if !self.scene.is_level() || distance <= 0.0 || !distance.is_finite() {
            return SKY;
        }
        self.ground(&(self.camera.eye + towards * distance), &Vector3::z(), &towards)
    }

    fn ground(&self, point: &Point3<f64>, normal: &Vector3<f64>, towards: &Vector3<f64>) -> Colour {
        let distance_m = (point - self.camera.eye).norm();
        let haze = 1.0 - (-((distance_m - self.camera.target_m).max(0.0) / HAZE_M).powi(2)).exp();
        if haze > 0.995 {
            return SKY;
        }
        let lamp = LAMP * normal.dot(&self.to_lamp).max(0.0) * self.lit.share(point, normal);
        // Length of the ground that a pixel shows, along x and along y.
        let pixel_m = distance_m * 2.0 * self.camera.half_height / f64::from(self.size.1);
        let unit = towards.normalize();
        let steep = unit.dot(normal).abs().max(1e-3);
        let level = unit.xy().try_normalize(0.0).unwrap_or_default();
        let spread_m = [0, 1].map(|axis| pixel_m * ((level[axis] / steep).powi(2) + 1.0 - level[axis].powi(2)).sqrt());
        let colour = floor([point.x, point.y], spread_m).map(|part| part * (ambient(normal.z) + lamp));
        mixed(colour, SKY, haze)
    }
}

/// Returns the ambient brightness of a surface whose normal has this z.
fn ambient(up: f64) -> f64 {
    AMBIENT[0] + (AMBIENT[1] - AMBIENT[0]) * (up + 1.0) / 2.0
}

/// Returns the mean colour of the floor over a rectangle around a point.
fn floor(place_m: [f64; 2], spread_m: [f64; 2]) -> Colour {
    // Mean of a wave of length 2 with the values 1 and -1 (after Inigo Quilez).
    let wave = |axis: usize| {
        let (at, spread) = (place_m[axis], spread_m[axis].max(1e-6));
        let area = |to: f64| (to / 2.0 - whole(to / 2.0) - 0.5).abs();
        2.0 * (area(at - spread / 2.0) - area(at + spread / 2.0)) / spread
    };
    let colour = mixed(SQUARES[0], SQUARES[1], 0.5 - 0.5 * wave(0) * wave(1));
    let line = |axis: usize, every_m: f64, half_m: f64| {
        let (nearest_m, spread) = (whole(place_m[axis] / every_m + 0.5) * every_m, spread_m[axis]);
        let off_m = (place_m[axis] - nearest_m).abs();
        if off_m > half_m + spread / 2.0 {
            return 0.0;
        }
        let overlap_m = (off_m + spread / 2.0).min(half_m) - (off_m - spread / 2.0).max(-half_m);
        (overlap_m / spread.max(1e-6)).clamp(0.0, 1.0)
    };
    let [thin_m, wide_m] = LINE_HALF_WIDTH_M;
    let share = line(0, 1.0, thin_m).max(line(1, 1.0, thin_m)).max(line(0, WIDE_EVERY_M, wide_m));
    mixed(colour, LINE, share)
}

/// Rounds down. Without the instruction of newer processors the standard function takes many times as long.
fn whole(number: f64) -> f64 {
    let towards_zero = number as i64 as f64;
    if towards_zero > number { towards_zero - 1.0 } else { towards_zero }
}

fn added(one: Colour, other: Colour, weight: f64) -> Colour {
    [0, 1, 2].map(|part| one[part] + other[part] * weight)
}

fn mixed(one: Colour, other: Colour, share: f64) -> Colour {
    [0, 1, 2].map(|part| one[part] + (other[part] - one[part]) * share)
}
