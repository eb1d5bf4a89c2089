//! Page of all commands and flags, generated from clap's definitions.

use std::fmt::Write as _;

use clap::{Arg, ArgAction, Command};

use super::{cell, heading};

/// Arguments of every command.
const COMMON: [&str; 2] = ["help", "version"];

/// Returns the page.
pub fn page(program: Command) -> String {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let mut page = heading("Commands", "the definitions of the command line");
    page += "\n`treadmill COMMAND --help` and the pages of `treadmill man FOLDER` have the same text.\n";
    page += "Every command has `--help`; `treadmill --version` prints the version.\n";
    // Writing into a string cannot fail.
    let _ = describe(&mut page, &program);
    page
}

fn describe(page: &mut String, command: &Command) -> std::fmt::Result {
    let name = command.get_display_name().unwrap_or_else(|| command.get_name()).replace('-', " ");
    writeln!(page, "\n## {name}\n")?;
    let about = command.get_long_about().or_else(|| command.get_about());
    writeln!(page, "{}\n", about.map(ToString::to_string).unwrap_or_default())?;
    let usage = command.clone().render_usage().to_string();
    writeln!(page, "```text\n{}\n```", usage.trim_start_matches("Usage:").trim())?;
    let subcommands: Vec<&Command> = command.get_subcommands().filter(|command| !command.is_hide_set()).collect();
    if !subcommands.is_empty() {
        writeln!(page, "\n| command | does |\n|---|---|")?;
        for subcommand in &subcommands {
            let does = subcommand.get_about().map(ToString::to_string).unwrap_or_default();
            let name = format!("{name} {}", subcommand.get_name());
            writeln!(page, "| [`{name}`](#{}) | {} |", name.replace(' ', "-"), cell(&does))?;
        }
    }
    arguments(page, command)?;
    subcommands.into_iter().try_for_each(|subcommand| describe(page, subcommand))
}

fn arguments(page: &mut String, command: &Command) -> std::fmt::Result {
    let mut arguments: Vec<&Arg> = command
        .get_arguments()
        .filter(|argument| !argument.is_hide_set() && !COMMON.contains(&argument.get_id().as_str()))
        .collect();
    if arguments.is_empty() {
        return Ok(());
    }
    arguments.sort_by_key(|argument| !argument.is_positional());
    writeln!(page, "\n| argument | default | what it does |\n|---|---|---|")?;
    for argument in arguments {
        let help = argument.get_long_help().or_else(|| argument.get_help()).map(ToString::to_string);
        writeln!(
            page,
            "| `{}` | {} | {}{} |",
            cell(&usage(argument)),
            default(argument),
            cell(&help.unwrap_or_default()),
            choices(argument)
        )?;
    }
    Ok(())
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
    if values.is_empty() { "–".to_string() } else { values.join(", ") }
}

/// Returns a sentence with the possible values of an enumeration.
fn choices(argument: &Arg) -> String {
    let takes_values = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    let values = argument.get_possible_values();
    let named: Vec<String> = values.iter().map(|value| format!("`{}`", value.get_name())).collect();
    if takes_values && !named.is_empty() { format!(" One of {}.", named.join(", ")) } else { String::new() }
}
