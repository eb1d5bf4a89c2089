//! Waits until a run begins.

use std::{thread::sleep, time::Duration};

use treadmill_bus::Role;
use treadmill_runtime::{error_chain, run_folder::RunFolder};

use crate::{diagnosis::Silence, launch::output::say_error, shared::learner_address::ReachArgs};

const RETRY: Duration = Duration::from_secs(1);

/// Returns the flags of a learner that can be asked, as soon as there is one: the one that `reach` names, or the first one below
/// `runs/`. Says once for each reason why it waits.
///
/// # Errors
/// If the flags are refused.
pub fn until_there(reach: &ReachArgs) -> anyhow::Result<ReachArgs> {
    let mut said = String::new();
    loop {
        let folder = reach.live_runs().into_iter().next();
        let found = ReachArgs { folder: folder.or(reach.folder.clone()), ..reach.clone() };
        let Some(why) = hindrance(&found)? else { return Ok(found) };
        if why != said {
            say_error(&format!("waiting: {why}"));
            said = why;
        }
        sleep(RETRY);
    }
}

/// Returns why no learner can be asked now.
fn hindrance(reach: &ReachArgs) -> anyhow::Result<Option<String>> {
    if let Some(given) = &reach.folder {
        if let Err(why) = RunFolder::open(given) {
            return Ok(Some(error_chain(&why)));
        }
        if reach.idle_folder().is_some() {
            return Ok(Some(format!("no process trains `{given}` now")));
        }
    }
    if reach.named_endpoints().is_err() {
        return Ok(Some("the run has no endpoint yet".to_string()));
    }
    let options = reach.options(Role::Observer)?;
    Ok(Silence::of_route(&options, reach.run.as_deref()).map(|silence| silence.to_string()))
}
