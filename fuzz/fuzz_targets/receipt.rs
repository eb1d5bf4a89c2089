//! `cargo fuzz run receipt`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::receipt(data));
