use std::f64::consts::{PI, TAU};
use std::io::{Cursor, Write};

use proptest::prelude::*;
use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

use super::*;
use crate::mjcf::{HUMANOID_XML, motions_of, with_motions};
use crate::{Model, Physics, PhysicsSettings};

fn physics() -> Physics {
    Physics::new(Model::from_mjcf(HUMANOID_XML).unwrap(), PhysicsSettings::default()).unwrap()
}

fn names(physics: &Physics) -> Vec<String> {
    physics.model().hinges.iter().map(|hinge| hinge.name.clone()).collect()
}

/// Frames of a humanoid that turns and swings its hinges, each a little differently.
fn frames(hinges: usize, count: usize, rate_hz: f64) -> Vec<f32> {
    let frame = |number: usize| {
        let time_s = number as f64 / rate_hz;
        let (sin, cos) = (0.25 * time_s).sin_cos();
        let root = [0.3 * time_s, 0.1 * time_s, 1.4, cos, 0.0, 0.0, sin];
        let angles = (0..hinges).map(move |hinge| 0.01 * hinge as f64 + 0.2 * (TAU * time_s).sin());
        root.into_iter().chain(angles).map(|number| number as f32)
    };
    (0..count).flat_map(frame).collect()
}

fn swinging() -> MotionClip {
    let physics = physics();
    let hinges = names(&physics);
    let frames = frames(hinges.len(), 101, 50.0);
    MotionClip::new("swing", 50.0, hinges, frames).unwrap()
}

#[test]
fn sampled_positions_and_velocities_are_those_of_the_curve() {
    let motion = swinging();
    // Between frames, and at the frames.
    for step_s in [0.02, 0.007] {
        let sampled = SampledMotion::new(&motion, step_s);
        assert_eq!(sampled.positions.len(), (2.0 / step_s) as usize + 1);
        for (number, (position, velocity)) in sampled.positions.iter().zip(&sampled.velocities).enumerate() {
            let time_s = number as f64 * step_s;
            let is_end = number == 0 || number + 1 == sampled.positions.len();
            let tolerance = if is_end { 0.3 } else { 0.02 };
            assert!((position[0] - 0.3 * time_s).abs() < 1e-5 && (velocity[0] - 0.3).abs() < 1e-3);
            // A turn about the vertical by 0.5 rad/s.
            assert!((position[3] - (0.25 * time_s).cos()).abs() < 1e-6);
            assert!((velocity[5] - 0.5).abs() < 1e-3 && velocity[3].abs() < 1e-3 && velocity[4].abs() < 1e-3);
            let swing = 0.2 * (TAU * time_s).sin();
            assert!((position[10] - (0.03 + swing)).abs() < 2e-4, "{number}: {}", position[10]);
            let rate = 0.2 * TAU * (TAU * time_s).cos();
            assert!((velocity[9] - rate).abs() < tolerance, "{number}: {} {rate}", velocity[9]);
        }
    }
}

#[test]
fn motions_travel_in_the_text_of_their_model_and_follow_its_hinges() {
    let motion = swinging();
    let other = motion.frames().flatten().copied().collect();
    let other = MotionClip::new("a <b> & \"c\"", 50.0, motion.hinges.clone(), other).unwrap();
    let text = with_motions(HUMANOID_XML, &[motion.clone(), other.clone()]).unwrap();
    assert_eq!(motions_of(&text).unwrap(), [motion.clone(), other]);
    assert_eq!(&Model::from_mjcf(&text).unwrap().motions[0], &motion);
    // Another one takes their place, and nothing of them is left.
    let replaced = with_motions(&text, std::slice::from_ref(&motion)).unwrap();
    assert_eq!(replaced, with_motions(HUMANOID_XML, std::slice::from_ref(&motion)).unwrap());
    assert_eq!(with_motions(&replaced, &[]).unwrap(), HUMANOID_XML);
    let damaged = text.replacen("swing&#10;50", "swing&#10;fifty", 1);
    let why = Model::from_mjcf(&damaged).map(drop).unwrap_err();
    assert!(why.to_string().contains("damaged"), "{why}");
}

