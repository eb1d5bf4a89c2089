//! One target under libFuzzer: `TREADMILL_FUZZ_TARGET=pose cargo fuzz run fuzz_target`.
#![no_main]

use std::sync::LazyLock;

use treadmill_fuzz::{TARGETS, Target, robots::robot};

/// Function of the target that `TREADMILL_FUZZ_TARGET` names.
static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("TREADMILL_FUZZ_TARGET").expect("TREADMILL_FUZZ_TARGET names a target");
    let decoder = TARGETS.iter().find(|target| target.0 == name).map(|target| target.1);
    decoder.or((name == "robot").then_some(robot as Target)).unwrap_or_else(|| panic!("`{name}` is no target"))
});

libfuzzer_sys::fuzz_target!(|data: &[u8]| TARGET(data));
