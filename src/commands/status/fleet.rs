//! State of the dashboard: all runs that answered, and the selected one.

use std::{cmp::Ordering, collections::BTreeMap, time::Instant};

use treadmill_proto::{ActorStatus, RunStatus, json::Metric};

use super::{
    history::{Curve, Rate},
    keys::KeyAction,
};

/// Most runs that are kept; further ones are ignored.
const RUNS_MAX: usize = 64;

/// Metric tag of the curve of returns.
pub const RETURN: &str = "rollout/ep_rew_mean";
/// Metric tag of the distance walked, in metres.
pub const DISTANCE: &str = "rollout/distance_mean_m";
/// Metric tag of the velocity, in m/s.
pub const VELOCITY: &str = "rollout/velocity_mean_mps";
/// Metric tag of the speed, in environment steps per second.
pub const SPEED: &str = "time/fps";
/// Metric tags of the last batch's shares by policy lag: 0 to 4 versions, and 5 or more.
pub const LAGS: [&str; 6] = [
    "bus/policy_lag_0_share",
    "bus/policy_lag_1_share",
    "bus/policy_lag_2_share",
    "bus/policy_lag_3_share",
    "bus/policy_lag_4_share",
    "bus/policy_lag_5_up_share",
];

/// Metric tag of the last batch's mean policy lag, in versions.
pub const LAG_MEAN: &str = "bus/policy_lag_mean";
/// Tags of all curves.
pub const CURVES: [&str; 4] = [RETURN, DISTANCE, VELOCITY, SPEED];

/// Returns every tag that the dashboard subscribes to.
pub fn tags() -> Vec<&'static str> {
    CURVES.into_iter().chain(LAGS).chain([LAG_MEAN]).collect()
}

/// State of one run.
#[derive(Clone, Debug)]
pub struct Run {
    /// Last answer of its learner.
    pub status: RunStatus,
    /// Time of that answer.
    pub answered: Instant,
    /// Accepted fragments per second.
    pub fragments: Rate,
    /// Accepted bytes per second.
    pub bytes: Rate,
    curves: BTreeMap<&'static str, Curve>,
    lags: [Option<f64>; LAGS.len()],
    lag_mean: Option<f64>,
}

impl Run {
    fn new(status: RunStatus, now: Instant) -> Self {
        Self {
            status,
            answered: now,
            fragments: Rate::default(),
            bytes: Rate::default(),
            curves: BTreeMap::new(),
            lags: [None; LAGS.len()],
            lag_mean: None,
        }
    }

    /// Returns a curve; it is empty before its first value.
    pub fn curve(&self, tag: &str) -> Curve {
        self.curves.get(tag).cloned().unwrap_or_default()
    }

    /// Returns the histogram of lags once a share is known.
    pub fn lags(&self) -> Option<[f64; LAGS.len()]> {
        let shares = self.lags.map(|share| share.unwrap_or_default());
        self.lags.iter().any(Option::is_some).then_some(shares)
    }

    /// Returns the mean lag, of the histogram's batch if known.
    pub fn lag_mean(&self) -> f64 {
        self.lag_mean.unwrap_or(self.status.policy_lag_mean)
    }

    fn apply_status(&mut self, status: RunStatus, began: Instant, now: Instant) {
        let at_s = now.duration_since(began).as_secs_f64();
        self.fragments.push(at_s, status.accepted as f64);
        self.bytes.push(at_s, status.accepted_bytes as f64);
        let values = [
            (RETURN, status.return_mean),
            (DISTANCE, status.distance_mean_m),
            (VELOCITY, status.velocity_mean_mps),
            (SPEED, (status.updates > 0).then_some(status.env_steps_per_s)),
        ];
        for (tag, value) in values {
            if let Some(value) = value {
                self.curves.entry(tag).or_default().push(status.env_steps, value);
            }
        }
        (self.status, self.answered) = (status, now);
    }

    fn apply_metric(&mut self, metric: &Metric) {
        if let Some(lag) = LAGS.iter().position(|tag| *tag == metric.tag) {
            self.lags[lag] = Some(metric.value.clamp(0.0, 1.0));
        } else if metric.tag == LAG_MEAN {
            self.lag_mean = Some(metric.value);
        } else if let Some(tag) = CURVES.into_iter().find(|tag| *tag == metric.tag) {
            self.curves.entry(tag).or_default().push(metric.step, metric.value);
        }
    }
}

/// Sort order of the table of actors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ActorOrder {
    /// By name.
    #[default]
    Name,
    /// Slowest first.
    Speed,
    /// Furthest behind first.
    Lag,
    /// Longest silent first.
    Contact,
}

impl ActorOrder {
    fn next(self) -> Self {
        match self {
            Self::Name => Self::Speed,
            Self::Speed => Self::Lag,
            Self::Lag => Self::Contact,
            Self::Contact => Self::Name,
        }
    }

