//! Learning curves of a sweep as a PNG: for each setting the mean of its runs, in a band from the least to the greatest.

use std::fs::File;
use std::path::{Path, PathBuf};

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use treadmill_runtime::atomic_file;

use super::CurveError;
use super::curve::{BLUE, HEADER_HEIGHT, PANEL_HEIGHT, TITLE, axes, encode_png, painted, value_range};
use super::curve_marks::{Area, DrawError, LABEL, SCALE, WIDTH, font, scaled};
use super::curve_points::{CurvePoint, CurvePoints};

/// Tag of the second panel.
const RETURN: &str = "rollout/ep_rew_mean";
/// Points of a band.
const BAND_POINTS: usize = 120;
/// Most characters of a caption.
const CAPTION_CHARS_MAX: usize = 90;
const GREY: RGBColor = RGBColor(170, 170, 170);
/// Opacity of a band.
const OPACITY: f64 = 0.15;

/// Runs of one setting.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweptCurve {
    /// Its keys; empty if there is one setting.
    pub name: String,
    /// Curves: each the logs of runs that followed each other, with the last step of each log.
    pub lines: Vec<Vec<(PathBuf, u64)>>,
}

/// What the trials of a sweep reached of its goal, against what they cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GoalCost {
    /// Goal in words.
    pub goal: String,
    /// For each trial that reached something: environment steps of all trials up to it, in millions, and what it reached.
    pub trials: Vec<(f64, f64)>,
    /// The same for the best so far.
    pub best: Vec<(f64, f64)>,
}

/// Steps in millions, with the mean, the least and the greatest value of several curves.
type Band = Vec<(f64, [f64; 3])>;

/// Draws the curves of a metric and of the return, with the best setting, which is the first, in colour; and the goal
/// against its cost. The image replaces an older one atomically.
///
/// # Errors
/// If the image cannot be drawn or written. Logs that cannot be read are left out.
pub fn draw_sweep(
    title: &str,
    curves: &[SweptCurve],
    tag: &str,
    cost: &GoalCost,
    png: &Path,
) -> Result<(), CurveError> {
    let tags = if tag == RETURN { vec![RETURN] } else { vec![tag, RETURN] };
    let bands: Vec<Vec<Band>> = curves.iter().map(|curve| bands(curve, &tags)).collect();
    let panel_count = tags.len() + 1;
    let size = (WIDTH, HEADER_HEIGHT + PANEL_HEIGHT * panel_count as u32);
    let rgb = painted(size, title, |panels| {
        let areas = panels.split_evenly((panel_count, 1));
        areas.iter().zip(&tags).enumerate().try_for_each(|(index, (area, tag))| {
            let of_tag: Vec<&Band> = bands.iter().map(|bands| &bands[index]).collect();
            let best = curves.first().map(|curve| curve.name.as_str()).filter(|name| !name.is_empty());
            draw_panel(tag, best, &of_tag, area)
        })?;
        draw_cost(cost, &areas[panel_count - 1])
    });
    let draw = |why: String| CurveError::Draw { path: png.to_path_buf(), why };
    let rgb = rgb.map_err(|error| draw(error.to_string()))?;
    let bytes = encode_png(&rgb, size).map_err(|error| draw(error.to_string()))?;
    atomic_file::write(png, &bytes).map_err(|source| CurveError::Write { path: png.to_path_buf(), source })
}

