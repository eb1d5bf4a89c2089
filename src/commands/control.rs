//! `treadmill control`: commands to a running learner.

use std::time::Duration;

use anyhow::Context;
use clap::{Args, Subcommand};
use treadmill_bus::{Bus, Role, command, statuses};
use treadmill_proto::{Command, ControlReply, ControlRequest};

use crate::{
    launch::{exit_code::Usage, output::say},
    shared::learner_address::{self, ReachArgs},
};

/// Timeout of a command, which waits for the end of the current update.
const DONE_TIMEOUT: Duration = Duration::from_secs(60);

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
    learner_address::connect(&reach, Role::Operator, async |bus, run| {
        let run = match run {
            Some(run) => run,
            None => only_run(&bus).await?,
        };
        let reply = learner_address::retry_until_answered(async || {
            Ok(command(&bus, &run, &request, DONE_TIMEOUT).await?.into_iter().collect())
        })
        .await?
        .pop();
        let ControlReply { done, text, .. } = reply.with_context(|| {
            format!(
                "no learner of run `{run}` takes commands there; is it running, and do you have the operator's certificate?"
            )
        })?;
        if !done {
            return Err(Usage(text).into());
        }
        say(&text);
        Ok(())
    })
}

/// Returns the only run that answers, because a command is for one run.
async fn only_run(bus: &Bus) -> anyhow::Result<String> {
    let replies =
        learner_address::retry_until_answered(async || statuses(bus, None, learner_address::ANSWER_TIMEOUT).await)
            .await?;
    let mut runs: Vec<String> = replies.into_iter().filter_map(|reply| Some(reply.status?.run)).collect();
    runs.sort();
    match &runs[..] {
        [] => anyhow::bail!("no run answers there; is its learner running?"),
        [run] => Ok(run.clone()),
        _ => Err(Usage(format!("several runs answer there; choose one with --run: {}", runs.join(", "))).into()),
    }
}
