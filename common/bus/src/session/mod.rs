//! Opens and closes sessions; the only place that builds Zenoh's configuration.
//!
//! Learners and routers never wait for a requester that does not read its replies. Zenoh sends a reply with the congestion
//! control of its request, so they replace that on arrival: where a link has no space for a reply, Zenoh drops it, and the
//! requester asks again. A request that a router passes on waits for space again; not one that a learner with one
//! thread for all links passes on, as that thread would wait for itself.

pub(crate) mod access_rules;
pub mod endpoint;
mod links;
mod listening;

use std::path::PathBuf;

use serde_json::json;
use zenoh::{Config, Session, Wait};

use crate::{
    admission::closed_peers,
    error::{BusError, in_words},
    workarounds::{close, discovery, linger, open_files::check_open_files, redial_pause, threads},
};
use access_rules::{AdmittedPool, Credentials};

/// Largest message that is reassembled, in bytes; above every limit of our own formats.
const MESSAGE_BYTES_MAX: usize = 32 << 20;
/// Silence after which a peer counts as gone; each side announces its own. It is not part of the run's configuration,
/// because a client opens its session before it has that.
const LEASE_MS: u64 = 4000;
/// Smallest message that uses shared memory.
pub(crate) const SHARED_BYTES_MIN: usize = 64 << 10;
/// Shared memory of a process: two fragments of 3 MB.
const SHARED_POOL_BYTES: usize = 8 << 20;

/// Most sessions of a router; the system's limit on open files may allow fewer.
const SESSIONS_MAX: u64 = 4096;
/// Open files reserved for checkpoints and logs, which must not fail because many peers connect.
const OTHER_FILES: u64 = 256;
/// Most connections that are open but not yet authenticated.
const ACCEPT_PENDING: u64 = 256;
/// Time to authenticate; the TLS handshake has a shorter one.
const ACCEPT_TIMEOUT_MS: u64 = 5000;
const HANDSHAKE_TIMEOUT_MS: u64 = 3000;

/// Options of a session.
#[derive(Clone, Debug, Default)]
pub struct BusOptions {
    /// Endpoints to listen on, of a learner or router.
    pub listen: Vec<String>,
    /// Endpoints to dial.
    pub connect: Vec<String>,
    /// Whether a listening session answers multicast scouting, and a dialling one scouts.
    pub discover: bool,
    /// Whether plain tcp may leave this machine.
    pub insecure: bool,
    /// Certificates, if links are encrypted.
    pub credentials: Option<Credentials>,
    /// Whether large messages between processes of one machine use shared memory. Both ends must enable it. Messages that do
    /// not fit use the link.
    pub shared_memory: bool,
    /// Pools of actors that a listening session admits to some runs only.
    pub pools: Vec<AdmittedPool>,
    /// The user's Zenoh configuration; our settings override it.
    pub zenoh_config: Option<PathBuf>,
}

impl BusOptions {
    /// Checks the endpoints and the limit on open files.
    pub fn check(&self) -> Result<(), BusError> {
        self.listen.iter().chain(&self.connect).try_for_each(|given| self.check_endpoint(given))?;
        if self.credentials.is_some() {
            self.listen.iter().try_for_each(|given| endpoint::check_encrypted(given))?;
        }
        check_open_files()
    }

    /// Returns whether any link is encrypted. With `discover` no endpoint is given, but there are certificates.
    pub fn is_encrypted(&self) -> bool {
        let mut endpoints = self.listen.iter().chain(&self.connect);
        self.credentials.is_some() || endpoints.any(|endpoint| endpoint.starts_with("tls/"))
    }

    /// Checks an endpoint from a scouting reply, which any host may send. The rules for the user's endpoints apply; with
    /// certificates, plain text is refused, too.
    fn check_discovered(&self, locator: &str) -> Result<(), BusError> {
        if self.credentials.is_some() && !locator.starts_with("tls/") {
            let why = "it is not encrypted, and --tls was given".to_string();
            return Err(BusError::Endpoint { endpoint: locator.to_string(), why });
        }
        self.check_endpoint(locator)
    }

