//! Return, distance, velocity and speed over environment steps.

use ratatui::{
    Frame,
    layout::{Constraint, Layout, Rect},
    symbols::Marker,
    text::Line,
    widgets::{Axis, Block, Chart, Dataset, GraphType, Paragraph},
};

use treadmill_proto::RunStatus;

use super::{
    figures::{known, number, short},
    pieces::Pieces,
    theme::{CURVE, QUIET, STRONG},
};
use crate::commands::status::{
    fleet::{BODY_ERROR, DISTANCE, DONE_SHARE, RETURN, Run, SPEED, VELOCITY, VELOCITY_ERROR, YAW_RATE_ERROR},
    history::Curve,
};

/// Smallest width with a chart of velocity.
const WIDE: u16 = 120;

/// Draws the charts side by side.
pub fn draw(frame: &mut Frame, area: Rect, run: &Run) {
    let status = &run.status;
    let is_wide = area.width >= WIDE;
    let [first, second] = if let Some([done, error]) = imitated(status) {
        [(DONE_SHARE, format!("done {done} of the motion")), (BODY_ERROR, format!("error {error} m"))]
    } else if status.has_commands {
        let [velocity, yaw_rate] = errors(status);
        [(VELOCITY_ERROR, format!("error {velocity} m/s")), (YAW_RATE_ERROR, format!("error {yaw_rate} rad/s"))]
    } else {
        let (metres, mps) = (known(status.distance_mean_m), known(status.velocity_mean_mps));
        let distance = if is_wide { format!("distance {metres} m") } else { format!("{metres} m at {mps} m/s") };
        [(DISTANCE, distance), (VELOCITY, format!("velocity {mps} m/s"))]
    };
    let mut charts = vec![
        (RETURN, format!("return {}", known(status.return_mean))),
        first,
        (SPEED, format!("{} steps/s", number(status.env_steps_per_s))),
    ];
    if is_wide {
        charts.insert(2, second);
    }
    let areas = Layout::horizontal(vec![Constraint::Fill(1); charts.len()]).spacing(1).split(area);
    for ((tag, title), area) in charts.into_iter().zip(areas.iter()) {
        curve(frame, *area, &run.curve(tag), title);
    }
}

/// Returns how a motion was done in the last evaluation, if the run imitates one.
fn imitated(status: &RunStatus) -> Option<[String; 2]> {
    Some([number(status.done_share?), number(status.body_error_m?)])
}

/// Returns the errors of the velocity and the yaw rate.
fn errors(status: &RunStatus) -> [String; 2] {
    [status.velocity_error_mps, status.yaw_rate_error_radps].map(known)
}

fn curve(frame: &mut Frame, area: Rect, curve: &Curve, title: String) {
    let block = Block::new().title(Line::styled(title, STRONG));
    let points: Vec<(f64, f64)> = curve.points().collect();
    let Some([x_bounds, y_bounds]) = bounds(&points) else {
        let nothing = Paragraph::new("nothing yet").style(QUIET);
        return frame.render_widget(nothing.block(block), area);
    };
    let axis = |bounds: [f64; 2], labels: [String; 2]| Axis::default().bounds(bounds).labels(labels).style(QUIET);
    let (first, last) = (points[0].0, points[points.len() - 1].0);
    let data = Dataset::default().marker(Marker::Braille).graph_type(GraphType::Line).style(CURVE).data(&points);
    let chart = Chart::new(vec![data])
        .block(block)
        .legend_position(None)
        .x_axis(axis(x_bounds, [first, last].map(|step| short(step as u64))))
        .y_axis(axis(y_bounds, y_bounds.map(number)));
    frame.render_widget(chart, area);
}

/// Returns the smallest ranges of steps and values that contain all points and are not empty.
fn bounds(points: &[(f64, f64)]) -> Option<[[f64; 2]; 2]> {
    let (first, last) = (points.first()?.0, points.last()?.0);
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    };
    let [low, high] = range(&mut points.iter().map(|(_, value)| *value));
    let widened = |low: f64, high: f64| {
        // Relative to the value, because a smaller difference could be lost in rounding.
        let least = (low.abs().max(high.abs()) * 1e-6).max(1e-6);
        if high - low < least { [low - least, high + least] } else { [low, high] }
    };
    Some([widened(first, last), widened(low, high)])
}

/// Draws the latest values in one line, for small terminals.
pub fn draw_line(frame: &mut Frame, area: Rect, run: &Run) {
    let status = &run.status;
    let mut pieces = Pieces::new(area.width);
    pieces.push(format!("return {}", known(status.return_mean)), STRONG);
    if let Some([done, error]) = imitated(status) {
        pieces.push(format!("{done} done, error {error} m"), STRONG);
    } else if status.has_commands {
        let [velocity, yaw_rate] = errors(status);
        pieces.push(format!("errors {velocity} m/s {yaw_rate} rad/s"), STRONG);
    } else {
        pieces.push(format!("{} m", known(status.distance_mean_m)), STRONG);
        pieces.push(format!("{} m/s", known(status.velocity_mean_mps)), STRONG);
    }
    pieces.push(format!("{} steps long", known(status.length_mean)), QUIET);
    frame.render_widget(pieces.line(), area);
}
