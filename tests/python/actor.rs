//! The Python actor: its mathematics compared with the Rust code, and short runs with a real environment.

use std::{path::PathBuf, process::Command};

use crate::support::*;
use serde_json::json;
use treadmill_config::Config;
use treadmill_policy::{
    NetworkShape, Policy,
    exported::{ActionFacts, ExportedPolicy, ObservationFacts},
    gaussian,
    normaliser::RunningMoments,
};
use treadmill_runtime::seeds;

fn python_folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("python")
}

/// Returns the expected content of python/tests/golden.json: a small policy and its results for some observations.
fn golden() -> serde_json::Value {
    let wavy = |count: usize, step: f32| (0..count).map(|i| (i as f32 * step).sin()).collect::<Vec<f32>>();
    let shape = NetworkShape { observation: 4, action: 2, hidden: vec![5, 3], privileged: 0 };
    let mut parameters = wavy(shape.parameter_count(), 0.7);
    // One standard deviation within the allowed range, one beyond.
    parameters[shape.log_std()].copy_from_slice(&[-0.5, 2.5]);
    let mut moments = RunningMoments::new(4);
    moments.update(&wavy(40, 1.3).iter().map(|x| x * 30.0 + 2.0).collect::<Vec<_>>(), 4);
    let (observation, mean, variance) = ObservationFacts::from_moments("compact", &moments, 1.5);
    let exported = ExportedPolicy {
        parameters: parameters.clone(),
        shape: shape.clone(),
        observation,
        mean,
        variance,
        action: ActionFacts { names: vec!["a".into(), "b".into()], low: vec![-0.4; 2], high: vec![0.4; 2] },
        returns: None,
        control_step_s: 0.015,
        settings: Config::default().episodes_toml(),
        model_xml: String::new(),
    };
    let (rows, observations) = (6, wavy(24, 0.9).iter().map(|x| x * 60.0).collect::<Vec<_>>());
    let mut normalised = observations.clone();
    exported.normaliser().apply(&mut normalised);
    let policy = Policy::new(shape, parameters).unwrap();
    let (mut means, normals, mut actions) = (vec![0.0; rows * 2], wavy(rows * 2, 2.1), vec![0.0; rows * 2]);
    policy.means(&normalised, rows, &mut means);
    let mut log_probs = Vec::new();
    for row in 0..rows {
        let place = row * 2..row * 2 + 2;
        let (mean, normal) = (&means[place.clone()], &normals[place.clone()]);
        gaussian::sample(mean, policy.log_std(), normal, &mut actions[place.clone()]);
        log_probs.push(gaussian::log_probability(&actions[place], mean, policy.log_std()));
    }
    let table = |numbers: &[f32], width| numbers.chunks(width).map(<[f32]>::to_vec).collect::<Vec<_>>();
    json!({
        "export": exported.to_bytes().unwrap().iter().map(|byte| format!("{byte:02x}")).collect::<String>(),
        "observations": table(&observations, 4),
        "normals": table(&normals, 2),
        "means": table(&means, 2),
        "actions": table(&actions, 2),
        "log_probs": log_probs,
        "checksum": seeds::checksum(&[b"treadmill"]),
    })
}

#[test]
fn the_golden_numbers_of_the_python_tests_are_up_to_date() {
    let path = python_folder().join("tests/golden.json");
    let now = golden();
    if std::env::var_os("TREADMILL_WRITE_GOLDEN").is_some() {
        std::fs::write(&path, format!("{now:#}\n")).unwrap();
    }
    let kept: serde_json::Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(kept["checksum"], now["checksum"]);
    for field in ["observations", "normals", "means", "actions", "log_probs"] {
        let numbers = |of: &serde_json::Value| {
            let rows = of[field].as_array().unwrap().iter();
            rows.flat_map(|row| row.as_array().cloned().unwrap_or_else(|| vec![row.clone()]))
                .map(|number| number.as_f64().unwrap())
                .collect::<Vec<_>>()
        };
        let (kept, now) = (numbers(&kept), numbers(&now));
        assert_eq!(kept.len(), now.len());
        // Other processors may sum products in another order.
        assert!(kept.iter().zip(&now).all(|(kept, now)| (kept - now).abs() < 1e-5), "{field}: {kept:?} {now:?}");
    }
}

/// Returns a Python with `modules` and the package of the actor.
fn python(modules: &str) -> Option<Command> {
    let mut command = python_with(modules)?;
    command.env("PYTHONPATH", python_folder());
    Some(command)
}

#[test]
fn the_python_package_passes_its_own_tests() {
    let Some(mut python) = python("gymnasium, google.protobuf, numpy, zenoh") else { return };
    let tests = python_folder().join("tests");
    let output = python.args(["-m", "unittest", "discover", "-s", tests.to_str().unwrap()]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("OK") && !stderr(&output).contains("Ran 0 tests"), "{}", stderr(&output));
}

