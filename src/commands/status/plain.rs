//! Statuses of runs as lines of text.

use std::fmt::Write as _;

use treadmill_learner::metrics::{progress::imitation, table::format_number};
use treadmill_proto::{ActorStatus, Phase, PoolDemand, RunStatus};
use treadmill_runtime::numbers::thousands;

use crate::shared::foreign_text::printable;

/// Longest name from another machine.
const NAME_CHARS_MAX: usize = 24;
/// Longest alarm.
const ALARM_CHARS_MAX: usize = 400;

/// Returns a paragraph for each run, with a table of its actors.
pub fn as_text(runs: &[RunStatus]) -> String {
    let mut out = String::new();
    for run in runs {
        // Writing into a string cannot fail.
        let _ = describe(&mut out, run);
    }
    let _ = describe_pool(&mut out, runs);
    out
}

/// Writes how the runs share a pool of actors, if there is one.
fn describe_pool(out: &mut String, runs: &[RunStatus]) -> std::fmt::Result {
    let demands: Vec<&PoolDemand> = runs.iter().filter_map(|run| run.pool.as_ref()).collect();
    // Learners hear of the same actors, but not at the same moment.
    let Some(newest) = demands.iter().max_by_key(|demand| demand.pool_actors).filter(|pool| pool.pool_actors > 0)
    else {
        return Ok(());
    };
    let has: u32 = demands.iter().map(|demand| demand.envs).fold(0, u32::saturating_add);
    let idle = newest.pool_envs.saturating_sub(has);
    writeln!(out, "pool: {} actors with {} environments, {idle} without a run", newest.pool_actors, newest.pool_envs)?;
    writeln!(
        out,
        "  {:<24} {:>7} {:>9} {:>6} {:>6} {:>6} {:>7}",
        "run", "share", "wants", "own", "due", "has", "actors"
    )?;
    for demand in demands {
        let wants = if demand.open { format!("{}–{}", demand.envs_min, demand.envs_max) } else { "none".to_string() };
        let PoolDemand { run, share, envs_own, envs_target, envs, actors, .. } = demand;
        writeln!(
            out,
            "  {run:<24} {:>7} {wants:>9} {envs_own:>6} {envs_target:>6} {envs:>6} {actors:>7}",
            format_number(*share)
        )?;
    }
    Ok(())
}

/// Returns a line for each run.
pub fn as_lines(runs: &[RunStatus]) -> String {
    runs.iter().map(line_of).collect::<Vec<_>>().join("\n")
}

fn line_of(run: &RunStatus) -> String {
    let alive = run.actors.iter().filter(|actor| actor.alive).count();
    let mut line = format!(
        "run `{}` {}: {} of {} steps ({:.1} %), {} steps/s, actors: {alive}",
        run.run,
        phase(run),
        thousands(run.env_steps),
        thousands(run.env_steps_wanted),
        100.0 * run.env_steps as f64 / run.env_steps_wanted.max(1) as f64,
        thousands(run.env_steps_per_s.max(0.0) as u64),
    );
    let mut add = |name: &str, value: Option<f64>, decimals: usize, unit: &str| {
        line += &value.map(|value| format!(", {name} {value:.decimals$}{unit}")).unwrap_or_default();
    };
    add("return", run.return_mean, 0, "");
    add("length", run.length_mean, 0, "");
    match (run.has_commands, run.done_share) {
        (true, _) => {
            add("velocity error", run.velocity_error_mps, 2, " m/s");
            add("yaw rate error", run.yaw_rate_error_radps, 2, " rad/s");
        }
        (false, Some(done)) => {
            add("motion done", Some(100.0 * done), 0, " %");
            add("links off by", run.body_error_m.map(|error_m| 100.0 * error_m), 1, " cm");
        }
        (false, None) => add("distance", run.distance_mean_m, 1, " m"),
    }
    add("falls", run.fall_fraction.map(|share| 100.0 * share), 0, " %");
    add("used", run.used_share.map(|share| 100.0 * share), 0, " %");
    let alarms = run.alarms.iter().map(|alarm| format!("\n  ALARM {}", printable(alarm, ALARM_CHARS_MAX)));
    line + &alarms.collect::<String>()
}

