//! Actors of the run, with their last statistics.

use std::{
    collections::{BTreeMap, BTreeSet},
    time::{Duration, Instant},
};

use treadmill_bus::learner::{AliveView, StatsFeed};
use treadmill_proto::{ActorStats, ActorStatus, PolicyVersion};

/// An actor that has left stays in the status for this long.
const KEPT: Duration = Duration::from_secs(60);
/// Most actors in the roster, and in a status.
const ACTORS_MAX: usize = 16_384;

/// Last statistics of each actor, and when they came.
pub struct Roster {
    alive: AliveView,
    last_stats: BTreeMap<String, Contact>,
    pruned: Instant,
}

/// Statistics of an actor, when they came, and the newest version then: lag that grew since says nothing about the actor.
struct Contact {
    stats: ActorStats,
    at: Instant,
    newest: PolicyVersion,
}

impl Roster {
    /// Empty roster.
    pub fn new(alive: AliveView) -> Self {
        Self { alive, last_stats: BTreeMap::new(), pruned: Instant::now() }
    }

    /// Takes the actors' newest statistics; `newest` is the newest version.
    pub fn update(&mut self, feed: &StatsFeed, newest: PolicyVersion, now: Instant) {
        // The training thread has its own feed, and logs malformed messages.
        for stats in feed.take().flatten() {
            if self.last_stats.len() < ACTORS_MAX || self.last_stats.contains_key(&stats.actor) {
                self.last_stats.insert(stats.actor.clone(), Contact { stats, at: now, newest });
            }
        }
        // Rarely, because this visits every actor.
        if now.duration_since(self.pruned) > KEPT {
            self.last_stats.retain(|_, contact| now.duration_since(contact.at) < KEPT);
            self.pruned = now;
        }
    }

    /// Returns the actors that are alive, in quarantine, or sent statistics lately.
    pub fn actors(&self, quarantined: &[String], now: Instant) -> Vec<ActorStatus> {
        actor_statuses(&self.alive.actors(), &self.last_stats, quarantined, now)
    }
}

fn actor_statuses(
    alive: &BTreeSet<String>,
    last_stats: &BTreeMap<String, Contact>,
    quarantined: &[String],
    now: Instant,
) -> Vec<ActorStatus> {
    let recent = last_stats.iter().filter(|(_, of)| now.duration_since(of.at) < KEPT).map(|(name, _)| name.as_str());
    let names: BTreeSet<&str> =
        alive.iter().map(String::as_str).chain(recent).chain(quarantined.iter().map(String::as_str)).collect();
    names
        .into_iter()
        .take(ACTORS_MAX)
        .map(|name| {
            let last = last_stats.get(name);
            let versions = last.and_then(|of| Some((of.stats.version?, of.newest)));
            ActorStatus {
                name: name.to_string(),
                alive: alive.contains(name),
                since_contact_s: last.map(|of| now.duration_since(of.at).as_secs_f64()),
                quarantined: quarantined.iter().any(|quarantined| quarantined == name),
                // Lag is unknown for a version of an earlier learner.
                lag_versions: versions
                    .filter(|(version, newest)| version.incarnation == newest.incarnation)
                    .map(|(version, newest)| newest.number.saturating_sub(version.number)),
                stats: last.map(|of| of.stats.clone()),
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
        let version = |number| PolicyVersion { incarnation: 7, number, epoch: 0 };
        let stats = |actor: &str, number| ActorStats {
            actor: actor.into(),
            version: Some(version(number)),
            ..ActorStats::default()
        };
        let mut last_stats: BTreeMap<_, _> = [("alive", 10), ("gone", 9), ("forgotten", 3)]
            .into_iter()
            .map(|(name, number)| {
                let at = if name == "forgotten" { begun } else { begun + KEPT };
                (name.to_string(), Contact { stats: stats(name, number), at, newest: version(12) })
            })
            .collect();
        let alive = ["alive", "new"].map(String::from).into();
        let now = begun + KEPT + Duration::from_secs(1);
        let statuses = actor_statuses(&alive, &last_stats, &["banned".to_string()], now);
        let names: Vec<&str> = statuses.iter().map(|actor| actor.name.as_str()).collect();
        assert_eq!(names, ["alive", "banned", "gone", "new"]);
        assert_eq!(
            (statuses[0].alive, statuses[0].lag_versions, statuses[0].since_contact_s),
            (true, Some(2), Some(1.0))
        );
        assert!(statuses[1].quarantined && !statuses[1].alive);
        assert_eq!((statuses[2].alive, statuses[2].lag_versions), (false, Some(3)));
        assert_eq!((statuses[3].alive, statuses[3].lag_versions, statuses[3].since_contact_s), (true, None, None));
        let of_successor = PolicyVersion { incarnation: 8, number: 12, epoch: 0 };
        last_stats.get_mut("alive").unwrap().newest = of_successor;
        assert_eq!(actor_statuses(&alive, &last_stats, &[], now)[0].lag_versions, None);
    }
}