#[test]
fn a_python_actor_trains_and_outlives_its_learner() {
    let Some(mut python) = python("gymnasium, google.protobuf, mujoco, numpy, zenoh") else { return };
    let (folder, run) = folders();
    let path = run.to_str().unwrap().to_string();
    // The second learner uses the same port, so that the actor finds it.
    let [listen] = free_endpoints("tcp");
    let learner = |more: &[&str]| {
        let mut command = treadmill(folder.path());
        command.args(["learner", "--listen", &listen]).args(more);
        Running::start(command)
    };
    let task = ["--preset", "smoke", "--task", "gymnasium/InvertedPendulum-v5"];
    let first = learner(&[&task[..], &["--run-dir", &path, "--steps", ENDLESS]].concat());
    endpoint(&run);
    python.args(["-m", "treadmill_actor", "--env", "InvertedPendulum-v5", "--run", "run", "--connect", &listen]);
    python.args(["--envs", "4", "--name", "gym-1", "--seed", "1"]);
    let actor = Running::start(python);
    actor.wait_for("joined run `run`");
    // The recording example writes the experience as arrays.
    let recorded = folder.path().join("recorded");
    let mut record = self::python("google.protobuf, numpy, zenoh").expect("a Python, as above");
    record.arg(python_folder().join("examples/actor/record.py")).arg(&recorded);
    record.args(["--connect", &listen, "--count", "2"]);
    let output = record.output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let files: Vec<PathBuf> = std::fs::read_dir(&recorded).unwrap().flatten().map(|entry| entry.path()).collect();
    let arrays =
        "import numpy, sys; f = numpy.load(sys.argv[1]); print(f['observations'].shape, f['last_at'].shape[1])";
    let shapes = Command::new(std::env::var("TREADMILL_PYTHON").unwrap()).args(["-c", arrays]).arg(&files[0]).output();
    assert_eq!((files.len(), stdout(&shapes.unwrap()).trim()), (2, "(64, 4, 4) 2"));

    await_steps(&run, 4096);
    first.signal(libc::SIGKILL);
    drop(first);
    let second = learner(&["--resume", &path, "--steps", "16384"]);
    let (status, lines) = second.wait();
    assert!(status.success(), "{lines:#?}");
    assert!(last_value(&run, "rollout/ep_rew_mean").is_some_and(|reward| reward > 0.0));
    assert_eq!(last_value(&run, "bus/fragments_malformed"), Some(0.0));
    // The first batch that reaches the goal is the last; it holds all that was delivered.
    let [steps, batch] = ["time/total_timesteps", "train/batch"].map(|tag| last_value(&run, tag).unwrap());
    assert!(steps >= 16384.0 && steps - batch < 16384.0, "{steps} steps, the last batch of {batch}");
    actor.signal(libc::SIGINT);
    let (status, lines) = actor.wait();
    assert!(status.success(), "{lines:#?}");
}

#[test]
fn a_python_actor_goes_on_with_the_standby_that_takes_over() {
    let Some(mut python) = python("gymnasium, google.protobuf, mujoco, numpy, zenoh") else { return };
    let (folder, run) = folders();
    let store = format!("file://{}/store", folder.path().display());
    let learner = |name: &str, more: &[&str]| {
        let mut command = treadmill(folder.path());
        command.args(["learner", "--store", &store, "--listen", "tcp/127.0.0.1:0", "--run-dir", name]).args(more);
        Running::start(command)
    };
    let new = ["--preset", "smoke", "--task", "gymnasium/InvertedPendulum-v5", "--steps", ENDLESS];
    let leader = learner("run", &new);
    let listening = |learner: &Running| learner.wait_for("listening ").rsplit(' ').next().unwrap().to_string();
    let leading = listening(&leader);
    let standby = learner("second", &["--standby", "--connect", &leading]);
    let (second, following) = (folder.path().join("second"), listening(&standby));
    python.args(["-m", "treadmill_actor", "--env", "InvertedPendulum-v5", "--envs", "4", "--seed", "1"]);
    python.args(["--run", "run", "--connect", &leading, "--connect", &following]);
    let actor = Running::start(python);
    await_steps(&run, 2048);
    standby.wait_for("run `run` is at");
    let reached = last_step(&run);
    leader.signal(libc::SIGKILL);
    standby.wait_for("taking over");
    await_steps(&second, reached + 2048);
    assert_eq!(last_value(&second, "bus/fragments_malformed"), Some(0.0));
    actor.signal(libc::SIGINT);
    let (status, lines) = actor.wait();
    assert!(status.success(), "{lines:#?}");
}

#[test]
fn a_python_actor_of_another_task_is_refused_by_name() {
    let Some(mut python) = python("gymnasium, google.protobuf, mujoco, numpy, zenoh") else { return };
    let (folder, run) = folders();
    let mut command = treadmill(folder.path());
    command.args(["learner", "--listen", "tcp/127.0.0.1:0", "--preset", "smoke", "--run-dir", run.to_str().unwrap()]);
    let _training = Running::start(command);
    let endpoint = endpoint(&run);
    python.args(["-m", "treadmill_actor", "--env", "InvertedPendulum-v5", "--run", "run", "--connect", &endpoint]);
    let output = python.args(["--envs", "1"]).output().unwrap();
    assert_refused(&output, 1, &["`treadmill/humanoid-v5` (45 observations, 17 actions)", "InvertedPendulum-v5"]);
}
