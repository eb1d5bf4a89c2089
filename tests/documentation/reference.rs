//! Pages of the reference, completions and manual pages, compared with the program.
//!
//! `TREADMILL_WRITE_REFERENCE=1 cargo test --release --test documentation reference` writes the pages.

use std::{collections::BTreeSet, fs, path::PathBuf, process::Command};

use crate::{
    support::*,
    tidy::{assert_none, files, root},
};
use treadmill_config::Config;
use treadmill_learner::metrics::catalogue::{METRICS, MetricRow};

/// Most words of the page of metrics.
const METRICS_WORDS_MAX: usize = 1750;

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/reference").join(name).with_extension("md")
}

/// Runs the program and returns its output.
fn output_of(args: &[&str]) -> String {
    let (folder, _) = folders();
    let output = run(folder.path(), args);
    assert!(output.status.success(), "{}", stderr(&output));
    stdout(&output)
}

/// Asserts that a page is what the program prints, or writes it. Returns the page.
fn assert_generated(name: &str) -> String {
    let wanted = output_of(&["reference", name]);
    if std::env::var_os("TREADMILL_WRITE_REFERENCE").is_some() {
        fs::write(file(name), &wanted).unwrap();
    }
    let found = fs::read_to_string(file(name)).unwrap_or_default();
    assert!(
        found == wanted,
        "docs/reference/{name}.md is out of date; write it with \
         TREADMILL_WRITE_REFERENCE=1 cargo test --release --test documentation reference"
    );
    wanted
}

#[test]
fn every_configuration_key_is_in_the_reference() {
    let page = assert_generated("configuration");
    for key in Config::keys() {
        let begin = format!("- `{} = {}` ({}): ", key.key, key.default, key.allowed);
        let row = page.lines().find(|line| line.starts_with(&begin)).expect(key.key);
        assert!(row.contains(key.doc), "{row}");
    }
    assert!(page.contains("\n- `ppo.target_kl = 0.04` (0 or more): ") && page.contains("*Live.*"), "{page}");
}

/// Returns the subcommands that `--help` of `command` lists, recursively.
fn commands(command: &[&str]) -> Vec<String> {
    let help = output_of(&[command, &["--help"]].concat());
    let Some((_, list)) = help.split_once("\nCommands:\n") else { return Vec::new() };
    let names = list.lines().take_while(|line| !line.is_empty()).filter(|line| !line.starts_with("   "));
    let names: Vec<&str> =
        names.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help").collect();
    names
        .into_iter()
        .flat_map(|name| {
            let below = [command, &[name]].concat();
            [vec![below.join(" ")], commands(&below)].concat()
        })
        .collect()
}

#[test]
fn every_command_and_flag_is_in_the_reference() {
    let page = assert_generated("commands");
    let commands = commands(&[]);
    assert!(commands.len() > 20, "{commands:?}");
    for command in commands {
        let heading = format!("\n## treadmill {command}\n");
        let (_, section) = page.split_once(&heading).unwrap_or_else(|| panic!("no section for {command}"));
        let section = section.split("\n## ").next().unwrap();
        let help = output_of(&[&command.split(' ').collect::<Vec<_>>()[..], &["--help"]].concat());
        let flags =
            help.lines().filter_map(|line| line.trim().split_once("--").filter(|(before, _)| before.len() <= 4));
        for (_, flag) in flags {
            let name: String = flag.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
            assert!(name == "help" || section.contains(&format!("`--{name}")), "--{name} of {command}");
        }
    }
}

#[test]
fn every_metric_is_in_the_reference() {
    let page = assert_generated("metrics");
    for MetricRow { tag, help, .. } in METRICS {
        assert!(page.lines().any(|line| line.starts_with("- `") && line.ends_with(&format!(": {help}"))), "{tag}");
    }
    let tags: BTreeSet<&str> = METRICS.iter().map(|row| row.tag).collect();
    assert_eq!(tags.len(), METRICS.len(), "each tag has one row");
    assert!(page.split_whitespace().count() <= METRICS_WORDS_MAX, "the page is short");
}

