//! How runs are while they train, for the page: asked of their learners.

use std::{thread, time::Duration};

use anyhow::Context;
use treadmill_bus::{
    Bus, BusOptions, Role,
    observer::{newest_of_each_run, statuses},
};
use treadmill_proto::ControlReply;
use treadmill_runtime::{error_chain, shutdown::Shutdown};

use super::hub::Hub;
use crate::{
    launch::async_runtime,
    shared::learner_address::{self, ANSWER_TIMEOUT, ReachArgs, dial},
};

/// Interval of asking a learner, while a page is open.
const ASK_EVERY: Duration = Duration::from_secs(2);

/// Shows the status of `run`, or of all runs on the bus, while a page is open, until the stop or until answers say that it
/// no longer `goes_on`.
pub async fn follow(
    bus: Bus,
    run: Option<String>,
    hub: Hub,
    shutdown: Shutdown,
    goes_on: impl Fn(&[ControlReply]) -> bool,
) {
    while !shutdown.asked() {
        if hub.has_pages() {
            match statuses(&bus, run.as_deref(), ANSWER_TIMEOUT).await {
                Ok(replies) => {
                    if !goes_on(&replies) {
                        return;
                    }
                    newest_of_each_run(replies).into_iter().for_each(|status| hub.show_status(status));
                }
                Err(why) => tracing::debug!(error = %error_chain(&why), "no status for the page"),
            }
        }
        tokio::select! {
            () = tokio::time::sleep(ASK_EVERY) => {}
            () = shutdown.wait() => {}
        }
    }
}

/// Run in a folder of this machine, which may be trained now or later.
pub struct LocalRun {
    reach: ReachArgs,
    options: BusOptions,
}

impl LocalRun {
    /// Prepares to follow a run; `None` if it was never trained here, or not without certificates that `reach` lacks.
    /// Called before any thread starts, as [`ReachArgs::options`].
    #[must_use]
    pub fn new(reach: &ReachArgs, run: &str) -> Option<Self> {
        let reach = ReachArgs { folder: Some(run.to_string()), ..reach.clone() };
        let options = reach.options(Role::Observer).ok()?;
        Some(Self { reach, options })
    }

    /// Follows the run in a thread of its own until the stop.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn follow(self, hub: Hub, shutdown: Shutdown) -> anyhow::Result<()> {
        let follow = move || {
            while !shutdown.asked() {
                if hub.wait_for_page(ASK_EVERY)
                    && self.reach.holder().is_some()
                    && let Err(why) = async_runtime::run(self.while_it_trains(&hub, &shutdown))
                {
                    tracing::debug!(error = %error_chain(&*why), "no status for the page");
                }
                thread::sleep(ASK_EVERY);
            }
        };
        thread::Builder::new().name("fleet".to_string()).spawn(follow).context("no thread for the page")?;
        Ok(())
    }

    async fn while_it_trains(&self, hub: &Hub, shutdown: &Shutdown) -> anyhow::Result<()> {
        // A learner that goes on with the run may listen elsewhere.
        let options = BusOptions { connect: self.reach.endpoints()?, ..self.options.clone() };
        let bus = dial(&options, None).await?;
        let holder = self.reach.holder();
        let is_its = |reply: &ControlReply| {
            reply.status.as_ref().is_some_and(|status| learner_address::is_of(holder.as_ref(), status))
        };
        let is_trained = |replies: &[ControlReply]| replies.iter().any(is_its);
        follow(bus.clone(), None, hub.clone(), shutdown.clone(), is_trained).await;
        bus.close();
        Ok(())
    }
}
