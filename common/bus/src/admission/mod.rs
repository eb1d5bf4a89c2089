//! Admission of fragments: decides before a fragment is read, so that a flood costs little and disturbs no other sender.
//!
//! Zenoh does not name the sender of a message, and all actors may share one certificate. Known are the actor's name in the
//! key and the incarnation that the fragment claims. A process is *proven* once one of its fragments was accepted. A proven
//! process is a sender of its own, with its own share of the queue. All other fragments under a name count as one sender. So
//! malformed fragments under a good actor's name quarantine only their own sender. All unproven senders together share one
//! part of the queue and one rate, however many names they use.

pub(crate) mod closed_peers;
pub mod rate_limited_log;
pub mod tls_rejections;

use std::{
    collections::{BTreeMap, HashMap},
    sync::{Arc, Mutex, MutexGuard},
    time::{Duration, Instant},
};

/// Duration of a quarantine.
pub const QUARANTINE: Duration = Duration::from_secs(60);
/// Senders whose history is kept; the one that was silent longest is forgotten first.
const SENDERS_MAX: usize = 4096;
/// Fragments of one proven sender that may wait. An actor has at most two in flight, each resent once if its receipt is
/// lost.
const WAITING_PER_SENDER_MAX: usize = 8;
/// Unproven senders may fill this fraction of the queue: one in this many places.
const NEWCOMERS_SHARE: usize = 4;
/// Bytes of unproven senders that may wait: two fragments of the largest size, or one of 3 MB from each thread that reads
/// links. Hundreds of actors that start at once then need not resend their first fragments.
const NEWCOMERS_BYTES_MAX: usize = 64 << 20;
/// Fragments of unproven senders that are considered per second.
const NEWCOMERS_PER_S: f64 = 200.0;
/// Fragments of unproven senders that are considered at once after a silence.
const NEWCOMERS_BURST: f64 = 512.0;
/// Part of that budget that a *busy* receipt costs: little, so that each of hundreds of actors that start at once gets one
/// and retries soon.
const BUSY_COST: f64 = 0.1;
/// Duplicate or vanished fragments in a row that lead to quarantine. After a restart of the learner, an honest actor resends
/// all fragments that it has kept.
const USELESS_MAX: u32 = 1024;

/// Sender of fragments: a proven process, or all unproven processes under one name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Sender {
    name: String,
    incarnation: Option<u64>,
}

impl Sender {
    /// Returns the actor's name in the key.
    pub fn name(&self) -> &str {
        &self.name
    }
}

/// Reason why a fragment is not admitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// Its sender is in quarantine.
    Quarantined,
    /// The sender's part of the queue is full.
    Busy,
    /// Too many fragments of unproven senders; they get no receipt.
    Flood,
}

/// Decides which fragments are admitted; shared by the bus's callback and the learner.
#[derive(Debug)]
pub struct Admission {
    quarantine_after: u32,
    newcomers_max: usize,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// Proven processes, with the time of their last accepted fragment.
    proven: BTreeMap<(String, u64), Instant>,
    failures: BTreeMap<Sender, Failures>,
    waiting: HashMap<Sender, usize>,
    newcomers: usize,
    newcomers_bytes: usize,
    newcomers_budget: Budget,
    unread: Unread,
}

#[derive(Clone, Copy, Debug)]
struct Failures {
    in_a_row: u32,
    useless_in_a_row: u32,
    /// Accepted fragments in a row that the learner did not learn from.
    implausible_in_a_row: u32,
    last: Instant,
}

/// Counts of fragments that were refused before they were read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unread {
    /// Empty, too large, or under an invalid name.
    pub malformed: u64,
    /// From senders in quarantine.
    pub quarantined: u64,
    /// For lack of space; their senders retry.
    pub turned_away: u64,
}

/// Place in the queue; dropping it frees the place.
#[derive(Debug)]
pub struct AdmissionPermit {
    admission: Arc<Admission>,
    sender: Sender,
    bytes: usize,
}

impl Admission {
    /// Quarantines a sender after `quarantine_after` malformed fragments in a row; the queue holds `capacity` fragments.
    pub fn new(quarantine_after: u32, capacity: usize) -> Self {
        Self { quarantine_after, newcomers_max: (capacity / NEWCOMERS_SHARE).max(1), state: Mutex::default() }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().expect("no holder of this lock panics")
    }

