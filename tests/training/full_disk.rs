//! A disk that is full while a run trains.

use std::{
    fs::OpenOptions,
    io::Write,
    path::Path,
    process::Command,
    sync::atomic::{AtomicBool, Ordering},
};

use crate::support::*;

/// Takes all room of a disk, also what others free, until `enough`.
fn fill(file: &Path, enough: &AtomicBool) {
    let mut file = OpenOptions::new().create(true).append(true).open(file).unwrap();
    while !enough.load(Ordering::Relaxed) {
        // Small parts leave no rest, and a full disk refuses them.
        if file.write_all(&[0; 512]).is_err() {
            std::thread::yield_now();
        }
    }
}

#[test]
fn training_waits_while_the_disk_is_full_and_loses_nothing() {
    let (folder, _) = folders();
    std::fs::create_dir(folder.path().join("small")).unwrap();
    if !works("unshare", &["-rm", "true"]) {
        return skip("`unshare -rm` is not allowed here");
    }
    let train = format!("{} train --preset smoke --actors 1 --steps {ENDLESS}", env!("CARGO_BIN_EXE_treadmill"));
    let mut command = Command::new("unshare");
    command.current_dir(folder.path()).stdin(std::process::Stdio::null());
    command.args(["-rm", "sh", "-c"]);
    command.arg(format!("mount -t tmpfs -o size=16m none small && exec {train} --run-dir small/run --no-progress"));
    let training = Running::start(command);
    // Only the run sees its disk; others reach it through the run's root.
    let small = folder.path().join("small").canonicalize().unwrap();
    let disk = Path::new("/proc").join(training.pid().to_string()).join("root").join(small.strip_prefix("/").unwrap());
    let run = disk.join("run");
    await_that("the first checkpoint", || run.join("checkpoints/latest.bundle").exists().then_some(()));

    let enough = AtomicBool::new(false);
    let filler = disk.join("filler");
    std::thread::scope(|scope| {
        scope.spawn(|| fill(&filler, &enough));
        let warning = training.wait_for("the disk is full");
        enough.store(true, Ordering::Relaxed);
        assert!(warning.contains("training waits until there is room"), "{warning}");
    });
    let before = latest(&run).counters;
    std::fs::remove_file(&filler).unwrap();
    let after = await_that("a later checkpoint", || {
        let now = latest(&run).counters;
        (now.updates > before.updates + 2).then_some(now)
    });
    assert_eq!((after.restarts, after.resumes), (0, 0));
    assert_eq!(
        after.env_steps - before.env_steps,
        (after.updates - before.updates) * 512,
        "each batch was learnt from"
    );
    training.signal(libc::SIGINT);
    let (status, lines) = training.wait();
    assert!(status.success(), "{lines:#?}");
}
