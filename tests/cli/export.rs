//! `export`: exported files play the same episodes, are readable without this program, and are refused if malformed.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use crate::support::*;
use rten_tensor::{NdTensor, prelude::*};
use serde_json::Value;

fn export(folder: &Path, run: &str, file: &Path) -> Vec<u8> {
    let output = done(folder, &["export", run, "--safetensors", file.to_str().unwrap()]);
    assert!(stdout(&output).contains(file.to_str().unwrap()));
    fs::read(file).unwrap()
}

/// Safetensors file: length of the header, header, numbers.
struct Tensors {
    header: Value,
    data: Vec<u8>,
}

impl Tensors {
    fn parse(bytes: &[u8]) -> Self {
        let length = u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
        Self { header: serde_json::from_slice(&bytes[8..8 + length]).unwrap(), data: bytes[8 + length..].to_vec() }
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        let place = &self.header[name]["data_offsets"];
        let bytes = &self.data[place[0].as_u64().unwrap() as usize..place[1].as_u64().unwrap() as usize];
        match self.header[name]["dtype"].as_str().unwrap() {
            "F32" => bytes.as_chunks::<4>().0.iter().map(|number| f64::from(f32::from_le_bytes(*number))).collect(),
            _ => bytes.as_chunks::<8>().0.iter().map(|number| f64::from_le_bytes(*number)).collect(),
        }
    }

    /// Returns the action means for a raw observation, computed as the format's documentation describes.
    fn act(&self, facts: &Value, observation: &[f64]) -> Vec<f64> {
        let clip = facts["observation"]["clip"].as_f64().unwrap();
        let epsilon = facts["observation"]["variance_epsilon"].as_f64().unwrap();
        let (mean, variance) = (self.numbers("observation.mean"), self.numbers("observation.variance"));
        let mut row: Vec<f64> = observation
            .iter()
            .zip(mean.iter().zip(&variance))
            .map(|(x, (mean, variance))| ((x - mean) / (variance + epsilon).sqrt()).clamp(-clip, clip))
            .collect();
        let layers = facts["network"]["hidden"].as_array().unwrap().len() + 1;
        for layer in 0..layers {
            let weight = self.numbers(&format!("actor.{layer}.weight"));
            let bias = self.numbers(&format!("actor.{layer}.bias"));
            let inputs = row.len();
            row = weight
                .chunks(inputs)
                .zip(bias)
                .map(|(weights, bias)| bias + weights.iter().zip(&row).map(|(w, x)| w * x).sum::<f64>())
                .map(|x| if layer + 1 < layers && x < 0.0 { x.exp_m1() } else { x })
                .collect();
        }
        row
    }
}

#[test]
fn an_exported_policy_plays_the_episodes_of_its_run_and_every_export_is_identical() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let (one, two) = (folder.path().join("one.safetensors"), folder.path().join("elsewhere.bin"));
    let bytes = export(folder.path(), run.to_str().unwrap(), &one);
    assert_eq!(export(folder.path(), run.to_str().unwrap(), &two), bytes);
    let bundle = run.join("checkpoints/latest.bundle");
    assert_eq!(export(folder.path(), bundle.to_str().unwrap(), &two), bytes);
    assert_eq!(export(folder.path(), one.to_str().unwrap(), &two), bytes);

    // The same policy in a run of another name, at another time.
    let moved = folder.path().join("another-name");
    fs::rename(&run, &moved).unwrap();
    assert_eq!(export(folder.path(), "another-name", &two), bytes);

    let play = |what: &str, more: &[&str]| {
        let args = [&["eval", what, "--episodes", "3", "--seed", "5", "--json"], more].concat();
        let output = done(folder.path(), &args);
        last_json(&output)
    };
    let mut result = play("another-name", &[]);
    assert_eq!((result["checkpoint"].take(), result["checkpoint_env_steps"].take()), ("latest".into(), 2048.into()));
    assert_eq!(play(one.to_str().unwrap(), &[]), result);
    assert_eq!(play(two.to_str().unwrap(), &[]), result);
}

