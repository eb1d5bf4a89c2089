//! Comma-separated poses, one in each line: Unitree's retargeting of LAFAN1 and what has its columns.

use super::{MotionError, ROOT};

/// Reads lines of root position, root quaternion x, y, z, w, and hinge angles; returns the frames with the quaternion as w,
/// x, y, z.
pub(super) fn read(text: &str, hinges: usize) -> Result<Vec<f64>, MotionError> {
    let fail = |problem: String| Err(MotionError(problem));
    let width = ROOT + hinges;
    let mut frames = Vec::new();
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    for (number, line) in lines.filter(|(_, line)| !line.is_empty()) {
        let entries: Vec<&str> = line.split(',').map(str::trim).collect();
        if frames.is_empty() && entries[0].parse::<f64>().is_err() {
            return fail(header(&entries));
        }
        if entries.len() != width {
            return fail(format!(
                "line {number} has {} columns; this robot with {hinges} hinges needs {width}: root position x, y, z, root \
                 quaternion x, y, z, w, and one angle per hinge",
                entries.len()
            ));
        }
        let start = frames.len();
        for (column, entry) in entries.iter().enumerate() {
            match entry.parse::<f64>() {
                Ok(value) if value.is_finite() => frames.push(value),
                _ => return fail(format!("line {number}, column {}: `{entry}` is not a finite number", column + 1)),
            }
        }
        // x, y, z, w to w, x, y, z.
        frames[start + 3..start + ROOT].rotate_right(1);
    }
    if frames.is_empty() { fail("it is empty".to_owned()) } else { Ok(frames) }
}

/// Returns what a file with a header is, and what converts it.
fn header(names: &[&str]) -> String {
    let has = |part: &str| names.iter().any(|name| name.to_lowercase().contains(part));
    if has("frame") && (has("root_translate") || has("translatex")) {
        return "it is a CSV of BONES-SEED, with centimetres, degrees and a column of frames; convert it to metres, radians and \
                quaternions, without header, for example by GMR (github.com/YanjieZe/GMR)"
            .to_owned();
    }
    let first = names[0].chars().take(40).collect::<String>();
    format!(
        "its first line is a header (`{first}`); expected are lines of numbers alone: root position x, y, z (m), root \
         quaternion x, y, z, w, and one angle per hinge (rad), in the robot's order"
    )
}
