//! Multilayer perceptron on plain slices: forward and backward pass over one chunk of rows, and evaluation of many.
//!
//! Hidden layers are ELU, the last layer is linear. With `Z = H Wᵀ + b` for each layer, the gradients are
//! `dW = dZᵀ H`, `db = Σ_rows dZ` and `dH = dZ W` (Rumelhart, Hinton & Williams 1986).

use std::{cell::RefCell, ops::Range};

use gemm::{Parallelism, gemm};
use rayon::{ThreadPool, prelude::*};

use crate::{
    Dense,
    elementwise::{add_bias, add_bias_elu, add_column_sums, elu_backward},
};

/// Rows that are processed together, so that the activations of one layer stay in the second-level cache.
pub const CHUNK_ROWS: usize = 256;

/// Network whose parameters are a part of the flat vector.
#[derive(Clone, Debug)]
pub struct Mlp {
    range: Range<usize>,
    /// Layers, with offsets relative to `range.start`.
    layers: Vec<Dense>,
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
    /// Gradient by the input of a layer.
    below: Vec<f32>,
}

thread_local! {
    /// Tape of this thread's evaluations, so that an actor allocates nothing in a control step.
    static TAPE: RefCell<Tape> = RefCell::default();
}

impl Mlp {
    /// Returns the network of these layers, which follow each other in the flat vector.
    pub fn new(layers: Vec<Dense>) -> Self {
        let start = layers.first().map_or(0, |layer| layer.offset);
        let end = layers.last().map_or(start, |layer| layer.bias().end);
        let layers = layers.into_iter().map(|layer| Dense { offset: layer.offset - start, ..layer }).collect();
        Self { range: start..end, layers }
    }

    /// Returns its part of the flat parameter vector.
    pub fn range(&self) -> Range<usize> {
        self.range.clone()
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

    /// Fills the tape's input from the given rows of `plane`, `[S, columns]`. The network sees the first columns.
    pub fn gather(&self, plane: &[f32], columns: usize, rows: impl Iterator<Item = usize>, tape: &mut Tape) {
        tape.input.clear();
        rows.for_each(|row| tape.input.extend_from_slice(&plane[row * columns..][..self.input()]));
    }

    /// Computes the tape's output from its input. `flat` is the whole parameter vector.
    pub fn forward(&self, flat: &[f32], tape: &mut Tape) {
        let parameters = &flat[self.range()];
        let (last, hidden) = self.layers.split_last().expect("a network has at least one layer");
        let rows = tape.input.len() / self.input();
        tape.activations.resize(rows * hidden.iter().map(|layer| layer.output).sum::<usize>(), 0.0);
        tape.output.resize(rows * last.output, 0.0);
        let (mut input, mut activations) = (&tape.input[..], &mut tape.activations[..]);
        for layer in hidden {
            let (current, rest) = activations.split_at_mut(rows * layer.output);
            linear(layer, parameters, input, current);
            add_bias_elu(current, &parameters[layer.bias()]);
            (input, activations) = (current, rest);
        }
        linear(last, parameters, input, &mut tape.output);
        add_bias(&mut tape.output, &parameters[last.bias()]);
    }

    /// Computes the gradient of the parameters, which is as long as [`Self::range`]. The tape holds the forward pass and the
    /// gradient by its output. With `accumulate` the result is added to `gradient`, otherwise it replaces it.
    pub fn backward(&self, flat: &[f32], tape: &mut Tape, gradient: &mut [f32], accumulate: bool) {
        let parameters = &flat[self.range()];
        let Tape { input, activations, gradient: above, below, .. } = tape;
        let rows = input.len() / self.input();
        let mut end = activations.len();
        for (i, layer) in self.layers.iter().enumerate().rev() {
            let bias_gradient = &mut gradient[layer.bias()];
            if !accumulate {
                bias_gradient.fill(0.0);
            }
            if i + 1 == self.layers.len() {
                add_column_sums(above, bias_gradient);
            } else {
                let start = end - rows * layer.output;
                elu_backward(above, &activations[start..end], bias_gradient);
                end = start;
            }
            let seen = if i == 0 { &input[..] } else { &activations[end - rows * layer.input..end] };
            let above_rows = Matrix::row_major(above, layer.output);
            let seen = Matrix::row_major(seen, layer.input);
            let sizes = [layer.output, layer.input, rows];
            multiply(sizes, above_rows.transposed(), seen, &mut gradient[layer.weight()], accumulate);
            if i > 0 {
                below.resize(rows * layer.input, 0.0);
                let weight = Matrix::row_major(&parameters[layer.weight()], layer.input);
                multiply([rows, layer.input, layer.output], above_rows, weight, below, false);
                std::mem::swap(above, below);
            }
        }
    }

    /// Evaluates the network for every row of `plane`, `[rows, columns]`, into `output`, `[rows, output]`. The threads of
    /// `pool` share the rows, with the same results.
    pub fn evaluate(&self, flat: &[f32], plane: &[f32], columns: usize, output: &mut [f32], pool: Option<&ThreadPool>) {
        let chunk = |(rows, output): (&[f32], &mut [f32])| {
            TAPE.with_borrow_mut(|tape| {
                self.gather(rows, columns, 0..rows.len() / columns, tape);
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

/// Computes `output = input Wᵀ` for one layer.
fn linear(layer: &Dense, parameters: &[f32], input: &[f32], output: &mut [f32]) {
    let weight = Matrix::row_major(&parameters[layer.weight()], layer.input).transposed();
    let rows = output.len() / layer.output;
    multiply([rows, layer.output, layer.input], Matrix::row_major(input, layer.input), weight, output, false);
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

    fn transposed(self) -> Self {
        Self { data: self.data, row_stride: self.column_stride, column_stride: self.row_stride }
    }

    /// Returns whether all of `rows × columns` is inside the data.
    fn covers(&self, rows: usize, columns: usize) -> bool {
        rows == 0 || columns == 0 || (rows - 1) * self.row_stride + (columns - 1) * self.column_stride < self.data.len()
    }
}

/// Computes `product = left · right`, or `product += left · right`: `[m, k] · [k, n]` into row-major `[m, n]`.
fn multiply([m, n, k]: [usize; 3], left: Matrix, right: Matrix, product: &mut [f32], accumulate: bool) {
    assert!(left.covers(m, k) && right.covers(k, n) && product.len() == m * n, "matrix sizes do not fit");
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
            n as isize,
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
