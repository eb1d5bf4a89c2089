//! Archives of NumPy: those of mjlab, UniLab and AMP, and of holosoma.

use std::io::{Cursor, Read, Write};

use nalgebra::UnitQuaternion;
use npyz::{DType, NpyFile, Order, TypeChar, WriterBuilder};
use zip::{CompressionMethod, ZipArchive, ZipWriter, write::SimpleFileOptions};

use super::order::{BodyPoses, Unordered};
use super::{MOTION_FILE_BYTES_MAX, MotionClip, MotionError, ROOT, SampledMotion};
use crate::physics::Physics;

/// Most arrays of an archive.
const ARRAYS_MAX: usize = 64;
/// Keys of archives with human poses, which are not those of a robot.
const HUMAN_KEYS: [&str; 4] = ["poses", "trans", "betas", "body_pose"];

/// What an archive has.
pub(super) struct Archive {
    /// Poses of the hinges and of the bodies, in their order.
    pub unordered: Unordered,
    /// Frames per second.
    pub rate_hz: f64,
    /// Format.
    pub format: &'static str,
    /// What is ignored.
    pub notices: Vec<String>,
    /// Rates of the hinges in the file (rad/s), `[T][hinges]`.
    pub rates_radps: Option<Vec<f64>>,
}

/// Array of numbers.
struct Array {
    shape: Vec<usize>,
    numbers: Vec<f64>,
}

/// Reads an archive for a robot with this many hinges.
pub(super) fn read(bytes: &[u8], hinges: usize) -> Result<Archive, MotionError> {
    let fail = |problem: String| Err(MotionError(problem));
    let mut archive = ZipArchive::new(Cursor::new(bytes))
        .map_err(|why| MotionError(format!("it is no archive of NumPy: {why}; write it again by numpy.savez")))?;
    if archive.len() > ARRAYS_MAX {
        return fail(format!("it has {} arrays; allowed: {ARRAYS_MAX}", archive.len()));
    }
    let names: Vec<String> = archive.file_names().filter_map(|name| name.ok().map(|name| name.into_owned())).collect();
    let has = |key: &str| names.iter().any(|name| name.strip_suffix(".npy") == Some(key));
    if !has("joint_pos") && HUMAN_KEYS.iter().any(|key| has(key)) {
        return fail(
            "it has poses of a human body (SMPL), not of a robot; retarget it first, for example by GMR \
             (github.com/YanjieZe/GMR)"
                .to_owned(),
        );
    }
    let mut left = MOTION_FILE_BYTES_MAX;
    let mut bytes_of = |key: &str| -> Result<Option<Vec<u8>>, MotionError> {
        if !has(key) {
            return Ok(None);
        }
        let damaged = |why: &dyn std::fmt::Display| MotionError(format!("its array `{key}` cannot be read: {why}"));
        let file = archive.by_name(&format!("{key}.npy")).map_err(|why| damaged(&why))?;
        let mut content = Vec::new();
        // What the archive says of its size may be wrong.
        file.take(left + 1).read_to_end(&mut content).map_err(|why| damaged(&why))?;
        left = left
            .checked_sub(content.len() as u64)
            .ok_or_else(|| MotionError(format!("its arrays are longer than {} MiB", MOTION_FILE_BYTES_MAX >> 20)))?;
        Ok(Some(content))
    };
    let mut numbers = |key: &str| bytes_of(key)?.map(|bytes| array(key, &bytes)).transpose();
    let [rate, joints, rates, places, turns] =
        ["fps", "joint_pos", "joint_vel", "body_pos_w", "body_quat_w"].map(&mut numbers);
    let missing =
        |key: &str| MotionError(format!("it lacks the array `{key}`; a motion has fps, joint_pos and body_pos_w"));
    let rate = rate?.ok_or_else(|| missing("fps"))?;
    let [rate_hz] = rate.numbers[..] else { return fail("its array `fps` must be one number".to_owned()) };
    let joints = joints?.ok_or_else(|| missing("joint_pos"))?;
    let [count, width] = joints.shape[..] else {
        return fail(format!("its array `joint_pos` has {} dimensions; expected: frames, hinges", joints.shape.len()));
    };
    let names = |key: &str, bytes: Option<Vec<u8>>| bytes.map(|bytes| texts(key, &bytes)).transpose();
    let hinge_names = names("joint_names", bytes_of("joint_names")?)?;
    let body_names = names("body_names", bytes_of("body_names")?)?;
    let object = has("object_pos_w").then(|| "its object is ignored: the robot alone is simulated".to_owned());
    let has_root = hinge_names.as_ref().is_some_and(|names| width == names.len() + ROOT) || width == hinges + ROOT;
    let poses = poses(places?, turns?, count)?;
    let (roots, hinge_count, format) = if has_root {
        let roots: Vec<f64> = joints.numbers.chunks_exact(width).flat_map(|row| row[..ROOT].iter().copied()).collect();
        (roots, width - ROOT, "npz of holosoma")
    } else {
        let poses = poses.as_ref().ok_or_else(|| missing("body_pos_w and body_quat_w"))?;
        let root = |frame: usize| {
            let at = frame * poses.count;
            poses.places_m[at].into_iter().chain(poses.turns[at])
        };
        ((0..count).flat_map(root).collect(), width, "npz of mjlab")
    };
    if let Some(names) = hinge_names.as_ref().filter(|names| names.len() != hinge_count) {
        return fail(format!("`joint_names` has {} names, `joint_pos` {hinge_count} hinges", names.len()));
    }
    let angles_rad: Vec<f64> = match has_root {
        true => joints.numbers.chunks_exact(width).flat_map(|row| row[ROOT..].iter().copied()).collect(),
        false => joints.numbers,
    };
    let of_hinges = |rates: Array| -> Option<Vec<f64>> {
        let [frames, wide] = rates.shape[..] else { return None };
        let from = wide.checked_sub(hinge_count).filter(|from| frames == count && matches!(from, 0 | 6))?;
        Some(rates.numbers.chunks_exact(wide.max(1)).flat_map(|row| row[from..].iter().copied()).collect())
    };
    let rates_radps = rates?.and_then(of_hinges);
    let unordered = Unordered { roots, angles_rad, hinges: hinge_count, hinge_names, poses, body_names };
    Ok(Archive { unordered, rate_hz, format, notices: object.into_iter().collect(), rates_radps })
}