#[test]
fn hinges_are_matched_by_name_and_missing_ones_are_named() {
    let motion = swinging();
    let mut turned = motion.hinges.clone();
    turned.reverse();
    let moved = motion.in_order_of(&turned).unwrap();
    let (first, last) = (motion.frames().next().unwrap(), moved.frames().next().unwrap());
    assert_eq!(first[7], *last.last().unwrap());
    assert_eq!(moved.in_order_of(&motion.hinges).unwrap(), motion);
    turned[0] = "tail".into();
    let why = motion.in_order_of(&turned).unwrap_err().to_string();
    assert!(why.contains("the motion lacks the robot's hinges `tail`") && why.contains("the robot lacks"), "{why}");
}

#[test]
fn numbers_that_no_motion_has_are_refused_by_name() {
    let hinges = names(&physics());
    let sound = frames(hinges.len(), 10, 50.0);
    let refused = |rate_hz: f64, change: &dyn Fn(&mut Vec<f32>)| {
        let mut frames = sound.clone();
        change(&mut frames);
        MotionClip::new("m", rate_hz, hinges.clone(), frames).unwrap_err().to_string()
    };
    assert!(refused(50.0, &|all| all[25] = f32::NAN).contains("frame 1, at 0.02 s: entry 1 is not a finite number"));
    assert!(refused(50.0, &|all| all[3] = 2.0).contains("the quaternion of the root has length 2.000"));
    assert!(refused(50.0, &|all| all[0] = 2000.0).contains("use metres"));
    assert!(refused(50.0, &|all| all[7] = 180.0).contains("angles are in rad"));
    assert!(refused(0.0, &|_| ()).contains("its rate is 0"));
    assert!(refused(50.0, &|all| all.truncate(30)).contains("frames; at least 3 are needed"));
    let long = frames(1, 1300, 1.0);
    let why = MotionClip::new("m", 1.0, vec!["h".into()], long).unwrap_err().to_string();
    assert!(why.contains("it lasts 1299 s; allowed: 1200 s"), "{why}");
}

fn read_text(text: &str, rate_hz: Option<f64>) -> Result<MotionFile, String> {
    file::read(text.as_bytes(), "m", rate_hz, &mut physics()).map_err(|why| why.to_string())
}

#[test]
fn lines_of_numbers_have_the_quaternion_with_w_last() {
    let hinges = names(&physics()).len();
    let line = |quaternion: &str| format!("0.1, 0.2, 1.4, {quaternion}, {}\n", vec!["0.05"; hinges].join(", "));
    let text = format!("\u{feff}{}", line("0, 0, 0.6, 0.8").repeat(5));
    let found = read_text(&text, Some(30.0)).unwrap();
    let frame = found.motion.frames().next().unwrap().to_vec();
    assert_eq!((found.motion.rate_hz, &frame[..8]), (30.0, &[0.1, 0.2, 1.4, 0.8, 0.0, 0.0, 0.6, 0.05][..]));
    for (text, rate_hz, named) in [
        (text.clone(), None, "--fps 30"),
        (line("1, 0, 0, 0").repeat(5), Some(30.0), "seem to be w, x, y, z"),
        (line("0, 0, 0, one").repeat(5), Some(30.0), "line 1, column 7: `one` is not a finite number"),
        (line("0, 0, 0, nan").repeat(5), Some(30.0), "`nan` is not a finite number"),
        ("0,0,1,0,0,0,1\n".into(), Some(30.0), "line 1 has 7 columns; this robot with 17 hinges needs 24"),
        ("Frame,root_translateX,root_translateY\n1,2,3\n".into(), None, "BONES-SEED"),
        ("a,b,c\n".into(), None, "its first line is a header (`a`)"),
        ("HIERARCHY\nROOT hips\n".into(), None, "BVH"),
        ("\n\n".into(), Some(30.0), "it is empty"),
        (String::new(), None, "it is empty"),
    ] {
        let why = read_text(&text, rate_hz).unwrap_err();
        assert!(why.contains(named), "{named}: {why}");
    }
    let why = file::read(&[0x80, 4, 1, 2], "m", None, &mut physics()).unwrap_err().to_string();
    assert!(why.contains("it is a pickle"), "{why}");
}

