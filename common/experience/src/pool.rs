//! Pool of actors that belong to no run: how its environments are divided among the runs, and the part of each learner.
//! Every learner evaluates the same rule on what all of them publish, so that no process decides for the others.

use std::{
    cmp::Reverse,
    collections::{BTreeMap, BTreeSet},
    time::Duration,
};

use treadmill_proto::{PoolDemand, pool::DEMAND_LASTS};
use treadmill_runtime::seeds::checksum;

/// Time after which an admitted actor that did not come has lost its place.
pub const GRANT: Duration = Duration::from_secs(15);
/// Time in a run after which an actor moves for any gain; before, only if a run is far from its target.
const SETTLED: Duration = Duration::from_secs(30);
/// Distance of a run from its target that is large, as a share of the target.
const LARGE: f64 = 0.1;
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
        let high = demand.envs_wanted() / unit;
        let low = demand.envs_min.saturating_sub(demand.envs_own).div_ceil(unit);
        Self {
            share: demand.share,
            own: f64::from(demand.envs_own) / f64::from(unit),
            // What it cannot have at least, it has not at all.
            low: if low <= high { f64::from(low) } else { 0.0 },
            high: if low <= high { f64::from(high) } else { 0.0 },
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

/// Another run.
#[derive(Clone, Debug)]
struct Other {
    demand: PoolDemand,
    heard: Duration,
    /// Environments of the pool that it should have, by this learner's view.
    target: u32,
}

/// Part of one learner in the pool. Times are since it started.
#[derive(Clone, Debug)]
pub struct PoolShare {
    /// Its own demand. The numbers of what it has follow from the actors.
    demand: PoolDemand,
    others: BTreeMap<String, Other>,
    /// Environments of every actor of the pool.
    actors: BTreeMap<String, u32>,
    /// Actors of the pool that the run has, and since when.
    members: BTreeMap<String, Duration>,
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

    /// Records the demand of another run, for the next [`Self::count`]. A run of another physics is left out, because its
    /// actors cannot join this one.
    pub fn hear(&mut self, demand: PoolDemand, now: Duration) {
        let known = self.others.get(&demand.run);
        let is_older = known.is_some_and(|known| known.demand.epoch > demand.epoch);
        let has_room = known.is_some() || self.others.len() < RUNS_MAX;
        let is_other = demand.run != self.demand.run && demand.physics_version == self.demand.physics_version;
        if is_other && !is_older && has_room {
            let target = demand.envs_target;
            self.others.insert(demand.run.clone(), Other { demand, heard: now, target });
        }
    }

    /// Forgets a run whose learner is gone, for the next [`Self::count`].
    pub fn forget(&mut self, run: &str) {
        self.others.remove(run);
    }

    /// Sets the actors of the whole pool with their environments, and the names of all actors that are in this run.
    pub fn set_actors(&mut self, pool: &BTreeMap<String, u32>, in_run: &BTreeSet<String>, now: Duration) {
        if self.actors != *pool {
            self.actors.clone_from(pool);
        }
        self.members.retain(|name, _| in_run.contains(name) && pool.contains_key(name));
        for name in in_run.iter().filter(|name| pool.contains_key(*name)) {
            self.members.entry(name.clone()).or_insert(now);
        }
        self.granted.retain(|name, until| *until > now && !in_run.contains(name) && pool.contains_key(name));
        self.others.retain(|_, other| now < other.heard + DEMAND_LASTS);
        self.count();
    }

    /// Returns whether an actor is known.
    pub fn knows(&self, actor: &str) -> bool {
        self.actors.contains_key(actor)
    }

    /// Adds an actor, which counts until [`Self::set_actors`] leaves it out.
    pub fn add_actor(&mut self, actor: &str, envs: u32) {
        self.actors.insert(actor.to_string(), envs);
        self.count();
    }

    /// Answers an actor that would join; an admitted one has its place for [`GRANT`]. One that is stranded has no run, and
    /// those with room refused it: remainders of the rounding, or a run that it cannot join.
    pub fn admit(&mut self, actor: &str, is_stranded: bool, now: Duration) -> bool {
        let Some(envs) = self.actors.get(actor).copied() else { return false };
        if self.members.contains_key(actor) || self.granted.contains_key(actor) {
            return true;
        }
        let PoolDemand { envs: has, envs_target: target, envs_min, envs_max, envs_own, open, share, .. } = self.demand;
        // The run must come nearer to its target.
        let is_wanted = has < target && (has + envs).saturating_sub(target) <= target - has;
        let with_it = has.saturating_add(envs_own).saturating_add(envs);
        let is_of_use = is_stranded && open && share > 0.0 && with_it >= envs_min;
        let admitted = with_it <= envs_max && (is_wanted || is_of_use);
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
            .filter(|Other { demand, target, .. }| demand.open && demand.envs < *target)
            .map(|Other { demand, target, .. }| Lack {
                envs: f64::from(target - demand.envs),
                target: f64::from(*target),
                room: f64::from(demand.envs_max) - f64::from(demand.envs_own) - f64::from(demand.envs),
                order: checksum(&[self.demand.run.as_bytes(), demand.run.as_bytes()]),
            })
            .collect();
        let mut members: Vec<(&String, &Duration)> = self.members.iter().collect();
        members.sort_by_key(|(name, since)| {
            let is_new = now < **since + SETTLED;
            (is_new, checksum(&[self.demand.run.as_bytes(), name.as_bytes()]))
        });
        let takes_none = self.demand.envs_wanted() == 0;
        let mut released = Vec::new();
        for (name, since) in members {
            let Some(envs) = self.actors.get(name).map(|envs| f64::from(*envs)) else { continue };
            lacking.sort_by_key(|lack| Reverse((lack.envs as u64, lack.order)));
            // The first one that would admit it.
            let admits = |lack: &&mut Lack| envs <= lack.room && (lack.envs - envs).abs() <= lack.envs;
            let Some(lack) = lacking.iter_mut().find(admits) else { continue };
            let surplus = has - target;
            let gain = surplus.abs() - (surplus - envs).abs() + lack.envs - (lack.envs - envs).abs();
            let is_large = surplus > LARGE * target || lack.envs > LARGE * lack.target;
            let may_move = takes_none || is_large || now >= *since + SETTLED;
            if surplus > 0.0 && gain > 0.0 && may_move {
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
        let others: u32 = self.others.values().map(|other| other.demand.envs).fold(0, u32::saturating_add);
        let idle = self.demand.pool_envs.saturating_sub(others).saturating_sub(self.demand.envs);
        idle > 0 && self.demand.envs < self.demand.envs_target
    }

    /// Counts what the run has, and what it should have.
    pub fn count(&mut self) {
        let names = || self.members.keys().chain(self.granted.keys());
        self.demand.envs = names().filter_map(|name| self.actors.get(name)).sum();
        self.demand.actors = self.members.len() as u32;
        self.demand.pool_actors = self.actors.len() as u32;
        self.demand.pool_envs = self.actors.values().copied().fold(0, u32::saturating_add);
        let demands: Vec<&PoolDemand> =
            [&self.demand].into_iter().chain(self.others.values().map(|other| &other.demand)).collect();
        // An actor that no run can take must not spoil the division of the others.
        let largest = demands.iter().map(|demand| demand.envs_wanted()).max().unwrap_or_default();
        let of_use: Vec<u32> = self.actors.values().copied().filter(|envs| *envs <= largest).collect();
        let envs = of_use.iter().copied().fold(0, u32::saturating_add);
        let targets = targets(&demands, envs, usual(&of_use));
        self.demand.envs_target = targets[0];
        for (other, target) in self.others.values_mut().zip(&targets[1..]) {
            other.target = *target;
        }
    }
}

/// Returns the most frequent number, the smallest one of several; 1 if there is none.
fn usual(numbers: &[u32]) -> u32 {
    let mut counts = BTreeMap::<u32, usize>::new();
    for number in numbers {
        *counts.entry(*number).or_default() += 1;
    }
    counts.into_iter().max_by_key(|(number, count)| (*count, Reverse(*number))).map_or(1, |(number, _)| number)
}

#[cfg(test)]
#[path = "pool_tests.rs"]
mod tests;
