//! Many pictures as one GIF, or single ones as PNG.

use std::{collections::HashMap, io::Write};

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, Frame, Repeat};

use crate::picture::Picture;

/// A picture that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// The GIF.
    #[error("the GIF cannot be written: {0}")]
    Gif(#[from] gif::EncodingError),
    /// A PNG.
    #[error("the PNG cannot be written: {0}")]
    Png(#[from] png::EncodingError),
    /// Larger than a GIF can be, or not as large as the first picture.
    #[error("a picture of {width} × {height} pixels does not fit into this GIF")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
}

/// Colours that a GIF may have beside the one that stands for what was there before.
const COLOURS: usize = 255;
/// Stands for what was there before.
const AS_BEFORE: u8 = 255;
/// How thoroughly colours are chosen, from 1 (all pixels are looked at) to 30.
const CHOICE: i32 = 3;
/// Time in a GIF is counted in these.
const TICKS_PER_S: f64 = 100.0;

/// An animation that is written picture by picture, and repeats for ever. All pictures share the colours of the first; of each,
/// only what has changed is written.
pub struct Gif<W: Write> {
    out: Option<W>,
    begun: Option<Begun<W>>,
    pictures_per_s: f64,
    pictures: u32,
}

struct Begun<W: Write> {
    encoder: Encoder<W>,
    size: (u16, u16),
    colours: NeuQuant,
    known: HashMap<[u8; 3], u8>,
    last: Vec<u8>,
}

impl<W: Write> Gif<W> {
    /// Writes to `out`, which is best buffered.
    pub fn new(out: W, pictures_per_s: f64) -> Self {
        Self { out: Some(out), begun: None, pictures_per_s, pictures: 0 }
    }

    /// The next picture.
    ///
    /// # Errors
    /// [`FilmError`] where it cannot be written or has not the size of the first.
    pub fn add(&mut self, picture: &Picture) -> Result<(), FilmError> {
        let wrong = FilmError::Size { width: picture.width, height: picture.height };
        let (Ok(width), Ok(height)) = (u16::try_from(picture.width), u16::try_from(picture.height)) else {
            return Err(wrong);
        };
        if let Some(out) = self.out.take() {
            self.begun = Some(Begun::new(out, (width, height), picture)?);
        }
        // Without one, an earlier picture could not be written.
        let Some(begun) = self.begun.as_mut().filter(|begun| begun.size == (width, height)) else { return Err(wrong) };
        let tick = |pictures: u32| (f64::from(pictures) * TICKS_PER_S / self.pictures_per_s).round();
        let delay = tick(self.pictures + 1) - tick(self.pictures);
        self.pictures += 1;
        begun.write(picture, delay as u16)
    }
}

impl<W: Write> Gif<W> {
    /// Writes the end, and gives back what was written to, unless there was no picture.
    ///
    /// # Errors
    /// [`FilmError`] where the end cannot be written.
    pub fn finish(self) -> Result<W, FilmError> {
        match (self.begun, self.out) {
            (Some(begun), _) => Ok(begun.encoder.into_inner()?),
            (None, Some(out)) => Ok(out),
            (None, None) => Err(FilmError::Size { width: 0, height: 0 }),
        }
    }
}

impl<W: Write> Begun<W> {
    fn new(out: W, size: (u16, u16), first: &Picture) -> Result<Self, FilmError> {
        let rgba: Vec<u8> = first.rgb.as_chunks::<3>().0.iter().flat_map(|[r, g, b]| [*r, *g, *b, 255]).collect();
        let colours = NeuQuant::new(CHOICE, COLOURS, &rgba);
        let mut palette = colours.color_map_rgb();
        palette.resize((COLOURS + 1) * 3, 0);
        let mut encoder = Encoder::new(out, size.0, size.1, &palette)?;
        encoder.set_repeat(Repeat::Infinite)?;
        Ok(Self { encoder, size, colours, known: HashMap::new(), last: Vec::new() })
    }

    fn write(&mut self, picture: &Picture, delay: u16) -> Result<(), FilmError> {
        let Self { colours, known, .. } = self;
        let mut nearest = |rgb: &[u8; 3]| {
            *known.entry(*rgb).or_insert_with(|| colours.index_of(&[rgb[0], rgb[1], rgb[2], 255]) as u8)
        };
        let now: Vec<u8> = picture.rgb.as_chunks::<3>().0.iter().map(&mut nearest).collect();
        let (width, height) = self.size;
        let is_first = self.last.is_empty();
        let changed = |index: usize| is_first || self.last[index] != now[index];
        let row_changed = |row: &usize| (0..width as usize).any(|column| changed(row * width as usize + column));
        // Where nothing changed, one row that changes nothing keeps the time.
        let top = (0..height as usize).find(row_changed).unwrap_or(0);
        let bottom = (top..height as usize).rev().find(row_changed).unwrap_or(top);
        let rows = top * width as usize..(bottom + 1) * width as usize;
        let buffer = rows.map(|index| if changed(index) { now[index] } else { AS_BEFORE }).collect::<Vec<_>>().into();
        let frame = Frame {
            delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(AS_BEFORE),
            top: top as u16,
            width,
            height: (bottom + 1 - top) as u16,
            buffer,
            ..Frame::default()
        };
        self.encoder.write_frame(&frame)?;
        self.last = now;
        Ok(())
    }
}

/// A picture as the bytes of a PNG file.
///
/// # Errors
/// [`FilmError`] where it cannot be encoded.
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
