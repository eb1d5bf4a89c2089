//! Runs every decoder on random bytes and mutated samples: no panic, stable round trips, bounded allocation.
//!
//! `TREADMILL_FUZZ_CASES` sets the messages of each kind per decoder; 2000 by default.

mod memory;

use proptest::{
    prelude::*,
    test_runner::{Config, TestRunner},
};
use treadmill_fuzz::{TARGETS, Target, samples, seeds_of};
use treadmill_proto::limits::{BUNDLE_BYTES_MAX, FRAGMENT_BYTES_MAX, MODEL_BYTES_MAX, SMALL_BYTES_MAX};

#[global_allocator]
static ALLOCATOR: memory::CountingAllocator = memory::CountingAllocator;

/// Allowed allocation independent of the message: tables, parsers, error messages.
const CONSTANT_BYTES: usize = 2 << 20;

fn cases() -> u32 {
    std::env::var("TREADMILL_FUZZ_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(2000)
}

/// Mutation of a message; positions are taken modulo its length.
#[derive(Clone, Debug)]
enum Mutation {
    Set(usize, u8),
    Cut(usize, usize),
    Repeat(usize, usize, usize),
    Insert(usize, Vec<u8>),
    End(usize),
    /// Overwrites with an extreme varint, length, float or text.
    Extreme(usize, usize),
}

const EXTREMES: [&[u8]; 10] = [
    &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1],
    &[0xff, 0xff, 0xff, 0xff, 0x0f],
    &[0xff, 0xff, 0xff, 0xff, 0x07],
    &[0x80, 0x80, 0x80, 0x80, 0x10],
    &[0, 0, 0x80, 0x7f],
    &[0, 0, 0, 0, 0, 0, 0xf8, 0x7f],
    b"1e999",
    b"-9223372036854775808",
    b"nan",
    "\u{1F916}".as_bytes(),
];

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = || any::<usize>();
    prop_oneof![
        4 => (at(), any::<u8>()).prop_map(|(at, byte)| Mutation::Set(at, byte)),
        2 => (at(), 1usize..40).prop_map(|(at, length)| Mutation::Cut(at, length)),
        2 => (at(), 1usize..40, 1usize..50).prop_map(|(at, length, times)| Mutation::Repeat(at, length, times)),
        2 => (at(), prop::collection::vec(any::<u8>(), 1..20)).prop_map(|(at, bytes)| Mutation::Insert(at, bytes)),
        1 => at().prop_map(Mutation::End),
        2 => (at(), 0..EXTREMES.len()).prop_map(|(at, which)| Mutation::Extreme(at, which)),
    ]
}

fn apply(bytes: &mut Vec<u8>, mutation: &Mutation) {
    let length = bytes.len();
    if length == 0 {
        return;
    }
    match mutation {
        Mutation::Set(at, byte) => bytes[at % length] = *byte,
        Mutation::Cut(at, count) => drop(bytes.drain(at % length..(at % length + count).min(length))),
        Mutation::Repeat(at, count, times) => {
            let part = bytes[at % length..(at % length + count).min(length)].repeat(*times);
            bytes.splice(at % length..at % length, part);
        }
        Mutation::Insert(at, inserted) => drop(bytes.splice(at % length..at % length, inserted.iter().copied())),
        Mutation::End(at) => bytes.truncate(at % length),
        Mutation::Extreme(at, which) => {
            let (from, extreme) = (at % length, EXTREMES[*which]);
            drop(bytes.splice(from..(from + extreme.len()).min(length), extreme.iter().copied()));
        }
    }
}

/// Runs a decoder and asserts the limit on its allocations.
fn run_target(name: &str, target: Target, factor: usize, bytes: &[u8]) {
    let peak = memory::peak_bytes(|| target(bytes));
    let allowed = CONSTANT_BYTES + factor * bytes.len();
    assert!(peak <= allowed, "{name} allocated {peak} bytes for a message of {} bytes", bytes.len());
}

fn find_target(name: &str) -> (Target, usize) {
    let found = TARGETS.iter().find(|target| target.0 == name).expect("a target of this name");
    (found.1, found.3)
}

