//! Orthogonal initialisation of the networks.
//!
//! Saxe, McClelland & Ganguli 2014, arXiv:1312.6120, with the gains of Engstrom et al. 2020, arXiv:2005.12729. The last
//! actor layer has a gain of 0.01 (Andrychowicz et al. 2021, arXiv:2006.05990), so that the first actions are near 0.

use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::{Mlp, Networks, mirror::Parts};

const HIDDEN_GAIN: f64 = std::f64::consts::SQRT_2;
const LAST_ACTOR_GAIN: f64 = 0.01;
const LAST_CRITIC_GAIN: f64 = 1.0;

impl Networks {
    /// Returns initial parameters: orthogonal weights, zero biases, every `log_std` at `init_log_std`. The blocks of
    /// equivariant networks are orthogonal, so that the weights of the equal dense networks are.
    pub fn initial_parameters(&self, init_log_std: f32, rng: &mut impl Rng) -> Vec<f32> {
        let mut parameters = vec![0.0; self.parameter_count()];
        let [actor_sides, critic_sides] = self.sides();
        fill_network(&self.actor(), &actor_sides, LAST_ACTOR_GAIN, &mut parameters, rng);
        fill_network(&self.critic(), &critic_sides, LAST_CRITIC_GAIN, &mut parameters, rng);
        let log_std = &mut parameters[self.log_std_range()];
        log_std.fill(init_log_std);
        crate::gaussian::clamp_log_std(log_std);
        parameters
    }
}

fn fill_network(network: &Mlp, sides: &[Parts], last_gain: f64, parameters: &mut [f32], rng: &mut impl Rng) {
    let parameters = &mut parameters[network.range()];
    for (i, layer) in network.layers().iter().enumerate() {
        let gain = if i + 1 == network.layers().len() { last_gain } else { HIDDEN_GAIN };
        // A pair of entries has one weight in place of two.
        let share = |side: usize, part: usize| sides.get(i + side).map_or(1.0, |parts| parts.share(part));
        for block in &layer.blocks {
            let columns = block.input.len();
            let weight = orthogonal(block.output.len(), columns, rng);
            for (index, (target, value)) in parameters[block.weight.clone()].iter_mut().zip(weight).enumerate() {
                let (output, input) = (block.output.start + index / columns, block.input.start + index % columns);
                *target = (value * gain * share(1, output) * share(0, input)) as f32;
            }
        }
    }
}

/// Returns a random `[rows, columns]` matrix, row-major. Its rows are orthonormal, or its columns if there are fewer of
/// them.
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
        // A vector almost in the span of the others would be rounding noise, so another one is drawn.
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
    use crate::{Dense, NetworkShape};
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    fn initial_parameters(shape: &NetworkShape, init_log_std: f32, rng: &mut Xoshiro256PlusPlus) -> Vec<f32> {
        Networks::from(shape.clone()).initial_parameters(init_log_std, rng)
    }

    /// Returns the largest deviation of the Gram matrix of the shorter side from `gain²` times the identity.
    fn misfit(weight: &[f32], layer: &Dense, gain: f64) -> f64 {
        let (rows, columns) = (layer.output, layer.input);
        let at = |r: usize, c: usize| f64::from(weight[r * columns + c]);
        let short: Vec<Vec<f64>> = if rows <= columns {
            (0..rows).map(|r| (0..columns).map(|c| at(r, c)).collect()).collect()
        } else {
            (0..columns).map(|c| (0..rows).map(|r| at(r, c)).collect()).collect()
        };
        let mut furthest = 0.0_f64;
        for (i, left) in short.iter().enumerate() {
            for (j, right) in short.iter().enumerate() {
                let expected = if i == j { gain * gain } else { 0.0 };
                furthest = furthest.max((dot(left, right) - expected).abs());
            }
        }
        furthest
    }

    #[test]
    fn weights_are_orthogonal_with_the_documented_gains() {
        let (hidden_gain, gains) = (2.0_f64.sqrt(), [0.01, 1.0]);
        // Tall and wide layers, and those of the presets.
        for (observation, action, hidden) in
            [(11, 4, vec![24, 16]), (45, 17, vec![256, 128]), (348, 17, vec![512, 256])]
        {
            let shape = NetworkShape { observation, action, hidden, privileged: 0 };
            let parameters = initial_parameters(&shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(1));
            for (network, last) in [shape.actor(), shape.critic()].iter().zip(gains) {
                for (layer, gain) in network.iter().zip([hidden_gain, hidden_gain, last]) {
                    let weight = &parameters[layer.weight()];
                    let misfit = misfit(weight, layer, gain);
                    assert!(misfit < 1e-6 * gain * gain, "{misfit} for {layer:?} with a gain of {gain}");
                    assert!(parameters[layer.bias()].iter().all(|b| *b == 0.0));
                }
            }
            assert!(parameters[shape.log_std()].iter().all(|l| *l == -0.5));
        }
    }

    #[test]
    fn one_wrong_sign_is_not_orthogonal() {
        let shape = NetworkShape { observation: 11, action: 4, hidden: vec![24, 16], privileged: 0 };
        let parameters = initial_parameters(&shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(1));
        for layer in &shape.actor()[..2] {
            let mut weight = parameters[layer.weight()].to_vec();
            let largest = (0..weight.len()).max_by(|a, b| weight[*a].abs().total_cmp(&weight[*b].abs()));
            let largest = largest.expect("there are weights");
            weight[largest] = -weight[largest];
            assert!(misfit(&weight, layer, 2.0_f64.sqrt()) > 0.01, "{layer:?}");
        }
    }

    #[test]
    fn the_seed_decides_the_weights() {
        let shape = NetworkShape { observation: 5, action: 2, hidden: vec![6], privileged: 0 };
        let draw = |seed| initial_parameters(&shape, 0.0, &mut Xoshiro256PlusPlus::seed_from_u64(seed));
        assert_eq!(draw(7), draw(7));
        assert_ne!(draw(7), draw(8));
    }
}
