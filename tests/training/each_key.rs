//! Each declared key, given where a run goes on: none is accepted, written down and without effect.

use std::fs;

use toml::Value;
use treadmill_config::{Config, KeyDoc};

use crate::support::*;

/// Returns another allowed value of a key.
fn another(key: &KeyDoc, value: &Value) -> Option<Value> {
    let quoted = key.allowed.split('"').skip(1).step_by(2).map(Value::from);
    let candidates: Vec<Value> = match value {
        Value::Boolean(is) => vec![(!is).into()],
        Value::Integer(number) => vec![(number + 1).into(), (number - 1).into(), (2 * number).into()],
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
    format!("list = {text}").parse::<toml::Table>().unwrap()["list"].clone()
}

#[test]
fn a_resumed_run_refuses_each_of_them_by_name() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let saved: toml::Table = fs::read_to_string(run.join("config.toml")).unwrap().parse().unwrap();
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
