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
fn a_robot_is_steered_by_letters() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let Some(mut command) = treadmill(folder.path()) else { return };
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../actor/humanoid/assets/g1-like-servos.xml");
    let card = format!(
        "model = '{}'\nfeet = ['left_foot', 'right_foot']\n[[hinges]]\nnames = '*'\neffort_nm = 60.0\n",
        model.display()
    );
    fs::write(folder.path().join("card.toml"), card).expect("a card");
    command.args(["train", "--preset", "smoke", "--steps", "1024", "--model", "card.toml", "--run-dir", "run"]);
    command.args(["--set", "env.task=velocity", "--set", "env.control_step_s=0.02", "--no-progress"]);
    let trained = command.output().expect("it starts");
    assert!(trained.status.success(), "{}", String::from_utf8_lossy(&trained.stderr));

    let mut command = viewer(folder.path());
    command.args(["run", "--steer", "--for-s", "1", "--speed", "20", "--rrd", "steered.rrd"]);
    let letters = tempfile::NamedTempFile::new().expect("a file");
    fs::write(letters.path(), "wwq").expect("letters");
    command.stdin(fs::File::open(letters.path()).expect("letters"));
    let output = command.output().expect("the viewer starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("w s forward and back"));
    let (rows, _) = read(&folder.path().join("steered.rrd"));
    // 1 s in steps of 20 ms, perhaps in several episodes with gaps; one more row has the names of the curves.
    let steps = rows["/world/velocities"];
    assert!((20..=51).contains(&steps), "{rows:#?}");
    assert_eq!(rows["/commands"], steps + 1, "{rows:#?}");
}

#[test]
fn visual_meshes_replace_the_shapes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    // A tetrahedron, in the frame of the humanoid's torso.
    fs::write(
        folder.path().join("part.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    )
    .expect("a mesh");
    let text = "<mujoco><asset><mesh name='part' file='part.obj' scale='0.1 0.1 0.1'/></asset><worldbody>\
                <body name='torso'><geom type='mesh' mesh='part' contype='0' conaffinity='0' rgba='1 0 0 1'/>\
                <geom type='mesh' mesh='part'/></body></worldbody></mujoco>";
    fs::write(folder.path().join("seen.xml"), text).expect("a model");
    let mut command = viewer(folder.path());
    command.arg(policy()).args(["--episodes", "1", "--for-s", "0.3", "--rrd", "seen.rrd", "--model", "seen.xml"]);
    let output = command.output().expect("the viewer starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let (rows, _) = read(&folder.path().join("seen.rrd"));
    assert_eq!(rows.get("/world/body/torso/visual-0"), Some(&1), "{rows:#?}");
    assert!(!rows.keys().any(|path| path.contains("/shape-") || path.contains("visual-1")), "{rows:#?}");
}

#[test]
fn invalid_arguments_are_refused_by_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let refused = |args: &[&str], code: i32, parts: &[&str]| {
        let mut command = viewer(folder.path());
        command.args(args);
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
    refused(&[policy, "--bind", "0.0.0.0"], 2, &["--bind 0.0.0.0", "--insecure", "ssh"]);
    refused(&[policy, "--rrd", "absent/a.rrd"], 1, &["--rrd absent/a.rrd"]);
    refused(&[policy, "--speed", "0"], 2, &["--speed"]);
    refused(&[policy, "--actor", "a"], 2, &["--live"]);
    refused(&[policy, "--steer", "--rrd", "a.rrd"], 2, &["--steer", "no commands", "--preset g1"]);
    refused(&[policy, "--model", "absent.xml", "--rrd", "a.rrd"], 1, &["absent.xml"]);
    refused(&["--live", "--connect", "tcp/127.0.0.1:9", "--actor", "a/b"], 2, &["--actor", "a/b"]);
    refused(&["--live", "--connect", "tcp/127.0.0.1:9"], 1, &["no process listens at tcp/127.0.0.1:9"]);
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("an address").port().to_string();
    refused(&[policy, "--web-port", &port], 2, &["--web-port", &port]);
    refused(&[policy, "--web-port", "0", "--data-port", &port], 2, &["--data-port", &port]);
}
