//! `cargo fuzz run fragment`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::fragment(data));
