//! `treadmill eval`: plays episodes with a trained policy or a baseline; [`filming`] writes pictures of them.

use std::{
    fs::File,
    io::{BufWriter, Write},
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::{Args, ValueEnum};
use serde_json::json;
use treadmill_actor::{
    ActorError,
    agent::{Agent, PolicyAgent, PreferredActionAgent, RandomAgent},
    evaluation::{Evaluation, EvaluationStep, evaluate},
};
use treadmill_config::{Config, RandomisationConfig};
use treadmill_humanoid::Environment;
use treadmill_learner::checkpoint::Which;
use treadmill_policy::exported::ExportedPolicy;

mod filming;

use self::filming::{FilmArgs, Filming};
use crate::{
    launch::{
        exit_code::Usage,
        model::{self, ModelArgs},
        output::say,
        slow_step::SlowStepNotice,
    },
    shared::saved_policy,
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
    /// Run folder, name below runs/, bundle file, or a file that `export` wrote; needed only for --agent policy.
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
}

/// Plays the episodes and prints their results.
pub fn run(args: EvalArgs) -> anyhow::Result<()> {
    let (mut environment, agent) = prepare(&args)?;
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
    let quiet = args.json || print_every == 0;
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
        if !quiet && (step.step == 1 || step.step.is_multiple_of(print_every)) {
            let EvaluationStep { episode, step, reward, total, .. } = step;
            say(&format!("episode {episode:>3}  step {step:>4}  reward {reward:>8.3}  total {total:>9.2}"));
        }
    })?;
    agent.finish()?;
    notice.update("finishing the pictures".to_string());
    let pictures = filming.map(Filming::finish).transpose()?;
    drop(notice);
    if args.json {
        say(&as_json(args.agent, &evaluation, control_step_s));
    } else {
        print_table(args.agent, &evaluation, control_step_s);
        pictures.iter().for_each(|line| say(&format!("pictures      {line}")));
    }
    Ok(())
}

fn prepare(args: &EvalArgs) -> anyhow::Result<(Environment, Box<dyn Agent>)> {
    let Some(run) = &args.run else {
        if matches!(args.agent, AgentKind::Policy) {
            let why = "eval needs a RUN, as in `treadmill eval runs/walk-1`; or choose --agent random".to_string();
            return Err(Usage(why).into());
        }
        let config = configuration(args, Config::default())?;
        let file = args.model.model.as_deref();
        let environment = model::environment(&config, &model::text(file)?, file)?;
        let action_size = environment.action_size();
        return Ok((environment, baseline(args, action_size)));
    };
    let _step = SlowStepNotice::begin(format!("loading the policy of {run}"));
    let policy = saved_policy::load(run, args.checkpoint.unwrap_or(Which::BestOrLatest))?;
    let config = configuration(args, saved_policy::trained_under(&policy))?;
    let environment = match args.model.model.as_deref() {
        None => saved_policy::environment(run, &policy, &config)?,
        Some(file) => {
            let environment = model::environment(&config, &model::text(Some(file))?, Some(file))?;
            check_fits(&policy, &environment, args.agent, file)?;
            environment
        }
    };
    let agent: Box<dyn Agent> = match args.agent {
        AgentKind::Policy => Box::new(PolicyAgent::new(&policy)?),
        _ => baseline(args, environment.action_size()),
    };
    Ok((environment, agent))
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
fn check_fits(policy: &ExportedPolicy, environment: &Environment, agent: AgentKind, file: &Path) -> Result<(), Usage> {
    let wanted = (policy.shape.observation, policy.shape.action);
    let found = (environment.observation_size(), environment.action_size());
    if found == wanted || !matches!(agent, AgentKind::Policy) {
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

fn print_table(agent: AgentKind, evaluation: &Evaluation, control_step_s: f64) {
    say("episode      return  length  distance m  velocity m/s  end");
    for (index, played) in evaluation.episodes.iter().enumerate() {
        let end = match (played.fault, played.fell) {
            (true, _) => "non-finite",
            (_, true) => "fell",
            _ => "time limit",
        };
        say(&format!(
            "{:>7} {:>11.1} {:>7} {:>11.2} {:>13.2}  {end}",
            index + 1,
            played.return_sum,
            played.length,
            played.distance_m,
            played.velocity_mps
        ));
    }
    let joints = &evaluation.joints;
    say("");
    say(&format!("agent         {}", agent.name()));
    say(&format!("episodes      {}, {} of them ended with a fall", evaluation.episodes.len(), evaluation.falls()));
    say(&format!("return        {:.1} ± {:.1}", evaluation.mean(|played| played.return_sum), evaluation.return_std()));
    say(&format!("length        {:.1} steps", evaluation.mean(|played| f64::from(played.length))));
    say(&format!("distance      {:.2} m", evaluation.mean(|played| played.distance_m)));
    say(&format!("velocity      {:.2} m/s", evaluation.velocity_mean_mps(control_step_s)));
    say(&format!(
        "joints        limit overshoot {:.3} rad (99.9 % of steps; largest {:.3} rad)",
        joints.overshoot_p999_rad, joints.overshoot_max_rad
    ));
}

fn as_json(agent: AgentKind, evaluation: &Evaluation, control_step_s: f64) -> String {
    let joints = &evaluation.joints;
    json!({
        "agent": agent.name(),
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
