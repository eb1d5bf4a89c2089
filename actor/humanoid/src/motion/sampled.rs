//! A motion at the rate of control.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{MotionClip, ROOT};

/// Poses and velocities of a motion, one for each control step.
///
/// Positions and angles between frames are those of the cubic polynomial through four frames (Catmull and Rom 1974), and
/// orientations those of spherical interpolation. Velocities are central differences over two control steps, one-sided at
/// the ends, without smoothing: for a component that swings with angular frequency w their error is a share of
/// (w · step)²/6, 0.7 % at 1.6 Hz and steps of 20 ms.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledMotion {
    /// Position vectors, see [`crate::Physics::position`].
    pub positions: Vec<Vec<f64>>,
    /// Velocity vectors, see [`crate::Physics::velocity`].
    pub velocities: Vec<Vec<f64>>,
}

impl SampledMotion {
    /// Returns a motion at control steps of this length (s).
    #[must_use]
    pub fn new(motion: &MotionClip, step_s: f64) -> Self {
        let frames: Vec<Vec<f64>> =
            motion.frames().map(|frame| frame.iter().map(|number| f64::from(*number)).collect()).collect();
        // The last frame counts although its time may be rounded.
        let count = (motion.duration_s() / step_s + 1e-6).floor() as usize + 1;
        let positions: Vec<_> = (0..count).map(|step| at(&frames, step as f64 * step_s * motion.rate_hz)).collect();
        let velocities = (0..count)
            .map(|step| {
                let (before, after) = (step.saturating_sub(1), (step + 1).min(count - 1));
                let span_s = (after - before).max(1) as f64 * step_s;
                rates(&positions[before], &positions[step], &positions[after], span_s)
            })
            .collect();
        Self { positions, velocities }
    }
}

/// Returns the pose at a place between frames.
fn at(frames: &[Vec<f64>], place: f64) -> Vec<f64> {
    let last = frames.len() - 1;
    let first = (place.floor().max(0.0) as usize).min(last);
    let share = place - first as f64;
    if share < 1e-9 || first == last {
        return frames[first].clone();
    }
    let [before, from, to, after] =
        [first.saturating_sub(1), first, first + 1, (first + 2).min(last)].map(|frame| &frames[frame]);
    // Frames between the two by which the slope at each end is taken: one beside the first and the last frame.
    let span = [if first == 0 { 1.0 } else { 2.0 }, if first + 1 == last { 1.0 } else { 2.0 }];
    let (square, cube) = (share * share, share * share * share);
    let mut pose: Vec<f64> = (0..from.len())
        .map(|entry| {
            let start = (to[entry] - before[entry]) / span[0];
            let end = (after[entry] - from[entry]) / span[1];
            (2.0 * cube - 3.0 * square + 1.0) * from[entry]
                + (cube - 2.0 * square + share) * start
                + (3.0 * square - 2.0 * cube) * to[entry]
                + (cube - square) * end
        })
        .collect();
    let turned = rotation(from).try_slerp(&rotation(to), share, 1e-9).unwrap_or_else(|| rotation(to));
    pose[3..ROOT].copy_from_slice(&[turned.w, turned.i, turned.j, turned.k]);
    pose
}

/// Returns the velocity vector of a pose, between two others that are this far apart in time.
fn rates(before: &[f64], pose: &[f64], after: &[f64], span_s: f64) -> Vec<f64> {
    let turned: Vector3<f64> = (rotation(after) * rotation(before).inverse()).scaled_axis() / span_s;
    let local = rotation(pose).inverse_transform_vector(&turned);
    let differences = after.iter().zip(before).map(|(after, before)| (after - before) / span_s);
    let linear: Vec<f64> = differences.clone().take(3).collect();
    linear.into_iter().chain(local.iter().copied()).chain(differences.skip(ROOT)).collect()
}

fn rotation(pose: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(pose[3], pose[4], pose[5], pose[6]))
}
