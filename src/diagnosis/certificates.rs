//! Diagnosis of a folder of certificates: role, validity, authority, hosts, and privacy of keys.

use std::{fs, io, net::IpAddr, os::unix::fs::PermissionsExt, path::Path, sync::Arc};

use rustls::{
    CertificateError, RootCertStore,
    pki_types::{CertificateDer, PrivateKeyDer, UnixTime, pem::PemObject},
    server::WebPkiClientVerifier,
    sign::CertifiedKey,
};
use time::OffsetDateTime;
use treadmill_bus::{Credentials, Role};
use treadmill_runtime::words::quoted;
use x509_parser::prelude::{FromDer, GeneralName, X509Certificate};

use super::finding::{Finding, Severity};
use crate::launch::exit_code::Usage;

const NAME: &str = "certificates";

/// Remaining days below which a certificate should be renewed.
const RENEWAL_DAYS: i64 = 14;
/// Words for a certificate that this folder's authority did not issue.
pub const OTHER_AUTHORITY: &str = "it is of another authority";
/// Remedy for [`OTHER_AUTHORITY`].
pub const SAME_AUTHORITY: &str =
    "all machines need files of one authority: copy ca.crt and each role's files from the same folder";
const COPY_ANEW: &str = "copy both files again from the folder that `treadmill certs` wrote";

/// Makes a finding for each role whose certificate is in the folder.
pub fn diagnose(folder: &Path) -> Vec<Finding> {
    let roots = match authority(folder) {
        Ok(roots) => roots,
        Err(finding) => return vec![finding],
    };
    let roles = Role::ALL.into_iter().filter(|role| folder.join(format!("{}.crt", role.name())).exists());
    let findings: Vec<Finding> =
        roles.map(|role| diagnose_whole(folder, role, &roots).unwrap_or_else(|finding| finding)).collect();
    if findings.is_empty() {
        let seen = format!("{} has no role's certificate", folder.display());
        return vec![Finding::problem(
            NAME,
            seen,
            "copy the two files of this machine's role, as actor.crt and actor.key",
        )];
    }
    findings
}

/// Makes the finding for one role's certificate, as far as links depend on it.
pub fn diagnose_role_in(folder: &Path, role: Role) -> Finding {
    authority(folder).and_then(|roots| diagnose_role(folder, role, &roots)).unwrap_or_else(|finding| finding)
}

/// Refuses a certificate of this process that no other side would accept. Zenoh would dial on in silence
/// (eclipse-zenoh/zenoh#2720).
///
/// # Errors
/// If a file is damaged, the certificate is expired or of another role or authority, or the key is another one's.
pub fn check_own(credentials: Option<&Credentials>) -> Result<(), Usage> {
    let finding = credentials.map(|own| diagnose_role_in(&own.folder, own.role));
    match finding.filter(|finding| finding.severity == Severity::Problem) {
        Some(Finding { seen, remedy, .. }) => Err(Usage(format!("--tls: {seen}; {}", remedy.unwrap_or_default()))),
        None => Ok(()),
    }
}

/// Reads the folder's authority; the error is the finding about it.
pub fn authority(folder: &Path) -> Result<Arc<RootCertStore>, Finding> {
    let file = Credentials::authority(folder);
    let mut roots = RootCertStore::empty();
    let added = CertificateDer::from_pem_file(&file)
        .map_err(|why| why.to_string())
        .and_then(|certificate| roots.add(certificate).map_err(|why| why.to_string()));
    match added {
        Ok(()) => Ok(Arc::new(roots)),
        Err(why) => Err(Finding::problem(
            NAME,
            format!("{}: {why}", file.display()),
            "make certificates with `treadmill certs`, or copy ca.crt from where they were made",
        )),
    }
}

fn diagnose_whole(folder: &Path, role: Role, roots: &Arc<RootCertStore>) -> Result<Finding, Finding> {
    let finding = diagnose_role(folder, role, roots)?;
    let [_, key] = Credentials { folder: folder.to_path_buf(), role }.files();
    check_privacy(&key).map(|()| finding)
}

