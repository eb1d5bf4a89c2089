//! `eval --film` and `--png`: pictures without a window.

use std::{fs, path::Path};

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
    let output = done(folder.path(), &[&args[..], &["--fps", "20", "--json"]].concat());
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
fn films_have_25_pictures_per_second_and_can_start_later_and_end_earlier() {
    let (folder, _) = folders();
    let film = |name: &str, episodes: f64, more: &[&str]| {
        let (count, name) = (episodes.to_string(), &format!("{name}.gif"));
        let args = ["eval", "--agent", "random", "--episodes", &count, "--size", "64x48", "--film", name, "--json"];
        let steps = last_json(&done(folder.path(), &[&args[..], more].concat()))["length_mean"].as_f64().unwrap();
        (screens(&folder.path().join(name)).len() as f64, steps * episodes * 0.015 * 25.0)
    };
    let ((one, of_one), (three, of_three)) = (film("one", 1.0, &[]), film("three", 3.0, &[]));
    assert!((one - of_one).abs() <= 1.0, "{one} {of_one}");
    assert!((three - of_three).abs() <= 3.0 && three > one, "{three} {of_three}");

    assert_eq!(film("short", 1.0, &["--fps", "50", "--seconds", "0.1"]).0, 5.0);
    let (whole, late) =
        (film("whole", 1.0, &["--fps", "50"]).0, film("late", 1.0, &["--fps", "50", "--from-s", "0.1"]).0);
    assert!(late < whole && late + 6.0 >= whole, "{late} of {whole}");
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
    fs::create_dir(&tools).unwrap();
    let path = format!("{}:/usr/bin:/bin", tools.display());
    install(&tools.join("ffmpeg"), "#!/bin/sh\necho \"$@\" >arguments\nfor last; do :; done\nexec cat >\"$last\"\n");
    let output = film(&path);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("pictures of 64x48"), "{}", stdout(&output));
    let arguments = fs::read_to_string(folder.path().join("arguments")).unwrap();
    assert!(arguments.contains("-video_size 64x48 -framerate 25"), "{arguments}");
    let bytes = fs::read(folder.path().join("a.mp4")).unwrap().len();
    assert!(bytes > 3 * 64 * 48 * 3 && bytes.is_multiple_of(64 * 48 * 3), "{bytes} bytes");
    fs::remove_file(folder.path().join("a.mp4")).unwrap();
    install(&tools.join("ffmpeg"), "#!/bin/sh\ncat >/dev/null\necho 'unknown encoder' >&2\nexit 1\n");
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
    refused(&["--film", "a.gif", "--size", "9x9"], 2, &["--size", "640x480"]);
    refused(&["--film", "a.gif", "--fps", "0"], 2, &["--fps"]);
    refused(&["--fps", "10"], 2, &["--film"]);
    refused(&["--film", "a.avi"], 2, &["--film a.avi", ".gif or .mp4"]);
    refused(&["--film", "a.gif", "--from-s", "3000"], 2, &["--from-s 3000", "every episode ended before"]);
    assert!(!folder.path().join("a.gif").exists());
}

/// Whether a pixel has a colour of the robot: sky and ground are bluish, and the right limbs far more so.
fn is_robot([red, _, blue]: [u8; 3]) -> bool {
    let warm = i32::from(red) - i32::from(blue);
    !(-38..=4).contains(&warm)
}

#[test]
fn the_robot_stands_in_the_middle_of_half_of_the_picture_and_the_text_changes() {
    let (folder, _) = folders();
    done(folder.path(), &["eval", "--agent", "random", "--episodes", "1", "--png", "frames", "--seconds", "0.3"]);
    let picture = |number: u32| pixels(&folder.path().join(format!("frames/{number:05}.png")));
    let mut lines = Vec::new();
    for number in [0, 5] {
        let (width, height, rgb) = picture(number);
        assert_eq!((width, height), (640, 480));
        let rows: Vec<&[[u8; 3]]> = rgb.as_chunks::<3>().0.chunks(640).collect();
        let shown: Vec<usize> = (0..480).filter(|row| rows[*row].iter().any(|pixel| is_robot(*pixel))).collect();
        let (top, bottom) = (shown[0] as f64, *shown.last().unwrap() as f64);
        assert!(((top + bottom) / 2.0 - 240.0).abs() < 25.0, "picture {number}: rows {top} to {bottom}");
        // It stands in the first picture, and falls soon.
        let share = (bottom - top) / 480.0;
        assert!(number > 0 || (0.42..0.6).contains(&share), "picture {number}: rows {top} to {bottom}");
        lines.push(rows[..30].concat());
        // Lines of the ground and numbers: the lower edge is not of one colour.
        let mut colours: Vec<[u8; 3]> = rows[380..].concat();
        colours.sort_unstable();
        colours.dedup();
        assert!(colours.len() > 50, "picture {number}: {} colours", colours.len());
    }
    assert_ne!(lines[0], lines[1], "time and speed are other ones");
    let dark = |line: &[[u8; 3]]| line.iter().filter(|pixel| pixel.iter().all(|part| *part < 80)).count();
    assert!(dark(&lines[0]) > 40, "{} pixels of ink", dark(&lines[0]));
}

#[test]
fn a_film_that_cannot_be_written_fails_before_an_episode_is_played() {
    let (folder, _) = folders();
    for (name, wanted) in [("absent/a.gif", "does not exist"), ("a.png", ".gif or .mp4")] {
        let args = ["eval", "--agent", "random", "--episodes", "1", "--print-every", "1", "--film", name];
        let output = run(folder.path(), &args);
        assert!(!output.status.success() && stderr(&output).contains(wanted), "{}", stderr(&output));
        assert_eq!(stdout(&output), "", "no step was played");
    }
}
