//! `cargo fuzz run robot`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::robots::robot(data));
