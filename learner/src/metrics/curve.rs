//! Learning curve as a PNG, drawn from `metrics.jsonl`.

use std::fs::File;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use time::OffsetDateTime;
use treadmill_config::{ChosenTask, Config};
use treadmill_runtime::atomic_file;

use super::curve_marks::{Area, DrawError, FONT, Key, LABEL, SCALE, WIDTH, dashed, draw_legend, font, reduced, scaled};
use super::curve_points::{CurvePoint, CurvePoints};
use super::table::format_number;

/// Height of a panel, and of the line above them, in pixels.
pub(super) const PANEL_HEIGHT: u32 = 380;
pub(super) const HEADER_HEIGHT: u32 = 60;
/// Most points that are drawn as dots: a line alone would not show that there are few.
const DOTS_MAX: usize = 60;

pub(super) const TITLE: RGBColor = RGBColor(40, 40, 40);
const GRID: RGBColor = RGBColor(225, 225, 225);
pub(super) const BLUE: RGBColor = RGBColor(31, 119, 180);
const GREEN: RGBColor = RGBColor(44, 140, 60);
const ORANGE: RGBColor = RGBColor(200, 80, 30);
const PURPLE: RGBColor = RGBColor(120, 80, 160);

/// Plot of one quantity over environment steps.
struct Panel {
    /// Metric of the training, and that of evaluations; either may be missing.
    tags: [Option<&'static str>; 2],
    title: &'static str,
    axis: &'static str,
    /// Returns the better of two values.
    better: fn(f64, f64) -> f64,
    colour: RGBColor,
    /// Whether the axis begins at zero.
    from_zero: bool,
}

const RETURN: Panel = Panel {
    tags: [Some("rollout/ep_rew_mean"), Some("eval/mean_reward")],
    title: "Return",
    axis: "return per episode",
    better: f64::max,
    colour: BLUE,
    from_zero: false,
};
/// Panels of a task that goes forward.
const PANELS: [Panel; 3] = [
    RETURN,
    Panel {
        tags: [Some("rollout/distance_mean_m"), Some("eval/distance_mean_m")],
        title: "Distance",
        axis: "distance per episode [m]",
        colour: GREEN,
        from_zero: true,
        ..RETURN
    },
    Panel {
        tags: [Some("rollout/velocity_mean_mps"), Some("eval/velocity_mean_mps")],
        title: "Velocity",
        axis: "mean velocity [m/s]",
        colour: ORANGE,
        ..RETURN
    },
];
/// Panels of a task that follows commands; the second and the third are those of [`CurveFacts::standing_errors`].
const COMMANDED_PANELS: [Panel; 4] = [
    RETURN,
    Panel {
        tags: [None, Some("eval/velocity_error")],
        title: "Velocity error",
        axis: "error [m/s]",
        better: f64::min,
        colour: GREEN,
        from_zero: true,
    },
    Panel {
        tags: [None, Some("eval/yaw_rate_error")],
        title: "Yaw rate error",
        axis: "error [rad/s]",
        better: f64::min,
        colour: ORANGE,
        from_zero: true,
    },
    Panel {
        tags: [Some("rollout/fall_fraction"), Some("eval/fall_fraction")],
        title: "Falls",
        axis: "share of episodes",
        better: f64::min,
        colour: PURPLE,
        from_zero: true,
    },
];

/// What the curve shows of a run's configuration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveFacts {
    /// Task and robot.
    pub task: String,
    /// Velocity error (m/s) and yaw rate error (rad/s) of a robot that only stands, for a task with commands.
    pub standing_errors: Option<[f64; 2]>,
}

impl CurveFacts {
    /// Returns the facts of a configuration.
    #[must_use]
    pub fn of(config: &Config) -> Self {
        let robot = Some(&config.env.robot).filter(|robot| !robot.is_empty());
        let robot = robot.map(|robot| format!(" of {robot}")).unwrap_or_default();
        let (task, has_commands) = match config.env.chosen_task() {
            ChosenTask::HumanoidV5 => ("humanoid-v5", false),
            ChosenTask::HumanoidV4 => ("humanoid-v4", false),
            ChosenTask::Velocity => ("velocity", true),
            ChosenTask::Motion => ("motion", false),
            ChosenTask::External => (&*config.task.name, false),
            ChosenTask::Own(own) => (own, false),
        };
        let velocity = &config.velocity;
        Self {
            task: format!("task {task}{robot}"),
            standing_errors: has_commands.then(|| [velocity.mean_speed_mps(), velocity.mean_yaw_rate_radps()]),
        }
    }
}

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

