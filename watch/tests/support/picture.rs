//! Screenshots of a page, and their differences.

use std::{collections::HashSet, fs, io::Cursor, ops::Range, path::Path};

/// PNG of a screenshot, and its pixels.
pub struct Screenshot {
    png: Vec<u8>,
    width: usize,
    height: usize,
    rgb: Vec<[u8; 3]>,
}

/// Region of a screenshot, in shares of its width and height.
pub struct Region {
    /// Horizontal range, from the left.
    pub x: Range<f64>,
    /// Vertical range, from the top.
    pub y: Range<f64>,
}

impl Screenshot {
    /// Decodes a PNG.
    pub fn decode(png: &[u8]) -> Self {
        let mut reader = png::Decoder::new(Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size that fits into memory")];
        let frame = reader.next_frame(&mut pixels).expect("a PNG");
        let channels = frame.color_type.samples();
        let rgb = pixels.chunks_exact(channels).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        Self { png: png.to_vec(), width: frame.width as usize, height: frame.height as usize, rgb }
    }

    /// Returns the PNG.
    pub fn png(&self) -> &[u8] {
        &self.png
    }

    /// Writes the PNG to a file.
    pub fn save(&self, file: &Path) {
        fs::write(file, &self.png).expect("the picture can be written");
    }

    fn pixels(&self, region: &Region) -> impl Iterator<Item = [u8; 3]> {
        let cut =
            |range: &Range<f64>, size: usize| (range.start * size as f64) as usize..(range.end * size as f64) as usize;
        let (columns, rows) = (cut(&region.x, self.width), cut(&region.y, self.height));
        rows.flat_map(move |row| columns.clone().map(move |column| self.rgb[row * self.width + column]))
    }

    /// Returns the number of colours.
    pub fn colours(&self, region: &Region) -> usize {
        self.pixels(region).collect::<HashSet<_>>().len()
    }

    /// Returns the share of pixels that differ visibly from a screenshot of the same size.
    pub fn difference(&self, other: &Self, region: &Region) -> f64 {
        assert_eq!((self.width, self.height), (other.width, other.height));
        let (mut differing, mut all) = (0, 0);
        for (one, two) in self.pixels(region).zip(other.pixels(region)) {
            all += 1;
            differing += usize::from(one.iter().zip(two).any(|(a, b)| a.abs_diff(b) > 24));
        }
        f64::from(u32::try_from(differing).expect("few pixels")) / f64::from(u32::try_from(all).expect("few pixels"))
    }

    /// Returns the share of pixels that satisfy a condition.
    pub fn share(&self, region: &Region, matches: impl Fn([u8; 3]) -> bool) -> f64 {
        let all: Vec<bool> = self.pixels(region).map(matches).collect();
        all.iter().filter(|matches| **matches).count() as f64 / all.len() as f64
    }
}
