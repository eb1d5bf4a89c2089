//! Sessions and flows of the message bus. No other crate depends on Zenoh.
//!
//! Rollouts and policies are queries, because a publication also succeeds when no subscriber receives it. Announcements,
//! statistics and metrics are publications, which the bus may drop. Callbacks never wait for a receiver: each one puts its
//! message into a bounded queue. Replies never wait for a requester that does not read: see `session`.
//!
//! # Layout
//! - [`learner`], [`actor`], [`observer`]: what each side of the bus needs.
//! - `flows`: sends and receives; one file for each kind of message, with its key and both of its ends. A new one adds its
//!   file, and its names to one of the sides in `flows/mod.rs`. With certificates, only learners and routers may use it
//!   until `session/access_rules.rs` allows it to others.
//! - `session`: opens sessions; builds Zenoh's configuration, endpoints and access rules. `role`: who may be on the bus.
//! - `admission`: decides which fragments are admitted, so that floods disturb no other sender.
//! - [`workarounds`]: code that exists only because of a fault in Zenoh.

mod admission;
mod error;
mod flows;
mod role;
mod session;
pub mod workarounds;

pub use admission::tls_rejections::log_tls_rejections;
pub use error::BusError;
pub use flows::{actor, learner, observer};
pub use role::Role;
pub use session::{
    Bus, BusOptions,
    access_rules::{AdmittedPool, Credentials},
    endpoint,
};
