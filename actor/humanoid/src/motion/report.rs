//! What a motion asks of a robot.

use super::{MotionClip, ROOT, SampledMotion};
use crate::clearance;
use crate::physics::Physics;

/// Height of the lowest part up to which it touches the ground (m).
const TOUCH_M: f64 = 0.03;
/// Rate of a hinge (rad/s), velocity (m/s) and rate of the root (rad/s) that are jumps rather than motions.
const JUMP_HINGE_RADPS: f64 = 30.0;
const JUMP_MPS: f64 = 10.0;
const JUMP_RADPS: f64 = 20.0;
/// Angle beyond a hinge's range that is worth a line (rad).
const BEYOND_RAD: f64 = 0.01;

/// Heights, speeds and faults of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionReport {
    /// Frames.
    pub frames: usize,
    /// Frames per second.
    pub rate_hz: f64,
    /// Duration (s).
    pub duration_s: f64,
    /// Lowest and highest height of the base (m).
    pub base_m: [f64; 2],
    /// Lowest and highest height above the ground of the lowest part of the robot (m); none if nothing can touch it.
    pub lowest_m: Option<[f64; 2]>,
    /// Share of the frames in which it touches the ground.
    pub touching_share: f64,
    /// Times at which it begins or ceases to touch the ground (s), with what it does.
    pub contacts_s: Vec<(f64, bool)>,
    /// Horizontal path of the base (m).
    pub path_m: f64,
    /// Greatest velocity of the base (m/s).
    pub speed_max_mps: f64,
    /// Fastest hinge, its rate (rad/s) and the time (s).
    pub fastest: (String, f64, f64),
    /// Hinges beyond their range: name, greatest angle beyond it (rad), share of the frames.
    pub beyond: Vec<(String, f64, f64)>,
    /// Jumps: time (s) and what jumps.
    pub jumps: Vec<(f64, String)>,
}

impl MotionReport {
    /// Returns the report of a motion of the robot that `physics` simulates, frame by frame.
    #[must_use]
    pub fn of(motion: &MotionClip, physics: &mut Physics) -> Self {
        let sampled = SampledMotion::new(motion, 1.0 / motion.rate_hz);
        let frames = sampled.positions.len();
        let mut report = Self {
            frames,
            rate_hz: motion.rate_hz,
            duration_s: motion.duration_s(),
            base_m: [f64::INFINITY, f64::NEG_INFINITY],
            lowest_m: None,
            touching_share: 0.0,
            contacts_s: Vec::new(),
            path_m: 0.0,
            speed_max_mps: 0.0,
            fastest: (String::new(), 0.0, 0.0),
            beyond: Vec::new(),
            jumps: Vec::new(),
        };
        let mut beyond = vec![(0.0_f64, 0_usize); motion.hinges.len()];
        let (mut touching, mut touched) = (0, None);
        for (number, (position, velocity)) in sampled.positions.iter().zip(&sampled.velocities).enumerate() {
            let time_s = number as f64 / motion.rate_hz;
            physics.set_state(position, velocity);
            report.base_m = [report.base_m[0].min(position[2]), report.base_m[1].max(position[2])];
            if let Some(height_m) = clearance::of_robot_m(physics, |_, _| 0.0) {
                let [low_m, high_m] = report.lowest_m.unwrap_or([height_m; 2]);
                report.lowest_m = Some([low_m.min(height_m), high_m.max(height_m)]);
                let touches = height_m <= TOUCH_M;
                touching += usize::from(touches);
                if touched != Some(touches) {
                    report.contacts_s.push((time_s, touches));
                }
                touched = Some(touches);
            }
            let norm = |parts: &[f64]| parts.iter().map(|part| part * part).sum::<f64>().sqrt();
            let (speed_mps, turn_radps) = (norm(&velocity[..3]), norm(&velocity[3..6]));
            report.speed_max_mps = report.speed_max_mps.max(speed_mps);
            if number > 0 {
                let before = &sampled.positions[number - 1];
                report.path_m += (position[0] - before[0]).hypot(position[1] - before[1]);
            }
            if speed_mps > JUMP_MPS || turn_radps > JUMP_RADPS {
                report.jumps.push((time_s, format!("the base, by {speed_mps:.1} m/s and {turn_radps:.1} rad/s")));
            }
            for (hinge, rate_radps) in velocity[6..].iter().map(|rate| rate.abs()).enumerate() {
                if rate_radps > report.fastest.1 {
                    report.fastest = (motion.hinges[hinge].clone(), rate_radps, time_s);
                }
                if rate_radps > JUMP_HINGE_RADPS {
                    report.jumps.push((time_s, format!("`{}`, by {rate_radps:.0} rad/s", motion.hinges[hinge])));
                }
                let over_rad = physics.model().hinges[hinge].overshoot_rad(position[ROOT + hinge]);
                if over_rad > BEYOND_RAD {
                    beyond[hinge] = (beyond[hinge].0.max(over_rad), beyond[hinge].1 + 1);
                }
            }
        }
        report.touching_share = touching as f64 / frames as f64;
        let named = motion.hinges.iter().zip(beyond).filter(|(_, (_, count))| *count > 0);
        report.beyond = named.map(|(name, (over, count))| (name.clone(), over, count as f64 / frames as f64)).collect();
        report
    }
}
