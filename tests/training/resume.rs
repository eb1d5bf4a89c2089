//! Deterministic runs that were stopped, killed or damaged end bit-identical to an uninterrupted run.

use std::{fs, path::Path};

use crate::support::*;
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_learner::checkpoint::{TrainingState, encoding};

/// Transitions of one update.
const BATCH: u64 = 512;
/// Four fragments make a batch.
const SMALL: [&str; 2] = ["rollout.fragment_steps=16", "learner.checkpoint_every_updates=2"];
/// Randomisation of the preset sim2sim with more pushes, and the observation of Gymnasium's environment.
const RANDOMISED: [&str; 9] = [
    "env.observation=gymnasium-v5",
    "randomisation.mass_scale=[0.85, 1.15]",
    "randomisation.floor_friction_scale=[0.5, 1.5]",
    "randomisation.motor_scale=[0.85, 1.15]",
    "randomisation.damping_scale=[0.6, 1.5]",
    "randomisation.sensor_noise_position=0.005",
    "randomisation.action_delay_steps=[0, 1]",
    "randomisation.push_interval_s=[0.1, 0.3]",
    "randomisation.push_mps=[0.0, 0.5]",
];

/// Returns the flags of a new deterministic run with these keys.
fn new_run<'a>(keys: &[&'a str]) -> Vec<&'a str> {
    [vec!["train", "--preset", "smoke", "--deterministic"], set(&SMALL), set(keys)].concat()
}

fn begin(folder: &Path, run: &Path, updates: u64, keys: &[&str]) -> TrainingState {
    let steps = (updates * BATCH).to_string();
    done(folder, &[&new_run(keys)[..], &["--steps", &steps, "--run-dir", run.to_str().unwrap()]].concat());
    latest(run)
}

fn resume(folder: &Path, run: &Path, updates: u64, more: &[&str]) -> (TrainingState, String) {
    let steps = (updates * BATCH).to_string();
    let args = [&["train", "--resume", run.to_str().unwrap(), "--steps", &steps], more].concat();
    let output = done(folder, &args);
    (latest(run), stderr(&output))
}

/// Asserts bit-identical states, apart from names of processes and times.
fn assert_same(found: &TrainingState, wanted: &TrainingState) {
    let bits = |numbers: &[f32]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
    assert!(bits(found.ppo.parameters()) == bits(wanted.ppo.parameters()), "other parameters");
    assert!(found.ppo == wanted.ppo, "another optimiser, learning rate, statistics or order of minibatches");
    assert_eq!(found.episodes, wanted.episodes);
    assert_eq!(found.best_return, wanted.best_return);
    assert_eq!(found.fragment_counts, wanted.fragment_counts);
    assert!(found.actor_state.is_some());
    assert!(found.actor_state == wanted.actor_state, "the actor is somewhere else");
    let counts = |state: &TrainingState| {
        let counters = state.counters;
        (counters.env_steps, counters.updates, counters.gradient_steps, counters.undone_updates, counters.restarts)
    };
    assert_eq!(counts(found), counts(wanted));
}

#[test]
fn five_updates_and_five_resumed_updates_equal_ten() {
    for more in [&[][..], &RANDOMISED[..]] {
        let (folder, whole) = folders();
        let wanted = begin(folder.path(), &whole, 10, more);
        assert_eq!(wanted.counters.updates, 10);
        assert!(wanted.episodes.finished > 0);
        let halves = folder.path().join("halves");
        let half = begin(folder.path(), &halves, 5, more);
        assert_ne!(half.ppo.parameters(), wanted.ppo.parameters());
        let (found, _) = resume(folder.path(), &halves, 10, &[]);
        assert_same(&found, &wanted);
        assert_ne!(found.lineage.newest().incarnation, half.lineage.newest().incarnation);
        let logged = metrics(&halves).into_iter().filter(|(tag, ..)| tag == "train/std").map(|(_, step, _)| step);
        let steps: Vec<u64> = (1..=10).map(|update| update * BATCH).collect();
        assert_eq!(logged.collect::<Vec<_>>(), steps, "no step is missing or logged twice");
        // Again from a kept checkpoint: each holds the actor's state.
        let (found, _) = resume(folder.path(), &halves, 10, &["--checkpoint", "8"]);
        assert_eq!(found.counters.resumes, 2);
        assert_same(&found, &wanted);
        let aside = halves.join("checkpoints/abandoned-after-8");
        assert!(aside.join("latest.bundle").exists() && aside.join("00000010.bundle").exists());
    }
}

