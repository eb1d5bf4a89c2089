//! Model texts: values read from them, and refusals.

mod actuators;
mod assets;
mod automatic;
mod cards;
mod composed;
mod contacts;
mod equalities;
mod files;
mod joints;
mod refusals;
mod support;
mod urdf;
mod values;
