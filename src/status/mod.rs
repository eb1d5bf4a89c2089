//! `treadmill status`: how runs go, and who takes part.
//!
//! # Layout
//! - [`plain`], [`json`]: the answer as text and as JSON.
//! - [`dashboard`]: the same on a terminal, again and again; [`screen`] is that terminal, [`keys`] what is typed there.
//! - [`follow`]: asks the learners and listens to metrics, beside the dashboard.
//! - [`past`]: what a run has logged before.
//! - [`fleet`], [`history`]: what is known, within bounds.
//! - [`draw`]: how it looks.

mod dashboard;
mod draw;
mod fleet;
mod follow;
mod history;
mod json;
mod keys;
mod past;
mod plain;
#[cfg(test)]
mod samples;
mod screen;

use std::time::Duration;

use clap::Args;
use treadmill_bus::{Bus, Role, statuses};
use treadmill_proto::RunStatus;

use crate::{
    operator::{self, ReachArgs},
    output::say,
};

/// How often `--watch` looks.
const WATCH_EVERY: Duration = Duration::from_secs(2);

/// Flags of `status`.
#[derive(Args)]
pub struct StatusArgs {
    #[command(flatten)]
    reach: ReachArgs,
    /// Look again every two seconds: a dashboard on a terminal (`q` quits, `?` explains), plain text elsewhere.
    #[arg(long)]
    watch: bool,
    /// Print one JSON object per line.
    #[arg(long)]
    json: bool,
}

/// Tells how it goes, once or again and again.
pub fn run(args: StatusArgs) -> anyhow::Result<()> {
    let StatusArgs { reach, watch, json } = args;
    if watch && !json && screen::is_there() {
        return dashboard::run(&reach);
    }
    operator::on_the_bus(&reach, Role::Observer, async |bus, run| {
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

/// How every run goes that answers; an error where none does.
async fn ask(bus: &Bus, run: Option<&str>) -> anyhow::Result<Vec<RunStatus>> {
    let replies = operator::until_answered(async || statuses(bus, run, operator::ANSWER_TIMEOUT).await).await?;
    let mut told: Vec<RunStatus> = replies.into_iter().filter_map(|reply| reply.status).collect();
    if told.is_empty() {
        let whose = run.map_or("no run".to_string(), |run| format!("no run `{run}`"));
        anyhow::bail!("{whose} answers there; is its learner up, and does your certificate let you ask?");
    }
    told.sort_by(|a, b| a.run.cmp(&b.run));
    Ok(told)
}
