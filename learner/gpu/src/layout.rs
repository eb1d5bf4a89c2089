//! Where numbers lie in the GPU's memory, as offsets into its arrays; see `kernels.cu`.

use std::ops::Range;

use treadmill_policy::{NetworkLayer, NetworkStructure};

/// Threads that sum squares and terms, and sums of each, as in `kernels.cu`.
pub(crate) const SUMMERS: usize = 1024;
pub(crate) const SUMS: usize = 5;
/// Rows and columns of a tile of a product, as in `kernels.cu`.
pub(crate) const TILE: [usize; 2] = [8, 64];
/// Most partial gradients that a gradient is the sum of.
const SLICES_MAX: usize = 32;
/// Fewest rows of a partial gradient.
const SLICE_ROWS: usize = 64;
/// Numbers that a cache line holds; arrays begin at one.
const LINE: usize = 32;
/// Numbers for fields of launches.
const FIELDS: usize = 1 << 16;

/// Entries of the array of control numbers, as in `kernels.cu`.
#[derive(Clone, Copy, Debug)]
#[repr(usize)]
#[allow(dead_code, reason = "kernels.cu uses those that are not used here")]
pub(crate) enum Control {
    Start,
    KeptFirst,
    KeptSecond,
    LearningRate,
    MaxGradNorm,
    ClipRange,
    ValueCoefficient,
    EntropyCoefficient,
    BoundsCoefficient,
    BoundsLimit,
    Scale,
    StepSize,
    RootCorrection,
    Failure,
    Policy,
    Value,
    Bounds,
    Clipped,
    Entropy,
    Norm,
}

/// Number of [`Control`] numbers.
pub(crate) const CONTROLS: usize = Control::Norm as usize + 1;

/// Sizes that the arrays have room for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Room {
    /// Transitions of a batch.
    pub(crate) batch: usize,
    /// Rows of a gradient step.
    pub(crate) minibatch: usize,
    /// Rows that the divergence is measured on.
    pub(crate) measured: usize,
    /// Width of an observation.
    pub(crate) observation: usize,
    /// Length of the flat parameter vector.
    pub(crate) parameters: usize,
}

/// Outputs of a layer for the rows of a step, and the gradient by them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayerRows {
    pub(crate) rows: usize,
    pub(crate) gradient: usize,
}

/// Offsets into the array of numbers, unless stated.
#[derive(Clone, Debug)]
pub(crate) struct MemoryLayout {
    /// Parameters, then both moments of Adam; the first of all numbers.
    pub(crate) state: Range<usize>,
    /// Copy of it from before a pass; it follows.
    pub(crate) backup: Range<usize>,
    pub(crate) gradient: usize,
    /// Weights as the forward pass reads them.
    pub(crate) transposed: usize,
    pub(crate) slices: usize,
    pub(crate) inputs: usize,
    pub(crate) actions: usize,
    pub(crate) log_probs: usize,
    pub(crate) advantages: usize,
    pub(crate) returns: usize,
    pub(crate) old_means: usize,
    pub(crate) old_log_std: usize,
    pub(crate) gathered: usize,
    pub(crate) actor: Vec<LayerRows>,
    pub(crate) critic: Vec<LayerRows>,
    pub(crate) means: usize,
    pub(crate) by_means: usize,
    pub(crate) by_log_std: usize,
    pub(crate) terms: usize,
    /// Room that tiles at the edge of a matrix may read.
    #[allow(dead_code, reason = "nothing is written there")]
    pub(crate) end: usize,
    /// Length of the array of numbers.
    pub(crate) numbers: usize,
    /// Offsets into the array of integers: order of the rows, rows of the divergence, tables, fields of launches.
    pub(crate) order: usize,
    pub(crate) measured: usize,
    pub(crate) log_std: usize,
    pub(crate) joins: usize,
    pub(crate) splits: usize,
    pub(crate) fields: Range<usize>,
    /// Offsets into the array of control numbers.
    pub(crate) sums: usize,
    pub(crate) folded: usize,
    pub(crate) divergences: usize,
    /// Length of the array of control numbers.
    pub(crate) controls: usize,
}

/// Gives out consecutive parts of an array.
struct Taker(usize);

