//! Policies on their way from the learner to actors, and to other programs.
//!
//! - [`announcements`]: which version is the newest.
//! - [`server`]: serves the newest policy, as a learner. [`pieces`]: in pieces, as a learner and as a router.
//! - [`fetch`]: asks for the policy, and puts the pieces together.
//! - [`cache`]: policies in a router. [`silences`]: learners that do not answer it.
//! - [`standby_mark`]: a learner that only follows says so.

pub mod announcements;
pub mod cache;
pub mod fetch;
pub mod pieces;
pub mod server;
mod silences;
pub mod standby_mark;
