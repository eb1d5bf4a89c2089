//! Who was heard of, and when.

use std::{
    collections::{BTreeMap, BTreeSet},
    time::{Duration, Instant},
};

use treadmill_bus::{AliveView, StatsFeed};
use treadmill_proto::{ActorStats, ActorStatus, wire::PolicyVersion};

/// Somebody who is gone is still told of for so long.
const REMEMBERED: Duration = Duration::from_secs(60);
/// Actors that are remembered and told of.
const ACTORS_MAX: usize = 16_384;

/// What each actor last told, and when.
pub struct Roster {
    alive: AliveView,
    heard: BTreeMap<String, (ActorStats, Instant)>,
    sorted_out: Instant,
}

impl Roster {
    /// Nobody was heard yet.
    pub fn new(alive: AliveView) -> Self {
        Self { alive, heard: BTreeMap::new(), sorted_out: Instant::now() }
    }

    /// Takes note of what actors told about themselves.
    pub fn hear(&mut self, feed: &StatsFeed, now: Instant) {
        // What is wrong with others the training thread says, which hears them, too.
        for stats in feed.take().flatten() {
            if self.heard.len() < ACTORS_MAX || self.heard.contains_key(&stats.actor) {
                self.heard.insert(stats.actor.clone(), (stats, now));
            }
        }
        // Not each time: it looks at everybody.
        if now.duration_since(self.sorted_out) > REMEMBERED {
            self.heard.retain(|_, (_, at)| now.duration_since(*at) < REMEMBERED);
            self.sorted_out = now;
        }
    }

    /// Everybody who is alive or was heard of lately. `newest` is the policy that lag is counted from.
    pub fn actors(&self, newest: PolicyVersion, quarantined: &[String], now: Instant) -> Vec<ActorStatus> {
        tell(&self.alive.actors(), &self.heard, newest, quarantined, now)
    }
}

fn tell(
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
            let told = heard.get(name);
            let version = told.and_then(|(stats, _)| stats.version);
            ActorStatus {
                name: name.to_string(),
                alive: alive.contains(name),
                since_contact_s: told.map(|(_, at)| now.duration_since(*at).as_secs_f64()),
                quarantined: quarantined.iter().any(|held| held == name),
                // Versions of a learner that is gone cannot be counted from.
                lag_versions: version
                    .filter(|version| version.incarnation == newest.incarnation)
                    .map(|version| newest.number.saturating_sub(version.number)),
                stats: told.map(|(stats, _)| stats.clone()),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_living_the_recent_and_the_banned_are_told_of() {
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
        let told = tell(&alive, &heard, version(12), &["banned".to_string()], now);
        let names: Vec<&str> = told.iter().map(|actor| actor.name.as_str()).collect();
        assert_eq!(names, ["alive", "banned", "gone", "new"]);
        assert_eq!((told[0].alive, told[0].lag_versions, told[0].since_contact_s), (true, Some(2), Some(1.0)));
        assert!(told[1].quarantined && !told[1].alive);
        assert_eq!((told[2].alive, told[2].lag_versions), (false, Some(3)));
        assert_eq!((told[3].alive, told[3].lag_versions, told[3].since_contact_s), (true, None, None));
        let successor = PolicyVersion { incarnation: 8, number: 12 };
        assert_eq!(tell(&alive, &heard, successor, &[], now)[0].lag_versions, None);
    }
}