impl Taker {
    fn take(&mut self, count: usize) -> usize {
        let start = self.0;
        self.0 = start.saturating_add(count).next_multiple_of(LINE);
        start
    }
}

impl MemoryLayout {
    pub(crate) fn new(structure: &NetworkStructure, room: &Room) -> Self {
        let (actions, parameters) = (structure.log_std.len(), room.parameters);
        let rows = room.minibatch.max(room.measured);
        let mut numbers = Taker(0);
        let mut of = |count: usize, width: usize| numbers.take(count.saturating_mul(width));
        let (state, backup) = (of(3, parameters), of(3, parameters));
        let network = |layers: &[NetworkLayer], of: &mut dyn FnMut(usize, usize) -> usize| -> Vec<LayerRows> {
            let layer =
                |layer: &NetworkLayer| LayerRows { rows: of(rows, layer.output), gradient: of(rows, layer.output) };
            layers.iter().map(layer).collect()
        };
        let (actor, critic) = (network(&structure.actor, &mut of), network(&structure.critic, &mut of));
        let mut integers = Taker(0);
        let (order, measured) = (integers.take(room.batch), integers.take(room.measured));
        let (log_std, joins, splits) = (integers.take(actions), integers.take(4 * actions), integers.take(4 * actions));
        let fields = integers.take(FIELDS);
        let mut controls = Taker(0);
        controls.take(CONTROLS);
        let (sums, folded) = (controls.take(SUMS * SUMMERS), controls.take(SUMS * 32));
        let divergences = controls.take(room.measured);
        let widest = structure.actor.iter().chain(&structure.critic).map(|layer| layer.output).max().unwrap_or(0);
        Self {
            state: state..state + 3 * parameters,
            backup: backup..backup + 3 * parameters,
            gradient: of(1, parameters),
            transposed: of(1, parameters),
            slices: of(SLICES_MAX, parameters + actions),
            inputs: of(room.batch, room.observation),
            actions: of(room.batch, actions),
            log_probs: of(room.batch, 1),
            advantages: of(room.batch, 1),
            returns: of(room.batch, 1),
            old_means: of(room.measured, actions),
            old_log_std: of(1, actions),
            gathered: of(rows, room.observation),
            means: of(rows, actions),
            by_means: of(rows, actions),
            by_log_std: of(rows, actions),
            terms: of(rows, SUMS - 1),
            end: of(TILE[0], widest.max(room.observation) + TILE[1]),
            actor,
            critic,
            numbers: numbers.0,
            order,
            measured,
            log_std,
            joins,
            splits,
            fields: fields..fields + FIELDS,
            sums,
            folded,
            divergences,
            controls: controls.0,
        }
    }

    /// Returns the memory of the arrays in bytes.
    pub(crate) fn bytes(&self) -> u64 {
        4 * (self.numbers as u64 + self.fields.end as u64) + 8 * self.controls as u64
    }
}

/// Returns the rows of a partial gradient, and the number of partial gradients.
pub(crate) fn slices(rows: usize) -> (usize, usize) {
    let slice = SLICE_ROWS.max(rows.div_ceil(SLICES_MAX));
    (slice, rows.div_ceil(slice))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partial_gradients_cover_all_rows_and_stay_few() {
        for rows in [1, 63, 64, 65, 512, 767, 2048, 2049, 16_384, 4_194_304] {
            let (slice, count) = slices(rows);
            assert!(
                count <= SLICES_MAX && slice * count >= rows && slice * (count - 1) < rows,
                "{rows}: {slice} {count}"
            );
        }
    }

    #[test]
    fn control_numbers_are_those_of_the_kernels() {
        let source = include_str!("kernels.cu");
        let (_, rest) = source.split_once("enum {").unwrap();
        let (names, _) = rest.split_once('}').unwrap();
        let plain = |name: &str| name.replace('_', "").trim().to_lowercase();
        let names: Vec<_> = names.split(',').map(plain).collect();
        assert_eq!(names.len(), CONTROLS);
        for (control, name) in [
            (Control::Start, "start"),
            (Control::KeptSecond, "keptsecond"),
            (Control::BoundsLimit, "boundslimit"),
            (Control::Failure, "failure"),
            (Control::Norm, "norm"),
        ] {
            assert_eq!(names[control as usize], name);
            assert_eq!(format!("{control:?}").to_lowercase(), name);
        }
    }
}
