use treadmill_proto::PolicyVersion;

use super::*;

fn validator() -> FragmentValidator {
    let expected = ExpectedFragment {
        run: "walk".into(),
        config_hash: 5,
        observation_size: 1,
        action_size: 1,
        max_policy_lag: 1,
        physics_version: 0,
    };
    FragmentValidator::new(expected, Arc::new(Admission::new(3, 64)), Ledger::default(), FragmentCounts::default())
}

fn fragment(sequence: u64, number: u64) -> Fragment {
    Fragment {
        run: "walk".into(),
        actor: "a".into(),
        actor_incarnation: 2,
        sequence,
        version: PolicyVersion::new(1, number),
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
        ..Fragment::default()
    }
}

fn lineage(number: u64) -> Lineage {
    let mut lineage = Lineage::new(1);
    (0..number).for_each(|_| lineage.advance());
    lineage
}

fn outcome(validator: &mut FragmentValidator, fragment: &Fragment, lineage: &Lineage) -> Outcome {
    match validator.validate("a", fragment.encode().unwrap().into(), lineage, Instant::now()) {
        Ok(_) => Outcome::Accepted,
        Err(receipt) => receipt.outcome,
    }
}

#[test]
fn each_outcome_and_its_count() {
    let (mut validator, lineage) = (validator(), lineage(5));
    assert_eq!(outcome(&mut validator, &fragment(1, 5), &lineage), Outcome::Accepted);
    assert_eq!(outcome(&mut validator, &fragment(1, 5), &lineage), Outcome::Duplicate);
    assert_eq!(outcome(&mut validator, &fragment(2, 4), &lineage), Outcome::Accepted);
    assert_eq!(outcome(&mut validator, &fragment(3, 3), &lineage), Outcome::TooOld);
    let vanished = Fragment { version: PolicyVersion::new(9, 5), ..fragment(4, 5) };
    assert_eq!(outcome(&mut validator, &vanished, &lineage), Outcome::Vanished);
    let other_run = Fragment { run: "other".into(), ..fragment(5, 5) };
    assert_eq!(outcome(&mut validator, &other_run, &lineage), Outcome::Malformed);
    let wanted =
        FragmentCounts { accepted: 2, duplicate: 1, too_old: 1, vanished: 1, malformed: 1, ..Default::default() };
    assert_eq!(validator.counts, wanted);
}

#[test]
fn a_fragment_of_the_run_that_this_one_replaced_is_dropped_by_rule() {
    let (mut validator, lineage) = (validator(), lineage(5));
    let other = Fragment {
        version: PolicyVersion::new(9, 5),
        config_hash: 6,
        observation_size: 2,
        observations: vec![0.0; 2],
        last_observations: vec![0.0; 2],
        physics_version: 3,
        ..fragment(1, 5)
    };
    for _ in 0..4 {
        assert_eq!(outcome(&mut validator, &other, &lineage), Outcome::Vanished);
    }
    assert_eq!((validator.counts.vanished, validator.counts.duplicate, validator.counts.malformed), (1, 3, 0));
    let claimed = Fragment { version: PolicyVersion::new(1, 5), ..other };
    assert_eq!(outcome(&mut validator, &claimed, &lineage), Outcome::Malformed);
}

#[test]
fn a_fragment_dropped_by_rule_gets_the_same_outcome_when_it_is_sent_again() {
    let (mut validator, lineage) = (validator(), lineage(5));
    for duplicates in 0..2 {
        assert_eq!(outcome(&mut validator, &fragment(1, 0), &lineage), Outcome::TooOld);
        assert_eq!((validator.counts.too_old, validator.counts.duplicate), (1, duplicates));
    }
    validator.ledger.mark_durable();
    assert_eq!(validator.ledger.durable_through("a", 2), 1);
}

