//! Table of all metrics. The reference page, the texts of Prometheus and the scalars of each update come from it.

use treadmill_proto::{ActorStats, PolicyVersion};
use treadmill_runtime::machine;

use super::scalars::UpdateRecord;

/// One metric.
pub struct MetricRow {
    /// Tag `group/name`, the unit last. A name in braces stands for any.
    pub tag: &'static str,
    /// Unit, or `–` for a number without one.
    pub unit: &'static str,
    /// Median over the first → the last fiftieth of a default run, or empty.
    pub typical: &'static str,
    /// Meaning in Markdown.
    pub help: &'static str,
    /// Whether the tables on a terminal, which have at most 25 lines, show it.
    pub is_important: bool,
    /// Whether it is a total, which only grows: for Prometheus a counter.
    pub is_total: bool,
    /// Where its value comes from.
    pub source: MetricSource,
}

/// Where the value of a metric comes from.
#[derive(Clone, Copy)]
pub enum MetricSource {
    /// Every update.
    Always(fn(&UpdateRecord<'_>) -> f64),
    /// Updates in which it is known.
    Sometimes(fn(&UpdateRecord<'_>) -> Option<f64>),
    /// Actors, which choose the names of the reward's terms.
    Term,
    /// Batch, whose distribution is only for TensorBoard.
    Histogram,
    /// Statistics of one actor, and the newest version; only for Prometheus.
    Actor(fn(&ActorStats, PolicyVersion) -> Option<f64>),
    /// Process at the time of a request; only for Prometheus.
    Live,
}
use MetricSource::{Actor, Always, Histogram, Live, Sometimes, Term};

impl MetricRow {
    /// Returns the value after an update, if it has one.
    pub fn value(&self, record: &UpdateRecord<'_>) -> Option<f64> {
        match self.source {
            Always(of) => Some(of(record)),
            Sometimes(of) => of(record),
            Term | Histogram | Actor(_) | Live => None,
        }
    }

    /// Returns the part of the tag before the slash.
    pub fn group(&self) -> &'static str {
        self.tag.split_once('/').map_or("", |(group, _)| group)
    }

    /// Returns the row of a tag.
    pub fn of(tag: &str) -> Option<&'static Self> {
        let has_braces = |row: &&Self| row.tag.split_once('{').is_some_and(|(begin, _)| tag.starts_with(begin));
        METRICS.iter().find(|row| row.tag == tag).or_else(|| METRICS.iter().find(has_braces))
    }
}

/// Declares metrics: `/// help` `tag, unit, typical => source;`, with marks before the tag.
macro_rules! metrics {
    ($(
        $(#[doc = $help:literal])+
        $($mark:ident)* $tag:literal, $unit:literal, $typical:literal => $source:expr;
    )*) => {
        &[$( MetricRow {
            tag: $tag,
            unit: $unit,
            typical: $typical,
            help: concat!($($help),+).trim_ascii(),
            is_important: false $(|| matches!(Mark::$mark, Mark::Important))*,
            is_total: false $(|| matches!(Mark::$mark, Mark::Total))*,
            source: $source,
        } ),*]
    };
}

/// Mark of a metric in the table.
enum Mark {
    Important,
    Total,
}

/// All metrics, in the order in which an update logs them.
pub const METRICS: &[MetricRow] = metrics! {
    /// Mean return, the sum of unscaled rewards. Standing still through a default episode earns about 5000.
    Important "rollout/ep_rew_mean", "–", "174→5892" => Sometimes(|r| Some(r.state.episodes.means()?.return_mean));
    /// Mean length.
    Important "rollout/ep_len_mean", "steps", "36→941" => Sometimes(|r| Some(r.state.episodes.means()?.length_mean));
    /// Mean forward distance of the torso.
    Important "rollout/distance_mean_m", "m", "0.04→18" => Sometimes(|r| Some(r.state.episodes.means()?.distance_mean_m));
    /// Mean of distance over duration.
    "rollout/velocity_mean_mps", "m/s", "0.03→1.3" => Sometimes(|r| Some(r.state.episodes.means()?.velocity_mean_mps));
    /// Episodes that ended with a fall; with external tasks, by their rule.
    Important "rollout/fall_fraction", "share", "1→0.15" => Sometimes(|r| Some(r.state.episodes.means()?.fall_fraction));
    /// Mean level of the ground's difficulty, 0 to 9, with `ground.kinds`.
    "rollout/ground_level", "–", "" => Sometimes(|r| r.state.episodes.means()?.ground_level);
    /// Mean factor on the ranges of commands, 0.4 to 1, with `velocity.command_curriculum`.
    "rollout/command_factor", "–", "" => Sometimes(|r| r.state.episodes.means()?.command_factor);
    /// Entropy of the last 128 failures to imitate motions, over their seconds; 0 if in one.
    "rollout/failure_entropy", "nats", "" => Sometimes(|r| r.state.curricula.failure_entropy(r.control_step_s));
    /// Greatest `rollout/distance_mean_m`.
    Important "rollout/distance_best_m", "m", "" => Sometimes(|r| r.history.distance_best_m);
    /// Finished episodes.
    Total "rollout/episodes", "count", "" => Always(|r| r.state.episodes.finished as f64);
    /// Environment steps learnt from, divided by those that actors counted, in the last 10 s or 20 updates. Below 0.9 is an
    /// alarm.
    Important "rollout/used_share", "share", "1" => Sometimes(|r| r.efficiency.used_share);

    /// Environment steps learnt from per second, in the last 10 s, or in 20 updates if those take longer.
    Important "time/fps", "steps/s", "23000" => Always(|r| r.efficiency.env_steps_per_s);
    /// Updates, undone ones included.
    Total "time/iterations", "count", "" => Always(|r| r.state.counters.updates as f64);
    /// Resumes of the run.
    Total "time/resumes", "count", "" => Always(|r| r.state.counters.resumes as f64);
    /// Time that the learner ran.
    Total "time/time_elapsed", "s", "" => Always(|r| r.state.counters.wall_s);
    /// Environment steps learnt from; equals `step`.
    Important Total "time/total_timesteps", "steps", "" => Always(|r| r.state.counters.env_steps as f64);
    /// Time spent waiting for this batch.
    "time/collect_s", "s", "0.24" => Always(|r| r.durations.collect.as_secs_f64());
    /// Time for advantage estimation and gradient steps.
    "time/update_s", "s", "0.098" => Always(|r| r.durations.update.as_secs_f64());
    /// Time to update the state and write the checkpoint.
    "time/checkpoint_s", "s", "0.003" => Always(|r| r.durations.checkpoint.as_secs_f64());
    /// Time to encode and announce the new policy, and to release the receipts.
    "time/publish_s", "s", "0.0006" => Always(|r| r.durations.publish.as_secs_f64());
    /// Work of the training thread besides the update: validating fragments, saving, publishing, logging.
    "time/serial_s", "s", "0.018" => Always(|r| r.durations.serial.as_secs_f64());

    /// Simulation.
    "parts/simulation", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("simulation"));
    /// Networks of the actors.
    "parts/inference", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("inference"));
    /// Encoding of fragments.
    "parts/encoding", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("encoding"));
    /// What remains of a round: transport and waiting.
    "parts/bus", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("bus"));
    /// Normalisation, advantages, values.
    "parts/batch", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("batch"));
    /// Gradient steps.
    "parts/update", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("update"));
    /// Checkpoints.
    "parts/checkpoint", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("checkpoint"));
    /// Publishing.
    "parts/publishing", "steps/s", "" => Sometimes(|r| r.parts.steps_per_s("publishing"));
    /// All parts but the bus in turn.
    "parts/ideal", "steps/s", "" => Sometimes(|r| r.parts.ideal_steps_per_s());
    /// Speed, divided by `parts/ideal`.
    "parts/efficiency", "share", "" => Sometimes(|r| r.parts.efficiency());

    /// KL divergence from the policy before the update to the one after its last epoch, in closed form. Over
    /// twice `ppo.target_kl`, the learning rate is divided by 1.5; under half of it, multiplied.
    Important "train/approx_kl", "nats", "0.03→0.027" => Sometimes(|r| Some(r.update?.approx_kl));
    /// Passes that were undone, because the divergence was above eight times `ppo.target_kl`.
    "train/undone_passes", "count", "0" => Sometimes(|r| Some(r.update?.undone_passes.into()));
    /// Samples whose probability ratio left 1 ± `ppo.clip_range`.
    Important "train/clip_fraction", "share", "0.25→0.28" => Sometimes(|r| Some(r.update?.clip_fraction));
    /// Minus the entropy of the actions' distribution, summed over actions.
    "train/entropy_loss", "nats", "−15.5→−12.1" => Sometimes(|r| Some(-r.update?.entropy));
    /// Share of the returns' variance that the critic predicted.
    Important "train/explained_variance", "up to 1", "0.83→0.89" => Sometimes(|r| Some(r.update?.explained_variance));
    /// Clipped surrogate loss, mean over gradient steps; below 0 if the policy improves.
    "train/policy_gradient_loss", "–", "−0.02→−0.008" => Sometimes(|r| Some(r.update?.policy_loss));
    /// Half the critic's mean squared error, in units of the returns' running variance.
    "train/value_loss", "–", "0.1→0.002" => Sometimes(|r| Some(r.update?.value_loss));
    /// Squared excess of action means over `ppo.bounds_limit`, summed over actions.
    "train/bounds_loss", "–", "0→1.6" => Sometimes(|r| Some(r.update?.bounds_loss));
    /// Euclidean norm of the gradient before clipping to `ppo.max_grad_norm`, mean over gradient steps.
    "train/grad_norm", "–", "1.5→3" => Sometimes(|r| Some(r.update?.grad_norm));
    /// Standard deviation of the exploration noise, mean over actions from −1 to 1. Starts at exp(`policy.init_log_std`).
    Important "train/std", "action range", "0.6→0.5" => Sometimes(|r| Some(r.update?.std));
    /// Samples (batch times epochs) per second of gradient steps alone.
    "train/samples_per_s", "1/s", "275000"
        => Sometimes(|r| Some(r.update?.samples as f64 / r.durations.learn.as_secs_f64().max(1e-9)));
    /// `ppo.clip_range`; constant.
    "train/clip_range", "–", "0.2" => Always(|r| r.clip_range);
    /// Transitions of this update: all that actors delivered, at least `ppo.batch`.
    "train/batch", "transitions", "8192" => Always(|r| r.lag.transitions);
    /// Passes over the batch: `ppo.epochs`; down to `ppo.epochs_min` if experience keeps waiting in mode `async`.
    "train/epochs", "count", "3" => Always(|r| r.epochs.into());
    /// Learning rate after the update.
    Important "train/learning_rate", "–", "0.00045→0.0003" => Always(|r| r.state.ppo.learning_rate());
    /// Gradient steps.
    Total "train/n_updates", "count", "" => Always(|r| r.state.counters.gradient_steps as f64);
    /// Updates undone because a number was not finite. 0 in a healthy run; `learner.undone_max` in a row end it.
    Total "train/undone_updates", "count", "" => Always(|r| r.state.counters.undone_updates as f64);

    /// Versions that the acting policy was behind the newest, mean over the batch. 0 in mode `sync`; about 1 in `async`.
    "bus/policy_lag_mean", "versions", "" => Always(|r| r.lag.mean);
    /// Largest lag in the batch; at most `learner.max_policy_lag`.
    "bus/policy_lag_max", "versions", "" => Always(|r| r.lag.max);
    /// Transitions of the newest policy.
    "bus/policy_lag_0_share", "share", "" => Always(|r| r.lag.shares[0]);
    /// Transitions 1 version behind.
    "bus/policy_lag_1_share", "share", "" => Always(|r| r.lag.shares[1]);
    /// Transitions 2 versions behind.
    "bus/policy_lag_2_share", "share", "" => Always(|r| r.lag.shares[2]);
    /// Transitions 3 versions behind.
    "bus/policy_lag_3_share", "share", "" => Always(|r| r.lag.shares[3]);
    /// Transitions 4 versions behind.
    "bus/policy_lag_4_share", "share", "" => Always(|r| r.lag.shares[4]);
    /// Transitions 5 versions or more behind.
    "bus/policy_lag_5_up_share", "share", "" => Always(|r| r.lag.shares[5]);
    /// Accepted fragments.
    Total "bus/fragments_accepted", "count", "" => Always(|r| r.state.fragment_counts.accepted as f64);
    /// Fragments that arrived again; not learnt from again.
    Total "bus/fragments_duplicate", "count", "" => Always(|r| r.state.fragment_counts.duplicate as f64);
    /// Dropped by rule: lag over `learner.max_policy_lag`, or any lag in mode `sync`.
    Total "bus/fragments_too_old", "count", "" => Always(|r| r.state.fragment_counts.too_old as f64);
    /// Dropped by rule: a resumed learner does not know their policy.
    Total "bus/fragments_vanished", "count", "" => Always(|r| r.state.fragment_counts.vanished as f64);
    /// Refused: invalid, or of another run or configuration; the log names the field. 0 in a healthy fleet.
    Total "bus/fragments_malformed", "count", "" => Always(|r| r.state.fragment_counts.malformed as f64);
    /// Accepted but not learnt from: absurd log-probabilities or rewards. `treadmill status` names the senders.
    Total "bus/fragments_implausible", "count", "" => Always(|r| r.state.fragment_counts.implausible as f64);
    /// Refused unread: their sender is in quarantine.
    Total "bus/fragments_quarantined", "count", "" => Always(|r| r.state.fragment_counts.quarantined as f64);
    /// Refused unread for lack of space; actors send them again. Near 0 in a healthy fleet.
    Total "bus/fragments_turned_away", "count since start", "" => Always(|r| r.turned_away as f64);
    /// Size on the bus of accepted fragments.
    Total "bus/accepted_mb", "MB since start", "" => Always(|r| r.accepted_bytes as f64 / 1e6);
    /// Sequence numbers that senders settled and this learner never handled.
    Total "bus/fragments_unseen", "count", "" => Always(|r| r.state.ledger.total().unseen as f64);
    /// Environment steps in fragments dropped by rule.
    Total "bus/env_steps_dropped", "env steps", "" => Always(|r| r.state.ledger.total().env_steps_dropped as f64);

    /// Connected actors.
    Important "actors/alive", "count", "2" => Always(|r| r.alive.len() as f64);
    /// Environments of all actors.
    "actors/envs", "count", "64" => Always(|r| r.sum(|stats| stats.envs.into()));
    /// Time in which actors did not simulate, in the last 10 s or 20 updates. In mode `sync` they wait during updates.
    Important "actors/idle_share", "share", "0.28" => Sometimes(|r| r.efficiency.idle_share);
    /// Actor processes that `train` restarted. 0 in a healthy run.
    Total "actors/restarts", "count", "" => Always(|r| r.state.counters.restarts as f64);
    /// Senders in quarantine now.
    "actors/quarantined", "count", "" => Always(|r| r.quarantined as f64);
    /// Episodes in which the physics gave a number that is not finite.
    Total "actors/physics_faults", "count", "" => Always(|r| r.state.episodes.faults as f64);
    /// Sum of the actors' speeds.
    "actors/env_steps_per_s", "steps/s", "20500" => Always(|r| r.sum(|stats| stats.env_steps_per_s));
    /// Fragments that live actors sent again: no receipt, or the learner was busy, stopping or restarted.
    "actors/fragments_resent", "count", "" => Always(|r| r.sum(|stats| stats.resent as f64));
    /// Resident memory of the largest actor; 0 without `/proc`.
    "actors/memory_max_mb", "MB", "39"
        => Always(|r| r.stats.values().map(|stats| stats.resident_bytes).max().unwrap_or(0) as f64 / 1e6);
    /// Time in which the learner waited for rollouts, in the last 10 s or 20 updates: the demand for more actors. Never
    /// near 0 in mode `sync`.
    "learner/wait_share", "share", "0.69" => Always(|r| r.efficiency.wait_share);
    /// Resident memory of the learner.
    "learner/memory_mb", "MB", "63" => Always(|_| machine::resident_bytes() as f64 / 1e6);

    /// Mean return of `eval.episodes` deterministic episodes without randomisation. The best policy is kept as `best`.
    Important "eval/mean_reward", "reward", "556→6393" => Sometimes(|r| Some(r.evaluation?.0.return_mean));
    /// Standard deviation of their returns.
    "eval/std_reward", "reward", "50→8" => Sometimes(|r| Some(r.evaluation?.0.return_std));
    /// Mean length.
    "eval/mean_ep_length", "control steps", "107→1000" => Sometimes(|r| Some(r.evaluation?.0.length_mean));
    /// Mean forward distance per episode.
    Important "eval/distance_mean_m", "m", "0.57→20" => Sometimes(|r| Some(r.evaluation?.0.distance_mean_m));
    /// Greatest `eval/distance_mean_m`.
    "eval/distance_best_m", "m", "" => Sometimes(|r| r.evaluation.and(r.history.evaluated_best_m));
    /// Total distance over total time.
    "eval/velocity_mean_mps", "m/s", "0.35→1.4" => Sometimes(|r| Some(r.evaluation?.0.velocity_mean_mps));
    /// Episodes that ended with a fall.
    "eval/fall_fraction", "share", "1→0"
        => Sometimes(|r| r.evaluation.map(|(report, _)| f64::from(report.falls) / f64::from(report.episodes)));
    /// Environment steps that the evaluated policy had learnt from.
    "eval/total_timesteps", "steps", "" => Sometimes(|r| Some(r.evaluation?.1 as f64));
    /// Error of the base's horizontal velocity, for tasks with commands: mean over windows of 1 s without change or push.
    Important "eval/velocity_error", "m/s", "" => Sometimes(|r| r.evaluation?.0.velocity_error_mps);
    /// The same for the yaw rate.
    Important "eval/yaw_rate_error", "rad/s", "" => Sometimes(|r| r.evaluation?.0.yaw_rate_error_radps);
    /// Mean distance of the compared links from those of the motion, for the motion task; the anchors lie above each other.
    Important "eval/body_error", "m", "" => Sometimes(|r| r.evaluation?.0.body_error_m);
    /// Mean angle between them.
    "eval/body_angle_error", "rad", "" => Sometimes(|r| r.evaluation?.0.body_error_rad);
    /// Mean distance between the anchors.
    "eval/anchor_error", "m", "" => Sometimes(|r| r.evaluation?.0.anchor_error_m);
    /// Mean of the hinges' root mean square error.
    "eval/hinge_error", "rad", "" => Sometimes(|r| r.evaluation?.0.hinge_error_rad);
    /// Mean share of a motion that was done.
    Important "eval/done_share", "share", "" => Sometimes(|r| r.evaluation?.0.done_share);

    /// Mean of weight times this term of the reward over the batch.
    "rewards/{term}", "–", "" => Term;

    /// All entries of a batch's actions before clipping.
    "actions/all", "action range", "" => Histogram;
    /// The same for one motor, or one entry of an external task; at most 64.
    "actions/{name}", "action range", "" => Histogram;
    /// Lag of the batch's transitions, one bucket per version.
    "bus/policy_lag", "versions", "" => Histogram;

    /// Always 1, with the program's `version` as a label.
    "build/info", "–", "" => Live;
    /// Time since the training thread last made progress; at most about one update in a healthy run.
    "learner/silence_s", "s", "" => Live;
    /// Environments beyond those of its own actors that the run could use; 0 if it takes none. The demand for a pool.
    "pool/envs_wanted", "count", "" => Live;
    /// Environments of a pool's actors that it has.
    "pool/envs", "count", "" => Live;
    /// Speed of the actor in the label `actor`; one row per live actor, at most 1024.
    "actor/env_steps_per_s", "steps/s", "" => Actor(|stats, _| Some(stats.env_steps_per_s));
    /// Its environments.
    "actor/envs", "count", "" => Actor(|stats, _| Some(stats.envs.into()));
    /// Policy version that it used.
    "actor/policy_version", "version", "" => Actor(|stats, _| Some(stats.version.as_ref()?.number as f64));
    /// How far that is behind the newest; absent for another learner's policy.
    "actor/policy_lag", "versions", "" => Actor(|stats, newest| {
        let version = stats.version.as_ref().filter(|version| version.incarnation == newest.incarnation)?;
        Some(newest.number.saturating_sub(version.number) as f64)
    });
    /// Fragments that it sent again.
    Total "actor/fragments_resent", "count", "" => Actor(|stats, _| Some(stats.resent as f64));
    /// Its resident memory.
    "actor/memory_mb", "MB", "" => Actor(|stats, _| Some(stats.resident_bytes as f64 / 1e6));
};
