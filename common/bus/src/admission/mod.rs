//! Who may hand in fragments now: looked at before anything is read, so that a flood costs little and reaches nobody else.
//!
//! The bus does not tell who sent a message, and all actors may share one certificate. What is known is the name in the key
//! and the incarnation that the fragment claims. A process whose fragment was taken once has *proven* itself: from then on
//! it is judged by what it does itself, and has its own room in the queue. Everything else of a name is one sender, so that
//! somebody who sends nonsense under the name of a good actor shuts out himself and not that actor; and all senders that
//! have proven nothing share a part of the queue and a rate, however many names they invent.

pub mod acl_drops;
pub mod rate_limited_log;
pub(crate) mod read_throttle;
pub mod tls_rejections;

use std::{
    collections::{BTreeMap, HashMap},
    sync::{Arc, Mutex, MutexGuard},
    time::{Duration, Instant},
};

/// How long a sender is not listened to.
pub const QUARANTINE: Duration = Duration::from_secs(60);
/// Senders that are remembered for what they did, good or bad; the one that was silent longest gives way.
const SENDERS_MAX: usize = 4096;
/// Fragments of one proven sender that may wait. An actor has two in flight at most, each sent once more where a receipt
/// was lost.
const WAITING_EACH_MAX: usize = 8;
/// Senders that have proven nothing may fill this part of the queue.
const NEWCOMERS_SHARE: usize = 4;
/// Bytes of theirs that may wait: two fragments of the largest size, or one of 3 MB from each thread that reads links, so that
/// hundreds of actors that begin at once need not send their first ones again and again.
const NEWCOMERS_BYTES_MAX: usize = 64 << 20;
/// Fragments of theirs that are looked at: each second, and at once after a silence.
const NEWCOMERS_PER_S: f64 = 200.0;
const NEWCOMERS_BURST: f64 = 512.0;
/// What it takes of these to tell one of them that there is no room: little, so that hundreds that come at once and find none
/// hear of it, and come again soon.
const BUSY_COST: f64 = 0.1;
/// Useless fragments in a row (sent before, or of policies that never were) that are no failure yet: after a restart of
/// the learner an honest actor sends again whatever it has kept.
const USELESS_MAX: u32 = 1024;

/// Whom something is put down to: a proven process, or all else of a name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Sender {
    name: String,
    incarnation: Option<u64>,
}

impl Sender {
    /// The name in its key.
    pub fn name(&self) -> &str {
        &self.name
    }
}

/// Why a fragment is not let in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// Its sender is in quarantine.
    Quarantined,
    /// No room for this sender now.
    Busy,
    /// Too many newcomers at once; not even an answer is spent on them.
    Flood,
}

/// Decides who is let in; shared by the bus's callback and the learner.
#[derive(Debug)]
pub struct Admission {
    after: u32,
    newcomers_max: usize,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// Processes whose fragments were taken, and when the last one was.
    proven: BTreeMap<(String, u64), Instant>,
    failures: BTreeMap<Sender, Failures>,
    waiting: HashMap<Sender, usize>,
    newcomers: usize,
    newcomers_bytes: usize,
    budget: Option<(f64, Instant)>,
    unread: Unread,
}

#[derive(Clone, Copy, Debug)]
struct Failures {
    in_a_row: u32,
    useless_in_a_row: u32,
    since: Instant,
}

/// Fragments that were refused before they were read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Unread {
    /// Without content, too large, or under a name that is none.
    pub malformed: u64,
    /// Of senders in quarantine.
    pub quarantined: u64,
    /// For lack of room; their senders come again.
    pub turned_away: u64,
}

/// Room in the queue, given back when it is dropped.
#[derive(Debug)]
pub struct AdmissionPermit {
    admission: Arc<Admission>,
    sender: Sender,
    bytes: usize,
}

impl Admission {
    /// A sender is put in quarantine after so many refused fragments in a row; `capacity` fragments may wait in all.
    pub fn new(after: u32, capacity: usize) -> Self {
        Self { after, newcomers_max: (capacity / NEWCOMERS_SHARE).max(1), state: Mutex::default() }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().expect("no holder of this lock panics")
    }

    /// Whom a fragment is put down to that came under this name and claims this incarnation.
    pub fn identify(&self, name: &str, claimed: Option<u64>) -> Sender {
        self.state().identify(name, claimed)
    }

    /// Room for a fragment of so many bytes, if there is any.
    pub fn admit(
        self: &Arc<Self>,
        name: &str,
        claimed: Option<u64>,
        bytes: usize,
        now: Instant,
    ) -> Result<AdmissionPermit, Refusal> {
        let mut state = self.state();
        let sender = state.identify(name, claimed);
        if state.holds(&sender, self.after, now) {
            state.unread.quarantined += 1;
            return Err(Refusal::Quarantined);
        }
        let newcomer = sender.incarnation.is_none();
        let has_room = if newcomer {
            let has_room = state.newcomers < self.newcomers_max && state.newcomers_bytes + bytes <= NEWCOMERS_BYTES_MAX;
            if !state.spend(if has_room { 1.0 } else { BUSY_COST }, now) {
                state.unread.turned_away += 1;
                return Err(Refusal::Flood);
            }
            has_room
        } else {
            state.waiting.get(&sender).is_none_or(|waiting| *waiting < WAITING_EACH_MAX)
        };
        if !has_room {
            state.unread.turned_away += 1;
            return Err(Refusal::Busy);
        }
        if newcomer {
            state.newcomers += 1;
            state.newcomers_bytes += bytes;
        } else {
            *state.waiting.entry(sender.clone()).or_insert(0) += 1;
        }
        drop(state);
        Ok(AdmissionPermit { admission: self.clone(), sender, bytes })
    }

