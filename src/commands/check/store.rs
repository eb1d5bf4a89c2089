//! Diagnosis of the store of a run's state.

use treadmill_runtime::{error_chain, numbers::thousands};

use crate::{diagnosis::finding::Finding, launch::slow_step::SlowStepNotice, shared::saved_run};

const NAME: &str = "store";

/// Reads the newest state of the run in a store.
pub fn diagnose(url: &str) -> Finding {
    let _step = SlowStepNotice::begin("reading the store");
    match saved_run::of_store(url) {
        Ok((state, manifest)) => {
            let (run, steps) = (&manifest.run, thousands(state.counters.env_steps));
            Finding::ok(NAME, format!("{url} holds run `{run}` after {steps} env steps, in epoch {}", manifest.epoch))
        }
        Err(why) => Finding::problem(
            NAME,
            format!("{url}: {}", error_chain(&*why)),
            "check its address, the network and the credentials in the environment",
        ),
    }
}
