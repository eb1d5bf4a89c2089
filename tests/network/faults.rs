//! Killed and frozen processes: the others continue, and no loss goes unreported.

use std::{fs, os::unix::process::CommandExt, path::Path, process::Stdio};

use crate::support::*;
use treadmill_bus::observer::observe;
use treadmill_learner::checkpoint::load_file;
use treadmill_proto::ActorStats;

fn actor(folder: &Path, endpoint: &str, name: &str) -> Running {
    start(folder, &["actor", "--connect", endpoint, "--envs", "4", "--name", name])
}

/// Waits until another process has replaced the killed actor-0, then stops the training.
fn await_restart(training: Running, run: &Path, killed: u32) {
    await_that("another actor-0", || children(training.pid(), "actor-0").first().copied().filter(|pid| *pid != killed));
    await_that("the count of restarts", || last_value(run, "actors/restarts").filter(|restarts| *restarts == 1.0));
    await_that("two actors", || last_value(run, "actors/alive").filter(|alive| *alive == 2.0));
    stop(training);
}

#[test]
fn a_killed_actor_is_restarted_and_counted() {
    let (folder, run) = folders();
    let training = start_endless(folder.path(), &run, "train", &[]);
    await_steps(&run, 1024);
    let killed = children(training.pid(), "actor-0");
    assert_eq!(killed.len(), 1);
    send_signal(killed[0], libc::SIGKILL);
    training.wait_for("actor-0 ended");
    await_restart(training, &run, killed[0]);
}

#[test]
fn an_actor_is_restarted_after_the_program_was_replaced() {
    let (folder, run) = folders();
    let program = folder.path().join("treadmill");
    fs::copy(env!("CARGO_BIN_EXE_treadmill"), &program).unwrap();
    let given = endless(folder.path(), &run, "train");
    let mut command = std::process::Command::new(&program);
    command.args(given.get_args()).current_dir(folder.path()).stdin(Stdio::null());
    let training = Running::start(command);
    await_steps(&run, 512);
    fs::remove_file(&program).unwrap();
    let killed = children(training.pid(), "actor-0");
    send_signal(killed[0], libc::SIGKILL);
    await_restart(training, &run, killed[0]);
}

#[test]
fn fragments_of_a_large_actor_fit_into_messages() {
    let (folder, run) = folders();
    let learner = start(folder.path(), &["learner", "--run-dir", run.to_str().unwrap(), "--listen", "tcp/127.0.0.1:0"]);
    // 128 steps, the horizon of 64 environments, would be 33 MB.
    let large = ["actor", "--connect", &endpoint(&run), "--envs", "1000", "--name", "large"];
    let large = start(folder.path(), &large);
    await_steps(&run, 30_000);
    assert!(is_running(large.pid()));
    drop((large, learner));
}

#[test]
fn actors_of_a_killed_train_exit() {
    let (folder, run) = folders();
    let training = start_endless(folder.path(), &run, "train", &[]);
    await_steps(&run, 512);
    let orphans = children(training.pid(), "actor");
    assert_eq!(orphans.len(), 2);
    training.signal(libc::SIGKILL);
    await_that("the end of the orphans", || orphans.iter().all(|pid| !is_running(*pid)).then_some(()));
}

#[test]
fn an_actor_without_a_learner_warns_and_retries() {
    let (folder, run) = folders();
    let [endpoint] = free_endpoints("tcp");
    let waiting = actor(folder.path(), &endpoint, "early");
    waiting.wait_for(&endpoint);
    assert!(is_running(waiting.pid()));
    let learner = start_endless(folder.path(), &run, "learner", &["--listen", &endpoint]);
    await_steps(&run, 512);
    drop((learner, waiting));
}

