//! `treadmill control`: commands to a running learner.

use std::time::Duration;

use clap::{Args, Subcommand};
use treadmill_bus::{
    Role,
    observer::{command, statuses},
};
use treadmill_proto::{Command, ControlReply, ControlRequest};

use crate::{
    launch::{exit_code::Usage, output::say},
    shared::{
        foreign_text::printable,
        learner_address::{self, LearnerLink, ReachArgs},
    },
};

/// Timeout of a command, which waits for the end of the current update.
const DONE_TIMEOUT: Duration = Duration::from_secs(60);
/// Most characters of a learner's answer.
const TEXT_CHARS_MAX: usize = 2000;

/// Flags of `control`.
#[derive(Args)]
pub struct ControlArgs {
    #[command(subcommand)]
    command: ControlCommand,
}

#[derive(Subcommand)]
enum ControlCommand {
    /// Stop learning until `resume`; actors keep their fragments.
    Pause(ReachArgs),
    /// Continue after `pause`.
    Resume(ReachArgs),
    /// Keep the newest checkpoint under its number of updates.
    Checkpoint(ReachArgs),
    /// Finish the update, save, and exit.
    Stop(ReachArgs),
    /// Change one configuration key, as in: set ppo.target_kl 0.01
    Set {
        /// Name of the key.
        key: String,
        /// New value.
        #[arg(allow_hyphen_values = true)]
        value: String,
        #[command(flatten)]
        reach: ReachArgs,
    },
}

impl ControlCommand {
    fn split(self) -> (ControlRequest, ReachArgs) {
        let plain = ControlRequest::plain;
        match self {
            Self::Pause(reach) => (plain(Command::Pause), reach),
            Self::Resume(reach) => (plain(Command::Resume), reach),
            Self::Checkpoint(reach) => (plain(Command::Checkpoint), reach),
            Self::Stop(reach) => (plain(Command::Stop), reach),
            Self::Set { key, value, reach } => (ControlRequest::set(&key, &value), reach),
        }
    }
}

/// Sends the command and prints the learner's reply.
pub fn run(args: ControlArgs) -> anyhow::Result<()> {
    let (request, reach) = args.command.split();
    learner_address::connect(&reach, Role::Operator, async |link| {
        let run = match &link.run {
            Some(run) => run.clone(),
            None => only_run(link).await?,
        };
        let reply = learner_address::retry_until_answered(async || {
            Ok(command(&link.bus, &run, &request, DONE_TIMEOUT).await?.into_iter().collect())
        })
        .await?
        .pop();
        let Some(ControlReply { done, text, .. }) = reply else { return Err(link.silence().await) };
        // Another machine wrote it.
        let text = printable(&text, TEXT_CHARS_MAX);
        match (done, request.command()) {
            (true, _) => say(&text),
            // The key or its value is refused.
            (false, Command::Set) => return Err(Usage(text).into()),
            (false, _) => anyhow::bail!(text),
        }
        Ok(())
    })
}

/// Returns the run whose folder was given, or the only one that answers: a command is for one run.
async fn only_run(link: &LearnerLink) -> anyhow::Result<String> {
    let ask = async || statuses(&link.bus, None, learner_address::ANSWER_TIMEOUT).await;
    let replies = learner_address::retry_until_answered(ask).await?;
    let statuses = replies.into_iter().filter_map(|reply| reply.status);
    let (wanted, others): (Vec<_>, Vec<_>) =
        statuses.partition(|status| learner_address::is_of(link.holder.as_ref(), status));
    let mut runs: Vec<String> = wanted.into_iter().map(|status| status.run).collect();
    runs.sort();
    // A learner that was overtaken may answer, too.
    runs.dedup();
    match (&runs[..], &link.holder) {
        ([run], _) => Ok(run.clone()),
        ([], Some(holder)) if !others.is_empty() => {
            Err(anyhow::anyhow!("the run is trained by {holder}, but only other learners answer at its endpoint"))
        }
        ([], _) => Err(link.silence().await),
        _ => Err(Usage(format!("several runs answer there; choose one with --run: {}", runs.join(", "))).into()),
    }
}
