//! Joins a run and fetches its newest policy.

use std::{
    pin::Pin,
    sync::{Arc, RwLock},
    time::Duration,
};

use tokio::sync::{Mutex, watch};
use treadmill_bus::{
    Bus, BusError,
    actor::{FetchedPolicy, fetch_newer_policy, fetch_policy, is_behind_standby},
};
use treadmill_proto::{PolicyAnnouncement, PolicyBundle, PolicyRequest, PolicyVersion};
use treadmill_runtime::{epoch::SeenEpoch, error_chain, shutdown::Shutdown};

use crate::{ActorError, acting_policy::ActingPolicy};

const FETCH_TIMEOUT: Duration = Duration::from_secs(10);
const RETRY: Duration = Duration::from_millis(200);
/// Retries between two warnings that no learner answers.
const RETRIES_PER_WARNING: u32 = 50;

/// Finds out why the run does not answer on a bus that is open.
pub type Explain = Arc<dyn Fn(Bus) -> Pin<Box<dyn Future<Output = String> + Send>> + Send + Sync>;

/// Waits for a learner's policy; returns `None` after a request to stop.
pub async fn join_run(
    bus: &Bus,
    run: Option<&str>,
    explain: &Explain,
    epochs: &SeenEpoch,
    shutdown: &Shutdown,
) -> Result<Option<PolicyBundle>, BusError> {
    let mut retries = 0u32;
    loop {
        let bundle = tokio::select! {
            bundle = fetch_policy(bus, run, FETCH_TIMEOUT) => bundle?,
            () = shutdown.wait() => return Ok(None),
        };
        if let Some(bundle) = bundle.filter(|bundle| epochs.admits(&bundle.run, bundle.version.epoch)) {
            return Ok(Some(bundle));
        }
        // The first retries are silent: the learner may just be starting.
        if retries % RETRIES_PER_WARNING == 5 {
            let cause = tokio::select! {
                cause = explain(bus.clone()) => cause,
                () = shutdown.wait() => return Ok(None),
            };
            tracing::warn!(run = run.map(tracing::field::display), %cause, "no learner answers; retrying");
        }
        retries += 1;
        tokio::select! {
            () = tokio::time::sleep(RETRY) => {}
            () = shutdown.wait() => return Ok(None),
        }
    }
}

/// Holds the policy in use and replaces it with newer ones.
pub struct PolicyFetcher {
    bus: Bus,
    run: String,
    /// Run that the user named. Without one, the actor follows the learner to another run.
    requested_run: Option<String>,
    config_hash: u64,
    physics_version: u32,
    current: RwLock<Arc<ActingPolicy>>,
    /// Last announcement, whose checksum the weights of its version must have.
    announced: RwLock<Option<PolicyAnnouncement>>,
    epochs: Arc<SeenEpoch>,
    /// Highest epoch so far.
    newest_epoch: watch::Sender<u64>,
    fetching: Mutex<()>,
}

/// Result of looking for a newer policy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refresh {
    /// No learner answered, or no newer policy exists.
    Unchanged,
    /// A newer policy is in use.
    Replaced,
    /// The learner trains another run, or the same name with another configuration, model or physics. The actor must rejoin.
    OtherRun,
}

impl PolicyFetcher {
    /// Starts with the policy received on joining.
    pub fn new(
        bus: Bus,
        requested_run: Option<String>,
        bundle: &PolicyBundle,
        epochs: Arc<SeenEpoch>,
    ) -> Result<Self, ActorError> {
        Ok(Self {
            bus,
            run: bundle.run.clone(),
            requested_run,
            config_hash: bundle.config_hash,
            physics_version: bundle.physics_version,
            current: RwLock::new(Arc::new(ActingPolicy::new(bundle)?)),
            announced: RwLock::new(None),
            epochs,
            newest_epoch: watch::Sender::new(bundle.version.epoch),
            fetching: Mutex::new(()),
        })
    }

    /// Returns the policy in use.
    pub fn current(&self) -> Arc<ActingPolicy> {
        self.current.read().expect("no holder of this lock panics").clone()
    }

