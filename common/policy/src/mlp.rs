//! Multilayer perceptron on plain slices: forward and backward pass over one chunk of rows, and evaluation of many.
//!
//! Hidden layers are ELU, the last layer is linear. With `Z = H Wᵀ + b` for each layer, the gradients are
//! `dW = dZᵀ H`, `db = Σ_rows dZ` and `dH = dZ W` (Rumelhart, Hinton & Williams 1986).

use std::{borrow::Cow, cell::RefCell, ops::Range};

use rayon::{ThreadPool, prelude::*};

use crate::{
    Dense,
    elementwise::{
        add_bias, add_bias_elu, add_bias_elu_to_halves, add_column_sums, elu_backward, elu_backward_from_halves,
    },
    matrix::{Matrix, multiply, transpose},
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
    /// First even and first odd part that the network sees.
    pub(crate) seen: [usize; 2],
    /// Parts of an output.
    pub(crate) output: Parts,
}

/// Parameters of one network as [`Mlp::forward`] reads them, see [`Mlp::prepare`].
#[derive(Clone, Debug, Default)]
pub struct ForwardWeights(Vec<f32>);

/// Numbers of one network over one chunk of rows: what the forward pass leaves for the backward pass.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    /// Outputs of the hidden layers, one layer after the other.
    activations: Vec<f32>,
    /// Output of the forward pass, `[rows, output]`.
    output: Vec<f32>,
    /// Gradient by the output of a layer. This and `below` change places; they only grow, so that they are not filled before
    /// each use.
    above: Vec<f32>,
    /// Gradient by the input of a layer, or even and odd parts of rows.
    below: Vec<f32>,
}

impl Tape {
    /// Returns the output of the forward pass, and where the backward pass finds the gradient of the loss by it; both are
    /// `[rows, output]`.
    pub fn output_and_gradient(&mut self) -> (&[f32], &mut [f32]) {
        let gradient = room(&mut self.above, self.output.len());
        (&self.output, gradient)
    }
}

