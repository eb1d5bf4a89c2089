//! Tests of the division of a pool.

use proptest::prelude::*;

use super::*;

fn demand(run: &str, share: f64, envs_min: u32, envs_max: u32) -> PoolDemand {
    PoolDemand { run: run.into(), share, envs_min, envs_max, open: true, ..PoolDemand::default() }
}

fn divided(demands: &[PoolDemand], envs: u32, unit: u32) -> Vec<u32> {
    targets(&demands.iter().collect::<Vec<_>>(), envs, unit)
}

#[test]
fn the_pool_is_divided_by_share_within_the_limits() {
    let runs = [demand("a", 1.0, 0, 1000), demand("b", 3.0, 0, 1000)];
    assert_eq!(divided(&runs, 256, 32), [64, 192]);
    let limited = [demand("a", 1.0, 0, 1000), demand("b", 3.0, 0, 128)];
    assert_eq!(divided(&limited, 256, 32), [128, 128], "what one cannot use goes to the other");
    assert_eq!(divided(&limited[1..], 256, 32), [128], "the rest is idle");
    let with_own = [PoolDemand { envs_own: 64, ..runs[0].clone() }, runs[1].clone()];
    assert_eq!(divided(&with_own, 192, 32), [0, 192], "64 of 256 are its own");
    let closed = [PoolDemand { open: false, ..runs[0].clone() }, runs[1].clone()];
    assert_eq!(divided(&closed, 256, 32), [0, 256]);
    assert_eq!(divided(&[], 256, 32), [0u32; 0]);
    assert_eq!(divided(&[demand("a", 0.0, 0, 512), demand("b", 1.0, 0, 512)], 128, 32), [0, 128]);
}

#[test]
fn a_run_has_its_smallest_number_or_none() {
    let runs = [demand("a", 1.0, 64, 1000), demand("b", 1.5, 64, 1000), demand("c", 9.0, 64, 1000)];
    assert_eq!(divided(&runs, 128, 32), [0, 64, 64], "the smallest share waits");
    assert_eq!(divided(&runs, 192, 32), [64, 64, 64]);
    assert_eq!(divided(&runs, 32, 32), [0, 0, 0], "of use to none of them");
}

#[test]
fn remainders_go_to_the_largest_and_equal_ones_by_hash() {
    // 10 actors by 1 : 2 : 4 are 1.43, 2.86 and 5.71: the two largest remainders are rounded up.
    let runs = [demand("a", 1.0, 0, 999), demand("b", 2.0, 0, 999), demand("c", 4.0, 0, 999)];
    assert_eq!(divided(&runs, 320, 32), [32, 96, 192]);
    let equal = [demand("a", 1.0, 0, 999), demand("b", 1.0, 0, 999)];
    let three = divided(&equal, 96, 32);
    assert_eq!(three.iter().sum::<u32>(), 96);
    let reversed = divided(&[equal[1].clone(), equal[0].clone()], 96, 32);
    assert_eq!(three, [reversed[1], reversed[0]], "the order of the runs does not matter");
}

/// Pool with its learners, which hear each other at once.
struct Model {
    shares: Vec<PoolShare>,
    /// Environments and run of each actor.
    actors: BTreeMap<String, (u32, Option<usize>)>,
    now: Duration,
    moves: usize,
}

impl Model {
    fn new(demands: Vec<PoolDemand>, actors: &[u32]) -> Self {
        let actors = actors.iter().enumerate().map(|(i, envs)| (format!("a{i}"), (*envs, None))).collect();
        let shares = demands.into_iter().map(PoolShare::new).collect();
        Self { shares, actors, now: Duration::ZERO, moves: 0 }
    }

    /// Lets every learner see the actors and hear the others.
    fn publish(&mut self) {
        let pool: BTreeMap<String, u32> = self.actors.iter().map(|(name, (envs, _))| (name.clone(), *envs)).collect();
        for (index, share) in self.shares.iter_mut().enumerate() {
            let in_run = self.actors.iter().filter(|(_, (_, run))| *run == Some(index)).map(|(name, _)| name.clone());
            share.set_actors(&pool, &in_run.collect(), self.now);
        }
        let demands: Vec<PoolDemand> = self.shares.iter().map(|share| share.demand().clone()).collect();
        for share in &mut self.shares {
            demands.iter().for_each(|demand| share.hear(demand.clone(), self.now));
            share.count();
        }
    }