fn diagnose_role(folder: &Path, role: Role, roots: &Arc<RootCertStore>) -> Result<Finding, Finding> {
    let [certificate_file, key_file] = Credentials { folder: folder.to_path_buf(), role }.files();
    let shown = certificate_file.display();
    let unreadable = |why: String| Finding::problem(NAME, format!("{shown} is not a certificate: {why}"), COPY_ANEW);
    check_readable(&certificate_file)?;
    let der = CertificateDer::from_pem_file(&certificate_file).map_err(|why| unreadable(why.to_string()))?;
    let (_, certificate) = X509Certificate::from_der(&der).map_err(|why| unreadable(why.to_string()))?;
    let validity = check_validity(folder, role, &certificate)?;
    if let Some(why) = rejection(&der, roots) {
        let seen = format!("the {}'s certificate is refused: {why}", role.name());
        return Err(Finding::problem(NAME, seen, SAME_AUTHORITY));
    }
    check_key(&der, &shown.to_string(), &key_file)?;
    let common_name = certificate.subject().iter_common_name().next().and_then(|name| name.as_str().ok());
    let is_pool =
        role == Role::Actor && common_name.is_some_and(|name| name.starts_with(&Role::common_name_of_pool("")));
    if common_name != Some(&role.common_name()) && !is_pool {
        let (found, expected) = (common_name.unwrap_or(""), role.common_name());
        let seen = format!("{shown} belongs to `{found}`; the bus expects `{expected}`");
        return Err(Finding::problem(NAME, seen, "give each file the name of its role, as `treadmill certs` does"));
    }
    Ok(validity)
}

/// Returns the command that renews certificates: those of `folder` only where their authority can sign.
fn renewal(folder: &Path) -> String {
    let signs = folder.join("ca.key").exists();
    let folder = if signs { quoted(&folder.display().to_string()) } else { "DIR".to_string() };
    format!("treadmill certs {folder} --renew")
}

/// Compares a certificate's validity with the clock; returns the finding for a certificate without other problems.
fn check_validity(folder: &Path, role: Role, certificate: &X509Certificate) -> Result<Finding, Finding> {
    let (now, role, validity) = (OffsetDateTime::now_utc(), role.name(), certificate.validity());
    let (from, until) = (validity.not_before.to_datetime(), validity.not_after.to_datetime());
    if now < from {
        let (from, now) = (date_text(from), date_text(now));
        let seen = format!("the {role}'s certificate is not valid before {from} UTC, and it is {now} here");
        return Err(Finding::problem(NAME, seen, "set this machine's clock, or wait"));
    }
    if now > until {
        let remedy = format!("renew it with `{}`, and copy it to each machine; or set the clock", renewal(folder));
        let seen = format!("the {role}'s certificate expired at {} UTC", date_text(until));
        return Err(Finding::problem(NAME, seen, remedy));
    }
    let days = (until - now).whole_days();
    let hosts = hosts(certificate);
    let named = if hosts.is_empty() { String::new() } else { format!(", for {}", hosts.join(" ")) };
    let seen = format!("the {role}'s is valid until {} UTC, {days} days more{named}", date_text(until));
    Ok(match days {
        ..RENEWAL_DAYS => Finding::note(NAME, seen, format!("renew them soon: `{}`", renewal(folder))),
        _ => Finding::ok(NAME, seen),
    })
}

/// Tests that the private key matches the certificate.
fn check_key(der: &CertificateDer, certificate: &str, file: &Path) -> Result<(), Finding> {
    let shown = file.display();
    let problem = |what: String| Finding::problem(NAME, format!("{shown} {what}"), COPY_ANEW);
    check_readable(file)?;
    let key = PrivateKeyDer::from_pem_file(file).map_err(|why| problem(format!("is not a private key: {why}")))?;
    let provider = rustls::crypto::ring::default_provider();
    CertifiedKey::from_der(vec![der.clone().into_owned()], key, &provider)
        .map_err(|why| problem(format!("does not match {certificate}: {why}")))?;
    Ok(())
}

