//! Motion that a robot is to imitate: poses at a constant rate.

/// Numbers of the root in a frame: position x, y, z (m), quaternion w, x, y, z.
const ROOT: usize = 7;
/// Fewest frames of a motion.
const FRAMES_MIN: usize = 3;
/// Longest motion (s).
const DURATION_MAX_S: f64 = 1200.0;
/// Lowest and highest rate (1/s).
const RATES_HZ: [f64; 2] = [1.0, 1000.0];
/// Greatest difference of a quaternion's length from 1: files round, and some were interpolated without normalising.
const LENGTH_ERROR_MAX: f64 = 0.02;
/// Greatest angle (rad), and distance from the origin (m).
const ANGLE_MAX_RAD: f32 = 100.0;
const DISTANCE_MAX_M: f32 = 1000.0;

/// Most names in a message, and most characters of each.
const NAMED_MAX: usize = 8;
const NAME_CHARS_MAX: usize = 64;

/// Motion that cannot be read or does not fit the robot.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct MotionError(pub String);

/// One motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionClip {
    /// Name: that of its file without ending.
    pub name: String,
    /// Frames per second.
    pub rate_hz: f64,
    /// Names of the hinges, in the order of each frame.
    pub hinges: Vec<String>,
    /// Frames one after the other, each root position x, y, z (m), root quaternion w, x, y, z, one angle per hinge (rad).
    frames: Vec<f32>,
}

impl MotionClip {
    /// Returns a motion; quaternions are normalised.
    ///
    /// # Errors
    /// [`MotionError`] for a rate, a length or a number that no motion has.
    pub fn new(name: &str, rate_hz: f64, hinges: Vec<String>, mut frames: Vec<f32>) -> Result<Self, MotionError> {
        let fail = |problem: String| Err(MotionError(problem));
        let [low_hz, high_hz] = RATES_HZ;
        if !(low_hz..=high_hz).contains(&rate_hz) {
            return fail(format!("its rate is {rate_hz} frames per second; allowed: {low_hz} to {high_hz}"));
        }
        let width = ROOT + hinges.len();
        let count = frames.len() / width;
        if count * width != frames.len() || count < FRAMES_MIN {
            return fail(format!("it has {count} frames; at least {FRAMES_MIN} are needed"));
        }
        let duration_s = (count - 1) as f64 / rate_hz;
        if duration_s > DURATION_MAX_S {
            return fail(format!(
                "it lasts {duration_s:.0} s; allowed: {DURATION_MAX_S:.0} s, so cut it into parts, or check its rate"
            ));
        }
        for (number, frame) in frames.chunks_exact_mut(width).enumerate() {
            let at = || format!("frame {number}, at {:.2} s", number as f64 / rate_hz);
            if let Some(place) = frame.iter().position(|entry| !entry.is_finite()) {
                return fail(format!("{}: entry {place} is not a finite number", at()));
            }
            let quaternion = &mut frame[3..ROOT];
            let length = quaternion.iter().map(|part| f64::from(*part).powi(2)).sum::<f64>().sqrt();
            if (length - 1.0).abs() > LENGTH_ERROR_MAX {
                return fail(format!("{}: the quaternion of the root has length {length:.3}, but must have 1", at()));
            }
            quaternion.iter_mut().for_each(|part| *part = (f64::from(*part) / length) as f32);
            if frame[..3].iter().any(|place| place.abs() > DISTANCE_MAX_M) {
                return fail(format!(
                    "{}: the root is farther than {DISTANCE_MAX_M} m from the origin; use metres",
                    at()
                ));
            }
            if let Some(hinge) = frame[ROOT..].iter().position(|angle| angle.abs() > ANGLE_MAX_RAD) {
                let (angle, name) = (frame[ROOT + hinge], &hinges[hinge]);
                return fail(format!("{}: the angle of `{name}` is {angle}; angles are in rad", at()));
            }
        }
        Ok(Self { name: name.to_owned(), rate_hz, hinges, frames })
    }

    /// Returns the number of frames.
    #[must_use]
    pub fn len(&self) -> usize {
        self.frames.len() / (ROOT + self.hinges.len())
    }

    /// Returns whether there is no frame, which is never so.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Returns the time from the first frame to the last one (s).
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        (self.len() - 1) as f64 / self.rate_hz
    }

    /// Returns the frames.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = &[f32]> {
        self.frames.chunks_exact(ROOT + self.hinges.len())
    }

    /// Returns the motion with its hinges in the order of these names, which may be those of the held hinges too.
    ///
    /// # Errors
    /// [`MotionError`] if the names are others.
    pub fn in_order_of(&self, hinges: &[String]) -> Result<Self, MotionError> {
        if *hinges == *self.hinges {
            return Ok(self.clone());
        }
        let missing = |of: &[String], from: &[String]| -> Vec<String> {
            let missing = of.iter().filter(|name| !from.contains(name)).take(NAMED_MAX);
            missing.map(|name| format!("`{}`", name.chars().take(NAME_CHARS_MAX).collect::<String>())).collect()
        };
        let (not_here, not_there) = (missing(hinges, &self.hinges), missing(&self.hinges, hinges));
        if !not_here.is_empty() || !not_there.is_empty() {
            let mut parts = Vec::new();
            if !not_here.is_empty() {
                parts.push(format!("the motion lacks the robot's hinges {}", not_here.join(", ")));
            }
            if !not_there.is_empty() {
                parts.push(format!("the robot lacks the motion's hinges {}", not_there.join(", ")));
            }
            return Err(MotionError(parts.join("; ")));
        }
        let place = |name: &String| self.hinges.iter().position(|own| own == name).unwrap_or_default();
        let order: Vec<usize> = hinges.iter().map(place).collect();
        let moved = |frame: &[f32]| -> Vec<f32> {
            let angles = order.iter().map(|place| frame[ROOT + place]);
            frame[..ROOT].iter().copied().chain(angles).collect()
        };
        Ok(Self { hinges: hinges.to_vec(), frames: self.frames().flat_map(moved).collect(), ..self.clone() })
    }
}
