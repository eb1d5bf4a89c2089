//! Fleet as the learner knows it from fragments: environments and speed of each actor, its horizon, and its effort.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use treadmill_proto::Fragment;

use super::horizon::{HorizonRule, Member};

/// Rounds without its token after which an actor no longer counts. A restarted actor is back sooner, and the horizons of the
/// others stay as they are.
const ABSENT_ROUNDS_MAX: u32 = 3;
/// Change of an actor's relative speed that its horizon does not follow, so that noise changes no horizon.
const SPEED_TOLERANCE: f64 = 0.15;
/// Largest ratio between the speeds of two actors that the rule uses.
const SPEED_RATIO_MAX: f64 = 64.0;
/// Weight of the newest fragment in an actor's mean duration of a step.
const NEWEST_WEIGHT: f64 = 0.5;
/// Most actors.
const ACTORS_MAX: usize = 4096;

/// Longest simulation of one fragment that counts (s).
const COLLECT_S_MAX: f64 = 86_400.0;

/// What a fragment says about its sender's work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Effort {
    incarnation: u64,
    transitions: u64,
    /// Environment steps that the process has simulated; 0 if it does not count them.
    counted: u64,
    envs: usize,
    collect_s: f64,
    /// Seconds per control step of all environments; 0 if unknown.
    step_s: f64,
}

impl Effort {
    pub(super) fn of(fragment: &Fragment) -> Self {
        Self {
            incarnation: fragment.actor_incarnation,
            transitions: fragment.transitions() as u64,
            counted: fragment.env_steps,
            envs: fragment.envs as usize,
            collect_s: fragment.collect_s,
            step_s: fragment.collect_s / f64::from(fragment.steps),
        }
    }
}

/// Work of all actors since the learner started, by their own count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FleetEffort {
    /// Environment steps simulated, up to the newest fragment of each process.
    pub env_steps: u64,
    /// Seconds of simulation, summed over actors.
    pub collect_s: f64,
}

/// Known actor.
#[derive(Clone, Debug)]
struct Actor {
    incarnation: u64,
    counted: u64,
    envs: usize,
    step_s: f64,
    /// Speed that its horizon follows.
    speed: f64,
    steps: u32,
    absent_rounds: u32,
}

/// Environments, speed and horizon of every actor.
#[derive(Debug)]
pub struct FleetPlan {
    rule: HorizonRule,
    actors: HashMap<String, Actor>,
    nominal: u32,
    effort: FleetEffort,
}

impl FleetPlan {
    /// Fleet before the first fragment, where `envs` environments are expected.
    pub fn new(rule: HorizonRule, envs: usize) -> Self {
        Self { nominal: rule.nominal(envs), rule, actors: HashMap::new(), effort: FleetEffort::default() }
    }

    /// Returns the environments of each actor that has sent a fragment.
    pub fn envs(&self) -> BTreeMap<String, u32> {
        self.actors.iter().map(|(name, actor)| (name.clone(), actor.envs as u32)).collect()
    }

    /// Returns the horizon of an actor without a receipt.
    pub fn nominal(&self) -> u32 {
        self.nominal
    }

    /// Returns the work of all actors since the learner started.
    pub fn effort(&self) -> FleetEffort {
        self.effort
    }

    /// Returns the horizon of an actor's next fragment.
    pub(super) fn steps(&self, actor: &str) -> u32 {
        self.actors.get(actor).map_or(self.nominal, |known| known.steps)
    }

    /// Returns the transitions of one fragment of every live actor.
    pub(super) fn round_transitions(&self, alive: &BTreeSet<String>) -> usize {
        let live = self.actors.iter().filter(|(name, _)| alive.contains(*name));
        live.map(|(_, actor)| actor.envs * actor.steps as usize).sum()
    }

    /// Replaces the rule, after a change of the configuration.
    pub fn set_rule(&mut self, rule: HorizonRule) {
        self.rule = rule;
    }

