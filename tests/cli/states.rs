//! What `status`, `runs` and `check` say of runs that ended, were killed, lie in a store, or cannot be read.

use std::{fs, io::ErrorKind, os::unix::fs::PermissionsExt, path::Path};

use crate::support::*;
use std::os::unix::process::CommandExt;

#[test]
fn a_killed_run_is_no_stopped_one() {
    let (folder, run_folder) = folders();
    let training = start_endless(folder.path(), &run_folder, "train", &["--no-progress"]);
    await_steps(&run_folder, 2048);
    training.signal(libc::SIGKILL);
    let _ = training.wait();
    let status = run(folder.path(), &["status", "run"]);
    assert_refused(&status, 1, &["was killed", "last checkpoint"]);
    let text = stdout(&status);
    assert!(text.contains("run `run` is killed") && text.contains("--resume run"), "{text}");
    let status = run(folder.path(), &["status", "run", "--json"]);
    assert_eq!((status.status.code(), last_json(&status)["phase"].as_str()), (Some(1), Some("killed")));
    assert!(stdout(&run(folder.path(), &["runs", "run"])).contains("killed"));
    // A clean end after it.
    let training = start(folder.path(), &["train", "--resume", "run", "--no-progress"]);
    training.wait_for("  resume    ");
    stop(training);
    let status = run(folder.path(), &["status", "run", "--json"]);
    assert_eq!((status.status.code(), last_json(&status)["phase"].as_str()), (Some(0), Some("stopped")));
}

#[test]
fn a_leader_that_was_killed_is_not_taken_for_another_machines() {
    let (folder, run_folder) = folders();
    let url = format!("file://{}/store", folder.path().display());
    let training = start_endless(folder.path(), &run_folder, "train", &["--no-progress", "--store", &url]);
    await_steps(&run_folder, 1024);
    let (pid, host) = (training.pid(), treadmill_runtime::machine::host_name());
    training.signal(libc::SIGKILL);
    let _ = training.wait();
    let status = run(folder.path(), &["status", "run"]);
    assert_refused(&status, 1, &["was killed"]);
    assert!(stdout(&status).contains("run `run` is killed"), "{}", stdout(&status));
    // The lock of another process was left behind here.
    let lock = fs::read_to_string(run_folder.join("lock.json")).unwrap();
    fs::write(run_folder.join("lock.json"), lock.replace(&pid.to_string(), "1")).unwrap();
    let status = run(folder.path(), &["status", "run"]);
    let wanted = format!("led elsewhere: its store names process {pid} on host {host}");
    assert!(status.status.success() && stdout(&status).contains(&wanted), "{}", stdout(&status));
}

#[test]
fn a_run_in_a_store_is_shown_and_checked_by_its_url() {
    let folder = tempfile::tempdir().unwrap();
    let url = format!("file://{}/store", folder.path().display());
    let missing = run(folder.path(), &["status", &url]);
    assert_refused(&missing, 2, &["holds no run"]);
    let text = stdout(&run(folder.path(), &["check", &url]));
    assert!(text.contains("note     store") && text.contains("holds no run"), "{text}");
    assert!(!folder.path().join("store").exists(), "a mistyped folder is not created");
    let train =
        ["train", "--preset", "smoke", "--actors", "1", "--run-dir", "walk", "--steps", "2048", "--no-progress"];
    done(folder.path(), &[&train[..], &["--store", &url]].concat());
    let text = stdout(&run(folder.path(), &["status", &url]));
    assert!(text.contains("run `walk` is finished") && text.contains("2,048") && text.contains(&url), "{text}");
    let of_url = run(folder.path(), &["runs", "--json", &url]);
    assert_eq!(
        (last_json(&of_url)["run"].as_str(), last_json(&of_url)["env_steps"].as_u64()),
        (Some("walk"), Some(2048))
    );
    let text = stdout(&run(folder.path(), &["check", "walk"]));
    assert!(text.contains("ok       store") && text.contains("holds run `walk` after 2,048 env steps"), "{text}");
    assert!(text.contains("refuses writes whose condition does not hold"), "{text}");
    assert!(text.lines().any(|line| line.contains("disk") && line.ends_with("/walk")), "{text}");
}

