//! `treadmill status`: progress and participants of runs.
//!
//! # Layout
//! - [`plain`], [`json`]: the answers as text and as JSON.
//! - [`local`]: runs of this machine: those that are trained now, and the results of one that is not.
//! - [`dashboard`]: draws the answers on a terminal, again and again; [`keys`] has its keys.
//! - [`follow`]: polls the learners and receives metrics for the dashboard.
//! - [`past`]: reads metrics that a run on this machine logged before.
//! - [`fleet`], [`history`]: the dashboard's state, of bounded size.
//! - [`draw`]: draws that state.

mod dashboard;
mod draw;
mod fleet;
mod follow;
mod history;
mod json;
mod keys;
mod local;
mod past;
mod plain;
#[cfg(test)]
mod samples;

use std::time::Duration;

use clap::Args;
use treadmill_bus::{Bus, Role, statuses};
use treadmill_proto::RunStatus;

use crate::{
    launch::{output::say, terminal_screen},
    shared::learner_address::{self, ReachArgs},
};

/// Interval at which `--watch` asks for statuses.
const WATCH_EVERY: Duration = Duration::from_secs(2);

/// Flags of `status`.
#[derive(Args)]
pub struct StatusArgs {
    #[command(flatten)]
    reach: ReachArgs,
    /// Repeat every two seconds: as a dashboard on a terminal (`q` quits, `?` shows the keys), as plain text elsewhere.
    #[arg(long)]
    watch: bool,
    /// Print one JSON object per line.
    #[arg(long)]
    json: bool,
}

/// Prints the statuses, once or repeatedly.
pub fn run(args: StatusArgs) -> anyhow::Result<()> {
    let StatusArgs { reach, watch, json } = args;
    if watch && !json && terminal_screen::is_there() {
        return dashboard::run(&reach);
    }
    if let Some(idle) = local::idle(&reach).filter(|_| !watch) {
        say(&idle?.describe(json));
        return Ok(());
    }
    let live = if watch { Vec::new() } else { local::live(&reach) };
    if live.is_empty() {
        return show(&reach, watch, json);
    }
    live.into_iter().try_for_each(|folder| show(&ReachArgs { folder: Some(folder), ..reach.clone() }, false, json))
}

/// Asks the learners that `reach` names, and prints their statuses.
fn show(reach: &ReachArgs, watch: bool, json: bool) -> anyhow::Result<()> {
    learner_address::connect(reach, Role::Observer, async |bus, run| {
        loop {
            let replies = ask(&bus, run.as_deref()).await?;
            let text = if json { json::as_json(&replies) } else { plain::as_text(&replies) };
            say(text.trim_end());
            if !watch {
                return Ok(());
            }
            tokio::time::sleep(WATCH_EVERY).await;
        }
    })
}

/// Returns the statuses of all runs that answer; fails if none does.
async fn ask(bus: &Bus, run: Option<&str>) -> anyhow::Result<Vec<RunStatus>> {
    let replies =
        learner_address::retry_until_answered(async || statuses(bus, run, learner_address::ANSWER_TIMEOUT).await)
            .await?;
    let mut runs: Vec<RunStatus> = replies.into_iter().filter_map(|reply| reply.status).collect();
    if runs.is_empty() {
        let whose = run.map_or("no run".to_string(), |run| format!("no run `{run}`"));
        anyhow::bail!("{whose} answers there; is its learner running, and does your certificate let you ask?");
    }
    runs.sort_by(|a, b| a.run.cmp(&b.run));
    Ok(runs)
}
