//! Parameters as safetensors bytes: f32 under the names of [`NetworkShape::tensors`].
//!
//! Equal parameters give equal bytes: only the tensors are written, in safetensors' fixed order.

use std::collections::HashMap;

use safetensors::tensor::{Dtype, SafeTensorError, SafeTensors, TensorView, serialize};

use super::{NamedTensor, NetworkShape};

/// Error of reading parameters for a network.
#[derive(Debug, thiserror::Error)]
pub enum ParameterError {
    /// The bytes are not in the safetensors format.
    #[error("the weights are not valid safetensors data")]
    Format(#[from] SafeTensorError),
    /// A tensor of the network is missing.
    #[error("the weights have no tensor {name:?} of shape {expected:?}")]
    Missing {
        /// Name of the tensor.
        name: String,
        /// Shape in the network.
        expected: Vec<usize>,
    },
    /// A tensor does not fit the network.
    #[error("tensor {name:?} has shape {found:?}, expected {expected:?}: these weights belong to another network")]
    Shape {
        /// Name of the tensor.
        name: String,
        /// Shape in the bytes.
        found: Vec<usize>,
        /// Shape in the network.
        expected: Vec<usize>,
    },
    /// A tensor has the wrong number type.
    #[error("tensor {name:?} holds {found}, expected {expected}")]
    Dtype {
        /// Name of the tensor.
        name: String,
        /// Expected type.
        expected: &'static str,
        /// Type in the bytes.
        found: String,
    },
    /// A number is infinite or not a number.
    #[error("tensor {name:?} holds {value} at index {index}; every parameter must be finite")]
    NonFinite {
        /// Name of the tensor.
        name: String,
        /// Index within the tensor, row-major.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A flat vector has the wrong length.
    #[error("{found} parameters given, the network has {expected}")]
    Count {
        /// Length of the vector.
        found: usize,
        /// Length in the network.
        expected: usize,
    },
    /// The tensor library refused an operation.
    #[error("the tensor library failed")]
    Tensor(#[from] candle_core::Error),
}

/// Checks the length of a flat parameter vector, and that all numbers are finite.
pub fn check_parameters(shape: &NetworkShape, parameters: &[f32]) -> Result<(), ParameterError> {
    let expected = shape.parameter_count();
    if parameters.len() != expected {
        return Err(ParameterError::Count { found: parameters.len(), expected });
    }
    let numbers = |tensor: &NamedTensor| parameters[tensor.range()].iter().copied().map(f64::from);
    shape.tensors().iter().try_for_each(|tensor| check_finite(&tensor.name, numbers(tensor)))
}

/// Returns the parameters as safetensors bytes.
///
/// # Panics
/// If `parameters` does not have the length of `shape`.
pub fn to_safetensors(shape: &NetworkShape, parameters: &[f32]) -> Vec<u8> {
    to_safetensors_with(shape, parameters, &[], None)
}

/// Returns the parameters of the actor, without those of the critic, as safetensors bytes.
///
/// # Panics
/// If `parameters` does not have the length of `shape`.
pub fn actor_to_safetensors(shape: &NetworkShape, parameters: &[f32]) -> Vec<u8> {
    encode(shape, &shape.actor_tensors(), parameters, &[], None)
}

/// Returns the parameters, named columns of f64 and one entry of metadata as safetensors bytes.
///
/// Only one entry, because several would be written in random order.
///
/// # Panics
/// If `parameters` does not have the length of `shape`.
pub(crate) fn to_safetensors_with(
    shape: &NetworkShape,
    parameters: &[f32],
    columns: &[(&str, &[f64])],
    metadata: Option<(&str, String)>,
) -> Vec<u8> {
    encode(shape, &shape.tensors(), parameters, columns, metadata)
}

fn encode(
    shape: &NetworkShape,
    tensors: &[NamedTensor],
    parameters: &[f32],
    columns: &[(&str, &[f64])],
    metadata: Option<(&str, String)>,
) -> Vec<u8> {
    assert_eq!(parameters.len(), shape.parameter_count(), "parameters do not fit the network");
    let bytes: Vec<u8> = parameters.iter().flat_map(|p| p.to_le_bytes()).collect();
    let weights = tensors.iter().map(|tensor| {
        let range = tensor.range();
        (tensor.name.clone(), view(Dtype::F32, tensor.shape.clone(), &bytes[range.start * 4..range.end * 4]))
    });
    let wide: Vec<(String, Vec<u8>)> = columns
        .iter()
        .map(|(name, numbers)| (name.to_string(), numbers.iter().flat_map(|x| x.to_le_bytes()).collect()))
        .collect();
    let columns = wide.iter().map(|(name, bytes)| (name.clone(), view(Dtype::F64, vec![bytes.len() / 8], bytes)));
    let metadata = metadata.map(|(key, value)| HashMap::from([(key.to_string(), value)]));
    serialize(weights.chain(columns), metadata).expect("names are unique and every view is complete")
}

fn view(dtype: Dtype, shape: Vec<usize>, bytes: &[u8]) -> TensorView<'_> {
    TensorView::new(dtype, shape, bytes).expect("the slice has the length of the shape")
}

/// Reads the flat parameter vector from safetensors bytes; ignores tensors that are not part of the network.
///
/// # Errors
/// If a tensor is missing, has the wrong shape or number type, or holds a number that is not finite.
pub fn from_safetensors(bytes: &[u8], shape: &NetworkShape) -> Result<Vec<f32>, ParameterError> {
    decode(bytes, shape, &shape.tensors())
}

/// Reads the flat parameter vector of an actor, which never evaluates the critic: parameters of the critic are 0. Ignores
/// tensors that are not part of the actor.
///
/// # Errors
/// As [`from_safetensors`].
pub fn actor_from_safetensors(bytes: &[u8], shape: &NetworkShape) -> Result<Vec<f32>, ParameterError> {
    decode(bytes, shape, &shape.actor_tensors())
}

fn decode(bytes: &[u8], shape: &NetworkShape, tensors: &[NamedTensor]) -> Result<Vec<f32>, ParameterError> {
    let file = SafeTensors::deserialize(bytes)?;
    let mut parameters = vec![0.0; shape.parameter_count()];
    for tensor in tensors {
        let data = data_of(&file, &tensor.name, &tensor.shape, Dtype::F32, "F32")?;
        let target = &mut parameters[tensor.range()];
        for (number, bytes) in target.iter_mut().zip(data.as_chunks::<4>().0) {
            *number = f32::from_le_bytes(*bytes);
        }
        check_finite(&tensor.name, target.iter().copied().map(f64::from))?;
    }
    Ok(parameters)
}

/// Reads a column of f64 from a safetensors file.
///
/// # Errors
/// If it is missing, has the wrong length or number type, or holds a number that is not finite.
pub(crate) fn column(file: &SafeTensors<'_>, name: &str, length: usize) -> Result<Vec<f64>, ParameterError> {
    let data = data_of(file, name, &[length], Dtype::F64, "F64")?;
    let numbers: Vec<f64> = data.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    check_finite(name, numbers.iter().copied())?;
    Ok(numbers)
}

/// Returns the bytes of one tensor after checking its shape and number type.
fn data_of<'a>(
    file: &SafeTensors<'a>,
    name: &str,
    shape: &[usize],
    dtype: Dtype,
    expected: &'static str,
) -> Result<&'a [u8], ParameterError> {
    let view =
        file.tensor(name).map_err(|_| ParameterError::Missing { name: name.to_string(), expected: shape.to_vec() })?;
    if view.dtype() != dtype {
        return Err(ParameterError::Dtype { name: name.to_string(), expected, found: format!("{:?}", view.dtype()) });
    }
    if view.shape() != shape {
        return Err(ParameterError::Shape {
            name: name.to_string(),
            found: view.shape().to_vec(),
            expected: shape.to_vec(),
        });
    }
    Ok(view.data())
}

