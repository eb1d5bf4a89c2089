//! Random robots. `TREADMILL_FUZZ_SECONDS=3600 cargo test --release -p treadmill-fuzz --test robots` tries them for an hour.

use std::time::{Duration, Instant};

use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use treadmill_fuzz::{robots::robot, seeds_of};

#[test]
fn no_robot_panics_or_depends_on_its_neighbours() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let limit = number("TREADMILL_FUZZ_SECONDS").map(Duration::from_secs);
    let cases = number("TREADMILL_FUZZ_CASES").unwrap_or(300) as u32;
    let begun = Instant::now();
    let mut tried = 0;
    loop {
        let config =
            ProptestConfig { cases, failure_persistence: None, max_shrink_iters: 200, ..ProptestConfig::default() };
        let found = TestRunner::new(config).run(&prop::collection::vec(any::<u8>(), 0..3000), |data| {
            robot(&data);
            Ok(())
        });
        assert!(found.is_ok(), "{}", found.map_or_else(|why| why.to_string(), |()| String::new()));
        tried += cases;
        if limit.is_none_or(|limit| begun.elapsed() > limit) {
            break;
        }
    }
    assert!(tried >= cases);
}

#[test]
fn committed_seeds_depend_on_no_neighbours() {
    let seeds = seeds_of("robot");
    assert!(!seeds.is_empty());
    seeds.iter().for_each(|seed| robot(seed));
}
