//! A fleet without a bus: actors, messages that take their time or get lost, and a clock that jumps from event to event.
//!
//! The learner's intake is the real one. Actors follow the protocol of the actor process: credit, fragments sent until
//! they are dealt with, those taken kept until they are durable and sent again to a new learner.

mod source;

use std::{
    cell::RefCell,
    cmp::Reverse,
    collections::{BTreeMap, BTreeSet, BinaryHeap, VecDeque},
    rc::Rc,
    time::{Duration, Instant},
};

use bytes::Bytes;
use rand::RngExt;
use treadmill_proto::{Fragment, Outcome, PolicyVersion, Receipt};
use treadmill_runtime::{
    seeds::{self, Stream},
    shutdown::Shutdown,
};

pub use source::{MemoryFragmentSource, MemoryMessage};

const RECEIPT_TIMEOUT: Duration = Duration::from_secs(60);
const RETRY: Duration = Duration::from_millis(200);

/// What the fleet is like.
#[derive(Clone, Debug)]
pub struct Setting {
    pub seed: u64,
    /// Milliseconds that each actor takes for a fragment.
    pub fragment_ms: Vec<u64>,
    /// Fragments of an actor on the bus at once.
    pub in_flight: u32,
    /// Messages of a hundred that get lost.
    pub loss_percent: u32,
    /// Milliseconds that a message takes at most.
    pub delay_ms: u64,
}

enum Event {
    Simulated {
        actor: usize,
        incarnation: u64,
    },
    Request {
        actor: usize,
        incarnation: u64,
        sequence: u64,
        payload: Bytes,
    },
    Answer {
        actor: usize,
        incarnation: u64,
        sequence: u64,
        receipt: Receipt,
    },
    /// Neither a verdict nor an answer came: the fragment is sent again.
    Again {
        actor: usize,
        incarnation: u64,
        sequence: u64,
        attempt: u64,
    },
    Announcement {
        actor: usize,
        version: PolicyVersion,
    },
}

/// One actor process.
pub struct Actor {
    pub name: String,
    pub incarnation: u64,
    pub newest: u64,
    /// On their way: the fragment and the number of the last attempt.
    pub in_flight: BTreeMap<u64, (Bytes, u64)>,
    /// Taken, but perhaps not durable.
    pub kept: BTreeMap<u64, Bytes>,
    pub dropped: BTreeSet<u64>,
    version: PolicyVersion,
    learner: u64,
    credit: u32,
    is_simulating: bool,
    /// Version that the fragment being simulated is acted by.
    acting: PolicyVersion,
}

/// Everything but the learner.
pub struct FleetWorld {
    setting: Setting,
    begun: Instant,
    pub now: Duration,
    events: BinaryHeap<Reverse<(Duration, u64)>>,
    pending: BTreeMap<u64, Event>,
    counter: u64,
    random: Stream,
    pub actors: Vec<Actor>,
    queue: VecDeque<MemoryMessage>,
    /// What a learner dropped by rule, whether or not its receipt came through: (actor, incarnation, sequence).
    pub refused: BTreeSet<(String, u64, u64)>,
    /// Whether a learner listens.
    pub is_learner_up: bool,
    /// When nothing came until this moment, the learner is asked to stop.
    pub patient_until: Duration,
    pub out_of_patience: Shutdown,
}

pub type Shared = Rc<RefCell<FleetWorld>>;

