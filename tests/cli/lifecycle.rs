//! Life of a run's folder: one writer at a time, goals of a resumed run, services that begin or go on, failed starts.

use std::{fs, net::TcpListener, path::Path};

use crate::support::*;
use serde_json::Value;

fn steps_saved(run: &Path) -> u64 {
    let config: toml::Table = fs::read_to_string(run.join("config.toml")).unwrap().parse().unwrap();
    u64::try_from(config["run"]["steps"].as_integer().unwrap()).unwrap()
}

#[test]
fn a_second_writer_is_refused_until_the_first_is_killed() {
    let (folder, run) = folders();
    let path = run.to_str().unwrap();
    let first = Running::start(endless(folder.path(), &run, "train"));
    await_steps(&run, 1024);
    let resume = ["--resume", path];
    let holder = format!("process {}", first.pid());
    for command in [&["train", "--resume", path][..], &["learner", "--listen", "tcp/127.0.0.1:0", resume[0], resume[1]]]
    {
        assert_refused(&self::run(folder.path(), command), 2, &["is in use by", &holder, &endpoint(&run)]);
    }
    let runs = self::run(folder.path(), &["runs", "--json", path]);
    assert_eq!(last_json(&runs)["state"], "running");
    first.signal(libc::SIGKILL);
    first.wait();
    let steps = last_value(&run, "time/total_timesteps").unwrap() as u64 + 2048;
    done(folder.path(), &["train", "--resume", path, "--steps", &steps.to_string()]);
    assert_eq!(last_json(&self::run(folder.path(), &["runs", "--json", path]))["state"], "stopped");
}

#[test]
fn a_goal_that_is_reached_is_refused_and_never_shrinks_the_saved_one() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let path = run.to_str().unwrap();
    let resume = |more: &[&str]| self::run(folder.path(), &[&["train", "--resume", path], more].concat());
    for steps in ["1024", "2048", "2k"] {
        assert_refused(&resume(&["--steps", steps]), 2, &["is already at 2,048 steps", "`--steps 4096`"]);
    }
    assert_eq!(steps_saved(&run), 2048);
    let finished = resume(&[]);
    assert!(finished.status.success());
    assert_eq!(stdout(&finished).lines().count(), 1, "{}", stdout(&finished));
    assert!(stdout(&finished).contains("run `run` is finished: it has 2,048 steps"), "{}", stdout(&finished));
    assert_eq!(last_json(&resume(&["--json"]))["env_steps"], 2048);
    // A farther goal is saved, whatever the file of the configuration says.
    assert!(resume(&["--steps", "8192"]).status.success());
    fs::write(run.join("config.toml"), "spoilt").unwrap();
    let farther = resume(&["--steps", "9k", "--json"]);
    assert!(farther.status.success(), "{}", stderr(&farther));
    assert_eq!(steps_saved(&run), 9000);
}

#[test]
fn a_nearer_goal_than_the_saved_one_ends_only_this_start() {
    let (folder, run) = folders();
    let path = run.to_str().unwrap();
    let first = Running::start(endless(folder.path(), &run, "train"));
    await_steps(&run, 1024);
    first.signal(libc::SIGINT);
    first.wait();
    let reached = last_value(&run, "time/total_timesteps").unwrap() as u64;
    let goal = (reached + 1024).to_string();
    done(folder.path(), &["train", "--resume", path, "--steps", &goal]);
    assert!(last_value(&run, "time/total_timesteps").unwrap() as u64 >= reached + 1024);
    assert_eq!(steps_saved(&run).to_string(), ENDLESS);
}

#[test]
fn a_service_begins_or_goes_on_with_one_command_line() {
    let (folder, run) = folders();
    let path = run.to_str().unwrap();
    let service = |steps: &str, more: &[&str]| {
        let args = ["train", "--preset", "smoke", "--seed", "3", "--run-dir", path, "--resume-or-start", "--json"];
        self::run(folder.path(), &[&args[..], &["--steps", steps], more].concat())
    };
    let steps = |output: &std::process::Output| last_json(output)["env_steps"].as_u64().unwrap();
    let begun = steps(&service("1024", &[]));
    assert!((1024..2048).contains(&begun), "{begun}");
    let further = steps(&service("4096", &[]));
    assert!(further >= 4096);
    let finished = service("4096", &[]);
    assert_eq!(steps(&finished), further);
    assert!(finished.status.success() && stdout(&finished).contains("is finished"), "{}", stdout(&finished));
    let other = service("9000", &["--set", "ppo.gamma=0.5"]);
    assert_refused(&other, 2, &["`ppo.gamma` is 0.5 by your flags and 0.99", "in the saved run"]);
    assert_usage(folder.path(), &["train", "--resume-or-start"], &["--run-dir"]);
}

