//! Text in pictures.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};
use nalgebra::Point3;

use crate::{Camera, Picture, look::Colour, picture::byte_of};

/// Colour of text.
pub const INK: Colour = [0.12, 0.14, 0.17];
/// Least height of text that can be read (pixels); smaller one is left out.
const HEIGHT_MIN: f64 = 7.0;
/// Height of text in small pictures (pixels).
const HEIGHT_LEAST: f64 = 9.0;

/// The font is embedded, because a machine without a screen often has none.
static FONT: LazyLock<FontRef<'static>> =
    LazyLock::new(|| FontRef::try_from_slice(dejavu::sans::regular()).expect("the embedded font is whole"));

/// Returns the width of text of this height, in pixels.
fn text_width(text: &str, height: f64) -> f64 {
    let font = FONT.as_scaled(PxScale::from(height as f32 * 1.16));
    f64::from(text.chars().map(|letter| font.h_advance(font.glyph_id(letter))).sum::<f32>())
}

/// Where text stands: its point in the picture, in pixels from the upper left corner, and the share of its width that is to
/// the left of it.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Column.
    pub column: f64,
    /// Row of its middle.
    pub row: f64,
    /// 0 for text that begins there, 1 for text that ends there.
    pub left_share: f64,
}

impl Picture {
    /// Height of text that fits to the picture's size (pixels).
    #[must_use]
    pub fn text_height(&self) -> f64 {
        (f64::from(self.height.min(self.width)) / 32.0).max(HEIGHT_LEAST)
    }

    /// Writes a line of text at the upper edge, smaller if it would not fit.
    pub fn write_line(&mut self, text: &str) {
        let (height, room) = (self.text_height(), f64::from(self.width) - 2.0 * self.text_height());
        let height = height * (room / text_width(text, height)).min(1.0);
        self.write(text, Place { column: height, row: 1.2 * height, left_share: 0.0 }, height, INK);
    }

    /// Writes a line of text. Text that would be too small to read is left out, and what is
    /// outside the picture is cut off.
    pub fn write(&mut self, text: &str, place: Place, height: f64, colour: Colour) {
        if height < HEIGHT_MIN {
            return;
        }
        let font = FONT.as_scaled(PxScale::from(height as f32 * 1.16));
        let mut at = point(
            (place.column - text_width(text, height) * place.left_share) as f32,
            place.row as f32 + (font.ascent() + font.descent()) / 2.0,
        );
        for letter in text.chars() {
            let mut glyph = font.scaled_glyph(letter);
            glyph.position = at;
            at.x += font.h_advance(glyph.id);
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let first = outline.px_bounds().min;
            outline.draw(|column, row, share| {
                let (column, row) = (first.x as i64 + i64::from(column), first.y as i64 + i64::from(row));
                let is_inside =
                    (0..i64::from(self.width)).contains(&column) && (0..i64::from(self.height)).contains(&row);
                if is_inside {
                    let start = (row as usize * self.width as usize + column as usize) * 3;
                    for (byte, ink) in self.rgb[start..start + 3].iter_mut().zip(colour) {
                        let paper = f64::from(*byte) / 255.0;
                        *byte = byte_of(paper + (ink - paper) * f64::from(share).clamp(0.0, 1.0));
                    }
                }
            });
        }
    }

    /// Writes texts at points of the world. Those that the edge would cut off are left out.
    pub fn write_scale(
        &mut self,
        camera: &Camera,
        marks: impl IntoIterator<Item = (Point3<f64>, String)>,
        left_share: f64,
    ) {
        let (size, height) = ((self.width, self.height), self.text_height() * 0.85);
        for (mark, text) in marks {
            let Some((column, row)) = camera.project(&mark, size) else { continue };
            let width = text_width(&text, height);
            let left = column - width * left_share;
            if left >= 0.0 && left + width <= f64::from(self.width) {
                self.write(&text, Place { column, row, left_share }, height, INK);
            }
        }
    }
}
