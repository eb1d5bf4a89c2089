//! `cargo fuzz run policy_piece`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::policy_piece(data));