#[test]
fn another_physics_is_refused_by_name() {
    let lineage = lineage(0);
    let outcome = |expected: u32, found: u32| {
        let mut validator = validator();
        validator.expected.physics_version = expected;
        let fragment = Fragment { physics_version: found, wire_version: 2, ..fragment(1, 0) };
        let validated = validator.validate("a", fragment.encode().unwrap().into(), &lineage, Instant::now());
        validated.map(drop).map_err(|receipt| receipt.reason)
    };
    for (expected, found) in [(1, 1), (2, 2), (0, 0), (0, 7)] {
        assert_eq!(outcome(expected, found), Ok(()), "{expected} {found}");
    }
    for (expected, found) in [(1, 2), (2, 1), (2, 0), (2, u32::MAX)] {
        let wanted = format!(
            "field `physics_version` is {found}; expected {expected}, the physics of the run: use the same version of \
             treadmill"
        );
        assert_eq!(outcome(expected, found), Err(wanted));
    }
}

#[test]
fn rejections_name_the_field_and_lead_to_quarantine() {
    let (mut validator, lineage) = (validator(), lineage(0));
    let wrong =
        Fragment { observation_size: 2, observations: vec![0.0; 2], last_observations: vec![0.0; 2], ..fragment(1, 0) };
    for _ in 0..3 {
        let receipt = validator.validate("a", wrong.encode().unwrap().into(), &lineage, Instant::now()).unwrap_err();
        assert_eq!(receipt.outcome, Outcome::Malformed);
        assert!(receipt.reason.contains("`observation_size` is 2; expected 1"), "{}", receipt.reason);
    }
    assert_eq!(outcome(&mut validator, &fragment(1, 0), &lineage), Outcome::Quarantined);
    assert_eq!(validator.quarantined(Instant::now()), ["a"]);
}

#[test]
fn versions_of_the_future_and_names_of_others_are_malformed() {
    let (mut validator, lineage) = (validator(), lineage(5));
    for (sender, number, why) in [("a", 6, "`version` is 6; expected at most 5"), ("b", 5, "as the key says")] {
        let sent = fragment(1, number).encode().unwrap();
        let receipt = validator.validate(sender, sent.into(), &lineage, Instant::now()).unwrap_err();
        assert_eq!(receipt.outcome, Outcome::Malformed);
        assert!(receipt.reason.contains(why), "{}", receipt.reason);
    }
}

#[test]
fn malformed_fragments_in_the_name_of_an_actor_do_not_harm_it() {
    let (mut validator, lineage) = (validator(), lineage(0));
    assert_eq!(outcome(&mut validator, &fragment(1, 0), &lineage), Outcome::Accepted);
    let impostor = Fragment { actor_incarnation: 3, run: "other".into(), ..fragment(2, 0) };
    for _ in 0..3 {
        assert_eq!(outcome(&mut validator, &impostor, &lineage), Outcome::Malformed);
    }
    assert_eq!(outcome(&mut validator, &impostor, &lineage), Outcome::Quarantined);
    assert_eq!(outcome(&mut validator, &fragment(2, 0), &lineage), Outcome::Accepted);
}

#[test]
fn implausible_fragments_are_counted_and_lead_to_quarantine() {
    let (mut validator, lineage) = (validator(), lineage(0));
    let now = Instant::now();
    for sequence in 1..=4 {
        let sent = fragment(sequence, 0);
        assert_eq!(outcome(&mut validator, &sent, &lineage), Outcome::Accepted, "its numbers are not checked here");
        // The first is good; the others are three in a row.
        match sequence {
            1 => validator.report_learnt(&sent),
            _ => validator.report_implausible(&sent, &Implausible::NonFinite, now),
        }
        assert_eq!(validator.quarantined(now).is_empty(), sequence < 4, "{sequence}");
    }
    assert_eq!((validator.counts.implausible, validator.counts.accepted, validator.counts.malformed), (3, 4, 0));
    assert_eq!(outcome(&mut validator, &fragment(5, 0), &lineage), Outcome::Quarantined);
    let other = Fragment { actor_incarnation: 3, ..fragment(1, 0) };
    assert_eq!(outcome(&mut validator, &other, &lineage), Outcome::Accepted, "another process of that name");
}
