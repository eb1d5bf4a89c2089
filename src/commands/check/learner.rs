//! Diagnosis of a learner: whether it answers, its version, and the difference of its clock.

use std::{io, time::Duration};

use treadmill_bus::{Bus, BusOptions, Credentials, Role, observer::statuses};
use treadmill_proto::{ControlReply, RunStatus};
use treadmill_runtime::{error_chain, holder::Holder, machine, program};

use crate::{
    diagnosis::{self, finding::Finding, route},
    launch::slow_step::SlowStepNotice,
    shared::{
        learner_address::{ANSWER_TIMEOUT, ReachArgs, is_of, retry_until_answered},
        network_args::check_run,
    },
};

const NAME: &str = "learner";
const VERSIONS: &str = "versions";
const SKEW: &str = "clock skew";
const ALARM: &str = "alarm";
const ALARM_REMEDY: &str = "see docs/operations/troubleshooting.md";

/// Timeout for opening the bus when a process listens.
const OPEN_TIMEOUT: Duration = Duration::from_secs(8);
/// Difference of clocks above which a note appears, and above which dates no longer match.
const SKEW_S: f64 = 2.0;
const SKEW_MAX_S: f64 = 60.0;
const SAME_VERSION: &str = "use the same version of Treadmill on all machines";

/// Route to a learner.
pub struct LearnerRoute {
    options: BusOptions,
    run: Option<String>,
    holder: Option<Holder>,
}

/// Returns why there is no learner to ask: no process trains the run whose folder was given, or several are trained
/// below `runs/`.
pub fn hindrance(reach: &ReachArgs) -> Option<Finding> {
    if let Some([seen, remedy]) = reach.idleness() {
        return Some(Finding::problem(NAME, seen, remedy));
    }
    match &reach.live_folders()[..] {
        [] | [_] => None,
        runs => {
            let seen = format!("several runs are trained here: {}", runs.join(", "));
            Some(Finding::note(NAME, seen, "name the one to check"))
        }
    }
}

impl LearnerRoute {
    /// Reads the route from the flags, or takes the only run that is trained below `runs/`; returns `None` without both.
    pub fn of(reach: &ReachArgs) -> anyhow::Result<Option<Self>> {
        check_run(reach.run.as_deref())?;
        let live = match &reach.live_folders()[..] {
            [run] => Some(run.clone()),
            _ => None,
        };
        let reach = &ReachArgs { folder: live.or(reach.folder.clone()), ..reach.clone() };
        // A store does not say where its learner listens.
        let names_no_learner = reach.folder.as_ref().is_none_or(|run| run.contains("://"))
            && reach.run.is_none()
            && reach.connect.is_empty();
        if names_no_learner && !reach.network.discover {
            return Ok(None);
        }
        let connect = reach.endpoints()?;
        let options = reach.network.options(role(reach), Vec::new(), connect)?;
        Ok(Some(Self { options, run: reach.run.clone(), holder: reach.holder() }))
    }

    /// Diagnoses each endpoint, and asks the learner if one of them is reachable.
    pub fn diagnose(&self) -> Vec<Finding> {
        let (mut findings, mut is_reachable) = (Vec::new(), self.options.discover);
        for endpoint in &self.options.connect {
            let (found, is_ok) = route::diagnose(endpoint, self.options.credentials.as_ref());
            findings.extend(found);
            is_reachable |= is_ok;
        }
        if is_reachable {
            findings.extend(self.ask().unwrap_or_else(|finding| vec![finding]));
        }
        findings
    }

    fn ask(&self) -> Result<Vec<Finding>, Finding> {
        let _step = SlowStepNotice::begin("asking the learner");
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build();
        let too_few_threads = |why: io::Error| Finding::problem(NAME, why.to_string(), "raise ulimit -u");
        let runtime = runtime.map_err(too_few_threads)?;
        let findings = runtime.block_on(async {
            let options = self.options.clone();
            let opened = tokio::task::spawn_blocking(move || Bus::open_client(&options));
            let Ok(Ok(opened)) = tokio::time::timeout(OPEN_TIMEOUT, opened).await else {
                return Err(Finding { name: NAME, ..diagnosis::no_peer(&self.options) });
            };
            let bus = opened.map_err(|why| Finding::problem(NAME, error_chain(&why), "check the network flags"))?;
            let replies = retry_until_answered(async || statuses(&bus, None, ANSWER_TIMEOUT).await).await;
            let now_unix_s = machine::time_unix_s();
            let findings = match replies {
                Ok(replies) => match &self.assess(replies, now_unix_s)[..] {
                    [] => Ok(vec![self.silence(&bus).await]),
                    findings => Ok(findings.to_vec()),
                },
                Err(why) => Err(Finding::problem(NAME, format!("{why:#}"), "ask again; then read the learner's log")),
            };
            bus.close();
            findings
        });
        // Unfinished dialling must not keep the process alive.
        runtime.shutdown_background();
        findings
    }

