//! Messages between processes: schemas, encoding and limits. No I/O, no tensors, no async.
//!
//! # Layout
//! - [`wire`]: structures generated from `schema/*.proto`.
//! - [`fragment`]: rollout fragments, checked on both sides.
//! - [`precision`]: precision of observations on the wire.
//! - [`prepared`]: one encoded fragment sent under many names.
//! - [`bundle`]: policy bundles and their announcements.
//! - [`policy_pieces`]: conditional requests for the newest policy, answered in pieces.
//! - [`actor_state`]: complete state of an actor, for deterministic runs.
//! - [`receipt`]: answers of the learner to fragments.
//! - [`version`]: versions of a policy.
//! - [`stats`]: statistics of an actor.
//! - [`pool`]: what runs want of actors that belong to none.
//! - [`pose`]: poses of an actor's body.
//! - [`page`]: messages of the page in the browser.
//! - [`task`]: registration of external tasks.
//! - [`evaluation`]: results of evaluations.
//! - [`control`]: commands to a learner, and its status.
//! - [`json`]: objects on the JSON topics.
//! - [`event_file`]: messages of TensorBoard's event files.
//! - [`onnx`]: policies as ONNX models.
//! - [`ident`]: names that are valid in a bus key.
//! - [`limits`]: size limits, checked before decoding.
//!
//! Received messages are hostile until checked: size first, then shape, then numbers.

/// Builds a message from the fields that it shares with another, taken or cloned, and from others that are given.
macro_rules! message {
    ($($to:ident)::+, $from:ident [$($field:ident),*], { $($other:ident: $value:expr),* $(,)? }) => {
        $($to)::+ { $($field: $from.$field,)* $($other: $value,)* }
    };
    ($($to:ident)::+, clone $from:ident [$($field:ident),*], { $($other:ident: $value:expr),* $(,)? }) => {
        $($to)::+ { $($field: Clone::clone(&$from.$field),)* $($other: $value,)* }
    };
}

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
pub mod page;
pub mod policy_pieces;
pub mod pool;
pub mod pose;
pub mod precision;
pub mod prepared;
pub mod receipt;
pub mod reward_term;
pub mod stats;
pub mod task;
pub mod version;

mod mirror;
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
pub use bundle::{PolicyAnnouncement, PolicyBundle};
pub use control::{ActorStatus, Command, ControlReply, ControlRequest, PartTime, Phase, RunStatus};
pub use evaluation::EvaluationReport;
pub use fragment::{EndCause, Episode, Fragment};
pub use policy_pieces::{PolicyPiece, PolicyRequest};
pub use pool::{PoolAnswer, PoolDemand, PoolJoin};
pub use pose::Pose;
pub use precision::Precision;
pub use prepared::PreparedFragment;
pub use receipt::{Outcome, Receipt};
pub use reward_term::RewardTerm;
pub use stats::ActorStats;
pub use task::{Task, TaskReceipt, TaskRegistration};
pub use version::PolicyVersion;

/// Version of the messages and of the configuration keys that actors know. Raised with each release that adds a field or
/// a key on which actors depend.
pub const WIRE_VERSION: u32 = 2;

/// Refuses a message of more than `limit` bytes.
fn check_size(what: &'static str, bytes: usize, limit: usize) -> Result<(), Malformed> {
    if bytes > limit { Err(Malformed::TooLarge { what, bytes, limit }) } else { Ok(()) }
}

/// Refuses 0 and values above `max`.
fn check_range(field: &'static str, value: u32, max: u32) -> Result<(), Malformed> {
    if (1..=max).contains(&value) { Ok(()) } else { Err(Malformed::field(field, value, format!("1 to {max}"))) }
}

/// Refuses infinities and NaN; the error names the first.
fn check_finite(field: &'static str, numbers: impl IntoIterator<Item = f64>) -> Result<(), Malformed> {
    match numbers.into_iter().enumerate().find(|(_, number)| !number.is_finite()) {
        Some((index, value)) => Err(Malformed::NotFinite { field, index, value: value.to_string() }),
        None => Ok(()),
    }
}

/// Reason for which a message is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Malformed {
    /// The message is too large.
    #[error("{what} has {bytes} bytes, more than the {limit} that are allowed")]
    TooLarge {
        /// Kind of message.
        what: &'static str,
        /// Size of the message.
        bytes: usize,
        /// Limit for this kind.
        limit: usize,
    },
    /// The bytes are no valid protobuf or JSON.
    #[error("{what} cannot be decoded: {why}")]
    Undecodable {
        /// Kind of message.
        what: &'static str,
        /// Message of the decoder.
        why: String,
    },
    /// A field's value is out of range, missing or of the wrong length.
    #[error("field `{field}` is {value}; expected {expected}")]
    Field {
        /// Name of the field.
        field: &'static str,
        /// Value found.
        value: String,
        /// Values allowed.
        expected: String,
    },
    /// A number is infinite or NaN.
    #[error("field `{field}` holds {value} at index {index}; every number must be finite")]
    NotFinite {
        /// Name of the field.
        field: &'static str,
        /// Position of the number in the field.
        index: usize,
        /// Value found.
        value: String,
    },
}

impl Malformed {
    pub(crate) fn field(field: &'static str, value: impl ToString, expected: impl Into<String>) -> Self {
        Self::Field { field, value: value.to_string(), expected: expected.into() }
    }

    /// Returns the error of a field with a wrong number of entries.
    pub(crate) fn length(field: &'static str, found: usize, expected: impl Into<String>) -> Self {
        Self::field(field, format!("{found} numbers long"), expected)
    }

    /// Returns a conversion of a decoder's error.
    pub(crate) fn undecodable<E: ToString>(what: &'static str) -> impl Fn(E) -> Self {
        move |error| Self::Undecodable { what, why: error.to_string() }
    }
}
