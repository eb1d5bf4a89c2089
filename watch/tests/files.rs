//! Recordings of a saved policy and of a training run, and refused arguments.

mod support;

use std::{collections::BTreeMap, fs, io::BufReader, path::Path};

use rerun::{
    external::re_log_encoding::DecoderApp,
    log::{Chunk, LogMsg},
};
use support::*;
use treadmill_humanoid::{HUMANOID_XML, Model};

/// Returns the rows of each entity of a recording, and whether it has a layout.
fn read(file: &Path) -> (BTreeMap<String, usize>, bool) {
    let mut rows = BTreeMap::new();
    let mut has_layout = false;
    for message in DecoderApp::decode_lazy(BufReader::new(fs::File::open(file).expect("it was written"))) {
        match message.expect("a whole recording") {
            LogMsg::ArrowMsg(store, message) if store.is_recording() => {
                let chunk = Chunk::from_arrow_msg(&message).expect("a sound chunk");
                *rows.entry(chunk.entity_path().to_string()).or_default() += chunk.num_rows();
            }
            LogMsg::BlueprintActivationCommand(_) => has_layout = true,
            _ => {}
        }
    }
    (rows, has_layout)
}

#[test]
fn a_played_episode_is_written_as_a_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut command = viewer(folder.path());
    command.arg(policy()).args(["--episodes", "1", "--for-s", "3", "--rrd", "walk.rrd"]);
    let output = command.output().expect("the viewer starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let (rows, has_layout) = read(&folder.path().join("walk.rrd"));
    assert!(has_layout);
    let shapes: usize =
        Model::from_mjcf(HUMANOID_XML).expect("valid").bodies.iter().map(|body| body.shapes.len()).sum();
    // 3 s in steps of 15 ms.
    for path in ["/world/body/torso", "/world/trail", "/world/contacts/forces"] {
        assert_eq!(rows.get(path), Some(&200), "{path} in {rows:#?}");
    }
    // One more row has the names of the curves.
    for path in ["/reward", "/velocity", "/torques"] {
        assert_eq!(rows.get(path), Some(&201), "{path} in {rows:#?}");
    }
    assert_eq!(rows.get("/world/floor/lines"), Some(&1));
    assert_eq!(rows.keys().filter(|path| path.contains("/shape-")).count(), shapes);
    assert!(rows["/world/floor"] > 3, "the floor must follow");
}

#[test]
fn a_training_run_is_watched_live() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(mut command) = treadmill(folder.path()) else { return };
    command.args(["train", "--preset", "smoke", "--steps", "1000000000", "--run-dir", "run", "--no-progress"]);
    let training = Running::start(command);
    training.wait_for("listening");
    let mut command = treadmill(folder.path()).expect("as before");
    command.args(["watch", "--live", "run", "--for-s", "3", "--rrd", "live.rrd"]);
    let live = Running::start(command);
    live.wait_for("watching actor-");
    live.wait_for("written: live.rrd");
    assert!(live.wait().0.success());
    let (rows, has_layout) = read(&folder.path().join("live.rrd"));
    assert!(has_layout);
    // Every other control step of 3 s, minus the gaps between episodes.
    assert!((50..=101).contains(&rows["/world/body/torso"]), "{rows:#?}");
    assert_eq!(rows["/world/body/torso"], rows["/reward"] - 1);
    assert!(rows["/episodes"] > 1, "an untrained body falls soon");
    // Ctrl-C ends it.
    let mut command = treadmill(folder.path()).expect("as before");
    command.args(["watch", "--live", "run", "--rrd", "asked.rrd"]);
    let live = Running::start(command);
    live.wait_for("watching actor-");
    live.signal(libc::SIGINT);
    assert!(live.wait().0.success());
    assert!(read(&folder.path().join("asked.rrd")).1);
}

#[test]
fn invalid_arguments_are_refused_by_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let refused = |args: &[&str], code: i32, parts: &[&str]| {
        let mut command = viewer(folder.path());
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").args(args);
        let output = command.output().expect("the viewer starts");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{args:?}: {text}");
        parts.iter().for_each(|part| assert!(text.contains(part), "`{part}` is missing in: {text}"));
        assert!(!text.contains("panicked"), "{text}");
    };
    let policy = policy();
    let policy = policy.to_str().expect("a plain path");
    refused(&[], 2, &["treadmill watch runs/walk-1", "--live"]);
    refused(&["absent"], 2, &["absent"]);
    refused(&[policy, "--native"], 2, &["no display", "docs/guide/watch.md"]);
    refused(&[policy, "--bind", "0.0.0.0"], 2, &["--bind 0.0.0.0", "--insecure", "ssh"]);
    refused(&[policy, "--rrd", "absent/a.rrd"], 1, &["--rrd absent/a.rrd"]);
    refused(&[policy, "--speed", "0"], 2, &["--speed"]);
    refused(&[policy, "--actor", "a"], 2, &["--live"]);
    refused(&["--live", "--connect", "tcp/127.0.0.1:9", "--actor", "a/b"], 2, &["--actor", "a/b"]);
    refused(&["--live", "--connect", "tcp/127.0.0.1:9"], 1, &["no process listens at tcp/127.0.0.1:9"]);
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("an address").port().to_string();
    refused(&[policy, "--web-port", &port], 2, &["--web-port", &port]);
    refused(&[policy, "--web-port", "0", "--data-port", &port], 2, &["--data-port", &port]);
}
