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
