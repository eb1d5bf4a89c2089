//! Evaluation of a policy: action means and values.

use std::sync::Arc;

use candle_core::{Device, Result, Storage, Tensor};
use rayon::ThreadPool;

use super::{NetworkPart, NetworkShape, Networks, ParameterError, check_parameters};

/// Rows per application of the networks on one thread or on a GPU; bounds the memory for activations.
const ROWS_AT_ONCE: usize = 4096;
/// Rows per application of the networks for each further thread: four of the chunks that threads share.
const ROWS_PER_THREAD: usize = 1024;

/// Networks with their parameters, for evaluation only.
#[derive(Clone, Debug)]
pub struct Policy {
    shape: NetworkShape,
    parameters: Vec<f32>,
    tensor: Tensor,
    device: Device,
    actor: Networks,
    critic: Networks,
    rows_at_once: usize,
}

impl Policy {
    /// Returns a policy that runs on the calling thread.
    ///
    /// # Errors
    /// If the parameters do not fit the shape or are not finite.
    pub fn new(shape: NetworkShape, parameters: Vec<f32>) -> std::result::Result<Self, ParameterError> {
        Self::build(shape, parameters, None, &Device::Cpu)
    }

    /// Returns a policy on `device`. On a CPU, the threads of `pool` share many rows, with the same results.
    ///
    /// # Errors
    /// If the parameters do not fit the shape or are not finite.
    pub fn with_pool(
        shape: NetworkShape,
        parameters: Vec<f32>,
        pool: Arc<ThreadPool>,
        device: &Device,
    ) -> std::result::Result<Self, ParameterError> {
        Self::build(shape, parameters, Some(pool), device)
    }

    fn build(
        shape: NetworkShape,
        parameters: Vec<f32>,
        pool: Option<Arc<ThreadPool>>,
        device: &Device,
    ) -> std::result::Result<Self, ParameterError> {
        check_parameters(&shape, &parameters)?;
        let tensor = Tensor::from_slice(&parameters, parameters.len(), device)?;
        let threads = pool.as_ref().map_or(1, |pool| pool.current_num_threads());
        let actor = Networks::on(device, &shape, NetworkPart::Actor, pool.clone());
        let critic = Networks::on(device, &shape, NetworkPart::Critic, pool);
        let rows_at_once = ROWS_AT_ONCE.max(threads * ROWS_PER_THREAD);
        Ok(Self { shape, parameters, tensor, device: device.clone(), actor, critic, rows_at_once })
    }

    /// Returns the shape of the networks.
    pub fn shape(&self) -> &NetworkShape {
        &self.shape
    }

    /// Returns the flat parameter vector.
    pub fn parameters(&self) -> &[f32] {
        &self.parameters
    }

    /// Returns the logarithm of the standard deviation of each action, `[action]`.
    pub fn log_std(&self) -> &[f32] {
        &self.parameters[self.shape.log_std()]
    }

    /// Writes the action means, `[rows, action]`, for normalised `observations`, `[rows, observation]`.
    ///
    /// # Errors
    /// If Candle fails.
    ///
    /// # Panics
    /// If a slice does not hold `rows` rows.
    pub fn means(&self, observations: &[f32], rows: usize, means: &mut [f32]) -> Result<()> {
        self.apply(&self.actor, self.shape.action, observations, rows, means)
    }

    /// Returns the critic's values, `[rows]`, for normalised `observations`, `[rows, observation]`.
    ///
    /// # Errors
    /// If Candle fails.
    ///
    /// # Panics
    /// If `observations` does not hold `rows` rows.
    pub fn values(&self, observations: &[f32], rows: usize) -> Result<Vec<f32>> {
        let mut values = vec![0.0; rows];
        self.apply(&self.critic, 1, observations, rows, &mut values)?;
        Ok(values)
    }

    fn apply(
        &self,
        networks: &Networks,
        width: usize,
        observations: &[f32],
        rows: usize,
        output: &mut [f32],
    ) -> Result<()> {
        let columns = self.shape.observation;
        assert_eq!(observations.len(), rows * columns, "observations do not hold {rows} rows of {columns}");
        assert_eq!(output.len(), rows * width, "the output does not hold {rows} rows of {width}");
        let inputs = observations.chunks(self.rows_at_once * columns);
        for (input, output) in inputs.zip(output.chunks_mut(self.rows_at_once * width)) {
            let input = Tensor::from_slice(input, (input.len() / columns, columns), &self.device)?;
            let result = networks.forward(&self.tensor, &input)?;
            let (storage, _) = result.storage_and_layout();
            if let Storage::Cpu(numbers) = &*storage {
                output.copy_from_slice(numbers.as_slice()?);
                continue;
            }
            drop(storage);
            output.copy_from_slice(&result.flatten_all()?.to_vec1()?);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::init::initial_parameters;
    use crate::plain;
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    #[test]
    fn means_and_values_agree_with_the_plain_networks_for_any_number_of_rows() -> Result<()> {
        let shape = NetworkShape { observation: 3, action: 2, hidden: vec![8, 4], privileged: 0 };
        let parameters = initial_parameters(&shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(3));
        let policy = Policy::new(shape.clone(), parameters.clone()).expect("fresh parameters fit");
        assert_eq!(policy.log_std(), [-0.5; 2]);
        for rows in [1, 5, ROWS_AT_ONCE + 3] {
            let observations: Vec<f32> = (0..rows * 3).map(|i| (i as f32 * 0.37).sin() * 3.0).collect();
            let mut means = vec![0.0; rows * 2];
            policy.means(&observations, rows, &mut means)?;
            let values = policy.values(&observations, rows)?;
            let tensor = Tensor::from_slice(&observations, (rows, 3), &Device::Cpu)?;
            let expected =
                plain::actor_critic(&shape, &Tensor::new(&parameters[..], &Device::Cpu)?, &tensor)?.to_vec2::<f32>()?;
            for (row, expected) in expected.iter().enumerate() {
                assert!((means[row * 2] - expected[0]).abs() < 1e-6 && (means[row * 2 + 1] - expected[1]).abs() < 1e-6);
                assert!((values[row] - expected[2]).abs() < 1e-5, "{row}");
            }
        }
        Ok(())
    }

    #[test]
    fn parameters_that_do_not_fit_are_refused() {
        let shape = NetworkShape { observation: 3, action: 2, hidden: vec![4], privileged: 0 };
        let count = shape.parameter_count();
        assert!(matches!(Policy::new(shape.clone(), vec![0.0; 5]), Err(ParameterError::Count { found: 5, .. })));
        let mut parameters = vec![0.0; count];
        parameters[count - 1] = f32::INFINITY;
        assert!(matches!(Policy::new(shape, parameters), Err(ParameterError::NonFinite { .. })));
    }
}
