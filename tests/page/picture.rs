//! Screenshots of a page.

use std::{fs, io::Cursor, path::PathBuf};

/// PNG of a screenshot, and its pixels.
pub struct Screenshot {
    png: Vec<u8>,
    rgb: Vec<[u8; 3]>,
}

impl Screenshot {
    /// Decodes a PNG.
    pub fn decode(png: &[u8]) -> Self {
        let mut reader = png::Decoder::new(Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size that fits into memory")];
        let frame = reader.next_frame(&mut pixels).expect("a PNG");
        let rgb = pixels.chunks_exact(frame.color_type.samples()).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        Self { png: png.to_vec(), rgb }
    }

    /// Returns the share of pixels of colours.
    pub fn share(&self, is_wanted: impl Fn([u8; 3]) -> bool) -> f64 {
        self.rgb.iter().filter(|pixel| is_wanted(**pixel)).count() as f64 / self.rgb.len() as f64
    }

    /// Returns the share of pixels that differ visibly from a screenshot of the same size.
    pub fn difference(&self, other: &Self) -> f64 {
        assert_eq!(self.rgb.len(), other.rgb.len());
        let differs = |(one, two): &(&[u8; 3], &[u8; 3])| one.iter().zip(*two).any(|(a, b)| a.abs_diff(*b) > 24);
        self.rgb.iter().zip(&other.rgb).filter(differs).count() as f64 / self.rgb.len() as f64
    }

    /// Writes the PNG to the folder TREADMILL_PICTURES, if there is one.
    pub fn keep(&self, name: &str) {
        if let Some(folder) = std::env::var_os("TREADMILL_PICTURES") {
            fs::write(PathBuf::from(folder).join(name), &self.png).expect("the picture can be written");
        }
    }
}