/// Returns the first numbers of a buffer, which grows if it is shorter.
fn room(buffer: &mut Vec<f32>, count: usize) -> &mut [f32] {
    if buffer.len() < count {
        buffer.resize(count, 0.0);
    }
    &mut buffer[..count]
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

    /// Returns `plane`, `[S, columns]`, as [`Self::forward`] reads it: as even and odd parts if the network is equivariant.
    /// Actor and critic read the same.
    pub fn inputs<'a>(&self, plane: &'a [f32]) -> Cow<'a, [f32]> {
        let Some(reflection) = &self.reflection else { return Cow::Borrowed(plane) };
        let mut parts = vec![0.0; plane.len()];
        reflection.observation.split(plane, &mut parts);
        Cow::Owned(parts)
    }

    /// Writes the network's part of the parameter vector `flat` as [`Self::forward`] reads it: each block is
    /// `[input, output]`, so that a product need not reorder it for every chunk of rows.
    pub fn prepare(&self, flat: &[f32], prepared: &mut ForwardWeights) {
        let (parameters, ForwardWeights(prepared)) = (&flat[self.range()], prepared);
        prepared.resize(parameters.len(), 0.0);
        for layer in &self.layers {
            prepared[layer.bias.clone()].copy_from_slice(&parameters[layer.bias.clone()]);
            for block in &layer.blocks {
                let weight = &parameters[block.weight.clone()];
                transpose(weight, block.input.len(), &mut prepared[block.weight.clone()]);
            }
        }
    }

    /// Computes the tape's output from `inputs`, `[rows, columns]`, with what [`Self::prepare`] wrote.
    pub fn forward(&self, ForwardWeights(prepared): &ForwardWeights, inputs: &[f32], columns: usize, tape: &mut Tape) {
        let Tape { activations, output, below, .. } = tape;
        let (last, hidden) = self.layers.split_last().expect("a network has at least one layer");
        let rows = inputs.len() / columns;
        activations.resize(rows * hidden.iter().map(|layer| layer.output).sum::<usize>(), 0.0);
        output.resize(rows * last.output, 0.0);
        let (mut source, mut activations) = (self.first_source(inputs, columns), &mut activations[..]);
        for layer in hidden {
            let (current, rest) = activations.split_at_mut(rows * layer.output);
            layer.forward(prepared, &source, current);
            let bias = &prepared[layer.bias.clone()];
            match self.reflection {
                None => add_bias_elu(current, bias),
                Some(_) => add_bias_elu_to_halves(current, bias),
            }
            (source, activations) = (Source::of(current, layer), rest);
        }
        last.forward(prepared, &source, output);
        add_bias(output, last.output, &prepared[last.bias.clone()]);
        if let Some(reflection) = &self.reflection {
            let parts = room(below, output.len());
            parts.copy_from_slice(output);
            reflection.output.join(parts, output);
        }
    }

    /// Returns what the first layer reads.
    fn first_source<'a>(&self, rows: &'a [f32], columns: usize) -> Source<'a> {
        Source { rows, columns, starts: self.first_columns() }
    }

    /// Returns the first column that each block of the first layer reads.
    pub(crate) fn first_columns(&self) -> [usize; 2] {
        self.reflection.as_ref().map_or([0; 2], |reflection| reflection.seen)
    }

    /// Computes the gradient of the parameters, which is as long as [`Self::range`]. The tape holds the forward pass of
    /// `inputs` and the gradient by its output. With `accumulate` the result is added to `gradient`, otherwise it replaces
    /// it. `flat` is the whole parameter vector.
    pub fn backward(
        &self,
        flat: &[f32],
        inputs: &[f32],
        columns: usize,
        tape: &mut Tape,
        gradient: &mut [f32],
        accumulate: bool,
    ) {
        let parameters = &flat[self.range()];
        let Tape { activations, output, above, below } = tape;
        let rows = inputs.len() / columns;
        if let Some(reflection) = &self.reflection {
            reflection.output.split(&above[..output.len()], room(below, output.len()));
            std::mem::swap(above, below);
        }
        let mut end = activations.len();
        for (i, layer) in self.layers.iter().enumerate().rev() {
            let bias_gradient = &mut gradient[layer.bias.clone()];
            if !accumulate {
                bias_gradient.fill(0.0);
            }
            let current = &mut above[..rows * layer.output];
            if i + 1 == self.layers.len() {
                add_column_sums(current, layer.output, bias_gradient);
            } else {
                let start = end - rows * layer.output;
                let activation = &activations[start..end];
                match self.reflection {
                    None => elu_backward(current, activation, bias_gradient),
                    Some(_) => elu_backward_from_halves(current, activation, bias_gradient),
                }
                end = start;
            }
            let source = match i {
                0 => self.first_source(inputs, columns),
                _ => Source::of(&activations[end - rows * layer.input..end], &self.layers[i - 1]),
            };
            let above_rows = Matrix::row_major(current, layer.output);
            for (number, block) in layer.blocks.iter().enumerate() {
                let sizes = [block.output.len(), block.input.len(), rows];
                let left = above_rows.skip_columns(block.output.start).transposed();
                let weight = &mut gradient[block.weight.clone()];
                multiply(sizes, left, source.block(number), weight, block.input.len(), accumulate);
            }
            if i > 0 {
                let next = room(below, rows * layer.input);
                for block in &layer.blocks {
                    let weight = Matrix::row_major(&parameters[block.weight.clone()], block.input.len());
                    let sizes = [rows, block.input.len(), block.output.len()];
                    let left = above_rows.skip_columns(block.output.start);
                    multiply(sizes, left, weight, &mut next[block.input.start..], layer.input, false);
                }
                std::mem::swap(above, below);
            }
        }
    }

    /// Evaluates the network for every row of `plane`, `[rows, columns]`, into `output`, `[rows, output]`, with what
    /// [`Self::prepare`] wrote. The threads of `pool` share the rows, with the same results.
    pub fn evaluate(
        &self,
        prepared: &ForwardWeights,
        plane: &[f32],
        columns: usize,
        output: &mut [f32],
        pool: Option<&ThreadPool>,
    ) {
        let chunk = |(rows, output): (&[f32], &mut [f32])| {
            TAPE.with_borrow_mut(|tape| {
                match &self.reflection {
                    None => self.forward(prepared, rows, columns, tape),
                    Some(reflection) => {
                        let mut parts = std::mem::take(&mut tape.above);
                        let inputs = room(&mut parts, rows.len());
                        reflection.observation.split(rows, inputs);
                        self.forward(prepared, inputs, columns, tape);
                        tape.above = parts;
                    }
                }
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
    /// Computes `output = input Wᵀ`, from the transposed weight.
    fn forward(&self, prepared: &[f32], source: &Source, output: &mut [f32]) {
        let rows = output.len() / self.output;
        for (number, block) in self.blocks.iter().enumerate() {
            let weight = Matrix::row_major(&prepared[block.weight.clone()], block.output.len());
            let sizes = [rows, block.output.len(), block.input.len()];
            multiply(sizes, source.block(number), weight, &mut output[block.output.start..], self.output, false);
        }
    }
}

/// Rows that a layer reads.
struct Source<'a> {
    rows: &'a [f32],
    columns: usize,
    /// First column that each block reads.
    starts: [usize; 2],
}

impl<'a> Source<'a> {
    /// Returns the activations of a layer as the next one reads them.
    fn of(rows: &'a [f32], layer: &BlockLayer) -> Self {
        let mut starts = [0; 2];
        starts.iter_mut().zip(&layer.blocks).for_each(|(start, block)| *start = block.output.start);
        Self { rows, columns: layer.output, starts }
    }

    /// Returns what a block reads, and columns after it.
    fn block(&self, number: usize) -> Matrix<'a> {
        Matrix::row_major(self.rows, self.columns).skip_columns(self.starts[number])
    }
}

#[cfg(test)]
#[path = "mlp_tests.rs"]
mod tests;
