//! Every decoder under noise and changed samples: it never panics, what it takes survives being encoded again, and it
//! allocates no more than a few times what came.
//!
//! `TREADMILL_FUZZ_CASES` says how many messages of each kind each decoder gets; 2000 by default.

mod memory;

use proptest::{
    prelude::*,
    test_runner::{Config, TestRunner},
};
use treadmill_fuzz::{TARGETS, Target, samples};
use treadmill_proto::limits::{BUNDLE_BYTES_MAX, FRAGMENT_BYTES_MAX, MODEL_BYTES_MAX, SMALL_BYTES_MAX};

#[global_allocator]
static ALLOCATOR: memory::Counting = memory::Counting;

/// What a decoder may allocate whatever came: tables, parsers, messages of errors.
const CONSTANT_BYTES: usize = 2 << 20;

fn cases() -> u32 {
    std::env::var("TREADMILL_FUZZ_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(2000)
}

/// A change of a message; positions are taken modulo its length.
#[derive(Clone, Debug)]
enum Change {
    Set(usize, u8),
    Cut(usize, usize),
    Repeat(usize, usize, usize),
    Insert(usize, Vec<u8>),
    End(usize),
    /// The largest numbers that a varint, a length, a float or a text may hold.
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

fn change() -> impl Strategy<Value = Change> {
    let at = || any::<usize>();
    prop_oneof![
        4 => (at(), any::<u8>()).prop_map(|(at, byte)| Change::Set(at, byte)),
        2 => (at(), 1usize..40).prop_map(|(at, length)| Change::Cut(at, length)),
        2 => (at(), 1usize..40, 1usize..50).prop_map(|(at, length, times)| Change::Repeat(at, length, times)),
        2 => (at(), prop::collection::vec(any::<u8>(), 1..20)).prop_map(|(at, bytes)| Change::Insert(at, bytes)),
        1 => at().prop_map(Change::End),
        2 => (at(), 0..EXTREMES.len()).prop_map(|(at, which)| Change::Extreme(at, which)),
    ]
}

fn apply(bytes: &mut Vec<u8>, change: &Change) {
    let length = bytes.len();
    if length == 0 {
        return;
    }
    match change {
        Change::Set(at, byte) => bytes[at % length] = *byte,
        Change::Cut(at, count) => drop(bytes.drain(at % length..(at % length + count).min(length))),
        Change::Repeat(at, count, times) => {
            let part = bytes[at % length..(at % length + count).min(length)].repeat(*times);
            bytes.splice(at % length..at % length, part);
        }
        Change::Insert(at, inserted) => drop(bytes.splice(at % length..at % length, inserted.iter().copied())),
        Change::End(at) => bytes.truncate(at % length),
        Change::Extreme(at, which) => {
            let (from, extreme) = (at % length, EXTREMES[*which]);
            drop(bytes.splice(from..(from + extreme.len()).min(length), extreme.iter().copied()));
        }
    }
}

/// Runs a decoder, and asserts what it allocated.
fn try_on(name: &str, target: Target, factor: usize, bytes: &[u8]) {
    let peak = memory::peak_bytes(|| target(bytes));
    let allowed = CONSTANT_BYTES + factor * bytes.len();
    assert!(peak <= allowed, "{name} allocated {peak} bytes for {} that came", bytes.len());
}

fn named(name: &str) -> (Target, usize) {
    let found = TARGETS.iter().find(|target| target.0 == name).expect("a target of this name");
    (found.1, found.3)
}

#[test]
fn noise() {
    for (name, target, _, factor) in TARGETS {
        let mut runner = TestRunner::new(Config { cases: cases(), failure_persistence: None, ..Config::default() });
        let noise = prop::collection::vec(any::<u8>(), 0..300);
        runner
            .run(&noise, |bytes| {
                try_on(name, *target, *factor, &bytes);
                Ok(())
            })
            .unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}

#[test]
fn changed_samples() {
    for (name, target, sample, factor) in TARGETS {
        let sample = sample();
        target(&sample);
        // A robot or a checkpoint takes a thousand times as long as a receipt.
        let cases = if sample.len() > 4000 { cases() / 10 } else { cases() };
        let mut runner = TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() });
        let changes = prop::collection::vec(change(), 1..6);
        runner
            .run(&changes, |changes| {
                let mut bytes = sample.clone();
                changes.iter().for_each(|change| apply(&mut bytes, change));
                try_on(name, *target, *factor, &bytes);
                Ok(())
            })
            .unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}

#[test]
fn sound_samples_are_taken() {
    // Else all of this would try nothing but refusals.
    use treadmill_proto::{Fragment, PolicyBundle};
    assert!(Fragment::decode(samples::fragment()).unwrap().actor_state.is_some());
    assert!(PolicyBundle::decode(samples::bundle()).unwrap().actor_state.is_some());
    let mut with_state = samples::fragment_without_state();
    with_state.extend([0x9a, 0x01, 0, 0]);
    let state = samples::actor_state();
    let length = with_state.len();
    with_state[length - 2..].copy_from_slice(&[state.len() as u8 | 0x80, (state.len() >> 7) as u8]);
    with_state.extend(state);
    assert_eq!(with_state, samples::fragment());
}

#[test]
fn few_bytes_do_not_buy_much_memory() {
    let (fragment, factor) = named("fragment");
    // Empty episodes, at the end of a sound fragment and by themselves.
    let episodes = [0x8a, 1, 0].repeat((FRAGMENT_BYTES_MAX - 4096) / 3);
    try_on("fragment", fragment, factor, &episodes);
    try_on("fragment", fragment, factor, &[samples::fragment_without_state(), episodes].concat());
    // Lengths that nobody sends the bytes for.
    for field in 1..=19u8 {
        let key = if field < 16 { vec![field << 3 | 2] } else { vec![(field << 3 | 2) | 0x80, field >> 4] };
        for length in EXTREMES[..4].iter() {
            try_on("fragment", fragment, factor, &[&key[..], length, b"rest"].concat());
        }
    }
    let (bundle, factor) = named("bundle");
    let mut widths = vec![0x2a];
    let count = BUNDLE_BYTES_MAX - 100;
    widths.extend([count as u8 | 0x80, (count >> 7) as u8 | 0x80, (count >> 14) as u8 | 0x80, (count >> 21) as u8]);
    widths.extend(vec![1; count]);
    try_on("bundle", bundle, factor, &widths);
    try_on("bundle", bundle, factor, &[0x28, 1].repeat(count / 2));
    let (validator, factor) = named("fragment_validator");
    try_on("fragment_validator", validator, factor, &vec![0; FRAGMENT_BYTES_MAX]);
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
        let (target, _) = named(name);
        target(&nested(open, close, bytes));
        let mut wrapped = b"<mujoco><worldbody>".to_vec();
        wrapped.extend(nested(open, close, bytes - 100));
        wrapped.extend(b"</worldbody></mujoco>");
        target(&wrapped);
    }
    let (model, _) = named("model");
    let defaults = ["<default class='a'>".repeat(9000), "</default>".repeat(9000)].concat();
    model(format!("<mujoco>{defaults}<worldbody/></mujoco>").as_bytes());
}

#[test]
fn an_entity_that_grows_is_refused() {
    let (model, factor) = named("model");
    let mut text = "<!DOCTYPE m [<!ENTITY a0 \"xxxxxxxxxx\">".to_string();
    for i in 1..12 {
        text += &format!("<!ENTITY a{i} \"{}\">", format!("&a{};", i - 1).repeat(10));
    }
    text += "]><mujoco model=\"&a11;\"><worldbody/></mujoco>";
    try_on("model", model, factor, text.as_bytes());
}
