//! `cargo fuzz run policy_request`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::policy_request(data));
