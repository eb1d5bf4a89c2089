//! Flows of the bus, one file for each kind of message.

pub(crate) mod actor;
pub(crate) mod control;
pub(crate) mod copies;
pub(crate) mod evaluation;
pub(crate) mod observer;
pub(crate) mod policies;
pub(crate) mod poses;
pub(crate) mod presence;
pub(crate) mod received;
pub(crate) mod rollouts;
pub(crate) mod tasks;