#[test]
fn a_damaged_key_is_never_in_order() {
    let folder = tempfile::tempdir().unwrap();
    done(folder.path(), &["certs", "certs"]);
    let key = folder.path().join("certs/learner.key");
    let sound = fs::read(&key).unwrap();
    fs::write(&key, "nonsense").unwrap();
    let refused = run(folder.path(), &["certs", "certs"]);
    assert_refused(&refused, 1, &["1 of the certificates", "--renew"]);
    let text = stdout(&refused);
    assert!(text.contains("learner.key is not a private key") && !text.contains("nothing to do"), "{text}");
    fs::write(&key, sound).unwrap();
    assert!(stdout(&run(folder.path(), &["certs", "certs"])).contains("nothing to do"));
}

/// Runs the binary as a user without rights: root may read everything, and only root can become another user.
fn without_rights(folder: &Path, args: &[&str]) -> std::process::Output {
    let copy = folder.join("treadmill");
    fs::copy(env!("CARGO_BIN_EXE_treadmill"), &copy).unwrap();
    fs::set_permissions(&copy, fs::Permissions::from_mode(0o755)).unwrap();
    loop {
        match std::process::Command::new(&copy).args(args).current_dir(folder).uid(65_534).output() {
            // A process that another test starts at this moment still holds the file open for writing.
            Err(why) if why.kind() == ErrorKind::ExecutableFileBusy => std::thread::yield_now(),
            done => return done.unwrap_or_else(|_| run(folder, args)),
        }
    }
}

#[test]
fn what_cannot_be_read_is_neither_missing_nor_damaged() {
    let folder = tempfile::tempdir().unwrap();
    let allow =
        |name: &str, mode| fs::set_permissions(folder.path().join(name), fs::Permissions::from_mode(mode)).unwrap();
    allow("", 0o755);
    trained(folder.path(), Path::new("run"));
    done(folder.path(), &["certs", "certs"]);
    allow("run", 0o000);
    let status = without_rights(folder.path(), &["status", "run"]);
    // So that the folder can be removed.
    allow("run", 0o755);
    assert_refused(&status, 2, &["`run` cannot be read", "the right to read it"]);
    allow("certs/learner.key", 0o000);
    let text = stdout(&without_rights(folder.path(), &["check", "--tls", "certs"]));
    assert!(text.contains("learner.key cannot be read") && !text.contains("does not match"), "{text}");
}

#[test]
fn several_runs_are_followed_line_by_line() {
    let (folder, _) = folders();
    let train =
        |name: &str| start_endless(folder.path(), Path::new(name), "train", &["--no-progress", "--actors", "1"]);
    let (_one, _other) = (train("runs/one"), train("runs/other"));
    for name in ["runs/one", "runs/other"] {
        await_steps(&folder.path().join(name), 512);
    }
    let watch = start(folder.path(), &["status", "--watch"]);
    for name in ["one", "other", "one"] {
        watch.wait_for(name);
    }
}

/// Returns the commands in printed lines, without what is said about them.
fn printed_commands(lines: &[String]) -> Vec<String> {
    let command = |line: &String| {
        let command = &line[line.find("treadmill ")?..];
        let command = command.split("  (").next()?.split(", also").next()?;
        // The viewer is another program.
        (!command.contains(" watch ")).then(|| command.trim().to_string())
    };
    lines.iter().filter_map(command).collect()
}

#[test]
fn every_command_that_a_training_prints_runs_as_printed() {
    let (folder, run_folder) = folders();
    let printed = |command: &str| start_printed(folder.path(), command);
    let training = start_endless(folder.path(), &run_folder, "train", &["--no-progress", "--actors", "1"]);
    await_steps(&run_folder, 1024);
    // The banner ends with the line that resumes.
    let mut lines = vec![training.wait_for("  watch     "), training.wait_for("  film      ")];
    lines.push(training.wait_for("  resume    "));
    let [watch, film, resume] = &printed_commands(&lines)[..] else { panic!("{lines:?}") };
    let mut watching = printed(watch);
    watching.wait_for("run");
    watching = printed(film);
    assert!(watching.wait().0.success(), "{film}");
    training.signal(libc::SIGINT);
    let (_, lines) = training.wait();
    let commands = printed_commands(&lines);
    assert!(commands.iter().any(|command| command == resume), "{resume} in {commands:?}");
    let mut resumed = 0;
    for command in &commands {
        let running = printed(command);
        if command.contains("--resume") {
            running.wait_for("  resume    ");
            stop(running);
            resumed += 1;
        } else {
            assert!(running.wait().0.success(), "{command}");
        }
    }
    assert!(resumed == 1 && commands.len() >= 3, "{commands:?}");
    // A run that has all its steps.
    let finished =
        run(folder.path(), &["train", "--preset", "smoke", "--steps", "512", "--run-dir", "done", "--actors", "1"]);
    let lines: Vec<String> = stdout(&finished).lines().map(str::to_string).collect();
    let further = lines.iter().find_map(|line| line.strip_prefix("train it further: ")).expect("the line");
    assert!(printed(further).wait().0.success(), "{further}");
    let again = stdout(&run(folder.path(), &["train", "--resume", "done"]));
    let further = again.split("go on with: ").nth(1).expect("the command").trim().to_string();
    assert!(printed(&further).wait().0.success(), "{further}");
    // A run that nothing trains, and one that does not exist.
    let idle = stdout(&run(folder.path(), &["status", "run"]));
    let resume = idle.lines().find_map(|line| line.strip_prefix("  resume     ")).expect("the line");
    let resumed = printed(resume);
    resumed.wait_for("  resume    ");
    stop(resumed);
}