/// Writes an archive with arrays of numbers.
fn archive(arrays: &[(&str, &[u64], Vec<f32>)], others: &[(&str, &[u8])]) -> Vec<u8> {
    use npyz::WriterBuilder;
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    for (key, shape, numbers) in arrays {
        zip.start_file(format!("{key}.npy"), options).unwrap();
        let mut npy = Vec::new();
        let mut writer = npyz::WriteOptions::new().default_dtype().shape(shape).writer(&mut npy).begin_nd().unwrap();
        writer.extend(numbers.iter().copied()).unwrap();
        writer.finish().unwrap();
        zip.write_all(&npy).unwrap();
    }
    for (key, bytes) in others {
        zip.start_file(format!("{key}.npy"), options).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn read_archive(bytes: &[u8]) -> Result<MotionFile, String> {
    file::read(bytes, "m", None, &mut physics()).map_err(|why| why.to_string())
}

#[test]
fn a_written_archive_is_read_again_and_the_order_of_its_hinges_is_found() {
    let motion = swinging();
    let mut physics = physics();
    let bytes = write_npz(&motion, &mut physics, 0.02).unwrap();
    let found = read_archive(&bytes).unwrap();
    assert!(found.order.starts_with("depth first") && found.notices.is_empty(), "{found:?}");
    let apart = motion.frames().flatten().zip(found.motion.frames().flatten()).map(|(one, other)| (one - other).abs());
    assert!(apart.fold(0.0, f32::max) < 1e-5);

    // The same breadth first: bodies and hinges in the order of their depth.
    let model = physics.model().clone();
    let mut order: Vec<usize> = (0..model.bodies.len()).collect();
    order.sort_by_key(|body| model.upward(*body).count());
    let hinges: Vec<usize> = order.iter().flat_map(|body| model.bodies[*body].hinges.clone()).collect();
    assert_ne!(hinges, (0..hinges.len()).collect::<Vec<_>>());
    let count = motion.len() as u64;
    let (mut angles, mut places, mut turns) = (Vec::new(), Vec::new(), Vec::new());
    for frame in motion.frames() {
        let position: Vec<f64> = frame.iter().map(|number| f64::from(*number)).collect();
        physics.set_state(&position, &vec![0.0; model.velocity_size()]);
        angles.extend(hinges.iter().map(|hinge| frame[7 + hinge]));
        for body in &order {
            let link = model.links.iter().position(|link| link.body == *body).unwrap();
            let pose = physics.link_pose(link);
            places.extend(pose.translation.vector.iter().map(|part| *part as f32));
            turns.extend([pose.rotation.w, pose.rotation.i, pose.rotation.j, pose.rotation.k].map(|part| part as f32));
        }
    }
    let (bodies, width) = (order.len() as u64, hinges.len() as u64);
    let arrays = |angles: Vec<f32>, places: Vec<f32>| {
        archive(
            &[
                ("fps", &[1], vec![50.0]),
                ("joint_pos", &[count, width], angles),
                ("body_pos_w", &[count, bodies, 3], places),
                ("body_quat_w", &[count, bodies, 4], turns.clone()),
            ],
            &[],
        )
    };
    let found = read_archive(&arrays(angles.clone(), places.clone())).unwrap();
    assert!(found.order.starts_with("breadth first"), "{}", found.order);
    let apart = motion.frames().flatten().zip(found.motion.frames().flatten()).map(|(one, other)| (one - other).abs());
    assert!(apart.fold(0.0, f32::max) < 1e-5);
    // Bodies that no order explains.
    let elsewhere = places.iter().enumerate().map(|(at, part)| part + if at % 30 == 9 { 0.2 } else { 0.0 }).collect();
    let why = read_archive(&arrays(angles, elsewhere)).unwrap_err();
    assert!(why.contains("its bodies are not where this robot's hinges put them"), "{why}");
}

#[test]
fn archives_that_are_no_motions_are_refused_by_name() {
    let count = 5;
    let joints = |width: u64| ("joint_pos", [count, width], vec![0.0; (count * width) as usize]);
    let poses = |quaternion: f32| {
        let turns = (0..count).flat_map(|_| [quaternion, 0.0, 0.0, 0.0]).collect();
        [("body_pos_w", [count, 1, 3], vec![0.0; 3 * count as usize]), ("body_quat_w", [count, 1, 4], turns)]
    };
    let with = |width: u64, quaternion: f32, rate: f32| {
        let (joints, [places, turns]) = (joints(width), poses(quaternion));
        archive(
            &[
                ("fps", &[1], vec![rate]),
                (joints.0, &joints.1, joints.2),
                (places.0, &places.1, places.2),
                (turns.0, &turns.1, turns.2),
            ],
            &[],
        )
    };
    // One body cannot be compared with the robot's, and is taken as the root.
    assert!(read_archive(&with(17, 1.0, 50.0)).unwrap().order.starts_with("taken as depth first"));
    for (bytes, named) in [
        (with(5, 1.0, 50.0), "it has 5 hinges, the robot has 17"),
        (with(17, 0.0, 50.0), "the quaternion of the root has length 0.000"),
        (with(17, f32::NAN, 50.0), "of its array `body_quat_w` is not a finite number"),
        (with(17, 1.0, 0.0), "its rate is 0"),
        (archive(&[("poses", &[2, 3], vec![0.0; 6])], &[]), "poses of a human body (SMPL)"),
        (archive(&[("joint_pos", &[2, 3], vec![0.0; 6])], &[]), "it lacks the array `fps`"),
        (archive(&[("fps", &[1], vec![50.0])], &[("joint_pos", b"not npy")]), "`joint_pos` cannot be read"),
        (archive(&[("fps", &[1], vec![50.0])], &[("joint_pos", &pickled())]), "pickled Python objects"),
        (archive(&[("fps", &[1], vec![50.0])], &[("joint_pos", &too_short())]), "shorter than its shape"),
        (archive(&[("fps", &[1], vec![50.0])], &[("joint_pos", &empty_texts())]), "shorter than its shape"),
        (b"PK\x03\x04 and no more".to_vec(), "no archive of NumPy"),
    ] {
        let why = read_archive(&bytes).unwrap_err();
        assert!(why.contains(named), "{named}: {why}");
    }
}

/// Returns the beginning of an array of NumPy with this description.
fn npy(header: &str) -> Vec<u8> {
    let padded = format!("{header:<117}\n");
    [b"\x93NUMPY\x01\x00".as_slice(), &(padded.len() as u16).to_le_bytes(), padded.as_bytes()].concat()
}

fn pickled() -> Vec<u8> {
    npy("{'descr': '|O', 'fortran_order': False, 'shape': (2, 17), }")
}

fn empty_texts() -> Vec<u8> {
    npy("{'descr': '<U0', 'fortran_order': False, 'shape': (1000000000000,), }")
}

fn too_short() -> Vec<u8> {
    npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1000000000, 17), }")
}

