//! Flags about the network, and the bus options that they mean.

use std::path::PathBuf;

use clap::Args;
use treadmill_bus::{BusOptions, Credentials, Role, workarounds::threads};

use crate::launch::exit_code::Usage;

/// Flags about the network.
#[derive(Args, Clone, Debug, Default)]
pub struct NetworkArgs {
    /// Allow plain tcp beyond loopback, where anybody on the network can read and forge it.
    #[arg(long)]
    pub insecure: bool,
    /// Be found, or find others, by multicast: learners and routers answer, actors and evaluators ask. Needs --tls, or
    /// --insecure.
    #[arg(long)]
    pub discover: bool,
    /// Folder of certificates, as `treadmill certs` makes it: links are encrypted, and only its authority's parts get in.
    #[arg(long, value_name = "DIR")]
    pub tls: Option<PathBuf>,
    /// Let large messages between processes of this machine pass through shared memory, where both ends allow it.
    #[arg(long)]
    pub shared_memory: bool,
    /// The bus's own configuration (JSON5), under which ours is laid.
    #[arg(long, value_name = "FILE")]
    pub zenoh_config: Option<PathBuf>,
}

impl NetworkArgs {
    /// How to reach the bus; called before anything is written, so that an endpoint that is refused leaves nothing behind.
    pub fn options(&self, role: Role, listen: Vec<String>, connect: Vec<String>) -> anyhow::Result<BusOptions> {
        if self.discover && self.tls.is_none() && !self.insecure {
            return Err(Usage(
                "--discover: anybody on the network could answer; give --tls DIR (certificates: `treadmill certs DIR`), or \
                 say --insecure where the network itself is trusted"
                    .to_string(),
            )
            .into());
        }
        let options = BusOptions {
            listen,
            connect,
            discover: self.discover,
            insecure: self.insecure,
            credentials: self.credentials(role)?,
            shared_memory: self.shared_memory,
            zenoh_config: self.zenoh_config.clone(),
        };
        options.check()?;
        if let Some((name, value)) = threads::wanted(&options, role) {
            // SAFETY: every command asks for its options before it starts a thread, so nobody reads the environment now.
            unsafe { std::env::set_var(name, value) };
        }
        Ok(options)
    }

    /// Where somebody is looked for, for messages.
    pub fn where_to(&self, connect: &[String]) -> String {
        let found = self.discover.then(|| "whatever multicast finds".to_string());
        connect.iter().cloned().chain(found).collect::<Vec<_>>().join(", ")
    }

    fn credentials(&self, role: Role) -> Result<Option<Credentials>, Usage> {
        let Some(folder) = &self.tls else { return Ok(None) };
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.clone());
        let credentials = Credentials { folder, role };
        match credentials.missing() {
            None => Ok(Some(credentials)),
            Some(file) => Err(Usage(format!(
                "--tls {}: `{}` is not there; make it with `treadmill certs`, or copy it from where that was done",
                credentials.folder.display(),
                file.display()
            ))),
        }
    }
}
