//! Chooses the implementation of the networks: fused on a CPU, plain elsewhere.

use std::sync::Arc;

use candle_core::{Device, Result, Tensor};
use rayon::ThreadPool;

use super::{FusedNetworks, NetworkShape, plain};

/// Networks that a computation needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetworkPart {
    /// Both; the output is `[rows, action + 1]`: action means, then the value.
    ActorCritic,
    /// Actor; the output is `[rows, action]`.
    Actor,
    /// Critic; the output is `[rows, 1]`.
    Critic,
}

/// Networks over one flat parameter vector, on one device.
#[derive(Clone, Debug)]
pub enum Networks {
    /// One operation with its own gradient; CPU only.
    Fused(FusedNetworks),
    /// Candle's operations and gradients; any device.
    Plain(NetworkShape, NetworkPart),
}

impl Networks {
    /// Returns the fastest implementation for `device`. A CPU uses the threads of `pool`.
    pub fn on(device: &Device, shape: &NetworkShape, part: NetworkPart, pool: Option<Arc<ThreadPool>>) -> Self {
        match device.is_cpu() {
            true => Self::Fused(FusedNetworks::new(shape, part, pool)),
            false => Self::Plain(shape.clone(), part),
        }
    }

    /// Applies the networks to `observations`, `[rows, observation]`; `parameters` is the flat vector, on the same device.
    ///
    /// # Errors
    /// If a tensor has the wrong shape or device.
    pub fn forward(&self, parameters: &Tensor, observations: &Tensor) -> Result<Tensor> {
        match self {
            Self::Fused(networks) => networks.forward(parameters, observations),
            Self::Plain(shape, NetworkPart::ActorCritic) => plain::actor_critic(shape, parameters, observations),
            Self::Plain(shape, NetworkPart::Actor) => plain::network(&shape.actor(), parameters, observations),
            Self::Plain(shape, NetworkPart::Critic) => plain::network(&shape.critic(), parameters, observations),
        }
    }
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    use super::*;
    use crate::init::initial_parameters;

    #[test]
    fn a_cpu_uses_the_fused_networks_and_they_agree_with_the_plain_ones() -> Result<()> {
        for privileged in [0, 2] {
            check_agreement(&NetworkShape { observation: 5, action: 3, hidden: vec![16, 8], privileged })?;
        }
        Ok(())
    }

    fn check_agreement(shape: &NetworkShape) -> Result<()> {
        let parameters = initial_parameters(shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(3));
        let parameters = Tensor::new(&parameters[..], &Device::Cpu)?;
        let observations = Tensor::from_vec((0..35).map(|i| (i as f32).sin()).collect(), (7, 5), &Device::Cpu)?;
        for (part, width) in [(NetworkPart::ActorCritic, 4), (NetworkPart::Actor, 3), (NetworkPart::Critic, 1)] {
            let chosen = Networks::on(&Device::Cpu, shape, part, None);
            assert!(matches!(chosen, Networks::Fused(_)));
            let fused = chosen.forward(&parameters, &observations)?;
            let plain = Networks::Plain(shape.clone(), part).forward(&parameters, &observations)?;
            assert_eq!(fused.dims(), [7, width]);
            let off = (fused - plain)?.abs()?.max_all()?.to_scalar::<f32>()?;
            assert!(off < 1e-6, "{part:?}: {off}");
        }
        Ok(())
    }
}
