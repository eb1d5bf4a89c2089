//! Motion files, known by their content.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::order::{Ordered, Unordered};
use super::{MOTION_FILE_BYTES_MAX, MotionClip, MotionError, ROOT, SampledMotion, csv, npz};
use crate::physics::Physics;

/// Share of frames in which a quaternion that is read in the other order would make the robot upright, from which it is
/// taken for such a one.
const UPRIGHT_SHARE: f64 = 0.9;
/// Vertical part of the base's z axis from which the robot is upright.
const UPRIGHT: f64 = 0.8;

/// Motion from a file, and what was understood.
#[derive(Clone, Debug)]
pub struct MotionFile {
    /// Motion, with its hinges in the robot's order.
    pub motion: MotionClip,
    /// Format.
    pub format: &'static str,
    /// Order of hinges and bodies in the file, and how it was found.
    pub order: String,
    /// What is ignored or unusual.
    pub notices: Vec<String>,
}

/// Reads a motion of the robot that `physics` simulates. `rate_hz` are the frames per second of a file that does not say so.
///
/// # Errors
/// [`MotionError`] names what is wrong, and the remedy.
pub fn read_motion_file(path: &Path, rate_hz: Option<f64>, physics: &mut Physics) -> Result<MotionFile, MotionError> {
    let in_file = |why: MotionError| MotionError(format!("motion file `{}`: {why}", path.display()));
    let unreadable = |why: std::io::Error| in_file(MotionError(format!("it cannot be read: {why}")));
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(MOTION_FILE_BYTES_MAX + 1).read_to_end(&mut bytes))
        .map_err(unreadable)?;
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().replace(char::is_control, " "));
    read(&bytes, &name, rate_hz, physics).map_err(in_file)
}

pub(super) fn read(
    bytes: &[u8],
    name: &str,
    rate_hz: Option<f64>,
    physics: &mut Physics,
) -> Result<MotionFile, MotionError> {
    let fail = |problem: &str| Err(MotionError(problem.to_owned()));
    if bytes.len() as u64 > MOTION_FILE_BYTES_MAX {
        return fail("it is longer than 256 MiB; cut it into parts");
    }
    let hinges = physics.model().hinges.len();
    match bytes {
        [] => fail("it is empty"),
        [b'P', b'K', 3 | 5, ..] => {
            if rate_hz.is_some() {
                return fail("it has its own rate; give none");
            }
            let archive = npz::read(bytes, hinges)?;
            let (rates, mut notices) = (archive.rates_radps, archive.notices);
            // The order of the rates is that of the angles.
            let comparison = rates.filter(|_| archive.unordered.hinge_names.is_none());
            let Ordered { motion, order } = archive.unordered.ordered(name, archive.rate_hz, physics)?;
            let is_same_order = order.starts_with("depth");
            notices.extend(comparison.filter(|_| is_same_order).and_then(|rates| differing_rates(&motion, &rates)));
            Ok(MotionFile { motion, format: archive.format, order, notices })
        }
        [0x80, 2..=5, ..] => fail(
            "it is a pickle, which may run code when it is read; GMR writes such files, and its script \
             batch_gmr_pkl_to_csv.py converts them to CSV",
        ),
        [0x93, b'N', b'U', b'M', b'P', b'Y', ..] => fail(
            "it is a single array of NumPy; a motion is an archive (npz) with fps, joint_pos, body_pos_w and body_quat_w",
        ),
        _ => {
            let Ok(text) = std::str::from_utf8(bytes) else {
                return fail("it is neither a CSV nor an archive of NumPy (npz)");
            };
            let text = text.trim_start_matches('\u{feff}');
            if text.trim_start().starts_with("HIERARCHY") {
                return fail(
                    "it is a BVH of a human; retarget it to the robot first, for example by GMR (github.com/YanjieZe/GMR)",
                );
            }
            let numbers = csv::read(text, hinges)?;
            let Some(rate_hz) = rate_hz else {
                return fail(
                    "its rate is not in the file; give it, as in --fps 30 for Unitree's retargeted LAFAN1 (--motion-fps where films have \
                     an --fps)",
                );
            };
            let rows = numbers.chunks_exact(ROOT + hinges);
            let unordered = Unordered {
                roots: rows.clone().flat_map(|row| row[..ROOT].iter().copied()).collect(),
                angles_rad: rows.flat_map(|row| row[ROOT..].iter().copied()).collect(),
                hinges,
                hinge_names: None,
                poses: None,
                body_names: None,
            };
            check_upright(&unordered.roots)?;
            let Ordered { motion, order } = unordered.ordered(name, rate_hz, physics)?;
            Ok(MotionFile { motion, format: "CSV with quaternions x, y, z, w", order, notices: Vec::new() })
        }
    }
}

/// Refuses quaternions w, x, y, z in a file in which they must be x, y, z, w: the robot would lie there, and be upright in
/// the other order.
fn check_upright(roots: &[f64]) -> Result<(), MotionError> {
    // Vertical part of the z axis of a frame turned by w, x, y, z.
    let up = |[w, x, y, z]: [f64; 4]| (w * w + z * z - x * x - y * y) / (w * w + x * x + y * y + z * z);
    let share = |up: &dyn Fn([f64; 4]) -> f64| {
        let rows = roots.chunks_exact(ROOT).map(|root| up([root[3], root[4], root[5], root[6]]));
        rows.filter(|up| *up > UPRIGHT).count() as f64 / (roots.len() / ROOT).max(1) as f64
    };
    // As read, w came last in the file. A file with w first has its w in x, x in y, y in z and z in w.
    let (as_read, turned) = (share(&up), share(&|[w, x, y, z]| up([x, y, z, w])));
    if as_read < 1.0 - UPRIGHT_SHARE && turned > UPRIGHT_SHARE {
        return Err(MotionError(
            "its quaternions seem to be w, x, y, z; in this format they are x, y, z, w, so move w behind z".to_owned(),
        ));
    }
    Ok(())
}

/// Returns a notice if the file's rates are not the derivatives of its angles.
fn differing_rates(motion: &MotionClip, rates_radps: &[f64]) -> Option<String> {
    let sampled = SampledMotion::new(motion, 1.0 / motion.rate_hz);
    let own: Vec<f64> = sampled.velocities.iter().flat_map(|velocity| velocity[6..].iter().copied()).collect();
    if own.len() != rates_radps.len() {
        return None;
    }
    let mean = |numbers: &mut dyn Iterator<Item = f64>| (numbers.sum::<f64>() / own.len() as f64).sqrt();
    let apart = mean(&mut own.iter().zip(rates_radps).map(|(own, other)| (own - other).powi(2)));
    let size = mean(&mut own.iter().map(|rate| rate * rate));
    (apart > 0.2 * size + 0.1).then(|| {
        format!(
            "its joint_vel differs from the derivative of joint_pos by {apart:.2} rad/s (root mean square), which is \
             {size:.2}; the derivative is used"
        )
    })
}
