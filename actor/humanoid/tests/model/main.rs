//! Model texts: values read from them, and refusals.

mod figures;
mod refusals;
