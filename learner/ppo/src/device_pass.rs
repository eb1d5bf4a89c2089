//! Passes over a batch on a GPU, with Candle's operations.
//!
//! The batch, parameters and moments are uploaded once. Gradient steps, clipping, Adam and the sums of statistics stay on the
//! device. After each pass, one transfer returns parameters, moments, sums and the means that measure the divergence.

use candle_core::{D, DType, Device, Result, Tensor, Var};
use treadmill_config::PpoConfig;
use treadmill_policy::gaussian::{LOG_STD_MAX, LOG_STD_MIN};
use treadmill_policy::{NamedTensor, NetworkShape, plain};

use crate::{
    batch::{Batch, minibatches},
    loss::{Minibatch, ppo_loss},
    measures::PolicyShift,
    optimiser::{BETA_1, BETA_2, EPSILON, bias_corrections},
    state::PpoState,
    update_stats::{PassSums, UpdateError, check_finite},
};

/// Sums of one pass: the loss and its four parts, the gradient's norm, and the number of clipped ratios.
const SUMS: usize = 7;

/// Batch and state of one update on a device.
pub(crate) struct DevicePass {
    shape: NetworkShape,
    config: PpoConfig,
    device: Device,
    observations: Tensor,
    rows: Minibatch,
    /// Observations that measure the divergence.
    shift_observations: Tensor,
    parameters: Tensor,
    first_moment: Tensor,
    second_moment: Tensor,
}

impl DevicePass {
    /// Uploads a batch and the state that the update starts from. `advantages` are the normalised ones.
    pub(crate) fn upload(
        batch: &Batch,
        advantages: &[f32],
        shift: &PolicyShift,
        shape: &NetworkShape,
        config: &PpoConfig,
        device: &Device,
        state: &PpoState,
    ) -> Result<Self> {
        let matrix = |plane: &[f32], width| Tensor::from_slice(plane, (batch.len(), width), device);
        let vector = |numbers: &[f32]| Tensor::from_slice(numbers, numbers.len(), device);
        let rows = Minibatch {
            actions: matrix(&batch.actions, shape.action)?,
            log_probs: vector(&batch.log_probs)?,
            advantages: vector(advantages)?,
            returns: vector(&batch.returns)?,
        };
        Ok(Self {
            shape: shape.clone(),
            config: config.clone(),
            device: device.clone(),
            observations: matrix(&batch.observations, shape.observation)?,
            rows,
            shift_observations: vector(&shift.observations)?.reshape(((), shape.observation))?,
            parameters: vector(&state.parameters)?,
            first_moment: vector(&state.optimiser.first_moment)?,
            second_moment: vector(&state.optimiser.second_moment)?,
        })
    }

    /// Takes one pass in the given order, and returns its results to `state`.
    pub(crate) fn run(
        &mut self,
        order: &[u32],
        shift: &PolicyShift,
        state: &mut PpoState,
    ) -> std::result::Result<PassSums, UpdateError> {
        let order = Tensor::from_slice(order, order.len(), &self.device)?;
        let gathered = |plane: &Tensor| plane.index_select(&order, 0);
        let observations = gathered(&self.observations)?;
        let rows = Minibatch {
            actions: gathered(&self.rows.actions)?,
            log_probs: gathered(&self.rows.log_probs)?,
            advantages: gathered(&self.rows.advantages)?,
            returns: gathered(&self.rows.returns)?,
        };
        let mut sums = Tensor::zeros(SUMS, DType::F32, &self.device)?;
        let count = order.elem_count();
        for range in minibatches(count, self.config.minibatch_rows(count)) {
            let part = |plane: &Tensor| plane.narrow(0, range.start, range.len());
            let minibatch = Minibatch {
                actions: part(&rows.actions)?,
                log_probs: part(&rows.log_probs)?,
                advantages: part(&rows.advantages)?,
                returns: part(&rows.returns)?,
            };
            state.optimiser.step += 1;
            let corrections = bias_corrections(state.optimiser.step, state.learning_rate);
            sums = (sums + self.gradient_step(&part(&observations)?, &minibatch, corrections)?)?;
        }
        let means = plain::network(&self.shape.actor(), &self.parameters, &self.shift_observations)?.flatten_all()?;
        self.read_back(&sums, &means, shift, state)
    }

