//! Text that `train` and `learner` print: before a run its goal, files and commands to watch, stop and resume it; after
//! a run its result and the next commands.

use std::{net::SocketAddr, path::Path};

use treadmill_bus::{Credentials, Role};
use treadmill_config::{ChosenTask, Config};
use treadmill_humanoid::{Model, motion::MotionClip, worlds_per_pass};
use treadmill_learner::{checkpoint::TrainingState, metrics::RunFigures, training::TrainingSummary};
use treadmill_ppo::BatchSize;
use treadmill_runtime::{numbers::thousands, run_folder::RunFolder, words::quoted};

use crate::{
    diagnosis::certificates,
    launch::{
        output::{say, say_error},
        prepared::{Prepared, RunSetup},
    },
};

/// Addresses of the pages that a process serves.
pub struct Pages {
    /// Metrics and health.
    pub metrics: Option<SocketAddr>,
    /// Page in the browser.
    pub watch: Option<String>,
}

/// Prints the banner of a run. `actors` is the number of actor processes that this process starts.
pub fn print_start(
    prepared: &Prepared,
    endpoints: &[String],
    credentials: Option<&Credentials>,
    actors: Option<u32>,
    pages: &Pages,
) {
    let Prepared { setup, state } = prepared;
    let RunSetup { config, folder, run, .. } = setup;
    let root = quoted(&folder.root().display().to_string());
    let steps = state.known().map_or(0, |state| state.counters.env_steps);
    let verb = match (steps, config.env.chosen_task(), &config.task.name[..]) {
        (1.., ..) if setup.origin.is_some() => format!("branching off at {} env steps", thousands(steps)),
        (1.., ..) => format!("resuming at {} env steps", thousands(steps)),
        (0, ChosenTask::HumanoidV5 | ChosenTask::HumanoidV4, _) => "training a humanoid to walk".to_string(),
        (0, ChosenTask::Velocity, _) => "training a robot to follow commands".to_string(),
        (0, ChosenTask::Motion, _) => "training a robot to imitate motions".to_string(),
        (0, ChosenTask::External, "") => "training the task that its first actor registers".to_string(),
        (0, ChosenTask::External | ChosenTask::Own(_), _) => format!("training `{}`", config.task_name()),
    };
    say(&format!("run `{run}`: {verb}"));
    say(&format!("  learns    {}", goal(config, steps)));
    if let Some(robot) = state.known().and_then(|state| robot(config, &state.model_xml)) {
        say(&format!("  robot     {robot}"));
    }
    if let Some(origin) = &setup.origin {
        say(&format!("  begins    with the policy of {origin}"));
    }
    say(&format!("  files     {root}  (curves: tensorboard --logdir {root}, or {root}/learning_curve.png)"));
    match actors {
        Some(actors) => {
            let processes = if actors == 1 { "1 process".to_string() } else { format!("{actors} processes") };
            let hint = if config.is_external() { String::new() } else { idle_lanes(config, actors) };
            say(&format!("  actors    {processes} beside this one{hint}"));
            setup.choice.iter().for_each(|choice| say(&format!("  chose     {choice}")));
        }
        None => {
            say(&format!("  actors    none yet; start some by: {}", actor_command(setup, &endpoints[0], credentials)))
        }
    }
    say(&format!("  listening {}", endpoints.join(", ")));
    let tls = credentials.map(|credentials| tls_flag(credentials, Role::Observer)).unwrap_or_default();
    say(&format!("  watch     treadmill status --watch {root}{tls}"));
    match &pages.watch {
        Some(link) => say(&format!("  page      {link}  (the robot and its curves, in a browser)")),
        None if config.is_external() => {}
        None => say(&format!("            treadmill watch {root}  (the robot and its curves, in a browser)")),
    }
    if !config.is_external() {
        say(&format!("  film      treadmill eval {root} --episodes 1 --film walk.gif, also while it trains"));
    }
    if credentials
        .is_some_and(|of_learner| [Role::Actor, Role::Observer].iter().any(|role| !has_keys(of_learner, *role)))
    {
        say("  DIR       the folder of that machine's own keys, made by `treadmill certs`");
    }
    if let Some(of_learner) = credentials.filter(|of_learner| only_names_itself(of_learner, endpoints)) {
        let folder = quoted(&of_learner.folder.display().to_string());
        say(&format!(
            "  hosts     other machines need this one's name: treadmill certs {folder} --host NAME, and a new start"
        ));
    }
    if let Some(address) = pages.metrics {
        say(&format!("  metrics   http://{address}/metrics"));
    }
    let command = actors.map_or("learner", |_| "train");
    say("  stop      Ctrl-C once finishes the update and saves");
    if let Some(url) = &setup.store {
        say(&format!("  state     in {url}; any learner with the same --store can take over"));
    }
    say(&format!("  resume    {}", setup.resume_command(command)));
}