#[test]
fn batches_grow_with_the_steps_of_a_run_and_stay_so_after_a_resume() {
    let (folder, whole) = folders();
    let keys = ["ppo.batch_growth_steps=1536"];
    let wanted = begin(folder.path(), &whole, 13, &keys);
    let batches = |run| metrics(run).into_iter().filter(|(tag, ..)| tag == "train/batch").map(|(.., value)| value);
    let sizes: Vec<f64> = batches(&whole).collect();
    // Twice as large from 1,536 steps on, four times from 3,072 on.
    assert_eq!(sizes, [512.0, 512.0, 512.0, 1024.0, 1024.0, 2048.0, 2048.0]);
    let halves = folder.path().join("halves");
    assert_eq!(begin(folder.path(), &halves, 5, &keys).counters.updates, 4);
    assert_same(&resume(folder.path(), &halves, 13, &[]).0, &wanted);
}

#[test]
fn neither_ctrl_c_nor_a_kill_changes_a_bit() {
    let (folder, run) = folders();
    let endless = (1_000_000 * BATCH).to_string();
    let name = run.to_str().unwrap();
    let mut updates = 0;
    for signal in [libc::SIGKILL, libc::SIGINT, libc::SIGKILL] {
        let mut command = treadmill(folder.path());
        if updates == 0 {
            // Updates take most of the time, so that most signals arrive during one.
            command.args(new_run(&["ppo.epochs=10"])).args(["--run-dir", name]);
        } else {
            command.args(["train", "--resume", name]);
        }
        let training = Running::start({
            command.args(["--steps", &endless]);
            command
        });
        await_steps(&run, (updates + 2) * BATCH);
        let actors = children(training.pid(), "actor");
        training.signal(signal);
        training.wait();
        await_that("the end of the actor", || actors.iter().all(|pid| !is_running(*pid)).then_some(()));
        updates = latest(&run).counters.updates;
    }
    let (found, errors) = resume(folder.path(), &run, updates + 2, &[]);
    assert!(!errors.contains("begins new episodes"), "{errors}");
    assert_eq!(temporary_files(&run), [""; 0], "the kills left files behind");
    let whole = folder.path().join("whole");
    let wanted = begin(folder.path(), &whole, updates + 2, &["ppo.epochs=10"]);
    assert_same(&found, &wanted);
}

#[test]
fn a_damaged_latest_checkpoint_is_reported_and_the_newest_sound_one_used() {
    let (folder, run) = folders();
    let wanted = begin(folder.path(), &run, 6, &["learner.keep_checkpoints=2"]);
    let latest = run.join("checkpoints/latest.bundle");
    let valid = fs::read(&latest).unwrap();
    let mut flipped = valid.clone();
    *flipped.last_mut().unwrap() ^= 1;
    let numbered = run.join("checkpoints/00000006.bundle");
    for (damaged, why) in [(&flipped[..], "checksum"), (&valid[..valid.len() / 2], "truncated"), (&[], "header")] {
        fs::write(&latest, damaged).unwrap();
        fs::write(&numbered, damaged).unwrap();
        // It is as new as the latest.
        fs::remove_file(run.join("checkpoints/best.bundle")).unwrap();
        let eval =
            self::run(folder.path(), &["eval", run.to_str().unwrap(), "--checkpoint", "latest", "--episodes", "1"]);
        assert!(eval.status.success(), "{}", stderr(&eval));
        assert!(stderr(&eval).contains("00000004.bundle"), "{}", stderr(&eval));
        assert_eq!(fs::read(&latest).unwrap(), damaged, "`eval` does not change it");
        let named = self::run(folder.path(), &["train", "--resume", run.to_str().unwrap(), "--checkpoint", "6"]);
        assert_refused(&named, 1, &["00000006.bundle", why, "--checkpoint"]);

        let (found, errors) = resume(folder.path(), &run, 6, &[]);
        for part in ["latest.bundle` is damaged", "00000006.bundle` is damaged", why, "00000004.bundle updates=4"] {
            assert!(errors.contains(part), "`{part}` is missing in: {errors}");
        }
        assert_same(&found, &wanted);
    }
}

