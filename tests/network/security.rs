//! Links with certificates: a fleet trains over them, also through a router, and clients of another authority are refused.

use std::{fs, os::unix::fs::PermissionsExt, path::Path};

use treadmill_bus::Role;

use crate::support::*;

fn learner(folder: &Path, run: &Path) -> Running {
    start_endless(folder, run, "learner", &["--listen", "tls/127.0.0.1:0", "--tls", "certs"])
}

#[test]
fn a_fleet_with_certificates_trains_through_a_router() {
    let (folder, run) = folders();
    certs(folder.path(), &["certs"]);
    let learner = learner(folder.path(), &run);
    let router = start(
        folder.path(),
        &["router", "--listen", "tls/127.0.0.1:0", "--connect", &endpoint(&run), "--tls", "certs"],
    );
    let listening = router.wait_for("listening");
    let actor = start(
        folder.path(),
        &["actor", "--envs", "4", "--tls", "certs", "--connect", listening.split_whitespace().last().unwrap()],
    );
    await_steps(&run, 2048);
    for part in [actor, router, learner] {
        part.signal(libc::SIGTERM);
        assert!(part.wait().0.success());
    }
}

#[test]
fn an_encrypted_router_runs_on_one_core() {
    let (folder, _) = folders();
    certs(folder.path(), &["certs"]);
    // Returns for every thread of the bus the number of its cores and its scheduling policy. Threads that read and
    // write links exist after the first link.
    let threads = |args: &[&str]| {
        let router = start(folder.path(), &[&["router"], args].concat());
        router.wait_for("listening");
        let tasks = fs::read_dir(format!("/proc/{}/task", router.pid())).unwrap().flatten();
        let of_the_bus = tasks.filter(|task| {
            let name = fs::read_to_string(task.path().join("comm")).unwrap();
            ["acc-", "net-", "rx-", "tx-"].iter().any(|kind| name.starts_with(kind))
        });
        let facts = of_the_bus.map(|task| {
            // SAFETY: takes and returns numbers.
            let policy = unsafe { libc::sched_getscheduler(task.file_name().to_str().unwrap().parse().unwrap()) };
            let status = fs::read_to_string(task.path().join("status")).unwrap();
            let cores = status.lines().find_map(|line| line.strip_prefix("Cpus_allowed:")).unwrap().trim();
            (cores.bytes().filter_map(|digit| char::from(digit).to_digit(16)).map(u32::count_ones).sum::<u32>(), policy)
        });
        facts.collect::<Vec<_>>()
    };
    let encrypted = threads(&["--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    assert!(!encrypted.is_empty() && encrypted.iter().all(|facts| *facts == (1, libc::SCHED_BATCH)), "{encrypted:?}");
    let plain = threads(&["--listen", "tcp/127.0.0.1:0"]);
    assert!(!plain.is_empty() && plain.iter().all(|(_, policy)| *policy == libc::SCHED_OTHER), "{plain:?}");
}

#[test]
fn a_training_with_certificates_needs_no_further_flag() {
    let (folder, path) = folders();
    assert!(run(folder.path(), &["certs", "certs", "--host", "learner.example"]).status.success());
    for listen in [&[][..], &["--listen", "tls/0.0.0.0:0"]] {
        let run_dir = path.with_extension(listen.len().to_string());
        let args = ["train", "--preset", "smoke", "--steps", "1024", "--tls", "certs", "--run-dir"];
        let trained = run(folder.path(), &[&args, &[run_dir.to_str().unwrap()][..], listen].concat());
        assert!(trained.status.success(), "{listen:?}: {}", stderr(&trained));
    }
    let plain = ["router", "--tls", "certs", "--listen", "tcp/127.0.0.1:0"];
    assert_refused(&run(folder.path(), &plain), 2, &["tcp/127.0.0.1:0", "write tls/127.0.0.1:0"]);
}

#[test]
fn an_actor_of_another_authority_is_refused() {
    let (folder, run) = folders();
    certs(folder.path(), &["certs"]);
    certs(folder.path(), &["others"]);
    let _learner = learner(folder.path(), &run);
    let endpoint = endpoint(&run);
    let stranger = start(folder.path(), &["actor", "--envs", "4", "--tls", "others", "--connect", &endpoint]);
    stranger.wait_for("it is of another authority");
    let _friend =
        start(folder.path(), &["actor", "--envs", "4", "--tls", "certs", "--name", "friend", "--connect", &endpoint]);
    await_steps(&run, 2048);
    assert_eq!(last_value(&run, "actors/alive"), Some(1.0));
}

#[test]
fn hosts_of_certificates_are_listed_added_and_kept() {
    let (folder, _) = folders();
    let certs = |args: &[&str]| {
        let output = run(folder.path(), &[&["certs", "certs"], args].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output)
    };
    let read = |name: &str| fs::read(folder.path().join("certs").join(name)).unwrap();
    let text = certs(&["--host", "first.example"]);
    assert!(
        text.contains("the learner's is valid until") && text.contains("for localhost 127.0.0.1 ::1 first.example"),
        "{text}"
    );
    let (actor, learner) = (read("actor.crt"), read("learner.crt"));
    let text = certs(&["--host", "2001:db8::0001"]);
    assert!(text.contains("wrote certificates and keys of learner, standby, router to certs"), "{text}");
    assert!(text.contains("364 days more, for localhost 127.0.0.1 ::1 first.example 2001:db8::1"), "{text}");
    assert!(read("actor.crt") == actor && read("learner.crt") != learner, "only roles that listen name hosts");
    let learner = read("learner.crt");
    let text = certs(&["--host", "::0001", "--host", "2001:db8::1"]);
    assert!(text.contains("nothing to do") && text.contains("first.example 2001:db8::1"), "{text}");
    assert_eq!(read("learner.crt"), learner);
    let text = certs(&["--renew", "--days", "30"]);
    assert!(text.contains("29 days more, for localhost 127.0.0.1 ::1 first.example 2001:db8::1"), "{text}");
    assert!(read("actor.crt") != actor && read("learner.crt") != learner);
}

#[test]
fn certificates_are_created_once_and_only_the_owner_can_read_keys() {
    let (folder, _) = folders();
    certs(folder.path(), &["certs", "--host", "learner.example"]);
    let read = |name: &str| fs::read(folder.path().join("certs").join(name)).unwrap();
    let (authority, actor) = (read("ca.crt"), read("actor.crt"));
    for key in ["ca.key", "learner.key", "operator.key"] {
        let mode = fs::metadata(folder.path().join("certs").join(key)).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600, "{key}");
    }
    certs(folder.path(), &["certs", "--host", "learner.example"]);
    assert_eq!(read("actor.crt"), actor);
    certs(folder.path(), &["certs", "--host", "learner.example", "--renew"]);
    assert_ne!(read("actor.crt"), actor);
    assert_eq!(read("ca.crt"), authority);
    fs::remove_file(folder.path().join("certs/ca.key")).unwrap();
    assert_refused(&run(folder.path(), &["certs", "certs"]), 2, &["only one of ca.crt and ca.key"]);
    fs::remove_file(folder.path().join("certs/actor.key")).unwrap();
    let args = ["actor", "--connect", "tls/127.0.0.1:1", "--tls", "certs"];
    assert_refused(&run(folder.path(), &args), 2, &["actor.key", "treadmill certs"]);
}

#[test]
fn a_certificate_that_no_other_side_accepts_is_an_error_at_once() {
    let (folder, _) = folders();
    certs(folder.path(), &["certs"]);
    let at = |name: &str| folder.path().join(name);
    // Zenoh would dial on in silence.
    let actor = ["actor", "--connect", "tls/127.0.0.1:1", "--tls"];
    fs::create_dir(at("expired")).unwrap();
    fs::copy(at("certs/ca.crt"), at("expired/ca.crt")).unwrap();
    issue(Role::Actor, &at("certs"), &at("expired"), [-9, -1]);
    assert_refused(&run(folder.path(), &[&actor[..], &["expired"]].concat()), 2, &["expired at", "--renew"]);
    fs::copy(at("certs/observer.key"), at("certs/actor.key")).unwrap();
    let refused = run(folder.path(), &[&actor[..], &["certs"]].concat());
    assert_refused(&refused, 2, &["actor.key does not match", "copy both files"]);
    fs::write(at("certs/router.crt"), "nonsense").unwrap();
    let router = run(folder.path(), &["router", "--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    assert_refused(&router, 2, &["router.crt is not a certificate"]);
    fs::write(at("certs/learner.crt"), "nonsense").unwrap();
    let train = run(folder.path(), &["train", "--preset", "smoke", "--tls", "certs", "--run-dir", "never"]);
    assert_refused(&train, 2, &["learner.crt is not a certificate"]);
    assert!(!at("never").exists());
}

#[test]
fn printed_commands_start_actors_and_resume_a_learner_with_its_certificates() {
    let (folder, run) = folders();
    done(folder.path(), &["certs", "certs"]);
    let shell = |command: &str| start_printed(folder.path(), command);
    let after = |line: String, part: &str| line.split_once(part).unwrap().1.to_string();
    let learner = learner(folder.path(), &run);
    let actor = shell(&after(learner.wait_for("  actors    "), "start some by: "));
    let command = after(learner.wait_for("  resume    "), "  resume    ");
    assert_eq!(fs::read_to_string(run.join("resume.txt")).unwrap().trim(), command);
    await_steps(&run, 1024);
    let listened = endpoint(&run);
    learner.signal(libc::SIGTERM);
    learner.wait();
    drop(actor);
    let before = last_step(&run);
    let resumed = shell(&command);
    let actor = shell(&after(resumed.wait_for("  actors    "), "start some by: "));
    // The system chose the ports.
    let lost = resumed.wait_for("the run listened elsewhere before");
    assert!(lost.ends_with(&format!("--listen {listened}")), "{lost}");
    await_steps(&run, before + 1024);
    drop((resumed, actor));

    // A folder with the learner's keys alone is not offered to others.
    for role in ["actor", "observer"] {
        for kind in ["key", "crt"] {
            fs::remove_file(folder.path().join(format!("certs/{role}.{kind}"))).unwrap();
        }
    }
    let alone = self::learner(folder.path(), &folder.path().join("alone"));
    assert!(alone.wait_for("  actors    ").contains("--tls DIR --run alone"));
    alone.wait_for("  DIR       ");
}
