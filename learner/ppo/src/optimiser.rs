//! Adam and gradient clipping over one flat slice.
//!
//! Kingma & Ba 2015, "Adam: a method for stochastic optimization", arXiv:1412.6980, algorithm 1, with the constants and
//! the place of ε of PyTorch's `torch.optim.Adam`: β₁ 0.9, β₂ 0.999, ε 1e-8 outside the root, no weight decay.

use multiversion::multiversion;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

const BETA_1: f64 = 0.9;
const BETA_2: f64 = 0.999;
const EPSILON: f64 = 1e-8;
/// Parameters that one thread steps, or whose squares it sums, at a time.
const PART: usize = 16_384;

/// State of Adam. Together with the learning rate, a resumed run continues from it exactly.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OptimiserState {
    /// Steps taken.
    pub step: u64,
    /// Running mean of the gradient, `[parameters]`.
    pub first_moment: Vec<f32>,
    /// Running mean of the squared gradient, `[parameters]`.
    pub second_moment: Vec<f32>,
}

impl OptimiserState {
    /// State before the first step.
    pub fn new(parameters: usize) -> Self {
        Self { step: 0, first_moment: vec![0.0; parameters], second_moment: vec![0.0; parameters] }
    }

    /// Takes one step of Adam with the gradient times `scale`, on the threads of the pool that calls it.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn apply(&mut self, parameters: &mut [f32], gradient: &[f32], scale: f32, learning_rate: f64) {
        let count = parameters.len();
        assert!(gradient.len() == count && self.first_moment.len() == count && self.second_moment.len() == count);
        self.step += 1;
        let (step_size, root_correction) = bias_corrections(self.step, learning_rate);
        let factors = Factors { scale, step_size: step_size as f32, root_correction: root_correction as f32 };
        let moments = self.first_moment.par_chunks_mut(PART).zip(self.second_moment.par_chunks_mut(PART));
        let parts = parameters.par_chunks_mut(PART).zip(gradient.par_chunks(PART)).zip(moments);
        parts.for_each(|((parameters, gradient), (first, second))| {
            adam(parameters, gradient, first, second, &factors);
        });
    }
}

/// Returns the step size, and the factor on the root of the second moment, of the given step.
pub(crate) fn bias_corrections(step: u64, learning_rate: f64) -> (f64, f64) {
    // Steps beyond i32 change nothing: both powers are 0 well before.
    let step = i32::try_from(step).unwrap_or(i32::MAX);
    (learning_rate / (1.0 - BETA_1.powi(step)), 1.0 / (1.0 - BETA_2.powi(step)).sqrt())
}

