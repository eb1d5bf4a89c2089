//! Motions that a robot is to imitate: poses at a constant rate.
//!
//! - `file`: reads the files that people have, known by their content.
//! - `csv`, `npz`: the formats.
//! - `order`: finds the order of hinges and bodies in files without names, by forward kinematics.
//! - `sampled`: poses and velocities at the rate of control.
//! - `report`: what a motion asks of a robot.

mod csv;
mod file;
mod npz;
mod order;
mod report;
mod sampled;

pub use self::file::{MotionFile, read_motion_file};
pub use self::npz::write_npz;
pub use self::report::MotionReport;
pub use self::sampled::SampledMotion;
pub use crate::model::{MotionClip, MotionError};

/// Longest file, and longest arrays of one (bytes).
pub const MOTION_FILE_BYTES_MAX: u64 = 256 << 20;
/// Numbers of the root in a frame: position x, y, z (m), quaternion w, x, y, z.
const ROOT: usize = 7;

#[cfg(test)]
mod tests;
