//! `treadmill motion`: prints what was understood of a motion file, and writes it as a film or in mjlab's form.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use treadmill_config::Config;
use treadmill_humanoid::{
    Physics,
    mjcf::visual_meshes,
    motion::{MotionClip, MotionFile, MotionReport, SampledMotion, write_npz},
};
use treadmill_render::Look;
use treadmill_runtime::atomic_file;

use crate::{
    commands::eval::filming::FilmArgs,
    launch::{exit_code::Usage, model, output::say},
    shared::{
        existing_file::existing_file,
        model_file::ModelFileArgs,
        motion_file::{physics_of, read_one},
    },
};

/// Most lines of one kind.
const LINES_MAX: usize = 8;
/// Rate of the written form (1/s): that of control.
const SAVED_HZ: f64 = 50.0;

/// Flags of `motion`.
#[derive(Args)]
pub struct MotionCommandArgs {
    /// Motion file: CSV or npz.
    #[arg(value_parser = existing_file)]
    file: PathBuf,
    /// MJCF or URDF file, or card, of the robot that moves; by default the built-in humanoid.
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// Flags about that file.
    #[command(flatten)]
    files: ModelFileArgs,
    /// Name of a built-in card that completes the model: g1, g1-29, h1 or t1.
    #[arg(long, value_name = "NAME")]
    card: Option<String>,
    /// Frames per second of a file that does not say so, as CSV.
    #[arg(long, value_name = "HZ")]
    fps: Option<f64>,
    /// Write a film of the motion (GIF).
    #[arg(long, value_name = "FILE")]
    film: Option<PathBuf>,
    /// Write the motion at 50 frames per second as an archive of NumPy with mjlab's keys.
    #[arg(long, value_name = "FILE.npz")]
    save: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Prints the report.
pub fn run(args: &MotionCommandArgs) -> anyhow::Result<()> {
    Usage::unless_writable("--film", args.film.as_deref())?;
    Usage::unless_writable("--save", args.save.as_deref())?;
    let mut config = Config::default();
    config.env.robot = args.card.clone().unwrap_or_default();
    let text = model::completed(&config, args.model.as_deref(), &args.files, "")?;
    let mut physics = physics_of(&text)?;
    let found = read_one(&args.file, args.fps, &mut physics)?;
    let report = MotionReport::of(&found.motion, &mut physics);
    if args.json {
        let beyond: Vec<_> =
            report.beyond.iter().map(|(name, rad, share)| json!({"hinge": name, "rad": rad, "share": share})).collect();
        let jumps: Vec<_> = report.jumps.iter().map(|(time_s, what)| json!({"time_s": time_s, "what": what})).collect();
        let contacts: Vec<_> =
            report.contacts_s.iter().map(|(time_s, touches)| json!({"time_s": time_s, "touches": touches})).collect();
        say(&json!({
            "file": args.file.display().to_string(),
            "format": found.format,
            "order": found.order,
            "notices": found.notices,
            "frames": report.frames,
            "rate_hz": report.rate_hz,
            "duration_s": report.duration_s,
            "hinges": found.motion.hinges,
            "base_m": report.base_m,
            "lowest_m": report.lowest_m,
            "touching_share": report.touching_share,
            "contacts": contacts,
            "path_m": report.path_m,
            "speed_max_mps": report.speed_max_mps,
            "fastest": {"hinge": report.fastest.0, "rate_radps": report.fastest.1, "time_s": report.fastest.2},
            "beyond": beyond,
            "jumps": jumps,
        })
        .to_string());
    } else {
        print(args, &found, &report);
    }
    if let Some(path) = &args.save {
        atomic_file::write(path, &write_npz(&found.motion, &mut physics, 1.0 / SAVED_HZ)?)?;
        note(args, &format!("wrote {}", path.display()));
    }
    if let Some(path) = &args.film {
        let line = film(args, path, &found.motion, &mut physics)?;
        note(args, &line);
    }
    Ok(())
}

/// Prints a line about a file that was written, unless standard output is one JSON object.
fn note(args: &MotionCommandArgs, line: &str) {
    if !args.json {
        say(line);
    }
}

/// Writes a film of the motion and returns a line that describes it.
fn film(args: &MotionCommandArgs, path: &Path, motion: &MotionClip, physics: &mut Physics) -> anyhow::Result<String> {
    // Nothing but a picture needs them.
    let meshes = args.model.as_ref().and_then(|file| visual_meshes(file, &args.files.files()).ok()).unwrap_or_default();
    let look = Look::of(physics.model(), &meshes);
    let step_s = 1.0 / SAVED_HZ;
    let filming = FilmArgs::of_file(path).begin(step_s, || look)?;
    let Some(mut filming) = filming else { return Ok(String::new()) };
    let sampled = SampledMotion::new(motion, step_s);
    for (number, (position, velocity)) in sampled.positions.iter().zip(&sampled.velocities).enumerate() {
        physics.set_state(position, velocity);
        filming.record_pose(physics, number as f64 * step_s);
    }
    filming.finish()
}

fn print(args: &MotionCommandArgs, found: &MotionFile, report: &MotionReport) {
    let line = |key: &str, text: &str| say(&format!("  {key:<9} {text}"));
    say(&format!("motion `{}`", args.file.display()));
    line("format", found.format);
    line("order", &found.order);
    line("frames", &format!("{} at {} per second: {:.2} s", report.frames, report.rate_hz, report.duration_s));
    line("hinges", &format!("{}: {}", found.motion.hinges.len(), found.motion.hinges.join(" ")));
    line(
        "base",
        &format!(
            "{:.3} to {:.3} m high, path {:.2} m, at most {:.2} m/s",
            report.base_m[0], report.base_m[1], report.path_m, report.speed_max_mps
        ),
    );
    match report.lowest_m {
        Some([low_m, high_m]) => {
            line(
                "ground",
                &format!(
                    "lowest part {low_m:.3} to {high_m:.3} m above it; touches in {:.0} % of the frames",
                    100.0 * report.touching_share
                ),
            );
            let leaves = report
                .contacts_s
                .iter()
                .map(|(time_s, touches)| format!("{} at {time_s:.2} s", if *touches { "touches" } else { "leaves" }));
            let shown: Vec<String> = leaves.take(LINES_MAX).collect();
            let more = report.contacts_s.len().saturating_sub(LINES_MAX);
            let rest = if more > 0 { format!(", and {more} more") } else { String::new() };
            line("", &format!("{}{rest}", shown.join(", ")));
        }
        None => line("ground", "no shape of the model can touch it"),
    }
    let (name, rate_radps, time_s) = &report.fastest;
    line("fastest", &format!("`{name}`, {rate_radps:.1} rad/s at {time_s:.2} s"));
    for (name, rad, share) in report.beyond.iter().take(LINES_MAX) {
        line(
            "beyond",
            &format!("`{name}` is up to {rad:.3} rad beyond its range, in {:.0} % of the frames", 100.0 * share),
        );
    }
    for (time_s, what) in report.jumps.iter().take(LINES_MAX) {
        line("jump", &format!("at {time_s:.2} s: {what}"));
    }
    if report.jumps.len() > LINES_MAX {
        line("jump", &format!("and {} more", report.jumps.len() - LINES_MAX));
    }
    found.notices.iter().for_each(|notice| line("note", notice));
}
