//! A program with a task of its own: every command, exact resume, and actors that lack the task.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::*;

/// Returns a command of `examples/own_task.rs`, which `cargo test` builds.
fn own_task(folder: &Path, args: &[&str]) -> Command {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_treadmill")).with_file_name("examples").join("own_task");
    assert!(program.is_file(), "{} is missing; build it: cargo build --release --examples", program.display());
    let mut command = Command::new(program);
    command.args(args).current_dir(folder).env("LC_ALL", "C.UTF-8");
    command
}

fn done(folder: &Path, args: &[&str]) -> Output {
    let output = own_task(folder, args).output().unwrap();
    assert!(output.status.success(), "{args:?}: {}", stderr(&output));
    output
}

fn checkpoint(run: &Path) -> Vec<u8> {
    let policy = run.with_extension("safetensors");
    done(run.parent().unwrap(), &["export", run.to_str().unwrap(), "--safetensors", policy.to_str().unwrap()]);
    std::fs::read(policy).unwrap()
}

#[test]
fn a_task_of_the_program_is_trained_evaluated_and_exported() {
    let (folder, run_folder) = folders();
    let run = run_folder.to_str().unwrap();
    let output = done(folder.path(), &["train", "--preset", "smoke", "--task", "squat", "--run-dir", run, "--json"]);
    assert!(stdout(&output).contains("training `squat`"), "{}", stdout(&output));
    assert!(last_json(&output)["env_steps"].as_u64().unwrap() >= 8192);
    let output = done(folder.path(), &["eval", run, "--episodes", "2", "--json"]);
    assert_eq!(last_json(&output)["episodes"], 2);
    // 22 positions, 23 velocities and the target.
    let output = done(folder.path(), &["export", run, "--onnx", "squat.onnx"]);
    assert!(stdout(&output).contains("46"), "{}", stdout(&output));

    let lacking = self::run(folder.path(), &["eval", run, "--episodes", "1"]);
    assert_refused(&lacking, 1, &["this program has no task `squat`; it has: none"]);
    let unknown = own_task(folder.path(), &["train", "--set", "env.own_task=jump"]).output().unwrap();
    assert_refused(&unknown, 2, &["this program has no task `jump`; it has: squat"]);
}

#[test]
fn a_deterministic_run_of_such_a_task_resumes_bit_for_bit() {
    let (folder, _) = folders();
    let train = |name: &str, steps: &[&str]| {
        for (index, steps) in steps.iter().enumerate() {
            let first = ["train", "--preset", "smoke", "--task", "squat", "--deterministic", "--run-dir", name];
            let next = ["train", "--resume", name];
            let args = [if index == 0 { &first[..] } else { &next[..] }, &["--steps", steps]].concat();
            done(folder.path(), &args);
        }
        checkpoint(&folder.path().join(name))
    };
    assert_eq!(train("whole", &["4096"]), train("cut", &["2048", "4096"]));
}

#[test]
fn an_actor_without_the_task_is_refused_by_name() {
    let (folder, run) = folders();
    let args =
        ["learner", "--preset", "smoke", "--task", "squat", "--steps", ENDLESS, "--run-dir", run.to_str().unwrap()];
    let _learner = Running::start(own_task(folder.path(), &args));
    let endpoint = await_that("the endpoint", || std::fs::read_to_string(run.join("endpoint.txt")).ok());
    let name = run.file_name().unwrap().to_str().unwrap();
    let actor = self::run(folder.path(), &["actor", "--connect", endpoint.trim(), "--run", name]);
    assert_refused(&actor, 1, &["this program has no task `squat`"]);
}