/// Returns the only command in backticks that an output has.
fn quoted_command(output: &std::process::Output) -> String {
    let text = stdout(output) + &stderr(output);
    let mut commands: Vec<&str> = text.split('`').filter(|part| part.starts_with("treadmill ")).collect();
    commands.dedup();
    let [command] = commands[..] else { panic!("{text}") };
    command.to_string()
}

#[test]
fn remedies_run_as_printed() {
    let folder = tempfile::tempdir().unwrap();
    let succeeds = |command: &str| {
        let (status, lines) = start_printed(folder.path(), command).wait();
        assert!(status.success(), "{command}: {lines:#?}");
        lines.join("\n")
    };
    // Certificates that end soon, in a folder that a shell would take for two.
    done(folder.path(), &["certs", "my certs", "--days", "2"]);
    let renewal = quoted_command(&run(folder.path(), &["check", "--tls", "my certs"]));
    succeeds(&renewal.replace("--renew", "--renew --bundles bundles"));
    assert!(!stdout(&run(folder.path(), &["check", "--tls", "my certs"])).contains("--renew"));

    // A learner without actors, and actors that only have their own keys.
    let learner_run = folder.path().join("learner");
    let encrypted = ["--listen", "tls/127.0.0.1:0", "--tls", "my certs"];
    let learner = start_endless(folder.path(), &learner_run, "learner", &encrypted);
    learner.wait_for("  resume    ");
    let check = |tls: &str| {
        let checked = stdout(&run(folder.path(), &["check", "learner", "--tls", tls]));
        let line = checked.lines().find_map(|line| line.split_once("start an actor: ")).expect(&checked);
        line.1.to_string()
    };
    let without_keys = check("bundles/observer");
    assert!(without_keys.contains("--tls DIR"), "{without_keys}");
    let actor = start_printed(folder.path(), &check("my certs"));
    await_steps(&learner_run, 512);
    drop(actor);
    stop(learner);

    // A store without a run, and with one.
    let url = format!("file://{}/my store", folder.path().display());
    let start_one = quoted_command(&run(folder.path(), &["status", &url]));
    assert_eq!(start_one, quoted_command(&run(folder.path(), &["runs", &url])));
    assert_eq!(start_one, quoted_command(&run(folder.path(), &["check", &url])));
    let learner = start_printed(folder.path(), &start_one);
    learner.wait_for("  resume    ");
    stop(learner);
    let idle = stdout(&run(folder.path(), &["status", &url]));
    let resume = idle.lines().find_map(|line| line.strip_prefix("  resume     ")).expect("the line");
    let resumed = start_printed(folder.path(), resume);
    resumed.wait_for("  resume    ");
    stop(resumed);

    // Several runs below a folder.
    fs::rename(&learner_run, folder.path().join("runs/learner")).unwrap();
    let listed = stdout(&run(folder.path(), &["runs", "runs"]));
    let keys = listed.lines().find_map(|line| line.strip_prefix("Configuration keys that differ: ")).expect("the line");
    assert!(succeeds(keys).contains("run.steps = "), "{keys}");

    // A model in which no feet are found.
    let ghost = ROBOT_XML.replace("class=\"solid\"", "class=\"solid\" contype=\"0\" conaffinity=\"0\"");
    fs::write(folder.path().join("my robot.xml"), ghost).unwrap();
    let draft = quoted_command(&run(folder.path(), &["train", "--task", "velocity", "--model", "my robot.xml"]));
    succeeds(&draft);
    assert!(folder.path().join("card.toml").is_file());
}
