//! Pictures of a page, and how far two of them differ.

use std::{collections::HashSet, fs, io::Cursor, ops::Range, path::Path};

/// A picture as the browser gave it, and its pixels.
pub struct Picture {
    png: Vec<u8>,
    width: usize,
    height: usize,
    rgb: Vec<[u8; 3]>,
}

/// A part of a picture, in shares of its width and height.
pub struct Part {
    /// From left to right.
    pub x: Range<f64>,
    /// From top to bottom.
    pub y: Range<f64>,
}

impl Picture {
    /// Reads a PNG.
    pub fn decode(png: &[u8]) -> Self {
        let mut reader = png::Decoder::new(Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("of a sensible size")];
        let frame = reader.next_frame(&mut pixels).expect("a PNG");
        let channels = frame.color_type.samples();
        let rgb = pixels.chunks_exact(channels).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        Self { png: png.to_vec(), width: frame.width as usize, height: frame.height as usize, rgb }
    }

    /// As the browser gave it.
    pub fn png(&self) -> &[u8] {
        &self.png
    }

    /// Keeps it as a file.
    pub fn save(&self, file: &Path) {
        fs::write(file, &self.png).expect("the picture can be written");
    }

    fn pixels(&self, part: &Part) -> impl Iterator<Item = [u8; 3]> {
        let cut =
            |range: &Range<f64>, size: usize| (range.start * size as f64) as usize..(range.end * size as f64) as usize;
        let (columns, rows) = (cut(&part.x, self.width), cut(&part.y, self.height));
        rows.flat_map(move |row| columns.clone().map(move |column| self.rgb[row * self.width + column]))
    }

    /// How many colours there are.
    pub fn colours(&self, part: &Part) -> usize {
        self.pixels(part).collect::<HashSet<_>>().len()
    }

    /// Share of pixels that differ visibly from those of another picture of the same size.
    pub fn difference(&self, other: &Self, part: &Part) -> f64 {
        assert_eq!((self.width, self.height), (other.width, other.height));
        let (mut differing, mut all) = (0, 0);
        for (one, two) in self.pixels(part).zip(other.pixels(part)) {
            all += 1;
            differing += usize::from(one.iter().zip(two).any(|(a, b)| a.abs_diff(b) > 24));
        }
        f64::from(u32::try_from(differing).expect("few pixels")) / f64::from(u32::try_from(all).expect("few pixels"))
    }

    /// Share of pixels for which `is_so` holds.
    pub fn share(&self, part: &Part, is_so: impl Fn([u8; 3]) -> bool) -> f64 {
        let all: Vec<bool> = self.pixels(part).map(is_so).collect();
        all.iter().filter(|so| **so).count() as f64 / all.len() as f64
    }
}
