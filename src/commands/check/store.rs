//! Diagnosis of the store of a run's state.

use treadmill_learner::leadership::read_manifest;
use treadmill_runtime::{error_chain, numbers::thousands, seeds};
use treadmill_store::{Store, promises};

use crate::{diagnosis::finding::Finding, launch::slow_step::SlowStepNotice, shared::saved_run};

const NAME: &str = "store";
/// Remedy for a store that fails.
const FAILS: &str = "check its address, the network and the credentials in the environment";

/// Writes trial objects into a store, and reads the newest state of its run.
pub fn diagnose(url: &str) -> Vec<Finding> {
    let _step = SlowStepNotice::begin("trying the store");
    let store = match Store::open(url) {
        Ok(store) => store,
        Err(why) => return vec![Finding::problem(NAME, error_chain(&why), FAILS)],
    };
    vec![trial(&store), run(&store)]
}

fn trial(store: &Store) -> Finding {
    match promises::check(store, seeds::unique()) {
        Ok(()) => Finding::ok(NAME, format!("{store} refuses writes whose condition does not hold")),
        Err(why @ promises::PromiseError::Broken { .. }) => {
            Finding::problem(NAME, why.to_string(), "use a server with conditional writes (If-Match, If-None-Match)")
        }
        Err(promises::PromiseError::Store(why)) => Finding::problem(NAME, error_chain(&why), FAILS),
    }
}

fn run(store: &Store) -> Finding {
    match read_manifest(store) {
        Ok(None) => return Finding::ok(NAME, format!("{store} holds no run")),
        Err(why) => return Finding::problem(NAME, error_chain(&why), FAILS),
        Ok(Some(_)) => {}
    }
    match saved_run::of_store(&store.to_string()) {
        Ok((state, manifest)) => {
            let (run, steps) = (&manifest.run, thousands(state.counters.env_steps));
            Finding::ok(NAME, format!("{store} holds run `{run}` after {steps} env steps, in epoch {}", manifest.epoch))
        }
        Err(why) => Finding::problem(NAME, format!("{store}: {}", error_chain(&*why)), FAILS),
    }
}
