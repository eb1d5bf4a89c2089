//! Pages of the reference, completions and manual pages, compared with the program.
//!
//! `TREADMILL_WRITE_REFERENCE=1 cargo test --release --test documentation reference` writes the pages.

use std::{collections::BTreeSet, fs, path::PathBuf, process::Command};

use clap::error::ErrorKind;

use crate::{
    support::*,
    tidy::{assert_none, files, root},
};
use treadmill_config::Config;
use treadmill_learner::metrics::catalogue::{METRICS, MetricRow};
use treadmill_rl::command_line;

/// Most words of the page of metrics.
const METRICS_WORDS_MAX: usize = 1870;

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

/// Joins strings and comments that go on in the next line, without tests of a source.
fn lines_joined(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let lines = text.lines().map(|line| line.trim_start_matches([' ', '/', '!', '#']));
    lines.fold(String::new(), |text, line| match text.strip_suffix('\\') {
        Some(begun) => format!("{begun}{line}"),
        None => format!("{text}\n{line}"),
    })
}

/// Returns the commands of a text: between backticks, after two blanks or a colon, or at the start of a line.
fn commands_in(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (start, _) in text.match_indices("treadmill ") {
        let (before, rest) = (&text[..start], &text[start..]);
        let is_inside = before.rsplit('\n').next().is_some_and(|line| line.starts_with("ip netns exec "));
        let ends: &[&str] = match before {
            _ if before.ends_with('`') => &["`", " >"],
            _ if before.ends_with('\n') || before.ends_with("  ") || is_inside => {
                &["\n", "  ", ", ", "\"", " | ", " >", " &", "`"]
            }
            _ if before.ends_with(": ") || before.ends_with('"') => &["\n", ", ", "\"", " (", "`", ";"],
            _ => continue,
        };
        // An apostrophe within a word quotes nothing.
        let is_unquoted = |at: &usize| {
            let opened = rest[..*at].matches(" '").count() + rest[..*at].matches("='").count();
            opened == 0 || rest[..*at].matches('\'').count() % 2 == 0
        };
        let places = ends.iter().flat_map(|end| rest.match_indices(end)).map(|(at, _)| at);
        let end = places.filter(is_unquoted).min().unwrap_or(rest.len());
        found.push(rest[..end].replace('\n', " "));
    }
    found
}

/// Replaces what a program fills in: a word of its own, or nothing after a word.
fn filled(command: &str) -> String {
    let mut text = String::new();
    for (number, part) in command.split('{').enumerate() {
        let after = if number == 0 { part } else { part.split_once('}').map_or("", |(_, after)| after) };
        if number > 0 && text.ends_with([' ', '/', '\'']) {
            text.push('x');
        }
        text.push_str(after);
    }
    text
}

/// Returns whether a word is no long flag, or one of a command or of its subcommands.
fn is_flag_of(command: &str, word: &str) -> bool {
    let Some(flag) = word.strip_prefix("--") else { return true };
    let flag = flag.split('=').next().unwrap_or_default();
    let program = command_line();
    let command = program.find_subcommand(command).unwrap();
    let mut commands = std::iter::once(command).chain(command.get_subcommands());
    commands.any(|command| command.get_arguments().any(|argument| argument.get_long() == Some(flag)))
}

#[test]
fn every_command_that_a_program_prints_or_a_page_shows_is_one() {
    let names: Vec<String> = command_line().get_subcommands().map(|one| one.get_name().to_owned()).collect();
    let is_name = |word: &String| {
        word.starts_with(|first: char| first.is_ascii_lowercase())
            && word.chars().all(|letter| matches!(letter, 'a'..='z' | '0'..='9' | '-'))
    };
    let (mut tried, mut wrong) = (0, Vec::new());
    for (path, text) in files(&["rs", "md", "py", "sh", "yml", "yaml"]) {
        if path.split('/').any(|part| part == "tests") || path.ends_with("_tests.rs") {
            continue;
        }
        for command in commands_in(&lines_joined(&text)) {
            let command = filled(&command);
            let Some(words) = shlex::split(&command) else {
                wrong.push(format!("{path}: {command}: not a line of a shell"));
                continue;
            };
            match words.get(1) {
                Some(name) if names.contains(name) => {}
                // The program fills in its name.
                Some(name) if name != "x" && is_name(name) => {
                    wrong.push(format!("{path}: {command}: there is no `{name}`"));
                    continue;
                }
                _ => continue,
            }
            tried += 1;
            let Err(error) = command_line().try_get_matches_from(&words) else { continue };
            // A command or flag may be named without its values, and a value may be a placeholder.
            let is_named = words[1..].iter().all(is_name) || words[words.len() - 1].starts_with('-');
            let is_right = match error.kind() {
                ErrorKind::DisplayHelp => true,
                // It is the first error, which hides unknown flags.
                ErrorKind::ValueValidation => words.iter().all(|word| is_flag_of(&words[1], word)),
                ErrorKind::MissingRequiredArgument
                | ErrorKind::MissingSubcommand
                | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
                | ErrorKind::InvalidValue => is_named,
                _ => false,
            };
            if !is_right {
                wrong.push(format!("{path}: {command}: {}", error.to_string().lines().next().unwrap_or_default()));
            }
        }
    }
    assert_none(&wrong, "commands are those of the program");
    assert!(tried > 150, "{tried} commands");
}
