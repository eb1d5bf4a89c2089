//! Multilayer perceptron on plain slices: forward and backward pass over one chunk of rows, and evaluation of many.
//!
//! Hidden layers are ELU, the last layer is linear. With `Z = H Wᵀ + b` for each layer, the gradients are
//! `dW = dZᵀ H`, `db = Σ_rows dZ` and `dH = dZ W` (Rumelhart, Hinton & Williams 1986).

use std::{borrow::Cow, cell::RefCell, ops::Range};

use gemm::{Parallelism, gemm};
use rayon::{ThreadPool, prelude::*};

use crate::{
    Dense,
    elementwise::{
        add_bias, add_bias_elu, add_bias_elu_to_halves, add_column_sums, elu_backward, elu_backward_from_halves,
    },
    mirror::Parts,
};

/// Rows that are processed together, so that the activations of one layer stay in the second-level cache.
pub const CHUNK_ROWS: usize = 256;

/// Network whose parameters are a part of the flat vector.
#[derive(Clone, Debug)]
pub struct Mlp {
    range: Range<usize>,
    layers: Vec<BlockLayer>,
    /// Reflection that the network is equivariant to. Its layers map even and odd parts, see [`crate::Networks`].
    reflection: Option<Reflected>,
}

/// Layer whose weight consists of blocks: one in dense networks, an even and an odd one in equivariant networks.
#[derive(Clone, Debug)]
pub(crate) struct BlockLayer {
    pub(crate) input: usize,
    pub(crate) output: usize,
    pub(crate) blocks: Vec<Block>,
    /// Bias of the first outputs, relative to the network's range.
    pub(crate) bias: Range<usize>,
}

/// Block of a layer's weight.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    /// Inputs that it maps.
    pub(crate) input: Range<usize>,
    /// Outputs that it maps to.
    pub(crate) output: Range<usize>,
    /// Weights, `[output, input]`, relative to the network's range.
    pub(crate) weight: Range<usize>,
}

/// Even and odd parts of what an equivariant network reads and writes.
#[derive(Clone, Debug)]
pub(crate) struct Reflected {
    /// Parts of a whole observation.
    pub(crate) observation: Parts,
    /// Parts that the network sees.
    pub(crate) seen: [Range<usize>; 2],
    /// Parts of an output.
    pub(crate) output: Parts,
}

/// Numbers of one network over one chunk of rows: what the forward pass leaves for the backward pass.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    /// What the network sees, `[rows, input]`.
    input: Vec<f32>,
    /// Outputs of the hidden layers, one layer after the other.
    activations: Vec<f32>,
    /// Output of the forward pass, `[rows, output]`.
    pub output: Vec<f32>,
    /// Gradient of the loss by the output, `[rows, output]`; the backward pass takes it and leaves other numbers.
    pub gradient: Vec<f32>,
    /// Gradient by the input of a layer, or even and odd parts of rows.
    below: Vec<f32>,
}

thread_local! {
    /// Tape of this thread's evaluations, so that an actor allocates nothing in a control step.
    static TAPE: RefCell<Tape> = RefCell::default();
}

impl Mlp {
    /// Returns the dense network of these layers, which follow each other in the flat vector.
    pub fn new(layers: Vec<Dense>) -> Self {
        let start = layers.first().map_or(0, |layer| layer.offset);
        let end = layers.last().map_or(start, |layer| layer.bias().end);
        let layer = |layer: Dense| {
            let Dense { input, output, offset } = layer;
            let layer = Dense { offset: offset - start, ..layer };
            let block = Block { input: 0..input, output: 0..output, weight: layer.weight() };
            BlockLayer { input, output, blocks: vec![block], bias: layer.bias() }
        };
        Self { range: start..end, layers: layers.into_iter().map(layer).collect(), reflection: None }
    }

    /// Returns an equivariant network.
    pub(crate) fn equivariant(range: Range<usize>, layers: Vec<BlockLayer>, reflection: Reflected) -> Self {
        Self { range, layers, reflection: Some(reflection) }
    }

    /// Returns its part of the flat parameter vector.
    pub fn range(&self) -> Range<usize> {
        self.range.clone()
    }

    pub(crate) fn layers(&self) -> &[BlockLayer] {
        &self.layers
    }

    /// Returns the width of the input.
    pub fn input(&self) -> usize {
        self.layers.first().map_or(0, |layer| layer.input)
    }

    /// Returns the width of the output.
    pub fn output(&self) -> usize {
        self.layers.last().map_or(0, |layer| layer.output)
    }

