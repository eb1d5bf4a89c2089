//! TensorBoard's event messages, and those of its HPARAMS tab: the parts of its schemas that scalars, texts, histograms
//! and hyperparameters need. They go to files and never to the bus.

use prost::Message;

use crate::Malformed;

pub use crate::wire_tensorboard::{
    Dim, Event, Experiment, HparamInfo, HparamValue, HparamsData, Metadata, MetricInfo, MetricName, PluginData,
    SessionEnd, SessionLog, SessionStart, Shape, Summary, Tensor, Value, hparam_value, hparams_data,
};

impl Event {
    /// Protobuf bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Reads protobuf bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Malformed> {
        Self::decode(bytes).map_err(|why| Malformed::Undecodable { what: "event", why: why.to_string() })
    }
}

impl HparamsData {
    /// Protobuf bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }
}
