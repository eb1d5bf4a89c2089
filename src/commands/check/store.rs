//! Diagnosis of the store of a run's state.

use treadmill_learner::leadership::read_manifest;
use treadmill_runtime::{error_chain, numbers::thousands, seeds, words::quoted};
use treadmill_store::{
    Store,
    promises::{self, PromiseError},
};

use crate::{diagnosis::finding::Finding, launch::slow_step::SlowStepNotice, shared::saved_run};

const NAME: &str = "store";
/// Remedy for a store that fails.
const FAILS: &str = "check its address, the network and the credentials in the environment";

/// Reads the newest state of the run in a store, and tries by trial objects whether the store suits a run.
pub fn diagnose(url: &str) -> Vec<Finding> {
    let _step = SlowStepNotice::begin("trying the store");
    let store = match Store::open(url) {
        Ok(store) => store,
        Err(why) => return vec![Finding::problem(NAME, error_chain(&why), FAILS)],
    };
    match read_manifest(&store) {
        Err(why) => vec![Finding::problem(NAME, error_chain(&why), FAILS)],
        Ok(None) => {
            let url = quoted(&store.to_string());
            let remedy = format!("correct its address, or begin a run there by `treadmill learner --store {url}`");
            let mut findings = vec![Finding::note(NAME, format!("{store} holds no run"), remedy)];
            // A trial would create a folder, whose address may be mistyped.
            findings.extend((!url.starts_with("file:")).then(|| trial(&store, false)));
            findings
        }
        Ok(Some(_)) => vec![run(&store), trial(&store, true)],
    }
}

/// Who may only read can watch a run, so that a refused write is no problem where there is one.
fn trial(store: &Store, holds_run: bool) -> Finding {
    match promises::check(store, seeds::unique()) {
        Ok(()) => Finding::ok(NAME, format!("{store} refuses writes whose condition does not hold")),
        Err(PromiseError::Store(why)) if holds_run => {
            let remedy = "a learner needs credentials that may write; to watch a run, reading is enough";
            Finding::note(NAME, format!("no trial of its writes: {}", error_chain(&why)), remedy)
        }
        Err(PromiseError::Store(why)) => Finding::problem(NAME, error_chain(&why), FAILS),
        Err(why @ PromiseError::Broken { .. }) => {
            let remedy = "use a server with conditional writes (If-Match, If-None-Match), without a cache before it";
            Finding::problem(NAME, why.to_string(), remedy)
        }
    }
}

fn run(store: &Store) -> Finding {
    match saved_run::of_store(&store.to_string()) {
        Ok((state, manifest)) => {
            let (run, steps) = (&manifest.run, thousands(state.counters.env_steps));
            Finding::ok(NAME, format!("{store} holds run `{run}` after {steps} env steps, in epoch {}", manifest.epoch))
        }
        Err(why) => Finding::problem(NAME, format!("{store}: {}", error_chain(&*why)), FAILS),
    }
}