/// Returns the poses of the bodies, if both arrays are there.
fn poses(places: Option<Array>, turns: Option<Array>, frames: usize) -> Result<Option<BodyPoses>, MotionError> {
    let (Some(places), Some(turns)) = (places, turns) else { return Ok(None) };
    let count = places.shape.get(1).copied().unwrap_or_default();
    if places.shape != [frames, count, 3] || turns.shape != [frames, count, 4] || count == 0 {
        let (places, turns) = (places.shape, turns.shape);
        return Err(MotionError(format!(
            "`body_pos_w` has the shape {places:?} and `body_quat_w` {turns:?}; expected: [{frames}, bodies, 3] and \
             [{frames}, bodies, 4], as `joint_pos` has {frames} frames"
        )));
    }
    Ok(Some(BodyPoses {
        count,
        places_m: places.numbers.as_chunks::<3>().0.to_vec(),
        turns: turns.numbers.as_chunks::<4>().0.to_vec(),
    }))
}

/// Opens an array, whose header may be wrong about its length.
fn open<'a>(key: &str, bytes: &'a [u8]) -> Result<NpyFile<&'a [u8]>, MotionError> {
    let fail = |problem: String| Err(MotionError(format!("its array `{key}` {problem}")));
    let file = match NpyFile::new(bytes) {
        Ok(file) => file,
        Err(why) => return fail(format!("cannot be read: {why}")),
    };
    if file.header().uses_pickled_array() {
        return fail(
            "holds pickled Python objects, which may run code when they are read, so it is not read; save it as \
                     numbers or text: numpy.savez with .astype(float) or .astype(str)"
                .to_owned(),
        );
    }
    if file.order() != Order::C {
        return fail("is in Fortran order; save numpy.ascontiguousarray of it".to_owned());
    }
    let each = file.dtype().num_bytes().unwrap_or(usize::MAX) as u64;
    let length = file.shape().iter().try_fold(each, |product, side| product.checked_mul(*side));
    // Entries of no bytes take memory all the same.
    if each == 0 || length.is_none_or(|length| length > bytes.len() as u64) {
        return fail(format!("is damaged: it is shorter than its shape {:?} says", file.shape()));
    }
    Ok(file)
}

