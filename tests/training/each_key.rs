//! Each declared key, given where a run goes on: none is accepted, written down and without effect.

use std::fs;

use toml::{Table, Value};
use treadmill_config::{Config, KeyDoc};

use crate::support::*;

/// Returns another allowed value of a key.
fn another(key: &KeyDoc, value: &Value) -> Option<Value> {
    let quoted = key.allowed.split('"').skip(1).step_by(2).map(Value::from);
    let candidates: Vec<Value> = match value {
        Value::Boolean(is) => vec![(!is).into()],
        Value::Integer(number) => [number + 1, number - 1, 2 * number, number / 2].map(Value::from).to_vec(),
        Value::Float(number) => [0.5 * number, 1.1 * number, 0.25, -1.0].map(Value::from).to_vec(),
        Value::String(_) => quoted.chain(["other".into()]).collect(),
        Value::Array(_) => ["[0.75, 1.25]", "[0, 1]", "[0.5, 2.0]", "[16]", "[\"slope\"]", "[\"other\"]"]
            .iter()
            .map(|text| array(text))
            .collect(),
        _ => Vec::new(),
    };
    let converted = candidates.into_iter().filter_map(|candidate| (key.convert)(&candidate).ok());
    converted.into_iter().find(|candidate| candidate != value && (key.is_allowed)(candidate.clone()))
}

fn array(text: &str) -> Value {
    format!("list = {text}").parse::<Table>().unwrap()["list"].clone()
}

#[test]
fn a_resumed_run_refuses_each_of_them_by_name() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let saved: Table = fs::read_to_string(run.join("config.toml")).unwrap().parse().unwrap();
    for key in Config::keys() {
        let (section, name) = key.key.split_once('.').unwrap();
        // Those of an external task are not written for a built-in one.
        let Some(value) = saved.get(section).and_then(|keys| keys.get(name)) else { continue };
        let other = another(&key, value).unwrap_or_else(|| panic!("no other value than {value} of {}", key.key));
        let given = format!("{}={other}", key.key);
        let output = self::run(folder.path(), &["train", "--resume", run.to_str().unwrap(), "--set", &given]);
        let text = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{given}: {text}");
        assert!(text.contains(key.key), "{given}: {text}");
    }
}

/// Begins a run with other values of all keys of each section at once, and checks that its configuration has them. Keys that
/// are refused by name are left out then; returns those.
fn refused_beside(begin: &[&str]) -> Vec<String> {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let saved: Table = fs::read_to_string(run.join("config.toml")).unwrap().parse().unwrap();
    let mut refused = Vec::new();
    for (section, keys) in &saved {
        let others = Config::keys().into_iter().filter_map(|key| {
            let name = key.key.strip_prefix(&format!("{section}."))?;
            // Flags of their own set these.
            let is_flag = ["run.steps", "rollout.actors"].contains(&key.key);
            let other = another(&key, keys.get(name)?).filter(|_| !is_flag)?;
            Some((key.key, other))
        });
        let mut given: Vec<(&str, Value)> = others.collect();
        loop {
            let pairs: Vec<String> = given.iter().map(|(key, other)| format!("{key}={other}")).collect();
            let flags = set(&pairs.iter().map(String::as_str).collect::<Vec<_>>());
            let output = self::run(folder.path(), &[begin, &flags[..]].concat());
            if output.status.success() {
                break;
            }
            let text = stderr(&output);
            let named = given.iter().position(|(key, _)| text.contains(key));
            let named = named.unwrap_or_else(|| panic!("{begin:?}, {pairs:?}: {text}"));
            assert_eq!(output.status.code(), Some(2), "{text}");
            refused.push(given.remove(named).0.to_string());
        }
        let begun = folder.path().join("new");
        let written: Table = fs::read_to_string(begun.join("config.toml")).unwrap().parse().unwrap();
        for (key, other) in &given {
            assert_eq!(written[section].get(&key[section.len() + 1..]), Some(other), "{key}");
        }
        fs::remove_dir_all(begun).unwrap();
    }
    refused
}

/// What the networks or other keys decide: no other robot, keyframe or task is there, and only velocity runs have ground.
const DECIDED: [&str; 8] = [
    "env.robot",
    "env.keyframe",
    "env.own_task",
    "env.observation",
    "env.exclude_current_positions_from_observation",
    "ground.kinds",
    "policy.init_log_std",
    "policy.hidden",
];

#[test]
fn a_fork_has_them_or_refuses_them_by_name() {
    let refused = refused_beside(&["train", "--fork", "run", "--run-dir", "new", "--steps", "2560", "--actors", "1"]);
    assert_eq!(refused, [&DECIDED[..], &["ppo.symmetry"]].concat());
}

#[test]
fn a_run_with_an_initial_policy_has_them_or_refuses_them_by_name() {
    let begin = ["train", "--init-from", "run", "--preset", "smoke", "--run-dir", "new", "--steps", "512"];
    let refused = refused_beside(&[&begin[..], &["--actors", "1"]].concat());
    assert_eq!(refused, DECIDED);
}
