//! Pool of actors that belong to no run: how its environments are divided among the runs, and the part of each learner.
//! Every learner evaluates the same rule on what all of them publish, so that no process decides for the others.

use std::{
    cmp::Reverse,
    collections::{BTreeMap, BTreeSet},
    time::Duration,
};

use treadmill_proto::PoolDemand;
use treadmill_runtime::seeds::checksum;

/// Time after which an admitted actor that did not come has lost its place.
pub const GRANT: Duration = Duration::from_secs(15);
/// Time after which a run that is not heard any more does not count; learners repeat their demand more often.
pub const HEARD: Duration = Duration::from_secs(20);
/// Time in a run after which an actor moves for any gain; before, for a large one only.
const SETTLED: Duration = Duration::from_secs(30);
/// Gain that is large: the distance of both runs from their targets that a move removes, as a share of the targets.
const LARGE_GAIN: f64 = 0.1;
/// Most runs and actors that are kept.
const RUNS_MAX: usize = 1024;
/// Steps of the bisection, which then is exact to the last bits of a share.
const BISECTIONS: usize = 200;

/// Environments of the pool that each run should have, in the order of `demands`: in proportion to `share`, at least
/// `envs_min` or none, at most `envs_max`, both with the run's own environments (weighted max-min fairness). `envs` is
/// the size of the pool; shares are rounded to whole actors of `unit` environments, largest remainder first.
pub fn targets(demands: &[&PoolDemand], envs: u32, unit: u32) -> Vec<u32> {
    let unit = unit.max(1);
    let actors = envs / unit;
    let mut wants: Vec<Want> = demands.iter().map(|demand| Want::of(demand, unit)).collect();
    // A run below its smallest number gains nothing: it waits while others with a larger share get theirs.
    loop {
        let needed: f64 = wants.iter().map(|want| want.low).sum();
        if needed <= f64::from(actors) {
            break;
        }
        let least = |(_, one): &(usize, &Want), (_, other): &(usize, &Want)| {
            one.share.total_cmp(&other.share).then(one.order.cmp(&other.order))
        };
        let waits = wants.iter().enumerate().filter(|(_, want)| want.low > 0.0).min_by(least).map(|(index, _)| index);
        let Some(index) = waits else { break };
        (wants[index].low, wants[index].high) = (0.0, 0.0);
    }
    let most: f64 = wants.iter().map(|want| want.high).sum();
    let divided = f64::from(actors).min(most);
    let level = level(&wants, divided);
    let exact: Vec<f64> = wants.iter().map(|want| want.at(level)).collect();
    let mut whole: Vec<u32> = exact.iter().map(|actors| (actors + 1e-9).floor() as u32).collect();
    let mut by_remainder: Vec<usize> = (0..wants.len()).collect();
    let remainder = |index: usize| exact[index] - f64::from(whole[index]);
    by_remainder.sort_by(|one, other| {
        remainder(*other).total_cmp(&remainder(*one)).then(wants[*one].order.cmp(&wants[*other].order))
    });
    let mut left = (divided.round() as u32).saturating_sub(whole.iter().sum());
    for index in by_remainder {
        if left > 0 && f64::from(whole[index]) + 1.0 <= wants[index].high {
            whole[index] += 1;
            left -= 1;
        }
    }
    whole.into_iter().map(|actors| actors * unit).collect()
}

/// Want of a run, in actors.
struct Want {
    share: f64,
    own: f64,
    /// Smallest and largest number of the pool's actors, whole numbers.
    low: f64,
    high: f64,
    /// Order of equal runs.
    order: u64,
}

impl Want {
    fn of(demand: &PoolDemand, unit: u32) -> Self {
        let beyond_own = |envs: u32| envs.saturating_sub(demand.envs_own);
        let (low, high) = match demand.open && demand.share > 0.0 {
            true => (beyond_own(demand.envs_min).div_ceil(unit), beyond_own(demand.envs_max) / unit),
            false => (0, 0),
        };
        Self {
            share: demand.share,
            own: f64::from(demand.envs_own) / f64::from(unit),
            low: f64::from(low.min(high)),
            high: f64::from(high),
            order: checksum(&[demand.run.as_bytes()]),
        }
    }

    /// Returns its actors where one unit of share gives `level` actors.
    fn at(&self, level: f64) -> f64 {
        (level * self.share - self.own).clamp(self.low, self.high)
    }
}

