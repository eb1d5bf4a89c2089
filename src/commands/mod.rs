//! Subcommands: each module has the flags of its command and a function `run`.
//!
//! # Layout
//! - Training: [`train`], [`sweep`], [`learner`], [`actor`], [`evaluator`], [`router`], [`certs`].
//! - While a run trains: [`status`], [`control`].
//! - Trained policies: [`eval`], [`watch`], [`export`], [`runs`].
//! - Robots: [`robot`], [`motion`].
//! - Machine and program: [`check`], [`bench`], [`config`], [`manual`] (`completions`, `man`, `reference`).

pub(crate) mod actor;
pub(crate) mod bench;
pub(crate) mod certs;
pub(crate) mod check;
pub(crate) mod config;
pub(crate) mod control;
pub(crate) mod eval;
pub(crate) mod evaluator;
pub(crate) mod export;
pub(crate) mod learner;
pub(crate) mod manual;
pub(crate) mod motion;
pub(crate) mod robot;
pub(crate) mod router;
pub(crate) mod runs;
pub(crate) mod status;
pub(crate) mod sweep;
pub(crate) mod train;
pub(crate) mod watch;
