//! Exports a policy as an ONNX model, for other programs.

use treadmill_proto::onnx::{Layer, OnnxPolicy};

use crate::exported::ExportedPolicy;

/// Returns the bytes of an ONNX file: normalisation, the actor's layers and the range of each motor. Metadata entries
/// `treadmill.*` name the observation, the motors and the duration of a control step.
#[must_use]
pub fn to_onnx(policy: &ExportedPolicy) -> Vec<u8> {
    let normaliser = policy.normaliser();
    let part = |range: std::ops::Range<usize>| &policy.parameters[range];
    let layers = policy.shape.actor();
    let metadata = [
        ("observation", policy.observation.kind.clone()),
        ("action", policy.action.names.join(",")),
        ("control_step_s", policy.control_step_s.to_string()),
    ];
    OnnxPolicy {
        mean: &normaliser.mean[..policy.shape.seen_by_actor()],
        inverse_std: &normaliser.inverse_std[..policy.shape.seen_by_actor()],
        clip: normaliser.clip,
        layers: layers.iter().map(|dense| Layer { weight: part(dense.weight()), bias: part(dense.bias()) }).collect(),
        low: &policy.action.low,
        high: &policy.action.high,
        metadata: metadata.map(|(key, value)| (format!("treadmill.{key}"), value)).to_vec(),
    }
    .encode()
}