    /// Returns the sender of a fragment that arrived under `name` and claims the incarnation `claimed`.
    pub fn identify(&self, name: &str, claimed: Option<u64>) -> Sender {
        self.state().identify(name, claimed)
    }

    /// Admits a fragment of `bytes` bytes, or returns why not.
    pub fn admit(
        self: &Arc<Self>,
        name: &str,
        claimed: Option<u64>,
        bytes: usize,
        now: Instant,
    ) -> Result<AdmissionPermit, Refusal> {
        let mut state = self.state();
        let sender = state.identify(name, claimed);
        if state.is_quarantined(&sender, self.quarantine_after, now) {
            state.unread.quarantined += 1;
            return Err(Refusal::Quarantined);
        }
        let is_newcomer = sender.incarnation.is_none();
        let has_space = if is_newcomer {
            let has_space =
                state.newcomers < self.newcomers_max && state.newcomers_bytes + bytes <= NEWCOMERS_BYTES_MAX;
            let cost = if has_space { 1.0 } else { BUSY_COST };
            if !state.newcomers_budget.spend(cost, NEWCOMERS_PER_S, NEWCOMERS_BURST, now) {
                state.unread.turned_away += 1;
                return Err(Refusal::Flood);
            }
            has_space
        } else {
            state.waiting.get(&sender).is_none_or(|waiting| *waiting < WAITING_PER_SENDER_MAX)
        };
        if !has_space {
            state.unread.turned_away += 1;
            return Err(Refusal::Busy);
        }
        if is_newcomer {
            state.newcomers += 1;
            state.newcomers_bytes += bytes;
        } else {
            *state.waiting.entry(sender.clone()).or_insert(0) += 1;
        }
        drop(state);
        Ok(AdmissionPermit { admission: self.clone(), sender, bytes })
    }

    /// Returns whether this sender is in quarantine.
    pub fn is_quarantined(&self, sender: &Sender, now: Instant) -> bool {
        self.state().is_quarantined(sender, self.quarantine_after, now)
    }

    /// Records a malformed fragment. Returns whether that put its sender in quarantine.
    pub fn record_malformed(&self, sender: &Sender, now: Instant) -> bool {
        let mut state = self.state();
        let failures = state.failures_of(sender, self.quarantine_after, now);
        failures.in_a_row = failures.in_a_row.saturating_add(1);
        failures.last = now;
        failures.in_a_row == self.quarantine_after
    }

    /// Records a fragment that was malformed at first sight. Returns whether that put its sender in quarantine.
    pub fn record_malformed_unread(&self, sender: &Sender, now: Instant) -> bool {
        self.state().unread.malformed += 1;
        self.record_malformed(sender, now)
    }

    /// Records a duplicate or vanished fragment. Returns whether that put its sender in quarantine.
    pub fn record_useless(&self, sender: &Sender, now: Instant) -> bool {
        let mut state = self.state();
        let failures = state.failures_of(sender, self.quarantine_after, now);
        failures.useless_in_a_row += 1;
        failures.last = now;
        if failures.useless_in_a_row < USELESS_MAX {
            return false;
        }
        (failures.in_a_row, failures.useless_in_a_row) = (self.quarantine_after, 0);
        true
    }

    /// Records an accepted fragment that the learner did not learn from, as many as malformed ones in a row lead to
    /// quarantine. Returns whether this one did.
    pub fn record_implausible(&self, sender: &Sender, now: Instant) -> bool {
        let mut state = self.state();
        let failures = state.failures_of(sender, self.quarantine_after, now);
        failures.implausible_in_a_row += 1;
        failures.last = now;
        if failures.implausible_in_a_row < self.quarantine_after {
            return false;
        }
        (failures.in_a_row, failures.implausible_in_a_row) = (self.quarantine_after, 0);
        true
    }

    /// Records a fragment that the learner learnt from; it ends a row of implausible ones.
    pub fn record_learnt(&self, sender: &Sender) {
        if let Some(failures) = self.state().failures.get_mut(sender) {
            failures.implausible_in_a_row = 0;
        }
    }