#[test]
fn a_report_names_hinges_beyond_their_range_and_jumps() {
    let mut physics = physics();
    let hinges = names(&physics);
    let mut frames = frames(hinges.len(), 50, 50.0);
    let (width, knee) = (7 + hinges.len(), hinges.iter().position(|name| name.contains("knee")).unwrap());
    frames[20 * width + 7 + knee] = PI as f32;
    let motion = MotionClip::new("m", 50.0, hinges.clone(), frames).unwrap();
    let report = MotionReport::of(&motion, &mut physics);
    assert_eq!((report.frames, report.duration_s), (50, 0.98));
    assert!(report.beyond.iter().any(|(name, rad, _)| *name == hinges[knee] && *rad > 1.0), "{report:?}");
    assert_eq!(report.fastest.0, hinges[knee]);
    assert!(report.jumps.iter().any(|(time_s, what)| (time_s - 0.4).abs() < 0.03 && what.contains(&hinges[knee])));
    assert!((report.path_m - 0.98 * 0.3_f64.hypot(0.1)).abs() < 1e-3);
}

proptest! {
    /// Files are hostile.
    #[test]
    fn no_bytes_make_the_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..600), kind in 0..3) {
        let start: &[u8] = [b"PK\x03\x04".as_slice(), b"", b"\x93NUMPY\x01\x00"][kind as usize];
        let whole = [start, &bytes].concat();
        prop_assert!(file::read(&whole, "m", Some(30.0), &mut physics()).is_err());
    }

    #[test]
    fn no_text_makes_the_reader_panic(data in "[a-z0-9\n ]{0,200}") {
        let element = format!("<custom><text name=\"treadmill_motion_0\" data=\"{}\"/></custom>", data.replace('\n', "&#10;"));
        let text = HUMANOID_XML.replacen("</mujoco>", &format!("{element}</mujoco>"), 1);
        prop_assert!(motions_of(&text).is_err());
    }
}
