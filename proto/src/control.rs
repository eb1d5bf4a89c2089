//! What people and scripts ask a learner, and what it answers.

use prost::Message;

use crate::{
    Malformed, bundle,
    ident::check_ident,
    limits::{CONTROL_VALUE_CHARS_MAX, STATUS_BYTES_MAX},
    wire,
};

pub use wire::{ActorStatus, Command, ControlReply, ControlRequest, Phase, RunStatus};

impl ControlRequest {
    /// A command that needs nothing but its name.
    pub fn plain(command: Command) -> Self {
        Self { command: command.into(), ..Self::default() }
    }

    /// Asks for another value of one key of the configuration.
    pub fn set(key: &str, value: &str) -> Self {
        Self { command: Command::Set.into(), key: key.to_string(), value: value.to_string() }
    }

    /// Protobuf bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Reads and checks protobuf bytes from a stranger.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        const WHAT: &str = "control request";
        bundle::check_small(WHAT, bytes.len())?;
        let request = Self::decode(bytes).map_err(|why| Malformed::Undecodable { what: WHAT, why: why.to_string() })?;
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
    /// Protobuf bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.encode_to_vec()
    }

    /// Reads and checks protobuf bytes from a stranger.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        const WHAT: &str = "control reply";
        if bytes.len() > STATUS_BYTES_MAX {
            return Err(Malformed::TooLarge { what: WHAT, bytes: bytes.len(), limit: STATUS_BYTES_MAX });
        }
        let reply = Self::decode(bytes).map_err(|why| Malformed::Undecodable { what: WHAT, why: why.to_string() })?;
        let Some(status) = &reply.status else {
            return Err(Malformed::field("status", "absent", "the status of the run"));
        };
        check_ident("run", &status.run)?;
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
    fn requests_survive_and_nonsense_is_refused() {
        let request = ControlRequest::set("ppo.target_kl", "0.02");
        assert_eq!(ControlRequest::decode_checked(&request.to_bytes()), Ok(request));
        let nothing = ControlRequest::default();
        assert!(ControlRequest::decode_checked(&nothing.to_bytes()).unwrap_err().to_string().contains("`command`"));
        let unknown = ControlRequest { command: 99, ..ControlRequest::default() };
        assert!(ControlRequest::decode_checked(&unknown.to_bytes()).is_err());
        let long = ControlRequest::set("ppo.target_kl", &"9".repeat(CONTROL_VALUE_CHARS_MAX + 1));
        assert!(ControlRequest::decode_checked(&long.to_bytes()).unwrap_err().to_string().contains("`value`"));
    }

    #[test]
    fn replies_survive_and_names_are_checked() {
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
