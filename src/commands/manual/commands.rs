//! Page of all commands and flags, generated from clap's definitions.

use std::collections::{BTreeMap, BTreeSet};

use clap::{Arg, ArgAction, Command};

use super::heading;

/// Arguments of every command.
const COMMON: [&str; 2] = ["help", "version"];

/// Returns the page. An argument that several commands have alike is described once, under the first heading.
pub fn page(program: Command) -> String {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let mut counts = BTreeMap::new();
    count(&program, &mut counts);
    let shared: BTreeSet<String> = counts.into_iter().filter(|(_, count)| *count > 1).map(|(line, _)| line).collect();
    let mut page = heading("Commands", "the definitions of the command line");
    page += "\n`treadmill COMMAND --help` and the pages of `treadmill man FOLDER` have the same text.\n";
    page += "\n## Shared arguments\n\nCommands below name those that they have.\n\n";
    shared.iter().for_each(|line| page += line);
    describe(&mut page, &program, &shared);
    page
}

/// Counts the commands that have each argument, by its line.
fn count(command: &Command, counts: &mut BTreeMap<String, usize>) {
    for argument in shown(command) {
        *counts.entry(line(argument)).or_default() += 1;
    }
    command.get_subcommands().filter(|command| !command.is_hide_set()).for_each(|command| count(command, counts));
}

fn describe(page: &mut String, command: &Command, shared: &BTreeSet<String>) {
    let name = command.get_display_name().unwrap_or_else(|| command.get_name()).replace('-', " ");
    let about = command.get_long_about().or_else(|| command.get_about());
    *page += &format!("\n## {name}\n\n{}\n", about.map(ToString::to_string).unwrap_or_default());
    let (known, own): (Vec<_>, Vec<_>) = shown(command).partition(|argument| shared.contains(&line(argument)));
    let known: Vec<String> = known.into_iter().map(|argument| format!("`{}`", name_of(argument))).collect();
    if !known.is_empty() {
        *page += &format!("\nShared: {}.\n", known.join(", "));
    }
    if !own.is_empty() {
        *page += "\n";
        own.into_iter().for_each(|argument| *page += &line(argument));
    }
    command
        .get_subcommands()
        .filter(|command| !command.is_hide_set())
        .for_each(|command| describe(page, command, shared));
}

/// Returns the arguments that the page has, positional ones first.
fn shown(command: &Command) -> impl Iterator<Item = &Arg> {
    let is_shown = |argument: &&Arg| !argument.is_hide_set() && !COMMON.contains(&argument.get_id().as_str());
    let mut arguments: Vec<&Arg> = command.get_arguments().filter(is_shown).collect();
    arguments.sort_by_key(|argument| !argument.is_positional());
    arguments.into_iter()
}

/// Returns the line of an argument.
fn line(argument: &Arg) -> String {
    let help = argument.get_long_help().or_else(|| argument.get_help()).map(ToString::to_string);
    format!("- `{}`{}: {}{}\n", usage(argument), default(argument), help.unwrap_or_default(), choices(argument))
}

/// Returns the name of an argument without its values.
fn name_of(argument: &Arg) -> String {
    argument.get_long().map_or_else(|| usage(argument), |long| format!("--{long}"))
}

/// Returns an argument as the user types it.
fn usage(argument: &Arg) -> String {
    let values: Vec<String> = match argument.get_value_names() {
        Some(names) => names.iter().map(ToString::to_string).collect(),
        None => vec![argument.get_id().to_string().to_uppercase()],
    };
    let takes_values = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    match argument.get_long() {
        Some(long) if takes_values => format!("--{long} {}", values.join(" ")),
        Some(long) => format!("--{long}"),
        None if argument.is_required_set() => values.join(" "),
        None => format!("[{}]", values.join(" ")),
    }
}

fn default(argument: &Arg) -> String {
    let values: Vec<String> = match argument.get_action() {
        ArgAction::Set | ArgAction::Append => {
            argument.get_default_values().iter().map(|value| format!("`{}`", value.to_string_lossy())).collect()
        }
        _ => Vec::new(),
    };
    if values.is_empty() { String::new() } else { format!(" (default {})", values.join(", ")) }
}

