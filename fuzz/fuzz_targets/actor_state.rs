//! `cargo fuzz run actor_state`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::actor_state(data));