    /// Checks one endpoint.
    fn check_endpoint(&self, given: &str) -> Result<(), BusError> {
        // The user's own Zenoh configuration may bring certificates.
        endpoint::check(given, self.insecure, self.credentials.is_some() || self.zenoh_config.is_some())
    }
}

/// Session on the bus.
#[derive(Clone, Debug)]
pub struct Bus {
    pub(crate) session: Session,
}

impl Bus {
    /// Opens the session of a learner or router, which others dial and which may dial further routers. Returns the endpoints
    /// it listens on, with port 0 replaced by the port that the system chose.
    pub fn open_router(options: &BusOptions) -> Result<(Self, Vec<String>), BusError> {
        options.check()?;
        options.listen.iter().try_for_each(|endpoint| endpoint::check_free(endpoint))?;
        let mut settings = base_settings(options)?;
        let files = rlimit::increase_nofile_limit(SESSIONS_MAX + ACCEPT_PENDING + OTHER_FILES).unwrap_or(1024);
        let sessions = files.saturating_sub(ACCEPT_PENDING + OTHER_FILES).clamp(16, SESSIONS_MAX);
        insert(&mut settings, "transport/unicast/max_sessions", json!(sessions))?;
        insert(&mut settings, "mode", json!("router"))?;
        if options.credentials.is_some() {
            insert(&mut settings, "access_control", access_rules::access(&options.pools))?;
        }
        insert(&mut settings, "low_pass_filter", access_rules::sizes())?;
        let rule = |flow: &str, control: &str| {
            let overwrite = json!({"congestion_control": control});
            json!({"messages": ["query"], "flows": [flow], "overwrite": overwrite})
        };
        let mut rules = vec![rule("ingress", "drop")];
        if !threads::is_one() {
            rules.push(rule("egress", "block"));
        }
        insert(&mut settings, "qos/network", json!(rules))?;
        let endpoints: Vec<String> = options.listen.iter().map(|endpoint| with_handshake_timeout(endpoint)).collect();
        insert(&mut settings, "listen/endpoints", json!(endpoints))?;
        if options.discover {
            // It answers but does not dial the routers it finds: links between routers are configured.
            insert(&mut settings, "scouting/multicast/enabled", json!(true))?;
            insert(&mut settings, "scouting/multicast/listen", json!({"router": true}))?;
            insert(&mut settings, "scouting/multicast/autoconnect", json!({"router": []}))?;
        }
        if !options.connect.is_empty() {
            dial(&mut settings, &options.connect)?;
        }
        let bus = Self::open(settings)?;
        let locators: Vec<String> = bus.session.info().locators().wait().iter().map(ToString::to_string).collect();
        let listen = listening::with_ports(&options.listen, &locators)?;
        closed_peers::listen_on(listening::ports(&listen));
        if !options.connect.is_empty() {
            redial_pause::install(&bus.session, &listen)?;
        }
        Ok((bus, listen))
    }

    /// Opens the session of a client, which dials until it is admitted.
    pub fn open_client(options: &BusOptions) -> Result<Self, BusError> {
        options.check()?;
        let mut settings = base_settings(options)?;
        insert(&mut settings, "mode", json!("client"))?;
        let mut endpoints = options.connect.clone();
        if options.discover {
            endpoints.extend(discovery::find(&settings, |locator| options.check_discovered(locator))?);
        }
        dial(&mut settings, &endpoints)?;
        Self::open(settings)
    }

    fn open(settings: Config) -> Result<Self, BusError> {
        linger::keep_off();
        let session = zenoh::open(settings).wait().map_err(|error| BusError::Open { why: in_words(&error) })?;
        Ok(Self { session })
    }

    /// Closes the session, waiting a limited time.
    pub fn close(&self) {
        close::close(self.session.clone());
    }
}

