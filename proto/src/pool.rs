//! Messages of the pool: what runs want, and which actors they admit.

use std::time::Duration;

use prost::Message;

use crate::{
    Malformed, check_range, check_size,
    ident::check_ident,
    limits::{ENVS_MAX, SMALL_BYTES_MAX},
    wire,
};

pub use wire::{PoolAnswer, PoolDemand, PoolJoin};

/// Time after which a run whose demand is not heard any more does not count. Learners repeat theirs more often.
pub const DEMAND_LASTS: Duration = Duration::from_secs(20);
/// Smallest weight of a run that takes actors.
pub const SHARE_MIN: f64 = 0.001;
/// Largest weight of a run.
pub const SHARE_MAX: f64 = 1000.0;
/// Most environments that a run may want or have: sums over many runs stay below 2^32.
pub const RUN_ENVS_MAX: u32 = 1_000_000;

/// Returns whether a weight is allowed: 0, or from [`SHARE_MIN`] to [`SHARE_MAX`].
pub fn is_share(share: f64) -> bool {
    share == 0.0 || (SHARE_MIN..=SHARE_MAX).contains(&share)
}

impl PoolDemand {
    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    ///
    /// # Errors
    /// If the message is too large, or a field is out of range.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        const KIND: &str = "demand of a run";
        check_size(KIND, bytes.len(), SMALL_BYTES_MAX)?;
        let demand = Self::decode(bytes).map_err(Malformed::undecodable(KIND))?;
        demand.check().map(|()| demand)
    }

    /// Returns the environments beyond those of its own actors that the run could use.
    pub fn envs_wanted(&self) -> u32 {
        if self.open && self.share > 0.0 { self.envs_max.saturating_sub(self.envs_own) } else { 0 }
    }

    pub(crate) fn check(&self) -> Result<(), Malformed> {
        check_ident("run", &self.run)?;
        if !is_share(self.share) {
            return Err(Malformed::field("share", self.share, format!("0, or {SHARE_MIN} to {SHARE_MAX}")));
        }
        for (field, envs) in [
            ("envs_max", self.envs_max),
            ("envs_own", self.envs_own),
            ("envs", self.envs),
            ("envs_target", self.envs_target),
        ] {
            if envs > RUN_ENVS_MAX {
                return Err(Malformed::field(field, envs, format!("at most {RUN_ENVS_MAX}")));
            }
        }
        if self.envs_min > self.envs_max {
            return Err(Malformed::field("envs_min", self.envs_min, "at most envs_max"));
        }
        Ok(())
    }
}

impl PoolJoin {
    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    ///
    /// # Errors
    /// If the message is too large, or the number of environments is out of range.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        const KIND: &str = "request to join";
        check_size(KIND, bytes.len(), SMALL_BYTES_MAX)?;
        let join = Self::decode(bytes).map_err(Malformed::undecodable(KIND))?;
        check_range("envs", join.envs, ENVS_MAX)?;
        Ok(join)
    }
}

impl PoolAnswer {
    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    ///
    /// # Errors
    /// If the message is too large or no protobuf.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        const KIND: &str = "answer to a request to join";
        check_size(KIND, bytes.len(), SMALL_BYTES_MAX)?;
        Self::decode(bytes).map_err(Malformed::undecodable(KIND))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_round_trip_and_bad_ones_are_refused() {
        let demand =
            PoolDemand { run: "walk-1".into(), share: 2.0, envs_max: 512, open: true, ..PoolDemand::default() };
        assert_eq!(PoolDemand::decode_checked(&demand.to_bytes()), Ok(demand.clone()));
        let refused = |change: fn(&mut PoolDemand)| {
            let mut changed = demand.clone();
            change(&mut changed);
            PoolDemand::decode_checked(&changed.to_bytes()).unwrap_err().to_string()
        };
        assert!(refused(|demand| demand.run = "**".into()).contains("`run`"));
        assert!(refused(|demand| demand.share = f64::NAN).contains("`share`"));
        assert!(refused(|demand| demand.share = -1.0).contains("`share`"));
        assert!(refused(|demand| demand.share = 1e-60).contains("`share`"));
        assert!(refused(|demand| demand.envs = u32::MAX).contains("`envs`"));
        assert!(refused(|demand| demand.envs_min = 513).contains("`envs_min`"));
        let join = PoolJoin { envs: 32, stranded: true };
        assert_eq!(PoolJoin::decode_checked(&join.to_bytes()), Ok(join));
        for envs in [0, ENVS_MAX + 1] {
            let why = PoolJoin::decode_checked(&PoolJoin { envs, stranded: false }.to_bytes()).unwrap_err();
            assert!(why.to_string().contains("`envs`"), "{why}");
        }
        assert_eq!(PoolAnswer::decode_checked(&PoolAnswer { admitted: true }.to_bytes()).map(|a| a.admitted), Ok(true));
        assert!(PoolAnswer::decode_checked(&vec![0; SMALL_BYTES_MAX + 1]).is_err());
    }
}