    /// Returns the numbers that a tape holds for each row, about.
    pub fn tape_width(&self) -> usize {
        self.layers.iter().map(|layer| layer.input + 2 * layer.output).sum()
    }

    /// Returns `plane`, `[S, columns]`, as [`Self::gather`] reads it: as even and odd parts if the network is equivariant.
    /// Actor and critic read the same.
    pub fn inputs<'a>(&self, plane: &'a [f32]) -> Cow<'a, [f32]> {
        let Some(reflection) = &self.reflection else { return Cow::Borrowed(plane) };
        let mut parts = Vec::with_capacity(plane.len());
        reflection.observation.split(plane, &mut parts);
        Cow::Owned(parts)
    }

    /// Fills the tape's input from the given rows of [`Self::inputs`], `[S, columns]`.
    pub fn gather(&self, inputs: &[f32], columns: usize, rows: impl Iterator<Item = usize>, tape: &mut Tape) {
        tape.input.clear();
        match &self.reflection {
            None => rows.for_each(|row| tape.input.extend_from_slice(&inputs[row * columns..][..self.input()])),
            Some(Reflected { seen: [even, odd], .. }) => rows.for_each(|row| {
                let row = &inputs[row * columns..][..columns];
                tape.input.extend_from_slice(&row[even.clone()]);
                tape.input.extend_from_slice(&row[odd.clone()]);
            }),
        }
    }

    /// Computes the tape's output from its input. `flat` is the whole parameter vector.
    pub fn forward(&self, flat: &[f32], tape: &mut Tape) {
        let parameters = &flat[self.range()];
        let Tape { input, activations, output, below, .. } = tape;
        let (last, hidden) = self.layers.split_last().expect("a network has at least one layer");
        let rows = input.len() / self.input();
        activations.resize(rows * hidden.iter().map(|layer| layer.output).sum::<usize>(), 0.0);
        output.resize(rows * last.output, 0.0);
        let (mut input, mut activations) = (&input[..], &mut activations[..]);
        for layer in hidden {
            let (current, rest) = activations.split_at_mut(rows * layer.output);
            layer.forward(parameters, input, current);
            let bias = &parameters[layer.bias.clone()];
            match self.reflection {
                None => add_bias_elu(current, bias),
                Some(_) => add_bias_elu_to_halves(current, bias),
            }
            (input, activations) = (current, rest);
        }
        last.forward(parameters, input, output);
        add_bias(output, last.output, &parameters[last.bias.clone()]);
        if let Some(reflection) = &self.reflection {
            below.clone_from(output);
            reflection.output.join(below, output);
        }
    }

    /// Computes the gradient of the parameters, which is as long as [`Self::range`]. The tape holds the forward pass and the
    /// gradient by its output. With `accumulate` the result is added to `gradient`, otherwise it replaces it.
    pub fn backward(&self, flat: &[f32], tape: &mut Tape, gradient: &mut [f32], accumulate: bool) {
        let parameters = &flat[self.range()];
        let Tape { input, activations, gradient: above, below, .. } = tape;
        let rows = input.len() / self.input();
        if let Some(reflection) = &self.reflection {
            reflection.output.split(above, below);
            std::mem::swap(above, below);
        }
        let mut end = activations.len();
        for (i, layer) in self.layers.iter().enumerate().rev() {
            let bias_gradient = &mut gradient[layer.bias.clone()];
            if !accumulate {
                bias_gradient.fill(0.0);
            }
            if i + 1 == self.layers.len() {
                add_column_sums(above, layer.output, bias_gradient);
            } else {
                let start = end - rows * layer.output;
                let activation = &activations[start..end];
                match self.reflection {
                    None => elu_backward(above, activation, bias_gradient),
                    Some(_) => elu_backward_from_halves(above, activation, bias_gradient),
                }
                end = start;
            }
            let seen = if i == 0 { &input[..] } else { &activations[end - rows * layer.input..end] };
            let seen = Matrix::row_major(seen, layer.input);
            let above_rows = Matrix::row_major(above, layer.output);
            for block in &layer.blocks {
                let sizes = [block.output.len(), block.input.len(), rows];
                let left = above_rows.skip_columns(block.output.start).transposed();
                let weight = &mut gradient[block.weight.clone()];
                multiply(sizes, left, seen.skip_columns(block.input.start), weight, block.input.len(), accumulate);
            }
            if i > 0 {
                below.resize(rows * layer.input, 0.0);
                for block in &layer.blocks {
                    let weight = Matrix::row_major(&parameters[block.weight.clone()], block.input.len());
                    let sizes = [rows, block.input.len(), block.output.len()];
                    let left = above_rows.skip_columns(block.output.start);
                    multiply(sizes, left, weight, &mut below[block.input.start..], layer.input, false);
                }
                std::mem::swap(above, below);
            }
        }
    }

    /// Evaluates the network for every row of `plane`, `[rows, columns]`, into `output`, `[rows, output]`. The threads of
    /// `pool` share the rows, with the same results.
    pub fn evaluate(&self, flat: &[f32], plane: &[f32], columns: usize, output: &mut [f32], pool: Option<&ThreadPool>) {
        let chunk = |(rows, output): (&[f32], &mut [f32])| {
            TAPE.with_borrow_mut(|tape| {
                let count = rows.len() / columns;
                match &self.reflection {
                    None => self.gather(rows, columns, 0..count, tape),
                    Some(reflection) => {
                        let mut parts = std::mem::take(&mut tape.below);
                        reflection.observation.split(rows, &mut parts);
                        self.gather(&parts, columns, 0..count, tape);
                        tape.below = parts;
                    }
                }
                self.forward(flat, tape);
                output.copy_from_slice(&tape.output);
            });
        };
        let (input_size, output_size) = (CHUNK_ROWS * columns, CHUNK_ROWS * self.output());
        match pool {
            Some(pool) => pool.install(|| {
                plane.par_chunks(input_size).zip(output.par_chunks_mut(output_size)).for_each(chunk);
            }),
            None => plane.chunks(input_size).zip(output.chunks_mut(output_size)).for_each(chunk),
        }
    }
}

