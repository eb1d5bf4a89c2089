//! `treadmill eval`: plays episodes with a trained policy or a baseline; [`filming`] writes pictures of them.

use std::{
    fs::File,
    io::{BufWriter, Write},
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::{Args, ValueEnum};
use serde_json::json;
use treadmill_actor::{
    ActorError,
    agent::{Agent, PolicyAgent, PreferredActionAgent, RandomAgent},
    evaluation::{EpisodeResult, Evaluation, EvaluationStep, evaluate},
};
use treadmill_config::{Config, RandomisationConfig};
use treadmill_humanoid::Environment;
use treadmill_learner::checkpoint::Which;
use treadmill_policy::exported::ExportedPolicy;
use treadmill_runtime::words::shown;

mod film;
mod filming;

use self::filming::{FilmArgs, Filming};
use crate::{
    launch::{
        exit_code::Usage,
        model::{self, ModelArgs},
        output::{say, say_to_reader},
        slow_step::SlowStepNotice,
    },
    shared::saved_policy::{self, Origin, SavedPolicy},
};

/// Source of the actions.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum AgentKind {
    /// The run's policy, without exploration.
    Policy,
    /// Uniformly random actions.
    Random,
    /// Naive learner that adjusts one preferred action.
    PreferredAction,
}

impl AgentKind {
    fn name(self) -> &'static str {
        match self {
            Self::Policy => "policy",
            Self::Random => "random",
            Self::PreferredAction => "preferred-action",
        }
    }
}

/// Flags of `eval`.
#[derive(Args)]
pub struct EvalArgs {
    /// Run folder, name below runs/, bundle file, or a file that `export` wrote; only for --agent policy.
    run: Option<String>,
    /// Episodes to play.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    episodes: u32,
    /// Seed of the resets and of the baselines.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// What chooses the actions.
    #[arg(long, value_enum, default_value = "policy")]
    agent: AgentKind,
    /// Checkpoint: best, latest, or the number of updates of a kept one; by default best if it exists.
    #[arg(long, value_name = "WHICH")]
    checkpoint: Option<Which>,
    /// Randomise the episodes as in training; by default they are never randomised.
    #[arg(long)]
    randomised: bool,
    #[command(flatten)]
    model: ModelArgs,
    /// Print the first and every N-th step of each episode; by default 100 for baselines, 0 (never) for the policy.
    #[arg(long, value_name = "N")]
    print_every: Option<u32>,
    /// Write each observation with its action to a file, one JSON object per line.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    #[command(flatten)]
    film: FilmArgs,
    /// Print only one JSON object.
    #[arg(long)]
    json: bool,
    /// Also print how well joint limits held.
    #[arg(long, conflicts_with = "json")]
    verbose: bool,
}

