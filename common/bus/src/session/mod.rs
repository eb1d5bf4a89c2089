//! Opening and closing a session: the one place that builds the bus's configuration.

pub mod access_rules;
mod discovery;
pub mod endpoint;
pub mod keys;

use std::{path::PathBuf, time::Duration};

use serde_json::json;
use zenoh::{Config, Session, Wait};

use crate::BusError;
use access_rules::Credentials;

/// Largest message that is reassembled: above every limit of our own formats.
const MESSAGE_BYTES_MAX: usize = 32 << 20;
/// Silence after which a peer counts as gone, announced by each side for itself: a client opens its session before it
/// has the run's configuration, so this is no part of it.
const LEASE_MS: u64 = 4000;
/// Smaller messages are not worth the trouble of shared memory.
const SHARED_BYTES_MIN: usize = 64 << 10;
/// Shared memory that a process fills: two fragments of 3 MB. What does not fit travels as ever.
const SHARED_POOL_BYTES: usize = 8 << 20;
/// Closing can hang on a dead link: after this the process goes on without it.
const CLOSE_TIMEOUT: Duration = Duration::from_secs(2);

/// Sessions at most, as far as the system's limit on open files allows.
const SESSIONS_MAX: u64 = 4096;
/// Open files that are kept for everything but the bus: checkpoints and logs must not fail because strangers connect.
const OTHER_FILES: u64 = 256;
/// Below this the bus's own threads find no file to begin with and panic, and whoever waits for them hangs; 48 were enough
/// for a run with two actors.
const OPEN_FILES_MIN: u64 = 64;
/// Connections that may be open and have not said yet who they are.
const ACCEPT_PENDING: u64 = 256;
/// How long one may take to say who it is; as long as the encryption is not agreed upon, a part of it.
const ACCEPT_TIMEOUT_MS: u64 = 5000;
const HANDSHAKE_TIMEOUT_MS: u64 = 3000;

/// How to reach the bus.
#[derive(Clone, Debug, Default)]
pub struct BusOptions {
    /// Endpoints to listen on; the learner's are a router's.
    pub listen: Vec<String>,
    /// Endpoints to dial.
    pub connect: Vec<String>,
    /// Whether those that listen answer who asks by multicast, and those that dial ask.
    pub discover: bool,
    /// Whether plain tcp may leave this machine.
    pub insecure: bool,
    /// Who we are, where links are encrypted.
    pub credentials: Option<Credentials>,
    /// Whether large messages between processes of one machine may pass through shared memory. It needs both ends, and
    /// what does not fit there travels as ever.
    pub shared_memory: bool,
    /// The user's own configuration, under which ours is laid.
    pub zenoh_config: Option<PathBuf>,
}

impl BusOptions {
    /// Refuses endpoints that are not acceptable, and a process that may open too few files for any.
    pub fn check(&self) -> Result<(), BusError> {
        self.listen.iter().chain(&self.connect).try_for_each(|given| endpoint::check(given, self.insecure))?;
        check_open_files()
    }
}

/// Raises the limit on open files to what one session needs, where that is allowed.
fn check_open_files() -> Result<(), BusError> {
    // Where the limit is not told, there is none to be met.
    let Ok((soft, _)) = rlimit::Resource::NOFILE.get() else { return Ok(()) };
    match soft < OPEN_FILES_MIN && rlimit::increase_nofile_limit(OPEN_FILES_MIN).unwrap_or(soft) < OPEN_FILES_MIN {
        true => Err(BusError::OpenFiles { limit: soft, needed: OPEN_FILES_MIN }),
        false => Ok(()),
    }
}

/// A session on the bus.
#[derive(Clone, Debug)]
pub struct Bus {
    pub(crate) session: Session,
}

