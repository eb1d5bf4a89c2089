//! `treadmill eval`: plays episodes with a trained policy or a baseline.
//!
//! # Layout
//! - [`command_file`]: commands that every episode follows.
//! - [`trace`]: every step, as JSON.
//! - [`filming`], [`film`]: pictures.

use std::{
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use clap::{Args, ValueEnum};
use serde_json::json;
use treadmill_actor::{
    agent::{Agent, PolicyAgent, PreferredActionAgent, RandomAgent},
    evaluation::{
        EpisodeResult, Evaluation, EvaluationStep, evaluate_commanded, imitation::Imitation, tracking::Tracking,
    },
};
use treadmill_config::{ChosenTask, Config, RandomisationConfig};
use treadmill_humanoid::{Environment, TaskRegistry, mjcf::visual_meshes};
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_policy::exported::ExportedPolicy;
use treadmill_render::Look;
use treadmill_runtime::words::shown;

mod command_file;
mod film;
pub(crate) mod filming;
mod trace;

use self::{
    command_file::CommandFile,
    filming::{FilmArgs, Filming},
    trace::Trace,
};
use crate::{
    launch::{
        exit_code::Usage,
        model::{self, ModelArgs},
        output::{say, say_error, say_to_reader},
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
    let mut filming = args.film.begin(control_step_s, || look(&args.model, &environment))?;
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
fn look(args: &ModelArgs, environment: &Environment) -> Look {
    let meshes = args.model.as_deref().map(|file| visual_meshes(file, &args.file.files()));
    let meshes =
        meshes.and_then(|meshes| meshes.inspect_err(|why| tracing::warn!(error = %why, "meshes not shown")).ok());
    Look::of(environment.physics().model(), &meshes.unwrap_or_default())
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

/// Figures of the task beside return and way.
#[derive(Clone, Copy)]
enum Columns {
    None,
    Tracking,
    Imitation,
}

impl Columns {
    fn of(environment: &Environment) -> Self {
        match environment.config().env.chosen_task() {
            ChosenTask::Motion => Self::Imitation,
            _ if environment.task().command().is_some() => Self::Tracking,
            _ => Self::None,
        }
    }
}

fn headings(columns: Columns) -> String {
    let errors = match columns {
        Columns::None => "",
        Columns::Tracking => "  error m/s  error rad/s",
        Columns::Imitation => "  done %  bodies cm  bodies deg  hinges rad",
    };
    format!("episode      return  length  distance m  velocity m/s{errors}  end")
}

fn row(episode: u32, played: &EpisodeResult) -> String {
    let end = match (played.fault, played.fell) {
        (true, _) => "non-finite",
        (_, true) => "fell",
        _ if played.imitation.is_some() => "finished",
        _ => "time limit",
    };
    let EpisodeResult { return_sum, length, distance_m, velocity_mps, tracking, imitation, .. } = played;
    let errors = tracking.map(|tracking| {
        let (velocity, yaw_rate) = (number(tracking.velocity_error_mps()), number(tracking.yaw_rate_error_radps()));
        format!(" {velocity:>10} {yaw_rate:>12}")
    });
    let errors = errors.or_else(|| {
        let imitation = imitation.as_ref()?;
        Some(format!(
            " {:>7.0} {:>10.1} {:>11.1} {:>11.3}",
            100.0 * imitation.done_share(),
            100.0 * imitation.body_error_m(),
            imitation.body_error_rad().to_degrees(),
            imitation.hinge_error_rad()
        ))
    });
    let errors = errors.unwrap_or_default();
    format!("{episode:>7} {return_sum:>11.1} {length:>7} {distance_m:>11.2} {velocity_mps:>13.2}{errors}  {end}")
}

fn print_summary(args: &EvalArgs, origin: Option<&Origin>, evaluation: &Evaluation, control_step_s: f64) {
    say("");
    let from = origin.map(|origin| format!(" of {origin}")).unwrap_or_default();
    say(&format!("agent         {}{from}", args.agent.name()));
    let (episodes, falls) = (evaluation.episodes.len(), evaluation.falls());
    let share = match evaluation.tracking() {
        Some(_) => format!(" ({:.0} %)", 100.0 * falls as f64 / episodes.max(1) as f64),
        None => String::new(),
    };
    say(&format!("episodes      {episodes}, {falls} of them ended with a fall{share}"));
    let (mean, std) = (evaluation.mean(|played| played.return_sum), evaluation.return_std());
    say(&shown(&format!("return        {mean:.1} ± {std:.1}")));
    say(&format!("length        {:.1} steps", evaluation.mean(|played| f64::from(played.length))));
    say(&format!("distance      {:.2} m", evaluation.mean(|played| played.distance_m)));
    say(&format!("velocity      {:.2} m/s", evaluation.velocity_mean_mps(control_step_s)));
    if let Some(tracking) = evaluation.tracking() {
        print_tracking(&tracking);
    }
    if let Some(imitation) = evaluation.imitation() {
        print_imitation(&imitation, episodes);
    }
    if args.verbose {
        let joints = &evaluation.joints;
        say(&format!(
            "joints        limit overshoot {:.3} rad (99.9 % of steps; largest {:.3} rad)",
            joints.overshoot_p999_rad, joints.overshoot_max_rad
        ));
    }
}

fn print_imitation(imitation: &Imitation, episodes: usize) {
    let (finished, done) = (imitation.finished(), 100.0 * imitation.done_share());
    say(&format!("finished      {finished} of {episodes}; {done:.1} % of the motion in the mean"));
    say(&format!(
        "anchor        {:.1} cm, {:.1}°",
        100.0 * imitation.anchor_error_m(),
        imitation.anchor_error_rad().to_degrees()
    ));
    let (bodies_cm, turned) = (100.0 * imitation.body_error_m(), imitation.body_error_rad().to_degrees());
    say(&format!("bodies        {bodies_cm:.1} cm, {turned:.1}°, with the anchors above each other"));
    say(&format!("hinges        {:.3} rad", imitation.hinge_error_rad()));
    if let Some((error_m, from_s)) = imitation.worst_second() {
        say(&format!("worst second  bodies {:.1} cm, from {from_s:.1} s of the motion on", 100.0 * error_m));
    }
}

fn print_tracking(tracking: &Tracking) {
    match (tracking.velocity_error_mps(), tracking.yaw_rate_error_radps()) {
        (Some(velocity), Some(yaw_rate)) => {
            say(&format!("tracking      {velocity:.2} m/s, {yaw_rate:.2} rad/s ({} windows of 1 s)", tracking.windows))
        }
        _ => say("tracking      unknown: no command lasted for 2 s without a push or a fall"),
    }
    say(&format!(
        "energy        {} J/m",
        tracking.energy_per_metre_jpm().map_or("-".into(), |jpm| format!("{jpm:.0}"))
    ));
    say(&format!("foot slip     {} m/s", number(tracking.foot_slip_mps())));
    if let (Some(drift_m), Some(hinge_radps), Some(lifts)) =
        (tracking.standing_drift_m(), tracking.standing_hinge_radps(), tracking.standing_lifts_per_s())
    {
        say(&format!(
            "standing      drifts {drift_m:.2} m, hinges turn at {hinge_radps:.2} rad/s, {lifts:.2} lifts/s of a foot"
        ));
    }
    say(&format!("pushes        {}", tracking.pushes));
}

/// Returns a number with two decimals, or a dash for none.
fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_string(), |value| format!("{value:.2}"))
}

fn as_json(agent: AgentKind, origin: Option<Origin>, evaluation: &Evaluation, control_step_s: f64) -> String {
    let joints = &evaluation.joints;
    let (checkpoint, env_steps) = origin.map(|Origin { checkpoint, env_steps }| (checkpoint, env_steps)).unzip();
    let mut fields = json!({
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
    });
    if let Some(imitation) = evaluation.imitation() {
        fields["finished"] = json!(imitation.finished());
        fields["done_share"] = json!(imitation.done_share());
        fields["anchor_error_m"] = json!(imitation.anchor_error_m());
        fields["anchor_error_rad"] = json!(imitation.anchor_error_rad());
        fields["body_error_m"] = json!(imitation.body_error_m());
        fields["body_error_rad"] = json!(imitation.body_error_rad());
        fields["hinge_error_rad"] = json!(imitation.hinge_error_rad());
        let worst = imitation.worst_second();
        fields["worst_second"] =
            json!(worst.map(|(error_m, from_s)| json!({"body_error_m": error_m, "from_s": from_s})));
    }
    if let Some(tracking) = evaluation.tracking() {
        fields["velocity_error_mps"] = json!(tracking.velocity_error_mps());
        fields["yaw_rate_error_radps"] = json!(tracking.yaw_rate_error_radps());
        fields["energy_per_metre_jpm"] = json!(tracking.energy_per_metre_jpm());
        fields["foot_slip_mps"] = json!(tracking.foot_slip_mps());
        fields["standing_drift_m"] = json!(tracking.standing_drift_m());
        fields["standing_hinge_radps"] = json!(tracking.standing_hinge_radps());
        fields["standing_lifts_per_s"] = json!(tracking.standing_lifts_per_s());
        fields["pushes"] = json!(tracking.pushes);
        fields["windows"] = json!(tracking.windows);
    }
    fields.to_string()
}
