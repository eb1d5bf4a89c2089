//! World of the simulation: processes, the links between them, and a clock that advances in ticks.

use std::{
    collections::VecDeque,
    time::{Duration, Instant},
};

use rand::RngExt;
use treadmill_learner::leadership::{
    Leadership,
    follower::{LeaderSight, Sight},
    read_manifest,
};
use treadmill_runtime::seeds::{self, Stream};
use treadmill_store::{
    Store,
    simulated::{Fault, SimulatedObjects},
};

use super::{
    actor::Actor,
    learner::{Lead, Learner, RunState},
};

const LEARNERS: usize = 3;
const ACTORS: usize = 3;
const TICK: Duration = Duration::from_millis(250);
/// Ticks with faults.
const TICKS: u32 = 160;
/// Ticks after which a token goes that its holder does not renew: the bus's lease of 4 s.
const LEASE_TICKS: u32 = 16;
/// Ticks without faults within which the fleet must go on.
const HEALED_TICKS: u32 = 240;
/// Longest delay of an announcement, in ticks.
const DELAY_MAX: u32 = 12;

/// Message to an actor on its way.
struct Announcement {
    at: u32,
    actor: usize,
    epoch: u64,
}

pub struct World {
    seed: u64,
    random: Stream,
    begun: Instant,
    tick: u32,
    objects: SimulatedObjects,
    learners: Vec<Learner>,
    actors: Vec<Actor>,
    /// Whether a learner reaches the store, the actors and each other learner. A link works in both directions or in none.
    store_links: [bool; LEARNERS],
    actor_links: [[bool; ACTORS]; LEARNERS],
    learner_links: [[bool; LEARNERS]; LEARNERS],
    /// Tick in which learner `b` last saw the token of learner `a`.
    seen: [[u32; LEARNERS]; LEARNERS],
    announcements: VecDeque<Announcement>,
    writers: u64,
    pub takeovers: u64,
    pub repeated_updates: u64,
    pub faults: u64,
}

impl World {
    pub fn new(seed: u64) -> Self {
        let objects = SimulatedObjects::default();
        let store = Store::simulated(&objects);
        let mut world = Self {
            seed,
            random: seeds::stream(seed, "takeover", &[]),
            begun: Instant::now(),
            tick: LEASE_TICKS,
            objects,
            learners: (0..LEARNERS).map(|_| Learner::new(&store)).collect(),
            actors: (0..ACTORS).map(|_| Actor::default()).collect(),
            store_links: [true; LEARNERS],
            actor_links: [[true; ACTORS]; LEARNERS],
            learner_links: [[true; LEARNERS]; LEARNERS],
            seen: [[0; LEARNERS]; LEARNERS],
            announcements: VecDeque::new(),
            writers: 0,
            takeovers: 0,
            repeated_updates: 0,
            faults: 0,
        };
        let state = RunState { updates: 0, learnt: vec![Vec::new(); ACTORS] };
        let leadership = Leadership::simulated(&store, None, world.next_writer());
        world.learners[0].lead = Some(Lead { leadership, state, durable: None, is_saving: true });
        // The run begins before the first fault.
        world.advance();
        world.takeovers = 0;
        world
    }

    pub fn run_with_faults(&mut self) {
        for _ in 0..TICKS {
            if self.random.random_range(0..100) < 12 {
                self.faults += 1;
                self.fail();
            }
            self.advance();
        }
    }