/// Returns a sentence with the possible values of an enumeration.
fn choices(argument: &Arg) -> String {
    let takes_values = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    let values = argument.get_possible_values();
    let named: Vec<String> = values.iter().map(|value| format!("`{}`", value.get_name())).collect();
    if takes_values && !named.is_empty() { format!(". One of {}.", named.join(", ")) } else { String::new() }
}

#[cfg(test)]
mod tests {
    use std::{fs, path::Path};

    use clap::{CommandFactory, Parser, error::ErrorKind};

    use crate::Cli;

    const ROOT: &str = env!("CARGO_MANIFEST_DIR");
    /// Folders of sources whose messages name commands, and of pages.
    const FOLDERS: [&str; 8] = ["src", "learner", "actor", "common", "watch", "python", "deploy", "docs"];

    /// Reads the sources and pages below a folder, without tests of sources.
    fn read(folder: &Path, texts: &mut Vec<(String, String)>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let kind = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            match path.is_dir() {
                true if path.ends_with("tests") || path.ends_with("target") => {}
                true => read(&path, texts),
                false if path.to_string_lossy().ends_with("_tests.rs") => {}
                false if ["rs", "md", "py", "sh", "yml", "yaml"].contains(&kind.as_str()) => {
                    let text = fs::read_to_string(&path).unwrap();
                    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
                    // A string or comment may go on in the next line.
                    let lines = text.lines().map(|line| line.trim_start_matches([' ', '/', '!', '#']));
                    let joined = lines.fold(String::new(), |text, line| match text.strip_suffix('\\') {
                        Some(begun) => format!("{begun}{line}"),
                        None => format!("{text}\n{line}"),
                    });
                    texts.push((path.display().to_string(), joined));
                }
                false => {}
            }
        }
    }

    /// Returns the commands of a text: between backticks, after two blanks or a colon, or at the start of a line.
    fn commands(text: &str) -> Vec<String> {
        let mut found = Vec::new();
        for (start, _) in text.match_indices("treadmill ") {
            let (before, rest) = (&text[..start], &text[start..]);
            let ends: &[&str] = match before {
                _ if before.ends_with('`') => &["`"],
                _ if before.ends_with('\n') || before.ends_with("  ") => {
                    &["\n", "  ", ", ", "\"", " | ", " > ", " &", "`"]
                }
                _ if before.ends_with(": ") || before.ends_with('"') => &["\n", ", ", "\"", " (", "`", ";"],
                _ => continue,
            };
            let is_unquoted = |at: &usize| rest[..*at].matches('\'').count() % 2 == 0;
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
            let (_, after) = if number == 0 { ("", part) } else { part.split_once('}').unwrap_or((part, "")) };
            if number > 0 && text.ends_with([' ', '/', '\'']) {
                text.push('x');
            }
            text.push_str(after);
        }
        text
    }

    #[test]
    fn every_command_that_a_program_prints_or_a_page_shows_is_one() {
        let mut texts = Vec::new();
        FOLDERS.iter().for_each(|folder| read(&Path::new(ROOT).join(folder), &mut texts));
        texts.push((
            "README.md".into(),
            format!("\n{}", fs::read_to_string(Path::new(ROOT).join("README.md")).unwrap()),
        ));
        let names: Vec<String> = Cli::command().get_subcommands().map(|one| one.get_name().to_owned()).collect();
        let (mut tried, mut wrong) = (0, Vec::new());
        for (path, text) in &texts {
            for command in commands(text) {
                let command = filled(&command);
                let Some(words) = shlex::split(&command) else {
                    wrong.push(format!("{path}: {command}: not a line of a shell"));
                    continue;
                };
                let is_name = |word: &String| word.chars().all(|letter| letter.is_ascii_lowercase());
                match words.get(1) {
                    Some(name) if names.contains(name) => {}
                    Some(name) if is_name(name) => {
                        wrong.push(format!("{path}: {command}: there is no `{name}`"));
                        continue;
                    }
                    _ => continue,
                }
                tried += 1;
                let Err(error) = Cli::try_parse_from(&words) else { continue };
                // A command or flag may be named without its values, and a value may be a placeholder.
                let is_named = words[1..].iter().all(is_name) || words[words.len() - 1].starts_with('-');
                let is_right = match error.kind() {
                    ErrorKind::ValueValidation | ErrorKind::DisplayHelp => true,
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
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        assert!(tried > 150, "{tried} commands");
    }
}
