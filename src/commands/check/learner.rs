//! Whether a learner answers, of which version it is, and how far its clock is off.

use std::time::Duration;

use treadmill_bus::{Bus, BusOptions, Role, statuses};
use treadmill_proto::{ControlReply, RunStatus};
use treadmill_runtime::machine;

use super::{
    finding::{Finding, actors as counted},
    route,
};
use crate::{
    launch::{exit_code::Usage, slow_step::SlowStepNotice},
    shared::learner_address::{self, ReachArgs},
};

const NAME: &str = "learner";
const VERSIONS: &str = "versions";
const SKEW: &str = "clock skew";

/// How long the bus may take to open once somebody listens.
const OPEN_TIMEOUT: Duration = Duration::from_secs(8);
/// Clocks that differ by this are worth a word, and by that much nothing that is dated fits together.
const SKEW_S: f64 = 2.0;
const SKEW_MAX_S: f64 = 60.0;

/// Route to a learner.
pub struct LearnerRoute {
    options: BusOptions,
    run: Option<String>,
}

impl LearnerRoute {
    /// As the flags say; none where they name no learner.
    pub fn of(reach: &ReachArgs) -> anyhow::Result<Option<Self>> {
        let connect = reach.named_endpoints()?;
        if let Some(run) = &reach.run {
            treadmill_proto::ident::check_ident("run", run).map_err(|why| Usage(why.to_string()))?;
        }
        if connect.is_empty() && !reach.network.discover {
            return Ok(None);
        }
        let role = role(reach);
        // Whoever has no certificate that fits is told so by the diagnosis, and not by a refusal to make it.
        let options = reach.network.options(role, Vec::new(), connect)?;
        Ok(Some(Self { options, run: reach.run.clone() }))
    }

    /// Goes the way.
    pub fn diagnose(&self) -> Vec<Finding> {
        let (mut findings, mut is_open) = (Vec::new(), self.options.discover);
        for endpoint in &self.options.connect {
            let (found, is_well) = route::diagnose(endpoint, self.options.credentials.as_ref());
            findings.extend(found);
            is_open |= is_well;
        }
        // Nobody would answer on the bus either.
        if is_open {
            findings.extend(self.ask());
        }
        findings
    }

    fn ask(&self) -> Vec<Finding> {
        let _step = SlowStepNotice::begin("asking the learner");
        let runtime = match tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build() {
            Ok(runtime) => runtime,
            Err(why) => {
                return vec![Finding::problem(NAME, why.to_string(), "see how many threads this user may have")];
            }
        };
        let findings = runtime.block_on(async {
            let options = self.options.clone();
            let opened = tokio::task::spawn_blocking(move || Bus::open_client(&options));
            let bus = match tokio::time::timeout(OPEN_TIMEOUT, opened).await {
                Ok(Ok(Ok(bus))) => bus,
                Ok(Ok(Err(why))) => {
                    return vec![Finding::problem(NAME, why.to_string(), "see the flags of the network")];
                }
                _ => return vec![self.silent()],
            };
            let asked = learner_address::retry_until_answered(async || {
                statuses(&bus, None, learner_address::ANSWER_TIMEOUT).await
            })
            .await;
            let now_unix_s = machine::time_unix_s();
            bus.close();
            match asked {
                Ok(replies) => self.assess(replies, now_unix_s),
                Err(why) => vec![Finding::problem(NAME, why.to_string(), "ask again; then see the learner's log")],
            }
        });
        // A dial that goes on must not keep the process.
        runtime.shutdown_background();
        findings
    }

    fn silent(&self) -> Finding {
        Finding::problem(
            NAME,
            "somebody listens there, and does not speak as a learner or a router does",
            "see what has that port: ss -ltnp there; a learner says what it listens on when it starts",
        )
    }

    fn assess(&self, replies: Vec<ControlReply>, now_unix_s: f64) -> Vec<Finding> {
        let runs: Vec<RunStatus> = replies.into_iter().filter_map(|reply| reply.status).collect();
        let wanted: Vec<&RunStatus> =
            runs.iter().filter(|status| self.run.as_ref().is_none_or(|run| *run == status.run)).collect();
        if wanted.is_empty() {
            return vec![self.missing(&runs)];
        }
        wanted.into_iter().flat_map(|status| [answers(status), versions(status), skew(status, now_unix_s)]).collect()
    }