    /// Ends every fault, and checks that one learner goes on with all that was durable.
    pub fn heal_and_check(&mut self) {
        self.objects.set_down(false);
        self.objects.set_faults([]);
        (self.store_links, self.actor_links) = ([true; LEARNERS], [[true; ACTORS]; LEARNERS]);
        self.learner_links = [[true; LEARNERS]; LEARNERS];
        self.learners.iter_mut().for_each(|learner| learner.is_frozen = false);
        let before = self.durable_state().updates;
        for _ in 0..HEALED_TICKS {
            self.advance();
        }
        let (seed, state) = (self.seed, self.durable_state());
        assert!(state.updates > before + 10, "seed {seed}: stuck at update {before}, now {}", state.updates);
        assert_eq!(self.learners.iter().filter(|learner| learner.leads()).count(), 1, "seed {seed}: one learner leads");
        for (index, actor) in self.actors.iter().enumerate() {
            let mut learnt = state.learnt[index].clone();
            learnt.sort_unstable();
            assert!(learnt.windows(2).all(|pair| pair[0] != pair[1]), "seed {seed}: learnt from twice: {learnt:?}");
            let lost: Vec<_> = actor.durable.iter().filter(|one| learnt.binary_search(one).is_err()).collect();
            assert!(lost.is_empty(), "seed {seed}: {lost:?} of actor {index} were called durable");
            // Nothing is lost silently either: each fragment is learnt from, or the actor still has it.
            let newest = learnt.last().copied().unwrap_or(0);
            let is_known = |one: u64| learnt.binary_search(&one).is_ok() || actor.has(one);
            assert!((1..=newest).all(is_known), "seed {seed}: a fragment of actor {index} has vanished");
        }
    }

    fn next_writer(&mut self) -> u64 {
        self.writers += 1;
        self.writers
    }

    /// State that the manifest names.
    fn durable_state(&self) -> RunState {
        let store = Store::simulated(&self.objects.without_faults());
        let (manifest, _) = read_manifest(&store).expect("sound").expect("the first learner began the run");
        RunState::decode(&store.get(&manifest.state).expect("the state that the manifest names").0)
    }

    /// One random fault, or the end of one.
    fn fail(&mut self) {
        let learner = self.random.random_range(0..LEARNERS);
        match self.random.random_range(0..12) {
            0 | 1 => self.learners[learner] = Learner::new(&Store::simulated(&self.objects)),
            2 => self.learners[learner].is_frozen = true,
            3 => self.learners.iter_mut().for_each(|learner| learner.is_frozen = false),
            // Its whole host is cut off.
            4 => {
                self.actor_links[learner] = [false; ACTORS];
                self.cut_learner(learner, false);
                self.store_links[learner] = self.random.random_range(0..2) == 0;
            }
            5 => self.store_links[learner] = false,
            6 => self.actor_links[learner] = [false; ACTORS],
            7 => {
                let actor = self.random.random_range(0..ACTORS);
                self.actor_links[learner][actor] = false;
            }
            8 => self.objects.set_down(true),
            9 => {
                let faults: Vec<_> = (0..self.random.random_range(1..12))
                    .map(|_| match self.random.random_range(0..3) {
                        0 => None,
                        1 => Some(Fault::Lost),
                        _ => Some(Fault::AnswerLost),
                    })
                    .collect();
                self.objects.set_faults(faults);
            }
            10 => {
                self.objects.set_down(false);
                self.store_links = [true; LEARNERS];
            }
            _ => {
                self.actor_links[learner] = [true; ACTORS];
                self.cut_learner(learner, true);
            }
        }
    }

    fn cut_learner(&mut self, learner: usize, is_linked: bool) {
        self.learner_links[learner] = [is_linked; LEARNERS];
        self.learner_links.iter_mut().for_each(|links| links[learner] = is_linked);
    }

    fn advance(&mut self) {
        self.tick += 1;
        let now = self.begun + TICK * self.tick;
        self.renew_tokens();
        let first = self.random.random_range(0..LEARNERS);
        for index in 0..LEARNERS {
            let index = (first + index) % LEARNERS;
            if !self.learners[index].is_frozen {
                self.run_learner(index, now);
            }
        }
        let due: Vec<_> =
            self.announcements.iter().filter(|one| one.at <= self.tick).map(|one| (one.actor, one.epoch)).collect();
        self.announcements.retain(|one| one.at > self.tick);
        for (actor, epoch) in due {
            self.actors[actor].hear(epoch);
        }
        for actor in 0..ACTORS {
            self.actors[actor].simulate();
        }
    }