    /// Records a well-formed fragment, also if it came too late.
    pub(super) fn record(&mut self, actor: &str, effort: &Effort) {
        // What a sender claims must not spoil the sums for good.
        self.effort.collect_s += effort.collect_s.clamp(0.0, COLLECT_S_MAX);
        let Some(known) = self.actors.get_mut(actor) else {
            self.effort.env_steps = self.effort.env_steps.saturating_add(effort.transitions);
            if self.actors.len() < ACTORS_MAX {
                let steps = self.rule.first(self.nominal, effort.envs);
                self.actors.insert(actor.to_string(), Actor::new(effort, steps));
            }
            return;
        };
        self.effort.env_steps = self.effort.env_steps.saturating_add(known.simulated(effort));
        if known.incarnation != effort.incarnation {
            // A restarted process may have other environments.
            let steps = self.rule.fitting(known.steps, effort.envs);
            *known = Actor { speed: known.speed, ..Actor::new(effort, steps) };
            return;
        }
        known.counted = known.counted.max(effort.counted);
        known.envs = effort.envs;
        known.step_s = match (known.step_s > 0.0, effort.step_s > 0.0) {
            (true, true) => known.step_s + NEWEST_WEIGHT * (effort.step_s - known.step_s),
            _ => effort.step_s,
        };
    }

    /// Fits every horizon to the present fleet. Returns the actors whose horizon is now shorter.
    pub(super) fn plan(&mut self, alive: &BTreeSet<String>) -> Vec<String> {
        self.actors.retain(|name, actor| {
            actor.absent_rounds = if alive.contains(name) { 0 } else { actor.absent_rounds + 1 };
            actor.absent_rounds <= ABSENT_ROUNDS_MAX
        });
        let usual = self.usual_step_s();
        for actor in self.actors.values_mut() {
            let speed = match actor.step_s > 0.0 {
                true => (usual / actor.step_s).clamp(1.0 / SPEED_RATIO_MAX, SPEED_RATIO_MAX),
                false => 1.0,
            };
            if (speed / actor.speed - 1.0).abs() > SPEED_TOLERANCE {
                actor.speed = speed;
            }
        }
        let members: BTreeMap<&str, Member> =
            self.actors.iter().map(|(name, a)| (name.as_str(), Member { envs: a.envs, speed: a.speed })).collect();
        let envs = members.values().map(|member| member.envs).sum();
        let steps: Vec<(String, u32)> =
            self.rule.horizons(&members).into_iter().map(|(name, steps)| (name.to_string(), steps)).collect();
        self.nominal = self.rule.nominal(envs);
        let mut shorter = Vec::new();
        for (name, steps) in steps {
            let Some(actor) = self.actors.get_mut(&name) else { continue };
            let is_shorter = steps < actor.steps;
            actor.steps = steps;
            shorter.extend(is_shorter.then_some(name));
        }
        shorter
    }

    /// Returns the median duration of a control step.
    fn usual_step_s(&self) -> f64 {
        let mut known: Vec<f64> = self.actors.values().map(|actor| actor.step_s).filter(|s| *s > 0.0).collect();
        known.sort_unstable_by(f64::total_cmp);
        known.get(known.len().saturating_sub(1) / 2).copied().unwrap_or(1.0)
    }
}

impl Actor {
    fn new(effort: &Effort, steps: u32) -> Self {
        let Effort { incarnation, counted, envs, step_s, .. } = *effort;
        Self { incarnation, counted, envs, step_s, speed: 1.0, steps, absent_rounds: 0 }
    }

    /// Returns the environment steps simulated since the last fragment of this process.
    fn simulated(&self, effort: &Effort) -> u64 {
        match self.incarnation == effort.incarnation && self.counted > 0 && effort.counted > 0 {
            true => effort.counted.saturating_sub(self.counted),
            false => effort.transitions,
        }
    }
}

#[cfg(test)]
mod tests {
    use treadmill_config::{Config, PpoConfig};

    use super::*;

    fn fleet() -> FleetPlan {
        let ppo = PpoConfig { batch: 8192, ..PpoConfig::default() };
        let config = Config { ppo, ..Config::default() };
        FleetPlan::new(HorizonRule::new(&config, 45, 17), 64)
    }

