use super::*;

fn admission() -> Arc<Admission> {
    Arc::new(Admission::new(2, 16))
}

#[test]
fn failures_in_a_row_lead_to_quarantine_and_time_leads_out() {
    let (admission, now) = (admission(), Instant::now());
    let a = admission.identify("a", None);
    assert!(!admission.failed(&a, now));
    admission.taken("a", 1, now);
    assert!(!admission.failed(&a, now), "not in a row");
    assert!(admission.failed(&a, now));
    assert!(admission.holds(&a, now) && !admission.holds(&admission.identify("b", None), now));
    assert_eq!(admission.held(now), ["a"]);
    assert_eq!(admission.admit("a", None, 1, now).unwrap_err(), Refusal::Quarantined);
    assert_eq!(admission.take_unread(), Unread { quarantined: 1, ..Unread::default() });
    assert_eq!(admission.take_unread(), Unread::default());
    assert!(!admission.holds(&a, now + QUARANTINE));
}

#[test]
fn nonsense_under_a_good_name_shuts_out_who_sends_it_alone() {
    let (admission, now) = (admission(), Instant::now());
    admission.taken("good", 7, now);
    // Without an incarnation, and with one that is made up.
    for claimed in [None, Some(8)] {
        admission.failed(&admission.identify("good", claimed), now);
    }
    assert_eq!(admission.admit("good", Some(8), 1, now).unwrap_err(), Refusal::Quarantined);
    assert!(admission.admit("good", Some(7), 1, now).is_ok());
    // Who has proven himself is judged by what he does himself.
    let proven = admission.identify("good", Some(7));
    assert!(!admission.failed(&proven, now) && admission.failed(&proven, now));
    assert_eq!(admission.admit("good", Some(7), 1, now).unwrap_err(), Refusal::Quarantined);
}

#[test]
fn newcomers_share_a_part_of_the_queue_whatever_their_names() {
    let (admission, now) = (admission(), Instant::now());
    admission.taken("good", 7, now);
    let tickets: Vec<_> = (0..100).map(|i| admission.admit(&format!("n{i}"), Some(i), 1, now)).collect();
    assert_eq!(tickets.iter().filter(|ticket| ticket.is_ok()).count(), 4, "a quarter of 16");
    assert_eq!(*tickets[99].as_ref().unwrap_err(), Refusal::Busy);
    let good: Vec<_> = (0..9).map(|_| admission.admit("good", Some(7), 1, now)).collect();
    assert_eq!(good.iter().filter(|ticket| ticket.is_ok()).count(), WAITING_EACH_MAX);
    drop((tickets, good));
    assert!(admission.admit("n", None, 1, now).is_ok(), "room is given back");
    assert!(admission.admit("good", Some(7), 1, now).is_ok());
    assert_eq!(admission.admit("n", None, NEWCOMERS_BYTES_MAX + 1, now).unwrap_err(), Refusal::Busy);
}

#[test]
fn a_flood_of_newcomers_is_let_in_drop_by_drop() {
    let (admission, now) = (admission(), Instant::now());
    let let_in = |count: u32, now| {
        (0..count).filter(|_| !matches!(admission.admit("n", None, 1, now), Err(Refusal::Flood))).count() as f64
    };
    assert_eq!(let_in(100_000, now), NEWCOMERS_BURST);
    assert_eq!(let_in(100_000, now + Duration::from_secs(1)), NEWCOMERS_PER_S);
    assert!(admission.take_unread().turned_away > 100_000);
}

#[test]
fn many_newcomers_hear_that_there_is_no_room() {
    let (admission, now) = (admission(), Instant::now());
    let tickets: Vec<_> = (0..4).map(|_| admission.admit("n", None, 1, now).unwrap()).collect();
    let told = (0..100_000).filter(|_| admission.admit("n", None, 1, now).unwrap_err() == Refusal::Busy).count() as f64;
    let most = (NEWCOMERS_BURST - tickets.len() as f64) / BUSY_COST;
    assert!((most - 1.0..=most + 1.0).contains(&told), "{told} of {most}");
}

#[test]
fn what_is_sent_again_and_again_is_a_failure_in_the_end() {
    let (admission, now) = (admission(), Instant::now());
    admission.taken("a", 1, now);
    let sender = admission.identify("a", Some(1));
    let until = (1..).find(|_| admission.useless(&sender, now)).unwrap();
    assert_eq!(until, USELESS_MAX);
    assert!(admission.holds(&sender, now));
    admission.taken("b", 1, now);
    let sender = admission.identify("b", Some(1));
    for _ in 1..USELESS_MAX {
        assert!(!admission.useless(&sender, now));
    }
    admission.taken("b", 1, now);
    assert!(!admission.useless(&sender, now), "something useful was among them");
}

#[test]
fn memory_is_bounded_and_quarantine_cannot_be_crowded_out() {
    let (admission, now) = (admission(), Instant::now());
    let bad = admission.identify("bad", None);
    admission.failed(&bad, now);
    admission.failed(&bad, now);
    for i in 0..3 * SENDERS_MAX as u64 {
        let later = now + Duration::from_micros(i);
        admission.failed(&admission.identify(&format!("n{i}"), None), later);
        admission.taken("many", i, later);
    }
    let state = admission.state();
    assert_eq!((state.failures.len(), state.proven.len()), (SENDERS_MAX, SENDERS_MAX));
    drop(state);
    assert!(admission.holds(&bad, now));
    assert!(admission.identify("many", Some(0)).incarnation.is_none(), "the oldest gave way");
}
