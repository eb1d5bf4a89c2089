//! Command that goes on with a run as it was started: with its endpoints, certificates, pages and device.

use std::{env, fs};

use treadmill_runtime::{run_folder::RunFolder, words::quoted};

/// Flags of `train` and `learner` that belong to the process, not to the run, which has the others saved; whether they
/// have a value.
const OF_PROCESS: [(&str, bool); 17] = [
    ("--listen", true),
    ("--connect", true),
    ("--tls", true),
    ("--insecure", false),
    ("--discover", false),
    ("--shared-memory", false),
    ("--zenoh-config", true),
    ("--prometheus", true),
    ("--page-listen", true),
    ("--steer", false),
    ("--no-page", false),
    ("--standby", false),
    ("--device", true),
    ("--actors", true),
    ("--no-progress", false),
    ("--log-metrics", false),
    ("--json", false),
];

/// Returns the command that resumes the run of a folder, or of a store, in a process like this one, which runs `command`.
pub fn of_this_process(command: &str, folder: &RunFolder, store: Option<&str>) -> String {
    line(command, folder, store, env::args().skip(1))
}

/// Returns the command that resumes the run of a folder, by the files there.
pub fn of_folder(folder: &RunFolder) -> String {
    let text = |path| fs::read_to_string(path).unwrap_or_default();
    let written = text(folder.resume());
    if let Some(mut words) = shlex::split(&written).filter(|words| !words.is_empty()) {
        // The folder may have been moved since.
        let flag = words.iter().position(|word| word == "--resume" || word == "--run-dir");
        if let Some(root) = flag.and_then(|flag| words.get_mut(flag + 1)) {
            *root = folder.root().display().to_string();
        }
        return words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
    }
    // An older version wrote the folder.
    let config: toml::Table = text(folder.config()).parse().unwrap_or_default();
    let task = config.get("env").and_then(|env| env.get("task")).and_then(toml::Value::as_str);
    let command = if task == Some("external") { "learner" } else { "train" };
    let store = text(folder.store());
    line(command, folder, Some(store.trim()).filter(|url| !url.is_empty()), std::iter::empty())
}

fn line(command: &str, folder: &RunFolder, store: Option<&str>, arguments: impl Iterator<Item = String>) -> String {
    let root = quoted(&folder.root().display().to_string());
    let begin = match store {
        Some(url) => format!("treadmill {command} --store {} --run-dir {root} --resume-or-start", quoted(url)),
        None => format!("treadmill {command} --resume {root}"),
    };
    std::iter::once(begin).chain(kept(arguments).iter().map(|part| quoted(part))).collect::<Vec<_>>().join(" ")
}

/// Returns the flags of the process, with their values.
fn kept(arguments: impl Iterator<Item = String>) -> Vec<String> {
    let (mut kept, mut arguments) = (Vec::new(), arguments);
    while let Some(argument) = arguments.next() {
        let flag = argument.split('=').next().unwrap_or_default();
        let Some((_, has_value)) = OF_PROCESS.iter().find(|(known, _)| *known == flag) else { continue };
        let value = (*has_value && flag == argument).then(|| arguments.next()).flatten();
        kept.extend([argument].into_iter().chain(value));
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_of_the_process_are_kept_and_those_of_the_run_are_not() {
        let arguments = [
            "learner",
            "--preset",
            "smoke",
            "--listen",
            "tls/h:1",
            "--set",
            "run.seed=2",
            "--listen=tls/h:2",
            "--tls",
            "my keys",
            "--prometheus",
            "127.0.0.1:9",
            "--steps",
            "5",
            "--shared-memory",
            "--store",
            "file:///s",
        ];
        let wanted = [
            "--listen",
            "tls/h:1",
            "--listen=tls/h:2",
            "--tls",
            "my keys",
            "--prometheus",
            "127.0.0.1:9",
            "--shared-memory",
        ];
        assert_eq!(kept(arguments.into_iter().map(str::to_string)), wanted);
    }
}