    /// Asks the runs for a place as an actor does: those that lack most first.
    fn seek(&mut self, name: &str, but: Option<usize>) -> bool {
        let mut runs: Vec<usize> = (0..self.shares.len()).filter(|run| Some(*run) != but).collect();
        let lack = |run: usize| {
            let demand = self.shares[run].demand();
            i64::from(demand.envs_target) - i64::from(demand.envs)
        };
        runs.sort_by_key(|run| Reverse(lack(*run)));
        let mut admits =
            |stranded: bool| runs.iter().find(|run| self.shares[**run].admit(name, stranded, self.now)).copied();
        let found = admits(false).or_else(|| if but.is_none() { admits(true) } else { None });
        if let Some(run) = found {
            self.actors.get_mut(name).unwrap().1 = Some(run);
            self.moves += 1;
        }
        found.is_some()
    }

    /// Runs rounds of one second until nothing moves; returns their number.
    fn settle(&mut self) -> usize {
        for round in 0..300 {
            self.publish();
            let before = self.moves;
            let idle: Vec<String> =
                self.actors.iter().filter(|(_, (_, run))| run.is_none()).map(|(name, _)| name.clone()).collect();
            for name in idle {
                self.seek(&name, None);
                self.publish();
            }
            for run in 0..self.shares.len() {
                for name in self.shares[run].releases(self.now) {
                    self.seek(&name, Some(run));
                }
            }
            self.now += Duration::from_secs(1);
            if self.moves == before && round > 40 {
                return round;
            }
        }
        panic!("the pool does not settle: {:?}", self.actors);
    }

    fn has(&self) -> Vec<u32> {
        let of = |run| self.actors.values().filter(|(_, of)| *of == Some(run)).map(|(envs, _)| envs).sum();
        (0..self.shares.len()).map(of).collect()
    }
}

#[test]
fn actors_go_where_they_are_needed_and_stay() {
    let runs = vec![demand("a", 1.0, 0, 512), demand("b", 3.0, 0, 512)];
    let mut model = Model::new(runs, &[32; 8]);
    model.settle();
    assert_eq!((model.has(), model.moves), (vec![64, 192], 8), "each one moves once");
    model.shares.push(PoolShare::new(demand("c", 4.0, 0, 512)));
    model.settle();
    assert_eq!((model.has(), model.moves), (vec![32, 96, 128], 12));
    model.shares[2].set(|demand| demand.open = false);
    model.settle();
    assert_eq!((model.has(), model.moves), (vec![64, 192, 0], 16), "a paused run has none");
    model.shares[0].set(|demand| demand.share = 9.0);
    model.settle();
    assert_eq!(model.has(), [192, 64, 0], "another share");
}

#[test]
fn an_admitted_actor_that_does_not_come_loses_its_place() {
    let mut share = PoolShare::new(demand("a", 1.0, 0, 32));
    let pool: BTreeMap<String, u32> = [("one".to_string(), 32), ("two".to_string(), 32)].into();
    let in_run = BTreeSet::new();
    share.set_actors(&pool, &in_run, Duration::ZERO);
    assert!(share.admit("one", true, Duration::ZERO) && !share.admit("two", true, Duration::ZERO));
    assert!(share.admit("one", true, Duration::ZERO), "it may ask again");
    assert!(!share.admit("stranger", true, Duration::ZERO));
    share.set_actors(&pool, &in_run, GRANT);
    assert!(share.admit("two", true, GRANT));
}

#[test]
fn an_actor_that_just_came_moves_for_a_large_gain_only() {
    let (large, small) = (demand("a", 1.0, 0, 9999), demand("b", 1.0, 0, 9999));
    let mut share = PoolShare::new(large);
    let actors = |count: usize| (0..count).map(|i| format!("a{i}")).collect::<Vec<_>>();
    for (count, released) in [(8, 4), (40, 0)] {
        let pool: BTreeMap<String, u32> = actors(count).into_iter().map(|name| (name, 10)).collect();
        // The other run has all but one of its actors.
        let (half, others) = (10 * count as u32 / 2, if count == 8 { 0 } else { 10 * (count as u32 / 2 - 1) });
        let in_run: BTreeSet<String> = actors(count - others as usize / 10).into_iter().collect();
        share.set_actors(&pool, &BTreeSet::new(), Duration::ZERO);
        share.set_actors(&pool, &in_run, Duration::ZERO);
        share.hear(PoolDemand { envs: others, envs_target: half, ..small.clone() }, Duration::ZERO);
        let soon = Duration::from_secs(10);
        share.set_actors(&pool, &in_run, soon);
        assert_eq!(share.releases(soon).len(), released, "{count}");
        share.hear(PoolDemand { envs: others, ..small.clone() }, SETTLED);
        share.set_actors(&pool, &in_run, SETTLED);
        assert_eq!(share.releases(SETTLED).len(), released.max(1), "{count}, later");
    }
}