/// Returns the level at which the runs have `divided` actors together.
fn level(wants: &[Want], divided: f64) -> f64 {
    let sum = |level: f64| wants.iter().map(|want| want.at(level)).sum::<f64>();
    let full = |want: &Want| (want.high + want.own) / want.share.max(f64::MIN_POSITIVE);
    let top = wants.iter().filter(|want| want.high > 0.0).map(full).fold(0.0, f64::max);
    let (mut low, mut high) = (0.0, top);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if sum(middle) < divided { low = middle } else { high = middle }
    }
    high
}

/// What another run lacks, in environments.
struct Lack {
    envs: f64,
    target: f64,
    /// Environments up to its largest number.
    room: f64,
    /// Order of equal runs.
    order: u64,
}

/// Actor of the pool that a run has.
#[derive(Clone, Copy, Debug)]
struct Member {
    since: Duration,
}

/// Part of one learner in the pool. Times are since it started.
#[derive(Clone, Debug)]
pub struct PoolShare {
    /// Its own demand. The numbers of what it has follow from the actors.
    demand: PoolDemand,
    others: BTreeMap<String, (PoolDemand, Duration)>,
    /// Environments of every actor of the pool.
    actors: BTreeMap<String, u32>,
    members: BTreeMap<String, Member>,
    /// Admitted actors that have not come yet, and until when they may.
    granted: BTreeMap<String, Duration>,
}

impl PoolShare {
    /// Part of the learner that publishes `demand`, in an empty pool.
    pub fn new(demand: PoolDemand) -> Self {
        let (others, actors) = (BTreeMap::new(), BTreeMap::new());
        let mut share = Self { demand, others, actors, members: BTreeMap::new(), granted: BTreeMap::new() };
        share.count();
        share
    }

    /// Returns the demand to publish.
    pub fn demand(&self) -> &PoolDemand {
        &self.demand
    }

    /// Changes what the run wants.
    pub fn set(&mut self, change: impl FnOnce(&mut PoolDemand)) {
        change(&mut self.demand);
        self.count();
    }

    /// Records the demand of another run.
    pub fn hear(&mut self, demand: PoolDemand, now: Duration) {
        let known = self.others.get(&demand.run);
        let is_older = known.is_some_and(|(known, _)| known.epoch > demand.epoch);
        let has_room = known.is_some() || self.others.len() < RUNS_MAX;
        if demand.run != self.demand.run && !is_older && has_room {
            self.others.insert(demand.run.clone(), (demand, now));
            self.count();
        }
    }

    /// Forgets a run whose learner is gone.
    pub fn forget(&mut self, run: &str) {
        self.others.remove(run);
        self.count();
    }

    /// Sets the actors of the whole pool with their environments, and the names of all actors that are in this run.
    pub fn set_actors(&mut self, pool: &BTreeMap<String, u32>, in_run: &BTreeSet<String>, now: Duration) {
        if self.actors != *pool {
            self.actors.clone_from(pool);
        }
        self.members.retain(|name, _| in_run.contains(name) && pool.contains_key(name));
        for name in in_run.iter().filter(|name| pool.contains_key(*name)) {
            self.members.entry(name.clone()).or_insert(Member { since: now });
        }
        self.granted.retain(|name, until| *until > now && !in_run.contains(name) && pool.contains_key(name));
        self.others.retain(|_, (_, heard)| now < *heard + HEARD);
        self.count();
    }

    /// Answers an actor that would join; an admitted one has its place for [`GRANT`].
    pub fn admit(&mut self, actor: &str, is_idle: bool, now: Duration) -> bool {
        let Some(envs) = self.actors.get(actor).copied() else { return false };
        if self.members.contains_key(actor) || self.granted.contains_key(actor) {
            return true;
        }
        let PoolDemand { envs: has, envs_target: target, envs_max, envs_own, open, .. } = self.demand;
        // The run must come nearer to its target.
        let is_wanted = has < target && (has + envs).saturating_sub(target) <= target - has;
        let is_of_use = || {
            // Remainders of the rounding: of use somewhere, as long as no run has room.
            let has_room = |demand: &PoolDemand| demand.open && demand.envs + envs <= demand.envs_target;
            is_idle && open && self.demand.share > 0.0 && !self.others.values().any(|(demand, _)| has_room(demand))
        };
        let fits = has.saturating_add(envs_own).saturating_add(envs) <= envs_max;
        let admitted = fits && (is_wanted || is_of_use());
        if admitted {
            self.granted.insert(actor.to_string(), now + GRANT);
            self.count();
        }
        admitted
    }

