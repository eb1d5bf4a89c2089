//! Ordinary slips of a new user: each gets an error that names the remedy.

use std::fs;

use crate::support::*;

#[test]
fn misspelled_names_get_the_nearest_one() {
    let (folder, run_folder) = folders();
    let folder = folder.path();
    trained(folder, &run_folder);
    fs::create_dir(folder.join("runs")).unwrap();
    fs::rename(&run_folder, folder.join("runs/walk-1")).unwrap();
    fs::write(folder.join("robot.xml"), "<mujoco/>").unwrap();
    let refused = |args: &[&str], parts: &[&str]| assert_usage(folder, args, parts);
    refused(&["eval", "wlak-1"], &["no run at `wlak-1`", "did you mean `walk-1`?", "runs here: runs/walk-1"]);
    refused(&["train", "--resume", "rnus/walk-1"], &["did you mean `runs/walk-1`?"]);
    refused(&["train", "--resume", "runs/walk-1/checkpoints/latest.bundle"], &["did you mean `runs/walk-1`?"]);
    refused(&["status", "runs"], &["no run at `runs`; runs here: runs/walk-1"]);
    refused(
        &["train", "--model", "robt.xml"],
        &["robt.xml` cannot be read: No such file", "did you mean `robot.xml`?"],
    );
    refused(&["train", "--config", "my.toml"], &["--config", "my.toml", "cannot be read: No such file"]);
    refused(&["train", "--preset", "Walk"], &["unknown preset `Walk`; did you mean `walk`?"]);
    refused(&["train", "--set", "ppo.epochs", "3"], &["hint: write --set ppo.epochs=3"]);
}

#[test]
fn ignored_and_impossible_flags_are_refused() {
    let (folder, _) = folders();
    let folder = folder.path();
    let refused = |args: &[&str], parts: &[&str]| assert_usage(folder, args, parts);
    refused(&["train", "--deterministic", "--actors", "4"], &["--deterministic runs one actor", "leave --actors out"]);
    refused(&["certs", "certs", "--host", "bad host!"], &["--host bad host!", "neither a host's name nor an address"]);
    let film = ["eval", "--agent", "random", "--episodes", "1", "--film", "films/walk.gif"];
    assert_refused(&run(folder, &film), 1, &["--film films/walk.gif", "the folder `films` does not exist"]);
    fs::write(folder.join("file"), "").unwrap();
    assert_refused(
        &run(folder, &["train", "--run-dir", "file"]),
        1,
        &["run folder `file`", "may write to with --run-dir"],
    );
    assert!(!folder.join("certs").exists() && !folder.join("runs").exists(), "nothing is left behind");
}

#[test]
fn control_finds_the_only_live_run_and_refuses_to_choose() {
    let (folder, _) = folders();
    let folder = folder.path();
    let start = |name: &str| {
        let training = Running::start(endless(folder, &folder.join("runs").join(name), "train"));
        await_steps(&folder.join("runs").join(name), 512);
        training
    };
    let _one = start("one");
    assert!(stdout(&run(folder, &["control", "pause"])).starts_with("paused"));
    let _two = start("two");
    assert_usage(folder, &["control", "resume"], &["several runs", "runs/one, runs/two"]);
    assert!(stdout(&run(folder, &["control", "resume", "one"])).starts_with("resumed"));
}

#[test]
fn keys_without_effect_are_refused_with_each_way_to_begin() {
    let (folder, run) = folders();
    let folder = folder.path();
    trained(folder, &run);
    let begin = |more: &[&str]| self::run(folder, &[&["train", "--no-progress", "--actors", "1"], more].concat());
    let refused = |more: &[&str], parts: &[&str]| assert_refused(&begin(more), 2, parts);
    let noise = ["--set", "policy.init_log_std=-2", "--run-dir", "never"];
    refused(
        &[&["--preset", "smoke", "--init-from", "run"][..], &noise].concat(),
        &["`policy.init_log_std`", "--init-from"],
    );
    refused(&[&["--fork", "run", "--steps", "4096"][..], &noise].concat(), &["`policy.init_log_std`", "--fork"]);
    let robot = ["--fork", "run", "--steps", "4096", "--set", "env.robot=g1", "--run-dir", "never"];
    refused(&robot, &["`env.robot`", "keeps the robot"]);
    refused(&["--resume", "run", "--set", "run.steps=4096"], &["`run.steps`", "use --steps N"]);
    refused(
        &["--resume", "run", "--set", "rollout.actors=7", "--steps", "4096"],
        &["`rollout.actors`", "use --actors N"],
    );
    assert!(!folder.join("never").exists());
    // The rate is applied, and without it the smallest one.
    let rate = |name: &str, more: &[&str]| {
        let fixed = ["--preset", "smoke", "--init-from", "run", "--steps", "512", "--run-dir", name];
        let output = begin(&[&fixed[..], more].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        let rates = metrics(&folder.join(name)).into_iter().filter(|(tag, ..)| tag == "train/learning_rate");
        rates.map(|(.., value)| value).next().unwrap()
    };
    assert!(rate("slow", &[]) < 1e-4);
    assert!(rate("given", &["--set", "ppo.learning_rate=9e-4"]) > 4e-4);
}
