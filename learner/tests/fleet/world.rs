//! Simulated fleet without a bus: actors, delayed or lost messages, and a clock that jumps from event to event.
//!
//! The learner's intake is the real one. Actors follow the protocol of the actor process: they have credit, send each
//! fragment until it is answered, keep accepted ones until they are durable, and send those again to a new learner.

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
use treadmill_experience::delivery::{self, Action, Attempt, Delivery};
use treadmill_proto::{Fragment, Outcome, PolicyVersion, Receipt};
use treadmill_runtime::{
    seeds::{self, Stream},
    shutdown::Shutdown,
};

pub use source::{MemoryFragment, MemoryFragmentSource};

const RECEIPT_TIMEOUT: Duration = Duration::from_secs(60);

/// Properties of the fleet.
#[derive(Clone, Debug)]
pub struct FleetSettings {
    pub seed: u64,
    /// Milliseconds that each actor needs for a control step of its environments.
    pub step_ms: Vec<f64>,
    /// Environments of each actor.
    pub envs: u32,
    /// Control steps of an actor's first fragment; receipts say those of the others.
    pub steps: u32,
    /// Configured control steps of a fragment; 0 means automatic.
    pub pinned_steps: u32,
    /// Fragments that an actor may have on the bus at once.
    pub in_flight: u32,
    /// Share of lost messages.
    pub loss_percent: u32,
    /// Longest delay of a message in milliseconds.
    pub delay_ms: u64,
    /// Plants a fault in the delivery of each actor: it forgets fragments once they are accepted.
    pub forgets_accepted: bool,
}

/// Event of the fleet. An attempt to deliver a fragment is on its way once its pause is over, and fails if no receipt comes.
enum Event {
    Simulated { actor: usize, incarnation: u64, steps: u32 },
    Request { actor: usize, incarnation: u64, sequence: u64, payload: Bytes },
    Answer { actor: usize, incarnation: u64, sequence: u64, receipt: Receipt },
    Attempt { actor: usize, incarnation: u64, attempt: Attempt },
    Timeout { actor: usize, incarnation: u64, sequence: u64, number: u64 },
    Announcement { actor: usize, version: PolicyVersion },
}

/// One actor process.
pub struct Actor {
    pub name: String,
    pub incarnation: u64,
    pub newest: u64,
    pub delivery: Delivery,
    /// Number of the last attempt for each pending fragment.
    attempts: BTreeMap<u64, u64>,
    pub dropped: BTreeSet<u64>,
    version: PolicyVersion,
    credit: u32,
    is_simulating: bool,
    /// Control steps of the next fragment.
    steps: u32,
    /// Environment steps simulated so far.
    pub env_steps: u64,
    /// Version that acts the fragment being simulated.
    acting: PolicyVersion,
}

impl Actor {
    fn new(name: String, incarnation: u64, settings: &FleetSettings, version: PolicyVersion) -> Self {
        Self {
            name,
            incarnation,
            newest: 0,
            delivery: match settings.forgets_accepted {
                false => Delivery::new(version.incarnation),
                true => Delivery::new(version.incarnation).with_fault(),
            },
            attempts: BTreeMap::new(),
            dropped: BTreeSet::new(),
            version,
            credit: settings.in_flight,
            is_simulating: false,
            steps: settings.steps,
            env_steps: 0,
            acting: version,
        }
    }
}

/// Fleet and network, without the learner.
pub struct FleetWorld {
    settings: FleetSettings,
    begun: Instant,
    pub now: Duration,
    events: BinaryHeap<Reverse<(Duration, u64)>>,
    scheduled: BTreeMap<u64, Event>,
    counter: u64,
    random: Stream,
    pub actors: Vec<Actor>,
    queue: VecDeque<MemoryFragment>,
    /// Fragments that a learner dropped by rule, even if the receipt was lost: (actor, incarnation, sequence).
    pub dropped: BTreeSet<(String, u64, u64)>,
    /// Whether a learner is running.
    pub is_learner_up: bool,
    /// If the learner still waits at this time, it is asked to stop.
    pub deadline: Duration,
    pub timed_out: Shutdown,
}

