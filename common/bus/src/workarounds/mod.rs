//! Code that exists only because of a fault in Zenoh 1.10. Each file names the upstream issue, if one is known, and the
//! condition under which it can be deleted.
//!
//! - [`threads`] and [`one_core`]: an encrypted link breaks if two threads use it at once (zenoh#2557).
//! - `open_files`: Zenoh's threads panic if they cannot open a file.
//! - `discovery`: a client does not dial a discovered endpoint again.
//! - `close`: closing a session can block on a dead link (zenoh#2675).
//! - `linger`: closing a link can block on a dead peer.
//! - `redial_pause`: routers lose each other's declarations when links break together and are dialled again at once.
//! - `kept_queryables`: a router forgets to declare its queryables to new links after another one undeclared the same.
//! - `kept_routes`: routes of undeclared keys are computed for each message.

pub(crate) mod close;
pub(crate) mod discovery;
pub(crate) mod kept_queryables;
pub(crate) mod kept_routes;
pub(crate) mod linger;
pub mod one_core;
pub(crate) mod open_files;
pub(crate) mod redial_pause;
pub mod threads;
