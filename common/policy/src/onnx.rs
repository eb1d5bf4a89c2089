//! Exports a policy as an ONNX model, for other programs.

use treadmill_proto::onnx::{Layer, OnnxMotion, OnnxOffset, OnnxPolicy, Ports};

use crate::exported::{ActionFacts, ExportedPolicy};

/// What a model has for the controller of a robot.
#[derive(Clone, Debug)]
pub struct ForController {
    /// Largest action, in the unit of action of each joint; replaces the ranges of the motors, if there is one.
    pub action_limit: Option<f32>,
    /// Input and output of the model.
    pub ports: Ports,
    /// Motion that the policy imitates.
    pub motion: Option<OnnxMotion>,
    /// What is added to the actions.
    pub offset: Option<OnnxOffset>,
    /// Metadata entries beside `treadmill.*`.
    pub metadata: Vec<(String, String)>,
}

/// Returns the bytes of an ONNX file: normalisation, the actor's layers and the range of each action. Metadata entries
/// `treadmill.*` name the observation, the motors and the duration of a control step. Actions are in the units of the
/// motors, or in those of a controller.
#[must_use]
pub fn to_onnx(policy: &ExportedPolicy, controller: Option<&ForController>) -> Vec<u8> {
    let normaliser = policy.normaliser();
    let part = |range: std::ops::Range<usize>| &policy.parameters[range];
    let layers = policy.shape.actor();
    let metadata = [
        ("observation", policy.observation.kind.clone()),
        ("action", policy.action.names.join(",")),
        ("control_step_s", policy.control_step_s.to_string()),
    ];
    let metadata = metadata.map(|(key, value)| (format!("treadmill.{key}"), value)).into_iter();
    let (low, high, doc) = match controller.and_then(|of| of.action_limit) {
        None => {
            let ActionFacts { low, high, .. } = &policy.action;
            (low.clone(), high.clone(), "raw observations to actions in the units of the motors")
        }
        Some(action_limit) => {
            let high = vec![action_limit; policy.shape.action];
            (high.iter().map(|end| -end).collect(), high, "raw observations to actions in units of action_scale")
        }
    };
    OnnxPolicy {
        mean: &normaliser.mean[..policy.shape.seen_by_actor()],
        inverse_std: &normaliser.inverse_std[..policy.shape.seen_by_actor()],
        clip: normaliser.clip,
        layers: layers.iter().map(|dense| Layer { weight: part(dense.weight()), bias: part(dense.bias()) }).collect(),
        low: &low,
        high: &high,
        ports: controller.map_or(Ports::ANY_BATCH, |of| of.ports),
        offset: controller.and_then(|of| of.offset.as_ref()),
        motion: controller.and_then(|of| of.motion.as_ref()),
        doc,
        metadata: metadata.chain(controller.iter().flat_map(|of| of.metadata.clone())).collect(),
    }
    .encode()
}