#[test]
fn a_paused_run_gives_its_actors_free_at_once() {
    let mut share = PoolShare::new(demand("a", 1.0, 0, 64));
    let pool: BTreeMap<String, u32> = (0..64).map(|i| (format!("a{i}"), 32)).collect();
    let in_run: BTreeSet<String> = ["a1", "a2"].map(String::from).into();
    share.hear(PoolDemand { envs: 62 * 32 - 64, ..demand("b", 1.0, 0, 2000) }, Duration::ZERO);
    share.set_actors(&pool, &in_run, Duration::ZERO);
    assert_eq!(share.releases(Duration::ZERO), [""; 0], "it has what it should have");
    share.set(|demand| demand.open = false);
    assert_eq!(share.releases(Duration::ZERO).len(), 2, "each is a small gain for the other run");
}

#[test]
fn an_actor_that_no_run_with_room_takes_works_elsewhere() {
    let mut share = PoolShare::new(demand("a", 1.0, 96, 128));
    let pool: BTreeMap<String, u32> = [("one".to_string(), 32), ("two".to_string(), 32)].into();
    // The other run's rules may not admit these actors.
    share.hear(demand("b", 99.0, 0, 999), Duration::ZERO);
    share.set_actors(&pool, &BTreeSet::new(), Duration::ZERO);
    assert!(!share.admit("one", false, Duration::ZERO));
    assert!(!share.admit("one", true, Duration::ZERO), "32 are of no use to a run that needs 96");
    share.set(|demand| demand.envs_min = 0);
    assert!(share.admit("one", true, Duration::ZERO) && share.admit("two", true, Duration::ZERO));
    share.hear(PoolDemand { physics_version: 7, ..demand("c", 99.0, 0, 999) }, Duration::ZERO);
    share.forget("b");
    share.set_actors(&pool, &BTreeSet::new(), Duration::ZERO);
    assert_eq!(share.demand().envs_target, 64, "actors cannot join a run of another physics");
}

#[test]
fn actors_that_no_run_can_take_do_not_spoil_the_division() {
    let mut share = PoolShare::new(demand("a", 1.0, 0, 512));
    let large = (0..9).map(|i| (format!("l{i}"), 65_536));
    let pool: BTreeMap<String, u32> = large.chain([("one".to_string(), 32)]).collect();
    share.set_actors(&pool, &BTreeSet::new(), Duration::ZERO);
    assert_eq!(share.demand().envs_target, 32);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_pool_settles_and_no_actor_is_idle_that_is_wanted(
        sizes in proptest::collection::vec(1u32..200, 1..40),
        runs in proptest::collection::vec((0.1f64..10.0, 0u32..100, 0u32..2000, any::<bool>()), 1..7),
    ) {
        let demands = runs.iter().enumerate().map(|(i, (share, min, beyond, open))| {
            PoolDemand { open: *open, ..demand(&format!("r{i}"), *share, *min, min + beyond) }
        }).collect();
        let mut model = Model::new(demands, &sizes);
        model.settle();
        model.publish();
        for (share, has) in model.shares.iter().zip(model.has()) {
            prop_assert!(share.releases(model.now).is_empty());
            prop_assert!(has <= share.demand().envs_max);
            prop_assert!(has == 0 || has >= share.demand().envs_min.min(*sizes.iter().min().unwrap()));
        }
        let idle: Vec<String> =
            model.actors.iter().filter(|(_, (_, run))| run.is_none()).map(|(name, _)| name.clone()).collect();
        for name in idle {
            prop_assert!(!model.seek(&name, None), "{name} could work");
        }
    }

    #[test]
    fn targets_are_fair(
        envs in 0u32..5000,
        unit in 1u32..70,
        runs in proptest::collection::vec((0.1f64..10.0, 0u32..1500, 0u32..100), 1..9),
    ) {
        let demands: Vec<PoolDemand> = runs.iter().enumerate().map(|(i, (share, max, own))| {
            PoolDemand { envs_own: *own, ..demand(&format!("r{i}"), *share, 0, *max) }
        }).collect();
        let found = divided(&demands, envs, unit);
        prop_assert!(found.iter().sum::<u32>() <= envs);
        for (one, has) in demands.iter().zip(&found) {
            prop_assert!(*has == 0 || has + one.envs_own <= one.envs_max);
            // No run has more for its share than another that could take a further actor, beyond rounding.
            for (other, others) in demands.iter().zip(&found) {
                let could_take = others + other.envs_own + unit <= other.envs_max;
                let level = |demand: &PoolDemand, has: u32| f64::from(has + demand.envs_own) / demand.share;
                if could_take && *has >= unit {
                    prop_assert!(
                        level(one, has - unit) <= level(other, others + unit) + 1e-6,
                        "{has} of {one:?}, {others} of {other:?}"
                    );
                }
            }
        }
    }
}
