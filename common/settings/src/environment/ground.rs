//! Settings of generated ground.

use crate::{choice, section};

/// Width of the level border around the tiles (m).
const BORDER_M: f64 = 4.0;

choice! {
    /// Kind of a tile of the ground.
    GroundKind {
        /// Level ground.
        Flat = "flat",
        /// Slope up to a crest around the middle, and down again.
        Slope = "slope",
        /// The same with stairs.
        Stairs = "stairs",
        /// Random heights.
        Rough = "rough",
        /// Stones with random heights and gaps between them.
        Stones = "stones",
    }
}

section! {
    /// Ground of the velocity task that code makes: square tiles, a column for each kind and a row for each level of
    /// difficulty.
    GroundConfig as "ground" {
        /// Kinds of tiles; none leaves the model's own ground. Slopes and stairs rise from the start in the tile's middle
        /// and fall towards its rim.
        kinds: Vec<GroundKind> = Vec::new(),
            "different names out of \"flat\", \"slope\", \"stairs\", \"rough\" and \"stones\""
            => |v| v.iter().enumerate().all(|(index, kind)| !v[..index].contains(kind));
        /// Levels of difficulty, from level ground to the largest values below.
        levels: u32 = 10, "1 to 20" => |v| (1..=20).contains(v);
        /// Side of a tile in metres; at most 1024 heights must fit along each side of the ground.
        tile_m: f64 = 8.0, "4 to 20" => |v| (4.0..=20.0).contains(v);
        /// Distance between two heights in metres.
        cell_m: f64 = 0.1, "0.05 to 0.5" => |v| (0.05..=0.5).contains(v);
        /// Largest gradient of the slopes.
        slope_max: f64 = 0.3, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Largest height of a stair in metres; stairs are 0.3 m deep, and rise along one cell.
        step_max_m: f64 = 0.1, "0 to 0.3" => |v| (0.0..=0.3).contains(v);
        /// Largest height and depth of rough ground in metres.
        rough_max_m: f64 = 0.05, "0 to 0.3" => |v| (0.0..=0.3).contains(v);
        /// Largest gap between two stones in metres; stones are 0.5 m wide, and gaps up to 0.3 m deep.
        stone_gap_max_m: f64 = 0.3, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Largest height and depth of a stone in metres.
        stone_height_max_m: f64 = 0.05, "0 to 0.3" => |v| (0.0..=0.3).contains(v);
        /// Seed of rough ground and stones.
        seed: u64 = 1, "0 to 9223372036854775807" => |v| *v <= i64::MAX as u64;
        /// Whether each environment's level rises and falls with success in training, and evaluation draws one for each
        /// episode. Otherwise it is always ground.start_level.
        curriculum: bool = true, "true or false" => |_| true;
        /// Level of the first episodes, from 0.
        start_level: u32 = 0, "0 to 19, below ground.levels" => |v| *v < 20;
    }
}

/// Tiles with a border around them: kinds follow each other along y, levels of difficulty along x. The border, the rims of
/// the tiles and the places to start in their middles are level.
impl GroundConfig {
    /// Returns half the cells along a side of a tile; a tile is rounded to twice a whole number of cells.
    #[must_use]
    pub fn half_tile_cells(&self) -> usize {
        (self.tile_m / (2.0 * self.cell_m)).round() as usize
    }

    /// Returns the cells along the border's width.
    #[must_use]
    pub fn border_cells(&self) -> usize {
        (BORDER_M / self.cell_m).ceil() as usize
    }

    /// Returns the number of heights along y and x.
    #[must_use]
    pub fn sides(&self) -> [usize; 2] {
        [self.kinds.len(), self.levels as usize]
            .map(|tiles| 2 * (tiles * self.half_tile_cells() + self.border_cells()) + 1)
    }

    /// Returns the half lengths along x and y (m).
    #[must_use]
    pub fn halves_m(&self) -> [f64; 2] {
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
}