    /// Records an accepted fragment: its process is proven from now on. Whether it is plausible is not known yet.
    pub fn record_accepted(&self, name: &str, incarnation: u64, now: Instant) {
        let mut state = self.state();
        let before = state.identify(name, Some(incarnation));
        if let Some(failures) = state.failures.remove(&before).filter(|failures| failures.implausible_in_a_row > 0) {
            let sender = Sender { name: name.to_string(), incarnation: Some(incarnation) };
            state.failures.insert(sender, Failures { in_a_row: 0, useless_in_a_row: 0, ..failures });
        }
        state.proven.insert((name.to_string(), incarnation), now);
        if state.proven.len() > SENDERS_MAX {
            let oldest = state.proven.iter().min_by_key(|(_, last)| **last).map(|(process, _)| process.clone());
            oldest.map(|process| state.proven.remove(&process));
        }
    }

    /// Returns the names of the senders in quarantine.
    pub fn quarantined(&self, now: Instant) -> Vec<String> {
        let state = self.state();
        let quarantined =
            state.failures.iter().filter(|(_, failures)| failures.is_quarantined(self.quarantine_after, now));
        let mut names: Vec<String> = quarantined.map(|(sender, _)| sender.name.clone()).collect();
        names.dedup();
        names
    }

    /// Returns the counts of fragments refused unread since the last call.
    pub fn take_unread(&self) -> Unread {
        std::mem::take(&mut self.state().unread)
    }
}

impl Failures {
    fn is_quarantined(&self, after: u32, now: Instant) -> bool {
        self.in_a_row >= after && now.duration_since(self.last) < QUARANTINE
    }
}

impl State {
    fn identify(&self, name: &str, claimed: Option<u64>) -> Sender {
        let process = claimed.map(|incarnation| (name.to_string(), incarnation));
        let incarnation =
            process.filter(|process| self.proven.contains_key(process)).map(|(_, incarnation)| incarnation);
        Sender { name: name.to_string(), incarnation }
    }

    fn is_quarantined(&mut self, sender: &Sender, after: u32, now: Instant) -> bool {
        match self.failures.get(sender) {
            Some(failures) if failures.is_quarantined(after, now) => true,
            Some(failures) if failures.in_a_row >= after => {
                self.failures.remove(sender);
                false
            }
            _ => false,
        }
    }

    /// Returns the failures of a sender. If the table is full, it forgets the sender that failed longest ago, and a
    /// quarantined one only if all are quarantined.
    fn failures_of(&mut self, sender: &Sender, after: u32, now: Instant) -> &mut Failures {
        if self.failures.len() >= SENDERS_MAX && !self.failures.contains_key(sender) {
            let oldest =
                self.failures.iter().min_by_key(|(_, failures)| (failures.is_quarantined(after, now), failures.last));
            let oldest = oldest.map(|(sender, _)| sender.clone());
            oldest.map(|sender| self.failures.remove(&sender));
        }
        let fresh = Failures { in_a_row: 0, useless_in_a_row: 0, implausible_in_a_row: 0, last: now };
        self.failures.entry(sender.clone()).or_insert(fresh)
    }
}

/// Budget that refills over time: what is left, and the time it was computed. It starts full.
#[derive(Debug, Default)]
struct Budget(Option<(f64, Instant)>);

impl Budget {
    /// Spends `cost` of a budget that earns `per_s` per second up to `most`. Returns whether there was enough.
    fn spend(&mut self, cost: f64, per_s: f64, most: f64, now: Instant) -> bool {
        let (left, computed) = self.0.unwrap_or((most, now));
        let left = (left + now.saturating_duration_since(computed).as_secs_f64() * per_s).min(most);
        let enough = left >= cost;
        self.0 = Some((if enough { left - cost } else { left }, now));
        enough
    }
}

impl AdmissionPermit {
    /// Returns the sender of the fragment.
    pub fn sender(&self) -> &Sender {
        &self.sender
    }
}

impl Drop for AdmissionPermit {
    fn drop(&mut self) {
        let mut state = self.admission.state();
        if self.sender.incarnation.is_none() {
            state.newcomers -= 1;
            state.newcomers_bytes -= self.bytes;
        } else if let Some(waiting) = state.waiting.get_mut(&self.sender) {
            *waiting -= 1;
            if *waiting == 0 {
                state.waiting.remove(&self.sender);
            }
        }
    }
}

#[cfg(test)]
mod tests;