#[test]
fn the_file_alone_determines_the_actions() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let (file, trace) = (folder.path().join("policy.safetensors"), folder.path().join("trace.jsonl"));
    let tensors = Tensors::parse(&export(folder.path(), run.to_str().unwrap(), &file));
    let text = tensors.header["__metadata__"]["treadmill"].as_str().unwrap();
    let facts: Value = serde_json::from_str(text).unwrap();
    assert_eq!(facts["action"]["names"][0], "abdomen_y");
    assert_eq!(facts["action"]["high"][16], 0.4);
    assert!(facts["settings"].as_str().unwrap().contains("healthy_reward = 5.0"));

    let args = ["eval", file.to_str().unwrap(), "--episodes", "1", "--trace", trace.to_str().unwrap()];
    done(folder.path(), &args);
    let (steps, mut largest) = (json_lines(&trace), 0.0f64);
    for step in &steps {
        let expected = tensors.act(&facts, &numbers(&step["observation"]));
        for (found, expected) in numbers(&step["action"]).iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-5, "{found} is not {expected}");
            largest = largest.max(found.abs());
        }
    }
    assert!(steps.len() > 5 && largest > 1e-3, "{largest}");
}

#[test]
fn unusable_files_are_refused_by_name_and_reason() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let file = folder.path().join("policy.safetensors");
    let valid = export(folder.path(), run.to_str().unwrap(), &file);
    let eval = |bytes: &[u8]| {
        fs::write(&file, bytes).unwrap();
        self::run(folder.path(), &["eval", file.to_str().unwrap(), "--episodes", "1"])
    };
    assert_refused(&eval(&valid[..valid.len() / 2]), 1, &["policy.safetensors", "truncated"]);
    assert_refused(&eval(b""), 1, &["policy.safetensors", "truncated"]);
    assert_refused(&eval(b"\x02\0\0\0\0\0\0\0{}"), 1, &["`treadmill export` did not write it"]);

    // A NaN in the first number of the first tensor.
    let mut broken = valid.clone();
    let place = Tensors::parse(&valid).header["log_std"]["data_offsets"][0].as_u64().unwrap() as usize;
    let at = valid.len() - Tensors::parse(&valid).data.len() + place;
    broken[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_refused(&eval(&broken), 1, &["policy.safetensors", "log_std", "NaN", "index 0"]);

    // The model of another robot, to which the network does not fit.
    let header = String::from_utf8_lossy(&valid).into_owned();
    assert!(header.contains("-0.4 0.4"));
    let replaced = replace(&valid, b"-0.4 0.4", b"-0.5 0.5");
    assert_refused(&eval(&replaced), 1, &["policy.safetensors", "`abdomen_y`", "action.low -0.4", "-0.5 to 0.5"]);

    let nowhere = folder.path().join("no/such/folder/x.safetensors");
    let output =
        self::run(folder.path(), &["export", run.to_str().unwrap(), "--safetensors", nowhere.to_str().unwrap()]);
    assert_refused(&output, 1, &["no/such/folder/x.safetensors", "its folder"]);
    assert_usage(folder.path(), &["export", "nowhere", "--safetensors", "x"], &["nowhere"]);
    assert_usage(folder.path(), &["export", run.to_str().unwrap()], &["--safetensors", "--onnx"]);
}

/// Replaces the first `from` by `to` of the same length.
fn replace(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let at = bytes.windows(from.len()).position(|window| window == from).unwrap();
    [&bytes[..at], to, &bytes[at + from.len()..]].concat()
}

