//! `treadmill check`: diagnoses of this machine and the route to a learner, each with a remedy.
//!
//! # Layout
//! - [`machine`]: vector instructions, disk, memory, open files, clock and ports of this machine.
//! - [`gpu`]: a GPU and its driver.
//! - [`store`]: the store of a run's state.
//! - [`learner`]: answer of a learner. The way to it and the certificates are diagnosed by `src/diagnosis/`.

mod gpu;
mod learner;
pub(crate) mod machine;
mod store;

use std::{path::PathBuf, process::ExitCode};

use clap::Args;
use serde_json::json;
use treadmill_runtime::machine::{cores, time_unix_s};

use crate::{
    diagnosis::{
        certificates,
        finding::{Finding, Severity},
    },
    launch::{exit_code, output::say},
    shared::learner_address::ReachArgs,
};

/// Flags of `check`.
#[derive(Args)]
pub struct CheckArgs {
    #[command(flatten)]
    reach: ReachArgs,
    /// Endpoint where a learner will listen on this machine; may be repeated.
    #[arg(long, value_name = "ENDPOINT")]
    listen: Vec<String>,
    /// Folder that runs will be written to, if RUN names none.
    #[arg(long, value_name = "DIR", default_value = "runs", conflicts_with = "folder")]
    run_dir: PathBuf,
    /// Actors that will run here or join; by default one per core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    actors: Option<u64>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Makes every diagnosis and prints it. Exit code: 0 without problems, 1 with problems, 2 for wrong usage.
pub fn run(args: CheckArgs) -> ExitCode {
    let findings = match diagnose(&args) {
        Ok(findings) => findings,
        Err(why) => return exit_code::exit_code(Err(why)),
    };
    let count = |severity| findings.iter().filter(|finding| finding.severity == severity).count();
    let (problems, notes) = (count(Severity::Problem), count(Severity::Note));
    if args.json {
        let as_json = |finding: &Finding| {
            json!({
                "name": finding.name, "verdict": finding.severity.name(), "seen": finding.seen, "remedy": finding.remedy,
            })
        };
        let findings: Vec<_> = findings.iter().map(as_json).collect();
        say(&json!({ "problems": problems, "notes": notes, "findings": findings }).to_string());
    } else {
        findings.iter().for_each(|finding| say(&finding.to_string()));
        say(&format!("{} diagnoses: {problems} problems, {notes} notes", findings.len()));
    }
    ExitCode::from(u8::from(problems > 0))
}

fn diagnose(args: &CheckArgs) -> anyhow::Result<Vec<Finding>> {
    let hindrance = learner::hindrance(&args.reach);
    // Comes first because it may set the threads of the bus through the environment.
    let learner_route = if hindrance.is_none() { learner::LearnerRoute::of(&args.reach)? } else { None };
    let run = args.reach.run_folder()?;
    let mut findings = vec![
        machine::cpu(),
        gpu::diagnose(),
        machine::disk(run.as_ref().map_or(&args.run_dir, |run| run.root())),
        machine::memory(args.actors.unwrap_or(cores() as u64)),
        machine::open_files(args.actors.unwrap_or(cores() as u64)),
        machine::clock(time_unix_s()),
    ];
    findings.extend(args.reach.store_url().iter().flat_map(|url| store::diagnose(url)));
    findings.extend(args.listen.iter().map(|endpoint| machine::listen(endpoint, &args.reach.network)));
    if let Some(folder) = &args.reach.network.tls {
        findings.extend(certificates::diagnose(folder));
    }
    findings.extend(hindrance);
    if let Some(route) = learner_route {
        findings.extend(route.diagnose());
    }
    Ok(findings)
}
