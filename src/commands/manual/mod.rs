//! `treadmill completions`, `man` and the hidden `reference`: text generated from definitions of commands, keys and metrics.
//!
//! # Layout
//! - [`commands`]: page of all commands and flags.
//! - [`configuration`]: page of all configuration keys.
//! - [`metrics`]: page of all metrics.

mod commands;
mod configuration;
mod metrics;

use std::{fs, path::PathBuf};

use anyhow::Context;
use clap::{Args, Command, ValueEnum};

use crate::launch::output::say;

/// Flags of `completions`.
#[derive(Args)]
pub struct CompletionsArgs {
    /// Shell that the script is for.
    shell: clap_complete::Shell,
}

/// Flags of `man`.
#[derive(Args)]
pub struct ManArgs {
    /// Folder for the pages, such as /usr/local/share/man/man1; created if missing.
    folder: PathBuf,
}

/// Flags of `reference`.
#[derive(Args)]
pub struct ReferenceArgs {
    /// Page to print.
    page: Page,
}

#[derive(Clone, Copy, ValueEnum)]
enum Page {
    Commands,
    Configuration,
    Metrics,
}

/// Prints the script.
pub fn completions(args: &CompletionsArgs, mut program: Command) {
    let mut script = Vec::new();
    let name = program.get_name().to_string();
    clap_complete::generate(args.shell, &mut program, name, &mut script);
    say(String::from_utf8_lossy(&script).trim_end());
}

/// Writes the pages.
pub fn man(args: &ManArgs, program: Command) -> anyhow::Result<()> {
    let folder = &args.folder;
    fs::create_dir_all(folder)
        .and_then(|()| clap_mangen::generate_to(program, folder))
        .with_context(|| format!("cannot write manual pages to `{}`", folder.display()))
}

/// Prints a page of `docs/reference/`.
pub fn reference(args: &ReferenceArgs, program: Command) {
    let page = match args.page {
        Page::Commands => commands::page(program),
        Page::Configuration => configuration::page(),
        Page::Metrics => metrics::page(),
    };
    say(page.trim_end());
}

/// Returns the head of a generated page.
fn heading(title: &str, made_from: &str) -> String {
    format!(
        "# {title}\n\n<!-- Generated from {made_from}; do not edit. Regenerate with\n     \
         TREADMILL_WRITE_REFERENCE=1 cargo test --release --test documentation reference -->\n"
    )
}