    /// Returns the word that the dashboard shows.
    pub fn name(self) -> &'static str {
        match self {
            Self::Name => "name",
            Self::Speed => "slowest",
            Self::Lag => "lag",
            Self::Contact => "contact",
        }
    }

    fn compare(self, a: &ActorStatus, b: &ActorStatus) -> Ordering {
        let speed = |actor: &ActorStatus| actor.stats.as_ref().map_or(f64::INFINITY, |stats| stats.env_steps_per_s);
        let contact = |actor: &ActorStatus| actor.since_contact_s.unwrap_or(-1.0);
        let first = match self {
            Self::Name => Ordering::Equal,
            Self::Speed => speed(a).total_cmp(&speed(b)),
            Self::Lag => b.lag_versions.cmp(&a.lag_versions),
            Self::Contact => contact(b).total_cmp(&contact(a)),
        };
        first.then_with(|| a.name.cmp(&b.name))
    }
}

/// All runs, the selected one and the scroll position.
#[derive(Clone, Debug)]
pub struct Fleet {
    began: Instant,
    runs: Vec<Run>,
    selected: usize,
    /// Index of the first actor shown.
    scroll: usize,
    /// Rows of the table when it was last drawn.
    visible_rows: usize,
    /// Order of the actors.
    pub order: ActorOrder,
    /// Whether the help is shown.
    pub shows_help: bool,
    /// Why no learner answers now.
    pub silence: Option<String>,
}

impl Fleet {
    /// Creates a state without runs.
    pub fn new(now: Instant) -> Self {
        Self {
            began: now,
            runs: Vec::new(),
            selected: 0,
            scroll: 0,
            visible_rows: 1,
            order: ActorOrder::default(),
            shows_help: false,
            silence: None,
        }
    }

    /// Returns the selected run, its number from 1, and the number of runs.
    pub fn selected(&self) -> Option<(&Run, usize, usize)> {
        self.runs.get(self.selected).map(|run| (run, self.selected + 1, self.runs.len()))
    }

    /// Applies answers; other runs keep their last status.
    pub fn apply_statuses(&mut self, answers: Vec<RunStatus>, now: Instant) {
        self.silence = None;
        let selected = self.selected().map(|(run, ..)| run.status.run.clone());
        for status in answers {
            match self.runs.binary_search_by(|run| run.status.run.cmp(&status.run)) {
                Ok(known) => self.runs[known].apply_status(status, self.began, now),
                Err(place) if self.runs.len() < RUNS_MAX => {
                    self.runs.insert(place, Run::new(status.clone(), now));
                    self.runs[place].apply_status(status, self.began, now);
                }
                Err(_) => {}
            }
        }
        // New runs may precede the selected one.
        let place = |name: String| self.runs.iter().position(|run| run.status.run == name);
        self.selected = selected.and_then(place).unwrap_or_default();
    }

    /// Applies a metric of a known run.
    pub fn apply_metric(&mut self, metric: &Metric) {
        if let Ok(known) = self.runs.binary_search_by(|run| run.status.run.cmp(&metric.run)) {
            self.runs[known].apply_metric(metric);
        }
    }

    /// Applies the action of a key, except for quitting.
    pub fn act(&mut self, action: KeyAction) {
        let page = self.visible_rows.max(1);
        match action {
            KeyAction::Help => self.shows_help = !self.shows_help,
            KeyAction::Back => self.shows_help = false,
            KeyAction::NextRun | KeyAction::PreviousRun if self.runs.is_empty() => {}
            KeyAction::NextRun => self.select((self.selected + 1) % self.runs.len()),
            KeyAction::PreviousRun => self.select((self.selected + self.runs.len() - 1) % self.runs.len()),
            KeyAction::Order => self.order = self.order.next(),
            KeyAction::Up => self.scroll = self.scroll.saturating_sub(1),
            KeyAction::Down => self.scroll += 1,
            KeyAction::PageUp => self.scroll = self.scroll.saturating_sub(page),
            KeyAction::PageDown => self.scroll += page,
            KeyAction::First => self.scroll = 0,
            KeyAction::Last => self.scroll = usize::MAX / 2,
            KeyAction::Quit => {}
        }
        self.show(self.visible_rows);
    }

    fn select(&mut self, run: usize) {
        (self.selected, self.scroll) = (run, 0);
    }

    /// Sets how many actors fit on the screen, and returns the index of the first one to show.
    pub fn show(&mut self, visible_rows: usize) -> usize {
        let actors = self.selected().map_or(0, |(run, ..)| run.status.actors.len());
        self.visible_rows = visible_rows;
        self.scroll = self.scroll.min(actors.saturating_sub(visible_rows));
        self.scroll
    }

    /// Returns the actors of the selected run in the chosen order.
    pub fn actors(&self) -> Vec<&ActorStatus> {
        let mut actors: Vec<_> =
            self.selected().map(|(run, ..)| run.status.actors.iter().collect()).unwrap_or_default();
        actors.sort_by(|a, b| self.order.compare(a, b));
        actors
    }
}
