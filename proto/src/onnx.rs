//! Policy as an ONNX model: its input is raw observations, its output actions between a lowest and a highest one.
//!
//! ```text
//! input ─ Sub mean ─ Mul 1/std ─ Clip ─ (Gemm ─ Elu)… ─ Gemm ─ Clip ±1 ─ Mul half ─ Add centre ─ Add ─ output
//!   └─ Sub itself ─ ReduceSum ────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! The second way is 0, but NaN if an entry is NaN or infinite. Many runtimes turn NaN into a bound of Clip, and a broken
//! sensor into a confident action.
//!
//! Operators are those of operator set 13, which current runtimes support. Input and output are `[batch, width]`, see
//! [`Ports`].

use bytes::Bytes;
use prost::Message;

use crate::{planes, wire_onnx as wire};

/// Version of the file format with operator set 13.
const IR_VERSION: i64 = 7;
const OPERATORS: i64 = 13;
const FLOAT32: i32 = 1;
const INT64: i32 = 7;

/// One dense layer, `y = W x + b`.
#[derive(Clone, Copy, Debug)]
pub struct Layer<'a> {
    /// `[output][input]`.
    pub weight: &'a [f32],
    /// `[output]`.
    pub bias: &'a [f32],
}

/// Input and output of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ports {
    /// Name of the input.
    pub input: &'static str,
    /// Name of the output.
    pub output: &'static str,
    /// Rows of both; `None` for any number.
    pub batch: Option<i64>,
}

impl Ports {
    /// Names of this project, for batches of any size.
    pub const ANY_BATCH: Self = Self { input: "observation", output: "action", batch: None };
    /// What the controllers of Unitree's `unitree_rl_lab` ask for.
    pub const UNITREE: Self = Self { input: "obs", output: "actions", batch: Some(1) };
}

/// Policy to encode as a model.
#[derive(Clone, Debug)]
pub struct OnnxPolicy<'a> {
    /// `[observation]`, subtracted first.
    pub mean: &'a [f32],
    /// `[observation]`, multiplied second.
    pub inverse_std: &'a [f32],
    /// Bound of normalised observations.
    pub clip: f32,
    /// Layers from the observation to the action, with ELU between them.
    pub layers: Vec<Layer<'a>>,
    /// `[action]`: action at policy output −1.
    pub low: &'a [f32],
    /// `[action]`: action at policy output 1.
    pub high: &'a [f32],
    /// Input and output.
    pub ports: Ports,
    /// What the model turns into what, for readers.
    pub doc: &'a str,
    /// Names and values of the model's metadata.
    pub metadata: Vec<(String, String)>,
}

