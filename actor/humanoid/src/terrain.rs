//! Heights of generated ground, see [`GroundConfig`].

use std::sync::{Arc, Mutex, PoisonError, Weak};

use nalgebra::Point3;

use crate::config::{ConfigError, GroundConfig, GroundKind};
use crate::error::ModelError;
use crate::model::{HEIGHT_FIELD_SIDE_MAX, HeightField};
use crate::randomisation::{stream, uniform};

/// Half of the side of the level place in the middle of a tile (m).
const PLATFORM_HALF_M: f64 = 0.75;
/// Depth of a stair's level part (m); the ground rises to the next one along a cell.
const TREAD_M: f64 = 0.3;
/// Side of a stone (m).
const STONE_M: f64 = 0.5;
/// Depth of the gaps between stones on the last level (m).
const GAP_DEPTH_MAX_M: f64 = 0.3;
/// Cells between two random heights of rough ground, which is linear between them.
const ROUGH_CELLS: usize = 2;

/// Fields in use, so that all environments of this process share them.
static FIELDS_IN_USE: Mutex<Vec<(GroundConfig, Weak<HeightField>)>> = Mutex::new(Vec::new());

/// Returns the height field of checked settings; the same one for the same settings while it is in use.
pub(crate) fn generated(settings: &GroundConfig) -> Result<Arc<HeightField>, ModelError> {
    let GroundConfig { curriculum, start_level, .. } = GroundConfig::default();
    let settings = GroundConfig { curriculum, start_level, ..settings.clone() };
    let mut in_use = FIELDS_IN_USE.lock().unwrap_or_else(PoisonError::into_inner);
    in_use.retain(|(_, field)| field.strong_count() > 0);
    if let Some(field) = in_use.iter().find(|(known, _)| *known == settings).and_then(|(_, field)| field.upgrade()) {
        return Ok(field);
    }
    let field = Arc::new(generate(&settings)?);
    in_use.push((settings, Arc::downgrade(&field)));
    Ok(field)
}

fn generate(settings: &GroundConfig) -> Result<HeightField, ModelError> {
    if settings.sides().into_iter().any(|side| side > HEIGHT_FIELD_SIDE_MAX) {
        let allowed = format!(
            "so small that the tiles and their border have at most {HEIGHT_FIELD_SIDE_MAX} heights along each side; take \
             smaller tiles, fewer levels or larger cells"
        );
        let (key, value) = ("ground.tile_m".to_owned(), settings.tile_m.to_string());
        return Err(ConfigError::Value { key, value, allowed }.into());
    }
    let ([rows, columns], [half_x_m, half_y_m]) = (settings.sides(), settings.halves_m());
    let (half, border) = (settings.half_tile_cells(), settings.border_cells());
    let mut heights_m = vec![0.0; rows * columns];
    for (column, kind) in settings.kinds.iter().enumerate() {
        for level in 0..settings.levels {
            let tile = Tile::new(settings, *kind, column, level);
            let (first_row, first_column) = (border + 2 * half * column, border + 2 * half * level as usize);
            // The rims of neighbours are the same heights.
            for (y, x) in (0..=2 * half).flat_map(|y| (0..=2 * half).map(move |x| (y, x))) {
                heights_m[(first_row + y) * columns + first_column + x] = tile.height_m(x, y);
            }
        }
    }
    let field = HeightField { rows, columns, half_x_m, half_y_m, centre_m: Point3::origin(), heights_m };
    field.check()?;
    Ok(field)
}

/// One tile; places are in cells from its corner of least x and y.
struct Tile {
    kind: GroundKind,
    cell_m: f64,
    half: usize,
    /// Half of the side of the level place in the middle.
    platform: usize,
    gradient: f64,
    step_m: f64,
    /// Depth of a stair with its riser, and number of stairs up to the top, which is as deep.
    stair: usize,
    stairs: usize,
    stone: usize,
    gap: usize,
    gap_depth_m: f64,
    /// Random heights, row by row: of the nodes of rough ground, or of the stones.
    random_m: Vec<f64>,
    /// Number of them in a row.
    width: usize,
}

impl Tile {
    fn new(settings: &GroundConfig, kind: GroundKind, column: usize, level: u32) -> Self {
        let (share, half) = (settings.difficulty(level), settings.half_tile_cells());
        let cells = |length_m: f64| (length_m / settings.cell_m).round() as usize;
        let (platform, stair) = ((PLATFORM_HALF_M / settings.cell_m).ceil() as usize, cells(TREAD_M).max(1) + 1);
        let (stone, gap) = (cells(STONE_M).max(1), cells(share * settings.stone_gap_max_m));
        let (largest_m, width) = match kind {
            GroundKind::Rough => (settings.rough_max_m, half * 2 / ROUGH_CELLS + 2),
            GroundKind::Stones => (settings.stone_height_max_m, half * 2 / (stone + gap) + 1),
            GroundKind::Flat | GroundKind::Slope | GroundKind::Stairs => (0.0, 0),
        };
        let number = (column as u64) << 32 | u64::from(level);
        let mut random = stream(settings.seed.rotate_left(16) ^ number, "ground");
        let random_m = (0..width * width).map(|_| share * uniform(&mut random, [-largest_m, largest_m])).collect();
        Self {
            kind,
            cell_m: settings.cell_m,
            half,
            platform,
            gradient: share * settings.slope_max,
            step_m: share * settings.step_max_m,
            stair,
            stairs: half.saturating_sub(platform + stair - 1) / (2 * stair),
            stone,
            gap,
            gap_depth_m: share * GAP_DEPTH_MAX_M,
            random_m,
            width,
        }
    }

    fn height_m(&self, x: usize, y: usize) -> f64 {
        // Squares around the middle: distance from the level place, and from the rim.
        let ring = x.abs_diff(self.half).max(y.abs_diff(self.half));
        let way = ring.saturating_sub(self.platform).min(self.half - ring);
        if way == 0 {
            return 0.0;
        }
        match self.kind {
            GroundKind::Flat => 0.0,
            GroundKind::Slope => self.gradient * (way as f64 * self.cell_m),
            GroundKind::Stairs => self.step_m * (way / self.stair).min(self.stairs) as f64,
            GroundKind::Rough => self.rough_m(x, y),
            GroundKind::Stones => self.stone_m(x, y),
        }
    }

    fn rough_m(&self, x: usize, y: usize) -> f64 {
        let ([column, row], [across, along]) = (
            [x, y].map(|place| place / ROUGH_CELLS),
            [x, y].map(|place| (place % ROUGH_CELLS) as f64 / ROUGH_CELLS as f64),
        );
        let between = |row: usize| {
            let of_row = &self.random_m[row * self.width + column..];
            of_row[0] + across * (of_row[1] - of_row[0])
        };
        let (near, far) = (between(row), between(row + 1));
        near + along * (far - near)
    }

    fn stone_m(&self, x: usize, y: usize) -> f64 {
        let period = self.stone + self.gap;
        let is_on_stone = [x, y].iter().all(|place| place % period <= self.stone);
        match is_on_stone {
            true => self.random_m[y / period * self.width + x / period],
            false => -self.gap_depth_m,
        }
    }
}
