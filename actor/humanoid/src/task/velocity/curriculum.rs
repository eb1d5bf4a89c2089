//! Curricula of one environment: its level of difficulty on each kind of ground, and the ranges of its commands.

use rand::RngExt;

use super::command::Command;
use crate::config::{EnvironmentConfig, GroundKind};
use crate::randomisation::stream;
use crate::task::{Difficulty, Reached};

/// Numbers of [`Curriculum::save`].
pub(super) const CURRICULUM_SAVED: usize = 7 + KINDS_MAX;
/// Most kinds of tiles.
const KINDS_MAX: usize = GroundKind::NAMES.len();
/// Share of the commanded way from which the level rises, and below which it falls.
const RISE_SHARE: f64 = 0.5;
const FALL_SHARE: f64 = 0.35;
/// Commanded way from which an episode counts (m), and its greatest share of the way that an episode commands in the mean.
const COUNTED_M: f64 = 2.0;
const COUNTED_SHARE: f64 = 0.5;
/// Mean way below which commands are turns, which the tracking of episodes judges (m).
const TURNS_M: f64 = 0.1;
/// First factor on the ranges of commands, and what success adds to it.
const FACTOR_MIN: f64 = 0.4;
const FACTOR_STEP: f64 = 0.1;
/// Share of the greatest reward for tracking, and of the commanded way, from which the commands grow.
const TRACKED_SHARE: f64 = 0.7;
const WALKED_SHARE: f64 = 0.7;

/// How an episode's level of the ground is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LevelChoice {
    /// One for each kind, which rises and falls with the environment's success.
    Rising,
    /// Always the first one.
    Fixed,
    /// Each episode draws one.
    Drawn,
}

/// How an episode ended, if it has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum EpisodeEnd {
    #[default]
    None,
    Fall,
    Limit,
}

/// How an episode has gone so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Score {
    commanded_m: f64,
    /// Way in the direction of the commands.
    covered_m: f64,
    /// Sum over the steps of the share of the greatest reward for tracking.
    tracked: f64,
    steps: u32,
    end: EpisodeEnd,
}

/// Present difficulty, and what the next one depends on.
#[derive(Clone, Debug)]
pub(super) struct Curriculum {
    /// How to choose a level of the ground, and their number; `None` without levels.
    ground: Option<(LevelChoice, u32)>,
    commands_grow: bool,
    /// Way that an episode commands in the mean (m), with a factor of 1; `None` where commands are turns.
    way_m: Option<f64>,
    /// Level on each kind of tile; a kind that is harder than others does not hold them back.
    levels: [u32; KINDS_MAX],
    /// Kind of this episode's tile.
    kind: usize,
    factor: f64,
    score: Score,
}

impl Curriculum {
    /// Returns the curriculum before the first episode; `None` if there is nothing to choose.
    pub(super) fn new(config: &EnvironmentConfig) -> Option<Self> {
        let choice = match (config.ground.curriculum, config.has_curricula) {
            (true, true) => LevelChoice::Rising,
            (true, false) => LevelChoice::Drawn,
            (false, _) => LevelChoice::Fixed,
        };
        let ground = (!config.ground.kinds.is_empty()).then_some((choice, config.ground.levels));
        let commands_grow = config.has_curricula && config.velocity.command_curriculum;
        let level = if choice == LevelChoice::Drawn { 0 } else { config.ground.start_level };
        let factor = if commands_grow { FACTOR_MIN } else { 1.0 };
        let levels = [level; KINDS_MAX];
        let chosen =
            Self { ground, commands_grow, way_m: mean_way_m(config), levels, kind: 0, factor, score: Score::default() };
        (ground.is_some() || commands_grow).then_some(chosen)
    }

    pub(super) fn level(&self) -> u32 {
        self.levels[self.kind]
    }

    /// Returns the factor on the ranges of commands.
    pub(super) fn factor(&self) -> f64 {
        self.factor
    }

    pub(super) fn difficulty(&self) -> Difficulty {
        Difficulty {
            ground_kind: self.ground.map(|_| self.kind as u32),
            ground_level: self.ground.map(|_| f64::from(self.level())),
            command_factor: self.commands_grow.then_some(self.factor),
            failed_step: None,
        }
    }

