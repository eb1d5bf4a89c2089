//! The learner's intake in a fleet with slow and dying actors and with delayed and lost messages. It never stalls,
//! accepts no fragment that is too old, and learns from every fragment at most once.

mod throughput;
mod world;

use std::{collections::BTreeSet, sync::Arc, time::Duration};

use proptest::prelude::*;
use rand::RngExt;
use treadmill_bus::learner::Admission;
use treadmill_config::{Config, LearnerMode};
use treadmill_experience::{ledger::Ledger, lineage::Lineage};
use treadmill_learner::intake::{
    BatchSize, Collected, ExpectedFragment, FleetPlan, FragmentCounts, FragmentValidator, HorizonRule, Intake,
};
use treadmill_runtime::seeds;
use world::{FleetSettings, FleetWorld, MemoryFragmentSource, Shared};

/// Longest time (of the fleet's clock) that an update may take, however many messages are lost.
const UPDATE_MAX: Duration = Duration::from_secs(3 * 3600);

#[derive(Clone, Debug)]
struct Case {
    fleet: FleetSettings,
    mode: LearnerMode,
    max_policy_lag: u64,
    size: BatchSize,
    /// Duration of an update, and per transition.
    update: (Duration, Duration),
    /// Share of rounds in which the learner dies before it saves.
    learner_deaths_percent: u32,
    actor_deaths_percent: u32,
}

/// Actor, incarnation and sequence number.
type FragmentId = (String, u64, u64);

/// Checkpoint of the fleet.
#[derive(Clone)]
struct Saved {
    lineage: Lineage,
    ledger: Ledger,
    counts: FragmentCounts,
    learnt: BTreeSet<FragmentId>,
}

struct Learner {
    case: Case,
    world: Shared,
    intake: Intake<MemoryFragmentSource>,
    lineage: Lineage,
    /// Fragments in the current weights.
    learnt: BTreeSet<FragmentId>,
    learnt_transitions: u64,
    saved: Saved,
    starts: u64,
}

impl Learner {
    fn new(case: &Case) -> Self {
        let lineage = Lineage::new(1000);
        let world = FleetWorld::new(&case.fleet, lineage.newest());
        let saved = Saved {
            lineage: lineage.clone(),
            ledger: Ledger::default(),
            counts: FragmentCounts::default(),
            learnt: BTreeSet::new(),
        };
        let intake = intake(case, &world, &saved);
        Self {
            case: case.clone(),
            world,
            intake,
            lineage,
            learnt: BTreeSet::new(),
            learnt_transitions: 0,
            saved,
            starts: 1,
        }
    }

    fn round(&mut self, dies: bool) -> Result<(), TestCaseError> {
        let shutdown = {
            let mut world = self.world.borrow_mut();
            world.deadline = world.now + UPDATE_MAX;
            world.timed_out.clone()
        };
        // Every other poll interrupts: the fragments collected until then must not be lost.
        let (size, mut polls) = (self.case.size, 0);
        let batch = loop {
            let interrupt = || {
                polls += 1;
                polls % 2 == 0
            };
            match self.intake.collect(size, &self.lineage, &shutdown, interrupt) {
                Collected::Batch(batch) => break Some(batch),
                Collected::Interrupted => {}
                Collected::Stopped => break None,
            }
        };
        let Some(batch) = batch else {
            return Err(TestCaseError::fail(format!(
                "no batch for {UPDATE_MAX:?}: {:?}",
                self.intake.validator.counts
            )));
        };
        let transitions: usize = batch.fragments.iter().map(|accepted| accepted.fragment.transitions()).sum();
        prop_assert!(transitions >= self.case.size.transitions);
        let last = batch.fragments.iter().map(|accepted| accepted.fragment.transitions()).max().unwrap_or(0);
        prop_assert!(transitions - last < self.case.size.transitions_max);
        self.learnt_transitions += transitions as u64;
        let allowed = if self.case.mode == LearnerMode::Sync { 0 } else { self.case.max_policy_lag };
        for accepted in &batch.fragments {
            prop_assert!(accepted.lag <= allowed);
            let fragment = &accepted.fragment;
            let id = (fragment.actor.clone(), fragment.actor_incarnation, fragment.sequence);
            prop_assert!(self.learnt.insert(id.clone()), "{id:?} is learnt from twice");
        }
        let (constant, each) = self.case.update;
        FleetWorld::pass(&self.world, constant + each * transitions as u32);
        if dies {
            self.die();
            return Ok(());
        }
        self.lineage.advance();
        let mut ledger = self.intake.validator.ledger.clone();
        ledger.mark_durable();
        let counts = self.intake.validator.counts;
        self.saved = Saved { lineage: self.lineage.clone(), ledger, counts, learnt: self.learnt.clone() };
        self.intake.validator.ledger.mark_durable();
        self.world.borrow_mut().announce(self.lineage.newest());
        if self.case.mode == LearnerMode::Sync {
            self.intake.begin_round(&self.lineage);
        }
        Ok(())
    }

