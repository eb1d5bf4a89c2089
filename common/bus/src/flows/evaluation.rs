//! Evaluations: the learner hands out the policy to evaluate; evaluators fetch it and send reports.

use std::{
    sync::{
        Arc, Mutex,
        mpsc::{Receiver, SyncSender, sync_channel},
    },
    time::Duration,
};

use bytes::Bytes;
use treadmill_proto::{EvaluationReport, PolicyBundle, PolicyVersion, ident::check_ident};
use zenoh::{qos::Priority, query::Query};

use super::shared::{ask, last_part, next_valid, reply, serve, start_thread};
use crate::{admission::rate_limited_log::RateLimitedLog, error::BusError, session::Bus};

/// Requests, and reports, that may wait. Further requests get no answer, and the evaluator asks again.
const QUEUE: usize = 64;

/// Returns `treadmill/{run}/evaluations/{evaluator}`.
fn key(run: &str, evaluator: &str) -> String {
    format!("treadmill/{run}/evaluations/{evaluator}")
}

type Candidate = Mutex<Option<Offer>>;

/// Policy to evaluate.
struct Offer {
    version: PolicyVersion,
    bundle: Bytes,
    /// Whether an evaluator has it.
    is_handed_out: bool,
}

/// Hands out policies to evaluate and receives reports.
pub struct EvaluationServer {
    candidate: Arc<Candidate>,
    reports: Receiver<EvaluationReport>,
}

impl EvaluationServer {
    /// Starts the server, with no policy to evaluate yet.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let candidate = Arc::new(Mutex::new(None));
        let (request_sender, requests) = sync_channel::<Query>(QUEUE);
        let (report_sender, reports) = sync_channel(QUEUE);
        start_thread("evaluation-server", {
            let (candidate, run) = (candidate.clone(), run.to_string());
            move || answer_all(requests, &run, &candidate, &report_sender)
        })?;
        let receive = move |query| drop(request_sender.try_send(query));
        serve(bus, key(run, "*"), "handing out policies for evaluation", receive)?;
        Ok(Self { candidate, reports })
    }

    /// Replaces the policy to evaluate. Returns whether an evaluator has the one before.
    pub fn put(&self, version: PolicyVersion, bundle: Bytes) -> bool {
        let offer = Offer { version, bundle, is_handed_out: false };
        let before = self.candidate.lock().expect("no holder of this lock panics").replace(offer);
        before.is_some_and(|before| before.is_handed_out)
    }

    /// Returns the next report that has arrived.
    pub fn next_report(&self) -> Option<EvaluationReport> {
        self.reports.try_recv().ok()
    }
}

fn answer_all(requests: Receiver<Query>, run: &str, candidate: &Candidate, reports: &SyncSender<EvaluationReport>) {
    let rejections = RateLimitedLog::default();
    for query in requests {
        // An invalid report gets no reply: a policy is large, and its sender does not evaluate.
        let Ok(report) = read_report(&query, run, &rejections) else { continue };
        let evaluated = report.map(|report| {
            let version = report.version;
            // If the queue is full, the learner has enough reports.
            drop(reports.try_send(report));
            version
        });
        answer(&query, candidate, evaluated);
    }
}

/// Report that was rejected, and logged.
struct Rejected;

/// Returns the report in a query, if there is one.
fn read_report(query: &Query, run: &str, rejections: &RateLimitedLog) -> Result<Option<EvaluationReport>, Rejected> {
    let Some(payload) = query.payload().filter(|payload| !payload.is_empty()) else { return Ok(None) };
    let evaluator = last_part(query.key_expr().as_str());
    let report = check_ident("evaluator", evaluator).and_then(|()| EvaluationReport::decode(&payload.to_bytes()));
    match report {
        Ok(report) if report.run == run && report.evaluator == evaluator => return Ok(Some(report)),
        Ok(report) => rejections.emit(|| {
            let (run, claimed) = (report.run, report.evaluator);
            tracing::warn!(evaluator, run, claimed, "evaluation report rejected: it does not match its key");
        }),
        Err(error) => rejections.emit(|| tracing::warn!(%error, "evaluation report rejected")),
    }
    Err(Rejected)
}

/// Replies with the policy to evaluate, or with nothing if there is none or the evaluator has just evaluated it.
fn answer(query: &Query, candidate: &Candidate, evaluated: Option<PolicyVersion>) {
    let bundle = match &mut *candidate.lock().expect("no holder of this lock panics") {
        Some(offer) if !evaluated.is_some_and(|evaluated| evaluated.names_same_policy(offer.version)) => {
            offer.is_handed_out = true;
            offer.bundle.clone()
        }
        _ => Bytes::new(),
    };
    reply(query, bundle, "policy for evaluation");
}

/// Learner's answer to an evaluator.
#[derive(Debug)]
pub enum Assignment {
    /// No answer came.
    NoAnswer,
    /// There is nothing to evaluate now.
    Nothing,
    /// Evaluate this policy.
    Evaluate(Box<PolicyBundle>),
}

/// Sends a report, if there is one, and asks for the next policy to evaluate.
pub async fn ask_for_evaluation(
    bus: &Bus,
    run: &str,
    evaluator: &str,
    report: Option<&EvaluationReport>,
    timeout: Duration,
) -> Result<Assignment, BusError> {
    let report = report.map_or_else(Vec::new, EvaluationReport::encode);
    let what = "asking for a policy to evaluate";
    let replies = ask(bus, key(run, evaluator), report, timeout, Priority::DataLow, what)?;
    let decode = |payload: Bytes| match payload.is_empty() {
        true => Ok(Assignment::Nothing),
        false => PolicyBundle::decode(payload).map(|bundle| Assignment::Evaluate(Box::new(bundle))),
    };
    Ok(next_valid(&replies, "policy bundle", decode).await.unwrap_or(Assignment::NoAnswer))
}
