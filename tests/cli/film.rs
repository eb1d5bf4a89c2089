//! `eval --film` and `--png`: pictures without a window.

use std::{fs, os::unix::fs::PermissionsExt, path::Path};

use crate::support::*;

/// Returns the frames of a GIF, each as the whole picture.
fn screens(path: &Path) -> Vec<Vec<u8>> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(fs::File::open(path).unwrap()).unwrap();
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let (mut screen, mut screens) = (vec![0; width * height * 3], Vec::new());
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!((frame.left, usize::from(frame.width)), (0, width));
        for (index, rgba) in frame.buffer.as_chunks::<4>().0.iter().enumerate() {
            if rgba[3] != 0 {
                let at = (usize::from(frame.top) * width + index) * 3;
                screen[at..at + 3].copy_from_slice(&rgba[..3]);
            }
        }
        screens.push(screen.clone());
    }
    screens
}

fn pixels(path: &Path) -> (u32, u32, Vec<u8>) {
    let file = std::io::BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width, info.height, pixels)
}

#[test]
fn an_episode_becomes_an_animation_and_single_pictures() {
    let (folder, _) = folders();
    let args =
        ["eval", "--agent", "random", "--episodes", "2", "--film", "a.gif", "--png", "frames", "--size", "96x64"];
    let output = run(folder.path(), &[&args[..], &["--fps", "20", "--json"]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(stdout(&output).lines().count(), 1, "--json is one line");
    let screens = screens(&folder.path().join("a.gif"));
    assert!(screens.len() > 3, "random actions stand for a moment: {}", screens.len());
    for (number, pair) in screens.windows(2).enumerate() {
        assert_ne!(pair[0], pair[1], "something moved before picture {}", number + 1);
    }
    for (number, screen) in screens.iter().enumerate() {
        let (width, height, single) = pixels(&folder.path().join(format!("frames/{number:05}.png")));
        assert_eq!((width, height), (96, 64));
        // A GIF has 255 colours: near, and not the same.
        let off: u64 = screen.iter().zip(&single).map(|(one, other)| u64::from(one.abs_diff(*other))).sum();
        assert!(
            off < 4 * single.len() as u64,
            "picture {number} is off by {} a byte",
            off as f64 / single.len() as f64
        );
    }
    assert_eq!(fs::read_dir(folder.path().join("frames")).unwrap().count(), screens.len());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "no temporary file remains");
}

#[test]
fn the_film_can_start_later_and_end_earlier() {
    let (folder, _) = folders();
    let film = |name: &str, more: &[&str]| {
        let args = ["eval", "--agent", "random", "--episodes", "1", "--size", "64x48", "--fps", "50", "--film", name];
        let output = run(folder.path(), &[&args[..], more].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        assert!(stdout(&output).contains("pictures of 64x48"), "{}", stdout(&output));
        screens(&folder.path().join(name))
    };
    let whole = film("whole.gif", &[]);
    assert_eq!(film("short.gif", &["--seconds", "0.1"]).len(), 5);
    let late = film("late.gif", &["--from-s", "0.1"]);
    assert!(late.len() < whole.len() && late.len() + 6 >= whole.len(), "{} of {}", late.len(), whole.len());
}

#[test]
fn every_episode_is_shown_at_25_pictures_per_second() {
    let (folder, _) = folders();
    let film = |episodes: &str, name: &str| {
        let args = ["eval", "--agent", "random", "--episodes", episodes, "--size", "64x48", "--film", name, "--json"];
        let output = run(folder.path(), &args);
        assert!(output.status.success(), "{}", stderr(&output));
        let steps = last_json(&output)["length_mean"].as_f64().unwrap() * episodes.parse::<f64>().unwrap();
        (screens(&folder.path().join(name)).len() as f64, steps * 0.015 * 25.0)
    };
    let (one, wanted) = film("1", "one.gif");
    assert!((one - wanted).abs() <= 1.0, "{one} {wanted}");
    let (three, wanted) = film("3", "three.gif");
    assert!((three - wanted).abs() <= 3.0 && three > one, "{three} {wanted}");
}

#[test]
fn a_video_is_written_by_ffmpeg() {
    let (folder, _) = folders();
    let film = |path: &str| {
        let mut command = treadmill(folder.path());
        command.env("PATH", path).args(["eval", "--agent", "random", "--episodes", "1", "--size", "64x48"]);
        command.args(["--film", "a.mp4"]).output().unwrap()
    };
    assert_refused(&film("/nowhere"), 2, &["--film a.mp4", "ffmpeg", "not installed", ".gif"]);
    // A program that copies its input into the file that its last argument names.
    let tools = folder.path().join("tools");
    let install = |text: &str| {
        fs::create_dir_all(&tools).unwrap();
        fs::write(tools.join("ffmpeg"), text).unwrap();
        fs::set_permissions(tools.join("ffmpeg"), PermissionsExt::from_mode(0o755)).unwrap();
    };
    let path = format!("{}:/usr/bin:/bin", tools.display());
    install("#!/bin/sh\necho \"$@\" >arguments\nfor last; do :; done\nexec cat >\"$last\"\n");
    let output = film(&path);
    assert!(output.status.success(), "{}", stderr(&output));
    let arguments = fs::read_to_string(folder.path().join("arguments")).unwrap();
    assert!(arguments.contains("-video_size 64x48 -framerate 25"), "{arguments}");
    let bytes = fs::read(folder.path().join("a.mp4")).unwrap().len();
    assert!(bytes > 3 * 64 * 48 * 3 && bytes.is_multiple_of(64 * 48 * 3), "{bytes} bytes");
    fs::remove_file(folder.path().join("a.mp4")).unwrap();
    install("#!/bin/sh\ncat >/dev/null\necho 'unknown encoder' >&2\nexit 1\n");
    assert_refused(&film(&path), 1, &["ffmpeg failed: unknown encoder"]);
    assert!(!folder.path().join("a.mp4").exists());
}

#[test]
fn unwritable_outputs_and_invalid_flags_are_refused() {
    let (folder, _) = folders();
    let refused = |more: &[&str], exit: i32, wanted: &[&str]| {
        let output = run(folder.path(), &[&["eval", "--agent", "random", "--episodes", "1"], more].concat());
        assert_refused(&output, exit, wanted);
    };
    fs::create_dir(folder.path().join("full")).unwrap();
    fs::write(folder.path().join("full/a"), "x").unwrap();
    refused(&["--png", "full"], 2, &["--png full", "not empty"]);
    refused(&["--film", "absent/a.gif"], 1, &["--film absent/a.gif"]);
    refused(&["--film", "a.gif", "--size", "9x9"], 2, &["--size", "320x240"]);
    refused(&["--film", "a.gif", "--fps", "0"], 2, &["--fps"]);
    refused(&["--fps", "10"], 2, &["--film"]);
    refused(&["--film", "a.avi"], 2, &["--film a.avi", ".gif or .mp4"]);
    refused(&["--film", "a.gif", "--from-s", "3000"], 2, &["--from-s 3000", "every episode ended before"]);
    assert!(!folder.path().join("a.gif").exists());
}
