//! Flags of the network, and the bus options made from them.

use std::path::PathBuf;

use clap::Args;
use treadmill_bus::{AdmittedPool, BusOptions, Credentials, Role, workarounds::threads};
use treadmill_proto::ident::check_ident;

use crate::{launch::exit_code::Usage, shared::existing_file::existing_file};

/// Checks the name of a run, if given.
///
/// # Errors
/// If the name has other characters than a key of the bus allows.
pub fn check_run(run: Option<&str>) -> Result<(), Usage> {
    run.map_or(Ok(()), |run| check_ident("run", run)).map_err(|why| Usage(why.to_string()))
}

/// Flags of the network.
#[derive(Args, Clone, Debug, Default)]
pub struct NetworkArgs {
    /// Allow plain tcp beyond loopback, where anyone on the network can read and forge it.
    #[arg(long)]
    pub insecure: bool,
    /// Discover learners and routers by multicast: actors and evaluators ask, learners and routers answer. Needs --tls or
    /// --insecure.
    #[arg(long)]
    pub discover: bool,
    /// Folder of certificates made by `treadmill certs`: encrypts links and admits only certificates of the same authority.
    #[arg(long, value_name = "DIR")]
    pub tls: Option<PathBuf>,
    /// Send large messages between processes of this machine through shared memory, if both ends allow it.
    #[arg(long)]
    pub shared_memory: bool,
    /// Zenoh configuration file (JSON5); Treadmill's own settings take precedence.
    #[arg(long, value_name = "FILE", value_parser = existing_file)]
    pub zenoh_config: Option<PathBuf>,
}

/// Pools of actors that a learner or router admits.
#[derive(Args, Clone, Debug, Default)]
pub struct PoolAccessArgs {
    /// Admit a pool of actors, with a certificate of its own from `treadmill certs`, to these runs only, as in
    /// lab=walk,seeds-*; may be repeated.
    #[arg(long, value_name = "POOL=RUNS", value_parser = admitted_pool)]
    admit: Vec<AdmittedPool>,
}

impl PoolAccessArgs {
    /// Adds the pools to the options of a session that listens.
    ///
    /// # Errors
    /// If links are not encrypted, and so have no certificates.
    pub fn add_to(&self, options: &mut BusOptions) -> Result<(), Usage> {
        if !self.admit.is_empty() && options.credentials.is_none() {
            return Err(Usage("--admit: only certificates say which pool an actor is of; pass --tls DIR".to_string()));
        }
        options.pools.clone_from(&self.admit);
        Ok(())
    }
}

fn admitted_pool(given: &str) -> Result<AdmittedPool, String> {
    let (pool, runs) = given.split_once('=').ok_or("expected POOL=RUN, or POOL=RUN,RUN")?;
    check_ident("pool", pool).map_err(|why| why.to_string())?;
    let runs: Vec<String> = runs.split(',').map(str::to_string).collect();
    for run in &runs {
        if run != "*" {
            check_ident("run", run.strip_suffix('*').unwrap_or(run)).map_err(|why| why.to_string())?;
        }
    }
    Ok(AdmittedPool { pool: pool.to_string(), runs })
}

/// Port of a learner or router by default.
pub const DEFAULT_PORT: u16 = 7447;

impl NetworkArgs {
    /// Returns the endpoint on loopback with this port, encrypted if there are certificates.
    #[must_use]
    pub fn loopback(&self, port: u16) -> String {
        format!("{}/127.0.0.1:{port}", if self.tls.is_some() { "tls" } else { "tcp" })
    }

    /// Returns the options of the bus. Called before anything is written, so that a refused endpoint leaves nothing
    /// behind, and before any thread starts, because it may set an environment variable.
    ///
    /// # Errors
    /// If an endpoint is refused or certificates are missing.
    pub fn options(&self, role: Role, listen: Vec<String>, connect: Vec<String>) -> anyhow::Result<BusOptions> {
        if self.discover && self.tls.is_none() && !self.insecure {
            return Err(Usage(
                "--discover: anyone on the network could answer; pass --tls DIR (certificates: `treadmill certs DIR`), or \
                 --insecure if the network is trusted"
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
            pools: Vec::new(),
            zenoh_config: self.zenoh_config.clone(),
        };
        options.check()?;
        // A later call, which makes the same options, must change nothing.
        let wanted = threads::wanted(options.is_encrypted(), role)
            .filter(|(name, value)| std::env::var(name).as_deref() != Ok(*value));
        if let Some((name, value)) = wanted {
            // SAFETY: every command calls this before it starts a thread, so no other thread accesses the environment.
            unsafe { std::env::set_var(name, value) };
        }
        Ok(options)
    }

    /// The same for a learner or router, which listens on loopback by default.
    ///
    /// # Errors
    /// As [`Self::options`].
    pub fn listening_options(
        &self,
        role: Role,
        mut listen: Vec<String>,
        connect: Vec<String>,
    ) -> anyhow::Result<BusOptions> {
        if listen.is_empty() {
            listen.push(self.loopback(DEFAULT_PORT));
        }
        self.options(role, listen, connect)
    }

    /// Returns the endpoints and discovery as text for messages.
    pub fn where_to(&self, connect: &[String]) -> String {
        let found = self.discover.then(|| "multicast discovery".to_string());
        connect.iter().cloned().chain(found).collect::<Vec<_>>().join(", ")
    }

    fn credentials(&self, role: Role) -> Result<Option<Credentials>, Usage> {
        let Some(folder) = &self.tls else { return Ok(None) };
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.clone());
        let credentials = Credentials { folder, role };
        match credentials.missing() {
            None => Ok(Some(credentials)),
            Some(file) => Err(Usage(format!(
                "--tls {}: `{}` does not exist; create it with `treadmill certs`, or copy it from the machine where that \
                 was run",
                credentials.folder.display(),
                file.display()
            ))),
        }
    }
}
