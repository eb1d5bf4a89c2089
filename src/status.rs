//! `treadmill status`: how runs go, and who takes part.

use std::{fmt::Write as _, io::IsTerminal, time::Duration};

use clap::Args;
use serde_json::json;
use treadmill_common::bus::{Bus, Role, statuses};
use treadmill_proto::{ActorStatus, ControlReply, Phase, RunStatus};

use crate::{
    operator::{self, ReachArgs},
    output::say,
};

/// How often `--watch` looks.
const WATCH_EVERY: Duration = Duration::from_secs(2);
/// Clears a terminal and goes to its first line.
const CLEAR: &str = "\u{1b}[2J\u{1b}[H";

/// Flags of `status`.
#[derive(Args)]
pub struct StatusArgs {
    #[command(flatten)]
    reach: ReachArgs,
    /// Look again every two seconds, until Ctrl-C.
    #[arg(long)]
    watch: bool,
    /// Print one JSON object per line.
    #[arg(long)]
    json: bool,
}

/// Tells how it goes, once or again and again.
pub fn run(args: StatusArgs) -> anyhow::Result<()> {
    let StatusArgs { reach, watch, json } = args;
    operator::on_the_bus(&reach, Role::Observer, async |bus, run| {
        loop {
            let replies = ask(&bus, run.as_deref()).await?;
            let text = if json { as_json(&replies) } else { as_text(&replies) };
            match (watch, json || !std::io::stdout().is_terminal()) {
                (false, _) => return say_all(&text),
                (true, true) => say_all(&text)?,
                (true, false) => say_all(&format!("{CLEAR}{text}"))?,
            }
            tokio::time::sleep(WATCH_EVERY).await;
        }
    })
}

fn say_all(text: &str) -> anyhow::Result<()> {
    say(text.trim_end());
    Ok(())
}

async fn ask(bus: &Bus, run: Option<&str>) -> anyhow::Result<Vec<RunStatus>> {
    let replies = operator::until_answered(async || statuses(bus, run, operator::ANSWER_TIMEOUT).await).await?;
    let mut told: Vec<RunStatus> = replies.into_iter().filter_map(|reply: ControlReply| reply.status).collect();
    if told.is_empty() {
        let whose = run.map_or("no run".to_string(), |run| format!("no run `{run}`"));
        anyhow::bail!("{whose} answers there; is its learner up, and does your certificate let you ask?");
    }
    told.sort_by(|a, b| a.run.cmp(&b.run));
    Ok(told)
}

fn as_text(runs: &[RunStatus]) -> String {
    let mut out = String::new();
    for run in runs {
        // Writing into a string cannot fail.
        let _ = describe(&mut out, run);
    }
    out
}

