//! What is in a folder of certificates: whose, valid from when to when, by which authority, and whether keys are private.

use std::{fs, os::unix::fs::PermissionsExt, path::Path, sync::Arc};

use rustls::{
    CertificateError, RootCertStore,
    pki_types::{CertificateDer, PrivateKeyDer, UnixTime, pem::PemObject},
    server::WebPkiClientVerifier,
    sign::CertifiedKey,
};
use time::OffsetDateTime;
use treadmill_bus::{Credentials, Role};
use x509_parser::prelude::{FromDer, GeneralName, X509Certificate};

use super::{clock::date_text, finding::Finding};

const NAME: &str = "certificates";

/// One that lasts no longer than this is to be renewed.
const SOON_DAYS: i64 = 14;

/// Of every part whose files are in the folder.
pub fn diagnose(folder: &Path) -> Vec<Finding> {
    let roots = match authority(folder) {
        Ok(roots) => roots,
        Err(finding) => return vec![finding],
    };
    let now = OffsetDateTime::now_utc();
    let parts = Role::ALL.into_iter().filter(|role| folder.join(format!("{}.crt", role.name())).exists());
    let findings: Vec<Finding> = parts.map(|role| look_at(folder, role, &roots, now)).collect();
    match findings.is_empty() {
        true => vec![Finding::problem(
            NAME,
            format!("{} has no part's certificate", folder.display()),
            "copy the two files of this machine's part there, as actor.crt and actor.key",
        )],
        false => findings,
    }
}

/// Whom this folder's authority has certified.
pub fn authority(folder: &Path) -> Result<Arc<RootCertStore>, Finding> {
    let file = Credentials::authority(folder);
    let wrong = |why: String| {
        let remedy = "make certificates with `treadmill certs`, or copy ca.crt from where that was done";
        Finding::problem(NAME, format!("{}: {why}", file.display()), remedy)
    };
    let mut roots = RootCertStore::empty();
    let certificate = CertificateDer::from_pem_file(&file).map_err(|why| wrong(why.to_string()))?;
    roots.add(certificate).map_err(|why| wrong(why.to_string()))?;
    Ok(Arc::new(roots))
}

fn look_at(folder: &Path, role: Role, roots: &Arc<RootCertStore>, now: OffsetDateTime) -> Finding {
    let [certificate_file, key_file] = Credentials { folder: folder.to_path_buf(), role }.files();
    let (part, shown) = (role.name(), certificate_file.display());
    let wrong = |seen: String, remedy: &str| Finding::problem(NAME, seen, remedy);
    let again = "copy both files anew from where `treadmill certs` was run";
    let der = match CertificateDer::from_pem_file(&certificate_file) {
        Ok(der) => der,
        Err(why) => return wrong(format!("{shown} is no certificate: {why}"), again),
    };
    let Ok((_, certificate)) = X509Certificate::from_der(&der) else {
        return wrong(format!("{shown} is no certificate"), again);
    };
    let (from, until) =
        (certificate.validity().not_before.to_datetime(), certificate.validity().not_after.to_datetime());
    if now < from {
        return wrong(
            format!(
                "the {part}'s certificate is not valid before {} UTC, and it is {} here",
                date_text(from),
                date_text(now)
            ),
            "set this machine's clock, or wait",
        );
    }
    if now > until {
        return wrong(
            format!("the {part}'s certificate expired at {} UTC", date_text(until)),
            "make new ones with `treadmill certs DIR --renew`, and copy them to each machine; if it should be valid, set the clock",
        );
    }
    if let Some(why) = refused(&der, roots) {
        return wrong(
            format!("the {part}'s certificate is refused: {why}"),
            "all machines need files that one authority made: copy ca.crt and this part's files from the same folder",
        );
    }
    let private = PrivateKeyDer::from_pem_file(&key_file).map_err(|why| why.to_string());
    let fits = private.and_then(|key| {
        CertifiedKey::from_der(vec![der.clone()], key, &rustls::crypto::ring::default_provider())
            .map_err(|why| why.to_string())
    });
    if let Err(why) = fits {
        return wrong(format!("{} does not go with {shown}: {why}", key_file.display()), again);
    }
    let mode = fs::metadata(&key_file).map_or(0, |facts| facts.permissions().mode() & 0o777);
    if mode & 0o077 != 0 {
        return wrong(
            format!("{} can be read by others: its mode is {mode:o}", key_file.display()),
            &format!("keep it private: chmod 600 {}", key_file.display()),
        );
    }
    let common_name = certificate.subject().iter_common_name().next().and_then(|name| name.as_str().ok());
    if common_name != Some(&role.common_name()) {
        return wrong(
            format!(
                "{shown} is of `{}`, and the bus knows the {part} as `{}`",
                common_name.unwrap_or(""),
                role.common_name()
            ),
            "give each file the name of its part, as `treadmill certs` does",
        );
    }
    let days = (until - now).whole_days();
    let hosts = names(&certificate);
    let named = if hosts.is_empty() { String::new() } else { format!(", for {}", hosts.join(" ")) };
    let seen = format!("the {part}'s is valid until {} UTC, {days} days more{named}", date_text(until));
    match days {
        ..SOON_DAYS => Finding::note(NAME, seen, "renew them soon: `treadmill certs DIR --renew`"),
        _ => Finding::ok(NAME, seen),
    }
}

/// Why the authority does not stand by a certificate, in words.
fn refused(der: &CertificateDer, roots: &Arc<RootCertStore>) -> Option<String> {
    let provider = Arc::new(rustls::crypto::ring::default_provider());
    let verifier = match WebPkiClientVerifier::builder_with_provider(roots.clone(), provider).build() {
        Ok(verifier) => verifier,
        Err(why) => return Some(why.to_string()),
    };
    verifier.verify_client_cert(der, &[], UnixTime::now()).err().map(|why| in_words(&why))
}

/// What encryption says against a certificate, as whoever runs a fleet would.
pub fn in_words(why: &rustls::Error) -> String {
    let rustls::Error::InvalidCertificate(reason) = why else { return why.to_string() };
    match reason {
        CertificateError::Expired | CertificateError::ExpiredContext { .. } => "it has expired".to_string(),
        CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => {
            "it is not valid yet".to_string()
        }
        CertificateError::UnknownIssuer | CertificateError::BadSignature => "it is of another authority".to_string(),
        CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. } => {
            format!("it is not for this name: {reason}")
        }
        reason => reason.to_string(),
    }
}

/// Hosts that a certificate is for.
fn names(certificate: &X509Certificate) -> Vec<String> {
    let Ok(Some(names)) = certificate.subject_alternative_name() else { return Vec::new() };
    let name = |name: &GeneralName| match name {
        GeneralName::DNSName(host) => Some((*host).to_string()),
        GeneralName::IPAddress(bytes) => match bytes.len() {
            4 => <[u8; 4]>::try_from(*bytes).ok().map(|four| std::net::Ipv4Addr::from(four).to_string()),
            _ => <[u8; 16]>::try_from(*bytes).ok().map(|sixteen| std::net::Ipv6Addr::from(sixteen).to_string()),
        },
        _ => None,
    };
    names.value.general_names.iter().filter_map(name).collect()
}
