//! Orthogonal initialisation of the networks.
//!
//! Saxe, McClelland & Ganguli 2014, arXiv:1312.6120; the gains are those of Engstrom et al. 2020, arXiv:2005.12729,
//! with a last actor layer of 0.01 (Andrychowicz et al. 2021, arXiv:2006.05990), so that the first actions are near 0.

use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

use super::{Dense, NetworkShape};

const HIDDEN_GAIN: f64 = std::f64::consts::SQRT_2;
const LAST_ACTOR_GAIN: f64 = 0.01;
const LAST_CRITIC_GAIN: f64 = 1.0;

/// Fresh parameters: orthogonal weights, zero biases, every `log_std` at `init_log_std`.
pub fn initial_parameters(shape: &NetworkShape, init_log_std: f32, rng: &mut impl Rng) -> Vec<f32> {
    let mut parameters = vec![0.0; shape.parameter_count()];
    fill_network(&shape.actor(), LAST_ACTOR_GAIN, &mut parameters, rng);
    fill_network(&shape.critic(), LAST_CRITIC_GAIN, &mut parameters, rng);
    parameters[shape.log_std()].fill(init_log_std);
    super::gaussian::clamp_log_std(&mut parameters[shape.log_std()]);
    parameters
}

fn fill_network(layers: &[Dense], last_gain: f64, parameters: &mut [f32], rng: &mut impl Rng) {
    for (i, layer) in layers.iter().enumerate() {
        let gain = if i + 1 == layers.len() { last_gain } else { HIDDEN_GAIN };
        let weight = orthogonal(layer.output, layer.input, rng);
        for (target, value) in parameters[layer.weight()].iter_mut().zip(weight) {
            *target = (value * gain) as f32;
        }
    }
}

/// A random `[rows, columns]` matrix, row-major, whose rows are orthonormal, or whose columns are where those are fewer.
fn orthogonal(rows: usize, columns: usize, rng: &mut impl Rng) -> Vec<f64> {
    let (count, length) = (rows.min(columns), rows.max(columns));
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(count);
    while basis.len() < count {
        let mut vector: Vec<f64> = (0..length).map(|_| StandardNormal.sample(rng)).collect();
        // Gram-Schmidt twice: one pass leaves rounding errors that grow with the number of vectors.
        for _ in 0..2 {
            for other in &basis {
                let overlap = dot(&vector, other);
                vector.iter_mut().zip(other).for_each(|(v, o)| *v -= overlap * o);
            }
        }
        let norm = dot(&vector, &vector).sqrt();
        // A draw that almost lies in the span of the others would only be rounding noise: draw again.
        if norm > 1e-6 {
            vector.iter_mut().for_each(|v| *v /= norm);
            basis.push(vector);
        }
    }
    let element = |row: usize, column: usize| if rows <= columns { basis[row][column] } else { basis[column][row] };
    (0..rows * columns).map(|i| element(i / columns, i % columns)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    /// The Gram matrix of the shorter side must be `gain²` times the identity.
    fn assert_orthogonal(weight: &[f32], layer: &Dense, gain: f64) {
        let (rows, columns) = (layer.output, layer.input);
        let at = |r: usize, c: usize| f64::from(weight[r * columns + c]);
        let count = rows.min(columns);
        for i in 0..count {
            for j in 0..count {
                let product: f64 = if rows <= columns {
                    (0..columns).map(|k| at(i, k) * at(j, k)).sum()
                } else {
                    (0..rows).map(|k| at(k, i) * at(k, j)).sum()
                };
                let expected = if i == j { gain * gain } else { 0.0 };
                assert!((product - expected).abs() < 1e-6, "{i},{j}: {product} for {layer:?}");
            }
        }
    }

    #[test]
    fn weights_are_orthogonal_with_the_documented_gains() {
        let shape = NetworkShape { observation: 11, action: 4, hidden: vec![24, 16] };
        let parameters = initial_parameters(&shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(1));
        for (network, last) in [(shape.actor(), 0.01), (shape.critic(), 1.0)] {
            for (layer, gain) in network.iter().zip([2.0_f64.sqrt(), 2.0_f64.sqrt(), last]) {
                assert_orthogonal(&parameters[layer.weight()], layer, gain);
                assert!(parameters[layer.bias()].iter().all(|b| *b == 0.0));
            }
        }
        assert_eq!(parameters[shape.log_std()], [-0.5; 4]);
    }

    #[test]
    fn the_seed_decides_the_weights() {
        let shape = NetworkShape { observation: 5, action: 2, hidden: vec![6] };
        let draw = |seed| initial_parameters(&shape, 0.0, &mut Xoshiro256PlusPlus::seed_from_u64(seed));
        assert_eq!(draw(7), draw(7));
        assert_ne!(draw(7), draw(8));
    }
}
