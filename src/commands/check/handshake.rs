//! Whether both ends of an encrypted link take each other's certificate, asked of the encryption itself: the bus would only
//! say that nobody answers.

use std::{io::Read, net::TcpStream, sync::Arc, time::Duration};

use rustls::{
    AlertDescription, ClientConfig, ClientConnection, Error, StreamOwned,
    pki_types::{CertificateDer, PrivateKeyDer, ServerName, pem::PemObject},
};
use treadmill_bus::Credentials;

use super::{certificates, finding::Finding};

const NAME: &str = "handshake";

/// How long each step may take.
const PATIENCE: Duration = Duration::from_secs(5);
/// Who does not take our certificate says so this soon; who does waits for us to speak.
const OBJECTION: Duration = Duration::from_millis(700);

/// Agrees on encryption with whoever is at the other end, who is to be `host`.
pub fn diagnose(stream: TcpStream, host: &str, credentials: &Credentials) -> Finding {
    match shake(stream, host, credentials) {
        Ok(()) => Finding::ok(NAME, format!("{host} and this machine's {} trust each other", credentials.role.name())),
        Err(why) => objection(host, &why),
    }
}

/// Why there is no link.
enum Failure {
    /// The files here cannot be used.
    Ours(String),
    /// What the encryption says.
    Tls(Error),
    /// What the system says.
    Io(String),
}

fn shake(stream: TcpStream, host: &str, credentials: &Credentials) -> Result<(), Failure> {
    let roots = certificates::authority(&credentials.folder).map_err(|finding| Failure::Ours(finding.seen))?;
    let [certificate, key] = credentials.files();
    let ours = |why: rustls::pki_types::pem::Error| Failure::Ours(why.to_string());
    let chain = vec![CertificateDer::from_pem_file(&certificate).map_err(ours)?];
    let private = PrivateKeyDer::from_pem_file(&key).map_err(ours)?;
    let config = ClientConfig::builder_with_provider(Arc::new(rustls::crypto::ring::default_provider()))
        .with_safe_default_protocol_versions()
        .and_then(|config| config.with_root_certificates(roots).with_client_auth_cert(chain, private))
        .map_err(|why| Failure::Ours(why.to_string()))?;
    let name = ServerName::try_from(host.to_string()).map_err(|why| Failure::Ours(why.to_string()))?;
    let connection = ClientConnection::new(Arc::new(config), name).map_err(Failure::Tls)?;
    let patient = |patience| {
        stream
            .set_read_timeout(Some(patience))
            .and_then(|()| stream.set_write_timeout(Some(patience)))
            .map_err(|why| Failure::Io(why.to_string()))
    };
    patient(PATIENCE)?;
    let socket = stream.try_clone().map_err(|why| Failure::Io(why.to_string()))?;
    let mut link = StreamOwned::new(connection, socket);
    while link.conn.is_handshaking() {
        link.conn.complete_io(&mut link.sock).map_err(failure)?;
    }
    // Our own certificate is judged after we are done.
    patient(OBJECTION)?;
    match link.read(&mut [0; 1]) {
        Ok(0) => Err(Failure::Io("the other end closed the link at once".to_string())),
        Ok(_) => Ok(()),
        Err(why) if matches!(why.kind(), std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut) => Ok(()),
        Err(why) => Err(failure(why)),
    }
}

fn failure(why: std::io::Error) -> Failure {
    let told = why.to_string();
    match why.into_inner().and_then(|inner| inner.downcast::<Error>().ok()) {
        Some(tls) => Failure::Tls(*tls),
        None => Failure::Io(told),
    }
}

fn objection(host: &str, why: &Failure) -> Finding {
    let same =
        "all machines need files that one authority made: copy ca.crt and each part's files from the same folder";
    let (seen, remedy) = match why {
        Failure::Ours(why) => (format!("this machine's files cannot be used: {why}"), "copy them anew"),
        Failure::Tls(why @ Error::InvalidCertificate(_)) => {
            let words = certificates::in_words(why);
            let remedy = match &words[..] {
                "it has expired" => {
                    "make new ones with `treadmill certs DIR --renew` and restart the learner with them"
                }
                "it is not valid yet" => "compare the clocks of both machines",
                "it is of another authority" => same,
                _ => "name the host in its certificate: `treadmill certs DIR --renew --host NAME`",
            };
            (format!("{host}'s certificate is refused: {words}"), remedy)
        }
        Failure::Tls(Error::AlertReceived(AlertDescription::CertificateExpired)) => (
            format!("{host} says that our certificate has expired"),
            "renew it, or compare the clocks of both machines",
        ),
        Failure::Tls(Error::AlertReceived(alert)) => {
            (format!("{host} does not take our certificate ({alert:?})"), same)
        }
        Failure::Tls(why) => {
            (format!("{host} does not speak TLS as it should: {why}"), "dial tcp/ if it is not encrypted")
        }
        Failure::Io(why) => (
            format!("the link to {host} broke while encryption was agreed upon: {why}"),
            "see whether its endpoint begins with tls/, and whether its clock and certificates are right",
        ),
    };
    Finding::problem(NAME, seen, remedy)
}