    /// Returns why no status came: only observers and operators may ask for it.
    async fn silence(&self, bus: &Bus) -> Finding {
        let run = self.run.as_deref();
        if let Some(missing) = diagnosis::missing_run(bus, &self.options, run).await {
            return missing;
        }
        match self.options.credentials.as_ref().map(|credentials| credentials.role) {
            None | Some(Role::Observer | Role::Operator) => diagnosis::silent_learner(&self.options, run),
            Some(role) => Finding::note(
                NAME,
                format!("the link works; the {}'s certificate may not ask for the status of a run", role.name()),
                "use an observer's certificate to check versions and clocks",
            ),
        }
    }

    /// Judges the answers of the wanted runs; returns nothing if none of them answered.
    fn assess(&self, replies: Vec<ControlReply>, now_unix_s: f64) -> Vec<Finding> {
        let statuses = replies.into_iter().filter_map(|reply| reply.status);
        let wanted = statuses.filter(|status| {
            self.run.as_ref().is_none_or(|run| *run == status.run) && is_of(self.holder.as_ref(), status)
        });
        let findings = |status: RunStatus| {
            let alarms = status.alarms.iter().map(|alarm| Finding::problem(ALARM, alarm.clone(), ALARM_REMEDY));
            [self.answers(&status), versions(&status), skew(&status, now_unix_s)]
                .into_iter()
                .chain(alarms.collect::<Vec<_>>())
        };
        wanted.flat_map(findings).collect()
    }

    fn answers(&self, status: &RunStatus) -> Finding {
        let RunStatus { run, host, env_steps, env_steps_wanted, .. } = status;
        let alive = status.actors.iter().filter(|actor| actor.alive).count();
        let seen = format!("run `{run}` answers from {host}: {env_steps} of {env_steps_wanted} steps, actors: {alive}");
        match alive {
            0 => Finding::note(NAME, seen, format!("start an actor: {}", self.actor_command(run))),
            _ => Finding::ok(NAME, seen),
        }
    }

    fn actor_command(&self, run: &str) -> String {
        let mut options = self.options.clone();
        if let Some(credentials) = &mut options.credentials {
            credentials.role = Role::Actor;
            if credentials.missing().is_some() {
                credentials.folder = "DIR".into();
            }
        }
        diagnosis::command_at("actor", &options, Some(run))
    }
}

/// Chooses the role to ask as: the first one, beginning with the observer, whose files exist.
fn role(reach: &ReachArgs) -> Role {
    let Some(folder) = &reach.network.tls else { return Role::Observer };
    let has_files = |role: &Role| Credentials { folder: folder.clone(), role: *role }.missing().is_none();
    let wanted = [Role::Observer, Role::Operator, Role::Actor, Role::Evaluator, Role::Learner, Role::Router];
    wanted.into_iter().find(has_files).unwrap_or(Role::Observer)
}

fn versions(status: &RunStatus) -> Finding {
    let ours = program::version();
    if status.program_version != ours {
        let seen = format!("the learner of `{}` has version {}, this has {ours}", status.run, status.program_version);
        return Finding::problem(VERSIONS, seen, SAME_VERSION);
    }
    let other = status.actors.iter().find_map(|actor| {
        let version = &actor.stats.as_ref()?.program_version;
        // Actors in other languages have versions of their own, which contain a space.
        (actor.alive && version != ours && !version.contains(' ')).then_some((&actor.name, version))
    });
    match other {
        Some((actor, version)) => {
            let seen = format!("actor `{actor}` has version {version}, the learner and this have {ours}");
            Finding::problem(VERSIONS, seen, SAME_VERSION)
        }
        None => Finding::ok(VERSIONS, format!("learner, actors and this program have {ours}")),
    }
}

fn skew(status: &RunStatus, now_unix_s: f64) -> Finding {
    if status.time_unix_s == 0.0 {
        return Finding::note(SKEW, "the learner does not report its time", SAME_VERSION);
    }
    let ahead_s = status.time_unix_s - now_unix_s;
    let direction = if ahead_s > 0.0 { "ahead of" } else { "behind" };
    let seen = format!("the learner's clock is {:.1} s {direction} this one", ahead_s.abs());
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
    use crate::diagnosis::finding::Severity;

    #[test]
    fn difference_of_clocks_is_reported() {
        let found = |time_unix_s| skew(&RunStatus { time_unix_s, ..RunStatus::default() }, 1000.0);
        assert_eq!(found(1001.0).severity, Severity::Ok);
        assert!(found(990.0).severity == Severity::Note && found(990.0).seen.contains("10.0 s behind"));
        assert!(found(5000.0).severity == Severity::Problem && found(5000.0).seen.contains("4000.0 s ahead"));
        assert_eq!(found(f64::NAN).severity, Severity::Problem);
        assert_eq!(found(0.0).severity, Severity::Note);
    }
}
