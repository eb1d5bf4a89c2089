//! Flags of `watch`. The command line parses and completes them even where the viewer (`watch/`) is not built.

use std::{
    net::{IpAddr, Ipv4Addr},
    path::PathBuf,
};

use clap::Args;
use treadmill_learner::checkpoint::Which;

use crate::shared::learner_address::ReachArgs;

/// What to watch, and how.
#[derive(Args, Clone, Debug)]
pub struct ViewerArgs {
    /// Where the run is.
    #[command(flatten)]
    pub reach: ReachArgs,
    /// Watch an actor of a run that trains now. RUN is its folder on this machine; elsewhere give --connect.
    #[arg(long)]
    pub live: bool,
    /// The actor to watch; by default the first that shows itself.
    #[arg(long, value_name = "NAME", requires = "live")]
    pub actor: Option<String>,
    /// End after so many seconds of motion.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub for_s: Option<f64>,
    /// Which checkpoint: best, latest, or the number of updates of a kept one; by default best if there is one.
    #[arg(long, value_name = "WHICH", conflicts_with = "live")]
    pub checkpoint: Option<Which>,
    /// Episodes to play; 0 shows the empty stage.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(..=1000), conflicts_with = "live")]
    pub episodes: u32,
    /// Seed of the resets, as for `eval`.
    #[arg(long, default_value_t = 1, conflicts_with = "live")]
    pub seed: u64,
    /// Show motion as it happens, at so many times the pace of the clock, rather than all of it at once.
    #[arg(long, value_name = "TIMES", value_parser = positive, conflicts_with = "live")]
    pub speed: Option<f64>,
    /// Let the camera stand still; it follows the torso otherwise.
    #[arg(long)]
    pub no_follow: bool,
    /// Where it is shown.
    #[command(flatten)]
    pub output: ViewerOutputArgs,
}

/// Where it is shown.
#[derive(Args, Clone, Debug)]
pub struct ViewerOutputArgs {
    /// Write a file for Rerun's viewer instead, as in `rerun walk.rrd`.
    #[arg(long, value_name = "FILE", conflicts_with = "native")]
    pub rrd: Option<PathBuf>,
    /// Open a window of Rerun's own viewer instead; the program `rerun` of the same version must be on the PATH.
    #[arg(long)]
    pub native: bool,
    /// Address that the viewer is served on. Anybody who reaches another one than this machine's own can watch and draw, so
    /// it needs --insecure.
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    pub bind: IpAddr,
    /// Port of the page; 0 for any free one.
    #[arg(long, value_name = "PORT", default_value_t = 9090)]
    pub web_port: u16,
    /// Port of the data that the page shows; 0 for any free one.
    #[arg(long, value_name = "PORT", default_value_t = 9876)]
    pub data_port: u16,
    /// Motion that is kept for pages that are opened later; the oldest goes first (MiB).
    #[arg(long, value_name = "MIB", default_value_t = 512, value_parser = clap::value_parser!(u64).range(16..=65_536))]
    pub memory_max_mb: u64,
}

/// What RUN means here; for `status`, from which the flag comes, it means a little less.
pub const RUN_HELP: &str = "A run's folder, its name below runs/, a bundle file, or what `export` wrote; with --live the folder of a run \
                        that trains on this machine";

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("expected a number above 0".to_string()),
    }
}
