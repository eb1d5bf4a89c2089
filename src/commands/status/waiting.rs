//! Waits until a run begins, or its learner answers again.

use std::{thread::sleep, time::Duration};

use treadmill_runtime::{error_chain, run_folder::RunFolder};

use crate::{diagnosis::Silence, launch::output::say_error, shared::learner_address::ReachArgs};

const RETRY: Duration = Duration::from_secs(1);

/// Says once for each reason why a command waits.
#[derive(Default)]
pub struct Waiting {
    said: String,
}

impl Waiting {
    /// Returns the flags of a run that may be asked, as soon as there is one: the one that `reach` names, or the first
    /// one below `runs/`.
    pub fn for_run(&mut self, reach: &ReachArgs) -> ReachArgs {
        loop {
            let folder = reach.live_folders().into_iter().next();
            let found = ReachArgs { folder: folder.or(reach.folder.clone()), ..reach.clone() };
            let Some(why) = hindrance(&found) else { return found };
            self.wait(why);
        }
    }

    /// Waits a moment after an attempt that no learner answered.
    ///
    /// # Errors
    /// The attempt's, if it has another reason.
    pub fn after(&mut self, attempt: anyhow::Result<()>) -> anyhow::Result<()> {
        match attempt {
            Err(why) if why.is::<Silence>() => self.wait(why.to_string()),
            done => done?,
        }
        Ok(())
    }

    fn wait(&mut self, why: String) {
        if why != self.said {
            say_error(&format!("waiting: {why}"));
            self.said = why;
        }
        sleep(RETRY);
    }
}

/// Returns why the run whose folder was given cannot be asked now.
fn hindrance(reach: &ReachArgs) -> Option<String> {
    let given = reach.folder.as_ref()?;
    if let Err(why) = RunFolder::open(given) {
        return Some(error_chain(&why));
    }
    if reach.idle_folder().is_some() {
        return Some(format!("no process trains `{given}` now"));
    }
    reach.named_endpoints().is_err().then(|| "the run has no endpoint yet".to_string())
}
