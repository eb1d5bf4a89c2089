//! `cargo fuzz run announcement`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::announcement(data));