    fn missing(&self, runs: &[RunStatus]) -> Finding {
        let role = self.options.credentials.as_ref().map(|credentials| credentials.role);
        match (&self.run, role) {
            (Some(run), _) if !runs.is_empty() => {
                let names: Vec<&str> = runs.iter().map(|status| &status.run[..]).collect();
                let seen = format!("no run `{run}` answers there; these do: {}", names.join(", "));
                Finding::problem(NAME, seen, "name one of these by --run")
            }
            (_, Some(role)) if !matches!(role, Role::Observer | Role::Operator) => Finding::note(
                NAME,
                format!("the {}'s certificate lets nobody ask how a run goes, so no more is known", role.name()),
                "look from a machine with an observer's certificate for versions and clocks",
            ),
            _ => Finding::problem(
                NAME,
                "no learner answers there",
                "start one, or dial it and not a router that has lost it; see that both sides speak of the same run",
            ),
        }
    }
}

/// As whom to ask: as an observer where there are its files, else as whoever this machine is.
fn role(reach: &ReachArgs) -> Role {
    let Some(folder) = &reach.network.tls else { return Role::Observer };
    let has_files =
        |role: &Role| ["crt", "key"].iter().all(|kind| folder.join(format!("{}.{kind}", role.name())).is_file());
    let wanted = [Role::Observer, Role::Operator, Role::Actor, Role::Evaluator, Role::Learner, Role::Router];
    wanted.into_iter().find(has_files).unwrap_or(Role::Observer)
}

fn answers(status: &RunStatus) -> Finding {
    let alive = status.actors.iter().filter(|actor| actor.alive).count();
    let seen = format!(
        "run `{}` answers from {}: {} of {} steps, {}",
        status.run,
        status.host,
        status.env_steps,
        status.env_steps_wanted,
        counted(alive as u64)
    );
    match alive {
        0 => Finding::note(NAME, seen, format!("start an actor: treadmill actor --run {}", status.run)),
        _ => Finding::ok(NAME, seen),
    }
}

fn versions(status: &RunStatus) -> Finding {
    let ours = env!("CARGO_PKG_VERSION");
    if status.program_version != ours {
        return Finding::problem(
            VERSIONS,
            format!("the learner of `{}` is of version {}, and this is {ours}", status.run, status.program_version),
            "use the same version of Treadmill on all machines",
        );
    }
    let other = status.actors.iter().find_map(|actor| {
        let version = &actor.stats.as_ref()?.program_version;
        // Actors in other languages have versions of their own.
        (actor.alive && version != ours && !version.contains(' ')).then_some((&actor.name, version))
    });
    match other {
        Some((actor, version)) => Finding::problem(
            VERSIONS,
            format!("actor `{actor}` is of version {version}, and the learner and this are of {ours}"),
            "use the same version of Treadmill on all machines",
        ),
        None => Finding::ok(VERSIONS, format!("learner, actors and this program are of {ours}")),
    }
}

fn skew(status: &RunStatus, now_unix_s: f64) -> Finding {
    if status.time_unix_s == 0.0 {
        return Finding::note(SKEW, "the learner does not tell its time", "use the same version on all machines");
    }
    let ahead_s = status.time_unix_s - now_unix_s;
    let seen = match ahead_s > 0.0 {
        true => format!("the learner's clock is {:.1} s ahead of this one", ahead_s.abs()),
        false => format!("the learner's clock is {:.1} s behind this one", ahead_s.abs()),
    };
    let remedy = "set both by NTP (timedatectl set-ntp true): certificates and dates of metrics depend on it";
    match ahead_s.abs() {
        off_s if off_s.is_nan() || off_s > SKEW_MAX_S => Finding::problem(SKEW, seen, remedy),
        off_s if off_s > SKEW_S => Finding::note(SKEW, seen, remedy),
        _ => Finding::ok(SKEW, seen),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn clocks_that_differ_are_told_by_how_much() {
        let found = |time_unix_s| skew(&RunStatus { time_unix_s, ..RunStatus::default() }, 1000.0);
        assert_eq!(found(1001.0).severity, Severity::Ok);
        assert!(found(990.0).severity == Severity::Note && found(990.0).seen.contains("10.0 s behind"));
        assert!(found(5000.0).severity == Severity::Problem && found(5000.0).seen.contains("4000.0 s ahead"));
        assert_eq!(found(f64::NAN).severity, Severity::Problem);
        assert_eq!(found(0.0).severity, Severity::Note);
    }
}