/// Describes the robot of a velocity run.
fn robot(config: &Config, model_xml: &str) -> Option<String> {
    let model = Model::from_mjcf(model_xml).ok()?;
    match config.env.chosen_task() {
        ChosenTask::Velocity => {}
        ChosenTask::Motion => return Some(imitator(&model)),
        _ => return None,
    }
    let feet: Vec<&str> =
        model.robot.iter().flat_map(|robot| &robot.feet).map(|foot| &*model.links[*foot].name).collect();
    let [back_mps, forward_mps] = config.velocity.lin_vel_x_mps;
    Some(format!(
        "{:.1} kg on {}; the policy moves {} of {} hinges, at {back_mps} to {forward_mps} m/s",
        model.mass_kg(),
        feet.join(" and "),
        model.motors.len(),
        model.hinges.len()
    ))
}

/// Describes the robot of a motion run.
fn imitator(model: &Model) -> String {
    let seconds: f64 = model.motions.iter().map(MotionClip::duration_s).sum();
    let motions = match &*model.motions {
        [motion] => format!("`{}`, {seconds:.1} s", motion.name),
        motions => format!("{} motions, {seconds:.1} s", motions.len()),
    };
    let (moved, hinges) = (model.motors.len(), model.hinges.len());
    format!("{:.1} kg; the policy moves {moved} of {hinges} hinges; imitates {motions}", model.mass_kg())
}

/// Returns the command that starts an actor of this run.
pub fn actor_command(setup: &RunSetup, endpoint: &str, credentials: Option<&Credentials>) -> String {
    let command = match setup.config.is_external() {
        true => "python -m treadmill_actor --env NAME",
        false => "treadmill actor",
    };
    format!("{command} --connect {} --run {}", connect_flags(endpoint, credentials), setup.run)
}

/// Returns the goal and the number of steps to it. The progress display adds the remaining time.
fn goal(config: &Config, steps: u64) -> String {
    let (wanted, batch) = (config.run.steps, BatchSize::of(&config.ppo).transitions as u64);
    let left = wanted.saturating_sub(steps);
    let goal = match config.env.chosen_task() {
        ChosenTask::External | ChosenTask::Own(_) => "to earn the task's rewards",
        ChosenTask::Motion => "to stay with the motions to their ends",
        ChosenTask::Velocity => "to follow velocity commands and not to fall",
        ChosenTask::HumanoidV5 | ChosenTask::HumanoidV4 => "to go forward and not to fall",
    };
    let updates = left.div_ceil(batch.max(1));
    let (left, updates) = (thousands(left), thousands(updates));
    format!(
        "{goal}, in {left} env steps (at most {updates} updates); the remaining time appears once the speed is known"
    )
}

/// Returns the value of `--connect` for other processes, with further flags that they need. An address that means "all
/// interfaces" becomes the host's name, or a name in the certificate, without which no other side accepts it.
fn connect_flags(endpoint: &str, credentials: Option<&Credentials>) -> String {
    let mut host = treadmill_runtime::machine::host_name();
    let known = credentials.map(hosts).unwrap_or_default();
    if !known.is_empty() && !known.contains(&host) {
        host.clone_from(known.iter().find(|name| certificates::is_far(name)).unwrap_or(&known[0]));
    }
    let dialled = endpoint.replace("/0.0.0.0:", &format!("/{host}:")).replace("/[::]:", &format!("/{host}:"));
    match credentials {
        Some(credentials) => dialled + &tls_flag(credentials, Role::Actor),
        None if dialled.contains(&host) && dialled != endpoint => format!("{dialled} --insecure"),
        None => dialled,
    }
}

/// Returns the hosts that the certificate of this process names.
fn hosts(credentials: &Credentials) -> Vec<String> {
    certificates::hosts_in(&credentials.files()[0]).unwrap_or_default()
}

/// Returns whether a process listens for other machines, with a certificate that none of them accepts.
fn only_names_itself(credentials: &Credentials, endpoints: &[String]) -> bool {
    let is_open = |endpoint: &String| endpoint.contains("/0.0.0.0:") || endpoint.contains("/[::]:");
    endpoints.iter().any(is_open) && !hosts(credentials).iter().any(|host| certificates::is_far(host))
}

