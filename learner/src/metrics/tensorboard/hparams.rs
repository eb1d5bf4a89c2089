//! Hyperparameters for TensorBoard's HPARAMS tab, which has one row for each run.
//!
//! TensorBoard keeps the first summary of each tag, and takes the columns from any run of the folder. So every run has
//! the same columns, and their values must not change during a run: a resume cannot change the keys below. How a run
//! ended is in a separate file, which is removed when the run is resumed.

use treadmill_config::Config;
use treadmill_proto::event_file::{
    Experiment, HparamInfo, HparamValue, HparamsData, MetricInfo, MetricName, SessionEnd, SessionStart,
    hparam_value::Kind, hparams_data::Data,
};

/// Tags that the plugin reads.
pub(super) const EXPERIMENT_TAG: &str = "_hparams_/experiment";
pub(super) const START_TAG: &str = "_hparams_/session_start_info";
pub(super) const END_TAG: &str = "_hparams_/session_end_info";

/// Hyperparameters, by section.
pub const KEYS: &[&str] = &[
    "run.seed",
    "env.task",
    "env.observation",
    "env.forward_reward_weight",
    "env.ctrl_cost_weight",
    "env.healthy_reward",
    "env.max_episode_steps",
    "rollout.envs",
    "rollout.fragment_steps",
    "policy.hidden",
    "policy.init_log_std",
    "ppo.batch",
    "ppo.minibatch",
    "ppo.epochs",
    "ppo.gamma",
    "ppo.gae_lambda",
    "ppo.clip_range",
    "ppo.symmetry",
    "ppo.value_coefficient",
    "ppo.entropy_coefficient",
    "ppo.bounds_coefficient",
    "ppo.max_grad_norm",
    "ppo.learning_rate",
    "ppo.target_kl",
    "ppo.reward_scale",
    "learner.mode",
    "learner.max_policy_lag",
];

/// Metrics of the comparison: tag, title, meaning. TensorBoard shows the last value of each.
pub const METRICS: &[(&str, &str, &str)] = &[
    ("eval/distance_best_m", "best evaluated distance [m]", "The greatest of all evaluations."),
    ("rollout/distance_best_m", "best distance in training [m]", "The greatest mean over the last episodes."),
    ("rollout/ep_rew_mean", "return in training", "Mean over the last episodes."),
    ("eval/mean_reward", "evaluated return", "Of the last evaluation."),
    ("time/total_timesteps", "environment steps", "Learnt from so far."),
    ("time/time_elapsed", "wall time [s]", "Training so far."),
];

/// `DataType` of `api.proto`.
const STRING: i32 = 1;
const BOOL: i32 = 2;
const NUMBER: i32 = 3;

/// `Status` of `api.proto`.
const SUCCESS: i32 = 1;
const FAILURE: i32 = 2;

/// Returns the columns, the same for every run.
pub(super) fn experiment() -> HparamsData {
    let (config, keys) = (Config::default(), Config::keys());
    let hparam_infos = KEYS.iter().map(|key| {
        let kind = match value(&config, key) {
            Kind::Number(_) => NUMBER,
            Kind::Bool(_) => BOOL,
            Kind::String(_) => STRING,
        };
        let doc = keys.iter().find(|known| known.key == *key).map(|known| known.doc.to_string());
        HparamInfo { name: (*key).to_string(), description: doc.unwrap_or_default(), r#type: kind }
    });
    let metric_infos = METRICS.iter().map(|(tag, title, meaning)| MetricInfo {
        name: Some(MetricName { tag: (*tag).to_string() }),
        display_name: (*title).to_string(),
        description: (*meaning).to_string(),
    });
    let experiment = Experiment {
        description: "Runs of Treadmill".to_string(),
        hparam_infos: hparam_infos.collect(),
        metric_infos: metric_infos.collect(),
    };
    HparamsData { version: 0, data: Some(Data::Experiment(experiment)) }
}

/// Returns the values of a run.
pub(super) fn session_start(config: &Config, time_unix_s: f64) -> HparamsData {
    let values = KEYS.iter().map(|key| ((*key).to_string(), HparamValue { kind: Some(value(config, key)) }));
    let start = SessionStart { hparams: values.collect(), start_time_secs: time_unix_s };
    HparamsData { version: 0, data: Some(Data::SessionStart(start)) }
}

/// Returns the status of a run that has ended.
pub(super) fn session_end(is_success: bool, time_unix_s: f64) -> HparamsData {
    let status = if is_success { SUCCESS } else { FAILURE };
    HparamsData { version: 0, data: Some(Data::SessionEnd(SessionEnd { status, end_time_secs: time_unix_s })) }
}

/// Returns a key's value as TensorBoard's type; a list is a string.
fn value(config: &Config, key: &str) -> Kind {
    let text = config.value_of(key);
    match (text.parse::<f64>(), text.parse::<bool>()) {
        (Ok(number), _) => Kind::Number(number),
        (_, Ok(yes)) => Kind::Bool(yes),
        _ => Kind::String(text.trim_matches('"').to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_in_the_configuration() {
        let known: Vec<_> = Config::keys().into_iter().map(|key| key.key.to_string()).collect();
        for key in KEYS {
            assert!(known.iter().any(|known| known == key), "{key}");
        }
    }

    #[test]
    fn values_keep_their_type() {
        let config = Config::default();
        assert_eq!(value(&config, "ppo.gamma"), Kind::Number(0.99));
        assert_eq!(value(&config, "ppo.symmetry"), Kind::String("auto".to_string()));
        assert_eq!(value(&config, "policy.hidden"), Kind::String("[256, 128]".to_string()));
        assert_eq!(value(&config, "env.terminate_when_unhealthy"), Kind::Bool(true));
    }
}