impl BlockLayer {
    /// Computes `output = input Wᵀ`.
    fn forward(&self, parameters: &[f32], input: &[f32], output: &mut [f32]) {
        let rows = output.len() / self.output;
        for block in &self.blocks {
            let weight = Matrix::row_major(&parameters[block.weight.clone()], block.input.len()).transposed();
            let input = Matrix::row_major(input, self.input).skip_columns(block.input.start);
            let sizes = [rows, block.output.len(), block.input.len()];
            multiply(sizes, input, weight, &mut output[block.output.start..], self.output, false);
        }
    }
}

/// View of a matrix: element `(i, j)` is at `i · row_stride + j · column_stride`.
#[derive(Clone, Copy)]
struct Matrix<'a> {
    data: &'a [f32],
    row_stride: usize,
    column_stride: usize,
}

impl<'a> Matrix<'a> {
    fn row_major(data: &'a [f32], columns: usize) -> Self {
        Self { data, row_stride: columns, column_stride: 1 }
    }

    /// Returns the matrix without its first columns.
    fn skip_columns(self, column: usize) -> Self {
        Self { data: &self.data[column.min(self.data.len())..], ..self }
    }

    fn transposed(self) -> Self {
        Self { data: self.data, row_stride: self.column_stride, column_stride: self.row_stride }
    }

    /// Returns whether all of `rows × columns` is inside the data.
    fn covers(&self, rows: usize, columns: usize) -> bool {
        rows == 0 || columns == 0 || (rows - 1) * self.row_stride + (columns - 1) * self.column_stride < self.data.len()
    }
}

/// Computes `product = left · right`, or `product += left · right`: `[m, k] · [k, n]` into `[m, n]`, whose rows begin every
/// `stride` numbers.
fn multiply([m, n, k]: [usize; 3], left: Matrix, right: Matrix, product: &mut [f32], stride: usize, accumulate: bool) {
    if m == 0 || n == 0 {
        return;
    }
    let reach = (m - 1) * stride + n;
    assert!(left.covers(m, k) && right.covers(k, n) && product.len() >= reach, "matrix sizes do not fit");
    if k == 0 {
        let rows = product.chunks_mut(stride).take(if accumulate { 0 } else { m });
        return rows.for_each(|row| row[..n].fill(0.0));
    }
    let kept = if accumulate { 1.0 } else { 0.0 };
    // SAFETY: by the assertion, sizes and strides reach only indices inside the three slices, and the mutable slice cannot
    // overlap the others.
    unsafe {
        gemm(
            m,
            n,
            k,
            product.as_mut_ptr(),
            1,
            stride as isize,
            accumulate,
            left.data.as_ptr(),
            left.column_stride as isize,
            left.row_stride as isize,
            right.data.as_ptr(),
            right.column_stride as isize,
            right.row_stride as isize,
            kept,
            1.0,
            false,
            false,
            false,
            Parallelism::None,
        );
    }
}

#[cfg(test)]
#[path = "mlp_tests.rs"]
mod tests;
