//! `cargo fuzz run bundle`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| treadmill_fuzz::bundle(data));