impl Bus {
    /// Opens the session of the learner or of a router: one that others dial, and that may dial further routers. Port 0 is
    /// replaced by a free one; the endpoints that were really opened are returned.
    pub fn open_router(options: &BusOptions) -> Result<(Self, Vec<String>), BusError> {
        options.check()?;
        let mut listen = Vec::new();
        for given in &options.listen {
            let endpoint = endpoint::with_port(given)?;
            endpoint::check_free(&endpoint)?;
            listen.push(endpoint);
        }
        let mut settings = base(options)?;
        let files = rlimit::increase_nofile_limit(SESSIONS_MAX + ACCEPT_PENDING + OTHER_FILES).unwrap_or(1024);
        let sessions = files.saturating_sub(ACCEPT_PENDING + OTHER_FILES).clamp(16, SESSIONS_MAX);
        insert(&mut settings, "transport/unicast/max_sessions", json!(sessions))?;
        insert(&mut settings, "mode", json!("router"))?;
        if options.credentials.is_some() {
            insert(&mut settings, "access_control", access_rules::access())?;
        }
        insert(&mut settings, "low_pass_filter", access_rules::sizes())?;
        let hasty: Vec<String> = listen.iter().map(|endpoint| impatient(endpoint)).collect();
        insert(&mut settings, "listen/endpoints", json!(hasty))?;
        if options.discover {
            // It answers. That it also dials whom it hears of is not wanted: links between routers are named.
            insert(&mut settings, "scouting/multicast/enabled", json!(true))?;
            insert(&mut settings, "scouting/multicast/listen", json!({"router": true}))?;
            insert(&mut settings, "scouting/multicast/autoconnect", json!({"router": []}))?;
        }
        if !options.connect.is_empty() {
            dial(&mut settings, &options.connect)?;
        }
        Ok((Self::open(settings)?, listen))
    }

    /// Opens an actor's or observer's session: a client that dials, and keeps dialling until it is let in.
    pub fn open_client(options: &BusOptions) -> Result<Self, BusError> {
        options.check()?;
        let mut settings = base(options)?;
        insert(&mut settings, "mode", json!("client"))?;
        let mut endpoints = options.connect.clone();
        if options.discover {
            // The bus itself would not dial again what it found: to us these are endpoints like those that were named.
            endpoints.extend(discovery::find(&settings, options)?);
        }
        dial(&mut settings, &endpoints)?;
        Self::open(settings)
    }

    fn open(settings: Config) -> Result<Self, BusError> {
        let session = zenoh::open(settings).wait().map_err(|why| BusError::Open { why: why.to_string() })?;
        Ok(Self { session })
    }

    /// Closes the session; a close that hangs is left behind.
    pub fn close(&self) {
        let session = self.session.clone();
        let (done, closed) = std::sync::mpsc::channel();
        std::thread::spawn(move || {
            let _ = session.close().wait();
            let _ = done.send(());
        });
        if closed.recv_timeout(CLOSE_TIMEOUT).is_err() {
            tracing::debug!("the bus session did not close within {CLOSE_TIMEOUT:?}");
        }
    }
}

/// An endpoint where encryption is agreed upon soon or not at all.
fn impatient(endpoint: &str) -> String {
    match endpoint.starts_with("tls/") && !endpoint.contains('#') {
        true => format!("{endpoint}#tls_handshake_timeout_ms={HANDSHAKE_TIMEOUT_MS}"),
        false => endpoint.to_string(),
    }
}

/// Dials `endpoints` again and again for as long as nobody answers. A client's session is open once somebody did, a router's
/// at once.
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

fn base(options: &BusOptions) -> Result<Config, BusError> {
    let mut settings = match options.zenoh_config.as_deref() {
        Some(path) => Config::from_file(path).map_err(|why| BusError::Config {
            what: format!("--zenoh-config {}", path.display()),
            why: why.to_string(),
        })?,
        None => Config::default(),
    };
    let ours = [
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
            json!({"control": 2, "real_time": 2, "interactive_high": 4, "interactive_low": 2,
                   "data_high": 4, "data": 16, "data_low": 2, "background": 2}),
        ),
        // A learner that is busy for a moment must not have its links cut.
        ("transport/link/tx/queue/congestion_control/block/wait_before_close", json!(10_000_000)),
        ("transport/link/rx/buffer_size", json!(1_048_576)),
        ("transport/link/rx/max_message_size", json!(MESSAGE_BYTES_MAX)),
        ("transport/shared_memory/enabled", json!(options.shared_memory)),
        ("transport/shared_memory/transport_optimization/message_size_threshold", json!(SHARED_BYTES_MIN)),
        ("transport/shared_memory/transport_optimization/pool_size", json!(SHARED_POOL_BYTES)),
    ];
    for (key, value) in ours {
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
        .map_err(|why| BusError::Config { what: format!("bus setting {key}"), why: why.to_string() })
}