impl FleetWorld {
    pub fn new(setting: &Setting, version: PolicyVersion) -> Shared {
        let mut world = Self {
            setting: setting.clone(),
            begun: Instant::now(),
            now: Duration::ZERO,
            events: BinaryHeap::new(),
            pending: BTreeMap::new(),
            counter: 0,
            random: seeds::stream(setting.seed, "world", &[]),
            actors: Vec::new(),
            queue: VecDeque::new(),
            refused: BTreeSet::new(),
            is_learner_up: true,
            patient_until: Duration::MAX,
            out_of_patience: Shutdown::default(),
        };
        for index in 0..setting.fragment_ms.len() {
            world.actors.push(Actor {
                name: format!("actor-{index}"),
                incarnation: 0,
                newest: 0,
                in_flight: BTreeMap::new(),
                kept: BTreeMap::new(),
                dropped: BTreeSet::new(),
                version,
                learner: version.incarnation,
                credit: 0,
                is_simulating: false,
                acting: version,
            });
            world.restart(index, version);
        }
        Rc::new(RefCell::new(world))
    }

    /// Another process takes an actor's place; what the old one had is gone.
    pub fn restart(&mut self, actor: usize, version: PolicyVersion) {
        self.counter += 1;
        let (incarnation, credit) = (self.counter, self.setting.in_flight);
        let process = &mut self.actors[actor];
        *process = Actor {
            name: process.name.clone(),
            incarnation,
            newest: 0,
            in_flight: BTreeMap::new(),
            kept: BTreeMap::new(),
            dropped: BTreeSet::new(),
            version,
            learner: version.incarnation,
            credit,
            is_simulating: false,
            acting: version,
        };
        self.simulate(actor);
    }

    /// The learner dies with all that waits for it.
    pub fn kill_learner(&mut self) {
        self.is_learner_up = false;
        self.queue.clear();
    }

    /// Lets time pass.
    pub fn pass(world: &Shared, time: Duration) {
        let until = world.borrow().now + time;
        while Self::step(world, until) {}
        world.borrow_mut().now = until;
    }

    /// Tells every actor of a new version, where the message comes through.
    pub fn announce(&mut self, version: PolicyVersion) {
        for actor in 0..self.actors.len() {
            self.send(Event::Announcement { actor, version });
        }
    }

    fn after(&mut self, time: Duration, event: Event) {
        self.counter += 1;
        self.pending.insert(self.counter, event);
        self.events.push(Reverse((self.now + time, self.counter)));
    }

    /// Over the network: late, or never.
    fn send(&mut self, event: Event) {
        let delay_ms = self.random.random_range(0..=self.setting.delay_ms);
        if self.random.random_range(0..100) >= self.setting.loss_percent {
            self.after(Duration::from_millis(delay_ms), event);
        }
    }

    /// The next event up to a moment; whether there was one.
    fn step(world: &Shared, until: Duration) -> bool {
        let event = {
            let mut world = world.borrow_mut();
            match world.events.peek() {
                Some(Reverse((at, number))) if *at <= until => {
                    let (at, number) = (*at, *number);
                    world.events.pop();
                    world.now = world.now.max(at);
                    world.pending.remove(&number)
                }
                _ => return false,
            }
        };
        if let Some(event) = event {
            Self::happen(world, event);
        }
        true
    }

    fn happen(shared: &Shared, event: Event) {
        let mut world = shared.borrow_mut();
        match event {
            Event::Simulated { actor, incarnation } if world.actors[actor].incarnation == incarnation => {
                world.deliver(actor);
            }
            Event::Request { actor, incarnation, sequence, payload } if world.is_learner_up => {
                let name = world.actors[actor].name.clone();
                let world_of_message = shared.clone();
                world.queue.push_back(MemoryMessage {
                    world: world_of_message,
                    actor,
                    name,
                    incarnation,
                    sequence,
                    payload,
                });
            }
            Event::Again { actor, incarnation, sequence, attempt } => {
                let process = &world.actors[actor];
                let is_open = process.in_flight.get(&sequence).is_some_and(|(_, last)| *last == attempt);
                if process.incarnation == incarnation && is_open {
                    world.submit(actor, sequence);
                }
            }
            Event::Answer { actor, incarnation, sequence, receipt }
                if world.actors[actor].incarnation == incarnation =>
            {
                world.heed(actor, sequence, &receipt);
            }
            Event::Announcement { actor, version } => world.refresh(actor, version),
            _ => {}
        }
    }

