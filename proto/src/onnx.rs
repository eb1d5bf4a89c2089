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

use crate::{
    planes,
    wire_onnx::{self as wire, tensor_shape_proto::dimension::Value as Side},
};

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

/// Motion that a model gives out beside the action: row `time_step` of each table, or the last one.
#[derive(Clone, Debug, Default)]
pub struct OnnxMotion {
    /// Rows of each table.
    pub rows: usize,
    /// Name of an output, shape of one row, and all rows.
    pub tables: Vec<(&'static str, Vec<usize>, Vec<f32>)>,
}

/// What a model adds to its actions: the first entries of the observation, one for each action, less `centre`, divided by
/// `scale`. The sum is within the lowest and the highest action.
#[derive(Clone, Debug, PartialEq)]
pub struct OnnxOffset {
    /// `[action]`
    pub centre: Vec<f32>,
    /// `[action]`
    pub scale: Vec<f32>,
}

/// Name of the input that chooses the row of a motion, `[1, 1]`, float32 as in mjlab.
pub const TIME_STEP: &str = "time_step";

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
    /// Motion, for policies that imitate one.
    pub motion: Option<&'a OnnxMotion>,
    /// What is added to the actions.
    pub offset: Option<&'a OnnxOffset>,
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
        let x = self.offset.map_or(x.clone(), |offset| graph.offset(offset, [&x, input], [self.low, self.high]));
        graph.tensor("entries", &[1], INT64, 1_i64.to_le_bytes().to_vec().into());
        let zeros = graph.node("Sub", &[input, input], "zeros", &[]);
        let fault = graph.node("ReduceSum", &[&zeros, "entries"], "fault", &[whole("keepdims", 1)]);
        graph.node("Add", &[&x, &fault], output, &[]);
        let motion = self.motion.map(|motion| graph.motion(motion)).unwrap_or_default();
        let time_step = self.motion.map(|_| value(TIME_STEP, &[Side::DimValue(1), Side::DimValue(1)]));
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
                input: std::iter::once(port(input, batch, self.mean.len())).chain(time_step).collect(),
                output: std::iter::once(port(output, batch, self.low.len())).chain(motion).collect(),
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

    /// Adds what an offset adds to actions within these ends; returns the sum.
    fn offset(&mut self, offset: &OnnxOffset, [actions, input]: [&str; 2], [low, high]: [&[f32]; 2]) -> String {
        let OnnxOffset { centre, scale } = offset;
        let inverse: Vec<f32> = scale.iter().map(|scale| 1.0 / scale).collect();
        for (name, numbers) in [("offset_centre", centre), ("offset_inverse_scale", &inverse)] {
            self.constant(name, &[numbers.len()], numbers);
        }
        self.constant("action_low", &[low.len()], low);
        self.constant("action_high", &[high.len()], high);
        for (name, number) in [("offset_from", 0), ("offset_to", centre.len() as i64), ("offset_axis", 1)] {
            self.tensor(name, &[1], INT64, number.to_le_bytes().to_vec().into());
        }
        let x = self.node("Slice", &[input, "offset_from", "offset_to", "offset_axis"], "offset_entries", &[]);
        let x = self.node("Sub", &[&x, "offset_centre"], "offset_apart", &[]);
        let x = self.node("Mul", &[&x, "offset_inverse_scale"], "offset", &[]);
        let x = self.node("Add", &[actions, &x], "moved", &[]);
        let x = self.node("Max", &[&x, "action_low"], "moved_up", &[]);
        self.node("Min", &[&x, "action_high"], "moved_within", &[])
    }

    /// Adds the tables of a motion; returns their outputs.
    fn motion(&mut self, motion: &OnnxMotion) -> Vec<wire::ValueInfoProto> {
        let row = self.clip(TIME_STEP, "row_within", 0.0, motion.rows.saturating_sub(1) as f32);
        let row = self.node("Cast", &[&row], "row_whole", &[whole("to", INT64.into())]);
        self.tensor("row_shape", &[1], INT64, 1_i64.to_le_bytes().to_vec().into());
        let row = self.node("Reshape", &[&row, "row_shape"], "row", &[]);
        let output = |(name, shape, numbers): &(&'static str, Vec<usize>, Vec<f32>)| {
            let table = format!("motion.{name}");
            let whole_shape: Vec<usize> = std::iter::once(motion.rows).chain(shape.iter().copied()).collect();
            self.constant(&table, &whole_shape, numbers);
            self.node("Gather", &[&table, &row], name, &[whole("axis", 0)]);
            let sides: Vec<Side> =
                std::iter::once(1).chain(shape.iter().copied()).map(|side| Side::DimValue(side as i64)).collect();
            value(name, &sides)
        };
        motion.tables.iter().map(output).collect()
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
    value(
        name,
        &[batch.map_or_else(|| Side::DimParam("batch".to_string()), Side::DimValue), Side::DimValue(width as i64)],
    )
}

/// Returns an input or output of a shape.
fn value(name: &str, sides: &[Side]) -> wire::ValueInfoProto {
    use wire::tensor_shape_proto::Dimension;
    let dim = sides.iter().map(|side| Dimension { value: Some(side.clone()) }).collect();
    let shape = wire::TensorShapeProto { dim };
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