#[test]
fn other_programs_compute_the_same_actions() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let run = run.to_str().unwrap();
    let (model, file) = (folder.path().join("policy.onnx"), folder.path().join("policy.safetensors"));
    let files = ["--onnx", model.to_str().unwrap(), "--safetensors", file.to_str().unwrap()];
    let output = done(folder.path(), &[&["export", run], &files[..]].concat());
    assert_eq!(stdout(&output).lines().count(), 2, "{}", stdout(&output));
    let trace = folder.path().join("trace.jsonl");
    let args = ["eval", run, "--episodes", "80", "--trace", trace.to_str().unwrap(), "--json"];
    done(folder.path(), &args);
    let wanted = wanted(&file, &trace);
    assert!(wanted.len() >= 1000, "{} observations", wanted.len());

    // The example, which uses no code of this project.
    let observations = folder.path().join("observations.jsonl");
    let line = |step: &Value| step["observation"].to_string() + "\n";
    fs::write(&observations, json_lines(&trace).iter().map(line).collect::<String>()).unwrap();
    let output = Command::new(example("play_policy")).arg(&file).stdin(fs::File::open(&observations).unwrap()).output();
    compare(&wanted, &output.unwrap(), 1e-5);

    // A Rust runtime.
    let of_rten = rten::Model::load_file(&model).unwrap();
    let play = |row: Vec<f64>| -> Vec<f32> {
        let row: Vec<f32> = row.into_iter().map(|number| number as f32).collect();
        let batch = NdTensor::from_data([1, row.len()], row);
        let found = of_rten.run_one(rten::Value::from(batch).into(), None).unwrap();
        NdTensor::<f32, 2>::try_from(found).unwrap().to_vec()
    };
    let steps = json_lines(&trace);
    for (step, wanted) in steps.iter().zip(&wanted) {
        let found = play(numbers(&step["observation"]));
        let off =
            found.iter().zip(wanted).map(|(found, wanted)| (f64::from(*found) - wanted).abs()).fold(0.0, f64::max);
        assert!(off < 1e-5 && found.len() == wanted.len(), "{off}");
    }
    let mut broken = numbers(&steps[0]["observation"]);
    broken[7] = f64::NAN;
    assert!(play(broken).iter().all(|action| action.is_nan()), "a broken sensor is seen in every action");

    let Some(mut python) = python_with("numpy, onnx, onnxruntime") else { return };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/run_onnx.py");
    let played = python.arg(&script).arg(&model).arg(&trace).output().unwrap();
    compare(&wanted, &played, 1e-5);
    for runtime in ["openvino", "tract"] {
        let Some(mut python) = python_with(&format!("numpy, onnx, {runtime}")) else { continue };
        compare(&wanted, &python.arg(&script).arg(&model).arg(&trace).arg(runtime).output().unwrap(), 1e-5);
    }

    // Mirrored observations give mirrored actions.
    let mirror = latest(Path::new(run)).ppo.networks().mirror().unwrap().clone();
    let mirrored = |row: Vec<f64>, reflection: &[(usize, f32)]| -> Vec<f64> {
        reflection.iter().map(|(entry, sign)| row[*entry] * f64::from(*sign)).collect()
    };
    let line = |step: &Value| {
        let observation = mirrored(numbers(&step["observation"]), &mirror.observation);
        serde_json::json!({ "observation": observation }).to_string() + "\n"
    };
    let images = folder.path().join("mirrored.jsonl");
    fs::write(&images, json_lines(&trace).iter().map(line).collect::<String>()).unwrap();
    let wanted: Vec<_> = actions(&played).into_iter().map(|row| mirrored(row, &mirror.action)).collect();
    let mut python = python_with("numpy, onnx, onnxruntime").unwrap();
    compare(&wanted, &python.arg(script).arg(&model).arg(&images).output().unwrap(), 1e-6);
}

/// Returns the actions of a trace in the units of the motors, with the ranges of the exported policy.
fn wanted(policy: &Path, trace: &Path) -> Vec<Vec<f64>> {
    let Tensors { header, .. } = Tensors::parse(&fs::read(policy).unwrap());
    let facts: Value = serde_json::from_str(header["__metadata__"]["treadmill"].as_str().unwrap()).unwrap();
    let (low, high) = (numbers(&facts["action"]["low"]), numbers(&facts["action"]["high"]));
    let motors = |step: &Value| {
        // A share of -1 is the low end, 1 the high one.
        let stretch = |(motor, share): (usize, f64)| {
            low[motor] + (share.clamp(-1.0, 1.0) + 1.0) / 2.0 * (high[motor] - low[motor])
        };
        numbers(&step["action"]).into_iter().enumerate().map(stretch).collect()
    };
    json_lines(trace).iter().map(motors).collect()
}

/// Returns the actions that another program wrote, one on a line.
fn actions(output: &Output) -> Vec<Vec<f64>> {
    assert!(output.status.success(), "{}", stderr(output));
    stdout(output).lines().map(|line| numbers(&serde_json::from_str(line).unwrap())).collect()
}

/// Compares actions that another program wrote.
fn compare(wanted: &[Vec<f64>], output: &Output, tolerance: f64) {
    let found = actions(output);
    assert_eq!(found.len(), wanted.len());
    for (row, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let off = found.iter().zip(wanted).map(|(found, wanted)| (found - wanted).abs()).fold(0.0, f64::max);
        assert!(off < tolerance && found.len() == wanted.len(), "row {row} is off by {off}");
    }
}

/// Returns the path of an example, which is built with the tests.
fn example(name: &str) -> PathBuf {
    let program = Path::new(env!("CARGO_BIN_EXE_treadmill")).parent().unwrap().join("examples").join(name);
    assert!(
        program.exists(),
        "`cargo test` builds it, but not `cargo test --test cli`: run `cargo build --release --examples` first"
    );
    program
}
