//! `treadmill status`: progress and participants of runs.
//!
//! # Layout
//! - [`plain`], [`json`]: the answers as text and as JSON.
//! - [`local`]: runs of this machine: those that are trained now, and the results of one that is not.
//! - [`dashboard`]: draws the answers on a terminal, again and again; [`keys`] has its keys.
//! - [`follow`]: polls the learners, and receives metrics or reads earlier ones, for the dashboard.
//! - [`fleet`], [`history`]: the dashboard's state, of bounded size.
//! - [`draw`]: draws that state.
//! - [`waiting`]: waits until a run begins.

mod dashboard;
mod draw;
mod fleet;
mod follow;
mod history;
mod json;
mod keys;
mod local;
mod plain;
#[cfg(test)]
mod samples;
mod waiting;

use std::time::Duration;

use clap::Args;
use treadmill_bus::{
    Role,
    observer::{newest_of_each_run, statuses},
};
use treadmill_proto::{ControlReply, RunStatus};

use self::{local::Idle, waiting::Waiting};
use crate::{
    launch::{
        exit_code::Usage,
        output::{say, say_error, say_to_reader},
        terminal_screen,
    },
    shared::learner_address::{self, LearnerLink, ReachArgs},
};

/// Interval at which `--watch` asks for statuses.
const WATCH_EVERY: Duration = Duration::from_secs(2);

/// Flags of `status`.
#[derive(Args)]
pub struct StatusArgs {
    #[command(flatten)]
    reach: ReachArgs,
    /// Wait for the run and follow it: as a dashboard on a terminal (`q` quits, `?` shows the keys), elsewhere every two
    /// seconds by a line for each run and alarm.
    #[arg(long)]
    watch: bool,
    /// Print one JSON object per line.
    #[arg(long)]
    json: bool,
}

/// Prints the statuses, once or repeatedly.
pub fn run(args: StatusArgs) -> anyhow::Result<()> {
    let StatusArgs { reach, watch, json } = args;
    if watch {
        return if json || !terminal_screen::is_there() { follow_lines(&reach, json) } else { show_dashboard(&reach) };
    }
    if let Some(idle) = local::idle(&reach, json) {
        return show_idle(idle?);
    }
    let live = reach.live_folders();
    if live.is_empty() {
        return show(&reach, json);
    }
    // One that does not answer must not hide the others.
    let shown: Vec<_> =
        live.into_iter().map(|folder| show(&ReachArgs { folder: Some(folder), ..reach.clone() }, json)).collect();
    shown.into_iter().collect()
}

/// Prints a run that no process trains; fails if its process was killed.
fn show_idle(idle: Idle) -> anyhow::Result<()> {
    say(&idle.text);
    if idle.was_killed {
        anyhow::bail!(
            "the process that trained this run was killed; it goes on from its last checkpoint by the line above"
        );
    }
    Ok(())
}

/// Asks the learners that `reach` names, and prints their statuses.
fn show(reach: &ReachArgs, json: bool) -> anyhow::Result<()> {
    learner_address::connect(reach, Role::Observer, async |link| {
        let runs = ask(link).await?;
        let text = if json { json::as_json(&runs) } else { plain::as_text(&runs) };
        say(text.trim_end());
        Ok(())
    })
}

/// Shows the dashboard, as soon as a learner answers.
fn show_dashboard(reach: &ReachArgs) -> anyhow::Result<()> {
    let live = reach.live_folders();
    if live.len() > 1 {
        return Err(Usage(format!("several runs are trained here; name one: {}", live.join(", "))).into());
    }
    let mut waiting = Waiting::default();
    loop {
        match dashboard::run(&waiting.for_run(reach)) {
            Ok(()) => return Ok(()),
            silent => waiting.after(silent)?,
        }
    }
}

/// Prints the statuses every two seconds, until the reader goes away or no process trains the run any more. Waits where no
/// learner answers.
fn follow_lines(reach: &ReachArgs, json: bool) -> anyhow::Result<()> {
    let mut waiting = Waiting::default();
    loop {
        let live = reach.live_folders();
        if live.len() > 1 {
            if !show_lines_of(live, reach, json) {
                return Ok(());
            }
            std::thread::sleep(WATCH_EVERY);
            continue;
        }
        let found = waiting.for_run(reach);
        let mut is_read = true;
        let followed = learner_address::connect(&found, Role::Observer, async |link| {
            while is_read {
                let runs = ask(link).await?;
                let text = if json { json::as_json(&runs) } else { plain::as_lines(&runs) };
                is_read = say_to_reader(text.trim_end());
                tokio::time::sleep(WATCH_EVERY).await;
            }
            Ok(())
        });
        if !is_read {
            return Ok(());
        }
        if let Some(idle) = local::idle(&found, json) {
            return show_idle(idle?);
        }
        waiting.after(followed)?;
    }
}

/// Prints the statuses of several runs of this machine. Returns whether the reader is still there.
fn show_lines_of(folders: Vec<String>, reach: &ReachArgs, json: bool) -> bool {
    let mut is_read = true;
    for folder in folders {
        let of_one = ReachArgs { folder: Some(folder.clone()), ..reach.clone() };
        let shown = learner_address::connect(&of_one, Role::Observer, async |link| {
            let runs = ask(link).await?;
            let text = if json { json::as_json(&runs) } else { plain::as_lines(&runs) };
            is_read = say_to_reader(text.trim_end());
            Ok(())
        });
        // One that ends now must not hide the others.
        if let Err(why) = shown {
            say_error(&format!("{folder}: {why:#}"));
        }
        if !is_read {
            break;
        }
    }
    is_read
}

/// Returns the statuses of all runs that answer; fails if none does.
async fn ask(link: &LearnerLink) -> anyhow::Result<Vec<RunStatus>> {
    let ask = async || statuses(&link.bus, link.run.as_deref(), learner_address::ANSWER_TIMEOUT).await;
    let replies = learner_address::retry_until_answered(ask).await?;
    let is_wanted = |reply: &ControlReply| {
        reply.status.as_ref().is_some_and(|status| learner_address::is_of(link.holder.as_ref(), status))
    };
    let runs = newest_of_each_run(replies.into_iter().filter(is_wanted));
    if runs.is_empty() {
        return Err(link.silence().await);
    }
    Ok(runs)
}
