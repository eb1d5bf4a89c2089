//! Why no learner answers: what every command asks before it reports that. `treadmill check` prints the same findings.
//!
//! # Layout
//! - [`finding`]: result of one diagnosis, with its severity.
//! - [`certificates`]: a folder of certificates.
//! - [`route`]: name, port and protocol of an endpoint; [`handshake`]: its TLS.

pub(crate) mod certificates;
pub(crate) mod finding;
mod handshake;
pub(crate) mod route;

use std::{fmt, time::Duration};

use treadmill_bus::{Bus, BusOptions, observer::live_runs};
use treadmill_runtime::words::{nearest, quoted};

use finding::{Finding, Severity};

const NAME: &str = "learner";

/// Longest wait for the list of learners.
const RUNS_TIMEOUT: Duration = Duration::from_secs(2);

/// Why no learner answers, what to do about it, and the command that examines everything.
#[derive(Clone, Debug, PartialEq)]
pub struct Silence {
    /// What was found, in one line.
    pub seen: String,
    /// What to do, in one line.
    pub remedy: String,
    /// A complete `treadmill check` command.
    pub check: String,
}

impl fmt::Display for Silence {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let Self { seen, remedy, check } = self;
        write!(formatter, "no answer: {seen}\n  {remedy}\n  {check}")
    }
}

impl std::error::Error for Silence {}

impl Silence {
    /// Finds out why no client can join the bus of `options`. Takes some seconds and blocks its thread.
    #[must_use]
    pub fn of_endpoints(options: &BusOptions, run: Option<&str>) -> Self {
        Self::of_route(options, run).unwrap_or_else(|| Self::new(no_peer(options), options, run))
    }

    /// Finds what stands on the way to an endpoint of `options`: the bus dials them in order, each until it answers.
    /// `None` if nothing is found, or if discovery may find others. Blocks its thread, at most some seconds for each
    /// endpoint.
    #[must_use]
    pub fn of_route(options: &BusOptions, run: Option<&str>) -> Option<Self> {
        if options.discover {
            return None;
        }
        let credentials = options.credentials.as_ref();
        // The folder of certificates explains a failed handshake better than the other end does.
        let own = credentials.map(|credentials| certificates::diagnose_role_in(&credentials.folder, credentials.role));
        let findings = options.connect.iter().flat_map(|endpoint| route::diagnose(endpoint, credentials).0);
        let found = own.into_iter().chain(findings).find(|finding| finding.severity == Severity::Problem);
        found.map(|finding| Self::new(finding, options, run))
    }

    /// Finds out why the run does not answer on a bus that is open.
    pub async fn of_run(bus: &Bus, options: &BusOptions, run: Option<&str>) -> Self {
        let finding = missing_run(bus, options, run).await.unwrap_or_else(|| silent_learner(options, run));
        Self::new(finding, options, run)
    }

    /// Returns all three parts in one line, for a log.
    #[must_use]
    pub fn in_one_line(&self) -> String {
        let Self { seen, remedy, check } = self;
        format!("{seen}; {remedy}; to examine it: {check}")
    }

    fn new(finding: Finding, options: &BusOptions, run: Option<&str>) -> Self {
        Self {
            seen: finding.seen,
            remedy: finding.remedy.unwrap_or_default(),
            check: command_at("check", options, run),
        }
    }
}

/// Returns the finding that no learner of the run is on the bus; `None` if one is.
pub async fn missing_run(bus: &Bus, options: &BusOptions, run: Option<&str>) -> Option<Finding> {
    let runs = live_runs(bus, RUNS_TIMEOUT).await.unwrap_or_default();
    let names = runs.join(", ");
    let there = if options.connect.is_empty() { "that was discovered".to_string() } else { options.connect.join(", ") };
    if runs.is_empty() {
        return Some(Finding::problem(
            NAME,
            format!("no learner has joined the bus at {there}"),
            "start a learner (one for an external task joins with its first actor); if this is a router, check its link to \
             the learner",
        ));
    }
    let run = run.filter(|run| !runs.iter().any(|live| live == run))?;
    let near = nearest(run, runs.iter().map(|run| &run[..])).map(|near| format!("; did you mean `{near}`?"));
    Some(Finding::problem(
        NAME,
        format!("no learner trains a run `{run}` at {there}{}", near.unwrap_or_default()),
        format!("name one of the runs there with --run: {names}"),
    ))
}

/// Returns the finding that a learner is on the bus and does not answer.
pub fn silent_learner(options: &BusOptions, run: Option<&str>) -> Finding {
    let credentials = options.credentials.as_ref();
    let own = credentials.map(|credentials| certificates::diagnose_role_in(&credentials.folder, credentials.role));
    own.filter(|own| own.severity == Severity::Problem).unwrap_or_else(|| {
        let whose = run.map(|run| format!(" of run `{run}`")).unwrap_or_default();
        let seen = format!("the learner{whose} is there, but does not answer in time");
        Finding::problem(NAME, seen, "ask again; then compare the versions on both machines, and read its log")
    })
}

/// Returns the finding that no learner or router could be joined, though a process listens.
pub fn no_peer(options: &BusOptions) -> Finding {
    if options.connect.is_empty() {
        return Finding::problem(
            "discovery",
            "no learner or router replied to multicast",
            "start it with --discover; where the network carries no multicast, name an endpoint with --connect",
        );
    }
    route::not_a_learner(&options.connect)
}

/// Returns a command with the flags that lead to a learner, quoted for a shell.
pub fn command_at(command: &str, options: &BusOptions, run: Option<&str>) -> String {
    let mut words = vec![format!("treadmill {command}")];
    let mut add = |flag: &str, value: &str| words.push(format!("{flag} {}", quoted(value)));
    options.connect.iter().for_each(|endpoint| add("--connect", endpoint));
    if let Some(run) = run {
        add("--run", run);
    }
    if let Some(credentials) = &options.credentials {
        add("--tls", &credentials.folder.display().to_string());
    }
    if let Some(file) = &options.zenoh_config {
        add("--zenoh-config", &file.display().to_string());
    }
    words.extend(options.insecure.then(|| "--insecure".to_string()));
    words.extend(options.discover.then(|| "--discover".to_string()));
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use treadmill_bus::{Credentials, Role};

    #[test]
    fn the_command_repeats_all_flags_of_the_network() {
        let credentials = Credentials { folder: "my certs".into(), role: Role::Actor };
        let options = BusOptions {
            connect: vec!["tls/a:1".to_string(), "tls/b:2".to_string()],
            credentials: Some(credentials),
            insecure: true,
            ..BusOptions::default()
        };
        assert_eq!(
            command_at("check", &options, Some("walk")),
            "treadmill check --connect tls/a:1 --connect tls/b:2 --run walk --tls 'my certs' --insecure"
        );
    }
}
