//! Encoding of pictures as GIF and PNG.

use std::{
    collections::{HashMap, HashSet},
    io::Write,
    iter,
};

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, Frame, Repeat};

use crate::picture::Picture;

/// Error of encoding a picture.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// The GIF cannot be encoded or written.
    #[error("the GIF cannot be written")]
    Gif(#[from] gif::EncodingError),
    /// The PNG cannot be encoded.
    #[error("the PNG cannot be written")]
    Png(#[from] png::EncodingError),
    /// The picture exceeds the GIF's limit, or differs from the first picture in size.
    #[error("a picture of {width} × {height} pixels does not fit into this GIF")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
}

/// Colours of a GIF by the quantiser; those of the first picture that are farthest from them, such as a small arrow's; and
/// [`TRANSPARENT`].
const COLOURS: usize = 223;
const RARE: usize = 32;
/// Index of the transparent colour, which keeps the previous frame's pixel.
const TRANSPARENT: u8 = 255;
/// Sampling factor of the colour quantiser, from 1 (all pixels) to 30.
const SAMPLING: i32 = 3;
/// Greatest difference of a pixel, in any of its three colours, that is not written.
const CHANGE_MAX: u8 = 5;
/// Unit of time in a GIF.
const TICKS_PER_S: f64 = 100.0;

/// Endlessly repeated animation, written picture by picture. All pictures share the first one's palette, and only changed
/// pixels are written.
pub struct Gif<W: Write> {
    out: Option<W>,
    encoding: Option<Encoding<W>>,
    pictures_per_s: f64,
    pictures: u32,
}

struct Encoding<W: Write> {
    encoder: Encoder<W>,
    size: (u16, u16),
    colours: NeuQuant,
    rare: Vec<[u8; 3]>,
    palette: Vec<[u8; 3]>,
    indices: HashMap<[u8; 3], u8>,
    previous: Vec<u8>,
}

impl<W: Write> Gif<W> {
    /// Creates an animation that is written to `out`, which should be buffered.
    pub fn new(out: W, pictures_per_s: f64) -> Self {
        Self { out: Some(out), encoding: None, pictures_per_s, pictures: 0 }
    }

    /// Appends a picture.
    ///
    /// # Errors
    /// [`FilmError`] if it cannot be written or differs from the first picture in size.
    pub fn add(&mut self, picture: &Picture) -> Result<(), FilmError> {
        let wrong = FilmError::Size { width: picture.width, height: picture.height };
        let (Ok(width), Ok(height)) = (u16::try_from(picture.width), u16::try_from(picture.height)) else {
            return Err(wrong);
        };
        if let Some(out) = self.out.take() {
            self.encoding = Some(Encoding::new(out, (width, height), picture)?);
        }
        // There is no encoding if an earlier picture failed.
        let Some(encoding) = self.encoding.as_mut().filter(|encoding| encoding.size == (width, height)) else {
            return Err(wrong);
        };
        let tick = |pictures: u32| (f64::from(pictures) * TICKS_PER_S / self.pictures_per_s).round();
        let delay = tick(self.pictures + 1) - tick(self.pictures);
        self.pictures += 1;
        encoding.write(picture, delay as u16)
    }

    /// Writes the trailer and returns the writer.
    ///
    /// # Errors
    /// [`FilmError`] if the trailer cannot be written or an earlier picture failed.
    pub fn finish(self) -> Result<W, FilmError> {
        match (self.encoding, self.out) {
            (Some(encoding), _) => Ok(encoding.encoder.into_inner()?),
            (None, Some(out)) => Ok(out),
            (None, None) => Err(FilmError::Size { width: 0, height: 0 }),
        }
    }
}

impl<W: Write> Encoding<W> {
    fn new(out: W, size: (u16, u16), first: &Picture) -> Result<Self, FilmError> {
        let pixels = first.rgb.as_chunks::<3>().0;
        let rgba: Vec<u8> = pixels.iter().flat_map(|[red, green, blue]| [*red, *green, *blue, 255]).collect();
        let colours = NeuQuant::new(SAMPLING, COLOURS, &rgba);
        let mut palette = colours.color_map_rgb();
        let single: HashSet<[u8; 3]> = pixels.iter().copied().collect();
        let nearest = |rgb: &[u8; 3]| palette.as_chunks::<3>().0[colours.index_of(&[rgb[0], rgb[1], rgb[2], 255])];
        let mut far: Vec<([u8; 3], u32)> = single.iter().map(|rgb| (*rgb, distance(rgb, &nearest(rgb)))).collect();
        far.sort_unstable();
        let mut rare = Vec::new();
        while rare.len() < RARE
            && let Some((found, _)) = far.iter().max_by_key(|(_, off)| *off).copied()
        {
            far.iter_mut().for_each(|(rgb, off)| *off = (*off).min(distance(rgb, &found)));
            rare.push(found);
        }
        palette.extend(rare.as_flattened());
        palette.resize((COLOURS + RARE + 1) * 3, 0);
        let mut encoder = Encoder::new(out, size.0, size.1, &palette)?;
        encoder.set_repeat(Repeat::Infinite)?;
        let palette = palette.as_chunks::<3>().0.to_vec();
        Ok(Self { encoder, size, colours, rare, palette, indices: HashMap::new(), previous: Vec::new() })
    }

    fn write(&mut self, picture: &Picture, delay: u16) -> Result<(), FilmError> {
        let Self { colours, rare, palette, indices, .. } = self;
        let mut nearest = |rgb: &[u8; 3]| {
            *indices.entry(*rgb).or_insert_with(|| {
                let usual = colours.index_of(&[rgb[0], rgb[1], rgb[2], 255]);
                let places = iter::once(usual).chain(COLOURS..COLOURS + rare.len());
                places.min_by_key(|place| distance(rgb, &palette[*place])).unwrap_or(usual) as u8
            })
        };
        let pixels = picture.rgb.as_chunks::<3>().0;
        let current: Vec<u8> = match self.previous.is_empty() {
            true => pixels.iter().map(&mut nearest).collect(),
            // A colour that hardly changes stays: that makes files smaller.
            false => iter::zip(pixels, &self.previous)
                .map(|(rgb, before)| if near(rgb, palette[usize::from(*before)]) { *before } else { nearest(rgb) })
                .collect(),
        };
        let (width, height) = self.size;
        let is_first = self.previous.is_empty();
        let changed = |index: usize| is_first || self.previous[index] != current[index];
        let row_changed = |row: &usize| (0..width as usize).any(|column| changed(row * width as usize + column));
        // If nothing changed, one transparent row carries the delay.
        let top = (0..height as usize).find(row_changed).unwrap_or(0);
        let bottom = (top..height as usize).rev().find(row_changed).unwrap_or(top);
        let rows = top * width as usize..(bottom + 1) * width as usize;
        let buffer =
            rows.map(|index| if changed(index) { current[index] } else { TRANSPARENT }).collect::<Vec<_>>().into();
        let frame = Frame {
            delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(TRANSPARENT),
            top: top as u16,
            width,
            height: (bottom + 1 - top) as u16,
            buffer,
            ..Frame::default()
        };
        self.encoder.write_frame(&frame)?;
        self.previous = current;
        Ok(())
    }
}

/// Returns the square of the distance of two colours.
fn distance(one: &[u8; 3], other: &[u8; 3]) -> u32 {
    iter::zip(one, other).map(|(one, other)| u32::from(one.abs_diff(*other)).pow(2)).sum()
}

fn near(one: &[u8; 3], other: [u8; 3]) -> bool {
    iter::zip(one, other).all(|(one, other)| one.abs_diff(other) <= CHANGE_MAX)
}

/// Encodes a picture as the bytes of a PNG file.
///
/// # Errors
/// [`FilmError`] if it cannot be encoded.
pub fn png(picture: &Picture) -> Result<Vec<u8>, FilmError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&picture.rgb)?;
    Ok(bytes)
}

#[cfg(test)]
#[path = "film_tests.rs"]
mod tests;
