//! Forward and backward pass of one multilayer perceptron over one chunk of rows, on plain slices.
//!
//! Hidden layers are ELU, the last layer is linear. With `Z = H Wᵀ + b` for each layer, the gradients are
//! `dW = dZᵀ H`, `db = Σ_rows dZ` and `dH = dZ W` (Rumelhart, Hinton & Williams 1986).

use std::ops::Range;

use gemm::{Parallelism, gemm};

use super::Dense;
use super::elementwise::{add_bias, add_bias_elu, add_column_sums, elu_backward};

/// Network whose parameters are the part `range` of the flat vector.
#[derive(Debug)]
pub(super) struct Mlp {
    /// Its part of the flat vector.
    pub(super) range: Range<usize>,
    /// Layers, with offsets relative to `range.start`.
    layers: Vec<Dense>,
}

/// Memory for the gradients between layers, reused from chunk to chunk.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    above: Vec<f32>,
    below: Vec<f32>,
}

impl Mlp {
    pub(super) fn new(layers: Vec<Dense>) -> Self {
        let start = layers.first().map_or(0, |layer| layer.offset);
        let end = layers.last().map_or(start, |layer| layer.bias().end);
        let layers = layers.into_iter().map(|layer| Dense { offset: layer.offset - start, ..layer }).collect();
        Self { range: start..end, layers }
    }

    /// Returns the width of the input.
    pub(super) fn input(&self) -> usize {
        self.layers.first().map_or(0, |layer| layer.input)
    }

    /// Returns the width of the output.
    pub(super) fn output(&self) -> usize {
        self.layers.last().map_or(0, |layer| layer.output)
    }

    /// Returns the sum of the widths of the hidden layers.
    pub(super) fn hidden(&self) -> usize {
        let (_, hidden) = self.layers.split_last().expect("a network has at least one layer");
        hidden.iter().map(|layer| layer.output).sum()
    }

    /// Returns the numbers in memory for one partial gradient over chunks of `rows` rows: the gradient itself, and those
    /// between layers.
    pub(super) fn lane_numbers(&self, rows: usize) -> usize {
        let widest = self.layers.iter().map(|layer| layer.output).max().unwrap_or(0);
        self.range.len() + rows * (2 * widest + self.output())
    }

    /// Computes `output`, `[rows, output]`, from `input`, `[rows, input]`.
    ///
    /// `activations`, of length `rows · hidden`, receives the outputs of the hidden layers, one layer after the other.
    pub(super) fn forward(
        &self,
        parameters: &[f32],
        input: &[f32],
        rows: usize,
        mut activations: &mut [f32],
        output: &mut [f32],
    ) {
        let (last, hidden) = self.layers.split_last().expect("a network has at least one layer");
        let mut input = input;
        for layer in hidden {
            let (current, rest) = activations.split_at_mut(rows * layer.output);
            let weight = Matrix::row_major(&parameters[layer.weight()], layer.input).transposed();
            multiply([rows, layer.output, layer.input], Matrix::row_major(input, layer.input), weight, current, false);
            add_bias_elu(current, &parameters[layer.bias()]);
            (input, activations) = (current, rest);
        }
        let weight = Matrix::row_major(&parameters[last.weight()], last.input).transposed();
        multiply([rows, last.output, last.input], Matrix::row_major(input, last.input), weight, output, false);
        add_bias(output, &parameters[last.bias()]);
    }

