//! `cargo fuzz run card`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::card(data));
