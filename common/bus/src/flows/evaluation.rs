//! Policies on trial: the learner's desk where evaluation actors fetch them and hand in what became of them.

use std::{
    sync::{
        Arc, RwLock,
        mpsc::{Receiver, sync_channel},
    },
    time::Duration,
};

use bytes::Bytes;
use treadmill_proto::{EvaluationReport, PolicyBundle, PolicyVersion, ident::check_ident};
use zenoh::{
    Wait,
    qos::{CongestionControl, Priority},
    query::{Query, Queryable},
};

use crate::{Bus, BusError, admission::rate_limited_log::RateLimitedLog, admission::read_throttle::ReadThrottle, keys};

/// Requests and reports that may wait; whoever finds no room asks again.
const QUEUE: usize = 64;
/// Requests that are read at full speed, each second.
const REQUESTS_PER_S: f64 = 200.0;

/// The learner's end.
pub struct EvaluationServer {
    candidate: Arc<RwLock<Option<(PolicyVersion, Bytes)>>>,
    reports: Receiver<EvaluationReport>,
    _queryable: Queryable<()>,
}

impl EvaluationServer {
    /// Opens the desk, with nothing to evaluate yet.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let candidate = Arc::new(RwLock::new(None));
        let (ask, requests) = sync_channel::<Query>(QUEUE);
        let (report, reports) = sync_channel(QUEUE);
        std::thread::Builder::new()
            .name("evaluation-desk".to_string())
            .spawn({
                let (candidate, run) = (candidate.clone(), run.to_string());
                move || {
                    let complaints = RateLimitedLog::default();
                    for query in requests {
                        let known = hand_in(&query, &run, &complaints).map(|handed: EvaluationReport| {
                            let version = handed.version;
                            // Where the queue is full the learner has reports enough.
                            drop(report.try_send(handed));
                            version
                        });
                        answer(&query, &candidate, known);
                    }
                }
            })
            .map_err(|why| BusError::Flow { what: "starting the evaluation desk".to_string(), why: why.to_string() })?;
        let throttle = ReadThrottle::new(REQUESTS_PER_S);
        let queryable = bus
            .session
            .declare_queryable(keys::evaluations(run, "*"))
            .callback(move |query| {
                throttle.pass();
                drop(ask.try_send(query));
            })
            .wait()
            .map_err(BusError::flow("handing out policies for evaluation"))?;
        Ok(Self { candidate, reports, _queryable: queryable })
    }

    /// Puts a policy on trial in place of the one before.
    pub fn put(&self, version: PolicyVersion, bundle: Bytes) {
        *self.candidate.write().expect("no holder of this lock panics") = Some((version, bundle));
    }

    /// The next report that was handed in.
    pub fn next_report(&self) -> Option<EvaluationReport> {
        self.reports.try_recv().ok()
    }
}

/// The report in a query, if there is a sound one.
fn hand_in(query: &Query, run: &str, complaints: &RateLimitedLog) -> Option<EvaluationReport> {
    let payload = query.payload().filter(|payload| !payload.is_empty())?;
    let name = keys::last_part(query.key_expr().as_str());
    let report = check_ident("evaluator", name).and_then(|()| EvaluationReport::decode(&payload.to_bytes()));
    match report {
        Ok(report) if report.run == run && report.evaluator == name => Some(report),
        Ok(report) => {
            let (run, evaluator) = (report.run, report.evaluator);
            complaints.warn(|| format!("a report of run `{run}` by `{evaluator}` came on `{name}`'s key"));
            None
        }
        Err(why) => {
            complaints.warn(|| format!("an evaluation report was refused: {why}"));
            None
        }
    }
}

fn answer(query: &Query, candidate: &RwLock<Option<(PolicyVersion, Bytes)>>, known: Option<PolicyVersion>) {
    let candidate = candidate.read().expect("no holder of this lock panics").clone();
    let bundle = match candidate {
        Some((version, bundle)) if known != Some(version) => bundle,
        _ => Bytes::new(),
    };
    if let Err(why) = query.reply(query.key_expr().clone(), bundle).wait() {
        tracing::debug!("a policy for evaluation could not be sent: {why}");
    }
}

/// What a learner answered an evaluation actor.
#[derive(Debug)]
pub enum Assignment {
    /// Nobody answered.
    Nobody,
    /// There is nothing to evaluate now.
    Nothing,
    /// This policy.
    Evaluate(Box<PolicyBundle>),
}

/// Hands in a report, if there is one, and asks for the next policy to evaluate.
pub async fn ask_for_evaluation(
    bus: &Bus,
    run: &str,
    evaluator: &str,
    report: Option<&EvaluationReport>,
    timeout: Duration,
) -> Result<Assignment, BusError> {
    let replies = bus
        .session
        .get(keys::evaluations(run, evaluator))
        .payload(report.map_or_else(Vec::new, EvaluationReport::encode))
        .timeout(timeout)
        .priority(Priority::DataLow)
        .congestion_control(CongestionControl::Block)
        .await
        .map_err(BusError::flow("asking for a policy to evaluate"))?;
    while let Ok(reply) = replies.recv_async().await {
        let Ok(sample) = reply.result() else { continue };
        let payload = Bytes::from(sample.payload().to_bytes().into_owned());
        if payload.is_empty() {
            return Ok(Assignment::Nothing);
        }
        match PolicyBundle::decode(payload) {
            Ok(bundle) => return Ok(Assignment::Evaluate(Box::new(bundle))),
            Err(why) => tracing::warn!("a policy bundle was refused: {why}"),
        }
    }
    Ok(Assignment::Nobody)
}
