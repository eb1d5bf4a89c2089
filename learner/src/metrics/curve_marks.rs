//! Marks, legends and soft edges of the learning curve.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::FontDesc;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::curve_points::CurvePoint;

/// Width of the image in pixels.
pub const WIDTH: u32 = 1200;
/// Pixels that are drawn for each pixel of the image, in each direction: the plotter's own lines have steps.
pub const SCALE: u32 = 2;

/// Name of the embedded font in the plotter.
pub const FONT: &str = "DejaVu Sans";

/// Colour of names beside marks.
pub const LABEL: RGBColor = RGBColor(90, 90, 90);

/// Error of the plotter.
pub type DrawError = DrawingAreaErrorKind<<BitMapBackend<'static> as DrawingBackend>::ErrorType>;
/// Part of the image.
pub type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

/// Mark in a legend.
pub enum Key {
    /// Stroke.
    Line,
    /// Circle without filling.
    Ring,
    /// Stroke with gaps.
    Dashes,
}

/// Draws marks and their names, from the right edge of a panel to the left.
pub fn draw_legend<'a>(
    entries: impl DoubleEndedIterator<Item = (Key, &'a str, bool)>,
    colour: RGBColor,
    area: &Area<'_>,
) -> Result<(), DrawError> {
    let mut right = (WIDTH - 36) as i32;
    for (key, name, _) in entries.rev() {
        let style = font(17).color(&LABEL).pos(Pos::new(HPos::Right, VPos::Center));
        area.draw(&Text::new(name, scaled(right, 26), style))?;
        right -= 9 * name.chars().count() as i32 + 10;
        let line = |from: i32, to: i32| vec![scaled(from, 26), scaled(to, 26)];
        match key {
            Key::Line => area.draw(&PathElement::new(line(right - 30, right), colour.stroke_width(2 * SCALE)))?,
            Key::Dashes => {
                for from in [right - 28, right - 12] {
                    area.draw(&PathElement::new(line(from, from + 10), LABEL.stroke_width(2 * SCALE)))?;
                }
            }
            Key::Ring => {
                for (radius, colour) in [(6, colour), (4, WHITE)] {
                    area.draw(&Circle::new(scaled(right - 8, 26), radius * SCALE, colour.filled()))?;
                }
            }
        }
        right -= 48;
    }
    Ok(())
}

/// Returns a dashed line between two points.
pub fn dashed(
    ends: &[CurvePoint; 2],
    colour: RGBColor,
    width: u32,
) -> DashedLineSeries<std::array::IntoIter<CurvePoint, 2>, u32> {
    DashedLineSeries::new(*ends, 8 * SCALE, 6 * SCALE, colour.stroke_width(width * SCALE))
}

/// Returns a place in pixels that are drawn.
pub fn scaled(column: i32, row: i32) -> (i32, i32) {
    (column * SCALE as i32, row * SCALE as i32)
}

/// Returns the means of squares of `SCALE` pixels in each direction.
pub fn reduced(large: &[u8], width: usize) -> Vec<u8> {
    let (scale, row_bytes) = (SCALE as usize, 3 * width);
    let rows = large.chunks_exact(row_bytes * scale);
    let mean = |rows: &[u8], at: usize| {
        let column = at / 3 * scale;
        let parts = (0..scale * scale)
            .map(|part| usize::from(rows[part / scale * row_bytes + (column + part % scale) * 3 + at % 3]));
        (parts.sum::<usize>() / (scale * scale)) as u8
    };
    rows.flat_map(|rows| (0..row_bytes / scale).map(move |at| mean(rows, at))).collect()
}

/// Returns the font at a size in pixels of the image.
pub fn font(size: u32) -> FontDesc<'static> {
    (FONT, size * SCALE).into_font()
}