    /// Returns the actors that another run needs more, those that came last at the end.
    pub fn releases(&self, now: Duration) -> Vec<String> {
        let target = f64::from(self.demand.envs_target);
        let has: u32 = self.members.keys().filter_map(|name| self.actors.get(name)).sum();
        let mut has = f64::from(has);
        let mut lacking: Vec<Lack> = self
            .others
            .values()
            .filter(|(demand, _)| demand.open && demand.envs < demand.envs_target)
            .map(|(demand, _)| Lack {
                envs: f64::from(demand.envs_target - demand.envs),
                target: f64::from(demand.envs_target),
                room: f64::from(demand.envs_max) - f64::from(demand.envs_own) - f64::from(demand.envs),
                order: checksum(&[self.demand.run.as_bytes(), demand.run.as_bytes()]),
            })
            .collect();
        let mut members: Vec<(&String, &Member)> = self.members.iter().collect();
        members.sort_by_key(|(name, member)| {
            let is_new = now < member.since + SETTLED;
            (is_new, checksum(&[self.demand.run.as_bytes(), name.as_bytes()]))
        });
        let mut released = Vec::new();
        for (name, member) in members {
            let Some(envs) = self.actors.get(name).map(|envs| f64::from(*envs)) else { continue };
            lacking.sort_by_key(|lack| Reverse((lack.envs as u64, lack.order)));
            // The first one that would admit it.
            let admits = |lack: &&mut Lack| envs <= lack.room && (lack.envs - envs).abs() <= lack.envs;
            let Some(lack) = lacking.iter_mut().find(admits) else { continue };
            let surplus = has - target;
            let gain = surplus.abs() - (surplus - envs).abs() + lack.envs - (lack.envs - envs).abs();
            let is_large = gain > LARGE_GAIN * (target + lack.target);
            if surplus > 0.0 && gain > 0.0 && (now >= member.since + SETTLED || is_large) {
                released.push(name.clone());
                has -= envs;
                lack.envs -= envs;
                lack.room -= envs;
            }
        }
        released
    }

    /// Returns the names of the pool's actors that the run has.
    pub fn members(&self) -> impl Iterator<Item = &str> {
        self.members.keys().map(String::as_str)
    }

    /// Returns whether the run has room for an actor that has no run, if there is one.
    pub fn has_room_for_idle(&self) -> bool {
        let others: u32 = self.others.values().map(|(demand, _)| demand.envs).fold(0, u32::saturating_add);
        let idle = self.demand.pool_envs.saturating_sub(others).saturating_sub(self.demand.envs);
        idle > 0 && self.demand.envs < self.demand.envs_target
    }

    /// Counts what the run has, and what it should have.
    fn count(&mut self) {
        let names = || self.members.keys().chain(self.granted.keys());
        self.demand.envs = names().filter_map(|name| self.actors.get(name)).sum();
        self.demand.actors = self.members.len() as u32;
        self.demand.pool_actors = self.actors.len() as u32;
        self.demand.pool_envs = self.actors.values().copied().fold(0, u32::saturating_add);
        let demands: Vec<&PoolDemand> =
            [&self.demand].into_iter().chain(self.others.values().map(|(demand, _)| demand)).collect();
        self.demand.envs_target = targets(&demands, self.demand.pool_envs, self.unit())[0];
    }

    /// Returns the most frequent number of environments of an actor, the smaller one of two.
    fn unit(&self) -> u32 {
        let mut counts = BTreeMap::<u32, usize>::new();
        for envs in self.actors.values() {
            *counts.entry(*envs).or_default() += 1;
        }
        counts.into_iter().max_by_key(|(envs, count)| (*count, Reverse(*envs))).map_or(1, |(envs, _)| envs)
    }
}

#[cfg(test)]
mod tests {
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
            let pool: BTreeMap<String, u32> =
                self.actors.iter().map(|(name, (envs, _))| (name.clone(), *envs)).collect();
            for (index, share) in self.shares.iter_mut().enumerate() {
                let in_run =
                    self.actors.iter().filter(|(_, (_, run))| *run == Some(index)).map(|(name, _)| name.clone());
                share.set_actors(&pool, &in_run.collect(), self.now);
            }
            let demands: Vec<PoolDemand> = self.shares.iter().map(|share| share.demand().clone()).collect();
            for share in &mut self.shares {
                demands.iter().for_each(|demand| share.hear(demand.clone(), self.now));
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
            let found = runs.into_iter().find(|run| self.shares[*run].admit(name, but.is_none(), self.now));
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
            share.hear(PoolDemand { envs: others, envs_target: half, ..small.clone() }, SETTLED);
            share.set_actors(&pool, &in_run, SETTLED);
            assert_eq!(share.releases(SETTLED).len(), released.max(1), "{count}, later");
        }
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
                prop_assert!(has <= share.demand().envs_max || has == 0);
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
}