#[test]
fn a_killed_learner_is_resumed_while_its_actors_wait() {
    let (folder, run) = folders();
    let learner = start_endless(folder.path(), &run, "learner", &["--listen", "tcp/127.0.0.1:0"]);
    let endpoint = endpoint(&run);
    let actors = [actor(folder.path(), &endpoint, "a"), actor(folder.path(), &endpoint, "b")];
    await_steps(&run, 2048);
    learner.signal(libc::SIGKILL);
    learner.wait();
    let saved = load_file(&run.join("checkpoints/latest.bundle")).unwrap();

    let learner = start(
        folder.path(),
        &["learner", "--resume", run.to_str().unwrap(), "--steps", ENDLESS, "--listen", &endpoint],
    );
    await_steps(&run, saved.counters.env_steps + 4096);
    assert!(actors.iter().all(|actor| is_running(actor.pid())), "actors outlive the learner");

    // In the actors' counts, produced = accepted + dropped by rule + in flight, and nothing piles up.
    let bus = join(&run);
    let feed = observe(&bus, "treadmill/run/actors/*/stats", 16).unwrap();
    for _ in 0..4 {
        let message = feed.next(TIMEOUT).expect("statistics");
        let stats = ActorStats::decode_checked(&message.payload).unwrap();
        assert_eq!(stats.produced, stats.accepted + stats.dropped_by_rule + stats.in_flight, "{stats:?}");
        assert!(stats.accepted > 0, "{stats:?}");
        assert!(stats.awaiting_durability <= 3, "a batch is two fragments: {stats:?}");
    }
    bus.close();
    stop(learner);

    let after = load_file(&run.join("checkpoints/latest.bundle")).unwrap();
    assert!(after.counters.env_steps >= saved.counters.env_steps + 4096);
    assert_eq!(after.ppo.gradient_steps(), after.counters.gradient_steps, "no gradient step is lost");
    // Every accepted fragment of 4 environments and 64 steps was learnt from, exactly once.
    assert_eq!(after.counters.env_steps, after.fragment_counts.accepted * 4 * 64);
    assert_eq!(after.fragment_counts.malformed, 0);
}

#[test]
fn an_actor_joins_the_run_that_replaces_its_own() {
    let (folder, run) = folders();
    let learner = start_endless(folder.path(), &run, "learner", &["--listen", "tcp/127.0.0.1:0"]);
    let endpoint = endpoint(&run);
    let actor = actor(folder.path(), &endpoint, "a");
    await_steps(&run, 1024);
    learner.signal(libc::SIGKILL);
    learner.wait();

    // Same name and address, other observations: fragments of the first run would be malformed in the second.
    let other = folder.path().join("other/run");
    let keys = set(&["env.observation=gymnasium-v5"]);
    let learner = start_endless(folder.path(), &other, "learner", &[&["--listen", &endpoint], &keys[..]].concat());
    actor.wait_for("the learner replaced the run; rejoining");
    await_steps(&other, 1024);
    stop(learner);
    let counts = load_file(&other.join("checkpoints/latest.bundle")).unwrap().fragment_counts;
    assert!(counts.accepted > 0, "{counts:?}");
    assert_eq!((counts.malformed, counts.quarantined), (0, 0), "{counts:?}");
    stop(actor);
}

#[test]
fn a_failed_save_ends_the_run_with_the_last_checkpoint_intact() {
    let (folder, run) = folders();
    let first = ["train", "--preset", "smoke", "--steps", "1024", "--run-dir", run.to_str().unwrap()];
    assert!(self::run(folder.path(), &first).status.success());
    let latest = run.join("checkpoints/latest.bundle");
    let valid = fs::read(&latest).unwrap();

    let mut command = treadmill(folder.path());
    command.args(["train", "--resume", run.to_str().unwrap(), "--steps", ENDLESS]).stdin(Stdio::null());
    let limit = (valid.len() / 2) as u64;
    // SAFETY: both calls only change limits and signals of the child before it executes the program.
    unsafe {
        command.pre_exec(move || {
            // Files cannot exceed half a checkpoint, as on a nearly full disk.
            let limit = libc::rlimit { rlim_cur: limit, rlim_max: limit };
            libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
            if libc::setrlimit(libc::RLIMIT_FSIZE, &limit) == 0 { Ok(()) } else { Err(std::io::Error::last_os_error()) }
        });
    }
    let output = command.output().unwrap();
    assert_refused(&output, 1, &["cannot save checkpoint", "latest.bundle", "the one before it is untouched"]);
    assert_eq!(fs::read(&latest).unwrap(), valid);
    let left: Vec<_> =
        fs::read_dir(run.join("checkpoints")).unwrap().flatten().map(|entry| entry.file_name()).collect();
    assert!(!left.iter().any(|name| name.to_string_lossy().ends_with(".tmp")), "{left:?}");
}