fn draw_panel(tag: &str, best: Option<&str>, bands: &[&Band], area: &Area<'_>) -> Result<(), DrawError> {
    let all: Vec<CurvePoint> = bands
        .iter()
        .flat_map(|band| band.iter())
        .flat_map(|(step, values)| values.map(|value| (*step, value)))
        .collect();
    let most = all.iter().map(|point| point.0).fold(0.0, f64::max);
    let (steps, values) = (0.0..if most > 0.0 { most } else { 1.0 }, value_range(&all, None, false));
    let middle = (steps.end / 2.0, (values.start + values.end) / 2.0);
    let mut chart = axes(area, steps, values, ["environment steps", tag])?;
    if all.is_empty() {
        let style = font(22).color(&LABEL).pos(Pos::new(HPos::Center, VPos::Center));
        chart.draw_series([Text::new(format!("no points of {tag}"), middle, style)])?;
    }
    // The best one comes last, above the others.
    for (number, band) in bands.iter().enumerate().rev() {
        let (colour, width) = if number == 0 { (BLUE, 3) } else { (GREY, 1) };
        let upper = band.iter().map(|(step, [_, _, most])| (*step, *most));
        let lower = band.iter().rev().map(|(step, [_, least, _])| (*step, *least));
        let outline: Vec<CurvePoint> = upper.chain(lower).collect();
        if outline.len() > 2 {
            chart.draw_series([Polygon::new(outline, colour.mix(OPACITY).filled())])?;
        }
        let mean = band.iter().map(|(step, [mean, ..])| (*step, *mean));
        chart.draw_series(LineSeries::new(mean, colour.stroke_width(width * SCALE)))?;
    }
    let caption = match best {
        Some(best) => format!("{tag}: in colour {best}"),
        None => format!("{tag}: mean and range of the runs"),
    };
    draw_caption(&caption, area)
}

/// Draws the goal against its cost.
fn draw_cost(cost: &GoalCost, area: &Area<'_>) -> Result<(), DrawError> {
    let most = cost.trials.iter().map(|point| point.0).fold(0.0, f64::max);
    let steps = 0.0..if most > 0.0 { most } else { 1.0 };
    let mut chart =
        axes(area, steps, value_range(&cost.trials, None, false), ["environment steps of all trials", "goal"])?;
    let points = cost.trials.iter().map(|point| Circle::new(*point, 4 * SCALE as i32, LABEL.filled()));
    chart.draw_series(points)?;
    // The best so far holds until a trial is better.
    let held = cost.best.windows(2).flat_map(|pair| [pair[0], (pair[1].0, pair[0].1)]);
    let last = cost.best.last().map(|last| [*last, (most, last.1)]);
    chart.draw_series(LineSeries::new(held.chain(last.into_iter().flatten()), BLUE.stroke_width(3 * SCALE)))?;
    draw_caption(&format!("Each trial, and in colour the best so far: {}", cost.goal), area)
}

fn draw_caption(caption: &str, area: &Area<'_>) -> Result<(), DrawError> {
    let is_long = caption.chars().count() > CAPTION_CHARS_MAX;
    let shown: String = caption.chars().take(CAPTION_CHARS_MAX - usize::from(is_long)).collect();
    let caption = if is_long { shown + "…" } else { shown };
    let style = font(20).color(&TITLE).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(caption, scaled(24, 26), style))
}

/// Returns the band of each tag.
fn bands(curve: &SweptCurve, tags: &[&str]) -> Vec<Band> {
    let lines: Vec<Vec<Vec<CurvePoint>>> = curve.lines.iter().map(|logs| line(logs, tags)).collect();
    (0..tags.len()).map(|tag| band(&lines.iter().map(|series| &*series[tag]).collect::<Vec<_>>())).collect()
}

/// Returns the points of each tag over logs that follow each other.
fn line(logs: &[(PathBuf, u64)], tags: &[&str]) -> Vec<Vec<CurvePoint>> {
    let mut series = vec![Vec::new(); tags.len()];
    for (log, until) in logs {
        let found = File::open(log).and_then(|file| CurvePoints::read(file, tags)).unwrap_or_default();
        let until = *until as f64 / 1e6;
        for (all, points) in series.iter_mut().zip(found.series) {
            all.extend(points.into_iter().filter(|point| point.0 <= until));
        }
    }
    series
}

/// Returns mean, least and greatest value of curves, each over the steps that it has.
fn band(lines: &[&[CurvePoint]]) -> Band {
    let lines: Vec<&[CurvePoint]> = lines.iter().copied().filter(|line| !line.is_empty()).collect();
    let first = lines.iter().map(|line| line[0].0).fold(f64::INFINITY, f64::min);
    let last = lines.iter().map(|line| line[line.len() - 1].0).fold(f64::NEG_INFINITY, f64::max);
    if lines.is_empty() {
        return Vec::new();
    }
    let steps = (0..BAND_POINTS).map(|point| first + (last - first) * point as f64 / (BAND_POINTS - 1) as f64);
    let at = |step: f64| {
        let values: Vec<f64> = lines.iter().filter_map(|line| interpolated(line, step)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let range = values
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)]);
        (!values.is_empty()).then_some((step, [mean, range[0], range[1]]))
    };
    steps.filter_map(at).collect()
}

