//! Commands to a learner, and its replies.

use prost::Message;

use crate::{
    Malformed, check_size,
    ident::check_ident,
    limits::{CONTROL_VALUE_CHARS_MAX, SMALL_BYTES_MAX, STATUS_BYTES_MAX},
    pool::PoolDemand,
    wire,
};

pub use wire::{ActorStatus, Command, ControlReply, ControlRequest, PartTime, Phase, RunStatus};

impl ControlRequest {
    /// Returns a request without arguments.
    pub fn plain(command: Command) -> Self {
        Self { command: command.into(), ..Self::default() }
    }

    /// Returns a request to set one configuration key.
    pub fn set(key: &str, value: &str) -> Self {
        Self { command: Command::Set.into(), key: key.to_string(), value: value.to_string() }
    }

    /// Encodes as protobuf.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        const KIND: &str = "control request";
        check_size(KIND, bytes.len(), SMALL_BYTES_MAX)?;
        let request = Self::decode(bytes).map_err(Malformed::undecodable(KIND))?;
        if request.command() == Command::Unspecified {
            return Err(Malformed::field("command", request.command, "1 to 6"));
        }
        for (field, text) in [("key", &request.key), ("value", &request.value)] {
            if text.chars().count() > CONTROL_VALUE_CHARS_MAX {
                let expected = format!("at most {CONTROL_VALUE_CHARS_MAX} characters");
                return Err(Malformed::field(field, format!("{} characters long", text.chars().count()), expected));
            }
        }
        Ok(request)
    }
}

impl ControlReply {
    /// Encodes as protobuf, without the last actors if the status would be too large.
    pub fn to_bytes(&self) -> Vec<u8> {
        let excess = self.encoded_len().saturating_sub(STATUS_BYTES_MAX);
        let Some(status) = self.status.as_ref().filter(|_| excess > 0) else { return self.encode_to_vec() };
        let mut kept = status.actors.clone();
        let mut removed = 0;
        while removed < excess
            && let Some(actor) = kept.pop()
        {
            removed += actor.encoded_len();
        }
        Self { status: Some(RunStatus { actors: kept, ..status.clone() }), ..self.clone() }.encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        const KIND: &str = "control reply";
        check_size(KIND, bytes.len(), STATUS_BYTES_MAX)?;
        let reply = Self::decode(bytes).map_err(Malformed::undecodable(KIND))?;
        let Some(status) = &reply.status else {
            return Err(Malformed::field("status", "absent", "the status of the run"));
        };
        check_ident("run", &status.run)?;
        status.pool.as_ref().map_or(Ok(()), PoolDemand::check)?;
        for actor in &status.actors {
            check_ident("name", &actor.name)?;
        }
        Ok(reply)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_round_trip_and_bad_ones_are_refused() {
        let request = ControlRequest::set("ppo.target_kl", "0.02");
        assert_eq!(ControlRequest::decode_checked(&request.to_bytes()), Ok(request));
        let empty = ControlRequest::default();
        assert!(ControlRequest::decode_checked(&empty.to_bytes()).unwrap_err().to_string().contains("`command`"));
        let unknown = ControlRequest { command: 99, ..ControlRequest::default() };
        assert!(ControlRequest::decode_checked(&unknown.to_bytes()).is_err());
        let long = ControlRequest::set("ppo.target_kl", &"9".repeat(CONTROL_VALUE_CHARS_MAX + 1));
        assert!(ControlRequest::decode_checked(&long.to_bytes()).unwrap_err().to_string().contains("`value`"));
    }

    #[test]
    fn a_status_of_too_many_actors_ends_with_fewer() {
        let actors = (0..100_000).map(|i| ActorStatus { name: format!("{i:060}"), ..ActorStatus::default() }).collect();
        let status = RunStatus { run: "walk-1".into(), actors, ..RunStatus::default() };
        let reply = ControlReply { status: Some(status.clone()), ..ControlReply::default() };
        let kept = ControlReply::decode_checked(&reply.to_bytes()).unwrap().status.unwrap().actors;
        assert!(kept.len() > 60_000, "4 MiB by 64 bytes: {}", kept.len());
        assert_eq!(kept[..], status.actors[..kept.len()]);
    }

    #[test]
    fn replies_round_trip_and_names_are_checked() {
        let actor = ActorStatus { name: "actor-0".into(), alive: true, ..ActorStatus::default() };
        let status = RunStatus { run: "walk-1".into(), actors: vec![actor], ..RunStatus::default() };
        let mut reply = ControlReply { done: true, text: "paused".into(), status: Some(status) };
        assert_eq!(ControlReply::decode_checked(&reply.to_bytes()), Ok(reply.clone()));
        reply.status.as_mut().unwrap().actors[0].name = "\u{1b}[2J".into();
        assert!(ControlReply::decode_checked(&reply.to_bytes()).is_err());
        reply.status = None;
        assert!(ControlReply::decode_checked(&reply.to_bytes()).is_err());
    }
}
