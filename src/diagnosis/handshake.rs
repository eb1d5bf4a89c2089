//! Diagnosis of the TLS handshake. The bus would report only that no learner answers.

use std::{io::Read, net::TcpStream, sync::Arc, time::Duration};

use rustls::{
    AlertDescription, ClientConfig, ClientConnection, Error, RootCertStore, StreamOwned,
    pki_types::{CertificateDer, PrivateKeyDer, ServerName, pem::PemObject},
};
use treadmill_bus::Credentials;

use super::{
    certificates::{self, OTHER_AUTHORITY, SAME_AUTHORITY},
    finding::Finding,
};

const NAME: &str = "handshake";

/// Timeout of each step.
const STEP_TIMEOUT: Duration = Duration::from_secs(5);
/// Time within which a peer that rejects our certificate says so; a peer that accepts it waits for us.
const REJECTION_TIMEOUT: Duration = Duration::from_millis(700);

/// Makes a TLS handshake with `host` at the other end of `stream`.
pub fn diagnose(stream: TcpStream, host: &str, credentials: &Credentials) -> Finding {
    let connection = match connection(host, credentials) {
        Ok(connection) => connection,
        Err(why) => {
            return Finding::problem(NAME, format!("this machine's files are unusable: {why}"), "copy them again");
        }
    };
    match shake_hands(stream, connection) {
        Ok(()) => Finding::ok(NAME, format!("{host} and this machine's {} trust each other", credentials.role.name())),
        Err(why) => rejected(host, &why),
    }
}

/// Returns whether the process at the other end of `stream` answers the beginning of a TLS handshake.
pub fn speaks_tls(mut stream: TcpStream) -> bool {
    let mut ask = || -> anyhow::Result<u8> {
        let config = ClientConfig::builder_with_provider(Arc::new(rustls::crypto::ring::default_provider()))
            .with_safe_default_protocol_versions()?
            .with_root_certificates(RootCertStore::empty())
            .with_no_client_auth();
        let mut connection = ClientConnection::new(Arc::new(config), ServerName::try_from("learner")?)?;
        stream.set_read_timeout(Some(REJECTION_TIMEOUT))?;
        connection.write_tls(&mut stream)?;
        let mut kind = [0];
        stream.read_exact(&mut kind)?;
        Ok(kind[0])
    };
    // Alert or handshake, RFC 8446, section 5.1.
    ask().is_ok_and(|kind| matches!(kind, 21 | 22))
}

fn connection(host: &str, credentials: &Credentials) -> anyhow::Result<ClientConnection> {
    let roots = certificates::authority(&credentials.folder).map_err(|finding| anyhow::anyhow!(finding.seen))?;
    let [certificate, key] = credentials.files();
    let chain = vec![CertificateDer::from_pem_file(&certificate)?];
    let config = ClientConfig::builder_with_provider(Arc::new(rustls::crypto::ring::default_provider()))
        .with_safe_default_protocol_versions()?
        .with_root_certificates(roots)
        .with_client_auth_cert(chain, PrivateKeyDer::from_pem_file(&key)?)?;
    Ok(ClientConnection::new(Arc::new(config), ServerName::try_from(host.to_string())?)?)
}

fn shake_hands(stream: TcpStream, connection: ClientConnection) -> anyhow::Result<()> {
    stream.set_read_timeout(Some(STEP_TIMEOUT))?;
    stream.set_write_timeout(Some(STEP_TIMEOUT))?;
    let mut link = StreamOwned::new(connection, stream);
    while link.conn.is_handshaking() {
        link.conn.complete_io(&mut link.sock)?;
    }
    // The peer verifies our certificate after our side of the handshake is complete.
    link.sock.set_read_timeout(Some(REJECTION_TIMEOUT))?;
    match link.read(&mut [0; 1]) {
        Ok(0) => anyhow::bail!("the other end closed the link at once"),
        Ok(_) => Ok(()),
        Err(why) if matches!(why.kind(), std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut) => Ok(()),
        Err(why) => Err(why.into()),
    }
}

fn rejected(host: &str, why: &anyhow::Error) -> Finding {
    // An I/O error wraps what TLS reports.
    let tls = why.chain().find_map(|cause| {
        let wrapped = cause.downcast_ref::<std::io::Error>().and_then(std::io::Error::get_ref);
        cause.downcast_ref::<Error>().or_else(|| wrapped?.downcast_ref::<Error>())
    });
    let (seen, remedy) = match tls {
        Some(why @ Error::InvalidCertificate(_)) => {
            let words = certificates::in_words(why);
            let remedy = match &words[..] {
                "it has expired" => "renew it with `treadmill certs DIR --renew`, and restart the learner",
                "it is not valid yet" => "compare the clocks of both machines",
                OTHER_AUTHORITY => SAME_AUTHORITY,
                _ => "name the host in its certificate: `treadmill certs DIR --host NAME`",
            };
            (format!("{host}'s certificate is refused: {words}"), remedy)
        }
        Some(Error::AlertReceived(AlertDescription::CertificateExpired)) => (
            format!("{host} reports that our certificate has expired"),
            "renew it, or compare the clocks of both machines",
        ),
        Some(Error::AlertReceived(alert)) => (format!("{host} rejects our certificate ({alert:?})"), SAME_AUTHORITY),
        Some(why) => (format!("{host} does not speak TLS: {why}"), "dial tcp/ if it is not encrypted"),
        None => (
            format!("the link to {host} broke during the handshake: {why}"),
            "check that its endpoint begins with tls/, and that its clock and certificates are right",
        ),
    };
    Finding::problem(NAME, seen, remedy)
}