    /// Whether this sender is in quarantine.
    pub fn holds(&self, sender: &Sender, now: Instant) -> bool {
        self.state().holds(sender, self.after, now)
    }

    /// Notes a refused fragment; whether that put its sender in quarantine.
    pub fn failed(&self, sender: &Sender, now: Instant) -> bool {
        let mut state = self.state();
        let failures = state.failures_of(sender, self.after, now);
        failures.in_a_row = failures.in_a_row.saturating_add(1);
        failures.since = now;
        failures.in_a_row == self.after
    }

    /// Notes a fragment that was refused before it was read; whether that put its sender in quarantine.
    pub fn failed_unread(&self, sender: &Sender, now: Instant) -> bool {
        self.state().unread.malformed += 1;
        self.failed(sender, now)
    }

    /// Notes a sound fragment that nothing could be learnt from; whether that was one too many.
    pub fn useless(&self, sender: &Sender, now: Instant) -> bool {
        let mut state = self.state();
        let failures = state.failures_of(sender, self.after, now);
        failures.useless_in_a_row += 1;
        failures.since = now;
        if failures.useless_in_a_row < USELESS_MAX {
            return false;
        }
        (failures.in_a_row, failures.useless_in_a_row) = (self.after, 0);
        true
    }

    /// Notes a fragment that was taken: its process has proven itself.
    pub fn taken(&self, name: &str, incarnation: u64, now: Instant) {
        let mut state = self.state();
        let before = state.identify(name, Some(incarnation));
        state.failures.remove(&before);
        state.proven.insert((name.to_string(), incarnation), now);
        if state.proven.len() > SENDERS_MAX {
            let oldest = state.proven.iter().min_by_key(|(_, last)| **last).map(|(process, _)| process.clone());
            oldest.map(|process| state.proven.remove(&process));
        }
    }

    /// Names of those in quarantine.
    pub fn held(&self, now: Instant) -> Vec<String> {
        let state = self.state();
        let held = state.failures.iter().filter(|(_, failures)| failures.hold(self.after, now));
        let mut names: Vec<String> = held.map(|(sender, _)| sender.name.clone()).collect();
        names.dedup();
        names
    }

    /// What was refused unread since the last call.
    pub fn take_unread(&self) -> Unread {
        std::mem::take(&mut self.state().unread)
    }
}

impl Failures {
    fn hold(&self, after: u32, now: Instant) -> bool {
        self.in_a_row >= after && now.duration_since(self.since) < QUARANTINE
    }
}

impl State {
    fn identify(&self, name: &str, claimed: Option<u64>) -> Sender {
        let process = claimed.map(|incarnation| (name.to_string(), incarnation));
        let incarnation =
            process.filter(|process| self.proven.contains_key(process)).map(|(_, incarnation)| incarnation);
        Sender { name: name.to_string(), incarnation }
    }

    fn holds(&mut self, sender: &Sender, after: u32, now: Instant) -> bool {
        match self.failures.get(sender) {
            Some(failures) if failures.hold(after, now) => true,
            Some(failures) if failures.in_a_row >= after => {
                self.failures.remove(sender);
                false
            }
            _ => false,
        }
    }

    /// The failures of a sender, for which another one is forgotten if need be: the one that failed longest ago, and of
    /// those in quarantine only where there are no others.
    fn failures_of(&mut self, sender: &Sender, after: u32, now: Instant) -> &mut Failures {
        if self.failures.len() >= SENDERS_MAX && !self.failures.contains_key(sender) {
            let oldest = self.failures.iter().min_by_key(|(_, failures)| (failures.hold(after, now), failures.since));
            let oldest = oldest.map(|(sender, _)| sender.clone());
            oldest.map(|sender| self.failures.remove(&sender));
        }
        let fresh = Failures { in_a_row: 0, useless_in_a_row: 0, since: now };
        self.failures.entry(sender.clone()).or_insert(fresh)
    }

    /// Whether one more newcomer may be looked at, or told something, for so much of the budget.
    fn spend(&mut self, cost: f64, now: Instant) -> bool {
        let (left, since) = self.budget.unwrap_or((NEWCOMERS_BURST, now));
        let earned = now.saturating_duration_since(since).as_secs_f64() * NEWCOMERS_PER_S;
        let left = (left + earned).min(NEWCOMERS_BURST);
        let enough = left >= cost;
        self.budget = Some((if enough { left - cost } else { left }, now));
        enough
    }
}

impl AdmissionPermit {
    /// Whom the fragment is put down to.
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