    /// Kills the process; another one continues from the last checkpoint.
    fn die(&mut self) {
        self.starts += 1;
        self.world.borrow_mut().kill_learner();
        FleetWorld::pass(&self.world, Duration::from_secs(2));
        self.world.borrow_mut().is_learner_up = true;
        self.lineage = self.saved.lineage.clone();
        self.lineage.resume(1000 * self.starts);
        self.learnt = self.saved.learnt.clone();
        self.intake = intake(&self.case, &self.world, &self.saved);
        self.world.borrow_mut().announce(self.lineage.newest());
    }

    /// Checks that each fragment of a living process is in a checkpoint, dropped by rule, pending, or kept.
    fn check_fragments(&self) -> Result<(), TestCaseError> {
        let world = self.world.borrow();
        for actor in &world.actors {
            for sequence in 1..=actor.newest {
                let id = (actor.name.clone(), actor.incarnation, sequence);
                let outstanding = actor.delivery.pending().chain(actor.delivery.kept()).any(|open| open == sequence);
                let (learnt, dropped) = (self.saved.learnt.contains(&id), actor.dropped.contains(&sequence));
                prop_assert!(learnt || dropped || outstanding, "{id:?} is lost");
                prop_assert!(!dropped || world.dropped.contains(&id), "{id:?} was never dropped");
                prop_assert!(!(learnt && dropped), "{id:?} is learnt from and counted as dropped");
            }
        }
        Ok(())
    }
}

fn intake(case: &Case, world: &Shared, saved: &Saved) -> Intake<MemoryFragmentSource> {
    let expected = ExpectedFragment {
        run: "walk".into(),
        config_hash: 5,
        observation_size: 1,
        action_size: 1,
        max_policy_lag: if case.mode == LearnerMode::Sync { 0 } else { case.max_policy_lag },
        physics_version: 0,
    };
    let validator =
        FragmentValidator::new(expected, Arc::new(Admission::new(8, 256)), saved.ledger.clone(), saved.counts);
    let mut config = Config::default();
    config.rollout.fragment_steps = case.fleet.pinned_steps;
    config.ppo.batch = case.size.transitions as u32;
    let fleet = FleetPlan::new(HorizonRule::new(&config, 1, 1), case.fleet.step_ms.len() * case.fleet.envs as usize);
    Intake::new(MemoryFragmentSource(world.clone()), case.mode, validator, fleet)
}

fn cases() -> impl Strategy<Value = Case> {
    let fleet = (
        any::<u64>(),
        prop::collection::vec(prop_oneof![5 => 80_f64..150.0, 1 => 400_f64..3000.0], 1..5),
        1_u32..=2,
        prop_oneof![2 => Just(0_u32), 1 => 0_u32..30],
        0_u64..400,
    );
    let learner = (any::<bool>(), 0_u64..5, 1_usize..8, 0_usize..6);
    let deaths = (prop_oneof![1 => Just(0_u32), 1 => 0_u32..20], prop_oneof![1 => Just(0_u32), 1 => 0_u32..20]);
    (fleet, learner, deaths).prop_map(|(fleet, learner, deaths)| {
        let (seed, step_ms, in_flight, loss_percent, delay_ms) = fleet;
        let (is_sync, max_policy_lag, transitions, more) = learner;
        let transitions_max = if is_sync { usize::MAX } else { transitions + more };
        Case {
            fleet: FleetSettings {
                seed,
                pinned_steps: 1,
                in_flight,
                loss_percent,
                delay_ms,
                ..throughput::fleet(&step_ms, 1)
            },
            mode: if is_sync { LearnerMode::Sync } else { LearnerMode::Async },
            max_policy_lag,
            size: BatchSize { transitions, transitions_max },
            update: (Duration::from_millis(150), Duration::ZERO),
            learner_deaths_percent: deaths.0,
            actor_deaths_percent: deaths.1,
        }
    })
}

#[test]
fn the_simulation_finds_an_actor_that_forgets_what_may_not_be_durable() {
    // A learner that dies in every other round loses what it had accepted since its last checkpoint.
    let mut case = throughput::pinned(LearnerMode::Async, &[100.0; 3], 3);
    case.fleet.forgets_accepted = true;
    let mut learner = Learner::new(&case);
    let is_found = (0..30).any(|round| {
        learner.round(round % 2 == 1).expect("the fleet goes on");
        learner.check_fragments().is_err()
    });
    assert!(is_found, "a planted fault was not found");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_failure_stalls_the_fleet_or_loses_or_doubles_a_fragment(case in cases()) {
        let mut random = seeds::stream(case.fleet.seed, "deaths", &[]);
        let mut learner = Learner::new(&case);
        for _ in 0..30 {
            learner.round(random.random_range(0..100) < case.learner_deaths_percent)?;
            learner.check_fragments()?;
            if random.random_range(0..100) < case.actor_deaths_percent {
                let actor = random.random_range(0..case.fleet.step_ms.len());
                learner.world.borrow_mut().restart(actor, learner.lineage.newest());
            }
        }
    }
}
