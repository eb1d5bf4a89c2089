//! The evaluation actor: plays deterministic episodes with policies on trial, and tells the learner what became of them.

use std::time::Duration;

use treadmill_bus::{Assignment, Bus, ask_for_evaluation};
use treadmill_config::{Config, ConfigError, ConfigSource};
use treadmill_humanoid::Environment;
use treadmill_proto::{EvaluationReport, PolicyBundle};
use treadmill_runtime::shutdown::Shutdown;

use crate::{ActorError, agent::PolicyAgent, evaluation::evaluate, policies::join, settings};

const ANSWER_TIMEOUT: Duration = Duration::from_secs(10);
/// Pause between two questions for a policy.
const PAUSE: Duration = Duration::from_millis(500);

/// How this process was started.
#[derive(Clone, Debug)]
pub struct EvaluatorOptions {
    /// The run to evaluate; the only one there is if none is named.
    pub run: Option<String>,
    /// The evaluator's name.
    pub name: String,
    /// Where the learner is, for messages.
    pub where_to: String,
}

/// Runs until somebody asks to stop.
pub async fn run(bus: Bus, options: EvaluatorOptions, shutdown: Shutdown) -> Result<(), ActorError> {
    let Some(bundle) = join(&bus, options.run.as_deref(), &options.where_to, &shutdown).await? else {
        return Ok(());
    };
    settings::check_ours(&bundle.run, &config_of(&bundle)?)?;
    let run = bundle.run;
    let mut report = None;
    while !shutdown.asked() {
        let assignment = tokio::select! {
            assignment = ask_for_evaluation(&bus, &run, &options.name, report.as_ref(), ANSWER_TIMEOUT) => assignment?,
            () = shutdown.wait() => return Ok(()),
        };
        if let Assignment::Evaluate(bundle) = assignment {
            let (name, stop) = (options.name.clone(), shutdown.clone());
            let played = tokio::task::spawn_blocking(move || play(&bundle, name, &stop));
            match played.await.map_err(|why| ActorError::Physics { why: why.to_string() })? {
                Ok(played) => report = played,
                // A policy that cannot be played is no reason to leave the next one unplayed.
                Err(why) => tracing::warn!("{why}"),
            }
        }
        tokio::select! {
            () = tokio::time::sleep(PAUSE) => {}
            () = shutdown.wait() => {}
        }
    }
    Ok(())
}

fn config_of(bundle: &PolicyBundle) -> Result<Config, ConfigError> {
    let mut source = ConfigSource::default();
    source.text(&bundle.config_toml, "the configuration of the run")?;
    source.build()
}

/// Plays one policy; `None` where somebody asked to stop before the end.
fn play(bundle: &PolicyBundle, evaluator: String, shutdown: &Shutdown) -> Result<Option<EvaluationReport>, ActorError> {
    let config = config_of(bundle)?;
    let mut environment = Environment::new(&settings::environment(&config.env), &bundle.model_xml)?;
    let mut agent = PolicyAgent::of_bundle(bundle)?;
    let mut evaluations = Vec::new();
    for episode in 0..config.eval.episodes {
        if shutdown.asked() {
            return Ok(None);
        }
        // The same starts for every policy: differences between two of them are their own.
        let seed = config.run.seed.wrapping_add(u64::from(episode));
        evaluations.push(evaluate(&mut environment, &mut agent, 1, seed, |_| {})?);
    }
    let mut all = evaluations.swap_remove(0);
    all.episodes.extend(evaluations.into_iter().flat_map(|evaluation| evaluation.episodes));
    Ok(Some(EvaluationReport {
        run: bundle.run.clone(),
        evaluator,
        version: bundle.version,
        episodes: all.episodes.len() as u32,
        return_mean: all.mean(|played| played.return_sum),
        return_std: all.return_std(),
        length_mean: all.mean(|played| f64::from(played.length)),
        distance_mean_m: all.mean(|played| played.distance_m),
        velocity_mean_mps: all.velocity_mean_mps(environment.control_step_s()),
        falls: all.falls() as u32,
    }))
}