    /// Returns whether a version is of a learner that no other has overtaken, as far as this actor knows.
    pub fn admits(&self, version: PolicyVersion) -> bool {
        self.newest_epoch.send_if_modified(|newest| {
            let is_newer = version.epoch > *newest;
            *newest = version.epoch.max(*newest);
            is_newer
        });
        self.epochs.admits(&self.run, version.epoch)
    }

    /// Returns the highest epoch so far. It changes when another learner has taken over.
    pub fn newest_epoch(&self) -> watch::Receiver<u64> {
        self.newest_epoch.subscribe()
    }

    /// Records an announcement. [`Self::refresh`] then fetches its version.
    pub fn record_announcement(&self, announcement: PolicyAnnouncement) {
        *self.announced.write().expect("no holder of this lock panics") = Some(announcement);
    }

    /// Fetches the newest policy, unless the `known` newest version is already in use.
    pub async fn refresh(&self, known: Option<PolicyVersion>) -> Refresh {
        // An announcement and a receipt name the same version at nearly the same time; only one of them fetches it.
        let _one_at_a_time = self.fetching.lock().await;
        let version = self.current().version;
        if known.is_some_and(|known| known.names_same_policy(version)) {
            return Refresh::Unchanged;
        }
        let bundle = match self.fetch(known).await {
            Ok(Some(FetchedPolicy::Newer(bundle))) => bundle,
            Ok(Some(FetchedPolicy::Unchanged) | None) => return Refresh::Unchanged,
            Err(error) => {
                tracing::warn!(error = %error_chain(&error), "cannot fetch the policy");
                return Refresh::Unchanged;
            }
        };
        if !self.epochs.admits(&bundle.run, bundle.version.epoch) {
            tracing::warn!(epoch = bundle.version.epoch, "policy rejected: another learner has overtaken its learner");
            return Refresh::Unchanged;
        }
        let is_same_run = bundle.run == self.run && bundle.config_hash == self.config_hash;
        // A learner of another version may have resumed the run.
        if !is_same_run || bundle.physics_version != self.physics_version {
            return Refresh::OtherRun;
        }
        self.replace(version, &bundle)
    }

    /// Returns whether the process that this actor dialled is a learner that follows.
    ///
    /// # Errors
    /// If the bus fails.
    pub async fn is_behind_standby(&self) -> Result<bool, BusError> {
        is_behind_standby(&self.bus, &self.run, &self.request(None)).await
    }

    fn request(&self, announced: Option<PolicyVersion>) -> PolicyRequest {
        PolicyRequest { known: Some(self.current().version), announced, config_hash: self.config_hash, offset: 0 }
    }

    /// Asks for a policy newer than the one in use; without configuration and model, which this actor has.
    async fn fetch(&self, announced: Option<PolicyVersion>) -> Result<Option<FetchedPolicy>, BusError> {
        let fetched = fetch_newer_policy(&self.bus, &self.run, &self.request(announced), FETCH_TIMEOUT).await?;
        if fetched.is_some() || self.requested_run.is_some() {
            return Ok(fetched);
        }
        // The learner may train another run by now.
        let other = fetch_policy(&self.bus, None, FETCH_TIMEOUT).await?;
        Ok(other.map(|bundle| FetchedPolicy::Newer(Box::new(bundle))))
    }

    /// Replaces the policy of `version` with a newer one. Keeps it if the newer one is damaged.
    fn replace(&self, version: PolicyVersion, bundle: &PolicyBundle) -> Refresh {
        // A router's cache may be behind what this actor got elsewhere.
        if bundle.version.names_same_policy(version) || bundle.version.is_before(version) {
            return Refresh::Unchanged;
        }
        let announced = *self.announced.read().expect("no holder of this lock panics");
        if announced.is_some_and(|announced| !announced.agrees_with(bundle)) {
            tracing::warn!(version = bundle.version.number, "policy rejected: its weights are not the announced ones");
            return Refresh::Unchanged;
        }
        match ActingPolicy::new(bundle) {
            Ok(policy) => {
                *self.current.write().expect("no holder of this lock panics") = Arc::new(policy);
                Refresh::Replaced
            }
            Err(error) => {
                tracing::warn!(error = %error_chain(&error), "keeping the previous policy");
                Refresh::Unchanged
            }
        }
    }
}
