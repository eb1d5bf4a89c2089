use super::*;

fn admission() -> Arc<Admission> {
    Arc::new(Admission::new(2, 16))
}

#[test]
fn consecutive_failures_quarantine_a_sender_for_a_limited_time() {
    let (admission, now) = (admission(), Instant::now());
    let a = admission.identify("a", None);
    assert!(!admission.record_malformed(&a, now));
    admission.record_accepted("a", 1, now);
    assert!(!admission.record_malformed(&a, now), "not in a row");
    assert!(admission.record_malformed(&a, now));
    assert!(admission.is_quarantined(&a, now) && !admission.is_quarantined(&admission.identify("b", None), now));
    assert_eq!(admission.quarantined(now), ["a"]);
    assert_eq!(admission.admit("a", None, 1, now).unwrap_err(), Refusal::Quarantined);
    assert_eq!(admission.take_unread(), Unread { quarantined: 1, ..Unread::default() });
    assert_eq!(admission.take_unread(), Unread::default());
    assert!(!admission.is_quarantined(&a, now + QUARANTINE));
}

#[test]
fn accepted_fragments_that_are_implausible_in_a_row_quarantine_their_sender() {
    let (admission, now) = (admission(), Instant::now());
    let accept = |admission: &Admission| admission.record_accepted("a", 1, now);
    accept(&admission);
    let a = admission.identify("a", Some(1));
    assert!(!admission.record_implausible(&a, now));
    // The next one is well-formed too, and is learnt from.
    accept(&admission);
    admission.record_learnt(&a);
    assert!(!admission.record_implausible(&a, now), "not in a row");
    accept(&admission);
    assert!(admission.record_implausible(&a, now), "being accepted does not end the row");
    assert!(admission.is_quarantined(&a, now));
    // A good fragment from before does not end the quarantine; time does, and the row begins anew.
    admission.record_learnt(&a);
    assert!(admission.is_quarantined(&a, now) && !admission.is_quarantined(&a, now + QUARANTINE));
    assert!(!admission.record_implausible(&a, now + QUARANTINE));
    // Others are not touched.
    assert!(!admission.is_quarantined(&admission.identify("a", Some(2)), now));
}

#[test]
fn malformed_fragments_under_a_good_name_quarantine_only_their_sender() {
    let (admission, now) = (admission(), Instant::now());
    admission.record_accepted("good", 7, now);
    // Without an incarnation, and with an invented one.
    for claimed in [None, Some(8)] {
        admission.record_malformed(&admission.identify("good", claimed), now);
    }
    assert_eq!(admission.admit("good", Some(8), 1, now).unwrap_err(), Refusal::Quarantined);
    assert!(admission.admit("good", Some(7), 1, now).is_ok());
    // A proven sender's own failures count.
    let proven = admission.identify("good", Some(7));
    assert!(!admission.record_malformed(&proven, now) && admission.record_malformed(&proven, now));
    assert_eq!(admission.admit("good", Some(7), 1, now).unwrap_err(), Refusal::Quarantined);
}

#[test]
fn newcomers_share_a_part_of_the_queue_whatever_their_names() {
    let (admission, now) = (admission(), Instant::now());
    admission.record_accepted("good", 7, now);
    let permits: Vec<_> = (0..100).map(|i| admission.admit(&format!("n{i}"), Some(i), 1, now)).collect();
    assert_eq!(permits.iter().filter(|permit| permit.is_ok()).count(), 4, "a quarter of 16");
    assert_eq!(*permits[99].as_ref().unwrap_err(), Refusal::Busy);
    let good: Vec<_> = (0..9).map(|_| admission.admit("good", Some(7), 1, now)).collect();
    assert_eq!(good.iter().filter(|permit| permit.is_ok()).count(), WAITING_PER_SENDER_MAX);
    drop((permits, good));
    assert!(admission.admit("n", None, 1, now).is_ok(), "dropped permits free their places");
    assert!(admission.admit("good", Some(7), 1, now).is_ok());
    assert_eq!(admission.admit("n", None, NEWCOMERS_BYTES_MAX + 1, now).unwrap_err(), Refusal::Busy);
}

#[test]
fn newcomers_are_admitted_at_a_limited_rate() {
    let (admission, now) = (admission(), Instant::now());
    let admitted = |count: u32, now| {
        (0..count).filter(|_| !matches!(admission.admit("n", None, 1, now), Err(Refusal::Flood))).count() as f64
    };
    assert_eq!(admitted(100_000, now), NEWCOMERS_BURST);
    assert_eq!(admitted(100_000, now + Duration::from_secs(1)), NEWCOMERS_PER_S);
    assert!(admission.take_unread().turned_away > 100_000);
}

#[test]
fn many_newcomers_get_a_busy_receipt() {
    let (admission, now) = (admission(), Instant::now());
    let permits: Vec<_> = (0..4).map(|_| admission.admit("n", None, 1, now).unwrap()).collect();
    let busy = (0..100_000).filter(|_| admission.admit("n", None, 1, now).unwrap_err() == Refusal::Busy).count() as f64;
    let most = (NEWCOMERS_BURST - permits.len() as f64) / BUSY_COST;
    assert!((most - 1.0..=most + 1.0).contains(&busy), "{busy} of {most}");
}

#[test]
fn many_useless_fragments_in_a_row_lead_to_quarantine() {
    let (admission, now) = (admission(), Instant::now());
    admission.record_accepted("a", 1, now);
    let sender = admission.identify("a", Some(1));
    let until = (1..).find(|_| admission.record_useless(&sender, now)).unwrap();
    assert_eq!(until, USELESS_MAX);
    assert!(admission.is_quarantined(&sender, now));
    admission.record_accepted("b", 1, now);
    let sender = admission.identify("b", Some(1));
    for _ in 1..USELESS_MAX {
        assert!(!admission.record_useless(&sender, now));
    }
    admission.record_accepted("b", 1, now);
    assert!(!admission.record_useless(&sender, now), "an accepted fragment interrupts the row");
}

#[test]
fn memory_is_bounded_and_a_quarantined_sender_is_not_forgotten() {
    let (admission, now) = (admission(), Instant::now());
    let bad = admission.identify("bad", None);
    admission.record_malformed(&bad, now);
    admission.record_malformed(&bad, now);
    for i in 0..3 * SENDERS_MAX as u64 {
        let later = now + Duration::from_micros(i);
        admission.record_malformed(&admission.identify(&format!("n{i}"), None), later);
        admission.record_accepted("many", i, later);
    }
    let state = admission.state();
    assert_eq!((state.failures.len(), state.proven.len()), (SENDERS_MAX, SENDERS_MAX));
    drop(state);
    assert!(admission.is_quarantined(&bad, now));
    assert!(admission.identify("many", Some(0)).incarnation.is_none(), "the oldest one is forgotten");
}
