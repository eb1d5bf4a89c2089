//! What the dashboard knows: every run that answered, and which of them is looked at.

use std::{cmp::Ordering, collections::BTreeMap, time::Instant};

use treadmill_proto::{ActorStatus, RunStatus, json::Metric};

use super::{
    history::{Curve, Rate},
    keys::Action,
};

/// Runs that are remembered; of more, those that answer first.
const RUNS_MAX: usize = 64;

/// Curves that are drawn, by the tag of their metric.
pub const RETURN: &str = "rollout/ep_rew_mean";
/// Metres forward.
pub const DISTANCE: &str = "rollout/distance_mean_m";
/// Metres per second.
pub const VELOCITY: &str = "rollout/velocity_mean_mps";
/// Environment steps per second.
pub const SPEED: &str = "time/fps";
/// Share of the last batch by how many versions it lagged behind: 0 to 4, and 5 or more.
pub const LAGS: [&str; 6] = [
    "bus/policy_lag_0_share",
    "bus/policy_lag_1_share",
    "bus/policy_lag_2_share",
    "bus/policy_lag_3_share",
    "bus/policy_lag_4_share",
    "bus/policy_lag_5_up_share",
];

/// Versions that the last batch lagged behind on average.
pub const LAG_MEAN: &str = "bus/policy_lag_mean";
/// Those of the curves.
pub const CURVES: [&str; 4] = [RETURN, DISTANCE, VELOCITY, SPEED];

/// Every tag that the dashboard listens to.
pub fn tags() -> Vec<&'static str> {
    CURVES.into_iter().chain(LAGS).chain([LAG_MEAN]).collect()
}

/// One run.
#[derive(Clone, Debug)]
pub struct Run {
    /// What its learner last answered.
    pub status: RunStatus,
    /// When.
    pub answered: Instant,
    /// Fragments per second.
    pub fragments: Rate,
    /// Bytes per second.
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

    /// One of the curves; an empty one where nothing was told yet.
    pub fn curve(&self, tag: &str) -> Curve {
        self.curves.get(tag).cloned().unwrap_or_default()
    }

    /// The histogram of lags, once it was told.
    pub fn lags(&self) -> Option<[f64; LAGS.len()]> {
        let told = self.lags.map(|share| share.unwrap_or_default());
        self.lags.iter().any(Option::is_some).then_some(told)
    }

    /// Of the same batch as the histogram, as far as that is known.
    pub fn lag_mean(&self) -> f64 {
        self.lag_mean.unwrap_or(self.status.policy_lag_mean)
    }

    fn answer(&mut self, status: RunStatus, began: Instant, now: Instant) {
        let at_s = now.duration_since(began).as_secs_f64();
        self.fragments.push(at_s, status.accepted as f64);
        self.bytes.push(at_s, status.accepted_bytes as f64);
        let told = [
            (RETURN, status.return_mean),
            (DISTANCE, status.distance_mean_m),
            (VELOCITY, status.velocity_mean_mps),
            (SPEED, (status.updates > 0).then_some(status.env_steps_per_s)),
        ];
        for (tag, value) in told {
            if let Some(value) = value {
                self.curves.entry(tag).or_default().push(status.env_steps, value);
            }
        }
        (self.status, self.answered) = (status, now);
    }

    fn measure(&mut self, metric: &Metric) {
        if let Some(lag) = LAGS.iter().position(|tag| *tag == metric.tag) {
            self.lags[lag] = Some(metric.value.clamp(0.0, 1.0));
        } else if metric.tag == LAG_MEAN {
            self.lag_mean = Some(metric.value);
        } else if let Some(tag) = CURVES.into_iter().find(|tag| *tag == metric.tag) {
            self.curves.entry(tag).or_default().push(metric.step, metric.value);
        }
    }
}

/// What the table of actors is ordered by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Names, as the learner has them.
    #[default]
    Name,
    /// Slowest first.
    Speed,
    /// Furthest behind first.
    Lag,
    /// Longest silent first.
    Contact,
}

impl Order {
    fn next(self) -> Self {
        match self {
            Self::Name => Self::Speed,
            Self::Speed => Self::Lag,
            Self::Lag => Self::Contact,
            Self::Contact => Self::Name,
        }
    }

    /// In a word.
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

/// Every run, and what of them is looked at.
#[derive(Clone, Debug)]
pub struct Fleet {
    began: Instant,
    runs: Vec<Run>,
    selected: usize,
    /// The first actor that is shown.
    scroll: usize,
    /// Actors that there was room for when they were last drawn.
    visible_rows: usize,
    /// What the actors are ordered by.
    pub order: Order,
    /// Whether the keys are explained.
    pub helps: bool,
    /// Why nobody answers now.
    pub silence: Option<String>,
}

impl Fleet {
    /// Nobody has answered yet.
    pub fn new(now: Instant) -> Self {
        Self {
            began: now,
            runs: Vec::new(),
            selected: 0,
            scroll: 0,
            visible_rows: 1,
            order: Order::default(),
            helps: false,
            silence: None,
        }
    }

    /// The run that is looked at, as which of how many.
    pub fn selected(&self) -> Option<(&Run, usize, usize)> {
        self.runs.get(self.selected).map(|run| (run, self.selected + 1, self.runs.len()))
    }

    /// Takes answers in; runs that did not answer keep what they last said.
    pub fn answer(&mut self, answers: Vec<RunStatus>, now: Instant) {
        self.silence = None;
        let looked_at = self.selected().map(|(run, ..)| run.status.run.clone());
        for status in answers {
            match self.runs.binary_search_by(|run| run.status.run.cmp(&status.run)) {
                Ok(known) => self.runs[known].answer(status, self.began, now),
                Err(place) if self.runs.len() < RUNS_MAX => {
                    self.runs.insert(place, Run::new(status.clone(), now));
                    self.runs[place].answer(status, self.began, now);
                }
                Err(_) => {}
            }
        }
        // Others may have come before it.
        let place = |name: String| self.runs.iter().position(|run| run.status.run == name);
        self.selected = looked_at.and_then(place).unwrap_or_default();
    }

    /// Takes a metric in, where its run is known.
    pub fn measure(&mut self, metric: &Metric) {
        if let Ok(known) = self.runs.binary_search_by(|run| run.status.run.cmp(&metric.run)) {
            self.runs[known].measure(metric);
        }
    }

    /// Does what a key stands for, but for quitting.
    pub fn act(&mut self, action: Action) {
        let page = self.visible_rows.max(1);
        match action {
            Action::Help => self.helps = !self.helps,
            Action::Back => self.helps = false,
            Action::NextRun | Action::PreviousRun if self.runs.is_empty() => {}
            Action::NextRun => self.select((self.selected + 1) % self.runs.len()),
            Action::PreviousRun => self.select((self.selected + self.runs.len() - 1) % self.runs.len()),
            Action::Order => self.order = self.order.next(),
            Action::Up => self.scroll = self.scroll.saturating_sub(1),
            Action::Down => self.scroll += 1,
            Action::PageUp => self.scroll = self.scroll.saturating_sub(page),
            Action::PageDown => self.scroll += page,
            Action::First => self.scroll = 0,
            Action::Last => self.scroll = usize::MAX / 2,
            Action::Quit => {}
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

    /// The actors of the run that is looked at, in the order that was chosen.
    pub fn actors(&self) -> Vec<&ActorStatus> {
        let mut actors: Vec<_> =
            self.selected().map(|(run, ..)| run.status.actors.iter().collect()).unwrap_or_default();
        actors.sort_by(|a, b| self.order.compare(a, b));
        actors
    }
}
