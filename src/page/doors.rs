//! Who may open the page: this machine's own browsers, or with TLS those that have the link.

use std::{
    fmt::Write,
    io,
    net::{IpAddr, Ipv6Addr, SocketAddr},
    path::Path,
    pin::Pin,
    sync::Arc,
    task::{Context, Poll},
    time::Duration,
};

use anyhow::Context as _;
use axum::http::{
    HeaderMap,
    header::{HOST, ORIGIN},
};
use rand::{TryRng, rngs::SysRng};
use rustls::{
    ServerConfig,
    pki_types::{CertificateDer, PrivateKeyDer, pem::PemObject},
};
use tokio::{
    io::{AsyncRead, AsyncWrite, ReadBuf},
    net::{TcpListener, TcpStream},
    sync::{OwnedSemaphorePermit, Semaphore, mpsc},
};
use tokio_rustls::{TlsAcceptor, server::TlsStream};
use treadmill_bus::{Credentials, Role};
use treadmill_runtime::machine;

use crate::{diagnosis::certificates, launch::exit_code::Usage};

/// Longest handshake, and most at a time.
const HANDSHAKE_TIMEOUT: Duration = Duration::from_secs(5);
const HANDSHAKES_MAX: usize = 32;
/// Most connections at a time: a browser opens several for one page.
const CONNECTIONS_MAX: usize = 64;
/// Pause after a failed accept, for instance with too many open files.
const ACCEPT_PAUSE: Duration = Duration::from_millis(200);

/// Who may open the page.
#[derive(Clone)]
pub enum Door {
    /// Browsers of this machine, or those that a tunnel leads to it.
    Loopback,
    /// Browsers with this token in the address, over TLS. The certificate names these hosts.
    Token(Arc<str>, Arc<ServerConfig>, Arc<[String]>),
}

impl Door {
    /// Reads a certificate of a listening role in `folder`, and draws a token.
    ///
    /// # Errors
    /// If the folder has no such certificate, or it cannot be used.
    pub fn with_tls(folder: &Path) -> anyhow::Result<Self> {
        let of = |role| Credentials { folder: folder.to_path_buf(), role };
        let mut own = [Role::Learner, Role::Router].map(of).into_iter().filter(|own| own.missing().is_none());
        let Some([certificate, key]) = own.next().map(|own| own.files()) else {
            let why =
                "the page needs the certificate of a learner or a router; make it by `treadmill certs DIR --host NAME`";
            return Err(Usage(format!("--tls {}: {why}", folder.display())).into());
        };
        let unusable = || format!("the certificate `{}` cannot be used", certificate.display());
        let chain: Result<Vec<_>, _> = CertificateDer::pem_file_iter(&certificate).with_context(unusable)?.collect();
        let key = PrivateKeyDer::from_pem_file(&key).with_context(unusable)?;
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        let config = ServerConfig::builder_with_provider(provider).with_safe_default_protocol_versions()?;
        let config =
            config.with_no_client_auth().with_single_cert(chain.with_context(unusable)?, key).with_context(unusable)?;
        let mut bytes = [0; 16];
        SysRng.try_fill_bytes(&mut bytes).context("the system gives no random numbers")?;
        let mut token = String::new();
        bytes.iter().for_each(|byte| write!(token, "{byte:02x}").expect("writing to a string does not fail"));
        let hosts = certificates::hosts_in(&certificate).unwrap_or_default();
        Ok(Self::Token(token.into(), Arc::new(config), hosts.into()))
    }

    /// Returns the host by which other machines open the page of one that listens on all addresses: this machine's name if
    /// the certificate has it, else another one that it has. Without any, warns.
    #[must_use]
    pub fn host(&self) -> String {
        let own = machine::host_name();
        let Self::Token(_, _, hosts) = self else { return own };
        let found = hosts
            .iter()
            .find(|host| **host == own)
            .or_else(|| hosts.iter().find(|host| certificates::is_far(host) && !host.contains('*')));
        if found.is_none() {
            tracing::warn!(
                "the certificate names only this machine, so browsers elsewhere refuse the page: `treadmill certs DIR --host {own}`"
            );
        }
        let host = found.unwrap_or(&own);
        if host.parse::<Ipv6Addr>().is_ok() { format!("[{host}]") } else { host.clone() }
    }

