//! The newest policy: announced by the learner, fetched by us, on joining too.

use std::{
    sync::{Arc, RwLock},
    time::Duration,
};

use tokio::sync::Mutex;
use treadmill_bus::{Bus, BusError, fetch_policy};
use treadmill_proto::{PolicyBundle, PolicyVersion};
use treadmill_runtime::shutdown::Shutdown;

use crate::{ActorError, acting::ActingPolicy};

const FETCH_TIMEOUT: Duration = Duration::from_secs(10);
const RETRY: Duration = Duration::from_millis(200);
/// Retries between two messages that say that nobody answers.
const RETRIES_PER_MESSAGE: u32 = 50;

/// Waits until a learner hands out its policy; `None` once somebody asked to stop.
pub async fn join(
    bus: &Bus,
    run: Option<&str>,
    where_to: &str,
    shutdown: &Shutdown,
) -> Result<Option<PolicyBundle>, BusError> {
    let mut tries = 0u32;
    loop {
        let bundle = tokio::select! {
            bundle = fetch_policy(bus, run, FETCH_TIMEOUT) => bundle?,
            () = shutdown.wait() => return Ok(None),
        };
        if bundle.is_some() {
            return Ok(bundle);
        }
        // Not at once: a learner that is just starting is no news.
        if tries % RETRIES_PER_MESSAGE == 5 {
            let whose = run.map_or("any run".to_string(), |run| format!("run `{run}`"));
            tracing::warn!("no learner of {whose} answers at {where_to}; trying on until one does");
        }
        tries += 1;
        tokio::select! {
            () = tokio::time::sleep(RETRY) => {}
            () = shutdown.wait() => return Ok(None),
        }
    }
}

/// Holds the policy in use and replaces it.
pub struct Policies {
    bus: Bus,
    run: String,
    /// What the user named; an actor that was told none follows the learner to another run.
    asked: Option<String>,
    config_hash: u64,
    current: RwLock<Arc<ActingPolicy>>,
    fetching: Mutex<()>,
}

/// What looking for a newer policy found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refreshed {
    /// Nobody answered, or there is none newer.
    Same,
    /// A newer policy is in use.
    Newer,
    /// It is another run, or the same begun anew with another configuration or model: everything begins again.
    OtherRun,
}

impl Policies {
    /// Begins with the policy that was handed out on joining.
    pub fn new(bus: Bus, asked: Option<String>, bundle: &PolicyBundle) -> Result<Self, ActorError> {
        Ok(Self {
            bus,
            run: bundle.run.clone(),
            asked,
            config_hash: bundle.config_hash,
            current: RwLock::new(Arc::new(ActingPolicy::new(bundle)?)),
            fetching: Mutex::new(()),
        })
    }

    /// The policy in use.
    pub fn current(&self) -> Arc<ActingPolicy> {
        self.current.read().expect("no holder of this lock panics").clone()
    }

    /// Fetches the newest policy unless `known`, which somebody spoke of, is in use already.
    pub async fn refresh(&self, known: Option<PolicyVersion>) -> Refreshed {
        // An announcement and a receipt speak of the same version at nearly the same time: one of them fetches.
        let _one_at_a_time = self.fetching.lock().await;
        let version = self.current().version;
        if known == Some(version) {
            return Refreshed::Same;
        }
        let bundle = match fetch_policy(&self.bus, self.asked.as_deref(), FETCH_TIMEOUT).await {
            Ok(Some(bundle)) => bundle,
            Ok(None) => return Refreshed::Same,
            Err(why) => {
                tracing::warn!("{why}");
                return Refreshed::Same;
            }
        };
        if bundle.run != self.run || bundle.config_hash != self.config_hash {
            return Refreshed::OtherRun;
        }
        if bundle.version == version {
            return Refreshed::Same;
        }
        match ActingPolicy::new(&bundle) {
            Ok(policy) => {
                *self.current.write().expect("no holder of this lock panics") = Arc::new(policy);
                Refreshed::Newer
            }
            Err(why) => {
                tracing::warn!("{why}; the one before it stays in use");
                Refreshed::Same
            }
        }
    }
}
