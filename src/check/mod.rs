//! `treadmill check`: what is wrong with a machine, or with the way to a learner, and what to do about it.
//!
//! # Layout
//! - [`finding`]: what a diagnosis says.
//! - Of this machine: [`cpu`], [`cores`], [`memory`], [`disk`], [`open_files`], [`clock`], [`shared_memory`],
//!   [`terminal`], [`gpu`].
//! - Of its network: [`loopback`], [`listening`], [`multicast`].
//! - Of what it computes: [`simulation`], [`networks`].
//! - Of the way to a learner: [`certificates`], [`route`], [`handshake`], [`learner`].
//! - [`system`]: what the system tells of itself, and a container's limits.

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

use crate::{operator::ReachArgs, outcome, output::say, patience::Step};
use finding::{Finding, Verdict};
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
    match diagnose(&args) {
        Ok(findings) => {
            if args.json {
                say(&as_json(&findings));
            } else {
                findings.iter().for_each(|finding| say(&finding.to_string()));
                say(&summary(&findings));
            }
            ExitCode::from(u8::from(count(&findings, Verdict::Problem) > 0))
        }
        Err(why) => outcome::exit_code(Err(why)),
    }
}

fn diagnose(args: &CheckArgs) -> anyhow::Result<Vec<Finding>> {
    // First, because it may have to say on which threads the bus works.
    let way = learner::Way::of(&args.reach)?;
    let system = System::here();
    let actors = args.actors.unwrap_or(machine::cores() as u64);
    let mut findings = vec![
        cpu::look(),
        cores::look(&system),
        memory::look(&system, actors),
        disk::look(&args.run_dir),
        open_files::look(actors),
        clock::look(machine::time_unix_s()),
        shared_memory::look(actors, args.reach.network.shared_memory),
        terminal::look(),
        gpu::look(),
        loopback::look(),
    ];
    findings.extend(args.listen.iter().map(|endpoint| listening::look(endpoint, args.reach.network.insecure)));
    findings.push(multicast::look(args.reach.network.discover));
    let step = Step::begin("simulating a humanoid");
    findings.push(simulation::look());
    findings.push(networks::look());
    drop(step);
    if let Some(folder) = &args.reach.network.tls {
        findings.extend(certificates::look(folder));
    }
    if let Some(way) = way {
        findings.extend(way.look());
    }
    Ok(findings)
}

fn count(findings: &[Finding], verdict: Verdict) -> usize {
    findings.iter().filter(|finding| finding.verdict == verdict).count()
}

fn summary(findings: &[Finding]) -> String {
    match (count(findings, Verdict::Problem), count(findings, Verdict::Note)) {
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
            "name": finding.name, "verdict": finding.verdict.name(), "seen": finding.seen, "remedy": finding.remedy,
        })
    });
    json!({
        "problems": count(findings, Verdict::Problem),
        "notes": count(findings, Verdict::Note),
        "findings": told.collect::<Vec<_>>(),
    })
    .to_string()
}
