//! Delivery of fragments: a table of events and actions, which the Python actor passes too, and properties of any events.

use proptest::prelude::*;
use serde_json::{Value, json};
use treadmill_experience::delivery::{Action, Delivery, Event};
use treadmill_proto::{Outcome, PolicyVersion, Receipt};

/// Scenarios: an event and the actions that follow in each step, and the counts at the end.
const TABLE: &str = include_str!("delivery_events.json");
const OUTCOMES: [(&str, Outcome); 8] = [
    ("accepted", Outcome::Accepted),
    ("duplicate", Outcome::Duplicate),
    ("too_old", Outcome::TooOld),
    ("vanished", Outcome::Vanished),
    ("malformed", Outcome::Malformed),
    ("quarantined", Outcome::Quarantined),
    ("busy", Outcome::Busy),
    ("stopping", Outcome::Stopping),
];

fn receipt(outcome: Outcome, epoch: u64, durable_through: u64) -> Receipt {
    let version = PolicyVersion { epoch, ..PolicyVersion::new(1, 1) };
    Receipt { outcome, reason: String::new(), version, durable_through, fragment_steps: 0 }
}

/// Takes the event of a step.
fn take(delivery: &mut Delivery, step: &Value) -> Vec<Action> {
    match (step["event"].as_str(), step["sequence"].as_u64()) {
        (Some("produced"), Some(sequence)) => {
            vec![Action::Send(delivery.produce(sequence, sequence.to_le_bytes().to_vec().into()))]
        }
        _ => delivery.handle(event(step)),
    }
}

fn event(step: &Value) -> Event {
    let number = |name: &str| step[name].as_u64().unwrap_or(0);
    let sequence = number("sequence");
    match step["event"].as_str().expect("a name") {
        "answered" => {
            let (_, outcome) = OUTCOMES.iter().find(|(name, _)| *name == step["outcome"]).expect("an outcome");
            Event::Answered { sequence, receipt: receipt(*outcome, number("epoch"), number("durable_through")) }
        }
        "silent" => Event::Silent { sequence },
        "heard" => Event::Heard { epoch: number("epoch") },
        "adopted" => Event::Adopted { incarnation: number("incarnation") },
        other => panic!("{other}"),
    }
}

fn described(action: Action) -> Value {
    match action {
        Action::Send(attempt) => {
            assert_eq!(attempt.bytes, attempt.sequence.to_le_bytes()[..], "its own bytes");
            json!({"send": attempt.sequence, "pause_ms": attempt.pause.as_millis() as u64})
        }
        Action::Settled { sequence } => json!({"settled": sequence}),
        Action::Warn { .. } => json!({"warn": true}),
        Action::Lost { pending } => json!({"lost": pending}),
        Action::Found => json!("found"),
    }
}

#[test]
fn every_step_of_the_table_gives_its_actions() {
    let table: Vec<Value> = serde_json::from_str(TABLE).expect("JSON");
    for scenario in &table {
        let mut delivery = Delivery::new(1);
        for step in scenario["steps"].as_array().expect("steps") {
            let actions: Vec<Value> = take(&mut delivery, step).into_iter().map(described).collect();
            assert_eq!(json!(actions), step["actions"], "{}: {step}", scenario["name"]);
        }
        let counts = delivery.counts();
        let found = json!({
            "produced": counts.produced, "accepted": counts.accepted, "dropped_by_rule": counts.dropped_by_rule,
            "in_flight": counts.in_flight, "resent": counts.resent,
            "awaiting_durability": counts.awaiting_durability, "settled_through": delivery.settled_through(),
        });
        assert_eq!(found, scenario["end"], "{}", scenario["name"]);
    }
}

#[test]
fn silence_is_reported_once_until_a_learner_answers() {
    let mut delivery = Delivery::new(1);
    take(&mut delivery, &json!({"event": "produced", "sequence": 1}));
    let silent = event(&json!({"event": "silent", "sequence": 1}));
    let reports = |delivery: &mut Delivery| -> Vec<Value> {
        let actions = (0..120).flat_map(|_| delivery.handle(silent.clone()));
        actions.map(described).filter(|action| action["send"].is_null()).collect()
    };
    assert_eq!(json!(reports(&mut delivery)), json!([{"lost": 1}, {"warn": true}, {"warn": true}, {"warn": true}]));
    let busy = Event::Answered { sequence: 1, receipt: receipt(Outcome::Busy, 0, 0) };
    assert_eq!(described(delivery.handle(busy).swap_remove(0)), json!("found"));
}

/// Any event for one of few fragments, learners and epochs.
fn any_event() -> impl Strategy<Value = Value> {
    let outcome = prop::sample::select(OUTCOMES.map(|(name, _)| name).to_vec());
    prop_oneof![
        3 => Just(json!({"event": "produced"})),
        6 => (1_u64..8, outcome, 0_u64..4, 0_u64..8).prop_map(|(sequence, outcome, epoch, durable_through)| json!({
            "event": "answered", "sequence": sequence, "outcome": outcome, "epoch": epoch,
            "durable_through": durable_through,
        })),
        2 => (1_u64..8).prop_map(|sequence| json!({"event": "silent", "sequence": sequence})),
        1 => (0_u64..4).prop_map(|epoch| json!({"event": "heard", "epoch": epoch})),
        1 => (1_u64..4).prop_map(|incarnation| json!({"event": "adopted", "incarnation": incarnation})),
    ]
}

proptest! {
    #[test]
    fn every_fragment_is_counted_once_whatever_happens(events in prop::collection::vec(any_event(), 0..80)) {
        let (mut delivery, mut produced) = (Delivery::new(1), 0_u64);
        for mut step in events {
            if step["event"] == "produced" {
                produced += 1;
                step["sequence"] = produced.into();
            }
            take(&mut delivery, &step);
            let counts = delivery.counts();
            prop_assert_eq!(counts.produced, produced);
            prop_assert_eq!(counts.produced, counts.accepted + counts.dropped_by_rule + counts.in_flight);
            prop_assert!(counts.awaiting_durability <= counts.accepted);
            let open = delivery.pending().chain(delivery.kept()).min();
            prop_assert_eq!(delivery.settled_through(), open.map_or(produced, |first| first - 1));
        }
    }
}
