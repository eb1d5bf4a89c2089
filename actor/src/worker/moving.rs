//! Move of an actor of a pool to another run: when its learner calls it to leave, or is gone.

use std::{
    future::pending,
    time::{Duration, Instant},
};

use tokio::{
    task::JoinSet,
    time::{Interval, MissedTickBehavior},
};
use treadmill_bus::{Bus, BusError, actor::PoolCalls};

use crate::pool::{Deliveries, Seeker};

/// Longest wait for the receipts of the last fragments of an actor that moves. Later ones come while it works elsewhere.
const LEAVE_TIMEOUT: Duration = Duration::from_secs(1);
/// Time for which the learner may be gone, as when its link is lost, before the actor looks for another run.
const GONE_GRACE: Duration = Duration::from_millis(200);
/// Longest wait for the first sign of the learner's life.
const FIRST_NEWS: Duration = Duration::from_secs(3);
/// Interval of looking for another run while the learner is gone.
const SEEK_EVERY: Duration = Duration::from_secs(1);
/// Longest time before the next answer to a call to leave.
const SEEK_PAUSE_MAX: Duration = Duration::from_secs(30);
/// Time after which an actor leaves a run without a learner also if no other one needs it.
const GIVE_UP: Duration = Duration::from_secs(10);

/// Move of an actor, which ends its membership in a run. An actor outside a pool never moves.
pub(super) struct Moving {
    run: String,
    pool: Option<(Seeker, PoolCalls)>,
    /// Whether the learner's token is there. Before the first news of the learner, it may have gone already.
    is_learner_there: Option<bool>,
    /// When the actor first looked for another run because the learner was gone.
    gone_since: Option<Instant>,
    /// Time before the next answer to a call to leave, if no other run admitted the actor: it grows.
    seek_pause: Duration,
    sought: Option<Instant>,
    seek_due: Interval,
    seeks: JoinSet<Result<Option<String>, BusError>>,
    /// Run that has admitted the actor, if one has, once it leaves.
    to: Option<Option<String>>,
    /// Time to which it waits for receipts, once nothing more is simulated.
    until: Option<Instant>,
}

impl Moving {
    /// Listens to calls to leave `run`.
    pub(super) fn new(bus: &Bus, run: &str, actor: &str, seeker: Option<&Seeker>) -> Result<Self, BusError> {
        let mut seek_due = tokio::time::interval(SEEK_EVERY);
        seek_due.set_missed_tick_behavior(MissedTickBehavior::Delay);
        seek_due.reset_after(FIRST_NEWS);
        let pool = seeker.map(|seeker| Ok((seeker.clone(), PoolCalls::open(bus, run, actor)?))).transpose()?;
        Ok(Self {
            run: run.to_string(),
            pool,
            is_learner_there: None,
            gone_since: None,
            seek_pause: Duration::ZERO,
            sought: None,
            seek_due,
            seeks: JoinSet::new(),
            to: None,
            until: None,
        })
    }

    /// Waits until the actor should leave, and returns true: another run has admitted it, or the learner is gone for long.
    /// Waits then until the time for receipts is up. Cancel-safe.
    pub(super) async fn next(&mut self) -> bool {
        if let Some(until) = self.until {
            tokio::time::sleep_until(until.into()).await;
            return false;
        }
        let Some((seeker, calls)) = self.pool.as_ref().filter(|_| self.to.is_none()) else { return pending().await };
        loop {
            let seeks = tokio::select! {
                () = calls.released(), if self.seeks.is_empty() => {
                    self.sought.is_none_or(|sought| sought.elapsed() >= self.seek_pause)
                }
                is_there = calls.learner() => {
                    self.is_learner_there = Some(is_there);
                    self.gone_since = None;
                    self.seek_due.reset_after(GONE_GRACE);
                    false
                }
                _ = self.seek_due.tick(), if self.is_learner_there != Some(true) && self.seeks.is_empty() => {
                    let gone_since = *self.gone_since.get_or_insert_with(Instant::now);
                    if gone_since.elapsed() > GIVE_UP {
                        // Without a run, it is called by any that needs it.
                        self.to = Some(None);
                        return true;
                    }
                    true
                }
                Some(found) = self.seeks.join_next() => {
                    // A search that failed is made again.
                    if let Ok(Ok(Some(run))) = found {
                        self.to = Some(Some(run));
                        return true;
                    }
                    self.seek_pause = (2 * self.seek_pause).clamp(SEEK_EVERY, SEEK_PAUSE_MAX);
                    false
                }
            };
            if seeks {
                self.sought = Some(Instant::now());
                let (seeker, run) = (seeker.clone(), self.run.clone());
                self.seeks.spawn(async move { seeker.seek(Some(&run)).await });
            }
        }
    }

    /// Notes a sign of the learner's life, for the case that the news of its token are lost.
    pub(super) fn hear(&mut self) {
        self.is_learner_there.get_or_insert(true);
    }

    /// Returns whether more fragments may come.
    pub(super) fn simulates(&self) -> bool {
        self.until.is_none()
    }

    /// Begins to wait for the last receipts; those of a learner that is gone come later, if at all.
    pub(super) fn wait_for_receipts(&mut self) {
        let patience = if self.is_learner_there == Some(false) { Duration::ZERO } else { LEAVE_TIMEOUT };
        self.until = Some(Instant::now() + patience);
    }

    /// Returns whether the actor may leave now.
    pub(super) fn has_left(&self, deliveries: &Deliveries) -> bool {
        self.until.is_some_and(|until| deliveries.is_empty() || Instant::now() >= until)
    }

    /// Returns the run to which it moves; `None` if it has no other one.
    pub(super) fn to(self) -> Option<String> {
        self.to.flatten()
    }
}
