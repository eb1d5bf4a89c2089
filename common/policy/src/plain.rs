//! Networks from Candle's own operations and gradients, as a reference.

use candle_core::{Result, Tensor};
use candle_nn::{Activation, Linear, Module};

use super::{Dense, NetworkShape};

/// Applies actor and critic to `observations`, `[rows, observation]`. Returns `[rows, action + 1]`: action means, then the
/// value. `parameters` is the flat vector.
///
/// # Errors
/// If a tensor has the wrong shape.
pub fn actor_critic(shape: &NetworkShape, parameters: &Tensor, observations: &Tensor) -> Result<Tensor> {
    let means = network(&shape.actor(), parameters, observations)?;
    let values = network(&shape.critic(), parameters, observations)?;
    Tensor::cat(&[means, values], 1)
}

/// Applies one network to the first columns of `observations`, as many as its first layer takes. Returns `[rows,
/// outputs of the last layer]`.
///
/// # Errors
/// If a tensor has the wrong shape.
pub fn network(layers: &[Dense], parameters: &Tensor, observations: &Tensor) -> Result<Tensor> {
    let mut tensors = Vec::new();
    for layer in layers {
        let weight = parameters.narrow(0, layer.weight().start, layer.weight().len())?;
        tensors.push(weight.reshape((layer.output, layer.input))?);
        tensors.push(parameters.narrow(0, layer.bias().start, layer.output)?);
    }
    let seen = layers.first().map_or(0, |layer| layer.input);
    layered(&tensors, &observations.narrow(1, 0, seen)?)
}

/// Applies one network, given weight and bias of each layer in turn. With leaves of their own, gradients have the size
/// of their layer; the gradient of a slice would have that of the flat vector.
///
/// # Errors
/// If a tensor has the wrong shape.
pub fn layered(tensors: &[Tensor], observations: &Tensor) -> Result<Tensor> {
    let mut rows = observations.clone();
    for (i, layer) in tensors.chunks_exact(2).enumerate() {
        if i > 0 {
            rows = Activation::Elu(1.0).forward(&rows)?;
        }
        let (weight, bias) = (layer[0].clone(), layer[1].clone());
        rows = Linear::new(weight, Some(bias)).forward(&rows)?;
    }
    Ok(rows)
}