    /// Returns the address of the page at a host with a port.
    #[must_use]
    pub fn link(&self, host: &str) -> String {
        match self {
            Self::Loopback => format!("http://{host}/"),
            Self::Token(token, ..) => format!("https://{host}/?token={token}"),
        }
    }

    /// Whether a request for `path` with this query may be answered. The socket wants the origin of this server's own
    /// page: so a page of another site cannot read or steer, even if its name resolves to this machine.
    #[must_use]
    pub fn admits(&self, headers: &HeaderMap, path: &str, query: &str) -> bool {
        let text = |name| headers.get(name).and_then(|value| value.to_str().ok());
        let Some(host) = text(HOST) else { return false };
        let is_socket = path == "/socket";
        let has_origin = |scheme: &str| text(ORIGIN).is_some_and(|origin| origin == format!("{scheme}://{host}"));
        match self {
            Self::Loopback => {
                // A tunnel may end at another port.
                let end = host.rsplit_once(':').filter(|(_, port)| port.parse::<u16>().is_ok());
                let name = end.map_or(host, |(name, _)| name);
                let address = name.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>();
                (name == "localhost" || address.is_ok_and(|address| address.is_loopback()))
                    && (!is_socket || has_origin("http"))
            }
            // The files hold no secrets.
            Self::Token(token, ..) => {
                let has_token =
                    query.split('&').any(|part| part.strip_prefix("token=").is_some_and(|given| is_same(given, token)));
                !is_socket && path != "/" || has_token && (!is_socket || has_origin("https"))
            }
        }
    }
}

/// Compares in a time that does not depend on where the texts differ.
fn is_same(given: &str, wanted: &str) -> bool {
    given.len() == wanted.len() && given.bytes().zip(wanted.bytes()).fold(0, |all, (one, other)| all | one ^ other) == 0
}

/// Connections after their handshakes, which run at the same time: a client that says nothing delays no other.
pub struct TlsListener {
    ready: mpsc::Receiver<(TlsStream<TcpStream>, SocketAddr)>,
    address: SocketAddr,
}

impl TlsListener {
    /// Begins to accept.
    ///
    /// # Errors
    /// If the socket has no address.
    pub fn new(listener: TcpListener, config: Arc<ServerConfig>) -> io::Result<Self> {
        let address = listener.local_addr()?;
        let (sender, ready) = mpsc::channel(HANDSHAKES_MAX);
        let (acceptor, places) = (TlsAcceptor::from(config), Arc::new(Semaphore::new(HANDSHAKES_MAX)));
        tokio::spawn(async move {
            while !sender.is_closed() {
                let Ok((stream, peer)) = listener.accept().await else {
                    tokio::time::sleep(ACCEPT_PAUSE).await;
                    continue;
                };
                let Ok(place) = Arc::clone(&places).try_acquire_owned() else { continue };
                let (sender, handshake) = (sender.clone(), acceptor.accept(stream));
                tokio::spawn(async move {
                    if let Ok(Ok(stream)) = tokio::time::timeout(HANDSHAKE_TIMEOUT, handshake).await {
                        let _ = sender.send((stream, peer)).await;
                    }
                    drop(place);
                });
            }
        });
        Ok(Self { ready, address })
    }
}

impl axum::serve::Listener for TlsListener {
    type Io = TlsStream<TcpStream>;
    type Addr = SocketAddr;

    async fn accept(&mut self) -> (Self::Io, Self::Addr) {
        match self.ready.recv().await {
            Some(connection) => connection,
            // The task that accepts never ends before this listener.
            None => std::future::pending().await,
        }
    }

    fn local_addr(&self) -> io::Result<Self::Addr> {
        Ok(self.address)
    }
}

/// Connections of which at most [`CONNECTIONS_MAX`] are open: a further one waits until another ends. So clients that
/// hold connections open take no files from the rest of the process.
pub struct BoundedListener<L> {
    inner: L,
    places: Arc<Semaphore>,
}

impl<L> BoundedListener<L> {
    /// Bounds a listener.
    pub fn new(inner: L) -> Self {
        Self { inner, places: Arc::new(Semaphore::new(CONNECTIONS_MAX)) }
    }
}

impl<L: axum::serve::Listener> axum::serve::Listener for BoundedListener<L> {
    type Io = Placed<L::Io>;
    type Addr = L::Addr;