/// Calls `test` with `cases` values of a strategy.
fn run_cases<S: Strategy>(name: &str, cases: u32, values: S, test: impl Fn(S::Value)) {
    let mut runner = TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() });
    let outcome = runner.run(&values, |value| {
        test(value);
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{name}: {error}"));
}

#[test]
fn random_bytes_are_decoded_safely() {
    for (name, target, _, factor) in TARGETS {
        let bytes = prop::collection::vec(any::<u8>(), 0..300);
        run_cases(name, cases(), bytes, |bytes| run_target(name, *target, *factor, &bytes));
    }
}

#[test]
fn mutated_samples_are_decoded_safely() {
    for (name, target, sample, factor) in TARGETS {
        let sample = sample();
        target(&sample);
        // Decoding a robot or a checkpoint takes a thousand times as long as a receipt.
        let cases = if sample.len() > 4000 { cases() / 10 } else { cases() };
        run_cases(name, cases, prop::collection::vec(mutation(), 1..6), |mutations| {
            let mut bytes = sample.clone();
            mutations.iter().for_each(|mutation| apply(&mut bytes, mutation));
            run_target(name, *target, *factor, &bytes);
        });
    }
}

#[test]
fn committed_seeds_are_decoded_safely() {
    for (name, target, _, factor) in TARGETS {
        let seeds = seeds_of(name);
        assert!(!seeds.is_empty(), "{name}");
        seeds.iter().for_each(|seed| run_target(name, *target, *factor, seed));
    }
}

#[test]
fn valid_samples_are_decoded() {
    // Otherwise the other tests would only cover refusals.
    use treadmill_proto::{Fragment, PolicyBundle};
    assert!(Fragment::decode(samples::fragment()).unwrap().actor_state.is_some());
    assert!(PolicyBundle::decode(samples::bundle()).unwrap().actor_state.is_some());
    let mut with_state = samples::fragment_without_state();
    with_state.extend([0x9a, 0x01, 0, 0]);
    let state = samples::actor_state();
    let length = with_state.len();
    with_state[length - 2..].copy_from_slice(&[state.len() as u8 | 0x80, (state.len() >> 7) as u8]);
    with_state.extend(state);
    assert_eq!(Fragment::decode(with_state), Fragment::decode(samples::fragment()), "fields may come in any order");
}

#[test]
fn small_messages_do_not_allocate_much() {
    let (fragment, factor) = find_target("fragment");
    // Empty episodes, alone and after a valid fragment.
    let episodes = [0x8a, 1, 0].repeat((FRAGMENT_BYTES_MAX - 4096) / 3);
    run_target("fragment", fragment, factor, &episodes);
    run_target("fragment", fragment, factor, &[samples::fragment_without_state(), episodes].concat());
    // Lengths beyond the end of the message.
    for field in 1..=19u8 {
        let key = if field < 16 { vec![field << 3 | 2] } else { vec![(field << 3 | 2) | 0x80, field >> 4] };
        for length in EXTREMES[..4].iter() {
            run_target("fragment", fragment, factor, &[&key[..], length, b"rest"].concat());
        }
    }
    let (bundle, factor) = find_target("bundle");
    let mut widths = vec![0x2a];
    let count = BUNDLE_BYTES_MAX - 100;
    widths.extend([count as u8 | 0x80, (count >> 7) as u8 | 0x80, (count >> 14) as u8 | 0x80, (count >> 21) as u8]);
    widths.extend(vec![1; count]);
    run_target("bundle", bundle, factor, &widths);
    run_target("bundle", bundle, factor, &[0x28, 1].repeat(count / 2));
    let (validator, factor) = find_target("fragment_validator");
    run_target("fragment_validator", validator, factor, &vec![0; FRAGMENT_BYTES_MAX]);
}

#[test]
fn depth_does_not_exhaust_the_stack() {
    let nested = |open: &str, close: &str, bytes: usize| {
        let depth = bytes / (open.len() + close.len());
        [open.repeat(depth), close.repeat(depth)].concat().into_bytes()
    };
    for (name, open, close, bytes) in [
        ("json", "[", "]", SMALL_BYTES_MAX),
        ("json", "{\"a\":", "}", SMALL_BYTES_MAX),
        ("config", "a = [", "]", 1 << 20),
        ("config", "a.", "", 1 << 20),
        ("model", "<body>", "</body>", MODEL_BYTES_MAX),
        ("model", "<frame>", "</frame>", MODEL_BYTES_MAX),
    ] {
        let (target, _) = find_target(name);
        target(&nested(open, close, bytes));
        let mut wrapped = b"<mujoco><worldbody>".to_vec();
        wrapped.extend(nested(open, close, bytes - 100));
        wrapped.extend(b"</worldbody></mujoco>");
        target(&wrapped);
    }
    let (model, _) = find_target("model");
    let defaults = ["<default class='a'>".repeat(9000), "</default>".repeat(9000)].concat();
    model(format!("<mujoco>{defaults}<worldbody/></mujoco>").as_bytes());
}

#[test]
fn exponential_entity_expansion_is_refused() {
    let (model, factor) = find_target("model");
    let mut text = "<!DOCTYPE m [<!ENTITY a0 \"xxxxxxxxxx\">".to_string();
    for i in 1..12 {
        text += &format!("<!ENTITY a{i} \"{}\">", format!("&a{};", i - 1).repeat(10));
    }
    text += "]><mujoco model=\"&a11;\"><worldbody/></mujoco>";
    run_target("model", model, factor, text.as_bytes());
}
