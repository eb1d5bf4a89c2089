//! Statistics that an actor publishes every few seconds.

use prost::Message;

use crate::{
    Malformed, check_finite, check_size,
    ident::check_ident,
    limits::{STATS_BYTES_MAX, STATS_TEXT_BYTES_MAX},
    wire,
};

pub use wire::ActorStats;

impl ActorStats {
    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        check_size("statistics", bytes.len(), STATS_BYTES_MAX)?;
        let stats = Self::decode(bytes).map_err(Malformed::undecodable("statistics"))?;
        check_ident("actor", &stats.actor)?;
        for (field, speed) in [
            ("env_steps_per_s", stats.env_steps_per_s),
            ("simulation_steps_per_s", stats.simulation_steps_per_s),
            ("inference_steps_per_s", stats.inference_steps_per_s),
            ("encoding_steps_per_s", stats.encoding_steps_per_s),
        ] {
            check_finite(field, [speed])?;
        }
        for (field, text) in [("host", &stats.host), ("program_version", &stats.program_version)] {
            if text.len() > STATS_TEXT_BYTES_MAX {
                let expected = format!("at most {STATS_TEXT_BYTES_MAX} bytes");
                return Err(Malformed::field(field, format!("{} bytes long", text.len()), expected));
            }
        }
        Ok(stats)
    }

    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_round_trip_and_bad_ones_are_refused() {
        let stats = ActorStats { actor: "a".into(), env_steps: 7, ..Default::default() };
        assert_eq!(ActorStats::decode_checked(&stats.to_bytes()).unwrap(), stats);
        let bad = ActorStats { actor: "A/B".into(), ..Default::default() };
        assert!(ActorStats::decode_checked(&bad.to_bytes()).is_err());
        let bad = ActorStats { host: "h".repeat(STATS_TEXT_BYTES_MAX + 1), ..stats.clone() };
        assert!(ActorStats::decode_checked(&bad.to_bytes()).unwrap_err().to_string().contains("`host`"));
        let bad = ActorStats { env_steps_per_s: f64::NAN, ..stats };
        assert!(ActorStats::decode_checked(&bad.to_bytes()).is_err());
    }
}