fn describe(out: &mut String, run: &RunStatus) -> std::fmt::Result {
    let version = run.version.unwrap_or_default();
    writeln!(
        out,
        "run `{}` {} on {} (process {}, version {})",
        run.run,
        phase(run),
        run.host,
        run.pid,
        run.program_version
    )?;
    writeln!(
        out,
        "  steps      {} of {} ({:.0} %), {:.0} per second",
        run.env_steps,
        run.env_steps_wanted,
        100.0 * run.env_steps as f64 / run.env_steps_wanted.max(1) as f64,
        run.env_steps_per_s
    )?;
    writeln!(
        out,
        "  updates    {}, the last {} ago; policy {:08x}:{}",
        run.updates,
        seconds(run.since_update_s),
        version.incarnation as u32,
        version.number
    )?;
    if let (Some(return_mean), Some(distance_m), Some(velocity_mps)) =
        (run.return_mean, run.distance_mean_m, run.velocity_mean_mps)
    {
        let length = run.length_mean.unwrap_or_default();
        writeln!(
            out,
            "  episodes   return {return_mean:.0}, {distance_m:.1} m at {velocity_mps:.2} m/s, {length:.0} steps long"
        )?;
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
    let alive = run.actors.iter().filter(|actor| actor.alive).count();
    writeln!(out, "  actors     {alive} alive, {:.0} steps per second together", fleet_rate(run))?;
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
    let known = |text: String| if actor.stats.is_some() { text } else { "–".to_string() };
    writeln!(
        out,
        "    {:<24} {:<16} {:>8} {:>5} {:>4} {:>9} {:>8} {:>8} {:>7}  {}",
        actor.name,
        known(plain(&stats.host)),
        known(plain(&stats.program_version)),
        known(stats.envs.to_string()),
        actor.lag_versions.map_or("–".to_string(), |lag| lag.to_string()),
        known(format!("{:.0}", stats.env_steps_per_s)),
        actor.since_contact_s.map_or("–".to_string(), seconds),
        known(stats.dropped_by_rule.to_string()),
        known(stats.resent.to_string()),
        state(actor),
    )
}

/// What strangers call themselves, without what would move the cursor.
fn plain(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(24).collect()
}

fn state(actor: &ActorStatus) -> &'static str {
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

fn fleet_rate(run: &RunStatus) -> f64 {
    run.actors
        .iter()
        .filter(|actor| actor.alive)
        .filter_map(|actor| actor.stats.as_ref().map(|stats| stats.env_steps_per_s))
        .sum()
}

fn as_json(runs: &[RunStatus]) -> String {
    runs.iter().map(|run| json_of(run).to_string() + "\n").collect()
}

fn json_of(run: &RunStatus) -> serde_json::Value {
    let version = |version: Option<treadmill_proto::wire::PolicyVersion>| version.map(|version| version.number);
    let actors: Vec<_> = run
        .actors
        .iter()
        .map(|actor| {
            let stats = actor.stats.as_ref();
            json!({
                "name": actor.name,
                "state": state(actor),
                "host": stats.map(|stats| &stats.host),
                "pid": stats.map(|stats| stats.pid),
                "program_version": stats.map(|stats| &stats.program_version),
                "policy_version": stats.and_then(|stats| version(stats.version)),
                "lag_versions": actor.lag_versions,
                "envs": stats.map(|stats| stats.envs),
                "env_steps": stats.map(|stats| stats.env_steps),
                "env_steps_per_s": stats.map(|stats| stats.env_steps_per_s),
                "since_contact_s": actor.since_contact_s,
                "produced": stats.map(|stats| stats.produced),
                "accepted": stats.map(|stats| stats.accepted),
                "dropped_by_rule": stats.map(|stats| stats.dropped_by_rule),
                "in_flight": stats.map(|stats| stats.in_flight),
                "resent": stats.map(|stats| stats.resent),
                "resident_bytes": stats.map(|stats| stats.resident_bytes),
            })
        })
        .collect();
    json!({
        "run": run.run,
        "phase": match run.phase() {
            Phase::Paused => "paused",
            Phase::Stopping => "stopping",
            Phase::Training | Phase::Unspecified => "training",
        },
        "host": run.host,
        "pid": run.pid,
        "program_version": run.program_version,
        "policy_version": version(run.version),
        "env_steps": run.env_steps,
        "env_steps_wanted": run.env_steps_wanted,
        "env_steps_per_s": run.env_steps_per_s,
        "updates": run.updates,
        "since_update_s": run.since_update_s,
        "wall_s": run.wall_s,
        "return_mean": run.return_mean,
        "length_mean": run.length_mean,
        "distance_mean_m": run.distance_mean_m,
        "velocity_mean_mps": run.velocity_mean_mps,
        "policy_lag_mean": run.policy_lag_mean,
        "resident_bytes": run.resident_bytes,
        "fragments": {
            "accepted": run.accepted, "duplicate": run.duplicate, "too_old": run.too_old, "vanished": run.vanished,
            "malformed": run.malformed, "quarantined": run.quarantined,
        },
        "actors": actors,
    })
}
