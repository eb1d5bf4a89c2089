//! Networks on slices against finite differences in double precision. The tests of `treadmill-ppo` compare them with
//! Candle's automatic differentiation.

use super::*;
use crate::NetworkShape;

#[test]
fn products_follow_the_strides() {
    let left = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let mut product = [0.0; 4];
    let left = Matrix::row_major(&left, 3);
    multiply([2, 2, 3], left, left.transposed(), &mut product, 2, false);
    assert_eq!(product, [14.0, 32.0, 32.0, 77.0]);
    multiply([2, 2, 3], left, left.transposed(), &mut product, 2, true);
    assert_eq!(product, [28.0, 64.0, 64.0, 154.0]);
    // The last column of the left matrix and the last two of the product's three; no column gives zeros.
    let mut product = [9.0; 6];
    multiply([2, 2, 1], left.skip_columns(2), left.transposed().skip_columns(0), &mut product[1..], 3, false);
    assert_eq!(product, [9.0, 3.0, 12.0, 9.0, 6.0, 24.0]);
    multiply([2, 2, 0], left, left, &mut product[1..], 3, true);
    assert_eq!(product, [9.0, 3.0, 12.0, 9.0, 6.0, 24.0]);
    multiply([2, 2, 0], left, left, &mut product[1..], 3, false);
    assert_eq!(product, [9.0, 0.0, 0.0, 9.0, 0.0, 0.0]);
}

#[test]
#[should_panic(expected = "matrix sizes")]
fn a_matrix_that_is_too_small_is_refused() {
    let data = [0.0; 5];
    multiply([2, 1, 3], Matrix::row_major(&data, 3), Matrix::row_major(&data, 1), &mut [0.0; 2], 1, false);
}

fn wave(count: usize, step: f64) -> Vec<f32> {
    (0..count).map(|i| ((i as f64 + 1.0) * step).sin() as f32 * 0.6).collect()
}

/// Returns parameters that keep the outputs of wide layers near 1.
fn parameters(shape: &NetworkShape) -> Vec<f32> {
    let widest = shape.hidden.iter().copied().max().unwrap_or(1).max(shape.observation);
    let scale = (16.0 / widest as f32).sqrt().min(1.0);
    wave(shape.parameter_count(), 0.71).iter().map(|p| p * scale).collect()
}

/// Returns the networks of the presets, for the compact and Gymnasium's observation.
fn shapes_in_use() -> [NetworkShape; 2] {
    [(45, vec![256, 128]), (348, vec![512, 256])].map(|(observation, hidden)| NetworkShape {
        observation,
        action: 17,
        hidden,
        privileged: 0,
    })
}

/// Returns the actor and the critic.
fn networks(shape: &NetworkShape) -> [Vec<Dense>; 2] {
    [shape.actor(), shape.critic()]
}

/// Returns output and parameter gradient of `Σ c · output + output²`, with `c` different for every element.
fn on_slices(layers: &[Dense], flat: &[f32], observations: &[f32], columns: usize) -> [Vec<f32>; 2] {
    let mlp = Mlp::new(layers.to_vec());
    let mut tape = Tape::default();
    mlp.forward(&prepared(&mlp, flat), observations, columns, &mut tape);
    let (output, slopes) = tape.output_and_gradient();
    for ((slope, output), c) in slopes.iter_mut().zip(output).zip(wave(output.len(), 0.3)) {
        *slope = c + 2.0 * output;
    }
    let output = output.to_vec();
    let mut gradient = vec![f32::NAN; mlp.range().len()];
    mlp.backward(flat, observations, columns, &mut tape, &mut gradient, false);
    [output, gradient]
}

/// Returns the parameters of a network as its forward pass reads them.
fn prepared(mlp: &Mlp, flat: &[f32]) -> ForwardWeights {
    let mut prepared = ForwardWeights::default();
    mlp.prepare(flat, &mut prepared);
    prepared
}

/// Sets the gradient to that of half the squared output, and returns the output.
fn slope_is_output(tape: &mut Tape) -> Vec<f32> {
    let (output, gradient) = tape.output_and_gradient();
    gradient.copy_from_slice(output);
    output.to_vec()
}

/// Returns the output of a network for one row in f64, straight from the definition.
fn exact_output(layers: &[Dense], parameters: &[f64], row: &[f64]) -> Vec<f64> {
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

#[test]
fn the_gradient_agrees_with_finite_differences() {
    const ROWS: usize = 3;
    let small = [vec![], vec![4], vec![5, 3]];
    let small = small.map(|hidden| NetworkShape { observation: 3, action: 2, hidden, privileged: 0 });
    for shape in small.into_iter().chain(shapes_in_use()) {
        let (flat, observations) = (parameters(&shape), wave(ROWS * shape.observation, 1.37));
        let wide = |numbers: &[f32]| numbers.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
        let (mut p, x) = (wide(&flat), wide(&observations));
        for layers in networks(&shape) {
            let [_, gradient] = on_slices(&layers, &flat, &observations, shape.observation);
            let weights = wide(&wave(ROWS * layers[layers.len() - 1].output, 0.3));
            let loss = |p: &[f64]| -> f64 {
                let outputs = x.chunks_exact(shape.observation).flat_map(|row| exact_output(&layers, p, row));
                outputs.zip(&weights).map(|(output, c)| c * output + output * output).sum()
            };
            for range in layers.iter().flat_map(|layer| [layer.weight(), layer.bias()]) {
                for i in [range.start, range.start + range.len() / 2, range.end - 1] {
                    let centre = p[i];
                    let mut at = |step: f64| {
                        p[i] = centre + step;
                        let loss = loss(&p);
                        p[i] = centre;
                        loss
                    };
                    let expected = (at(1e-5) - at(-1e-5)) / 2e-5;
                    let found = f64::from(gradient[i - layers[0].offset]);
                    assert!((found - expected).abs() < 1e-4 * expected.abs().max(0.1), "{i}: {found} {expected}");
                }
            }
        }
    }
}

#[test]
fn a_tape_that_is_used_again_gives_the_same_bits_and_gradients_add_up() {
    let shape = NetworkShape { observation: 5, action: 2, hidden: vec![8], privileged: 0 };
    let (mlp, flat, observations) = (Mlp::new(shape.actor()), parameters(&shape), wave(300 * 5, 1.37));
    let (weights, mut used) = (prepared(&mlp, &flat), Tape::default());
    for rows in [256, 10, 200, 1] {
        let inputs = &observations[..rows * 5];
        let mut fresh = Tape::default();
        let [again, first] = [&mut used, &mut fresh].map(|tape| {
            mlp.forward(&weights, inputs, 5, tape);
            let output = slope_is_output(tape);
            let mut gradient = vec![0.0; mlp.range().len()];
            mlp.backward(&flat, inputs, 5, tape, &mut gradient, false);
            (gradient, output)
        });
        assert_eq!(again, first, "{rows} rows");
    }
    let mut twice = vec![0.0; mlp.range().len()];
    for _ in 0..2 {
        slope_is_output(&mut used);
        mlp.backward(&flat, &observations[..5], 5, &mut used, &mut twice, true);
    }
    slope_is_output(&mut used);
    let mut once = vec![0.0; mlp.range().len()];
    mlp.backward(&flat, &observations[..5], 5, &mut used, &mut once, false);
    assert!(twice.iter().zip(once).all(|(twice, once)| (twice - 2.0 * once).abs() < 1e-5));
}