/// Adds the handshake timeout to a TLS endpoint without options.
fn with_handshake_timeout(endpoint: &str) -> String {
    match endpoint.starts_with("tls/") && !endpoint.contains('#') {
        true => format!("{endpoint}#tls_handshake_timeout_ms={HANDSHAKE_TIMEOUT_MS}"),
        false => endpoint.to_string(),
    }
}

/// Dials `endpoints` until one answers. A client's session opens then, a router's at once.
fn dial(settings: &mut Config, endpoints: &[String]) -> Result<(), BusError> {
    insert(settings, "connect/endpoints", json!(endpoints))?;
    insert(settings, "connect/timeout_ms", json!(-1))?;
    insert(settings, "connect/exit_on_failure", json!(false))?;
    insert(
        settings,
        "connect/retry",
        json!({"period_init_ms": 200, "period_max_ms": 2000, "period_increase_factor": 2}),
    )
}

fn base_settings(options: &BusOptions) -> Result<Config, BusError> {
    let mut settings = match options.zenoh_config.as_deref() {
        Some(path) => Config::from_file(path).map_err(|error| BusError::Config {
            what: format!("--zenoh-config {}", path.display()),
            why: in_words(&error),
        })?,
        None => Config::default(),
    };
    let overrides = [
        ("scouting/multicast/enabled", json!(false)),
        ("scouting/gossip/enabled", json!(false)),
        ("adminspace/enabled", json!(true)),
        ("transport/unicast/accept_pending", json!(ACCEPT_PENDING)),
        ("transport/unicast/accept_timeout", json!(ACCEPT_TIMEOUT_MS)),
        ("transport/unicast/open_timeout", json!(5000)),
        ("transport/link/tx/lease", json!(LEASE_MS)),
        ("transport/link/tx/keep_alive", json!(4)),
        (
            "transport/link/tx/queue/size",
            // The pieces of a policy and an announcement fit into `data_high`, a policy to evaluate into `data_low`.
            json!({"control": 2, "real_time": 2, "interactive_high": 4, "interactive_low": 2,
                   "data_high": 16, "data": 16, "data_low": 16, "background": 2}),
        ),
        // Keeps the links of a learner that is busy for a moment.
        ("transport/link/tx/queue/congestion_control/block/wait_before_close", json!(10_000_000)),
        ("transport/link/rx/buffer_size", json!(1_048_576)),
        ("transport/link/rx/max_message_size", json!(MESSAGE_BYTES_MAX)),
        ("transport/shared_memory/enabled", json!(options.shared_memory)),
        ("transport/shared_memory/transport_optimization/message_size_threshold", json!(SHARED_BYTES_MIN)),
        ("transport/shared_memory/transport_optimization/pool_size", json!(SHARED_POOL_BYTES)),
    ];
    for (key, value) in overrides {
        insert(&mut settings, key, value)?;
    }
    if let Some(credentials) = &options.credentials {
        insert(&mut settings, "transport/link/tls", credentials.transport())?;
    }
    Ok(settings)
}

fn insert(settings: &mut Config, key: &str, value: serde_json::Value) -> Result<(), BusError> {
    settings
        .insert_json5(key, &value.to_string())
        .map_err(|error| BusError::Config { what: format!("bus setting {key}"), why: in_words(&error) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::role::Role;

    #[test]
    fn with_certificates_no_plain_text_endpoint_is_dialled() {
        let insecure = BusOptions { insecure: true, ..BusOptions::default() };
        assert!(insecure.check_discovered("tcp/10.0.0.1:7447").is_ok());
        assert!(BusOptions::default().check_discovered("tcp/10.0.0.1:7447").is_err());
        let credentials = Credentials { folder: "certs".into(), role: Role::Actor };
        let with_tls = BusOptions { insecure: true, credentials: Some(credentials), ..BusOptions::default() };
        let why = with_tls.check_discovered("tcp/10.0.0.1:7447").unwrap_err().to_string();
        assert!(why.contains("tcp/10.0.0.1:7447") && why.contains("--tls"), "{why}");
        assert!(with_tls.check_discovered("tls/10.0.0.1:7447").is_ok());
    }
}