pub type Shared = Rc<RefCell<FleetWorld>>;

impl FleetWorld {
    pub fn new(settings: &FleetSettings, version: PolicyVersion) -> Shared {
        let mut world = Self {
            settings: settings.clone(),
            begun: Instant::now(),
            now: Duration::ZERO,
            events: BinaryHeap::new(),
            scheduled: BTreeMap::new(),
            counter: 0,
            random: seeds::stream(settings.seed, "world", &[]),
            actors: Vec::new(),
            queue: VecDeque::new(),
            dropped: BTreeSet::new(),
            is_learner_up: true,
            deadline: Duration::MAX,
            timed_out: Shutdown::default(),
        };
        for index in 0..settings.step_ms.len() {
            world.actors.push(Actor::new(format!("actor-{index}"), 0, settings, version));
            world.restart(index, version);
        }
        Rc::new(RefCell::new(world))
    }

    /// Replaces an actor's process; the old one's fragments are lost.
    pub fn restart(&mut self, actor: usize, version: PolicyVersion) {
        self.counter += 1;
        let name = self.actors[actor].name.clone();
        self.actors[actor] = Actor::new(name, self.counter, &self.settings, version);
        self.simulate(actor);
    }

    /// Kills the learner; its queue is lost.
    pub fn kill_learner(&mut self) {
        self.is_learner_up = false;
        self.queue.clear();
    }

    /// Advances the clock.
    pub fn pass(world: &Shared, time: Duration) {
        let until = world.borrow().now + time;
        while Self::step(world, until) {}
        world.borrow_mut().now = until;
    }

    /// Announces a new version to every actor; messages may be lost.
    pub fn announce(&mut self, version: PolicyVersion) {
        for actor in 0..self.actors.len() {
            self.send(Event::Announcement { actor, version });
        }
    }

    fn after(&mut self, time: Duration, event: Event) {
        self.counter += 1;
        self.scheduled.insert(self.counter, event);
        self.events.push(Reverse((self.now + time, self.counter)));
    }

    /// Sends over the network, which delays or loses the message.
    fn send(&mut self, event: Event) {
        let delay_ms = self.random.random_range(0..=self.settings.delay_ms);
        if self.random.random_range(0..100) >= self.settings.loss_percent {
            self.after(Duration::from_millis(delay_ms), event);
        }
    }

    /// Runs the next event up to `until`. Returns whether there was one.
    fn step(world: &Shared, until: Duration) -> bool {
        let event = {
            let mut world = world.borrow_mut();
            match world.events.peek() {
                Some(Reverse((at, number))) if *at <= until => {
                    let (at, number) = (*at, *number);
                    world.events.pop();
                    world.now = world.now.max(at);
                    world.scheduled.remove(&number)
                }
                _ => return false,
            }
        };
        if let Some(event) = event {
            Self::handle(world, event);
        }
        true
    }

