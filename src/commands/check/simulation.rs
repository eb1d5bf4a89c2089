//! Whether physics computes on this machine what it does elsewhere: a second of a falling humanoid, twice.

use treadmill_humanoid::{CONTROL_STEP_S, Environment, EnvironmentConfig, HUMANOID_XML};
use treadmill_runtime::seeds;

use super::finding::Finding;

const NAME: &str = "simulation";

/// A second.
const STEPS: usize = (1.0 / CONTROL_STEP_S) as usize;
/// After so many of them rounding, which may differ from machine to machine, has not grown to anything yet.
const EARLY_STEPS: usize = 10;
/// Height of the torso then (m), and how far it may be off.
const EARLY_HEIGHT_M: f64 = 1.264_441_130_560;
const OFF_MAX_M: f64 = 1e-6;

/// What a simulation gives.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Played {
    early_height_m: f64,
    is_finite: bool,
    checksum: u64,
}

/// Simulates.
pub fn diagnose() -> Finding {
    let played = play().and_then(|one| Ok((one, play()?)));
    assess(played.map_err(|why| why.to_string()))
}

fn assess(played: Result<(Played, Played), String>) -> Finding {
    let wrong = |seen: String| {
        let remedy =
            "this processor or this build computes wrongly: build anew on this machine, test its memory, and report it";
        Finding::problem(NAME, seen, remedy)
    };
    let (one, other) = match played {
        Ok(both) => both,
        Err(why) => return wrong(format!("it cannot begin: {why}")),
    };
    let off_m = (one.early_height_m - EARLY_HEIGHT_M).abs();
    if !one.is_finite || !other.is_finite {
        wrong("a second of it gave numbers that are not finite".to_string())
    } else if one.checksum != other.checksum {
        wrong(format!("the same second gave {:016x} and then {:016x}", one.checksum, other.checksum))
    } else if off_m.is_nan() || off_m > OFF_MAX_M {
        wrong(format!("the torso is {off_m:e} m off where it is known to be"))
    } else {
        Finding::ok(NAME, format!("a second of it, twice the same: {:016x}", one.checksum))
    }
}

fn play() -> anyhow::Result<Played> {
    let config = EnvironmentConfig { terminate_when_unhealthy: false, ..EnvironmentConfig::default() };
    let mut environment = Environment::new(&config, HUMANOID_XML)?;
    let mut observation = vec![0.0; environment.observation_size()];
    let (mut action, mut shares) = (vec![0.0; environment.action_size()], vec![0.0; environment.action_size()]);
    environment.try_reset(1, &mut observation)?;
    let (mut early_height_m, mut is_finite, mut bytes) = (f64::NAN, true, Vec::new());
    for step in 1..=STEPS {
        for (index, share) in shares.iter_mut().enumerate() {
            *share = (step as f32 * 0.3 + index as f32).sin() * 0.5;
        }
        environment.action_from_shares(&shares, &mut action);
        let taken = environment.try_step(&action, &mut observation)?;
        is_finite &= taken.reward.is_finite() && observation.iter().all(|entry| entry.is_finite());
        bytes.extend(observation.iter().flat_map(|entry| entry.to_le_bytes()));
        if step == EARLY_STEPS {
            early_height_m = environment.physics().torso_height_m();
        }
    }
    Ok(Played { early_height_m, is_finite, checksum: seeds::checksum(&[&bytes]) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn wrong_numbers_are_told_by_how_they_are_wrong() {
        let sound = play().unwrap();
        assert_eq!(assess(Ok((sound, sound))).severity, Severity::Ok, "{sound:?}");
        let seen = |one, other| {
            let found = assess(Ok((one, other)));
            assert_eq!(found.severity, Severity::Problem);
            found.seen
        };
        let endless = Played { is_finite: false, ..sound };
        assert!(seen(endless, sound).contains("not finite"));
        let other = Played { checksum: !sound.checksum, ..sound };
        assert!(seen(sound, other).contains("and then"));
        let lower = Played { early_height_m: sound.early_height_m - 0.001, ..sound };
        assert!(seen(lower, lower).contains("m off"));
        assert!(assess(Err("no model".to_string())).seen.contains("no model"));
    }
}
