//! Played fleet: a real learner with real updates among actors that do not simulate.

use std::{fs, path::PathBuf, str::FromStr};

use anyhow::Context;
use clap::Args;
use serde_json::json;
use treadmill_rl::launch::{exit_code::Usage, output::say_result};
use treadmill_runtime::machine;

use crate::{
    RUN,
    measurement::MeasurementPlan,
    process::{certify, flags},
};

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
    /// Duration of the measurement in seconds; it lasts for at least five updates. A quarter of it passes before.
    #[arg(long, value_name = "S", default_value_t = 20.0)]
    seconds: f64,
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

/// Value of `--rate`; `None` is `auto`.
#[derive(Clone, Copy, Debug)]
struct RateChoice(Option<f64>);

impl FromStr for RateChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let rate = text.parse().ok().filter(|rate| (RATE_MIN..=RATE_MAX).contains(rate));
        let expected = || format!("`auto`, or {RATE_MIN} to {RATE_MAX} steps per second");
        if text == "auto" { Ok(Self(None)) } else { rate.map(|rate| Self(Some(rate))).ok_or_else(expected) }
    }
}

/// Runs the measurement and prints its result.
pub fn run(args: &FleetArgs) -> anyhow::Result<()> {
    check(args)?;
    let temporary = tempfile::tempdir().context("cannot create a temporary folder")?;
    let folder = args.keep.clone().unwrap_or_else(|| temporary.path().to_path_buf());
    if folder.join(RUN).exists() {
        let why = format!("--keep {}: it has the run of another measurement; name another folder", folder.display());
        return Err(Usage(why).into());
    }
    fs::create_dir_all(&folder).with_context(|| format!("cannot create the folder `{}`", folder.display()))?;
    let mut learner = flags(&[("--preset", args.preset.clone()), ("--set", format!("learner.mode={}", args.mode))]);
    learner.extend(args.set.iter().flat_map(|pair| flags(&[("--set", pair.clone())])));
    let plan = MeasurementPlan {
        actors: args.actors as usize,
        envs: args.envs,
        rate: args.rate.0,
        load: args.load,
        slow: args.slow.clone(),
        routers: args.routers as usize,
        seconds: args.seconds,
        learner,
        listen: if args.tls { "tls/127.0.0.1:0" } else { "tcp/127.0.0.1:0" },
        network: if args.tls { certify(&temporary.path().join("certs"))?.into() } else { Vec::new() },
        folder,
    };
    let mut result = plan.measure()?;
    result["mode"] = json!(args.mode);
    result["transport"] = json!(if args.tls { "mutual tls" } else { "tcp" });
    result["settings"] = json!(args.set.join(" "));
    result["cores"] = json!(machine::cores());
    result["cpu"] = json!(machine::cpu_name());
    say_result(&result, args.json);
    Ok(())
}

/// Refuses numbers out of range.
fn check(args: &FleetArgs) -> Result<(), Usage> {
    if !(0.0..=3600.0).contains(&args.seconds) {
        return Err(Usage(format!("--seconds is {}; allowed: 0 to 3600", args.seconds)));
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
