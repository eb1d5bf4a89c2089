//! Evaluator process: plays deterministic episodes with policies that the learner assigns, and reports the results.

use std::{ops::ControlFlow, time::Duration};

use treadmill_bus::{
    Bus,
    actor::{Assignment, ask_for_evaluation},
};
use treadmill_humanoid::{Environment, TaskRegistry};
use treadmill_proto::{EvaluationReport, PolicyBundle};
use treadmill_runtime::{epoch::SeenEpoch, error_chain, shutdown::Shutdown};

use crate::{
    ActorError,
    agent::PolicyAgent,
    evaluation::{Evaluation, evaluate},
    policy_fetcher::{Explain, join_run},
    settings::RunSettings,
};

const ANSWER_TIMEOUT: Duration = Duration::from_secs(10);
/// Pause between two requests for a policy.
const PAUSE: Duration = Duration::from_millis(500);

/// Options of an evaluator process.
#[derive(Clone)]
pub struct EvaluatorOptions {
    /// Name of the run; without it, the only run of the endpoint.
    pub run: Option<String>,
    /// Name of the evaluator.
    pub name: String,
    /// Tasks that this program can simulate.
    pub tasks: TaskRegistry,
    /// Explains why the run does not answer.
    pub explain: Explain,
}

/// Evaluates policies until a request to stop.
pub async fn run(bus: Bus, options: EvaluatorOptions, shutdown: Shutdown) -> Result<(), ActorError> {
    let epochs = SeenEpoch::default();
    let Some(bundle) = join_run(&bus, options.run.as_deref(), &options.explain, &epochs, &shutdown).await? else {
        return Ok(());
    };
    RunSettings::simulated(&bundle)?;
    let run = bundle.run;
    let mut report = None;
    while !shutdown.asked() {
        let assignment = tokio::select! {
            assignment = ask_for_evaluation(&bus, &run, &options.name, report.as_ref(), ANSWER_TIMEOUT) => assignment?,
            () = shutdown.wait() => return Ok(()),
        };
        if let Assignment::Evaluate(bundle) = assignment {
            let (name, tasks, stop) = (options.name.clone(), options.tasks.clone(), shutdown.clone());
            let result = tokio::task::spawn_blocking(move || play(&bundle, name, &tasks, &stop)).await;
            match result.map_err(ActorError::Evaluation)? {
                Ok(finished) => report = finished,
                // The next policy may be sound, so the evaluator continues.
                Err(error) => tracing::warn!(error = %error_chain(&error), "policy not evaluated"),
            }
        }
        tokio::select! {
            () = tokio::time::sleep(PAUSE) => {}
            () = shutdown.wait() => {}
        }
    }
    Ok(())
}

/// Plays the episodes of one policy; returns `None` after a request to stop.
fn play(
    bundle: &PolicyBundle,
    evaluator: String,
    tasks: &TaskRegistry,
    shutdown: &Shutdown,
) -> Result<Option<EvaluationReport>, ActorError> {
    let settings = RunSettings::simulated(bundle)?;
    let mut environment = Environment::with_tasks(&settings.environment.plain(), &bundle.model_xml, tasks)?;
    let mut agent = PolicyAgent::of_bundle(bundle)?;
    let mut all = Evaluation::default();
    for episode in 0..settings.eval.episodes {
        if shutdown.asked() {
            return Ok(None);
        }
        // Every policy starts from the same states, so that differences between policies are their own.
        let seed = settings.run.seed.wrapping_add(u64::from(episode));
        environment.choose_start(episode.into());
        all.episodes.extend(evaluate(&mut environment, &mut agent, 1, seed, |_| ControlFlow::Continue(()))?.episodes);
    }
    let (tracking, imitation) = (all.tracking(), all.imitation());
    Ok(Some(EvaluationReport {
        run: bundle.run.clone(),
        evaluator,
        version: bundle.version,
        episodes: all.episodes.len() as u32,
        return_mean: all.mean(|episode| episode.return_sum),
        return_std: all.return_std(),
        length_mean: all.mean(|episode| f64::from(episode.length)),
        distance_mean_m: all.mean(|episode| episode.distance_m),
        velocity_mean_mps: all.velocity_mean_mps(environment.control_step_s()),
        falls: all.falls() as u32,
        velocity_error_mps: tracking.and_then(|tracking| tracking.velocity_error_mps()),
        yaw_rate_error_radps: tracking.and_then(|tracking| tracking.yaw_rate_error_radps()),
        anchor_error_m: imitation.map(|imitation| imitation.anchor_error_m()),
        body_error_m: imitation.map(|imitation| imitation.body_error_m()),
        body_error_rad: imitation.map(|imitation| imitation.body_error_rad()),
        hinge_error_rad: imitation.map(|imitation| imitation.hinge_error_rad()),
        done_share: imitation.map(|imitation| imitation.done_share()),
    }))
}
