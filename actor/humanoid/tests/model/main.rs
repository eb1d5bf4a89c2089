//! Model texts: what is read out of them, and which are refused.

mod figures;
mod refusals;
