//! Learners that fail, freeze and are cut off while they share a store, with actors that follow the protocol.
//!
//! Whatever happens, no actor acts on a lower epoch after a higher one, no overtaken learner announces a version,
//! nothing that was called durable is lost or learnt from twice, and once the network is sound again one learner goes
//! on.
//!
//! `TREADMILL_SIMULATION_SEEDS=100000` tries more seeds, `TREADMILL_SIMULATION_SEED=17` replays one.

mod actor;
mod learner;
mod world;

use world::World;

/// Seeds of a usual run.
const SEEDS: u64 = 10_000;

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| text.parse().unwrap_or_else(|_| panic!("{name} is `{text}`, not a number")))
}

#[test]
#[expect(clippy::print_stdout, reason = "shows how much was simulated")]
fn no_fault_of_learners_network_or_store_loses_or_doubles_what_is_durable() {
    let seeds = match number("TREADMILL_SIMULATION_SEED") {
        Some(seed) => seed..seed + 1,
        None => 0..number("TREADMILL_SIMULATION_SEEDS").unwrap_or(SEEDS),
    };
    let (mut takeovers, mut repeated, mut faults) = (0, 0, 0);
    for seed in seeds.clone() {
        let mut world = World::new(seed);
        world.run_with_faults();
        world.heal_and_check();
        takeovers += world.takeovers;
        repeated += world.repeated_updates;
        faults += world.faults;
    }
    println!("{} seeds: {faults} faults, {takeovers} takeovers, {repeated} updates repeated", seeds.count());
    // A simulation without faults or takeovers would prove nothing.
    assert!(faults > 0 && takeovers > 0);
}
