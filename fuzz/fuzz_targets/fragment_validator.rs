//! `cargo fuzz run fragment_validator`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::fragment_validator(data));