#[test]
fn a_failed_copy_of_a_checkpoint_ends_the_run_although_its_policy_was_announced() {
    let (folder, run) = folders();
    let train = |flags: &[&str]| self::run(folder.path(), &[&["train"], flags].concat());
    let every = "learner.checkpoint_every_updates=1";
    let path = run.to_str().unwrap();
    assert!(train(&["--preset", "smoke", "--steps", "1024", "--set", every, "--run-dir", path]).status.success());
    // A folder with the name of a later numbered checkpoint.
    fs::create_dir_all(run.join("checkpoints/00000004.bundle/x")).unwrap();
    let output = train(&["--resume", path, "--steps", ENDLESS]);
    assert_refused(&output, 1, &["cannot save checkpoint", "00000004.bundle"]);
}

#[test]
fn a_second_actor_of_the_same_name_is_refused_and_a_successor_is_not() {
    let (folder, run) = folders();
    let _learner = start_endless(folder.path(), &run, "learner", &["--listen", "tcp/127.0.0.1:0"]);
    let at = endpoint(&run);
    let actor = || actor(folder.path(), &at, "twin");
    let first = actor();
    first.wait_for("joined run `run` as `twin` with 4 environments");
    await_that("the actor is alive", || last_value(&run, "actors/alive").filter(|alive| *alive == 1.0));
    let (status, lines) = actor().wait();
    assert_eq!(status.code(), Some(1), "{lines:?}");
    assert!(lines.iter().any(|line| line.contains("an actor named `twin` is in the run `run` already")), "{lines:?}");
    first.signal(libc::SIGKILL);
    let next = actor();
    next.wait_for("joined run `run`");
    next.signal(libc::SIGTERM);
    let (status, lines) = next.wait();
    assert!(status.success());
    assert!(
        lines.iter().any(|line| line.starts_with("left run `run`: ") && line.contains("steps simulated")),
        "{lines:?}"
    );
}

/// Lets a process go on even if the test fails; it would not see its parent's end.
struct Thawed(u32);

impl Drop for Thawed {
    fn drop(&mut self) {
        // SAFETY: kill takes two numbers and accesses no memory. It fails if the process has ended.
        unsafe { libc::kill(self.0 as i32, libc::SIGCONT) };
    }
}

#[test]
fn a_token_that_routers_keep_of_a_killed_actor_is_no_obstacle() {
    let (folder, run) = folders();
    let _learner = start_endless(folder.path(), &run, "learner", &["--listen", "tcp/127.0.0.1:0"]);
    let endpoint = endpoint(&run);
    let bus = join(&run);
    // No actor with this name sends anything.
    let _kept = treadmill_bus::actor::token(&bus, "run", "one").unwrap();
    let actor = actor(folder.path(), &endpoint, "one");
    actor.wait_for("the token of an actor of this name is there, but it sends nothing");
    actor.wait_for("joined run");
}

#[test]
fn a_frozen_actor_does_not_delay_the_others() {
    let (folder, run) = folders();
    let training = start_endless(folder.path(), &run, "train", &[]);
    await_steps(&run, 1024);
    let frozen = Thawed(children(training.pid(), "actor-0")[0]);
    send_signal(frozen.0, libc::SIGSTOP);
    let before = metrics(&run).last().unwrap().1;
    await_steps(&run, before + 10 * 512);
    send_signal(frozen.0, libc::SIGCONT);
    let thawed = metrics(&run).last().unwrap().1;
    await_steps(&run, thawed + 10 * 512);
    stop(training);
    assert_eq!(last_value(&run, "bus/fragments_malformed"), Some(0.0));
}
