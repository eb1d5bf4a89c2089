//! `cargo fuzz run manifest`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::manifest(data));
