//! Evaluation of a policy: action means and values.

use std::sync::Arc;

use rayon::ThreadPool;

use crate::{ForwardWeights, Mlp, NetworkShape, Networks, ParameterError, check_parameters};

/// Networks with their parameters, for evaluation only.
#[derive(Clone, Debug)]
pub struct Policy {
    networks: Networks,
    actor: Mlp,
    critic: Mlp,
    /// Parameters of actor and critic.
    prepared: [ForwardWeights; 2],
    log_std: Vec<f32>,
    /// Threads that share many rows.
    pool: Option<Arc<ThreadPool>>,
}

impl Policy {
    /// Returns a policy that runs on the calling thread.
    ///
    /// # Errors
    /// If the parameters do not fit the shape or are not finite.
    pub fn new(networks: impl Into<Networks>, parameters: Vec<f32>) -> Result<Self, ParameterError> {
        let networks = networks.into();
        let (found, expected) = (parameters.len(), networks.parameter_count());
        if found != expected {
            return Err(ParameterError::Count { found, expected });
        }
        if parameters.iter().any(|parameter| !parameter.is_finite()) {
            // Only the dense networks have names for them.
            check_parameters(networks.shape(), &networks.dense(&parameters))?;
        }
        let (actor, critic, log_std) =
            (networks.actor(), networks.critic(), networks.log_std(&parameters).into_owned());
        let prepared = [&actor, &critic].map(|network| {
            let mut prepared = ForwardWeights::default();
            network.prepare(&parameters, &mut prepared);
            prepared
        });
        Ok(Self { networks, actor, critic, prepared, log_std, pool: None })
    }

    /// Returns a policy whose many rows the threads of `pool` share, with the same results.
    ///
    /// # Errors
    /// If the parameters do not fit the shape or are not finite.
    pub fn with_pool(
        networks: impl Into<Networks>,
        parameters: Vec<f32>,
        pool: Arc<ThreadPool>,
    ) -> Result<Self, ParameterError> {
        Ok(Self { pool: Some(pool), ..Self::new(networks, parameters)? })
    }

    /// Returns the shape of the networks.
    pub fn shape(&self) -> &NetworkShape {
        self.networks.shape()
    }

    /// Returns the logarithm of the standard deviation of each action, `[action]`.
    pub fn log_std(&self) -> &[f32] {
        &self.log_std
    }

    /// Writes the action means, `[rows, action]`, for normalised `observations`, `[rows, observation]`.
    ///
    /// # Panics
    /// If a slice does not hold `rows` rows.
    pub fn means(&self, observations: &[f32], rows: usize, means: &mut [f32]) {
        self.apply(&self.actor, &self.prepared[0], observations, rows, means)
    }

    /// Returns the critic's values, `[rows]`, for normalised `observations`, `[rows, observation]`.
    ///
    /// # Panics
    /// If `observations` does not hold `rows` rows.
    pub fn values(&self, observations: &[f32], rows: usize) -> Vec<f32> {
        let mut values = vec![0.0; rows];
        self.apply(&self.critic, &self.prepared[1], observations, rows, &mut values);
        values
    }

    fn apply(&self, network: &Mlp, prepared: &ForwardWeights, observations: &[f32], rows: usize, output: &mut [f32]) {
        let (columns, width) = (self.shape().observation, network.output());
        assert_eq!(observations.len(), rows * columns, "observations do not hold {rows} rows of {columns}");
        assert_eq!(output.len(), rows * width, "the output does not hold {rows} rows of {width}");
        network.evaluate(prepared, observations, columns, output, self.pool.as_deref());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{mlp::CHUNK_ROWS, plain};
    use candle_core::{Device, Result, Tensor};
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    #[test]
    fn means_and_values_agree_with_the_plain_networks_for_any_number_of_rows() -> Result<()> {
        for privileged in [0, 1] {
            check_agreement(NetworkShape { observation: 3, action: 2, hidden: vec![8, 4], privileged })?;
        }
        Ok(())
    }

    fn check_agreement(shape: NetworkShape) -> Result<()> {
        let parameters =
            Networks::from(shape.clone()).initial_parameters(-0.5, &mut Xoshiro256PlusPlus::seed_from_u64(3));
        let policy = Policy::new(shape.clone(), parameters.clone()).expect("fresh parameters fit");
        assert_eq!(policy.log_std(), [-0.5; 2]);
        for rows in [1, 5, 4 * CHUNK_ROWS + 3] {
            let observations: Vec<f32> = (0..rows * 3).map(|i| (i as f32 * 0.37).sin() * 3.0).collect();
            let mut means = vec![0.0; rows * 2];
            policy.means(&observations, rows, &mut means);
            let values = policy.values(&observations, rows);
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
        let parameters =
            Networks::from(shape.clone()).initial_parameters(-0.5, &mut Xoshiro256PlusPlus::seed_from_u64(3));
        let rows = 5 * CHUNK_ROWS + 17;
        let observations: Vec<f32> = (0..rows * 9).map(|i| (i as f32 * 0.37).sin() * 3.0).collect();
        let alone = Policy::new(shape.clone(), parameters.clone()).expect("they fit");
        let expected = alone.values(&observations, rows);
        for threads in [1, 2, 3, 7] {
            let pool = Arc::new(rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start"));
            let policy = Policy::with_pool(shape.clone(), parameters.clone(), pool).expect("they fit");
            assert_eq!(policy.values(&observations, rows), expected, "{threads} threads");
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
