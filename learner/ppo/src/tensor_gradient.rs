//! Gradient of the loss by Candle's operations and automatic differentiation on the processor.

use candle_core::{DType, Device, Result, Tensor, Var};
use treadmill_config::PpoConfig;
use treadmill_policy::{NamedTensor, Networks, plain};

use crate::{
    batch::Batch,
    loss::{Minibatch, ppo_loss},
    loss_gradient::LossSums,
};

/// Batch of one update as tensors.
pub(crate) struct TensorGradient<'a> {
    networks: &'a Networks,
    config: &'a PpoConfig,
    observations: Tensor,
    rows: Minibatch,
}

impl<'a> TensorGradient<'a> {
    /// Copies a batch. `advantages` are the normalised ones, times their weights.
    pub(crate) fn upload(
        batch: &Batch,
        advantages: &[f32],
        networks: &'a Networks,
        config: &'a PpoConfig,
    ) -> Result<Self> {
        let (shape, device) = (networks.shape(), &Device::Cpu);
        let matrix = |plane: &[f32], width| Tensor::from_slice(plane, (batch.len(), width), device);
        let rows = Minibatch {
            actions: matrix(&batch.actions, shape.action)?,
            log_probs: Tensor::new(&batch.log_probs[..], device)?,
            advantages: Tensor::new(advantages, device)?,
            returns: Tensor::new(&batch.returns[..], device)?,
        };
        Ok(Self { networks, config, observations: matrix(&batch.observations, shape.observation)?, rows })
    }

    /// Computes the gradient of the loss over the given rows by the learnt parameters, through the equal dense networks,
    /// which take fewer operations. Returns the loss. One transfer brings both from the
    /// device.
    pub(crate) fn compute(&self, rows: &[u32], parameters: &[f32], gradient: &mut [f32]) -> Result<LossSums> {
        let (device, shape) = (self.observations.device(), self.networks.shape());
        let index = Tensor::new(rows, device)?;
        let part = |plane: &Tensor| plane.index_select(&index, 0);
        let minibatch = Minibatch {
            actions: part(&self.rows.actions)?,
            log_probs: part(&self.rows.log_probs)?,
            advantages: part(&self.rows.advantages)?,
            returns: part(&self.rows.returns)?,
        };
        let dense = self.networks.dense(parameters);
        let leaves = self.leaves(&Tensor::new(&dense[..], device)?)?;
        let (actor, others) = leaves.split_at(2 * shape.actor().len());
        let (log_std, critic) = others.split_first().expect("log_std follows the actor");
        let observations = part(&self.observations)?;
        let seen = observations.narrow(1, 0, shape.seen_by_actor())?;
        let output = Tensor::cat(&[plain::layered(actor, &seen)?, plain::layered(critic, &observations)?], 1)?;
        let loss = ppo_loss(&output, log_std, &minibatch, self.config)?;

        let gradients = loss.total.backward()?;
        let gradient_of = |leaf: &Tensor| gradients.get(leaf).expect("the loss depends on every leaf").flatten_all();
        let mut numbers = leaves.iter().map(gradient_of).collect::<Result<Vec<_>>>()?;
        let is_clipped = (loss.log_ratio.exp()? - 1.0)?.abs()?.gt(self.config.clip_range)?;
        let clipped = is_clipped.to_dtype(DType::F32)?.mean_all()?;
        numbers.push(Tensor::stack(&[&loss.policy, &loss.value, &loss.bounds, &clipped], 0)?);
        let numbers = Tensor::cat(&numbers, 0)?.to_vec1::<f32>()?;
        let (flat, means) = numbers.split_at(shape.parameter_count());
        gradient.copy_from_slice(&self.networks.fold(flat));
        let sum = |index: usize| f64::from(means[index]) * rows.len() as f64;
        Ok(LossSums { policy: sum(0), value: sum(1), bounds: sum(2), clipped: sum(3) })
    }

    /// Returns a leaf for each tensor of the networks, in the order of the flat vector.
    fn leaves(&self, flat: &Tensor) -> Result<Vec<Tensor>> {
        let leaf = |tensor: &NamedTensor| {
            let part = flat.narrow(0, tensor.offset, tensor.len())?;
            Ok(Var::from_tensor(&part.reshape(&tensor.shape[..])?)?.into_inner())
        };
        self.networks.shape().tensors().iter().map(leaf).collect()
    }
}
