//! Invalid input: an error that names field, value and remedy, and exit code 2.

use std::fs;

use crate::support::*;
use treadmill_config::{EnvTask, PRESETS};

fn train(args: &[&str]) -> std::process::Output {
    let (folder, run) = folders();
    let mut all = vec!["train", "--preset", "smoke", "--run-dir", run.to_str().unwrap()];
    all.extend(args);
    let output = self::run(folder.path(), &all);
    assert!(!run.exists(), "no folder is left behind by {args:?}");
    output
}

#[test]
fn the_help_names_every_preset_and_task() {
    let (folder, _) = folders();
    let help = stdout(&done(folder.path(), &["train", "--help"]));
    let words: Vec<&str> = help.split(|c: char| !c.is_ascii_alphanumeric() && c != '-').collect();
    for name in PRESETS.iter().map(|(name, _)| name).chain(EnvTask::NAMES) {
        assert!(words.contains(name), "`{name}` is missing in: {help}");
    }
}

#[test]
fn invalid_configuration_is_refused_with_key_value_and_allowed_values() {
    assert_refused(&train(&["--envs", "0"]), 2, &["rollout.envs", "is 0", "1 to 65536"]);
    assert_refused(&train(&["--set", "rollout.envs=0"]), 2, &["rollout.envs", "is 0", "1 to 65536"]);
    assert_refused(&train(&["--set", "ppo.minibatch=1000"]), 2, &["ppo.minibatch", "1000", "ppo.batch, which is 512"]);
    assert_refused(&train(&["--set", "ppo.epoch=3"]), 2, &["unknown config key `ppo.epoch`", "`ppo.epochs`"]);
    assert_refused(&train(&["--set", "ppo.epochs=few"]), 2, &["ppo.epochs", "few", "1 to 100"]);
    assert_refused(&train(&["--set", "ppo.epochs"]), 2, &["ppo.epochs", "key=value"]);
    let range = train(&["--set", "env.contact_cost_range=[3, 1]"]);
    assert_refused(&range, 2, &["env.contact_cost_range", "[3.0, 1.0]", "the first not above the second"]);
    assert_refused(&train(&["--set", "env.task=humanoid-v3"]), 2, &["env.task", "humanoid-v3", "\"humanoid-v4\""]);
    let symmetry = |value: &str| train(&["--set", value, "--set", "policy.hidden=[32, 31]"]);
    assert_refused(&symmetry("ppo.symmetry=mirrored"), 2, &["`ppo.symmetry`", "\"mirrored\"", "\"auto\", \"off\""]);
    assert_refused(&symmetry("ppo.symmetry=equivariant"), 2, &["`ppo.symmetry`", "31 units", "\"auto\" or \"off\""]);
    assert_refused(&train(&["--steps", "0"]), 2, &["run.steps", "is 0"]);
    assert_refused(&train(&["--actors", "9"]), 2, &["rollout.actors", "is 9", "rollout.envs, which is 8"]);
    assert_refused(&train(&["--steps", "many"]), 2, &["--steps", "many"]);
    assert_refused(&train(&["--nonsense"]), 2, &["--nonsense"]);
}

#[test]
fn configuration_files_are_checked() {
    let (folder, _) = folders();
    let file = folder.path().join("mine.toml");
    let with = |text: &str| {
        fs::write(&file, text).unwrap();
        train(&["--config", file.to_str().unwrap()])
    };
    assert_refused(&with("[ppo]\ngama = 0.9\n"), 2, &["ppo.gama", "ppo.gamma"]);
    assert_refused(&with("[ppo]\ngamma = \"high\"\n"), 2, &["ppo.gamma", "high", "0 to 1"]);
    assert_refused(&with("[ppo\n"), 2, &["not valid TOML", "mine.toml"]);
    let output = self::run(folder.path(), &["train", "--preset", "stroll"]);
    assert_refused(
        &output,
        2,
        &[
            "stroll",
            "walk, own-task, walk-v5obs, walk-v4obs, smoke, velocity, g1, g1-29, g1-rough, motion, g1-motion, h1, t1, sim2sim",
        ],
    );
}

