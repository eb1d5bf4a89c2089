//! Learning curve as a PNG, drawn from `metrics.jsonl`.

use std::fs::File;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontStyle, register_font};
use treadmill_runtime::atomic_file;

use super::jsonl::for_each_metric;
use super::table::format_number;

/// Width and height of the image in pixels.
const SIZE: (u32, u32) = (1200, 1200);

/// Name of the embedded font in the plotter.
const FONT: &str = "DejaVu Sans";

/// Largest number that is drawn; larger ones are omitted, because the plotter's arithmetic would overflow.
const DRAWABLE_MAX: f64 = 1e12;

/// Most points that are drawn as dots: a line alone would not show that there are few.
const DOTS_MAX: usize = 60;

const TITLE: RGBColor = RGBColor(40, 40, 40);
const LABEL: RGBColor = RGBColor(90, 90, 90);
const GRID: RGBColor = RGBColor(225, 225, 225);
const BLUE: RGBColor = RGBColor(31, 119, 180);
const GREEN: RGBColor = RGBColor(44, 140, 60);
const ORANGE: RGBColor = RGBColor(200, 80, 30);

/// Plot of one quantity over environment steps.
struct Panel {
    tag: &'static str,
    title: &'static str,
    axis: &'static str,
    /// Returns the better of two values.
    better: fn(f64, f64) -> f64,
    colour: RGBColor,
}

const fn panel(
    tag: &'static str,
    title: &'static str,
    axis: &'static str,
    better: fn(f64, f64) -> f64,
    colour: RGBColor,
) -> Panel {
    Panel { tag, title, axis, better, colour }
}

const RETURN: Panel = panel("rollout/ep_rew_mean", "Return", "return per episode", f64::max, BLUE);
/// Panels of a task that goes forward.
const PANELS: [Panel; 3] = [
    RETURN,
    panel("rollout/distance_mean_m", "Distance", "distance per episode [m]", f64::max, GREEN),
    panel("rollout/velocity_mean_mps", "Velocity", "mean velocity [m/s]", f64::max, ORANGE),
];
/// Panels of a task that follows commands.
const COMMANDED_PANELS: [Panel; 3] = [
    RETURN,
    panel("eval/velocity_error", "Velocity error", "evaluated error [m/s]", f64::min, GREEN),
    panel("eval/yaw_rate_error", "Yaw rate error", "evaluated error [rad/s]", f64::min, ORANGE),
];

/// Why the learning curve cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum CurveError {
    /// The metrics cannot be read.
    #[error("cannot read the metrics in {path} for the learning curve")]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The plotter failed.
    #[error("cannot draw the learning curve to {path}: {why}")]
    Draw {
        /// Path of the file.
        path: PathBuf,
        /// Message of the plotter.
        why: String,
    },
    /// The image cannot be written.
    #[error("cannot write the learning curve to {path}")]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
}

/// Draws the learning curve of a run over environment steps, one panel below the other: return, distance and velocity,
/// or the errors of evaluations where the task has commands. A panel without points shows a note. The image replaces an
/// older one atomically.
pub fn draw_curve(metrics_jsonl: &Path, png: &Path) -> Result<(), CurveError> {
    let read = |source| CurveError::Read { path: metrics_jsonl.to_path_buf(), source };
    let curves = |panels| File::open(metrics_jsonl).and_then(|file| read_curves(file, panels)).map_err(read);
    let commanded = curves(&COMMANDED_PANELS)?;
    let (panels, curves) = match commanded[1].is_empty() {
        true => (&PANELS, curves(&PANELS)?),
        false => (&COMMANDED_PANELS, commanded),
    };

    let draw = |why: String| CurveError::Draw { path: png.to_path_buf(), why };
    let mut rgb = vec![0; 3 * SIZE.0 as usize * SIZE.1 as usize];
    draw_panels(panels, &curves, &mut rgb).map_err(|error| draw(error.to_string()))?;
    let bytes = encode_png(&rgb).map_err(|error| draw(error.to_string()))?;
    atomic_file::write(png, &bytes).map_err(|source| CurveError::Write { path: png.to_path_buf(), source })
}

fn encode_png(rgb: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIZE.0, SIZE.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(rgb)?;
    Ok(bytes)
}

/// Points (millions of steps, value) of each panel.
type Curves = [Vec<(f64, f64)>; PANELS.len()];

