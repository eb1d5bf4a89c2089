//! Model texts: values read from them, and refusals.

mod refusals;
mod values;
