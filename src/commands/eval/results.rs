//! Results of an evaluation, as text and as JSON.

use serde_json::json;
use treadmill_actor::evaluation::{EpisodeResult, Evaluation, imitation::Imitation, tracking::Tracking};
use treadmill_config::ChosenTask;
use treadmill_humanoid::Environment;
use treadmill_runtime::words::shown;

use super::{AgentKind, EvalArgs};
use crate::{launch::output::say, shared::saved_policy::Origin};

/// Figures of the task beside return and way.
#[derive(Clone, Copy)]
pub(super) enum Columns {
    None,
    Tracking,
    Imitation,
}

impl Columns {
    pub(super) fn of(environment: &Environment) -> Self {
        match environment.config().env.chosen_task() {
            ChosenTask::Motion => Self::Imitation,
            _ if environment.task().command().is_some() => Self::Tracking,
            _ => Self::None,
        }
    }
}

pub(super) fn headings(columns: Columns) -> String {
    let errors = match columns {
        Columns::None => "",
        Columns::Tracking => "  error m/s  error rad/s",
        Columns::Imitation => "  done %  bodies cm  bodies deg  hinges rad",
    };
    format!("episode      return  length  distance m  velocity m/s{errors}  end")
}

pub(super) fn row(episode: u32, played: &EpisodeResult) -> String {
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

pub(super) fn print_summary(args: &EvalArgs, origin: Option<&Origin>, evaluation: &Evaluation, control_step_s: f64) {
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

pub(super) fn as_json(
    agent: AgentKind,
    origin: Option<Origin>,
    evaluation: &Evaluation,
    control_step_s: f64,
) -> String {
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
