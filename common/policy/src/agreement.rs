//! Compares the fused networks with the plain ones on this processor.

use candle_core::{Device, Result, Tensor};

use super::{NetworkPart, NetworkShape, Networks, init::initial_parameters};
use treadmill_runtime::seeds;

/// Rows of the comparison: more than one chunk, and not a multiple of a vector register's width.
const ROWS: usize = 333;

/// Returns the largest difference between both outputs of a newly initialised actor and critic over [`ROWS`] observations;
/// infinite if an output is not finite.
///
/// # Errors
/// If the networks cannot be computed.
pub fn largest_difference(shape: &NetworkShape) -> Result<f32> {
    let parameters = initial_parameters(shape, -0.5, &mut seeds::stream(1, "agreement", &[]));
    let parameters = Tensor::new(&parameters[..], &Device::Cpu)?;
    let numbers: Vec<f32> = (0..ROWS * shape.observation).map(|index| (index as f32 * 0.7).sin() * 3.0).collect();
    let observations = Tensor::from_vec(numbers, (ROWS, shape.observation), &Device::Cpu)?;
    let fused =
        Networks::on(&Device::Cpu, shape, NetworkPart::ActorCritic, None).forward(&parameters, &observations)?;
    let plain = Networks::Plain(shape.clone(), NetworkPart::ActorCritic).forward(&parameters, &observations)?;
    let off = (fused - plain)?.abs()?.flatten_all()?.to_vec1::<f32>()?;
    // `f32::max` would ignore NaN.
    Ok(off.into_iter().fold(0.0, |most: f32, off| if off.is_finite() { most.max(off) } else { f32::INFINITY }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_agree_up_to_rounding() {
        let off = largest_difference(&NetworkShape { observation: 45, action: 17, hidden: vec![256, 128] }).unwrap();
        assert!((0.0..1e-4).contains(&off), "{off}");
    }
}