/// Factors that all parameters of one step share.
struct Factors {
    scale: f32,
    step_size: f32,
    root_correction: f32,
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2+fma"))]
fn adam(parameters: &mut [f32], gradient: &[f32], first: &mut [f32], second: &mut [f32], factors: &Factors) {
    const KEEP_1: f32 = BETA_1 as f32;
    const KEEP_2: f32 = BETA_2 as f32;
    const TAKE_1: f32 = (1.0 - BETA_1) as f32;
    const TAKE_2: f32 = (1.0 - BETA_2) as f32;
    let Factors { scale, step_size, root_correction } = *factors;
    for (((p, g), m), v) in parameters.iter_mut().zip(gradient).zip(first).zip(second) {
        let g = *g * scale;
        *m = KEEP_1 * *m + TAKE_1 * g;
        *v = KEEP_2 * *v + TAKE_2 * g * g;
        *p -= step_size * *m / (v.sqrt() * root_correction + EPSILON as f32);
    }
}

/// Returns the Euclidean norm of a gradient, summed in f64; infinite or not a number if an entry is. The parts are summed in
/// order, so the result does not depend on the number of threads.
pub fn global_norm(gradient: &[f32]) -> f64 {
    let parts: Vec<f64> = gradient.par_chunks(PART).map(squares).collect();
    parts.iter().sum::<f64>().sqrt()
}

/// Returns the sum of the squares of numbers.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2+fma"))]
fn squares(numbers: &[f32]) -> f64 {
    // Sixteen sums side by side, in a fixed order, so that the loop vectorises and the result never changes.
    let mut sums = [0.0_f64; 16];
    let (chunks, rest) = numbers.as_chunks::<16>();
    for chunk in chunks {
        for (sum, g) in sums.iter_mut().zip(chunk) {
            *sum += f64::from(*g) * f64::from(*g);
        }
    }
    for (sum, g) in sums.iter_mut().zip(rest) {
        *sum += f64::from(*g) * f64::from(*g);
    }
    sums.iter().sum()
}

/// Returns the factor that reduces a gradient of `norm` to `max_norm`, or 1 if it is smaller: Pascanu, Mikolov & Bengio
/// 2013, arXiv:1211.5063, with the 1e-6 of PyTorch's `clip_grad_norm_`.
pub fn clip_factor(norm: f64, max_norm: f64) -> f32 {
    (max_norm / (norm + 1e-6)).min(1.0) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adam_takes_the_steps_computed_by_hand() {
        let mut parameters = [1.0, -1.0];
        let mut state = OptimiserState::new(2);
        // First step: m̂ = g and v̂ = g², so each parameter moves by the learning rate against its gradient's sign.
        state.apply(&mut parameters, &[0.5, -4.0], 1.0, 0.1);
        assert!((parameters[0] - 0.9).abs() < 1e-6 && (parameters[1] + 0.9).abs() < 1e-6, "{parameters:?}");
        assert!((state.first_moment[0] - 0.05).abs() < 1e-7 && (state.second_moment[0] - 0.00025).abs() < 1e-9);
        // Second: m = 0.045 − 0.1, m̂ = −0.055/0.19; v = 0.00024975 + 0.001, v̂ = 0.00124975/0.001999.
        state.apply(&mut parameters, &[-1.0, 0.0], 1.0, 0.1);
        let expected = 0.9 + 0.1 * (0.055 / 0.19) / (0.001_249_75_f64 / 0.001_999).sqrt();
        assert!((f64::from(parameters[0]) - expected).abs() < 1e-5, "{} {expected}", parameters[0]);
        assert_eq!(state.step, 2);
    }

    #[test]
    fn the_scale_is_a_factor_on_the_gradient() {
        let (mut a, mut b) = ([1.0; 40], [1.0; 40]);
        let (mut state_a, mut state_b) = (OptimiserState::new(40), OptimiserState::new(40));
        let gradient: Vec<f32> = (0..40).map(|i| i as f32 - 20.5).collect();
        let half: Vec<f32> = gradient.iter().map(|g| g * 0.5).collect();
        for _ in 0..3 {
            state_a.apply(&mut a, &gradient, 0.5, 0.01);
            state_b.apply(&mut b, &half, 1.0, 0.01);
        }
        assert_eq!(a, b);
        assert_eq!(state_a, state_b);
    }

    #[test]
    fn the_number_of_threads_changes_neither_a_long_step_nor_its_norm() {
        let count = 2 * PART + 7;
        let wave = |factor: f32| -> Vec<f32> { (0..count).map(|i| (i as f32 * factor).sin()).collect() };
        let (gradient, parameters) = (wave(0.37), wave(1.1));
        let mut whole = (parameters.clone(), OptimiserState::new(count));
        let (step_size, root_correction) = bias_corrections(1, 0.01);
        let factors = Factors { scale: 0.5, step_size: step_size as f32, root_correction: root_correction as f32 };
        adam(&mut whole.0, &gradient, &mut whole.1.first_moment, &mut whole.1.second_moment, &factors);
        whole.1.step = 1;
        let exact = gradient.iter().map(|g| f64::from(*g) * f64::from(*g)).sum::<f64>().sqrt();
        let mut norms = Vec::new();
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            let mut found = (parameters.clone(), OptimiserState::new(count));
            pool.install(|| found.1.apply(&mut found.0, &gradient, 0.5, 0.01));
            assert_eq!(found, whole, "{threads} threads");
            norms.push(pool.install(|| global_norm(&gradient)));
        }
        assert!(norms[0] == norms[1] && norms[0] == norms[2] && (norms[0] - exact).abs() < 1e-9, "{norms:?} {exact}");
    }

    #[test]
    fn the_norm_is_that_of_the_whole_slice() {
        assert_eq!(global_norm(&[3.0, 4.0]), 5.0);
        assert!((global_norm(&[2.0; 100]) - 20.0).abs() < 1e-12);
        assert_eq!(global_norm(&[]), 0.0);
        assert!((global_norm(&[1e30; 4]) - 2e30).abs() < 1e24);
        assert!(global_norm(&[0.0, f32::NAN, 0.0]).is_nan());
        assert_eq!(global_norm(&[f32::NEG_INFINITY]), f64::INFINITY);
    }

    #[test]
    fn only_long_gradients_are_clipped() {
        assert_eq!(clip_factor(0.5, 1.0), 1.0);
        assert_eq!(clip_factor(0.0, 1.0), 1.0);
        assert!((clip_factor(4.0, 1.0) - 0.25).abs() < 1e-6);
    }
}