    /// Each learner sees the tokens of leaders to which it has a link.
    fn renew_tokens(&mut self) {
        for leader in 0..LEARNERS {
            if !self.learners[leader].leads() || self.learners[leader].is_frozen {
                continue;
            }
            for other in 0..LEARNERS {
                // Links between two actors' routers let a token pass too.
                let common = (0..ACTORS).any(|actor| self.actor_links[leader][actor] && self.actor_links[other][actor]);
                if self.learner_links[leader][other] || common {
                    self.seen[leader][other] = self.tick;
                }
            }
        }
    }

    fn run_learner(&mut self, index: usize, now: Instant) {
        let store = Store::simulated(&self.objects);
        if self.learners[index].lead.is_none() {
            if !self.store_links[index] {
                return;
            }
            let others = (0..LEARNERS).filter(|other| *other != index);
            let has_token = others.clone().any(|other| self.tick - self.seen[other][index] < LEASE_TICKS);
            let answering = others.into_iter().find(|other| self.seen[*other][index] == self.tick);
            let saves = |learner: usize| self.learners[learner].lead.as_ref().is_some_and(|lead| lead.is_saving);
            let leader = match answering {
                Some(leader) if saves(leader) => LeaderSight::Stalled,
                Some(_) => LeaderSight::Answers,
                None if has_token => LeaderSight::Silent,
                None => LeaderSight::Absent,
            };
            let sight = Sight { leader, actors: self.actor_links[index].contains(&true) };
            let writer = self.next_writer();
            self.learners[index].follow(&store, sight, writer, now);
        }
        if self.learners[index].lead.as_ref().is_some_and(|lead| lead.is_saving) {
            if self.store_links[index] {
                self.save(index, &store);
            }
            return;
        }
        self.collect(index);
    }

    /// Saves; a leader that succeeds announces its version at once.
    fn save(&mut self, index: usize, store: &Store) {
        let was_leading = self.learners[index].leads();
        if !self.learners[index].save(store) {
            return;
        }
        let Some(lead) = &self.learners[index].lead else { return };
        let epoch = lead.leadership.epoch();
        if !was_leading {
            self.takeovers += 1;
            // What its predecessor had learnt from since the last save is learnt again.
            let updates = lead.state.updates;
            let before = self.learners.iter().enumerate().filter(|(other, _)| *other != index);
            let predecessors =
                before.filter_map(|(_, other)| other.lead.as_ref().filter(|lead| lead.durable.is_some()));
            let ahead = predecessors.map(|lead| lead.state.updates.saturating_sub(updates)).max().unwrap_or(0);
            assert!(ahead <= 1, "seed {}: {ahead} updates are lost", self.seed);
            self.repeated_updates += ahead;
        }
        // The store itself says who leads when a version is announced.
        let leading = self.leader_in_store();
        assert_eq!(leading, epoch, "seed {}: an overtaken learner announces a version", self.seed);
        for actor in 0..ACTORS {
            if self.actor_links[index][actor] {
                let at = self.tick + self.random.random_range(0..DELAY_MAX);
                self.announcements.push_back(Announcement { at, actor, epoch });
            }
        }
    }

    /// Epoch in the manifest, read past any fault.
    fn leader_in_store(&self) -> u64 {
        let faultless = Store::simulated(&self.objects.without_faults());
        read_manifest(&faultless).expect("sound").expect("saved").0.epoch
    }

    /// Takes pending fragments of the actors in reach, answers them, and learns from them.
    fn collect(&mut self, index: usize) {
        let Some(lead) = &self.learners[index].lead else { return };
        let (epoch, state) = (lead.leadership.epoch(), lead.state.clone());
        let Some(durable) = lead.durable.clone() else { return };
        let mut batch = Vec::new();
        for actor in 0..ACTORS {
            if !self.actor_links[index][actor] {
                continue;
            }
            let pending: Vec<u64> = self.actors[actor].delivery.pending().collect();
            for sequence in pending {
                if !state.learnt[actor].contains(&sequence) {
                    batch.push((actor, sequence));
                }
                // Every fifth answer is lost.
                if self.random.random_range(0..5) > 0 {
                    self.actors[actor].take(sequence, epoch, durable.through(actor));
                }
            }
        }
        if !batch.is_empty() {
            self.learners[index].learn(&batch);
        }
    }
}
