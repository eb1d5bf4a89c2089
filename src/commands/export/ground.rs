//! Generated ground as a file, which `treadmill_transfer --ground` puts under the robot.

use std::f64::consts::FRAC_PI_2;

use serde_json::json;
use treadmill_humanoid::Environment;

/// Returns heights, extent and the starts on the hardest level, in four directions on each kind of tile; `None` if the
/// ground is the model's own.
pub(super) fn json(environment: &Environment) -> Option<String> {
    let settings = &environment.config().ground;
    let field = environment.physics().model().ground.height_field.as_ref().filter(|_| !settings.kinds.is_empty())?;
    let range = |middle_m: f64, half_m: f64| [middle_m - half_m, middle_m + half_m];
    let rows: Vec<Vec<f32>> = field
        .heights_m
        .chunks_exact(field.columns)
        .map(|row| row.iter().map(|height_m| (field.centre_m.z + height_m) as f32).collect())
        .collect();
    let tiles = (0..settings.kinds.len()).map(|kind| settings.tile_centre_m(settings.levels - 1, kind));
    let starts: Vec<[f64; 4]> =
        tiles.flat_map(|[x_m, y_m]| (0..4).map(move |turn| [x_m, y_m, 0.0, f64::from(turn) * FRAC_PI_2])).collect();
    let file = json!({
        "x_m": range(field.centre_m.x, field.half_x_m),
        "y_m": range(field.centre_m.y, field.half_y_m),
        "heights_m": rows,
        "starts": starts,
    });
    Some(file.to_string())
}
