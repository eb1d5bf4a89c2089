//! Flags of `watch`. They are part of the command line even if the viewer (`watch/`) is not built.

use std::{
    net::{IpAddr, Ipv4Addr},
    path::PathBuf,
};

use clap::Args;
use treadmill_learner::checkpoint::CheckpointChoice;

use crate::shared::{learner_address::ReachArgs, model_file::ModelFileArgs};

/// Flags of `watch`.
#[derive(Args, Clone, Debug)]
pub struct ViewerArgs {
    /// Location of the run.
    #[command(flatten)]
    pub reach: ReachArgs,
    /// Watch an actor of a run while it trains. RUN is its folder on this machine; on other machines pass --connect.
    #[arg(long)]
    pub live: bool,
    /// Actor to watch; by default the first one seen.
    #[arg(long, value_name = "NAME", requires = "live")]
    pub actor: Option<String>,
    /// End after this many seconds of motion.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub for_s: Option<f64>,
    /// Checkpoint: best, latest, or the number of updates of a kept one; by default best if it exists.
    #[arg(long, value_name = "WHICH", conflicts_with = "live")]
    pub checkpoint: Option<CheckpointChoice>,
    /// Episodes to play; 0 shows the empty scene.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(..=1000), conflicts_with = "live")]
    pub episodes: u32,
    /// Seed of the resets, as for `eval`.
    #[arg(long, default_value_t = 1, conflicts_with = "live")]
    pub seed: u64,
    /// Play in real time at this speed factor; by default all motion is sent at once.
    #[arg(long, value_name = "TIMES", value_parser = positive, conflicts_with = "live")]
    pub speed: Option<f64>,
    /// MJCF or URDF file, or card, of the robot on this machine; shows its visual meshes instead of the colliding shapes.
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// Flags about that file.
    #[command(flatten)]
    pub model_file: ModelFileArgs,
    /// Steer the robot by keys while it moves, in real time; for policies that follow commands.
    #[arg(long, conflicts_with_all = ["live", "episodes"])]
    pub steer: bool,
    /// Keep the camera still; by default it follows the torso.
    #[arg(long)]
    pub no_follow: bool,
    /// Flags of the output.
    #[command(flatten)]
    pub output: ViewerOutputArgs,
}

/// Flags of the viewer's output.
#[derive(Args, Clone, Debug)]
pub struct ViewerOutputArgs {
    /// Write a file for Rerun's viewer instead; open it by `rerun FILE`.
    #[arg(long, value_name = "FILE")]
    pub rrd: Option<PathBuf>,
    /// Address to serve the viewer on. Beyond loopback, anyone who reaches it can watch and draw, so it needs --insecure.
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    pub bind: IpAddr,
    /// Port of the page; 0 takes any free one.
    #[arg(long, value_name = "PORT", default_value_t = 9090)]
    pub web_port: u16,
    /// Port of the page's data; 0 takes any free one.
    #[arg(long, value_name = "PORT", default_value_t = 9876)]
    pub data_port: u16,
    /// Motion kept for pages that are opened later, in MiB; the oldest is dropped first.
    #[arg(long, value_name = "MIB", default_value_t = 512, value_parser = clap::value_parser!(u64).range(16..=65_536))]
    pub memory_max_mb: u64,
}

/// Help for RUN, which `watch` takes in more forms than `status`.
pub const RUN_HELP: &str = "\
    Folder of a run, its name below runs/, a bundle file or an exported policy; with --live the folder of a run that \
    trains on this machine";

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("expected a number above 0".to_string()),
    }
}
