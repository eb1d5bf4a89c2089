//! What crosses a process boundary: schemas, encoding and limits. No I/O, no tensors, no async.
//!
//! # Layout
//! - [`wire`]: the structures generated from `schema/*.proto`.
//! - [`fragment`]: rollouts, checked on both sides.
//! - [`precision`]: how exactly observations travel.
//! - [`prepared`]: one fragment under many names.
//! - [`bundle`]: the policy that the learner hands out.
//! - [`actor_state`]: where an actor is, for deterministic runs.
//! - [`receipt`]: the learner's answer to a fragment.
//! - [`stats`]: what an actor tells about itself.
//! - [`pose`]: how an actor's body stands and moves.
//! - [`task`]: what an actor of an external task registers.
//! - [`evaluation`]: what became of a policy in an evaluation.
//! - [`control`]: what people and scripts ask a learner.
//! - [`json`]: the objects on the JSON topics.
//! - [`event_file`]: TensorBoard's messages.
//! - [`onnx`]: a policy as other programs run it.
//! - [`ident`]: names that may stand in a key.
//! - [`limits`]: what is refused before it is decoded.
//!
//! Whatever arrives is hostile until checked: size first, then shape, then numbers.

pub mod actor_state;
pub mod bundle;
pub mod control;
pub mod evaluation;
pub mod event_file;
pub mod fragment;
pub mod ident;
pub mod json;
pub mod limits;
pub mod onnx;
pub mod pose;
pub mod precision;
pub mod prepared;
pub mod receipt;
pub mod stats;
pub mod task;

mod pieces;
mod planes;
mod scan;

/// Structures generated from `schema/*.proto`.
#[allow(missing_docs, unreachable_pub, clippy::all)]
pub mod wire {
    include!(concat!(env!("OUT_DIR"), "/treadmill.v1.rs"));
}

/// Structures generated from `onnx/onnx.proto`.
#[allow(missing_docs, unreachable_pub, clippy::all)]
mod wire_onnx {
    include!(concat!(env!("OUT_DIR"), "/treadmill.onnx.rs"));
}

/// Structures generated from `tensorboard/*.proto`.
#[allow(missing_docs, unreachable_pub, clippy::all)]
mod wire_tensorboard {
    include!(concat!(env!("OUT_DIR"), "/treadmill.tensorboard.rs"));
}

pub use actor_state::ActorState;
pub use bundle::{PolicyAnnouncement, PolicyBundle, PolicyVersion};
pub use control::{ActorStatus, Command, ControlReply, ControlRequest, Phase, RunStatus};
pub use evaluation::EvaluationReport;
pub use fragment::{EndCause, Episode, Fragment};
pub use pose::Pose;
pub use precision::Precision;
pub use prepared::PreparedFragment;
pub use receipt::{Outcome, Receipt};
pub use stats::ActorStats;
pub use task::{Task, TaskReceipt, TaskRegistration};

/// Why a message was refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Malformed {
    /// Larger than its kind may be.
    #[error("{what} has {bytes} bytes, more than the {limit} that are allowed")]
    TooLarge {
        /// Which message.
        what: &'static str,
        /// Its size.
        bytes: usize,
        /// The limit.
        limit: usize,
    },
    /// No valid protobuf or JSON.
    #[error("{what} cannot be decoded: {why}")]
    Undecodable {
        /// Which message.
        what: &'static str,
        /// What the decoder said.
        why: String,
    },
    /// A field's value is out of range, missing or of the wrong length.
    #[error("field `{field}` is {value}; expected {expected}")]
    Field {
        /// The field.
        field: &'static str,
        /// What was found.
        value: String,
        /// What is allowed.
        expected: String,
    },
    /// A number that is not finite.
    #[error("field `{field}` holds {value} at index {index}; every number must be finite")]
    NotFinite {
        /// The field.
        field: &'static str,
        /// Where.
        index: usize,
        /// What was found.
        value: String,
    },
}

impl Malformed {
    pub(crate) fn field(field: &'static str, value: impl ToString, expected: impl Into<String>) -> Self {
        Self::Field { field, value: value.to_string(), expected: expected.into() }
    }
}
