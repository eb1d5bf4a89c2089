//! `treadmill eval`: plays episodes with a trained policy or a baseline.
//!
//! # Layout
//! - [`command_file`]: commands that every episode follows.
//! - [`results`]: what is printed.
//! - [`trace`]: every step, as JSON.
//! - [`filming`], [`film`]: pictures.

use std::{
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use clap::{Args, ValueEnum};
use treadmill_actor::{
    agent::{Agent, PolicyAgent, PreferredActionAgent, RandomAgent},
    evaluation::{EvaluationStep, evaluate_commanded},
};
use treadmill_config::{Config, RandomisationConfig};
use treadmill_humanoid::{Environment, TaskRegistry};
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_policy::exported::ExportedPolicy;
use treadmill_render::Look;

mod command_file;
mod film;
pub(crate) mod filming;
mod results;
mod trace;

use self::{
    command_file::CommandFile,
    filming::{FilmArgs, Filming},
    results::{Columns, as_json, headings, print_summary, row},
    trace::Trace,
};
use crate::{
    launch::{
        exit_code::Usage,
        model::{self, ModelArgs},
        output::{say, say_error, say_to_reader},
        slow_step::SlowStepNotice,
    },
    shared::{
        model_file::{ModelSource, meshes},
        saved_policy::{self, Origin, SavedPolicy},
    },
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
    fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_string()).unwrap_or_default()
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
    checkpoint: Option<CheckpointChoice>,
    /// Randomise the episodes as in training; by default they are never randomised.
    #[arg(long)]
    randomised: bool,
    #[command(flatten)]
    model: ModelArgs,
    /// Print the first and every N-th step of each episode; by default 100 for baselines, 0 (never) for the policy.
    #[arg(long, value_name = "N")]
    print_every: Option<u32>,
    /// Follow the commands of a file in every episode: lines of time_s,vx,vy,yaw_rate.
    #[arg(long, value_name = "FILE")]
    commands: Option<PathBuf>,
    /// Write each observation with its action, state and torques to a file, one JSON object per line.
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
pub fn run(args: EvalArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    let commands = args.commands.as_deref().map(CommandFile::read).transpose()?;
    let Prepared { mut environment, mut agent, origin } = prepare(&args, tasks)?;
    let has_commands = environment.task().command().is_some();
    let columns = Columns::of(&environment);
    if let Some(path) = args.commands.as_ref().filter(|_| !has_commands) {
        let why = "this task has no commands; leave --commands out, or play a policy of the velocity task";
        return Err(Usage(format!("--commands {}: {why}", path.display())).into());
    }
    if let (Some(path), Some(file)) = (&args.commands, &commands) {
        warn_of_unplayed(path, file, environment.episode_s());
    }
    let mut trace = args.trace.as_deref().map(Trace::create).transpose()?;
    let print_every = match (args.print_every, args.agent) {
        (Some(every), _) => every,
        (None, AgentKind::Policy) => 0,
        (None, _) => 100,
    };
    let prints_steps = !args.json && print_every > 0;
    let prints_rows = !args.json && print_every == 0;
    let control_step_s = environment.control_step_s();
    let mut filming = args.film.begin(control_step_s, || look(&args, &environment))?;
    let notice = SlowStepNotice::begin(format!("playing episode 1 of {}", args.episodes));
    let command_at = commands.as_ref().map(|file| |time_s: f64| file.at(time_s));
    let command_at = command_at.as_ref().map(|at| at as &dyn Fn(f64) -> [f64; 3]);
    let (episodes, seed) = (args.episodes, args.seed);
    let evaluation = evaluate_commanded(&mut environment, &mut *agent, episodes, seed, command_at, |step| {
        if step.step == 1 {
            notice.update(format!("playing episode {} of {}", step.episode, args.episodes));
        }
        if let Some(filming) = &mut filming {
            filming.record(&step);
        }
        let is_traced = trace.as_mut().is_none_or(|trace| trace.record(&step));
        let mut is_read = true;
        if prints_steps && (step.step == 1 || step.step.is_multiple_of(print_every)) {
            let EvaluationStep { episode, step, reward, total, .. } = step;
            is_read = say_to_reader(&format!(
                "episode {episode:>3}  step {step:>4}  reward {reward:>8.3}  total {total:>9.2}"
            ));
        }
        if prints_rows && let Some(played) = &step.ended {
            is_read =
                (step.episode > 1 || say_to_reader(&headings(columns))) && say_to_reader(&row(step.episode, played));
        }
        // Files are completed although the table has no reader.
        let is_wanted = is_traced && (is_read || args.trace.is_some() || filming.is_some());
        if is_wanted { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    })?;
    // The results are printed although a file cannot be written.
    let traced = trace.map(Trace::finish).transpose();
    notice.update("finishing the pictures".to_string());
    let pictures = filming.map(Filming::finish).transpose();
    drop(notice);
    if args.json {
        say(&as_json(args.agent, origin, &evaluation, control_step_s));
    } else {
        if prints_steps {
            say(&headings(columns));
            (1..).zip(&evaluation.episodes).for_each(|(episode, played)| say(&row(episode, played)));
        }
        print_summary(&args, origin.as_ref(), &evaluation, control_step_s);
        pictures.iter().flatten().for_each(|line| say(&format!("pictures      {line}")));
    }
    traced.and(pictures).map(drop)
}

/// Returns the look of a robot, by the meshes of its file if they are readable.
fn look(args: &EvalArgs, environment: &Environment) -> Look {
    let ModelArgs { model, file, .. } = &args.model;
    let source = match model {
        Some(path) => ModelSource::given(path, file).ok(),
        None => args.run.as_deref().and_then(ModelSource::of_run),
    };
    Look::of(environment.physics().model(), &meshes(source))
}

/// What plays.
struct Prepared {
    environment: Environment,
    agent: Box<dyn Agent>,
    /// Checkpoint of the policy, if that comes from one.
    origin: Option<Origin>,
}

fn prepare(args: &EvalArgs, tasks: &TaskRegistry) -> anyhow::Result<Prepared> {
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
        let text = model::completed(&config, file, &args.model.file, "")?;
        let text = model::with_given_motions(&config, &text, &args.model.motion)?;
        let environment = model::environment(tasks, &config, &text, file)?;
        let action_size = environment.action_size();
        return Ok(Prepared { environment, agent: baseline(args, action_size), origin: None });
    };
    let _step = SlowStepNotice::begin(format!("loading the policy of {run}"));
    let SavedPolicy { policy, config, origin, .. } = saved_policy::load(run, args.checkpoint)?;
    let config = configuration(args, config)?;
    model::check_flags(args.model.model.as_deref(), &args.model.file)?;
    let environment = match args.model.model.as_deref() {
        None if args.model.motion.motion.is_empty() => saved_policy::environment(tasks, run, &policy, &config)?,
        None => {
            let text = model::with_given_motions(&config, &policy.model_xml, &args.model.motion)?;
            model::environment(tasks, &config, &text, None)?
        }
        Some(file) => {
            let text = model::for_policy(&config, file, &args.model.file, &policy.model_xml)?;
            let text = model::with_given_motions(&config, &text, &args.model.motion)?;
            let environment = model::environment(tasks, &config, &text, Some(file))?;
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
    }
    let config = args.model.config(&config)?;
    if args.randomised && config.randomisation == RandomisationConfig::default() {
        let why = "--randomised plays as the run did in training, but the run randomised nothing; \
                   choose a randomisation, as in --set randomisation.push_mps=[0.5,0.5]";
        return Err(Usage(why.to_string()).into());
    }
    Ok(config)
}

/// Tests that the model has as many observations and actions as the policy.
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

/// Warns of commands that no episode reaches.
fn warn_of_unplayed(path: &Path, file: &CommandFile, episode_s: f64) {
    if let unplayed @ [first_s, ..] = file.after(episode_s) {
        say_error(&format!(
            "--commands {}: {} commands from time_s {first_s} on are not played, because episodes end at {episode_s} s; \
             set env.max_episode_steps",
            path.display(),
            unplayed.len()
        ));
    }
}