    /// Forward, loss, backward, clipping, Adam. Returns the rows' contributions to the sums.
    fn gradient_step(
        &mut self,
        observations: &Tensor,
        minibatch: &Minibatch,
        (step_size, root_correction): (f64, f64),
    ) -> Result<Tensor> {
        let leaves = self.leaves()?;
        let (actor, others) = leaves.split_at(2 * self.shape.actor().len());
        let (log_std, critic) = others.split_first().expect("log_std follows the actor");
        let seen = observations.narrow(1, 0, self.shape.seen_by_actor())?;
        let (means, values) = (plain::layered(actor, &seen)?, plain::layered(critic, observations)?);
        let loss = ppo_loss(&Tensor::cat(&[means, values], 1)?, log_std, minibatch, &self.config)?;

        let gradients = loss.total.backward()?;
        let gradient_of = |leaf: &Tensor| gradients.get(leaf).expect("the loss depends on every leaf").flatten_all();
        let gradient = Tensor::cat(&leaves.iter().map(gradient_of).collect::<Result<Vec<_>>>()?, 0)?;
        let norm = gradient.sqr()?.sum_all()?.sqrt()?;
        // As `optimiser::clip_factor`.
        let scale = ((&norm + 1e-6)?.recip()? * self.config.max_grad_norm)?.minimum(1.0)?;
        self.adam(&gradient.broadcast_mul(&scale)?, step_size, root_correction)?;

        let outside = ((loss.log_ratio.exp()? - 1.0)?.abs()?.gt(self.config.clip_range)?).to_dtype(DType::F32)?;
        // The number of clipped ratios is a sum over rows already, the others are means.
        let means = [&loss.total, &loss.policy, &loss.value, &loss.entropy, &loss.bounds, &norm, &outside.mean_all()?];
        Tensor::stack(&means, 0)? * minibatch.returns.elem_count() as f64
    }

    /// Returns a leaf for each tensor of the networks, in the order of the flat vector.
    fn leaves(&self) -> Result<Vec<Tensor>> {
        let leaf = |tensor: &NamedTensor| {
            let part = self.parameters.narrow(0, tensor.offset, tensor.len())?;
            Ok(Var::from_tensor(&part.reshape(&tensor.shape[..])?)?.into_inner())
        };
        self.shape.tensors().iter().map(leaf).collect()
    }

    /// Takes the step of [`crate::optimiser::OptimiserState::apply`] with a clipped gradient, then clamps `log_std`.
    fn adam(&mut self, gradient: &Tensor, step_size: f64, root_correction: f64) -> Result<()> {
        self.first_moment = ((&self.first_moment * BETA_1)? + (gradient * (1.0 - BETA_1))?)?;
        self.second_moment = ((&self.second_moment * BETA_2)? + (gradient.sqr()? * (1.0 - BETA_2))?)?;
        let divisor = self.second_moment.sqrt()?.affine(root_correction, EPSILON)?;
        self.parameters = (&self.parameters - ((&self.first_moment / divisor)? * step_size)?)?;
        let range = self.shape.log_std();
        let log_std = self.parameters.narrow(0, range.start, range.len())?.clamp(LOG_STD_MIN, LOG_STD_MAX)?;
        self.parameters.slice_set(&log_std, 0, range.start)
    }

    /// Transfers the results of a pass, and checks them.
    fn read_back(
        &self,
        sums: &Tensor,
        means: &Tensor,
        shift: &PolicyShift,
        state: &mut PpoState,
    ) -> std::result::Result<PassSums, UpdateError> {
        let joined = Tensor::cat(&[&self.parameters, &self.first_moment, &self.second_moment, sums, means], D::Minus1)?;
        let numbers = joined.to_vec1::<f32>()?;
        let count = state.parameters.len();
        let (parameters, rest) = numbers.split_at(count);
        let (first, rest) = rest.split_at(count);
        let (second, rest) = rest.split_at(count);
        let (sums, means) = rest.split_at(SUMS);
        let [total, policy, value, entropy, bounds, norm, clipped] = sums else { unreachable!("seven sums") };
        check_finite(total.is_finite(), "loss")?;
        check_finite(norm.is_finite(), "gradient")?;
        check_finite(parameters.iter().all(|p| p.is_finite()), "parameter vector")?;
        let divergence = shift.divergence(means, &parameters[self.shape.log_std()]);
        check_finite(divergence.is_finite(), "divergence from the old policy")?;
        state.parameters.copy_from_slice(parameters);
        state.optimiser.first_moment.copy_from_slice(first);
        state.optimiser.second_moment.copy_from_slice(second);
        Ok(PassSums {
            policy_loss: f64::from(*policy),
            value_loss: f64::from(*value),
            entropy: f64::from(*entropy),
            bounds_loss: f64::from(*bounds),
            grad_norm: f64::from(*norm),
            clipped: f64::from(*clipped),
            divergence,
        })
    }
}