/// Draws the learning curve of a run over environment steps, one panel below the other: return, distance and velocity, or
/// the errors of evaluations and falls where the task has commands. A panel without points shows a note. The image replaces
/// an older one atomically.
pub fn draw_curve(metrics_jsonl: &Path, facts: &CurveFacts, png: &Path) -> Result<(), CurveError> {
    let read = |source| CurveError::Read { path: metrics_jsonl.to_path_buf(), source };
    let points = |panels: &[Panel]| {
        let tags: Vec<&str> = panels.iter().flat_map(|panel| panel.tags.map(Option::unwrap_or_default)).collect();
        File::open(metrics_jsonl).and_then(|file| CurvePoints::read(file, &tags)).map_err(read)
    };
    let panels: &[Panel] = if facts.standing_errors.is_some() { &COMMANDED_PANELS } else { &PANELS };
    let image = Image { panels, facts, points: points(panels)? };
    let draw = |why: String| CurveError::Draw { path: png.to_path_buf(), why };
    let rgb = image.rgb().map_err(|error| draw(error.to_string()))?;
    let bytes = encode_png(&rgb, image.size()).map_err(|error| draw(error.to_string()))?;
    atomic_file::write(png, &bytes).map_err(|source| CurveError::Write { path: png.to_path_buf(), source })
}

pub(super) fn encode_png(rgb: &[u8], size: (u32, u32)) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.0, size.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(rgb)?;
    Ok(bytes)
}

/// Draws larger pixels, and returns their means: a header, and below it what `draw` draws.
pub(super) fn painted(
    size: (u32, u32),
    header: &str,
    draw: impl FnOnce(&Area<'_>) -> Result<(), DrawError>,
) -> Result<Vec<u8>, DrawError> {
    // The font is embedded, because a machine without a screen often has none. If registering it failed, drawing text
    // would return an error.
    let _ = register_font(FONT, FontStyle::Normal, dejavu::sans::regular());
    let size = (size.0 * SCALE, size.1 * SCALE);
    let mut large = vec![0; 3 * size.0 as usize * size.1 as usize];
    {
        let area = BitMapBackend::with_buffer(&mut large, size).into_drawing_area();
        area.fill(&WHITE)?;
        let (above, panels) = area.split_vertically(HEADER_HEIGHT * SCALE);
        let style = font(22).color(&TITLE).pos(Pos::new(HPos::Left, VPos::Center));
        above.draw(&Text::new(header, scaled(24, 36), style))?;
        draw(&panels)?;
        area.present()?;
    }
    Ok(reduced(&large, size.0 as usize))
}

/// Chart over millions of environment steps.
pub(super) type Chart<'a, 'b> = ChartContext<'a, BitMapBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws the axes of a panel.
pub(super) fn axes<'a, 'b>(
    area: &'a Area<'b>,
    steps: Range<f64>,
    values: Range<f64>,
    [x, y]: [&str; 2],
) -> Result<Chart<'a, 'b>, DrawError> {
    let (steps_span, values_span) = (steps.end, values.end - values.start);
    let mut chart = ChartBuilder::on(area)
        .margin(16 * SCALE)
        .margin_top(44 * SCALE)
        .margin_right(36 * SCALE)
        .x_label_area_size(58 * SCALE)
        .y_label_area_size(100 * SCALE)
        .build_cartesian_2d(steps, values)?;
    chart
        .configure_mesh()
        .max_light_lines(1)
        .bold_line_style(GRID.stroke_width(SCALE))
        .light_line_style(WHITE)
        .axis_style(LABEL.stroke_width(SCALE))
        .label_style(font(18).color(&LABEL))
        .axis_desc_style(font(20).color(&TITLE))
        .x_labels(11)
        .y_labels(7)
        .x_label_formatter(&|steps| if *steps == 0.0 { "0".into() } else { axis_label(*steps, steps_span) + " M" })
        .y_label_formatter(&|value| axis_label(*value, values_span))
        .x_desc(x)
        .y_desc(y)
        .draw()?;
    Ok(chart)
}

/// Image of a run.
struct Image<'a> {
    panels: &'a [Panel],
    facts: &'a CurveFacts,
    points: CurvePoints,
}