impl OnnxPolicy<'_> {
    /// Encodes the model file. Equal policies give equal bytes.
    #[must_use]
    pub fn encode(&self) -> Vec<u8> {
        let mut graph = Graph::default();
        graph.constant("observation_mean", &[self.mean.len()], self.mean);
        graph.constant("observation_inverse_std", &[self.inverse_std.len()], self.inverse_std);
        let Ports { input, output, batch } = self.ports;
        let x = graph.node("Sub", &[input, "observation_mean"], "centred", &[]);
        let x = graph.node("Mul", &[&x, "observation_inverse_std"], "scaled", &[]);
        let mut x = graph.clip(&x, "normalised", -self.clip, self.clip);
        for (number, Layer { weight, bias }) in self.layers.iter().enumerate() {
            let (outputs, inputs) = (bias.len(), weight.len() / bias.len().max(1));
            let names = [format!("actor.{number}.weight"), format!("actor.{number}.bias")];
            graph.constant(&names[0], &[outputs, inputs], weight);
            graph.constant(&names[1], &[outputs], bias);
            x = graph.node("Gemm", &[&x, &names[0], &names[1]], &format!("dense.{number}"), &[whole("transB", 1)]);
            if number + 1 < self.layers.len() {
                x = graph.node("Elu", &[&x], &format!("hidden.{number}"), &[]);
            }
        }
        let x = graph.clip(&x, "share", -1.0, 1.0);
        let ranges = || self.low.iter().zip(self.high);
        let centre: Vec<f32> = ranges().map(|(low, high)| f32::midpoint(*low, *high)).collect();
        let half: Vec<f32> = ranges().map(|(low, high)| high / 2.0 - low / 2.0).collect();
        graph.constant("action_half", &[half.len()], &half);
        graph.constant("action_centre", &[centre.len()], &centre);
        let x = graph.node("Mul", &[&x, "action_half"], "stretched", &[]);
        let x = graph.node("Add", &[&x, "action_centre"], "bounded", &[]);
        graph.tensor("entries", &[1], INT64, 1_i64.to_le_bytes().to_vec().into());
        let zeros = graph.node("Sub", &[input, input], "zeros", &[]);
        let fault = graph.node("ReduceSum", &[&zeros, "entries"], "fault", &[whole("keepdims", 1)]);
        graph.node("Add", &[&x, &fault], output, &[]);
        let model = wire::ModelProto {
            ir_version: IR_VERSION,
            producer_name: "treadmill".to_string(),
            producer_version: env!("CARGO_PKG_VERSION").to_string(),
            doc_string: self.doc.to_string(),
            opset_import: vec![wire::OperatorSetIdProto { domain: String::new(), version: OPERATORS }],
            graph: Some(wire::GraphProto {
                node: graph.nodes,
                name: "policy".to_string(),
                initializer: graph.constants,
                input: vec![port(input, batch, self.mean.len())],
                output: vec![port(output, batch, self.low.len())],
            }),
            metadata_props: self
                .metadata
                .iter()
                .map(|(key, value)| wire::StringStringEntryProto { key: key.clone(), value: value.clone() })
                .collect(),
        };
        model.encode_to_vec()
    }
}

#[derive(Default)]
struct Graph {
    nodes: Vec<wire::NodeProto>,
    constants: Vec<wire::TensorProto>,
}

impl Graph {
    fn constant(&mut self, name: &str, shape: &[usize], numbers: &[f32]) {
        self.tensor(name, shape, FLOAT32, planes::to_bytes(numbers));
    }

    fn tensor(&mut self, name: &str, shape: &[usize], data_type: i32, raw_data: Bytes) {
        let dims = shape.iter().map(|length| *length as i64).collect();
        self.constants.push(wire::TensorProto { dims, data_type, name: name.to_string(), raw_data });
    }

    /// Adds an operation; returns the name of its output.
    fn node(&mut self, operator: &str, inputs: &[&str], output: &str, attributes: &[wire::AttributeProto]) -> String {
        self.nodes.push(wire::NodeProto {
            input: inputs.iter().map(ToString::to_string).collect(),
            output: vec![output.to_string()],
            name: output.to_string(),
            op_type: operator.to_string(),
            attribute: attributes.to_vec(),
        });
        output.to_string()
    }

    fn clip(&mut self, input: &str, output: &str, low: f32, high: f32) -> String {
        let names = [format!("{output}_min"), format!("{output}_max")];
        self.constant(&names[0], &[], &[low]);
        self.constant(&names[1], &[], &[high]);
        self.node("Clip", &[input, &names[0], &names[1]], output, &[])
    }
}

/// Returns an attribute that is a whole number.
fn whole(name: &str, i: i64) -> wire::AttributeProto {
    let r#type = wire::attribute_proto::AttributeType::Int.into();
    wire::AttributeProto { name: name.to_string(), i, r#type, ..Default::default() }
}

/// Returns an input or output of shape `[batch, width]`.
fn port(name: &str, batch: Option<i64>, width: usize) -> wire::ValueInfoProto {
    use wire::tensor_shape_proto::{Dimension, dimension::Value};
    let batch = batch.map_or_else(|| Value::DimParam("batch".to_string()), Value::DimValue);
    let dim = [batch, Value::DimValue(width as i64)];
    let shape = wire::TensorShapeProto { dim: dim.map(|value| Dimension { value: Some(value) }).to_vec() };
    let tensor = wire::type_proto::Tensor { elem_type: FLOAT32, shape: Some(shape) };
    wire::ValueInfoProto {
        name: name.to_string(),
        r#type: Some(wire::TypeProto { tensor_type: Some(tensor) }),
        doc_string: String::new(),
    }
}

#[cfg(test)]
#[path = "onnx_tests.rs"]
mod tests;
