//! Messages of TensorBoard's event files and of its tabs HPARAMS and CUSTOM SCALARS, as far as a run writes them.

use prost::Message;

use crate::Malformed;

pub use crate::wire_tensorboard::{
    Chart, ChartCategory, ChartLayout, Dim, Event, Experiment, HparamInfo, HparamValue, HparamsData, Lines, Metadata,
    MetricInfo, MetricName, PluginData, SessionEnd, SessionLog, SessionStart, Shape, Summary, Tensor, Value,
    hparam_value, hparams_data,
};

impl Event {
    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Decodes protobuf bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Malformed> {
        Self::decode(bytes).map_err(Malformed::undecodable("event"))
    }
}

impl ChartLayout {
    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }
}

impl HparamsData {
    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }
}
