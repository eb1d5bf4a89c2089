//! Settings of generated ground.

use super::refuse;
use crate::error::ModelError;
use crate::model::HEIGHT_FIELD_SIDE_MAX;

/// Width of the level border around the tiles (m).
const BORDER_M: f64 = 4.0;

/// Kind of a tile of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroundKind {
    /// Level ground.
    Flat,
    /// Slope up to a crest around the middle, and down again.
    Slope,
    /// The same with stairs.
    Stairs,
    /// Random heights.
    Rough,
    /// Stones with random heights and gaps between them.
    Stones,
}

impl GroundKind {
    /// All kinds, with their names.
    pub const ALL: [(&'static str, Self); 5] = [
        ("flat", Self::Flat),
        ("slope", Self::Slope),
        ("stairs", Self::Stairs),
        ("rough", Self::Rough),
        ("stones", Self::Stones),
    ];

    /// Returns the kind with a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(known, _)| *known == name).map(|(_, kind)| kind)
    }
}

/// Levels on which episodes start; levels count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartLevel {
    /// This level at first; then one for each kind, which rises and falls with the environment's success.
    Rising(u32),
    /// Always this level.
    Fixed(u32),
    /// A level that each episode draws.
    Drawn,
}

/// Generated ground: square tiles with a border around them. Kinds follow each other along y, levels of difficulty
/// along x. The border, the rims of the tiles and the places to start in their middles are level.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundSettings {
    /// Kinds of tiles; none leaves the model's ground.
    pub kinds: Vec<GroundKind>,
    /// Number of levels, from level ground to the largest values below.
    pub levels: u32,
    /// Side of a tile (m), which is rounded to twice a whole number of cells.
    pub tile_m: f64,
    /// Distance between two heights (m).
    pub cell_m: f64,
    /// Largest gradient of slopes.
    pub slope_max: f64,
    /// Largest height of a stair (m).
    pub step_max_m: f64,
    /// Largest height and depth of rough ground (m).
    pub rough_max_m: f64,
    /// Largest gap between two stones (m).
    pub stone_gap_max_m: f64,
    /// Largest height and depth of stones (m).
    pub stone_height_max_m: f64,
    /// Seed of rough ground and stones.
    pub seed: u64,
    /// Levels on which episodes start.
    pub start: StartLevel,
}

impl Default for GroundSettings {
    fn default() -> Self {
        Self {
            kinds: Vec::new(),
            levels: 10,
            tile_m: 8.0,
            cell_m: 0.1,
            slope_max: 0.3,
            step_max_m: 0.1,
            rough_max_m: 0.05,
            stone_gap_max_m: 0.3,
            stone_height_max_m: 0.05,
            seed: 1,
            start: StartLevel::Rising(0),
        }
    }
}

impl GroundSettings {
    /// Returns half the cells along a side of a tile.
    pub(crate) fn half_tile_cells(&self) -> usize {
        (self.tile_m / (2.0 * self.cell_m)).round() as usize
    }

    /// Returns the cells along the border's width.
    pub(crate) fn border_cells(&self) -> usize {
        (BORDER_M / self.cell_m).ceil() as usize
    }

    /// Returns the number of heights along y and x.
    pub(crate) fn sides(&self) -> [usize; 2] {
        [self.kinds.len(), self.levels as usize]
            .map(|tiles| 2 * (tiles * self.half_tile_cells() + self.border_cells()) + 1)
    }

    /// Returns the half lengths along x and y (m).
    pub(crate) fn halves_m(&self) -> [f64; 2] {
        let [rows, columns] = self.sides();
        [columns, rows].map(|count| (count - 1) as f64 / 2.0 * self.cell_m)
    }

    /// Returns x and y of the middle of a tile (m), which is where its episodes start.
    #[must_use]
    pub fn tile_centre_m(&self, level: u32, kind: usize) -> [f64; 2] {
        let tile_m = 2.0 * self.half_tile_cells() as f64 * self.cell_m;
        let place = |index: usize, count: usize| (index as f64 + 0.5 - count as f64 / 2.0) * tile_m;
        [place(level as usize, self.levels as usize), place(kind, self.kinds.len())]
    }

    /// Returns the share of the largest values that a level has: 0 for the first one, 1 for the last.
    #[must_use]
    pub fn difficulty(&self, level: u32) -> f64 {
        match self.levels {
            0 | 1 => 1.0,
            levels => f64::from(level) / f64::from(levels - 1),
        }
    }

    /// Rejects ground that cannot be made; `has_starts` says whether the task places its starts on tiles.
    pub(crate) fn check(&self, has_starts: bool) -> Result<(), ModelError> {
        if self.kinds.is_empty() {
            return Ok(());
        }
        if !has_starts {
            return refuse(
                "ground.kinds",
                &self.kinds,
                "empty, since only the velocity task starts on generated ground",
            );
        }
        for (setting, value, [min, max], expected) in [
            ("ground.levels", f64::from(self.levels), [1.0, 20.0], "1 to 20"),
            ("ground.tile_m", self.tile_m, [4.0, 20.0], "4 to 20"),
            ("ground.cell_m", self.cell_m, [0.05, 0.5], "0.05 to 0.5"),
            ("ground.slope_max", self.slope_max, [0.0, 1.0], "0 to 1"),
            ("ground.step_max_m", self.step_max_m, [0.0, 0.3], "0 to 0.3"),
            ("ground.rough_max_m", self.rough_max_m, [0.0, 0.3], "0 to 0.3"),
            ("ground.stone_gap_max_m", self.stone_gap_max_m, [0.0, 1.0], "0 to 1"),
            ("ground.stone_height_max_m", self.stone_height_max_m, [0.0, 0.3], "0 to 0.3"),
        ] {
            if !(min..=max).contains(&value) {
                return refuse(setting, &value, expected);
            }
        }
        if self.sides().into_iter().any(|side| side > HEIGHT_FIELD_SIDE_MAX) {
            let expected = "so small that the tiles and a border of 4 m have at most 1024 heights along each side; take \
                            smaller tiles, fewer levels or larger cells";
            return refuse("ground.tile_m", &self.tile_m, expected);
        }
        match self.start {
            StartLevel::Rising(level) | StartLevel::Fixed(level) if level >= self.levels => {
                refuse("ground.start_level", &level, "below ground.levels")
            }
            _ => Ok(()),
        }
    }
}