    /// Computes the gradient of the parameters from that of the output, `[rows, output]`.
    ///
    /// `activations` are those of the forward pass over the same rows. With `accumulate` the result is added to `gradient`,
    /// otherwise it replaces it.
    #[expect(clippy::too_many_arguments, reason = "slices of different meaning")]
    pub(super) fn backward(
        &self,
        parameters: &[f32],
        input: &[f32],
        rows: usize,
        activations: &[f32],
        output_gradient: &[f32],
        scratch: &mut Scratch,
        gradient: &mut [f32],
        accumulate: bool,
    ) {
        let Scratch { above, below } = scratch;
        above.clear();
        above.extend_from_slice(output_gradient);
        let mut end = activations.len();
        for (i, layer) in self.layers.iter().enumerate().rev() {
            if !accumulate {
                gradient[layer.bias()].fill(0.0);
            }
            let bias_gradient = &mut gradient[layer.bias()];
            if i + 1 == self.layers.len() {
                add_column_sums(above, bias_gradient);
            } else {
                let start = end - rows * layer.output;
                elu_backward(above, &activations[start..end], bias_gradient);
                end = start;
            }
            let layer_input = if i == 0 { input } else { &activations[end - rows * layer.input..end] };
            multiply(
                [layer.output, layer.input, rows],
                Matrix::row_major(above, layer.output).transposed(),
                Matrix::row_major(layer_input, layer.input),
                &mut gradient[layer.weight()],
                accumulate,
            );
            if i > 0 {
                below.resize(rows * layer.input, 0.0);
                let weight = Matrix::row_major(&parameters[layer.weight()], layer.input);
                multiply(
                    [rows, layer.input, layer.output],
                    Matrix::row_major(above, layer.output),
                    weight,
                    below,
                    false,
                );
                std::mem::swap(above, below);
            }
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
pub(crate) mod tests {
    use super::*;
    use crate::NetworkShape;

    #[test]
    fn products_follow_the_strides() {
        let left = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let mut product = [0.0; 4];
        let left = Matrix::row_major(&left, 3);
        multiply([2, 2, 3], left, left.transposed(), &mut product, false);
        assert_eq!(product, [14.0, 32.0, 32.0, 77.0]);
        multiply([2, 2, 3], left, left.transposed(), &mut product, true);
        assert_eq!(product, [28.0, 64.0, 64.0, 154.0]);
    }

    #[test]
    #[should_panic(expected = "matrix sizes")]
    fn a_matrix_that_is_too_small_is_refused() {
        let data = [0.0; 5];
        multiply([2, 1, 3], Matrix::row_major(&data, 3), Matrix::row_major(&data, 1), &mut [0.0; 2], false);
    }

    /// Returns the output of a network for one row in f64, straight from the definition.
    pub(crate) fn exact_output(layers: &[Dense], parameters: &[f64], row: &[f64]) -> Vec<f64> {
        let mut row = row.to_vec();
        for (i, layer) in layers.iter().enumerate() {
            let (weight, bias) = (&parameters[layer.weight()], &parameters[layer.bias()]);
            row = (0..layer.output)
                .map(|o| bias[o] + (0..layer.input).map(|k| weight[o * layer.input + k] * row[k]).sum::<f64>())
                .map(|z| if i + 1 == layers.len() || z > 0.0 { z } else { z.exp_m1() })
                .collect();
        }
        row
    }

    /// Returns `Σ c · output` in f64.
    fn weighted_output(layers: &[Dense], parameters: &[f64], input: &[f64], weights: &[f64]) -> f64 {
        let outputs = input.chunks_exact(layers[0].input).flat_map(|row| exact_output(layers, parameters, row));
        outputs.zip(weights).map(|(o, w)| o * w).sum()
    }

    fn wave(count: usize, step: f64) -> Vec<f32> {
        (0..count).map(|i| ((i as f64 + 1.0) * step).sin() as f32).collect()
    }

    #[test]
    fn the_gradient_agrees_with_finite_differences() {
        for hidden in [vec![], vec![4], vec![5, 3]] {
            let shape = NetworkShape { observation: 3, action: 2, hidden, privileged: 0 };
            let layers = shape.actor();
            let mlp = Mlp::new(layers.clone());
            let rows = 7;
            let parameters = wave(mlp.range.len(), 0.7);
            let input = wave(rows * 3, 1.3);
            let output_gradient = wave(rows * 2, 2.1);
            let mut activations = vec![0.0; rows * mlp.hidden()];
            let mut output = vec![0.0; rows * 2];
            mlp.forward(&parameters, &input, rows, &mut activations, &mut output);
            let mut gradient = vec![f32::NAN; mlp.range.len()];
            let mut scratch = Scratch::default();
            let mut run = |gradient: &mut [f32], accumulate| {
                mlp.backward(
                    &parameters,
                    &input,
                    rows,
                    &activations,
                    &output_gradient,
                    &mut scratch,
                    gradient,
                    accumulate,
                )
            };
            run(&mut gradient, false);

            let wide = |numbers: &[f32]| numbers.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
            let (mut p, x, c) = (wide(&parameters), wide(&input), wide(&output_gradient));
            let value: f64 = wide(&output).iter().zip(&c).map(|(o, w)| o * w).sum();
            assert!((value - weighted_output(&layers, &p, &x, &c)).abs() < 1e-5);
            for i in 0..p.len() {
                let centre = p[i];
                p[i] = centre + 1e-6;
                let above = weighted_output(&layers, &p, &x, &c);
                p[i] = centre - 1e-6;
                let below = weighted_output(&layers, &p, &x, &c);
                p[i] = centre;
                let expected = (above - below) / 2e-6;
                assert!((f64::from(gradient[i]) - expected).abs() < 2e-5, "{i}: {} {expected}", gradient[i]);
            }

            let once = gradient.clone();
            run(&mut gradient, true);
            for (twice, once) in gradient.iter().zip(once) {
                assert!((twice - 2.0 * once).abs() < 1e-5);
            }
        }
    }
}