#[test]
fn tags_in_programs_and_pages_are_in_the_table() {
    let groups: BTreeSet<&str> = METRICS.iter().map(MetricRow::group).collect();
    let is_name =
        |name: &str| !name.is_empty() && name.chars().all(|c| c.is_ascii_lowercase() || "_0123456789".contains(c));
    let is_tag =
        |word: &&str| word.split_once('/').is_some_and(|(group, name)| groups.contains(group) && is_name(name));
    let mut offences = Vec::new();
    for (file, text) in files(&["rs", "py", "md"]) {
        let unknown = text.split(['"', '\'', '`']).filter(is_tag).filter(|tag| MetricRow::of(tag).is_none());
        offences.extend(unknown.filter(|tag| !root().join(tag).exists()).map(|tag| format!("{file}: {tag}")));
    }
    assert_none(&offences, "tags are those of learner/src/metrics/catalogue.rs");
}

#[test]
fn a_shell_completes_commands_and_flags() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(output_of(&["completions", shell]).contains("status"), "{shell}");
    }
    let (folder, _) = folders();
    for other in ["tcsh", "ksh"] {
        let output = run(folder.path(), &["completions", other]);
        assert_refused(&output, 2, &[other, "bash"]);
    }
    let script = folder.path().join("treadmill.bash");
    fs::write(&script, output_of(&["completions", "bash"])).unwrap();
    let commands = r#"source "$0" && complete -p treadmill
        COMP_WORDS=(treadmill sta); COMP_CWORD=1; _treadmill treadmill sta treadmill; echo "${COMPREPLY[@]}"
        COMP_WORDS=(treadmill status --wa); COMP_CWORD=2; _treadmill treadmill --wa status; echo "${COMPREPLY[@]}""#;
    let bash = Command::new("bash").args(["--norc", "-c", commands]).arg(&script).output().expect("bash");
    let text = stdout(&bash);
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].contains("-F _treadmill") && lines[0].ends_with(" treadmill"), "{text}");
    assert_eq!(lines[1..], ["status", "--watch"], "{}", stderr(&bash));
}

#[test]
fn every_command_has_a_manual_page() {
    let (folder, _) = folders();
    let pages = folder.path().join("share/man1");
    let output = run(folder.path(), &["man", pages.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    for command in commands(&[]).into_iter().chain(["".to_string()]) {
        let name = format!("treadmill {command}").trim().replace(' ', "-");
        let page = fs::read_to_string(pages.join(format!("{name}.1"))).unwrap_or_else(|why| panic!("{name}: {why}"));
        for part in [".SH NAME", ".SH SYNOPSIS", ".SH OPTIONS"] {
            assert!(page.contains(part), "{part} is missing in {name}.1");
        }
    }
    assert!(!pages.join("treadmill-reference.1").exists(), "a hidden command has no page");
    fs::write(folder.path().join("file"), "").unwrap();
    assert_refused(&run(folder.path(), &["man", "file"]), 1, &["cannot write manual pages to `file`"]);
}

#[test]
fn the_installation_includes_pages_and_completions() {
    let (folder, _) = folders();
    let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("deploy/install.sh");
    let installed = Command::new(script).arg(folder.path()).arg(env!("CARGO_BIN_EXE_treadmill")).output().unwrap();
    assert!(installed.status.success(), "{}", stderr(&installed));
    for file in [
        "bin/treadmill",
        "share/man/man1/treadmill-control-set.1",
        "share/bash-completion/completions/treadmill",
        "share/zsh/site-functions/_treadmill",
        "share/fish/vendor_completions.d/treadmill.fish",
    ] {
        assert!(fs::metadata(folder.path().join(file)).is_ok_and(|file| file.len() > 100), "{file}");
    }
}