#[test]
fn flags_that_agree_with_the_saved_run_are_accepted_and_others_refused_with_both_values() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let path = run.to_str().unwrap();
    let learner = |more: &[&str]| {
        let args = ["learner", "--resume", path, "--listen", "tcp/127.0.0.1:0"];
        self::run(folder.path(), &[&args[..], more].concat())
    };
    // The run is finished, so that accepted flags end at once.
    for agreeing in [&["--run", "run"][..], &["--run-dir", path], &["--seed", "1"], &["--task", "humanoid-v5"]] {
        let output = learner(agreeing);
        assert!(output.status.success(), "{agreeing:?}: {}", stderr(&output));
    }
    assert_refused(&learner(&["--seed", "7"]), 2, &["`run.seed` is 7 by your flags and 1 in the saved run"]);
    assert_refused(&learner(&["--task", "humanoid-v4"]), 2, &["`env.task`", "humanoid-v4", "humanoid-v5"]);
    assert_refused(&learner(&["--run", "other"]), 2, &["--run other", "`run`"]);
    assert_refused(&learner(&["--run-dir", "elsewhere"]), 2, &["--run-dir elsewhere", path]);
    let train = self::run(folder.path(), &["train", "--resume", path, "--deterministic"]);
    assert_refused(&train, 2, &["`run.deterministic` is true by your flags and false in the saved run"]);
}

#[test]
fn status_finds_the_live_runs_of_this_folder_and_knows_the_others() {
    let (folder, _) = folders();
    let status = |args: &[&str]| self::run(folder.path(), &[&["status"], args].concat());
    trained(folder.path(), &folder.path().join("runs/done"));
    let text = stdout(&status(&["done"]));
    assert!(text.starts_with("run `done` is finished: no process trains it\n  steps      2,048\n"), "{text}");
    let live = ["one", "two"].map(|name| {
        let run = folder.path().join("runs").join(name);
        let running = Running::start(endless(folder.path(), &run, "train"));
        await_steps(&run, 512);
        running
    });
    let text = stdout(&status(&[]));
    assert!(text.contains("run `one` trains on") && text.contains("run `two` trains on"), "{text}");
    assert!(!text.contains("`done`"), "{text}");
    drop(live);
}

#[test]
fn a_port_in_use_is_refused_by_name_and_leaves_no_folder() {
    let (folder, run) = folders();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let listen = format!("tcp/{}", taken.local_addr().unwrap());
    for command in ["learner", "train"] {
        let args = [command, "--preset", "smoke", "--run-dir", run.to_str().unwrap(), "--listen", &listen];
        assert_refused(&self::run(folder.path(), &args), 1, &[&listen, "choose another port"]);
    }
    assert!(!run.exists());
    let output = self::run(folder.path(), &["train", "--preset", "smoke", "--listen", &listen]);
    assert!(!output.status.success());
    assert_eq!(fs::read_dir(folder.path().join("runs")).unwrap().count(), 0);
}

#[test]
fn a_configuration_and_its_keys_are_printed() {
    let (folder, _) = folders();
    let config = |args: &[&str]| self::run(folder.path(), &[&["config"], args].concat());
    let whole: toml::Table = stdout(&config(&["--preset", "smoke", "--set", "ppo.gamma=0.9"])).parse().unwrap();
    assert_eq!((whole["ppo"]["batch"].as_integer(), whole["ppo"]["gamma"].as_float()), (Some(512), Some(0.9)));
    let key = stdout(&config(&["ppo.gamma"]));
    for part in ["ppo.gamma = 0.985", "default  0.99", "allowed  0 to 1", "meaning", "live     yes"] {
        assert!(key.contains(part), "`{part}` is missing in {key}");
    }
    let section = stdout(&config(&["ppo", "--json"]));
    assert!(section.lines().count() > 3);
    for line in section.lines() {
        let value: Value = serde_json::from_str(line).unwrap();
        assert!(value["key"].as_str().unwrap().starts_with("ppo."), "{line}");
    }
    assert_refused(&config(&["ppo.gama"]), 2, &["ppo.gama", "ppo.gamma"]);
}

#[test]
fn flags_of_other_programs_get_a_hint() {
    let (folder, _) = folders();
    for (given, ours) in
        [("--num-envs=8", "--envs N"), ("--total-timesteps", "--steps N"), ("--lr", "ppo.learning_rate")]
    {
        assert_usage(folder.path(), &["train", given], &["hint:", ours]);
    }
    let task = self::run(folder.path(), &["train", "--task", "Humanoid-v5"]);
    assert_refused(&task, 2, &["--task Humanoid-v5", "`humanoid-v5`", "`gymnasium/Humanoid-v5`"]);
    for command in ["train", "learner"] {
        let task = self::run(folder.path(), &[command, "--task", "velocty"]);
        assert_refused(&task, 2, &["--task velocty", "did you mean `velocity`", "humanoid-v4", "task.name=velocty"]);
    }
}
