//! `treadmill check`: diagnoses of this machine, its network and the route to a learner, each with a remedy.
//!
//! # Layout
//! - [`finding`]: result of one diagnosis, with its severity.
//! - This machine: [`cpu`], [`cores`], [`memory`], [`disk`], [`open_files`], [`clock`], [`shared_memory`], [`terminal`],
//!   [`gpu`].
//! - Its network: [`loopback`], [`listening`], [`multicast`].
//! - What it computes: [`simulation`], [`networks`].
//! - Route to a learner: [`certificates`], [`route`], [`handshake`], [`learner`].
//! - [`system`]: facts from the operating system, and limits of a container.

mod certificates;
mod clock;
mod cores;
mod cpu;
mod disk;
mod finding;
mod gpu;
mod handshake;
mod learner;
mod listening;
mod loopback;
mod memory;
mod multicast;
mod networks;
mod open_files;
mod route;
mod shared_memory;
mod simulation;
mod system;
mod terminal;

use std::{path::PathBuf, process::ExitCode};

use clap::Args;
use serde_json::json;
use treadmill_runtime::machine;

use crate::{
    launch::{exit_code, output::say, slow_step::SlowStepNotice},
    shared::learner_address::ReachArgs,
};
use finding::{Finding, Severity};
use system::System;

/// Flags of `check`.
#[derive(Args)]
pub struct CheckArgs {
    #[command(flatten)]
    reach: ReachArgs,
    /// Where a learner is to listen on this machine; may be repeated.
    #[arg(long, value_name = "ENDPOINT")]
    listen: Vec<String>,
    /// Where runs are to be written.
    #[arg(long, value_name = "DIR", default_value = "runs")]
    run_dir: PathBuf,
    /// Actors that are to run here or to join; by default one per core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    actors: Option<u64>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Makes every diagnosis and tells them: 0 where there is no problem, 1 where there is one, 2 for wrong usage.
pub fn run(args: CheckArgs) -> ExitCode {
    match findings(&args) {
        Ok(findings) => {
            if args.json {
                say(&as_json(&findings));
            } else {
                findings.iter().for_each(|finding| say(&finding.to_string()));
                say(&summary(&findings));
            }
            ExitCode::from(u8::from(count(&findings, Severity::Problem) > 0))
        }
        Err(why) => exit_code::exit_code(Err(why)),
    }
}

fn findings(args: &CheckArgs) -> anyhow::Result<Vec<Finding>> {
    // First, because it may have to say on which threads the bus works.
    let learner_route = learner::LearnerRoute::of(&args.reach)?;
    let system = System::here();
    let actors = args.actors.unwrap_or(machine::cores() as u64);
    let mut findings = vec![
        cpu::diagnose(),
        cores::diagnose(&system),
        memory::diagnose(&system, actors),
        disk::diagnose(&args.run_dir),
        open_files::diagnose(actors),
        clock::diagnose(machine::time_unix_s()),
        shared_memory::diagnose(actors, args.reach.network.shared_memory),
        terminal::diagnose(),
        gpu::diagnose(),
        loopback::diagnose(),
    ];
    findings.extend(args.listen.iter().map(|endpoint| listening::diagnose(endpoint, args.reach.network.insecure)));
    findings.push(multicast::diagnose(args.reach.network.discover));
    let step = SlowStepNotice::begin("simulating a humanoid");
    findings.push(simulation::diagnose());
    findings.push(networks::diagnose());
    drop(step);
    if let Some(folder) = &args.reach.network.tls {
        findings.extend(certificates::diagnose(folder));
    }
    if let Some(route) = learner_route {
        findings.extend(route.diagnose());
    }
    Ok(findings)
}

fn count(findings: &[Finding], severity: Severity) -> usize {
    findings.iter().filter(|finding| finding.severity == severity).count()
}

fn summary(findings: &[Finding]) -> String {
    match (count(findings, Severity::Problem), count(findings, Severity::Note)) {
        (0, 0) => format!("all {} diagnoses are well", findings.len()),
        (0, notes) => format!("no problem, and {notes} to note, in {} diagnoses", findings.len()),
        (problems, notes) => {
            format!("problems: {problems}, to note: {notes}, in {} diagnoses; mend the problems first", findings.len())
        }
    }
}

fn as_json(findings: &[Finding]) -> String {
    let told = findings.iter().map(|finding| {
        json!({
            "name": finding.name, "verdict": finding.severity.name(), "seen": finding.seen, "remedy": finding.remedy,
        })
    });
    json!({
        "problems": count(findings, Severity::Problem),
        "notes": count(findings, Severity::Note),
        "findings": told.collect::<Vec<_>>(),
    })
    .to_string()
}
