//! `treadmill watch` starts the viewer.

use std::{fs, process::Command};

use crate::support::*;

#[test]
fn watch_passes_all_arguments_to_the_viewer_or_explains_how_to_build_it() {
    let (folder, _) = folders();
    let [alone, viewers] = ["alone", "viewers"].map(|name| {
        let folder = folder.path().join(name);
        fs::create_dir(&folder).unwrap();
        folder
    });
    // Copied to another folder, so that no viewer is beside it.
    let own = alone.join("treadmill");
    fs::copy(env!("CARGO_BIN_EXE_treadmill"), &own).unwrap();
    let watch = || {
        Command::new(&own)
            .args(["watch", "runs/walk-1", "--live", "--no-follow"])
            .env("PATH", &viewers)
            .output()
            .unwrap()
    };
    assert_refused(&watch(), 1, &["`treadmill-watch` is neither", "cargo build --release -p treadmill-watch"]);
    let script = |name: &str| format!("#!/bin/sh\necho {name} \"$@\"\nexit 7\n");
    install(&viewers.join("treadmill-watch"), &script("path"));
    let output = watch();
    assert_eq!((stdout(&output).as_str(), output.status.code()), ("path runs/walk-1 --live --no-follow\n", Some(7)));
    install(&alone.join("treadmill-watch"), &script("beside"));
    assert_eq!(stdout(&watch()), "beside runs/walk-1 --live --no-follow\n");
}