    /// Effort of a fragment of 10 steps by 8 environments, each step taking `step_s`.
    fn effort(incarnation: u64, counted: u64, step_s: f64) -> Effort {
        Effort { incarnation, transitions: 80, counted, envs: 8, collect_s: 10.0 * step_s, step_s }
    }

    fn names(count: usize) -> BTreeSet<String> {
        (0..count).map(|i| format!("a{i}")).collect()
    }

    #[test]
    fn horizons_follow_lasting_changes_of_speed_and_ignore_noise() {
        let (mut fleet, names) = (fleet(), names(8));
        for (i, name) in names.iter().enumerate() {
            fleet.record(name, &effort(1, 80, 1.0 + 0.01 * i as f64));
        }
        fleet.plan(&names);
        assert!(names.iter().all(|name| fleet.steps(name) == 128), "noise of some percent");
        fleet.record("a7", &effort(1, 160, 3.0));
        assert_eq!(fleet.plan(&names), ["a7"]);
        assert_eq!(fleet.steps("a7"), 70, "half the speed, by the mean of 1.07 s and 3 s: 8192 / 8 / 7.5 / 2");
        assert!(fleet.steps("a0") > 128, "the others fill the batch");
    }

    #[test]
    fn a_large_actor_gets_short_fragments_before_the_first_plan() {
        let large = |incarnation| Effort { envs: 1000, transitions: 8000, ..effort(incarnation, 8000, 1.0) };
        let mut fleet = fleet();
        fleet.record("large", &large(1));
        fleet.record("grows", &effort(1, 80, 1.0));
        assert_eq!((fleet.steps("large"), fleet.steps("grows")), (8, 128));
        fleet.record("grows", &large(2));
        // 30 MiB by 437 bytes and 1000 environments.
        assert_eq!(fleet.steps("grows"), 71);
    }

    #[test]
    fn a_short_absence_changes_no_horizon() {
        let (mut fleet, all) = (fleet(), names(4));
        all.iter().for_each(|name| fleet.record(name, &effort(1, 80, 1.0)));
        fleet.plan(&all);
        let before = fleet.steps("a0");
        for _ in 0..ABSENT_ROUNDS_MAX {
            fleet.plan(&names(2));
            assert_eq!(fleet.steps("a0"), before);
        }
        fleet.plan(&all);
        fleet.plan(&names(2));
        assert_eq!(fleet.steps("a0"), before, "an actor that is back counts from the beginning");
        (0..ABSENT_ROUNDS_MAX).for_each(|_| drop(fleet.plan(&names(2))));
        assert_eq!((before, fleet.steps("a0"), fleet.nominal()), (128, 128, 128), "16 environments: 4 rounds of 128");
        assert_eq!(fleet.actors.len(), 2);
    }

    #[test]
    fn effort_counts_what_never_arrived() {
        let mut fleet = fleet();
        fleet.record("a", &effort(1, 80, 1.0));
        fleet.record("a", &effort(1, 240, 1.0));
        assert_eq!(fleet.effort(), FleetEffort { env_steps: 240, collect_s: 20.0 }, "80 steps were lost on the way");
        fleet.record("a", &effort(1, 160, 1.0));
        assert_eq!(fleet.effort().env_steps, 240, "they came later");
        fleet.record("a", &effort(2, 80, 1.0));
        fleet.record("b", &effort(1, 0, 0.0));
        fleet.record("b", &effort(1, 0, 0.0));
        assert_eq!(fleet.effort().env_steps, 240 + 80 + 160, "a restart, and a sender that does not count");
    }

    #[test]
    fn absurd_speeds_and_many_names_are_bounded() {
        let mut fleet = fleet();
        fleet.record("fast", &effort(1, 80, 1e-300));
        for i in 0..2 * ACTORS_MAX {
            fleet.record(&format!("a{i}"), &effort(1, u64::MAX, 1.0));
        }
        assert_eq!(fleet.actors.len(), ACTORS_MAX);
        fleet.plan(&names(ACTORS_MAX));
        assert!(fleet.actors.values().all(|actor| actor.steps >= 1));
    }
}