    /// Begins where other environments of the run are: draws a level for each kind of ground and a factor from theirs.
    pub(super) fn adopt(&mut self, reached: &Reached<'_>, seed: u64) {
        let mut random = stream(seed, "curricula");
        if let Some((LevelChoice::Rising, levels)) = self.ground {
            for (kind, level) in self.levels.iter_mut().enumerate() {
                let pairs = reached.ground_kinds.iter().zip(reached.ground_levels);
                let known: Vec<u32> =
                    pairs.filter(|(of_kind, _)| **of_kind as usize == kind).map(|(_, level)| *level).collect();
                if !known.is_empty() {
                    *level = known[random.random_range(0..known.len())].min(levels - 1);
                }
            }
        }
        let factors = reached.command_factors;
        if self.commands_grow && !factors.is_empty() {
            self.factor = f64::from(factors[random.random_range(0..factors.len())]).clamp(FACTOR_MIN, 1.0);
        }
    }

    /// Chooses the difficulty of a new episode on this kind of tile by its seed and by how the last episodes went.
    pub(super) fn begin_episode(&mut self, seed: u64, kind: usize) {
        let last = std::mem::take(&mut self.score);
        let is_tracked = last.tracked > TRACKED_SHARE * f64::from(last.steps);
        // Small commands are tracked well enough by standing still.
        let has_walked = last.covered_m >= WALKED_SHARE * last.commanded_m;
        if self.commands_grow && last.end == EpisodeEnd::Limit && is_tracked && has_walked {
            self.factor = (self.factor + FACTOR_STEP).min(1.0);
        }
        let Some((choice, levels)) = self.ground else { return };
        let (counts, share) = match self.way_m {
            Some(way_m) => {
                let counted_m = COUNTED_M.min(COUNTED_SHARE * way_m * self.factor);
                (last.commanded_m > counted_m, last.covered_m / last.commanded_m)
            }
            None => (last.steps > 0, last.tracked / f64::from(last.steps)),
        };
        let counts = counts && last.end != EpisodeEnd::None;
        let has_failed = last.end == EpisodeEnd::Fall || counts && share < FALL_SHARE;
        let level = &mut self.levels[self.kind];
        match choice {
            LevelChoice::Rising if has_failed => *level = level.saturating_sub(1),
            LevelChoice::Rising if counts && share >= RISE_SHARE => *level = (*level + 1).min(levels - 1),
            LevelChoice::Rising | LevelChoice::Fixed | LevelChoice::Drawn => {}
        }
        self.kind = kind;
        if choice == LevelChoice::Drawn {
            self.levels[kind] = stream(seed, "ground-level").random_range(0..levels);
        }
    }

    /// Counts a control step under `command`, in which the base moved at `velocity_mps` forwards and to the left.
    /// `tracked` is the share of the greatest reward for tracking. A step that falls or reaches a limit is the last one
    /// that counts.
    pub(super) fn count(
        &mut self,
        command: &Command,
        velocity_mps: [f64; 2],
        tracked: f64,
        step_s: f64,
        [has_fallen, is_at_limit]: [bool; 2],
    ) {
        let score = &mut self.score;
        if score.end != EpisodeEnd::None {
            return;
        }
        let [x, y, _] = command.numbers();
        let speed_mps = x.hypot(y);
        if speed_mps > 0.0 {
            score.commanded_m += speed_mps * step_s;
            score.covered_m += (velocity_mps[0] * x + velocity_mps[1] * y) / speed_mps * step_s;
        }
        score.tracked += tracked;
        score.steps += 1;
        score.end = match (has_fallen, is_at_limit) {
            (true, _) => EpisodeEnd::Fall,
            (_, true) => EpisodeEnd::Limit,
            _ => EpisodeEnd::None,
        };
    }

    pub(super) fn save(&self) -> [f64; CURRICULUM_SAVED] {
        let Score { commanded_m, covered_m, tracked, steps, end } = self.score;
        let of_score = [commanded_m, covered_m, tracked, f64::from(steps), f64::from(end as u8)];
        let mut numbers = self.levels.map(f64::from).into_iter().chain([self.kind as f64, self.factor]).chain(of_score);
        std::array::from_fn(|_| numbers.next().expect("as many as are saved"))
    }

    pub(super) fn restore(&mut self, numbers: [f64; CURRICULUM_SAVED]) {
        let (levels, rest) = numbers.split_at(KINDS_MAX);
        let &[kind, factor, commanded_m, covered_m, tracked, steps, end] = rest else { return };
        let last = self.ground.map_or(0, |(_, levels)| levels - 1);
        for (level, saved) in self.levels.iter_mut().zip(levels) {
            *level = (*saved as u32).min(last);
        }
        self.kind = (kind as usize).min(KINDS_MAX - 1);
        self.factor = factor.clamp(if self.commands_grow { FACTOR_MIN } else { 1.0 }, 1.0);
        let end = match end as u8 {
            0 => EpisodeEnd::None,
            1 => EpisodeEnd::Fall,
            _ => EpisodeEnd::Limit,
        };
        self.score = Score { commanded_m, covered_m, tracked, steps: steps as u32, end };
    }
}

