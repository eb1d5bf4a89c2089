//! Statuses for tests of drawing: a sound one, and hostile ones.

use proptest::prelude::*;
use treadmill_proto::{ActorStats, ActorStatus, PartTime, Phase, PolicyVersion, PoolDemand, RunStatus};

/// Returns a run halfway through, with this many actors.
pub fn run(name: &str, actors: usize) -> RunStatus {
    let version = |number| Some(PolicyVersion::new(7, number));
    let actors = (0..actors).map(|number| ActorStatus {
        name: format!("actor-{number}"),
        alive: number != 2,
        since_contact_s: Some(0.25 * number as f64),
        quarantined: number == 1,
        lag_versions: Some(number as u64 % 4),
        stats: Some(ActorStats {
            actor: format!("actor-{number}"),
            host: format!("host-{}", number / 4),
            version: version(512 - number as u64 % 4),
            program_version: "0.1.0".into(),
            envs: 32,
            env_steps_per_s: 1000.0 + number as f64,
            dropped_by_rule: 3,
            resent: 1,
            resident_bytes: 39_000_000,
            ..ActorStats::default()
        }),
    });
    RunStatus {
        run: name.into(),
        phase: Phase::Training.into(),
        version: version(512),
        host: "workhorse".into(),
        pid: 4711,
        program_version: "0.1.0".into(),
        env_steps: 4_194_304,
        env_steps_wanted: 8_000_000,
        updates: 512,
        wall_s: 180.0,
        env_steps_per_s: 22_908.0,
        since_update_s: 0.3,
        return_mean: Some(5892.0),
        length_mean: Some(941.0),
        distance_mean_m: Some(18.3),
        velocity_mean_mps: Some(1.3),
        policy_lag_mean: 1.02,
        resident_bytes: 63_100_000,
        accepted: 970,
        time_unix_s: 1.7e9,
        accepted_bytes: 970_000_000,
        too_old: 5,
        actors: actors.collect(),
        ..RunStatus::default()
    }
}

/// Any `f64`, NaN and infinities included.
fn numbers() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits)
}

/// Text that might move the cursor or fill the screen.
fn names() -> impl Strategy<Value = String> {
    let nasty = "[\u{1b}\u{9b}\r\n\t\u{202e}\u{200d}日本👩‍👩‍👧a-z]{0,40}";
    prop_oneof![nasty, any::<String>(), Just("w".repeat(300))]
}

prop_compose! {
    /// Reply with valid names and arbitrary other fields.
    pub fn hostile()(
        run in "[a-z0-9_-]{1,64}",
        (phase, pid, counts) in (0..5i32, any::<u32>(), any::<[u64; 14]>()),
        floats in prop::array::uniform10(numbers()),
        (host, program_version) in (names(), names()),
        known in any::<bool>(),
        actors in prop::collection::vec(actor(), 0..24),
        alarms in prop::collection::vec(names(), 0..6),
        (limit, limit_help) in (names(), names()),
        parts in prop::collection::vec((names(), numbers()), 0..10),
    ) -> RunStatus {
        RunStatus {
            time_unix_s: floats[0],
            run, phase, pid, host, program_version, actors, alarms, limit, limit_help,
            used_share: known.then_some(floats[8]), idle_share: known.then_some(floats[9]), undone_updates: counts[13],
            version: known.then_some(PolicyVersion::new(counts[0], counts[1])),
            env_steps: counts[2], env_steps_wanted: counts[3], updates: counts[4],
            wall_s: floats[0], env_steps_per_s: floats[1], since_update_s: floats[2], policy_lag_mean: floats[3],
            return_mean: known.then_some(floats[4]), length_mean: known.then_some(floats[5]),
            distance_mean_m: known.then_some(floats[6]), velocity_mean_mps: known.then_some(floats[7]),
            resident_bytes: counts[5], accepted: counts[6], duplicate: counts[7], too_old: counts[8],
            vanished: counts[9], malformed: counts[10], quarantined: counts[11], accepted_bytes: counts[12],
            parts: parts.into_iter().map(|(name, share)| PartTime { name, share }).collect(),
            waits_for_storage: known, has_commands: known, fall_fraction: known.then_some(floats[1]),
            velocity_error_mps: known.then_some(floats[6]), yaw_rate_error_radps: known.then_some(floats[7]),
            done_share: known.then_some(floats[8]), body_error_m: known.then_some(floats[9]),
            pool: known.then(|| PoolDemand {
                run: "walk-1".to_string(), share: floats[0].abs().min(1000.0), envs: pid, envs_target: counts[0] as u32,
                envs_max: u32::MAX, pool_envs: counts[1] as u32, pool_actors: counts[2] as u32, ..PoolDemand::default()
            }),
        }
    }
}

prop_compose! {
    fn actor()(
        name in "[a-z0-9_-]{1,64}",
        (alive, quarantined, known) in any::<(bool, bool, bool)>(),
        (contact, speed) in (numbers(), numbers()),
        (lag, number, envs) in any::<(u64, u64, u32)>(),
        (host, program_version) in (names(), names()),
    ) -> ActorStatus {
        let stats = ActorStats {
            actor: name.clone(), host, program_version, envs, env_steps_per_s: speed,
            version: known.then_some(PolicyVersion::new(1, number)),
            dropped_by_rule: number, resent: lag, resident_bytes: lag, ..ActorStats::default()
        };
        ActorStatus {
            name, alive, quarantined,
            since_contact_s: known.then_some(contact),
            lag_versions: known.then_some(lag),
            stats: known.then_some(stats),
        }
    }
}