#[test]
fn a_run_that_returns_to_a_checkpoint_forgets_its_old_future() {
    let (folder, run) = folders();
    begin(folder.path(), &run, 10, &["learner.keep_checkpoints=100"]);
    let checkpoints = run.join("checkpoints");
    let names = |folder: &Path| -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<_> = entries.filter(|name| name.ends_with(".bundle")).collect();
        names.sort();
        names
    };
    let before = names(&checkpoints);
    assert!(before.contains(&"00000008.bundle".to_string()), "{before:?}");
    // Flags that are refused move nothing.
    let name = run.to_str().unwrap();
    let refused = self::run(folder.path(), &["train", "--resume", name, "--checkpoint", "4", "--steps", "1"]);
    assert_refused(&refused, 2, &["--steps 1"]);
    assert_eq!(names(&checkpoints), before);
    let (found, _) = resume(folder.path(), &run, 6, &["--checkpoint", "4"]);
    assert_eq!(found.counters.updates, 6);
    let (kept, aside) = (names(&checkpoints), names(&checkpoints.join("abandoned-after-4")));
    assert!(
        !kept.contains(&"00000008.bundle".to_string()) && kept.contains(&"00000006.bundle".to_string()),
        "{kept:?}"
    );
    assert!(
        aside.contains(&"00000008.bundle".to_string()) && aside.contains(&"latest.bundle".to_string()),
        "{aside:?}"
    );
    let gone = self::run(folder.path(), &["eval", name, "--checkpoint", "8", "--episodes", "1"]);
    assert_refused(&gone, 1, &["there is no checkpoint"]);
    // Nor does a damaged newest one bring it back.
    fs::write(checkpoints.join("latest.bundle"), "").unwrap();
    let eval = self::run(folder.path(), &["eval", name, "--checkpoint", "latest", "--episodes", "1"]);
    assert!(stderr(&eval).contains("00000006.bundle") && eval.status.success(), "{}", stderr(&eval));
}

/// Returns the names of the temporary files in a run folder.
fn temporary_files(run: &Path) -> Vec<String> {
    let folders = [run.to_path_buf(), run.join("checkpoints")];
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap().flatten());
    entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".tmp"))
        .collect()
}

#[test]
fn a_resumed_run_removes_the_temporary_files_of_killed_processes() {
    let (folder, run) = folders();
    begin(folder.path(), &run, 1, &[]);
    // Linux numbers processes up to 2^22.
    let ended = 1 << 30;
    for name in ["checkpoints/.latest.bundle", "checkpoints/.00000002.bundle", ".config.toml"] {
        fs::write(run.join(format!("{name}.{ended}.tmp")), "half").unwrap();
    }
    fs::write(run.join("notes.tmp"), "not ours").unwrap();
    resume(folder.path(), &run, 2, &[]);
    assert_eq!(temporary_files(&run), ["notes.tmp"]);
}

#[test]
fn an_older_physics_begins_new_episodes_and_a_newer_one_is_refused() {
    let (folder, run) = folders();
    begin(folder.path(), &run, 1, &[]);
    let latest_path = run.join("checkpoints/latest.bundle");
    let more = |updates: u64| {
        let steps = (updates * BATCH).to_string();
        self::run(folder.path(), &["train", "--resume", run.to_str().unwrap(), "--steps", &steps])
    };
    let mut state = latest(&run);
    state.physics_version = PHYSICS_VERSION - 1;
    fs::write(&latest_path, encoding::encode(&state).unwrap()).unwrap();
    let output = more(2);
    assert!(output.status.success() && stderr(&output).contains("newer physics"), "{}", stderr(&output));
    let mut state = latest(&run);
    assert_eq!((state.physics_version, state.counters.updates), (PHYSICS_VERSION, 2));

    state.physics_version = PHYSICS_VERSION + 1;
    fs::write(&latest_path, encoding::encode(&state).unwrap()).unwrap();
    let (ours, theirs) =
        (format!("simulates physics {PHYSICS_VERSION}"), format!("has physics {}", PHYSICS_VERSION + 1));
    assert_refused(&more(3), 1, &[&ours, &theirs, "versions.json"]);
}

