//! Actors of the run, with their last statistics.

use std::{
    collections::{BTreeMap, BTreeSet},
    time::{Duration, Instant},
};

use treadmill_bus::{AliveView, StatsFeed};
use treadmill_proto::{ActorStats, ActorStatus, wire::PolicyVersion};

/// An actor that is gone stays in the status for this long.
const REMEMBERED: Duration = Duration::from_secs(60);
/// Actors that are remembered, and actors in a status.
const ACTORS_MAX: usize = 16_384;

/// Last statistics of each actor, and when they came.
pub struct Roster {
    alive: AliveView,
    heard: BTreeMap<String, (ActorStats, Instant)>,
    pruned: Instant,
}

impl Roster {
    /// Empty roster.
    pub fn new(alive: AliveView) -> Self {
        Self { alive, heard: BTreeMap::new(), pruned: Instant::now() }
    }

    /// Takes the actors' newest statistics.
    pub fn hear(&mut self, feed: &StatsFeed, now: Instant) {
        // The training thread reads the same feed, and logs malformed messages.
        for stats in feed.take().flatten() {
            if self.heard.len() < ACTORS_MAX || self.heard.contains_key(&stats.actor) {
                self.heard.insert(stats.actor.clone(), (stats, now));
            }
        }
        // Not each time: this visits every actor.
        if now.duration_since(self.pruned) > REMEMBERED {
            self.heard.retain(|_, (_, at)| now.duration_since(*at) < REMEMBERED);
            self.pruned = now;
        }
    }

    /// Actors that are alive, in quarantine, or were heard of lately. Lag is counted from `newest`.
    pub fn actors(&self, newest: PolicyVersion, quarantined: &[String], now: Instant) -> Vec<ActorStatus> {
        actor_statuses(&self.alive.actors(), &self.heard, newest, quarantined, now)
    }
}

fn actor_statuses(
    alive: &BTreeSet<String>,
    heard: &BTreeMap<String, (ActorStats, Instant)>,
    newest: PolicyVersion,
    quarantined: &[String],
    now: Instant,
) -> Vec<ActorStatus> {
    let lately =
        heard.iter().filter(|(_, (_, at))| now.duration_since(*at) < REMEMBERED).map(|(name, _)| name.as_str());
    let names: BTreeSet<&str> =
        alive.iter().map(String::as_str).chain(lately).chain(quarantined.iter().map(String::as_str)).collect();
    names
        .into_iter()
        .take(ACTORS_MAX)
        .map(|name| {
            let last = heard.get(name);
            let version = last.and_then(|(stats, _)| stats.version);
            ActorStatus {
                name: name.to_string(),
                alive: alive.contains(name),
                since_contact_s: last.map(|(_, at)| now.duration_since(*at).as_secs_f64()),
                quarantined: quarantined.iter().any(|held| held == name),
                // Versions of a learner that is gone cannot be counted from.
                lag_versions: version
                    .filter(|version| version.incarnation == newest.incarnation)
                    .map(|version| newest.number.saturating_sub(version.number)),
                stats: last.map(|(stats, _)| stats.clone()),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_has_living_recent_and_quarantined_actors() {
        let begun = Instant::now();
        let version = |number| PolicyVersion { incarnation: 7, number };
        let stats = |actor: &str, number| ActorStats {
            actor: actor.into(),
            version: Some(version(number)),
            ..ActorStats::default()
        };
        let heard: BTreeMap<_, _> = [("alive", 10), ("gone", 9), ("forgotten", 3)]
            .into_iter()
            .map(|(name, number)| {
                let at = if name == "forgotten" { begun } else { begun + REMEMBERED };
                (name.to_string(), (stats(name, number), at))
            })
            .collect();
        let alive = ["alive", "new"].map(String::from).into();
        let now = begun + REMEMBERED + Duration::from_secs(1);
        let statuses = actor_statuses(&alive, &heard, version(12), &["banned".to_string()], now);
        let names: Vec<&str> = statuses.iter().map(|actor| actor.name.as_str()).collect();
        assert_eq!(names, ["alive", "banned", "gone", "new"]);
        assert_eq!(
            (statuses[0].alive, statuses[0].lag_versions, statuses[0].since_contact_s),
            (true, Some(2), Some(1.0))
        );
        assert!(statuses[1].quarantined && !statuses[1].alive);
        assert_eq!((statuses[2].alive, statuses[2].lag_versions), (false, Some(3)));
        assert_eq!((statuses[3].alive, statuses[3].lag_versions, statuses[3].since_contact_s), (true, None, None));
        let successor = PolicyVersion { incarnation: 8, number: 12 };
        assert_eq!(actor_statuses(&alive, &heard, successor, &[], now)[0].lag_versions, None);
    }
}