impl Image<'_> {
    /// Returns width and height in pixels.
    fn size(&self) -> (u32, u32) {
        (WIDTH, HEADER_HEIGHT + PANEL_HEIGHT * self.panels.len() as u32)
    }

    fn rgb(&self) -> Result<Vec<u8>, DrawError> {
        painted(self.size(), &self.header(), |panels| {
            let areas = panels.split_evenly((self.panels.len(), 1));
            areas.iter().enumerate().try_for_each(|(index, area)| self.draw_panel(index, area))
        })
    }

    /// Returns run, task, steps and day.
    fn header(&self) -> String {
        let CurvePoints { run, last_unix_s, resumed, .. } = &self.points;
        let resumed = match resumed {
            0 => String::new(),
            1 => ", resumed once".to_string(),
            times => format!(", resumed {times} times"),
        };
        let day = OffsetDateTime::from_unix_timestamp(*last_unix_s as i64).unwrap_or(OffsetDateTime::UNIX_EPOCH).date();
        match run.is_empty() {
            true => self.facts.task.clone(),
            false => format!("{run}: {}, until {day} UTC{resumed}", self.facts.task),
        }
    }

    fn draw_panel(&self, index: usize, area: &Area<'_>) -> Result<(), DrawError> {
        let panel = &self.panels[index];
        let [training, evaluated] = [0, 1].map(|kind| &*self.points.series[2 * index + kind]);
        let standing = self.facts.standing_errors.and_then(|errors| errors.get(index.checked_sub(1)?).copied());
        let all: Vec<CurvePoint> = training.iter().chain(evaluated).copied().collect();
        let most = self.points.series.iter().flatten().map(|point| point.0).fold(0.0, f64::max);
        let steps = 0.0..if most > 0.0 { most } else { 1.0 };
        let values = value_range(&all, standing.filter(|_| !all.is_empty()), panel.from_zero);
        let middle = (steps.end / 2.0, (values.start + values.end) / 2.0);
        let mut chart = axes(area, steps.clone(), values.clone(), ["environment steps", panel.axis])?;
        for resume in &self.points.resumes {
            chart.draw_series(dashed(&[(*resume, values.start), (*resume, values.end)], LABEL, 1))?;
        }
        if let Some(error) = standing.filter(|_| !all.is_empty()) {
            chart.draw_series(dashed(&[(0.0, error), (steps.end, error)], TITLE, 2))?;
        }
        if all.is_empty() {
            let style = font(22).color(&LABEL).pos(Pos::new(HPos::Center, VPos::Center));
            let tag = panel.tags.into_iter().flatten().next().unwrap_or_default();
            chart.draw_series([Text::new(format!("no points of {tag} yet"), middle, style)])?;
        }
        let line = |points: &[CurvePoint], width: u32| {
            LineSeries::new(points.to_vec(), panel.colour.stroke_width(width * SCALE))
        };
        if !training.is_empty() {
            chart.draw_series(line(training, 2))?;
        } else {
            chart.draw_series(line(evaluated, 2))?;
        }
        if training.len() <= DOTS_MAX {
            chart.draw_series(training.iter().map(|point| Circle::new(*point, 4 * SCALE, panel.colour.filled())))?;
        }
        for (radius, colour) in [(6, panel.colour), (4, WHITE)] {
            chart.draw_series(evaluated.iter().map(|point| Circle::new(*point, radius * SCALE, colour.filled())))?;
        }
        let shown = if evaluated.is_empty() { training } else { evaluated };
        let title = font(24).color(&TITLE).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(caption(panel, shown, !evaluated.is_empty()), scaled(24, 26), title))?;
        let legend = [
            (Key::Line, "training", !training.is_empty()),
            (Key::Ring, "evaluation", !evaluated.is_empty()),
            (Key::Dashes, "standing still", standing.is_some() && !all.is_empty()),
            (Key::Dashes, "resumed", !self.points.resumes.is_empty()),
        ];
        draw_legend(legend.into_iter().filter(|(.., is_shown)| *is_shown), panel.colour, area)
    }
}

fn caption(panel: &Panel, points: &[CurvePoint], are_evaluated: bool) -> String {
    let of = if are_evaluated && panel.tags[0].is_some() { "evaluated: " } else { "" };
    match (points.last(), points.iter().map(|point| point.1).reduce(panel.better)) {
        (Some(last), Some(best)) => {
            format!("{} ({of}last {}, best {})", panel.title, format_number(last.1), format_number(best))
        }
        _ => panel.title.to_string(),
    }
}

/// Returns the range of the vertical axis: all points, another value, and a margin, also for a single point or a constant.
pub(super) fn value_range(points: &[CurvePoint], other: Option<f64>, from_zero: bool) -> Range<f64> {
    if points.is_empty() {
        return 0.0..1.0;
    }
    let values = points.iter().map(|point| point.1).chain(other);
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let low = if from_zero { low.min(0.0) } else { low };
    let size = low.abs().max(high.abs());
    let span = high - low;
    let margin = if span > size * 1e-6 { span * 0.06 } else { (size * 0.1).max(1e-3) };
    let below = if from_zero && low == 0.0 { 0.0 } else { margin };
    low - below..high + margin
}

/// Formats a label with as many decimals as neighbouring labels on an axis of this span need, without trailing zeros.
fn axis_label(value: f64, span: f64) -> String {
    let decimals = (1.0 - span.log10().floor()).clamp(0.0, 9.0);
    let label = format!("{value:.*}", decimals as usize);
    let label = if label.contains('.') { label.trim_end_matches('0').trim_end_matches('.') } else { &label };
    if label == "-0" { "0".to_string() } else { label.to_string() }
}