/// Tests that this user may read a file.
fn check_readable(file: &Path) -> Result<(), Finding> {
    let remedy = match fs::File::open(file).map_err(|why| (why.kind(), why)) {
        Ok(_) => return Ok(()),
        Err((io::ErrorKind::PermissionDenied, why)) => {
            (why, "give this user the right to read it, or run this as its owner")
        }
        Err((_, why)) => (why, COPY_ANEW),
    };
    Err(Finding::problem(NAME, format!("{} cannot be read: {}", file.display(), remedy.0), remedy.1))
}

/// Tests that only its owner can read a private key. No link fails because of that.
fn check_privacy(file: &Path) -> Result<(), Finding> {
    let shown = file.display();
    let mode = file.metadata().map_or(0, |facts| facts.permissions().mode() & 0o777);
    if mode & 0o077 != 0 {
        let seen = format!("{shown} can be read by others: its mode is {mode:o}");
        return Err(Finding::problem(NAME, seen, format!("make it private: chmod 600 {shown}")));
    }
    Ok(())
}

/// Returns why the authority rejects a certificate.
fn rejection(der: &CertificateDer, roots: &Arc<RootCertStore>) -> Option<String> {
    let provider = Arc::new(rustls::crypto::ring::default_provider());
    match WebPkiClientVerifier::builder_with_provider(roots.clone(), provider).build() {
        Ok(verifier) => verifier.verify_client_cert(der, &[], UnixTime::now()).err().map(|why| in_words(&why)),
        Err(why) => Some(why.to_string()),
    }
}

/// Describes a TLS error in an operator's words.
pub fn in_words(why: &rustls::Error) -> String {
    let rustls::Error::InvalidCertificate(reason) = why else { return why.to_string() };
    match reason {
        CertificateError::Expired | CertificateError::ExpiredContext { .. } => "it has expired".to_string(),
        CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => {
            "it is not valid yet".to_string()
        }
        CertificateError::UnknownIssuer | CertificateError::BadSignature => OTHER_AUTHORITY.to_string(),
        CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. } => {
            format!("it is not for this name: {reason}")
        }
        reason => reason.to_string(),
    }
}

/// Returns the hosts that the certificate in a file names; `None` if it cannot be read.
pub fn hosts_in(file: &Path) -> Option<Vec<String>> {
    let der = CertificateDer::from_pem_file(file).ok()?;
    X509Certificate::from_der(&der).ok().map(|(_, certificate)| hosts(&certificate))
}

/// Returns whether a host of a certificate is not just another word for the machine itself.
pub fn is_far(host: &str) -> bool {
    !["localhost", "127.0.0.1", "::1"].contains(&host)
}

/// Returns the hosts that a certificate names.
fn hosts(certificate: &X509Certificate) -> Vec<String> {
    let Ok(Some(names)) = certificate.subject_alternative_name() else { return Vec::new() };
    let host = |name: &GeneralName| match name {
        GeneralName::DNSName(host) => Some((*host).to_string()),
        GeneralName::IPAddress(bytes) => {
            let v4 = <[u8; 4]>::try_from(*bytes).map(|bytes| IpAddr::from(bytes).to_string());
            v4.or_else(|_| <[u8; 16]>::try_from(*bytes).map(|bytes| IpAddr::from(bytes).to_string())).ok()
        }
        _ => None,
    };
    names.value.general_names.iter().filter_map(host).collect()
}

/// Formats a date as `2026-05-01 13:05`.
pub fn date_text(at: OffsetDateTime) -> String {
    let month = u8::from(at.month());
    format!("{:04}-{month:02}-{:02} {:02}:{:02}", at.year(), at.day(), at.hour(), at.minute())
}
