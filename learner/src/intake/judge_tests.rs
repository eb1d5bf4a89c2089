use treadmill_proto::PolicyVersion;

use super::*;

fn judge() -> Judge {
    let expected =
        Expected { run: "walk".into(), config_hash: 5, observation_size: 1, action_size: 1, max_policy_lag: 1 };
    Judge::new(expected, Arc::new(Admission::new(3, 64)), Ledger::default(), Tally::default())
}

fn fragment(sequence: u64, number: u64) -> Fragment {
    Fragment {
        run: "walk".into(),
        actor: "a".into(),
        actor_incarnation: 2,
        sequence,
        version: PolicyVersion { incarnation: 1, number },
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
        settled_through: 0,
        actor_state: None,
    }
}

fn lineage(number: u64) -> Lineage {
    let mut lineage = Lineage::new(1);
    (0..number).for_each(|_| lineage.advance());
    lineage
}

fn outcome(judge: &mut Judge, fragment: &Fragment, lineage: &Lineage) -> Outcome {
    match judge.judge("a", fragment.encode().unwrap().into(), lineage, Instant::now()) {
        Ok(_) => Outcome::Accepted,
        Err(receipt) => receipt.outcome,
    }
}

#[test]
fn each_outcome_and_its_count() {
    let (mut judge, lineage) = (judge(), lineage(5));
    assert_eq!(outcome(&mut judge, &fragment(1, 5), &lineage), Outcome::Accepted);
    assert_eq!(outcome(&mut judge, &fragment(1, 5), &lineage), Outcome::Duplicate);
    assert_eq!(outcome(&mut judge, &fragment(2, 4), &lineage), Outcome::Accepted);
    assert_eq!(outcome(&mut judge, &fragment(3, 3), &lineage), Outcome::TooOld);
    let vanished = Fragment { version: PolicyVersion { incarnation: 9, number: 5 }, ..fragment(4, 5) };
    assert_eq!(outcome(&mut judge, &vanished, &lineage), Outcome::Vanished);
    let other_run = Fragment { run: "other".into(), ..fragment(5, 5) };
    assert_eq!(outcome(&mut judge, &other_run, &lineage), Outcome::Malformed);
    let wanted = Tally { accepted: 2, duplicate: 1, too_old: 1, vanished: 1, malformed: 1, quarantined: 0 };
    assert_eq!(judge.tally, wanted);
}

#[test]
fn whoever_sends_again_what_was_dropped_by_rule_is_told_so_again() {
    let (mut judge, lineage) = (judge(), lineage(5));
    for duplicates in 0..2 {
        assert_eq!(outcome(&mut judge, &fragment(1, 0), &lineage), Outcome::TooOld);
        assert_eq!((judge.tally.too_old, judge.tally.duplicate), (1, duplicates));
    }
    judge.ledger.mark_durable();
    assert_eq!(judge.ledger.durable_through("a", 2), 1);
}

#[test]
fn refusals_name_the_field_and_lead_to_quarantine() {
    let (mut judge, lineage) = (judge(), lineage(0));
    let wrong =
        Fragment { observation_size: 2, observations: vec![0.0; 2], last_observations: vec![0.0; 2], ..fragment(1, 0) };
    for _ in 0..3 {
        let receipt = judge.judge("a", wrong.encode().unwrap().into(), &lineage, Instant::now()).unwrap_err();
        assert_eq!(receipt.outcome, Outcome::Malformed);
        assert!(receipt.reason.contains("`observation_size` is 2; expected 1"), "{}", receipt.reason);
    }
    assert_eq!(outcome(&mut judge, &fragment(1, 0), &lineage), Outcome::Quarantined);
    assert_eq!(judge.quarantined(Instant::now()), ["a"]);
}

#[test]
fn a_version_that_is_yet_to_come_is_a_lie() {
    let (mut judge, lineage) = (judge(), lineage(5));
    let receipt = judge.judge("a", fragment(1, 6).encode().unwrap().into(), &lineage, Instant::now()).unwrap_err();
    assert_eq!(receipt.outcome, Outcome::Malformed);
    assert!(receipt.reason.contains("`version` is 6; expected at most 5"), "{}", receipt.reason);
}

#[test]
fn nonsense_under_the_name_of_a_good_actor_does_not_harm_it() {
    let (mut judge, lineage) = (judge(), lineage(0));
    assert_eq!(outcome(&mut judge, &fragment(1, 0), &lineage), Outcome::Accepted);
    let impostor = Fragment { actor_incarnation: 3, run: "other".into(), ..fragment(2, 0) };
    for _ in 0..3 {
        assert_eq!(outcome(&mut judge, &impostor, &lineage), Outcome::Malformed);
    }
    assert_eq!(outcome(&mut judge, &impostor, &lineage), Outcome::Quarantined);
    assert_eq!(outcome(&mut judge, &fragment(2, 0), &lineage), Outcome::Accepted);
}

#[test]
fn a_sender_cannot_speak_for_another() {
    let (mut judge, lineage) = (judge(), lineage(0));
    let receipt = judge.judge("b", fragment(1, 0).encode().unwrap().into(), &lineage, Instant::now()).unwrap_err();
    assert!(receipt.reason.contains("as the key says"), "{}", receipt.reason);
}
