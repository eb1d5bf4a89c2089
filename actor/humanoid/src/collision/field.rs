//! Height field for contact queries.

use std::sync::{Arc, Mutex, PoisonError, Weak};

use nalgebra::Vector3;
use rapier3d::parry::shape::{HeightField as Triangles, HeightFieldFlags};
use rapier3d::parry::utils::Array2;

use crate::model::HeightField;

/// Least side of a block (m).
const BLOCK_MIN_M: f64 = 0.5;
/// Most blocks along a side.
const BLOCKS_MAX: f64 = 256.0;

/// Fields in use, so that all worlds over one ground share them.
static FIELDS_IN_USE: Mutex<Vec<(Weak<HeightField>, Weak<FieldShape>)>> = Mutex::new(Vec::new());

/// Triangles of a height field, and how high it is in places.
pub(super) struct FieldShape {
    pub(super) triangles: Triangles,
    heights: Arc<HeightField>,
    /// Height of the highest point (m, world).
    highest_m: f64,
    /// Corner of least x and y (m, world).
    corner_m: [f64; 2],
    /// Side of a block (m). A shape with a greater radius is compared with the highest point of all.
    block_m: f64,
    /// Number of blocks along x and y.
    blocks: [usize; 2],
    /// Height of the highest point of each block and the eight around it (m, world).
    highest_near_m: Vec<f64>,
}

impl FieldShape {
    /// Returns the shape of a field, the same one for the same field while it is in use.
    pub(super) fn of(field: &Arc<HeightField>) -> Arc<Self> {
        let mut in_use = FIELDS_IN_USE.lock().unwrap_or_else(PoisonError::into_inner);
        in_use.retain(|(_, shape)| shape.strong_count() > 0);
        let same = |known: &Weak<HeightField>| std::ptr::eq(known.as_ptr(), Arc::as_ptr(field));
        if let Some(shape) = in_use.iter().find(|(known, _)| same(known)).and_then(|(_, shape)| shape.upgrade()) {
            return shape;
        }
        let shape = Arc::new(Self::new(field));
        in_use.push((Arc::downgrade(field), Arc::downgrade(&shape)));
        shape
    }

    fn new(field: &Arc<HeightField>) -> Self {
        let corner_m = [field.centre_m.x - field.half_x_m, field.centre_m.y - field.half_y_m];
        let block_m = BLOCK_MIN_M.max(2.0 * field.half_x_m.max(field.half_y_m) / BLOCKS_MAX);
        let blocks = [field.half_x_m, field.half_y_m].map(|half_m| (2.0 * half_m / block_m).ceil().max(1.0) as usize);
        let steps_m =
            [2.0 * field.half_x_m / (field.columns - 1) as f64, 2.0 * field.half_y_m / (field.rows - 1) as f64];
        let mut highest_m = vec![f64::NEG_INFINITY; blocks[0] * blocks[1]];
        for (index, height_m) in field.heights_m.iter().enumerate() {
            // A height belongs to all blocks which the cells around it touch, and to the blocks around those.
            let place = [index % field.columns, index / field.columns];
            let [columns, rows] = [0, 1].map(|axis| {
                let at_m = place[axis] as f64 * steps_m[axis];
                let first = ((at_m - steps_m[axis]) / block_m).floor() - 1.0;
                let last = ((at_m + steps_m[axis]) / block_m).floor() + 1.0;
                first.max(0.0) as usize..=(last as usize).min(blocks[axis] - 1)
            });
            for row in rows {
                for block in &mut highest_m[row * blocks[0]..][columns.clone()] {
                    *block = block.max(*height_m + field.centre_m.z);
                }
            }
        }
        Self {
            triangles: triangles(field),
            heights: field.clone(),
            highest_m: highest_m.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            corner_m,
            block_m,
            blocks,
            highest_near_m: highest_m,
        }
    }

    /// Returns the height (m, world) and the upward unit normal of the ground at a place; `None` beyond the edges.
    pub(super) fn surface_at(&self, x_m: f64, y_m: f64) -> Option<(f64, Vector3<f64>)> {
        self.heights.surface_at(x_m, y_m)
    }

    /// Returns a height (m, world) which no ground exceeds within `radius_m` of a place.
    pub(super) fn highest_near_m(&self, x_m: f64, y_m: f64, radius_m: f64) -> f64 {
        if radius_m >= self.block_m {
            return self.highest_m;
        }
        // Beyond the edges the nearest block is still within the radius, if any ground is.
        let block = |at_m: f64, axis: usize| {
            let place = (at_m - self.corner_m[axis]) / self.block_m;
            (place.max(0.0) as usize).min(self.blocks[axis] - 1)
        };
        self.highest_near_m[block(y_m, 1) * self.blocks[0] + block(x_m, 0)]
    }
}

fn triangles(field: &HeightField) -> Triangles {
    // Rapier's rows run along z, which the rotation of the ground turns into −y.
    let mut heights = vec![0.0; field.rows * field.columns];
    for row in 0..field.rows {
        for column in 0..field.columns {
            heights[(field.rows - 1 - row) + column * field.rows] =
                field.heights_m[row * field.columns + column] as f32;
        }
    }
    let size = rapier3d::math::Vector::new(2.0 * field.half_x_m as f32, 1.0, 2.0 * field.half_y_m as f32);
    let heights = Array2::new(field.rows, field.columns, heights);
    Triangles::with_flags(heights, size, HeightFieldFlags::FIX_INTERNAL_EDGES)
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;

    #[test]
    fn no_ground_near_a_place_is_higher_than_the_bound() {
        let height_m = |x: f64, y: f64| 0.2 * (3.0 * x).sin() * (2.0 * y).cos() + 0.05 * x;
        let centre_m = Point3::new(1.0, -2.0, 0.3);
        for sides in [[31, 57], [4, 6]] {
            let field = Arc::new(HeightField::from_fn(sides, [3.0, 2.2], centre_m, height_m).unwrap());
            let shape = FieldShape::new(&field);
            let (mut lower, mut places) = (0, 0);
            for (x_m, y_m) in
                (-10..90).flat_map(|x| (-60..20).map(move |y| (-2.3 + 0.07 * f64::from(x), 0.07 * f64::from(y))))
            {
                let bound_m = shape.highest_near_m(x_m, y_m, 0.3);
                for (dx, dy) in [(0.0, 0.0), (0.3, 0.0), (0.0, -0.3), (-0.21, 0.21), (-0.3, 0.0)] {
                    let ground_m = field.height_at(x_m + dx, y_m + dy).unwrap_or(f64::NEG_INFINITY);
                    assert!(ground_m <= bound_m + 1e-12, "{x_m} {y_m}: {ground_m} above {bound_m}");
                }
                lower += usize::from(bound_m < shape.highest_m - 0.1);
                places += 1;
            }
            assert!(sides[0] < 9 || lower * 4 > places, "{lower} of {places} bounds are lower than the highest point");
            assert_eq!(shape.highest_near_m(0.0, 0.0, 0.6), shape.highest_m);
        }
    }
}
