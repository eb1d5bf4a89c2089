//! Played fleet: a real learner with real updates among actors that do not simulate.
//!
//! A played actor behaves on the bus as a real one does, by the same delivery. It does not simulate: a fragment is
//! ready when a real actor of the given rate would have finished it.
//!
//! # Layout
//! - Here: flags and the result.
//! - [`actors`]: process of many played actors. [`actor`]: one of them.
//! - [`pace`]: time that simulation takes. [`policy`]: transitions under each policy version. [`counts`]: what became
//!   of them.
//! - [`processes`]: learner and routers as child processes, and their use of the machine.
//! - [`run_metrics`]: follows the learner's metrics.
//! - [`measure`]: starts the processes, sets the rates and marks the measured window.
//! - [`figures`]: figures of the measured window.

mod actor;
pub mod actors;
mod counts;
mod figures;
mod measure;
mod pace;
mod policy;
mod processes;
mod run_metrics;

use std::{
    fs,
    path::{Path, PathBuf},
    str::FromStr,
};

use anyhow::Context;
use clap::Args;
use serde_json::json;
use treadmill_rl::launch::{exit_code::Usage, output::say_result};
use treadmill_runtime::machine;

use self::measure::{MeasurementPlan, PlayedRate};
use crate::helper;

/// Name of the run on the bus.
pub const RUN: &str = "fleet";
/// Least rate of an actor (environment steps per second).
const RATE_MIN: f64 = 0.01;
const RATE_MAX: f64 = 1e9;

/// Flags of `fleet`.
#[derive(Args)]
pub struct FleetArgs {
    /// Played actors.
    #[arg(long, value_name = "K", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=4000))]
    actors: u32,
    /// Environments of each actor.
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    envs: u32,
    /// Environment steps per second of each actor; `auto` measures the update's own speed first and divides --load of it.
    #[arg(long, value_name = "STEPS_PER_S", default_value = "auto")]
    rate: RateChoice,
    /// Sum of the rates divided by the update's own speed, with --rate auto.
    #[arg(long, value_name = "SHARE", default_value_t = 0.8)]
    load: f64,
    /// Factor on the rate of one actor, the last ones; may be repeated.
    #[arg(long, value_name = "FACTOR")]
    slow: Vec<f64>,
    /// Mode of the learner, as in learner.mode.
    #[arg(long, default_value = "sync", value_parser = ["sync", "async"])]
    mode: String,
    /// Routers that the actors' sessions are spread over; 0 lets them dial the learner.
    #[arg(long, value_name = "R", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=100))]
    routers: u32,
    /// Encrypt every link, with temporary certificates.
    #[arg(long)]
    tls: bool,
    /// Processes that the actors are spread over.
    #[arg(long, value_name = "P", default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=64))]
    processes: u32,
    /// Duration of the measurement in seconds; it lasts for at least five updates.
    #[arg(long, value_name = "S", default_value_t = 20.0)]
    seconds: f64,
    /// Time before the measurement in seconds, for at least three updates.
    #[arg(long, value_name = "S", default_value_t = 5.0)]
    warmup_s: f64,
    /// Duration of the measurement of the update's own speed in seconds, with --rate auto.
    #[arg(long, value_name = "S", default_value_t = 5.0)]
    calibrate_s: f64,
    /// Preset of the learner.
    #[arg(long, value_name = "NAME", default_value = "walk")]
    preset: String,
    /// Set a configuration key of the learner; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Keep the run folder and the learner's log in this folder.
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Value of `--rate`.
#[derive(Clone, Copy, Debug)]
enum RateChoice {
    Auto,
    Fixed(f64),
}

impl FromStr for RateChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("`auto`, or {RATE_MIN} to {RATE_MAX} steps per second");
        match text {
            "auto" => Ok(Self::Auto),
            _ => {
                let rate = text.parse().ok().filter(|rate| (RATE_MIN..=RATE_MAX).contains(rate));
                rate.map(Self::Fixed).ok_or_else(expected)
            }
        }
    }
}

/// Runs the measurement and prints its result.
pub fn run(args: &FleetArgs) -> anyhow::Result<()> {
    check(args)?;
    let temporary = tempfile::tempdir().context("cannot create a temporary folder")?;
    let folder = args.keep.as_deref().unwrap_or(temporary.path());
    if folder.join(RUN).exists() {
        let why = format!("--keep {}: it has the run of another measurement; name another folder", folder.display());
        return Err(Usage(why).into());
    }
    fs::create_dir_all(folder).with_context(|| format!("cannot create the folder `{}`", folder.display()))?;
    let mut result = plan(args, folder, temporary.path())?.measure()?;
    let more = json!({
        "mode": args.mode,
        "routers": args.routers,
        "transport": if args.tls { "mutual tls" } else { "tcp" },
        "settings": args.set.join(" "),
        "cores": machine::cores(),
        "cpu": machine::cpu_name(),
        "workload": format!(
            "learner of preset {} among {} played actors of {} environments",
            args.preset, args.actors, args.envs
        ),
        "checksum": format!("{} updates", result["updates"]),
    });
    let fields = result.as_object_mut().context("figures are an object")?;
    fields.extend(more.as_object().cloned().unwrap_or_default());
    say_result(&result, args.json);
    Ok(())
}

/// Refuses numbers out of range.
fn check(args: &FleetArgs) -> Result<(), Usage> {
    let durations = [("--seconds", args.seconds), ("--warmup-s", args.warmup_s), ("--calibrate-s", args.calibrate_s)];
    for (flag, seconds) in durations {
        if !(0.0..=3600.0).contains(&seconds) {
            return Err(Usage(format!("{flag} is {seconds}; allowed: 0 to 3600")));
        }
    }
    if !(args.load > 0.0 && args.load <= 100.0) {
        return Err(Usage(format!("--load is {}; allowed: above 0, at most 100", args.load)));
    }
    if let Some(factor) = args.slow.iter().find(|factor| !(0.001..=1.0).contains(*factor)) {
        return Err(Usage(format!("--slow is {factor}; allowed: 0.001 to 1")));
    }
    if let Some(pair) = args.set.iter().find(|pair| pair.starts_with("learner.mode=")) {
        return Err(Usage(format!("--set {pair}: choose the mode with --mode")));
    }
    if args.slow.len() > args.actors as usize {
        return Err(Usage(format!("--slow is given {} times for {} actors", args.slow.len(), args.actors)));
    }
    Ok(())
}

fn plan(args: &FleetArgs, folder: &Path, temporary: &Path) -> anyhow::Result<MeasurementPlan> {
    let mut network = Vec::new();
    if args.tls {
        network.extend(helper::certify(&temporary.join("certs"))?);
    }
    let mut learner = vec!["--preset".to_string(), args.preset.clone()];
    for pair in std::iter::once(&format!("learner.mode={}", args.mode)).chain(&args.set) {
        learner.extend(["--set".to_string(), pair.clone()]);
    }
    Ok(MeasurementPlan {
        actors: args.actors as usize,
        envs: args.envs,
        rate: match args.rate {
            RateChoice::Auto => PlayedRate::Load(args.load),
            RateChoice::Fixed(rate) => PlayedRate::Fixed(rate),
        },
        slow: args.slow.clone(),
        routers: args.routers as usize,
        processes: args.processes as usize,
        calibrate_s: args.calibrate_s,
        warmup_s: args.warmup_s,
        seconds: args.seconds,
        learner,
        listen: if args.tls { "tls/127.0.0.1:0" } else { "tcp/127.0.0.1:0" },
        network,
        folder: folder.to_path_buf(),
    })
}