    fn simulate(&mut self, actor: usize) {
        let process = &mut self.actors[actor];
        if process.credit == 0 || process.is_simulating {
            return;
        }
        process.credit -= 1;
        process.is_simulating = true;
        process.acting = process.version;
        let incarnation = process.incarnation;
        self.after(Duration::from_millis(self.setting.fragment_ms[actor]), Event::Simulated { actor, incarnation });
    }

    fn deliver(&mut self, actor: usize) {
        let process = &mut self.actors[actor];
        process.is_simulating = false;
        process.newest += 1;
        let open = [process.in_flight.keys().next(), process.kept.keys().next()].into_iter().flatten().min();
        let settled_through = open.map_or(process.newest - 1, |first| first - 1);
        let fragment = fragment(process, settled_through);
        let sequence = process.newest;
        let payload = fragment.encode().expect("it is sound").into();
        process.in_flight.insert(sequence, (payload, 0));
        self.submit(actor, sequence);
        self.simulate(actor);
    }

    fn submit(&mut self, actor: usize, sequence: u64) {
        let process = &mut self.actors[actor];
        let incarnation = process.incarnation;
        let Some((payload, attempt)) = process.in_flight.get_mut(&sequence) else { return };
        *attempt += 1;
        let (payload, attempt) = (payload.clone(), *attempt);
        self.after(RECEIPT_TIMEOUT, Event::Again { actor, incarnation, sequence, attempt });
        self.send(Event::Request { actor, incarnation, sequence, payload });
    }

    fn heed(&mut self, actor: usize, sequence: u64, receipt: &Receipt) {
        let process = &mut self.actors[actor];
        let incarnation = process.incarnation;
        let Some((payload, attempt)) = process.in_flight.get(&sequence).cloned() else { return };
        match receipt.outcome {
            Outcome::Busy | Outcome::Stopping => {
                return self.after(RETRY, Event::Again { actor, incarnation, sequence, attempt });
            }
            Outcome::Accepted | Outcome::Duplicate => drop(process.kept.insert(sequence, payload)),
            Outcome::TooOld | Outcome::Vanished => drop(process.dropped.insert(sequence)),
            Outcome::Malformed | Outcome::Quarantined => panic!("refused: {}", receipt.reason),
        }
        process.in_flight.remove(&sequence);
        process.kept.retain(|kept, _| *kept > receipt.durable_through);
        self.refresh(actor, receipt.version);
        // Fragments that are sent again to a new learner had their credit back before.
        let process = &mut self.actors[actor];
        process.credit = (process.credit + 1).min(self.setting.in_flight);
        self.simulate(actor);
    }

    fn refresh(&mut self, actor: usize, version: PolicyVersion) {
        let process = &mut self.actors[actor];
        process.version = version;
        if process.learner != version.incarnation {
            process.learner = version.incarnation;
            let again: Vec<u64> = process.kept.keys().copied().collect();
            let kept = std::mem::take(&mut process.kept);
            process.in_flight.extend(kept.into_iter().map(|(sequence, payload)| (sequence, (payload, 0))));
            again.into_iter().for_each(|sequence| self.submit(actor, sequence));
        }
    }
}

fn fragment(process: &Actor, settled_through: u64) -> Fragment {
    Fragment {
        run: "walk".into(),
        actor: process.name.clone(),
        actor_incarnation: process.incarnation,
        sequence: process.newest,
        version: process.acting,
        config_hash: 5,
        steps: 1,
        envs: 1,
        observation_size: 1,
        action_size: 1,
        observations: vec![0.0],
        actions: vec![0.0],
        log_probs: vec![0.0],
        rewards: vec![1.0],
        flags: vec![0],
        last_observations: vec![0.0],
        episodes: vec![],
        settled_through,
        actor_state: None,
    }
}
