//! Results of evaluations.

use prost::Message;

use crate::{
    Malformed, PolicyVersion, check_finite, check_size, ident::check_ident, limits::SMALL_BYTES_MAX, version, wire,
};

/// Results of deterministic episodes of one policy.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluationReport {
    /// Name of the run.
    pub run: String,
    /// Name of the evaluator.
    pub evaluator: String,
    /// Version of the policy.
    pub version: PolicyVersion,
    /// Episodes played, at least 1.
    pub episodes: u32,
    /// Mean return.
    pub return_mean: f64,
    /// Standard deviation of the return.
    pub return_std: f64,
    /// Mean length (control steps).
    pub length_mean: f64,
    /// Mean forward distance (m).
    pub distance_mean_m: f64,
    /// Total distance over total time (m/s).
    pub velocity_mean_mps: f64,
    /// Episodes that ended with a fall.
    pub falls: u32,
    /// Mean error of the base's horizontal velocity (m/s); only for tasks with commands.
    pub velocity_error_mps: Option<f64>,
    /// Mean error of the base's yaw rate (rad/s); only for tasks with commands.
    pub yaw_rate_error_radps: Option<f64>,
    /// Mean distance of the anchor from that of the motion (m); only for tasks with motions, as the rest.
    pub anchor_error_m: Option<f64>,
    /// Mean distance of the compared links from those of the motion (m).
    pub body_error_m: Option<f64>,
    /// Mean angle between them (rad).
    pub body_error_rad: Option<f64>,
    /// Mean of the hinges' root mean square error (rad).
    pub hinge_error_rad: Option<f64>,
    /// Mean share of the motion that was done.
    pub done_share: Option<f64>,
}

impl EvaluationReport {
    /// Encodes as protobuf.
    pub fn encode(&self) -> Vec<u8> {
        message!(
            wire::EvaluationReport,
            clone self [run, evaluator, episodes, return_mean, return_std, length_mean, distance_mean_m, velocity_mean_mps,
                falls, velocity_error_mps, yaw_rate_error_radps, anchor_error_m, body_error_m, body_error_rad, hinge_error_rad,
                done_share],
            { version: Some(self.version) }
        )
        .encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, Malformed> {
        const KIND: &str = "evaluation report";
        check_size(KIND, bytes.len(), SMALL_BYTES_MAX)?;
        let message = wire::EvaluationReport::decode(bytes).map_err(Malformed::undecodable(KIND))?;
        check_ident("run", &message.run)?;
        check_ident("evaluator", &message.evaluator)?;
        for (field, value) in [
            ("return_mean", message.return_mean),
            ("return_std", message.return_std),
            ("length_mean", message.length_mean),
            ("distance_mean_m", message.distance_mean_m),
            ("velocity_mean_mps", message.velocity_mean_mps),
        ] {
            check_finite(field, [value])?;
        }
        for (field, value) in [
            ("velocity_error_mps", message.velocity_error_mps),
            ("yaw_rate_error_radps", message.yaw_rate_error_radps),
            ("anchor_error_m", message.anchor_error_m),
            ("body_error_m", message.body_error_m),
            ("body_error_rad", message.body_error_rad),
            ("hinge_error_rad", message.hinge_error_rad),
            ("done_share", message.done_share),
        ] {
            check_finite(field, value)?;
        }
        if message.episodes == 0 {
            return Err(Malformed::field("episodes", 0, "at least 1"));
        }
        if message.falls > message.episodes {
            return Err(Malformed::field("falls", message.falls, format!("0 to {}, the episodes", message.episodes)));
        }
        Ok(message!(
            Self,
            message [run, evaluator, episodes, return_mean, return_std, length_mean, distance_mean_m, velocity_mean_mps,
                falls, velocity_error_mps, yaw_rate_error_radps, anchor_error_m, body_error_m, body_error_rad, hinge_error_rad,
                done_share],
            { version: version::required(message.version)? }
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_round_trip_and_bad_ones_are_refused() {
        let report = EvaluationReport {
            run: "walk-1".into(),
            evaluator: "evaluator".into(),
            version: PolicyVersion::new(3, 4),
            episodes: 10,
            return_mean: 6000.0,
            return_std: 3.0,
            length_mean: 990.0,
            distance_mean_m: 20.0,
            velocity_mean_mps: 1.3,
            falls: 1,
            velocity_error_mps: Some(0.0),
            yaw_rate_error_radps: Some(0.25),
            anchor_error_m: Some(0.1),
            body_error_m: Some(0.05),
            body_error_rad: Some(0.2),
            hinge_error_rad: Some(0.3),
            done_share: Some(0.95),
        };
        assert_eq!(EvaluationReport::decode(&report.encode()), Ok(report.clone()));
        let without = EvaluationReport { velocity_error_mps: None, yaw_rate_error_radps: None, ..report.clone() };
        assert_eq!(EvaluationReport::decode(&without.encode()), Ok(without));
        let corruptions: [fn(&mut EvaluationReport); 10] = [
            |report| report.run = "a/b".into(),
            |report| report.evaluator = String::new(),
            |report| report.episodes = 0,
            |report| report.falls = 11,
            |report| report.return_mean = f64::NAN,
            |report| report.velocity_mean_mps = f64::INFINITY,
            |report| report.velocity_error_mps = Some(f64::NAN),
            |report| report.yaw_rate_error_radps = Some(f64::INFINITY),
            |report| report.body_error_m = Some(f64::NAN),
            |report| report.done_share = Some(f64::INFINITY),
        ];
        for corrupt in corruptions {
            let mut bad = report.clone();
            corrupt(&mut bad);
            assert!(EvaluationReport::decode(&bad.encode()).is_err(), "{bad:?}");
        }
        assert!(EvaluationReport::decode(b"no protobuf").is_err());
    }
}
