//! `cargo fuzz run evaluation`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::evaluation(data));
