//! State of the dashboard: all runs that answered, and the selected one.

use std::{collections::BTreeMap, time::Instant};

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
/// Metric tags of the errors in evaluations, in m/s and rad/s.
pub const VELOCITY_ERROR: &str = "eval/velocity_error";
pub const YAW_RATE_ERROR: &str = "eval/yaw_rate_error";
/// Metric tags of how motions are imitated in evaluations: share that is done, error of the links in metres.
pub const DONE_SHARE: &str = "eval/done_share";
pub const BODY_ERROR: &str = "eval/body_error";
/// Metric tag of the velocity, in m/s.
pub const VELOCITY: &str = "rollout/velocity_mean_mps";
/// Metric tag of the speed, in environment steps per second.
pub const SPEED: &str = "time/fps";
/// Tags of all curves, to which the dashboard subscribes.
pub const CURVES: [&str; 8] =
    [RETURN, DISTANCE, VELOCITY, VELOCITY_ERROR, YAW_RATE_ERROR, DONE_SHARE, BODY_ERROR, SPEED];

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
}

impl Run {
    fn new(status: RunStatus, now: Instant) -> Self {
        Self { status, answered: now, fragments: Rate::default(), bytes: Rate::default(), curves: BTreeMap::new() }
    }

    /// Returns a curve; it is empty before its first value.
    pub fn curve(&self, tag: &str) -> Curve {
        self.curves.get(tag).cloned().unwrap_or_default()
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
        if let Some(tag) = CURVES.into_iter().find(|tag| *tag == metric.tag) {
            self.curves.entry(tag).or_default().push(metric.step, metric.value);
        }
    }
}

/// Order of the table of actors.
struct ActorOrder {
    /// Word that the dashboard shows.
    name: &'static str,
    /// Number that is least for the first actor; equal ones are ordered by name.
    key: fn(&ActorStatus) -> f64,
}

/// Orders: by name, slowest first, furthest behind first, longest silent first.
const ORDERS: [ActorOrder; 4] = [
    ActorOrder { name: "name", key: |_| 0.0 },
    ActorOrder { name: "slowest", key: |a| a.stats.as_ref().map_or(f64::INFINITY, |stats| stats.env_steps_per_s) },
    ActorOrder { name: "lag", key: |a| -a.lag_versions.map_or(-1.0, |lag| lag as f64) },
    ActorOrder { name: "contact", key: |a| -a.since_contact_s.unwrap_or(-1.0) },
];

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
    /// Index of the actors' order.
    order: usize,
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
            order: 0,
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
            KeyAction::Order => self.order = (self.order + 1) % ORDERS.len(),
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

    /// Returns the name of the chosen order.
    pub fn order_name(&self) -> &'static str {
        ORDERS[self.order].name
    }

    /// Returns the actors of the selected run in the chosen order.
    pub fn actors(&self) -> Vec<&ActorStatus> {
        let mut actors: Vec<_> =
            self.selected().map(|(run, ..)| run.status.actors.iter().collect()).unwrap_or_default();
        let key = ORDERS[self.order].key;
        actors.sort_by(|a, b| key(a).total_cmp(&key(b)).then_with(|| a.name.cmp(&b.name)));
        actors
    }
}