fn read_curves(file: File, panels: &[Panel; 3]) -> io::Result<Curves> {
    let mut curves = Curves::default();
    for_each_metric(file, |metric, _| {
        let point = (metric.step as f64 / 1e6, metric.value);
        if let Some(panel) = panels.iter().position(|panel| panel.tag == metric.tag)
            && point.0 <= DRAWABLE_MAX
            && point.1.abs() <= DRAWABLE_MAX
        {
            curves[panel].push(point);
        }
        Ok(())
    })?;
    Ok(curves)
}

type DrawError<'a> = DrawingAreaErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>;
type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

fn draw_panels<'a>(panels: &[Panel; 3], curves: &Curves, rgb: &'a mut [u8]) -> Result<(), DrawError<'a>> {
    // The font is embedded, because a machine without a screen often has none. If registering it failed, drawing text
    // would return an error.
    let _ = register_font(FONT, FontStyle::Normal, dejavu::sans::regular());
    let area = BitMapBackend::with_buffer(rgb, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let million_steps_max = curves.iter().flatten().map(|point| point.0).fold(0.0, f64::max);
    let million_steps = 0.0..if million_steps_max > 0.0 { million_steps_max } else { 1.0 };
    for ((panel, points), area) in panels.iter().zip(curves).zip(area.split_evenly((panels.len(), 1))) {
        draw_panel(panel, points, million_steps.clone(), &area)?;
    }
    area.present()
}

fn draw_panel<'a>(
    panel: &Panel,
    points: &[(f64, f64)],
    million_steps: Range<f64>,
    area: &Area<'a>,
) -> Result<(), DrawError<'a>> {
    let values = value_range(points);
    let (steps_span, values_span) = (million_steps.end - million_steps.start, values.end - values.start);
    let middle = ((million_steps.start + million_steps.end) / 2.0, (values.start + values.end) / 2.0);

    let mut chart = ChartBuilder::on(area)
        .caption(caption(panel, points), font(26).color(&TITLE))
        .margin(16)
        .margin_right(36)
        .x_label_area_size(58)
        .y_label_area_size(100)
        .build_cartesian_2d(million_steps, values)?;
    chart
        .configure_mesh()
        .max_light_lines(1)
        .bold_line_style(GRID)
        .light_line_style(WHITE)
        .axis_style(LABEL)
        .label_style(font(18).color(&LABEL))
        .axis_desc_style(font(20).color(&TITLE))
        .x_labels(11)
        .y_labels(7)
        .x_label_formatter(&|steps| axis_label(*steps, steps_span) + " M")
        .y_label_formatter(&|value| axis_label(*value, values_span))
        .x_desc("environment steps")
        .y_desc(panel.axis)
        .draw()?;

    if points.is_empty() {
        let style = font(22).color(&LABEL).pos(Pos::new(HPos::Center, VPos::Center));
        chart.draw_series([Text::new(format!("no points of {} yet", panel.tag), middle, style)])?;
    }
    chart.draw_series(LineSeries::new(points.iter().copied(), panel.colour.stroke_width(3)))?;
    if points.len() <= DOTS_MAX {
        chart.draw_series(points.iter().map(|point| Circle::new(*point, 5, panel.colour.filled())))?;
    }
    Ok(())
}

fn caption(panel: &Panel, points: &[(f64, f64)]) -> String {
    match (points.last(), points.iter().map(|point| point.1).reduce(panel.better)) {
        (Some(last), Some(best)) => {
            format!("{}: last {}, best {}", panel.title, format_number(last.1), format_number(best))
        }
        _ => panel.title.to_string(),
    }
}

/// Returns the range of the vertical axis: all points and a margin, also for a single point or a constant.
fn value_range(points: &[(f64, f64)]) -> Range<f64> {
    if points.is_empty() {
        return 0.0..1.0;
    }
    let (low, high) = points
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| (low.min(point.1), high.max(point.1)));
    let size = low.abs().max(high.abs());
    let span = high - low;
    let margin = if span > size * 1e-6 { span * 0.06 } else { (size * 0.1).max(1e-3) };
    low - margin..high + margin
}

/// Formats a label with as many decimals as neighbouring labels on an axis of this span need, without trailing zeros.
fn axis_label(value: f64, span: f64) -> String {
    let decimals = (1.0 - span.log10().floor()).clamp(0.0, 9.0);
    let label = format!("{value:.*}", decimals as usize);
    let label = if label.contains('.') { label.trim_end_matches('0').trim_end_matches('.') } else { &label };
    if label == "-0" { "0".to_string() } else { label.to_string() }
}

fn font(size: u32) -> FontDesc<'static> {
    (FONT, size).into_font()
}
