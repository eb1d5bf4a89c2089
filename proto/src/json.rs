//! Objects on the JSON topics.

use serde::{Deserialize, Serialize};

use crate::{Episode, Malformed, check_size, limits::SMALL_BYTES_MAX};

/// `treadmill/{run}/metrics/{group}/{name}`, and a line of `metrics.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Metric {
    /// Name of the run.
    pub run: String,
    /// Group and name, such as `rollout/ep_rew_mean`.
    pub tag: String,
    /// Environment steps so far.
    pub step: u64,
    /// Value of the scalar.
    pub value: f64,
    /// Seconds since 1970.
    pub time_unix_s: f64,
}

impl Metric {
    /// Encodes as one JSON object, for the topic and for a line of the file.
    pub fn to_json(&self) -> Vec<u8> {
        to_json(self)
    }

    /// Decodes an untrusted JSON object.
    pub fn from_json(bytes: &[u8]) -> Result<Self, Malformed> {
        from_json("metric", bytes)
    }
}

fn to_json(object: &impl Serialize) -> Vec<u8> {
    serde_json::to_vec(object).expect("strings and numbers have a JSON form")
}

fn from_json<T: for<'a> Deserialize<'a>>(what: &'static str, bytes: &[u8]) -> Result<T, Malformed> {
    check_size(what, bytes.len(), SMALL_BYTES_MAX)?;
    serde_json::from_slice(bytes).map_err(Malformed::undecodable(what))
}

/// `treadmill/{run}/episodes/{actor}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EpisodeReport {
    /// Name of the run.
    pub run: String,
    /// Name of the actor.
    pub actor: String,
    /// Sum of unscaled rewards.
    #[serde(rename = "return")]
    pub return_sum: f64,
    /// Control steps.
    pub length: u32,
    /// Forward distance (m).
    pub distance_m: f64,
    /// Distance over time (m/s).
    pub velocity_mean_mps: f64,
    /// `fell`, `time_limit`, `non_finite` or `terminated`.
    pub cause: String,
    /// Level of the ground's difficulty, from 0; absent where the task has no levels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground_level: Option<f64>,
    /// Factor on the ranges of commands; absent where the task has no such curriculum.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command_factor: Option<f64>,
    /// Control step, counted over all motions, at which it failed to imitate them; absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failed_step: Option<u32>,
}

impl EpisodeReport {
    /// Returns the report of one episode.
    pub fn new(run: &str, actor: &str, episode: &Episode) -> Self {
        Self {
            run: run.to_string(),
            actor: actor.to_string(),
            return_sum: episode.return_sum,
            length: episode.length,
            distance_m: episode.distance_m,
            velocity_mean_mps: episode.velocity_mean_mps,
            cause: episode.cause.name().to_string(),
            ground_level: episode.ground_level,
            command_factor: episode.command_factor,
            failed_step: episode.failed_step,
        }
    }

    /// Encodes as one JSON object.
    pub fn to_json(&self) -> Vec<u8> {
        to_json(self)
    }

    /// Decodes an untrusted JSON object.
    pub fn from_json(bytes: &[u8]) -> Result<Self, Malformed> {
        from_json("episode", bytes)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::EndCause;

    #[test]
    fn an_episode_has_the_documented_form() {
        let episode = Episode {
            return_sum: 1.5,
            length: 2,
            distance_m: 0.25,
            velocity_mean_mps: 0.5,
            cause: EndCause::Fell,
            ground_kind: None,
            ground_level: None,
            command_factor: None,
            failed_step: None,
        };
        assert_eq!(
            serde_json::to_string(&EpisodeReport::new("r", "a", &episode)).unwrap(),
            r#"{"run":"r","actor":"a","return":1.5,"length":2,"distance_m":0.25,"velocity_mean_mps":0.5,"cause":"fell"}"#
        );
        let on_ground = EpisodeReport::new("r", "a", &Episode { ground_level: Some(3.0), ..episode });
        let text = serde_json::to_string(&on_ground).unwrap();
        assert!(text.ends_with(r#""cause":"fell","ground_level":3.0}"#), "{text}");
        assert_eq!(EpisodeReport::from_json(text.as_bytes()).unwrap(), on_ground);
    }

    proptest! {
        #[test]
        fn numbers_are_read_as_they_were_written(bits: u64) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let metric = Metric { run: "r".into(), tag: "a/b".into(), step: bits, value, time_unix_s: -value };
            prop_assert_eq!(Metric::from_json(&metric.to_json()), Ok(metric));
        }
    }

    #[test]
    fn end_causes_have_the_documented_names() {
        let names =
            [EndCause::Fell, EndCause::TimeLimit, EndCause::NonFinite, EndCause::Terminated].map(EndCause::name);
        assert_eq!(names, ["fell", "time_limit", "non_finite", "terminated"]);
    }
}