/// Returns the flag that names the certificates of a role, after a space. A folder that was copied may have only the
/// learner's.
fn tls_flag(credentials: &Credentials, role: Role) -> String {
    match has_keys(credentials, role) {
        true => format!(" --tls {}", quoted(&credentials.folder.display().to_string())),
        false => " --tls DIR".to_string(),
    }
}

fn has_keys(credentials: &Credentials, role: Role) -> bool {
    Credentials { role, ..credentials.clone() }.missing().is_none()
}

/// Prints the endpoints of the last start, one in a line of `before`, that this one does not have, if other processes may
/// still look for the run there: all of a `learner`, or those beyond this machine.
pub fn print_lost_endpoints(before: &str, now: &[String], is_learner: bool) {
    let is_free = |endpoint: &str| !is_learner && endpoint.contains("/127.0.0.1:");
    let lost = before.lines().filter(|endpoint| !now.iter().any(|now| now == endpoint) && !is_free(endpoint));
    let lost: Vec<String> = lost.map(|endpoint| format!("--listen {endpoint}")).collect();
    if !lost.is_empty() {
        say_error(&format!(
            "the run listened elsewhere before, and actors look for it there; to go on so: {}",
            lost.join(" ")
        ));
    }
}

/// Prints that a run has all its steps; `resumed_by` resumes it.
pub fn print_finished(state: &TrainingState, resumed_by: &str) {
    let steps = state.counters.env_steps;
    say(&format!(
        "run `{}` is finished: it has {} steps; go on with: {resumed_by} --steps {}",
        state.run,
        thousands(steps),
        steps.saturating_mul(2)
    ));
}

/// Returns a hint if the processor could simulate more environments of each actor in the same time; empty if not.
fn idle_lanes(config: &Config, actors: u32) -> String {
    let (lanes, envs) = (worlds_per_pass() as u32, config.rollout.envs.div_ceil(actors.max(1)));
    match envs.next_multiple_of(lanes) {
        filled if filled > envs => format!(", {envs} environments each; {filled} take hardly longer (--envs)"),
        _ => String::new(),
    }
}

/// Prints the result of the run and the commands to use next; `resumed_by` resumes the run, whose state is in the store
/// `store`, or else in its folder.
pub fn print_end(folder: &RunFolder, store: Option<&str>, summary: &TrainingSummary, resumed_by: &str) {
    let root = quoted(&folder.root().display().to_string());
    let steps = summary.state.counters.env_steps;
    let what = if summary.stopped { "stopped" } else { "done" };
    let run = store.map_or(root, quoted);
    let place = store.map_or_else(|| format!("{run}/checkpoints"), str::to_string);
    say(&format!("{what} after {} env steps; saved in {place}", thousands(steps)));
    if let Some(means) = summary.state.episodes.means() {
        let (end, best_m) = (means.length_mean, summary.history.best_m());
        let best = best_m.map(|m| format!("; best {m:.1} m")).unwrap_or_default();
        let (moved, best) = match summary.history.tracking_errors {
            Some([velocity, yaw]) => (format!("errors of {velocity:.2} m/s and {yaw:.2} rad/s"), String::new()),
            None => match (summary.history.figures, summary.history.imitated) {
                (RunFigures::Imitation, Some([done, error_m])) => (
                    format!("{:.0} % of the motion, links off by {:.1} cm", 100.0 * done, 100.0 * error_m),
                    String::new(),
                ),
                (RunFigures::Tracking | RunFigures::Imitation, _) => ("no evaluation yet".to_string(), String::new()),
                (RunFigures::Distance, _) => {
                    (format!("{:.1} m at {:.2} m/s", means.distance_mean_m, means.velocity_mean_mps), best)
                }
            },
        };
        say(&format!(
            "reached: return {:.0}, {moved}, {end:.0} steps until the end of an episode{best}",
            means.return_mean
        ));
    }
    if let Some(limit) = summary.parts.limit() {
        say(&format!("{} took most of the time; to train faster, {}", limit.name, limit.help));
    }
    if summary.stopped {
        say_error(&format!("resume with: {resumed_by}"));
    } else {
        say(&format!("train it further: {resumed_by} --steps {}", steps.saturating_mul(2)));
    }
    if summary.state.model_xml.is_empty() {
        say(&format!("take the policy elsewhere: treadmill export {run} --safetensors FILE"));
    } else {
        say(&format!("see how far it walks: treadmill eval {run} --episodes 1 --film walk.gif"));
    }
    let others = match folder.root().parent() {
        Some(parent) if parent == Path::new("runs") => String::new(),
        Some(parent) if parent != Path::new("") => format!(" {}", quoted(&parent.display().to_string())),
        _ => " .".to_string(),
    };
    say(&format!("compare it with other runs: treadmill runs{others}"));
}