    async fn accept(&mut self) -> (Self::Io, Self::Addr) {
        let place = Arc::clone(&self.places).acquire_owned().await.expect("the semaphore is never closed");
        let (io, peer) = self.inner.accept().await;
        (Placed { io, _place: place }, peer)
    }

    fn local_addr(&self) -> io::Result<Self::Addr> {
        self.inner.local_addr()
    }
}

/// Connection with its place.
pub struct Placed<Io> {
    io: Io,
    _place: OwnedSemaphorePermit,
}

impl<Io: AsyncRead + Unpin> AsyncRead for Placed<Io> {
    fn poll_read(mut self: Pin<&mut Self>, cx: &mut Context<'_>, buf: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.io).poll_read(cx, buf)
    }
}

impl<Io: AsyncWrite + Unpin> AsyncWrite for Placed<Io> {
    fn poll_write(mut self: Pin<&mut Self>, cx: &mut Context<'_>, buf: &[u8]) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.io).poll_write(cx, buf)
    }

    fn poll_flush(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.io).poll_flush(cx)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.io).poll_shutdown(cx)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(host: &str, origin: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(HOST, host.parse().unwrap());
        if let Some(origin) = origin {
            headers.insert(ORIGIN, origin.parse().unwrap());
        }
        headers
    }

    #[test]
    fn only_this_machine_and_its_own_page_are_admitted_on_loopback() {
        let is_admitted =
            |host: &str, origin: Option<&str>, path| Door::Loopback.admits(&headers(host, origin), path, "");
        for host in ["127.0.0.1:7448", "localhost:7448", "[::1]:7448", "127.0.0.2:7448", "localhost", "localhost:8000"]
        {
            assert!(is_admitted(host, None, "/page.js"), "{host}");
            assert!(is_admitted(host, Some(&format!("http://{host}")), "/socket"), "{host}");
            assert!(!is_admitted(host, None, "/socket"), "{host} without an origin");
            assert!(!is_admitted(host, Some("http://evil.example"), "/socket"), "{host}");
        }
        for host in ["evil.example:7448", "localhost.evil.example", "127.0.0.1.evil.example:7448", ""] {
            assert!(!is_admitted(host, None, "/"), "{host}");
            assert!(!is_admitted(host, Some(&format!("http://{host}")), "/socket"), "{host}");
        }
        assert!(!Door::Loopback.admits(&HeaderMap::new(), "/", ""));
    }

    #[test]
    fn beyond_loopback_the_token_opens() {
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        let config = ServerConfig::builder_with_provider(provider).with_safe_default_protocol_versions().unwrap();
        let pair = rcgen::generate_simple_self_signed(["box".to_string()]).unwrap();
        let key = PrivateKeyDer::try_from(pair.signing_key.serialize_der()).unwrap();
        let config = config.with_no_client_auth().with_single_cert(vec![pair.cert.der().clone()], key).unwrap();
        let config = Arc::new(config);
        let door = |hosts: &[&str]| {
            let hosts = hosts.iter().map(|host| host.to_string()).collect();
            Door::Token("0123abcd".into(), config.clone(), hosts)
        };
        let own_name = machine::host_name();
        assert_eq!(door(&["localhost", "::1", "box", "other"]).host(), "box");
        assert_eq!(door(&["box", &own_name]).host(), own_name);
        assert_eq!(door(&["localhost"]).host(), own_name);
        assert_eq!(door(&["*.lab", "fd00::1"]).host(), "[fd00::1]");
        let door = door(&["box"]);
        let own = headers("box:7448", Some("https://box:7448"));
        for (path, query, is_admitted) in [
            ("/", "token=0123abcd", true),
            ("/socket", "a=b&token=0123abcd", true),
            ("/page.js", "", true),
            ("/", "", false),
            ("/", "token=0123abce", false),
            ("/socket", "", false),
            ("/socket", "token=0123abc", false),
            ("/socket", "token=", false),
        ] {
            assert_eq!(door.admits(&own, path, query), is_admitted, "{path}?{query}");
        }
        assert!(!door.admits(&headers("box:7448", Some("http://box:7448")), "/socket", "token=0123abcd"));
        assert_eq!(door.link("box:7448"), "https://box:7448/?token=0123abcd");
    }
}
