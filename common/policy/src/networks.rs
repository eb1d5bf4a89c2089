//! Which implementation of the networks runs: the fused one on a CPU, plain operations on anything else.

use std::sync::Arc;

use candle_core::{Device, Result, Tensor};
use rayon::ThreadPool;

use super::{FusedNetworks, NetworkShape, plain};

/// Which of the networks a computation needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Both: the output is `[rows, action + 1]`, action means and then the value.
    ActorCritic,
    /// The output is `[rows, action]`.
    Actor,
    /// The output is `[rows, 1]`.
    Critic,
}

/// Networks over one flat parameter vector, for one kind of device.
#[derive(Clone, Debug)]
pub enum Networks {
    /// One operation with its own gradient; CPU only.
    Fused(FusedNetworks),
    /// Candle's own operations and gradients, on any device.
    Plain(NetworkShape, Part),
}

impl Networks {
    /// The fastest that `device` runs; the threads of `pool` are for a CPU.
    pub fn on(device: &Device, shape: &NetworkShape, part: Part, pool: Option<Arc<ThreadPool>>) -> Self {
        if !device.is_cpu() {
            return Self::Plain(shape.clone(), part);
        }
        Self::Fused(match part {
            Part::ActorCritic => FusedNetworks::actor_critic(shape, pool),
            Part::Actor => FusedNetworks::actor(shape, pool),
            Part::Critic => FusedNetworks::critic(shape, pool),
        })
    }

    /// Applies them to `observations`, `[rows, observation]`; `parameters` is the flat vector, on the same device.
    ///
    /// # Errors
    /// If a tensor has another shape or is on another device.
    pub fn forward(&self, parameters: &Tensor, observations: &Tensor) -> Result<Tensor> {
        match self {
            Self::Fused(networks) => networks.forward(parameters, observations),
            Self::Plain(shape, Part::ActorCritic) => plain::actor_critic(shape, parameters, observations),
            Self::Plain(shape, Part::Actor) => plain::network(&shape.actor(), parameters, observations),
            Self::Plain(shape, Part::Critic) => plain::network(&shape.critic(), parameters, observations),
        }
    }
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    use super::*;
    use crate::init::initial_parameters;

    #[test]
    fn a_cpu_gets_the_fused_networks_and_plain_ones_say_the_same() -> Result<()> {
        let shape = NetworkShape { observation: 5, action: 3, hidden: vec![16, 8] };
        let parameters = initial_parameters(&shape, -0.5, &mut Xoshiro256PlusPlus::seed_from_u64(3));
        let parameters = Tensor::new(&parameters[..], &Device::Cpu)?;
        let observations = Tensor::from_vec((0..35).map(|i| (i as f32).sin()).collect(), (7, 5), &Device::Cpu)?;
        for (part, width) in [(Part::ActorCritic, 4), (Part::Actor, 3), (Part::Critic, 1)] {
            let chosen = Networks::on(&Device::Cpu, &shape, part, None);
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