fn check_finite(name: &str, numbers: impl IntoIterator<Item = f64>) -> Result<(), ParameterError> {
    match numbers.into_iter().enumerate().find(|(_, number)| !number.is_finite()) {
        None => Ok(()),
        Some((index, value)) => Err(ParameterError::NonFinite { name: name.to_string(), index, value }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape() -> NetworkShape {
        NetworkShape { observation: 3, action: 2, hidden: vec![4], privileged: 0 }
    }

    fn numbers() -> Vec<f32> {
        (0..shape().parameter_count()).map(|i| i as f32 * 0.25 - 3.0).collect()
    }

    #[test]
    fn the_actors_bytes_hold_the_actor_and_nothing_of_the_critic() {
        let bytes = actor_to_safetensors(&shape(), &numbers());
        let file = SafeTensors::deserialize(&bytes).expect("own bytes");
        assert!(file.names().iter().all(|name| name.starts_with("actor.") || *name == "log_std"), "{:?}", file.names());
        let end = shape().log_std().end;
        let expected: Vec<f32> = numbers()[..end].iter().copied().chain(vec![0.0; numbers().len() - end]).collect();
        assert_eq!(actor_from_safetensors(&bytes, &shape()).expect("own bytes"), expected);
        // A whole bundle holds the critic, too.
        let whole = to_safetensors(&shape(), &numbers());
        assert_eq!(actor_from_safetensors(&whole, &shape()).expect("own bytes"), expected);
        assert!(matches!(from_safetensors(&bytes, &shape()), Err(ParameterError::Missing { .. })));
    }

    #[test]
    fn parameters_survive_and_give_the_same_bytes_every_time() {
        let bytes = to_safetensors(&shape(), &numbers());
        assert_eq!(from_safetensors(&bytes, &shape()).expect("own bytes"), numbers());
        assert_eq!(to_safetensors(&shape(), &numbers()), bytes);
    }

    #[test]
    fn another_shape_is_refused_by_name_with_both_shapes() {
        let bytes = to_safetensors(&shape(), &numbers());
        let other = NetworkShape { observation: 7, ..shape() };
        let text = from_safetensors(&bytes, &other).expect_err("wrong shape").to_string();
        assert!(text.contains("actor.0.weight") && text.contains("[4, 3]") && text.contains("[4, 7]"), "{text}");
    }

    #[test]
    fn a_missing_tensor_is_refused_by_name() {
        let bytes = to_safetensors(&shape(), &numbers());
        let deeper = NetworkShape { hidden: vec![4, 2], ..shape() };
        let text = from_safetensors(&bytes, &deeper).expect_err("a layer is missing").to_string();
        assert!(text.contains("actor.2.weight"), "{text}");
    }

    #[test]
    fn a_number_that_is_not_finite_is_refused_by_name_and_index() {
        let mut parameters = numbers();
        parameters[shape().log_std().start + 1] = f32::NAN;
        let bytes = to_safetensors(&shape(), &parameters);
        let error = from_safetensors(&bytes, &shape()).expect_err("not finite");
        assert!(matches!(&error, ParameterError::NonFinite { name, index: 1, .. } if name == "log_std"), "{error}");
    }

    #[test]
    fn other_number_types_and_garbage_are_refused() {
        let tensor = &shape().tensors()[0];
        let bytes = vec![0_u8; tensor.len() * 8];
        let view = TensorView::new(Dtype::F64, tensor.shape.clone(), &bytes).expect("complete");
        let file = serialize([(tensor.name.clone(), view)], None).expect("one tensor");
        let error = from_safetensors(&file, &shape()).expect_err("wrong type");
        assert!(matches!(error, ParameterError::Dtype { .. }), "{error}");
        assert!(matches!(from_safetensors(b"garbage", &shape()), Err(ParameterError::Format(_))));
    }
}