    fn handle(shared: &Shared, event: Event) {
        let mut world = shared.borrow_mut();
        match event {
            Event::Simulated { actor, incarnation, steps } if world.actors[actor].incarnation == incarnation => {
                world.produce(actor, steps);
            }
            Event::Request { actor, incarnation, sequence, payload } if world.is_learner_up => {
                let name = world.actors[actor].name.clone();
                let fragment = MemoryFragment { world: shared.clone(), actor, name, incarnation, sequence, payload };
                world.queue.push_back(fragment);
            }
            Event::Attempt { actor, incarnation, attempt } if world.actors[actor].incarnation == incarnation => {
                world.submit(actor, attempt);
            }
            Event::Timeout { actor, incarnation, sequence, number } => {
                let process = &world.actors[actor];
                if process.incarnation == incarnation && process.attempts.get(&sequence) == Some(&number) {
                    world.deliver(actor, delivery::Event::Silent { sequence });
                }
            }
            Event::Answer { actor, incarnation, sequence, receipt }
                if world.actors[actor].incarnation == incarnation =>
            {
                world.apply_receipt(actor, sequence, &receipt);
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
        let (incarnation, steps) = (process.incarnation, process.steps);
        self.after(self.simulation(actor, steps), Event::Simulated { actor, incarnation, steps });
    }

    /// Returns the time in which an actor simulates `steps` control steps.
    fn simulation(&self, actor: usize, steps: u32) -> Duration {
        Duration::from_secs_f64(self.settings.step_ms[actor] * f64::from(steps) / 1e3)
    }

    fn produce(&mut self, actor: usize, steps: u32) {
        let (envs, collect_s) = (self.settings.envs, self.simulation(actor, steps).as_secs_f64());
        let process = &mut self.actors[actor];
        process.is_simulating = false;
        process.newest += 1;
        process.env_steps += u64::from(steps * envs);
        let settled_through = process.delivery.settled_through();
        let fragment = Fragment { collect_s, ..fragment(process, steps, envs, settled_through) };
        let bytes = fragment.encode().expect("a sound fragment").into();
        let first = process.delivery.produce(process.newest, bytes);
        self.submit(actor, first);
        self.simulate(actor);
    }

    /// Hands an event to an actor's delivery, and does what it asks for.
    fn deliver(&mut self, actor: usize, event: delivery::Event) {
        let incarnation = self.actors[actor].incarnation;
        for action in self.actors[actor].delivery.handle(event) {
            match action {
                Action::Send(attempt) => self.after(attempt.pause, Event::Attempt { actor, incarnation, attempt }),
                Action::Settled { sequence } => drop(self.actors[actor].attempts.remove(&sequence)),
                Action::Warn { .. } | Action::Lost { .. } | Action::Found => {}
            }
        }
    }

    fn submit(&mut self, actor: usize, Attempt { sequence, bytes, .. }: Attempt) {
        self.counter += 1;
        let (process, number) = (&mut self.actors[actor], self.counter);
        let incarnation = process.incarnation;
        process.attempts.insert(sequence, number);
        self.after(RECEIPT_TIMEOUT, Event::Timeout { actor, incarnation, sequence, number });
        self.send(Event::Request { actor, incarnation, sequence, payload: bytes });
    }

    fn apply_receipt(&mut self, actor: usize, sequence: u64, receipt: &Receipt) {
        let process = &mut self.actors[actor];
        let is_open = |process: &Actor| process.delivery.pending().any(|pending| pending == sequence);
        if !is_open(process) {
            return;
        }
        match receipt.outcome {
            Outcome::TooOld | Outcome::Vanished => drop(process.dropped.insert(sequence)),
            Outcome::Malformed | Outcome::Quarantined => panic!("refused: {}", receipt.reason),
            _ => {}
        }
        self.deliver(actor, delivery::Event::Answered { sequence, receipt: receipt.clone() });
        let process = &mut self.actors[actor];
        if is_open(process) {
            return;
        }
        process.steps = receipt.fragment_steps;
        self.refresh(actor, receipt.version);
        // Fragments that are sent again to a new learner have returned their credit before.
        let process = &mut self.actors[actor];
        process.credit = (process.credit + 1).min(self.settings.in_flight);
        self.simulate(actor);
    }

    fn refresh(&mut self, actor: usize, version: PolicyVersion) {
        self.actors[actor].version = version;
        self.deliver(actor, delivery::Event::Adopted { incarnation: version.incarnation });
    }
}

fn fragment(process: &Actor, steps: u32, envs: u32, settled_through: u64) -> Fragment {
    let rows = (steps * envs) as usize;
    Fragment {
        run: "walk".into(),
        actor: process.name.clone(),
        actor_incarnation: process.incarnation,
        sequence: process.newest,
        version: process.acting,
        config_hash: 5,
        steps,
        envs,
        observation_size: 1,
        action_size: 1,
        observations: vec![0.0; rows],
        actions: vec![0.0; rows],
        log_probs: vec![0.0; rows],
        rewards: vec![1.0; rows],
        flags: vec![0; rows],
        last_observations: vec![0.0; envs as usize],
        settled_through,
        env_steps: process.env_steps,
        ..Fragment::default()
    }
}