/// Returns the value of a curve at a step, if it has that.
fn interpolated(line: &[CurvePoint], step: f64) -> Option<f64> {
    let next = line.partition_point(|point| point.0 < step);
    let (to_step, to) = *line.get(next).or(line.last().filter(|last| step - last.0 < 1e-9))?;
    match next.checked_sub(1).map(|before| line[before]) {
        Some((from_step, from)) if to_step > from_step => {
            Some(from + (to - from) * ((step - from_step) / (to_step - from_step)).clamp(0.0, 1.0))
        }
        Some(_) => Some(to),
        None => (step >= to_step).then_some(to),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_has_the_mean_and_the_ends_of_the_curves_that_are_there() {
        let (short, long) = ([(0.0, 1.0), (1.0, 3.0)], [(0.0, 3.0), (2.0, 7.0)]);
        let found = band(&[&short, &long]);
        assert_eq!((found.len(), found[0]), (BAND_POINTS, (0.0, [2.0, 1.0, 3.0])));
        let (step, [mean, least, most]) = found[BAND_POINTS - 1];
        assert_eq!((step, mean, least, most), (2.0, 7.0, 7.0, 7.0));
        let (step, [mean, least, most]) = found[30];
        assert!((mean - (1.0 + 2.0 * step + 3.0 + 2.0 * step) / 2.0).abs() < 1e-9 && least < mean && mean < most);
        assert!(band(&[]).is_empty() && band(&[&[]]).is_empty());
    }

    #[test]
    fn logs_that_follow_each_other_make_one_curve_and_the_image_depends_on_them() {
        let folder = tempfile::tempdir().unwrap();
        let log = |name: &str, first: u64, factor: f64| {
            let line = |step: u64| {
                let value = step as f64 * factor;
                format!(
                    "{{\"run\":\"r\",\"tag\":\"{RETURN}\",\"step\":{step},\"value\":{value},\"time_unix_s\":1.0}}\n"
                )
            };
            let path = folder.path().join(name);
            std::fs::write(&path, (first..first + 10).map(line).collect::<String>()).unwrap();
            path
        };
        let (one, two) = (log("one", 1, 1.0), log("two", 6, 2.0));
        let points = line(&[(one.clone(), 5), (two, u64::MAX)], &[RETURN]);
        assert_eq!(points[0].len(), 15);
        assert!(points[0].is_sorted_by(|a, b| a.0 < b.0), "{points:?}");
        let png = folder.path().join("sweep.png");
        let cost = GoalCost {
            goal: "highest return".to_string(),
            trials: vec![(1.0, 3.0), (2.0, 1.0), (3.0, 7.0)],
            best: vec![(1.0, 3.0), (3.0, 7.0)],
        };
        let draw = |curves: &[SweptCurve], tag: &str| {
            draw_sweep("runs/S", curves, tag, &cost, &png).unwrap();
            std::fs::read(&png).unwrap()
        };
        let curve = |name: &str| SweptCurve { name: name.to_string(), lines: vec![vec![(one.clone(), u64::MAX)]] };
        let alone = draw(&[curve("a")], RETURN);
        assert_ne!(alone, draw(&[curve("b")], RETURN));
        assert_ne!(alone, draw(&[], RETURN));
        let two_panels = draw(&[curve("a"), SweptCurve::default()], "rollout/distance_mean_m");
        let height = |png: &[u8]| u32::from_be_bytes(png[20..24].try_into().unwrap());
        assert_eq!((height(&alone), height(&two_panels)), (820, 1200));
        draw_sweep("runs/S", &[curve("a")], RETURN, &GoalCost::default(), &png).unwrap();
        assert_ne!(std::fs::read(&png).unwrap(), alone, "nothing was reached");
    }
}