#[test]
fn an_actor_that_does_not_fit_the_saved_state_warns_and_begins_new_episodes() {
    let (folder, run) = folders();
    begin(folder.path(), &run, 2, &[]);
    let mut command = treadmill(folder.path());
    let steps = (4 * BATCH).to_string();
    fs::remove_file(run.join("endpoint.txt")).unwrap();
    command.args(["learner", "--resume", run.to_str().unwrap(), "--steps", &steps, "--listen", "tcp/127.0.0.1:0"]);
    let learner = Running::start(command);
    let mut command = treadmill(folder.path());
    command.args(["actor", "--connect", &endpoint(&run), "--envs", "4", "--name", "actor-0"]);
    let actor = Running::start(command);
    let warning = actor.wait_for("begins new episodes");
    assert!(warning.contains("the state has 8 environments, this actor has 4"), "{warning}");
    assert!(learner.wait().0.success());
    let state = latest(&run);
    assert_eq!(state.counters.updates, 4);
    assert_eq!(state.actor_state.unwrap().envs(), 4);
}

#[test]
fn curricula_go_on_where_they_were() {
    let (folder, run) = folders();
    let card = "model = 'robot.xml'\nfeet = ['left_foot', 'right_foot']\n[[hinges]]\nnames = '*'\neffort_nm = 60.0\n";
    let ground = ["ground.kinds=['slope']", "ground.start_level=5", "velocity.command_curriculum=true"];
    // It falls at once, from level to level.
    trained_robot(folder.path(), &run, card, &ground);
    let name = run.to_str().unwrap();
    done(folder.path(), &["train", "--resume", name, "--steps", "16384", "--actors", "1"]);
    let level = |run: &Path| last_value(run, "rollout/ground_level").unwrap();
    assert!(level(&run) < 1.5, "{}", level(&run));
    let steps =
        |run: &Path| metrics(run).into_iter().filter(|(tag, ..)| tag == "rollout/ground_level").collect::<Vec<_>>();
    let before = steps(&run).len();
    done(folder.path(), &["train", "--resume", name, "--steps", "18432", "--actors", "2"]);
    let after = &steps(&run)[before..];
    assert!(!after.is_empty() && after.iter().all(|(.., level)| *level < 2.5), "{after:?}");
    // A fork takes them along.
    let fork = folder.path().join("fork");
    let args = ["train", "--fork", name, "--steps", "20480", "--run-dir", fork.to_str().unwrap()];
    done(folder.path(), &args);
    let forked = steps(&fork);
    assert!(!forked.is_empty() && forked.iter().all(|(.., level)| *level < 2.5), "{forked:?}");
}

#[test]
fn when_an_actor_is_killed_does_not_change_a_deterministic_run() {
    let (folder, _) = folders();
    let folder = folder.path();
    // A fragment makes a batch: of several, those that a killed actor has delivered would be repeated.
    let begin = [&["train", "--preset", "smoke", "--deterministic"][..], &set(&RANDOMISED)].concat();
    let args = [&begin[..], &["--steps", "16384", "--run-dir"]].concat();
    done(folder, &[&args[..], &["whole"]].concat());
    let killed = start(folder, &[&args[..], &["killed"]].concat());
    let kill_actor = || {
        let actors =
            await_that("an actor", || Some(children(killed.pid(), "actor")).filter(|actors| !actors.is_empty()));
        send_signal(actors[0], libc::SIGKILL);
        killed.wait_for("actor-0 ended with signal: 9");
    };
    // Before it has delivered anything, and later.
    kill_actor();
    await_steps(&folder.join("killed"), 2048);
    kill_actor();
    let (status, lines) = killed.wait();
    assert!(status.success(), "{lines:#?}");
    let [found, wanted] = ["killed", "whole"].map(|run| latest(&folder.join(run)));
    assert!(found.ppo == wanted.ppo && found.episodes == wanted.episodes, "another result");
}