/// Reads an array of numbers.
fn array(key: &str, bytes: &[u8]) -> Result<Array, MotionError> {
    let file = open(key, bytes)?;
    let shape = file.shape().iter().map(|side| *side as usize).collect();
    let DType::Plain(kind) = file.dtype() else {
        return Err(MotionError(format!("its array `{key}` has fields; expected: numbers")));
    };
    let numbers = match (kind.type_char(), kind.num_bytes()) {
        (TypeChar::Float, Some(4)) => file.into_vec::<f32>().map(|all| all.into_iter().map(f64::from).collect()),
        (TypeChar::Float, Some(8)) => file.into_vec::<f64>(),
        (TypeChar::Int, Some(4)) => file.into_vec::<i32>().map(|all| all.into_iter().map(f64::from).collect()),
        (TypeChar::Int, Some(8)) => file.into_vec::<i64>().map(|all| all.into_iter().map(|one| one as f64).collect()),
        _ => {
            return Err(MotionError(format!(
                "its array `{key}` has the type {}; expected: float32, float64, int32 or int64",
                file.dtype().descr()
            )));
        }
    };
    let numbers: Vec<f64> = numbers.map_err(|why| MotionError(format!("its array `{key}` cannot be read: {why}")))?;
    match numbers.iter().position(|number| !number.is_finite()) {
        Some(place) => Err(MotionError(format!("entry {place} of its array `{key}` is not a finite number"))),
        None => Ok(Array { shape, numbers }),
    }
}

/// Reads an array of texts.
fn texts(key: &str, bytes: &[u8]) -> Result<Vec<String>, MotionError> {
    let texts = open(key, bytes)?.into_vec::<String>();
    texts.map_err(|why| MotionError(format!("its array `{key}` must have texts: {why}")))
}

/// Returns a motion as an archive with mjlab's keys and shapes, at control steps of this length (s). `physics` is a
/// simulation of its robot.
///
/// # Errors
/// [`MotionError`] if writing fails.
pub fn write_npz(motion: &MotionClip, physics: &mut Physics, step_s: f64) -> Result<Vec<u8>, MotionError> {
    let sampled = SampledMotion::new(motion, step_s);
    let frames = sampled.positions.len() as u64;
    let (links, hinges) = (physics.model().links.len() as u64, motion.hinges.len() as u64);
    let mut arrays: [Vec<f32>; 6] = Default::default();
    for (position, velocity) in sampled.positions.iter().zip(&sampled.velocities) {
        physics.set_state(position, velocity);
        let [joints, rates, places, turns, linear, angular] = &mut arrays;
        joints.extend(position[ROOT..].iter().map(|angle| *angle as f32));
        rates.extend(velocity[6..].iter().map(|rate| *rate as f32));
        for link in 0..physics.model().links.len() {
            let moved = physics.link_motion(link);
            places.extend(moved.pose.translation.vector.iter().map(|part| *part as f32));
            // The base of the file, see `Robot::forward`.
            let robot = physics.model().robot.as_ref().filter(|_| link == 0);
            let back = robot.map_or_else(UnitQuaternion::identity, |robot| robot.forward.turn().inverse());
            let turn = moved.pose.rotation * back;
            turns.extend([turn.w, turn.i, turn.j, turn.k].map(|part| part as f32));
            linear.extend(moved.linear_mps.iter().map(|part| *part as f32));
            angular.extend(moved.angular_radps.iter().map(|part| *part as f32));
        }
    }
    let shapes: [&[u64]; 6] = [
        &[frames, hinges],
        &[frames, hinges],
        &[frames, links, 3],
        &[frames, links, 4],
        &[frames, links, 3],
        &[frames, links, 3],
    ];
    let keys = ["joint_pos", "joint_vel", "body_pos_w", "body_quat_w", "body_lin_vel_w", "body_ang_vel_w"];
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let failed = |why: &dyn std::fmt::Display| MotionError(format!("the archive cannot be written: {why}"));
    let rate = [(1.0 / step_s) as f32];
    let all = std::iter::once(("fps", &[1][..], &rate[..]));
    let all =
        all.chain(keys.into_iter().zip(shapes).zip(&arrays).map(|((key, shape), array)| (key, shape, &array[..])));
    for (key, shape, array) in all {
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        zip.start_file(format!("{key}.npy"), options).map_err(|why| failed(&why))?;
        let mut npy = Vec::new();
        let begun = npyz::WriteOptions::new().default_dtype().shape(shape).writer(&mut npy).begin_nd();
        let mut writer = begun.map_err(|why| failed(&why))?;
        writer.extend(array.iter().copied()).and_then(|()| writer.finish()).map_err(|why| failed(&why))?;
        zip.write_all(&npy).map_err(|why| failed(&why))?;
    }
    zip.finish().map(Cursor::into_inner).map_err(|why| failed(&why))
}