fn describe(out: &mut String, run: &RunStatus) -> std::fmt::Result {
    let version = run.version.unwrap_or_default();
    writeln!(
        out,
        "run `{}` {} on {} (process {}, version {})",
        run.run,
        phase(run),
        plain(&run.host),
        run.pid,
        plain(&run.program_version)
    )?;
    writeln!(
        out,
        "  steps      {} of {} ({:.0} %), {} per second",
        thousands(run.env_steps),
        thousands(run.env_steps_wanted),
        100.0 * run.env_steps as f64 / run.env_steps_wanted.max(1) as f64,
        thousands(run.env_steps_per_s.max(0.0) as u64)
    )?;
    writeln!(
        out,
        "  updates    {}, the last {} ago; policy {:08x}:{}{}",
        run.updates,
        seconds(run.since_update_s),
        version.incarnation as u32,
        version.number,
        if version.epoch > 0 { format!(", epoch {}", version.epoch) } else { String::new() }
    )?;
    if let Some(return_mean) = run.return_mean {
        let imitated = run.done_share.zip(run.body_error_m).map(<[f64; 2]>::from);
        let moved = match (run.has_commands, run.velocity_error_mps, run.yaw_rate_error_radps) {
            (true, Some(velocity), Some(yaw_rate)) => format!("errors of {velocity:.2} m/s and {yaw_rate:.2} rad/s"),
            (true, ..) => "not evaluated yet".to_string(),
            (false, ..) => imitated.map(imitation).unwrap_or_else(|| {
                let (distance_m, velocity_mps) = (run.distance_mean_m, run.velocity_mean_mps);
                format!("{:.1} m at {:.2} m/s", distance_m.unwrap_or_default(), velocity_mps.unwrap_or_default())
            }),
        };
        let length = run.length_mean.unwrap_or_default();
        let falls = run.fall_fraction.map(|share| format!(", {:.0} % fell", 100.0 * share)).unwrap_or_default();
        writeln!(out, "  episodes   return {return_mean:.0}, {moved}, {length:.0} steps long{falls}")?;
    }
    writeln!(
        out,
        "  fragments  {} accepted, {} duplicate, {} too old, {} vanished, {} malformed, {} quarantined",
        run.accepted, run.duplicate, run.too_old, run.vanished, run.malformed, run.quarantined
    )?;
    writeln!(
        out,
        "  lag        {:.2} versions on average; learner {:.0} MB",
        run.policy_lag_mean,
        run.resident_bytes as f64 / 1e6
    )?;
    let share = |share: Option<f64>| share.map_or("-".to_string(), |share| format!("{:.1} %", 100.0 * share));
    writeln!(
        out,
        "  work       {} of the simulated steps learnt from, {} updates undone; actors idle {} of the time",
        share(run.used_share),
        run.undone_updates,
        share(run.idle_share)
    )?;
    if !run.limit.is_empty() {
        let [limit, help] = [&run.limit, &run.limit_help].map(|text| printable(text, ALARM_CHARS_MAX));
        writeln!(out, "  limit      {limit} takes most of the time; {help}")?;
    }
    for alarm in &run.alarms {
        writeln!(out, "  ALARM      {}", printable(alarm, ALARM_CHARS_MAX))?;
    }
    let alive = run.actors.iter().filter(|actor| actor.alive).count();
    writeln!(out, "  actors     {alive} alive, {} steps per second together", thousands(fleet_rate(run) as u64))?;
    if !run.actors.is_empty() {
        writeln!(
            out,
            "    {:<24} {:<16} {:>8} {:>5} {:>4} {:>9} {:>8} {:>8} {:>7}  state",
            "name", "host", "version", "envs", "lag", "steps/s", "contact", "dropped", "resent"
        )?;
        for actor in &run.actors {
            line(out, actor)?;
        }
    }
    Ok(())
}

fn line(out: &mut String, actor: &ActorStatus) -> std::fmt::Result {
    let stats = actor.stats.clone().unwrap_or_default();
    let known = |text: String| if actor.stats.is_some() { text } else { "-".to_string() };
    writeln!(
        out,
        "    {:<24} {:<16} {:>8} {:>5} {:>4} {:>9} {:>8} {:>8} {:>7}  {}",
        actor.name,
        known(plain(&stats.host)),
        known(plain(&stats.program_version)),
        known(stats.envs.to_string()),
        actor.lag_versions.map_or("-".to_string(), |lag| lag.to_string()),
        known(format!("{:.0}", stats.env_steps_per_s)),
        actor.since_contact_s.map_or("-".to_string(), seconds),
        known(stats.dropped_by_rule.to_string()),
        known(stats.resent.to_string()),
        state(actor),
    )
}

/// Returns up to 24 characters of text from other machines, without those that move the cursor or change direction.
pub fn plain(text: &str) -> String {
    printable(text, NAME_CHARS_MAX)
}

/// Returns the state of an actor in one word.
pub fn state(actor: &ActorStatus) -> &'static str {
    match (actor.quarantined, actor.alive) {
        (true, _) => "quarantined",
        (false, true) => "alive",
        (false, false) => "gone",
    }
}

fn phase(run: &RunStatus) -> &'static str {
    match run.phase() {
        Phase::Paused => "is paused",
        Phase::Stopping => "is stopping",
        Phase::Training | Phase::Unspecified => "trains",
    }
}

fn seconds(elapsed_s: f64) -> String {
    if elapsed_s < 100.0 { format!("{elapsed_s:.1} s") } else { format!("{:.0} min", elapsed_s / 60.0) }
}

/// Returns the sum of the steps per second that living actors report.
pub fn fleet_rate(run: &RunStatus) -> f64 {
    run.actors
        .iter()
        .filter(|actor| actor.alive)
        .filter_map(|actor| actor.stats.as_ref().map(|stats| stats.env_steps_per_s))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_task_shows_its_own_figures() {
        let walks = RunStatus {
            return_mean: Some(310.0),
            distance_mean_m: Some(4.0),
            velocity_mean_mps: Some(0.5),
            ..RunStatus::default()
        };
        let imitates = RunStatus { done_share: Some(0.95), body_error_m: Some(0.034), ..walks.clone() };
        let obeys = RunStatus {
            has_commands: true,
            velocity_error_mps: Some(0.125),
            yaw_rate_error_radps: Some(0.5),
            ..walks.clone()
        };
        for (run, line, text) in [
            (walks, "distance 4.0 m", "4.0 m at 0.50 m/s"),
            (imitates, "motion done 95 %, links off by 3.4 cm", "95 % of the motion done, links off by 3.4 cm"),
            (obeys, "velocity error 0.12 m/s, yaw rate error 0.50 rad/s", "errors of 0.12 m/s and 0.50 rad/s"),
        ] {
            let run = RunStatus { length_mean: Some(100.0), ..run };
            let (in_a_line, paragraph) = (as_lines(std::slice::from_ref(&run)), as_text(&[run]));
            assert!(in_a_line.contains(line) && paragraph.contains(text), "{in_a_line}\n{paragraph}");
        }
    }
}