/// Plays the episodes and prints their results.
pub fn run(args: EvalArgs) -> anyhow::Result<()> {
    let Prepared { mut environment, agent, origin } = prepare(&args)?;
    let mut agent = TracedAgent { agent, file: None };
    if let Some(path) = &args.trace {
        let file = File::create(path).with_context(|| format!("cannot write the trace `{}`", path.display()))?;
        agent.file = Some(BufWriter::new(file));
    }
    let print_every = match (args.print_every, args.agent) {
        (Some(every), _) => every,
        (None, AgentKind::Policy) => 0,
        (None, _) => 100,
    };
    let prints_steps = !args.json && print_every > 0;
    let prints_rows = !args.json && print_every == 0;
    let control_step_s = environment.control_step_s();
    let mut filming = args.film.begin(control_step_s)?;
    let notice = SlowStepNotice::begin(format!("playing episode 1 of {}", args.episodes));
    let evaluation = evaluate(&mut environment, &mut agent, args.episodes, args.seed, |step| {
        if step.step == 1 {
            notice.update(format!("playing episode {} of {}", step.episode, args.episodes));
        }
        if let Some(filming) = &mut filming {
            filming.record(&step);
        }
        let mut is_read = true;
        if prints_steps && (step.step == 1 || step.step.is_multiple_of(print_every)) {
            let EvaluationStep { episode, step, reward, total, .. } = step;
            is_read = say_to_reader(&format!(
                "episode {episode:>3}  step {step:>4}  reward {reward:>8.3}  total {total:>9.2}"
            ));
        }
        if prints_rows && let Some(played) = &step.ended {
            is_read = (step.episode > 1 || say_to_reader(HEADINGS)) && say_to_reader(&row(step.episode, played));
        }
        // Files are completed although the table has no reader.
        let is_wanted = is_read || args.trace.is_some() || filming.is_some();
        if is_wanted { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    })?;
    agent.finish()?;
    notice.update("finishing the pictures".to_string());
    let pictures = filming.map(Filming::finish).transpose()?;
    drop(notice);
    if args.json {
        say(&as_json(args.agent, origin, &evaluation, control_step_s));
    } else {
        if prints_steps {
            say(HEADINGS);
            (1..).zip(&evaluation.episodes).for_each(|(episode, played)| say(&row(episode, played)));
        }
        print_summary(&args, origin.as_ref(), &evaluation, control_step_s);
        pictures.iter().for_each(|line| say(&format!("pictures      {line}")));
    }
    Ok(())
}

/// What plays.
struct Prepared {
    environment: Environment,
    agent: Box<dyn Agent>,
    /// Checkpoint of the policy, if that comes from one.
    origin: Option<Origin>,
}

fn prepare(args: &EvalArgs) -> anyhow::Result<Prepared> {
    let is_policy = matches!(args.agent, AgentKind::Policy);
    let Some(run) = args.run.as_ref().filter(|_| is_policy) else {
        if is_policy {
            let why = "eval needs a RUN, as in `treadmill eval runs/walk-1`; or choose --agent random".to_string();
            return Err(Usage(why).into());
        }
        let unused = [("RUN", args.run.is_some()), ("--checkpoint", args.checkpoint.is_some())];
        if let Some((unused, _)) = unused.into_iter().find(|(_, is_given)| *is_given) {
            let agent = args.agent.name();
            let why =
                format!("--agent {agent} plays without a policy; leave {unused} out, or leave --agent {agent} out");
            return Err(Usage(why).into());
        }
        let config = configuration(args, Config::default())?;
        let file = args.model.model.as_deref();
        let environment = model::environment(&config, &model::completed(&config, file)?, file)?;
        let action_size = environment.action_size();
        return Ok(Prepared { environment, agent: baseline(args, action_size), origin: None });
    };
    let _step = SlowStepNotice::begin(format!("loading the policy of {run}"));
    let SavedPolicy { policy, origin, .. } = saved_policy::load(run, args.checkpoint)?;
    let config = configuration(args, policy.config())?;
    let environment = match args.model.model.as_deref() {
        None => saved_policy::environment(run, &policy, &config)?,
        Some(file) => {
            let environment = model::environment(&config, &model::completed(&config, Some(file))?, Some(file))?;
            check_fits(&policy, &environment, file)?;
            environment
        }
    };
    Ok(Prepared { environment, agent: Box::new(PolicyAgent::new(&policy)?), origin })
}

/// Returns the run's configuration, with randomisation only if the flag asks for it.
fn configuration(args: &EvalArgs, mut config: Config) -> anyhow::Result<Config> {
    if !args.randomised {
        config.randomisation = RandomisationConfig::default();
    } else if config.randomisation == RandomisationConfig::default() {
        let why = "--randomised plays as the run did in training, but the run randomised nothing; \
                   choose a randomisation, as in --set randomisation.push_mps=[0.5,0.5]";
        return Err(Usage(why.to_string()).into());
    }
    args.model.config(&config)
}

/// Tests that the model has as many observations and actions as the policy; the user must know that they mean the same.
fn check_fits(policy: &ExportedPolicy, environment: &Environment, file: &Path) -> Result<(), Usage> {
    let wanted = (policy.shape.observation, policy.shape.action);
    let found = (environment.observation_size(), environment.action_size());
    if found == wanted {
        return Ok(());
    }
    Err(Usage(format!(
        "model file `{}` has {} observations and {} actions, the run's policy {} and {}; leave out --model to evaluate on \
         the run's own model",
        file.display(),
        found.0,
        found.1,
        wanted.0,
        wanted.1
    )))
}

fn baseline(args: &EvalArgs, action_size: usize) -> Box<dyn Agent> {
    match args.agent {
        AgentKind::PreferredAction => Box::new(PreferredActionAgent::new(args.seed, action_size)),
        _ => Box::new(RandomAgent::new(args.seed)),
    }
}

/// Agent whose observations and actions are written to a file.
struct TracedAgent {
    agent: Box<dyn Agent>,
    file: Option<BufWriter<File>>,
}

impl TracedAgent {
    fn finish(&mut self) -> anyhow::Result<()> {
        self.file.as_mut().map_or(Ok(()), |file| file.flush()).context("cannot write the trace")
    }
}

impl Agent for TracedAgent {
    fn act(&mut self, observation: &[f32], action: &mut [f32]) -> Result<(), ActorError> {
        self.agent.act(observation, action)?;
        if let Some(file) = &mut self.file {
            let line = json!({"observation": observation, "action": action});
            writeln!(file, "{line}").map_err(ActorError::Trace)?;
        }
        Ok(())
    }

    fn rewarded(&mut self, reward: f32) {
        self.agent.rewarded(reward);
    }

    fn episode_ended(&mut self) {
        self.agent.episode_ended();
    }
}

const HEADINGS: &str = "episode      return  length  distance m  velocity m/s  end";

fn row(episode: u32, played: &EpisodeResult) -> String {
    let end = match (played.fault, played.fell) {
        (true, _) => "non-finite",
        (_, true) => "fell",
        _ => "time limit",
    };
    let EpisodeResult { return_sum, length, distance_m, velocity_mps, .. } = played;
    format!("{episode:>7} {return_sum:>11.1} {length:>7} {distance_m:>11.2} {velocity_mps:>13.2}  {end}")
}

fn print_summary(args: &EvalArgs, origin: Option<&Origin>, evaluation: &Evaluation, control_step_s: f64) {
    say("");
    let from = origin.map(|origin| format!(" of {origin}")).unwrap_or_default();
    say(&format!("agent         {}{from}", args.agent.name()));
    say(&format!("episodes      {}, {} of them ended with a fall", evaluation.episodes.len(), evaluation.falls()));
    let (mean, std) = (evaluation.mean(|played| played.return_sum), evaluation.return_std());
    say(&shown(&format!("return        {mean:.1} ± {std:.1}")));
    say(&format!("length        {:.1} steps", evaluation.mean(|played| f64::from(played.length))));
    say(&format!("distance      {:.2} m", evaluation.mean(|played| played.distance_m)));
    say(&format!("velocity      {:.2} m/s", evaluation.velocity_mean_mps(control_step_s)));
    if args.verbose {
        let joints = &evaluation.joints;
        say(&format!(
            "joints        limit overshoot {:.3} rad (99.9 % of steps; largest {:.3} rad)",
            joints.overshoot_p999_rad, joints.overshoot_max_rad
        ));
    }
}

fn as_json(agent: AgentKind, origin: Option<Origin>, evaluation: &Evaluation, control_step_s: f64) -> String {
    let joints = &evaluation.joints;
    let (checkpoint, env_steps) = origin.map(|Origin { checkpoint, env_steps }| (checkpoint, env_steps)).unzip();
    json!({
        "agent": agent.name(),
        "checkpoint": checkpoint,
        "checkpoint_env_steps": env_steps,
        "episodes": evaluation.episodes.len(),
        "return_mean": evaluation.mean(|played| played.return_sum),
        "return_std": evaluation.return_std(),
        "length_mean": evaluation.mean(|played| f64::from(played.length)),
        "distance_mean_m": evaluation.mean(|played| played.distance_m),
        "velocity_mean_mps": evaluation.velocity_mean_mps(control_step_s),
        "falls": evaluation.falls(),
        "faults": evaluation.episodes.iter().filter(|played| played.fault).count(),
        "limit_overshoot_p999_rad": joints.overshoot_p999_rad,
        "limit_overshoot_max_rad": joints.overshoot_max_rad,
    })
    .to_string()
}
