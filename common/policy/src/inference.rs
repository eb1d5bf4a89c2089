//! Evaluation of a policy: action means and values.

use std::sync::Arc;

use candle_core::{Device, Result, Tensor};
use rayon::ThreadPool;

use super::{Dense, Mlp, NetworkShape, ParameterError, check_parameters, plain};

/// Rows per application of the networks on a GPU; bounds the memory for activations.
const ROWS_AT_ONCE: usize = 4096;

/// Networks with their parameters, for evaluation only.
#[derive(Clone, Debug)]
pub struct Policy {
    shape: NetworkShape,
    parameters: Vec<f32>,
    /// Threads that share many rows on a CPU.
    pool: Option<Arc<ThreadPool>>,
    /// Parameters on a GPU.
    on_gpu: Option<Tensor>,
}

impl Policy {
    /// Returns a policy that runs on the calling thread.
    ///
    /// # Errors
    /// If the parameters do not fit the shape or are not finite.
    pub fn new(shape: NetworkShape, parameters: Vec<f32>) -> std::result::Result<Self, ParameterError> {
        check_parameters(&shape, &parameters)?;
        Ok(Self { shape, parameters, pool: None, on_gpu: None })
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
        let policy = Self::new(shape, parameters)?;
        let upload = || Tensor::from_slice(&policy.parameters, policy.parameters.len(), device);
        let on_gpu = if device.is_cpu() { None } else { Some(upload()?) };
        Ok(Self { pool: Some(pool), on_gpu, ..policy })
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
        self.apply(self.shape.actor(), observations, rows, means)
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
        self.apply(self.shape.critic(), observations, rows, &mut values)?;
        Ok(values)
    }

    fn apply(&self, layers: Vec<Dense>, observations: &[f32], rows: usize, output: &mut [f32]) -> Result<()> {
        let columns = self.shape.observation;
        let width = layers.last().map_or(0, |layer| layer.output);
        assert_eq!(observations.len(), rows * columns, "observations do not hold {rows} rows of {columns}");
        assert_eq!(output.len(), rows * width, "the output does not hold {rows} rows of {width}");
        let Some(parameters) = &self.on_gpu else {
            Mlp::new(layers).evaluate(&self.parameters, observations, columns, output, self.pool.as_deref());
            return Ok(());
        };
        let inputs = observations.chunks(ROWS_AT_ONCE * columns);
        for (input, output) in inputs.zip(output.chunks_mut(ROWS_AT_ONCE * width)) {
            let input = Tensor::from_slice(input, (input.len() / columns, columns), parameters.device())?;
            output.copy_from_slice(&plain::network(&layers, parameters, &input)?.flatten_all()?.to_vec1()?);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::init::initial_parameters;
    use crate::mlp::CHUNK_ROWS;
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    #[test]
    fn means_and_values_agree_with_the_plain_networks_for_any_number_of_rows() -> Result<()> {
        for privileged in [0, 1] {
            check_agreement(NetworkShape { observation: 3, action: 2, hidden: vec![8, 4], privileged })?;
        }
        Ok(())
    }

    fn check_agreement(shape: NetworkShape) -> Result<()> {
        let parameters = initial_parameters(&shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(3));
        let policy = Policy::new(shape.clone(), parameters.clone()).expect("fresh parameters fit");
        assert_eq!(policy.log_std(), [-0.5; 2]);
        for rows in [1, 5, 4 * CHUNK_ROWS + 3] {
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
    fn the_number_of_threads_does_not_change_one_bit() {
        let shape = NetworkShape { observation: 9, action: 4, hidden: vec![32, 16], privileged: 0 };
        let parameters = initial_parameters(&shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(3));
        let rows = 5 * CHUNK_ROWS + 17;
        let observations: Vec<f32> = (0..rows * 9).map(|i| (i as f32 * 0.37).sin() * 3.0).collect();
        let alone = Policy::new(shape.clone(), parameters.clone()).expect("they fit");
        let expected = alone.values(&observations, rows).expect("no device");
        for threads in [1, 2, 3, 7] {
            let pool = Arc::new(rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start"));
            let policy = Policy::with_pool(shape.clone(), parameters.clone(), pool, &Device::Cpu).expect("they fit");
            assert_eq!(policy.values(&observations, rows).expect("no device"), expected, "{threads} threads");
        }
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