#[test]
fn an_unknown_run_is_refused_with_the_existing_ones() {
    let (folder, _) = folders();
    fs::create_dir_all(folder.path().join("runs/walk-7/checkpoints")).unwrap();
    assert_usage(folder.path(), &["eval", "nowhere"], &["nowhere", "runs/walk-7"]);
    assert_usage(folder.path(), &["eval"], &["RUN", "--agent random"]);
    assert_refused(&self::run(folder.path(), &["eval", "walk-7"]), 1, &["no checkpoint", "saved none yet"]);
}

#[test]
fn plain_text_beyond_loopback_needs_a_flag() {
    let (folder, run) = folders();
    let args = ["train", "--preset", "smoke", "--run-dir", run.to_str().unwrap(), "--listen", "tcp/0.0.0.0:0"];
    assert_refused(&self::run(folder.path(), &args), 2, &["tcp/0.0.0.0:0", "--insecure"]);
    assert!(!run.exists(), "a refused endpoint leaves no folder behind");
    assert_usage(folder.path(), &["actor", "--connect", "tcp/192.0.2.1:7447"], &["tcp/192.0.2.1:7447", "--insecure"]);
    // Discovery asks the whole network, so answers must be verifiable.
    assert_usage(folder.path(), &["actor", "--discover"], &["--discover", "--tls DIR", "--insecure"]);
    let args = ["learner", "--preset", "smoke", "--run", "A/B", "--run-dir", run.to_str().unwrap()];
    assert_refused(&self::run(folder.path(), &args), 2, &["`run` is `A/B`", "a-z"]);
    assert!(!run.exists(), "a refused name leaves no folder behind");
    assert_usage(folder.path(), &["actor", "--threads", "many"], &["--threads", "many"]);
    assert_usage(folder.path(), &["actor", "--name", "A/B"], &["A/B", "a-z"]);
}

#[test]
fn output_that_cannot_be_written_is_a_failure() {
    let (folder, _) = folders();
    let mut command = treadmill(folder.path());
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let output = command.arg("config").stdout(full).output().unwrap();
    assert_refused(&output, 1, &["standard output cannot be written", "No space left"]);
    let mut command = treadmill(folder.path());
    let mut reader_left = command.arg("config").stdout(std::process::Stdio::piped()).spawn().unwrap();
    drop(reader_left.stdout.take());
    assert!(reader_left.wait().unwrap().success());
}

#[test]
fn a_preset_of_a_robot_names_the_missing_file() {
    let (folder, _) = folders();
    let args = ["train", "--preset", "g1"];
    assert_refused(&self::run(folder.path(), &args), 2, &["`env.robot` is `g1`", "--model FILE", "your-robot.md"]);
}

#[test]
fn help_and_version_are_printed() {
    let (folder, _) = folders();
    for command in ["train", "learner", "actor", "eval", "export", "bench"] {
        let output = self::run(folder.path(), &[command, "--help"]);
        assert!(output.status.success() && stdout(&output).contains("Usage: treadmill"), "{command}");
    }
    assert!(stdout(&self::run(folder.path(), &["--version"])).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_missing_device_is_refused_before_anything_is_written() {
    let (folder, run_folder) = folders();
    let path = run_folder.to_str().unwrap();
    // Hides the GPUs of a machine that has some.
    let run = |args: &[&str]| treadmill(folder.path()).args(args).env("CUDA_VISIBLE_DEVICES", "").output().unwrap();
    let parts = ["no CUDA device can be used", "nvidia-smi", "--device cpu"];
    for command in ["train", "learner"] {
        assert_refused(&run(&[command, "--preset", "smoke", "--run-dir", path, "--device", "cuda"]), 2, &parts);
    }
    assert!(!run_folder.exists());
    let deterministic = ["train", "--preset", "smoke", "--run-dir", path, "--deterministic", "--device", "cuda"];
    assert_refused(&run(&deterministic), 2, &["--deterministic", "bit for bit", "--device cpu"]);
    assert_refused(&run(&["bench", "update", "--device", "cuda"]), 2, &parts);
    assert_usage(folder.path(), &["train", "--device", "tpu"], &["tpu", "cpu, cuda, candle"]);
}