/// Returns the way that an episode commands in the mean (m); `None` where its commands are turns.
fn mean_way_m(config: &EnvironmentConfig) -> Option<f64> {
    let way_m = config.velocity.mean_speed_mps() * f64::from(config.env.max_episode_steps) * config.env.control_step_s;
    (way_m >= TURNS_M).then_some(way_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{GroundConfig, GroundKind, VelocityConfig};

    fn curriculum(choice: LevelChoice, start_level: u32) -> Curriculum {
        let curriculum = choice != LevelChoice::Fixed;
        let kinds = vec![GroundKind::Slope];
        let ground = GroundConfig { kinds, levels: 4, curriculum, start_level, ..GroundConfig::default() };
        let velocity = VelocityConfig { command_curriculum: true, ..VelocityConfig::default() };
        let has_curricula = choice != LevelChoice::Drawn;
        Curriculum::new(&EnvironmentConfig { has_curricula, ground, velocity, ..EnvironmentConfig::default() }).unwrap()
    }

    /// Plays 4 s at a command of 1 m/s to the left, of which `share` is covered, and begins the next episode.
    fn play(curriculum: &mut Curriculum, share: f64, tracked: f64, has_fallen: bool, seed: u64) {
        let command = Command { lin_vel_y_mps: 1.0, ..Command::default() };
        for step in 1..=200 {
            let ends = [has_fallen && step == 200, step == 200];
            curriculum.count(&command, [5.0, share], tracked, 0.02, ends);
        }
        curriculum.begin_episode(seed, 0);
    }

    #[test]
    fn the_level_rises_with_the_way_covered_and_falls_with_falls() {
        let mut rising = curriculum(LevelChoice::Rising, 1);
        rising.begin_episode(1, 0);
        assert_eq!(rising.level(), 1, "the first episode");
        for (share, has_fallen, level) in
            [(0.51, false, 2), (0.49, false, 2), (0.36, false, 2), (0.34, false, 1), (0.9, true, 0), (0.1, false, 0)]
        {
            play(&mut rising, share, 0.0, has_fallen, 7);
            assert_eq!(rising.level(), level, "{share} {has_fallen}");
        }
        // A short way says nothing, and neither does an episode without an end.
        let command = Command { lin_vel_x_mps: 1.0, ..Command::default() };
        rising.count(&command, [1.0, 0.0], 1.0, 1.0, [false, true]);
        rising.begin_episode(2, 0);
        assert_eq!(rising.level(), 0);
        rising.count(&command, [1.0, 0.0], 1.0, 10.0, [false, false]);
        rising.begin_episode(3, 0);
        assert_eq!(rising.level(), 0);
    }

    #[test]
    fn slow_commands_and_turns_raise_the_level_too() {
        let slow = |range, speed_mps, covered_mps, tracked| {
            let velocity =
                VelocityConfig { lin_vel_x_mps: range, lin_vel_y_mps: [0.0; 2], ..VelocityConfig::default() };
            let ground = GroundConfig { kinds: vec![GroundKind::Slope], levels: 4, ..GroundConfig::default() };
            let config = EnvironmentConfig { velocity, ground, has_curricula: true, ..EnvironmentConfig::default() };
            let mut rising = Curriculum::new(&config).unwrap();
            let command = Command { lin_vel_x_mps: speed_mps, ang_vel_z_radps: 0.3, ..Command::default() };
            // An episode of the default length, 15 s.
            (1..=1000)
                .for_each(|step| rising.count(&command, [covered_mps, 0.0], tracked, 0.015, [false, step == 1000]));
            rising.begin_episode(1, 0);
            rising.level()
        };
        assert_eq!(slow([0.0, 0.1], 0.05, 0.04, 0.0), 1, "0.75 m commanded");
        assert_eq!(slow([0.0, 0.1], 0.05, 0.02, 1.0), 0, "less than half of it covered");
        assert_eq!(slow([0.0, 0.1], 0.02, 0.02, 1.0), 0, "0.3 m, less than half of the mean, says little");
        assert_eq!((slow([0.0; 2], 0.0, 0.0, 0.9), slow([0.0; 2], 0.0, 0.0, 0.4)), (1, 0), "turns on the spot");
    }

    #[test]
    fn new_environments_begin_where_others_are() {
        let reached = Reached {
            ground_kinds: &[0, 0, 0, 2, 9],
            ground_levels: &[1, 2, 99, 3, 3],
            command_factors: &[0.5, 0.75, 7.0],
            failed_steps: &[],
        };
        let (mut levels, mut factors) = (Vec::new(), Vec::new());
        for seed in 0..100 {
            let mut rising = curriculum(LevelChoice::Rising, 0);
            rising.adopt(&reached, seed);
            assert_eq!(rising.levels[1..3], [0, 3], "of a kind without episodes, and of one");
            levels.push(rising.levels[0]);
            factors.push(rising.factor());
        }
        for level in [1, 2, 3] {
            assert!(levels.iter().filter(|found| **found == level).count() > 15, "{levels:?}");
        }
        assert!([0.5, 0.75, 1.0].iter().all(|factor| factors.contains(factor)), "{factors:?}");
        assert!(factors.iter().all(|factor| [0.5, 0.75, 1.0].contains(factor)), "{factors:?}");
        // Without any, and where levels do not rise, all begins as before.
        let mut fresh = curriculum(LevelChoice::Rising, 1);
        fresh.adopt(&Reached::default(), 1);
        assert_eq!((fresh.level(), fresh.factor()), (1, FACTOR_MIN));
        let mut fixed = curriculum(LevelChoice::Fixed, 1);
        fixed.adopt(&reached, 1);
        assert_eq!(fixed.levels, [1; KINDS_MAX]);
    }

    #[test]
    fn each_kind_has_a_level_of_its_own() {
        let mut rising = curriculum(LevelChoice::Rising, 1);
        for (kind, next, has_fallen, level) in [(0, 2, false, 1), (2, 0, true, 2), (0, 2, false, 0), (2, 0, false, 3)] {
            rising.kind = kind;
            let command = Command { lin_vel_x_mps: 1.0, ..Command::default() };
            rising.count(&command, [1.0, 0.0], 0.0, 4.0, [has_fallen, true]);
            rising.begin_episode(1, next);
            assert_eq!(rising.level(), level, "of kind {next} after kind {kind}");
        }
    }

    #[test]
    fn success_on_the_last_level_stays_there() {
        let mut last = curriculum(LevelChoice::Rising, 2);
        for (share, level) in [(1.0, 3), (1.0, 3), (0.1, 2)] {
            play(&mut last, share, 1.0, false, 1);
            assert_eq!(last.level(), level, "{share}");
        }
    }

    #[test]
    fn fixed_and_drawn_levels_do_not_depend_on_success() {
        let mut fixed = curriculum(LevelChoice::Fixed, 2);
        play(&mut fixed, 1.0, 1.0, false, 1);
        assert_eq!(fixed.level(), 2);
        let (mut one, mut other) = (curriculum(LevelChoice::Drawn, 0), curriculum(LevelChoice::Drawn, 0));
        for seed in 0..20 {
            play(&mut one, 1.0, 1.0, false, seed);
            play(&mut other, 0.0, 0.0, true, seed);
            assert_eq!(one.level(), other.level());
        }
    }

    #[test]
    fn commands_grow_with_success_and_never_shrink() {
        let mut growing = curriculum(LevelChoice::Fixed, 0);
        assert_eq!(growing.factor(), 0.4);
        for (share, tracked, has_fallen, factor) in [
            (1.0, 0.69, false, 0.4),
            (1.0, 0.9, true, 0.4),
            (0.69, 0.9, false, 0.4),
            (0.71, 0.71, false, 0.5),
            (1.0, 0.0, true, 0.5),
        ] {
            play(&mut growing, share, tracked, has_fallen, 1);
            assert!((growing.factor() - factor).abs() < 1e-12, "{share} {tracked} {has_fallen}");
        }
        for _ in 0..10 {
            play(&mut growing, 1.0, 1.0, false, 1);
        }
        assert_eq!(growing.factor(), 1.0);
    }

    #[test]
    fn a_saved_curriculum_goes_on_as_it_was() {
        let mut original = curriculum(LevelChoice::Rising, 2);
        play(&mut original, 1.0, 1.0, false, 1);
        let command = Command { lin_vel_x_mps: 1.0, ..Command::default() };
        original.count(&command, [0.2, 0.0], 0.5, 4.0, [false, true]);
        let mut other = curriculum(LevelChoice::Rising, 0);
        other.restore(original.save());
        assert_eq!(other.save(), original.save());
        original.begin_episode(3, 0);
        other.begin_episode(3, 0);
        assert_eq!((other.level(), other.factor()), (2, 0.5));
        assert_eq!(other.save(), original.save());
    }
}
