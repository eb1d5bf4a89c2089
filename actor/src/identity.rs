//! Identity of an actor process.

/// Fields that every message of one actor process repeats.
#[derive(Clone, Debug)]
pub struct ActorIdentity {
    /// Name of the run.
    pub run: String,
    /// Name of the actor.
    pub actor: String,
    /// Random number of this process, which distinguishes it from others of the same name.
    pub incarnation: u64,
    /// Hash over configuration and model.
    pub config_hash: u64,
}
