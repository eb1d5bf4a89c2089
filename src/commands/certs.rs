//! `treadmill certs`: creates an authority and a certificate for each role, without which no machine joins the bus.

use std::{
    collections::BTreeSet,
    fs,
    io::Write,
    net::IpAddr,
    os::unix::fs::OpenOptionsExt,
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::Args;
use rcgen::{
    BasicConstraints, CertificateParams, DnType, ExtendedKeyUsagePurpose, IsCa, Issuer, KeyPair, KeyUsagePurpose,
};
use rustls::pki_types::ServerName;
use time::{Duration, OffsetDateTime};
use treadmill_bus::{Credentials, Role};
use treadmill_proto::ident::check_ident;

use crate::{
    diagnosis::{certificates, finding::Severity},
    launch::{exit_code::Usage, output::say},
};

/// Certificates are valid from this long before they were made, because clocks differ.
const LEEWAY: Duration = Duration::days(1);
/// Folder of the pools' certificates, below that of the roles'.
const POOLS: &str = "pools";
/// Hosts of new certificates by default.
const LOCAL_HOSTS: [&str; 3] = ["localhost", "127.0.0.1", "::1"];

/// Flags of `certs`.
#[derive(Args)]
pub struct CertsArgs {
    /// Folder to write to.
    folder: PathBuf,
    /// Name or address at which the learner or a router is dialled; may be repeated. New certificates also have localhost,
    /// 127.0.0.1 and ::1; existing ones keep their hosts and get the new ones.
    #[arg(long, value_name = "HOST")]
    host: Vec<String>,
    /// Days until the certificates of the roles expire; the authority's own lasts ten times as long.
    #[arg(long, default_value_t = 365, value_parser = clap::value_parser!(u32).range(1..=3650))]
    days: u32,
    /// Replace the roles' certificates, and keep the authority.
    #[arg(long)]
    renew: bool,
    /// Also make a certificate for the actors of this pool, in the folder pools/POOL; may be repeated. Only routers and
    /// learners with `--admit POOL=RUNS` know it.
    #[arg(long, value_name = "POOL", value_parser = pool_name)]
    pool: Vec<String>,
    /// Also write a folder per role and pool below this one, with only the three files that it needs.
    #[arg(long, value_name = "DIR")]
    bundles: Option<PathBuf>,
}

/// Creates the missing files, and prints what the folder contains.
pub fn run(args: &CertsArgs) -> anyhow::Result<()> {
    let folder = &args.folder;
    let made = make(args)?;
    let findings = certificates::diagnose(folder);
    let problems = findings.iter().filter(|finding| finding.severity == Severity::Problem).count();
    match (made.is_empty(), problems) {
        (true, 0) => say("nothing to do: all certificates exist; --host adds a host, --renew replaces them all"),
        (true, _) => say("wrote nothing: all files exist"),
        (false, _) => say(&format!("wrote certificates and keys of {} to {}", made.join(", "), folder.display())),
    }
    findings.iter().for_each(|finding| say(&finding.to_string()));
    if problems > 0 {
        anyhow::bail!(
            "{problems} of the certificates in `{}` cannot be used as they are; see above, or replace them all by --renew",
            folder.display()
        );
    }
    if let Some(bundles) = &args.bundles {
        for role in Role::ALL {
            write_bundle(folder, role, &bundles.join(role.name()))?;
        }
        for pool in pools(folder) {
            let own = folder.join(POOLS).join(&pool);
            if pool_files(&own).iter().all(|file| file.exists()) {
                write_bundle(&own, Role::Actor, &bundles.join(POOLS).join(&pool))?;
            } else {
                say(&format!("the pool {pool} lacks a file, so it gets no folder; --pool {pool} makes new ones"));
            }
        }
        say(&format!("wrote a folder for each role and pool below {}", bundles.display()));
    }
    say("give each machine ca.crt and the two files of its role; keep ca.key where only you can read it");
    Ok(())
}

/// Creates the missing files, and those of listening roles that lack a host; returns the roles whose files were written.
pub fn make(args: &CertsArgs) -> anyhow::Result<Vec<String>> {
    let folder = &args.folder;
    if let Some(host) = args.host.iter().find(|host| ServerName::try_from(host.as_str()).is_err()) {
        return Err(Usage(format!("--host {host}: it is neither a host's name nor an address")).into());
    }
    fs::create_dir_all(folder).with_context(|| format!("cannot create the folder `{}`", folder.display()))?;
    let authority = authority(folder, args.days)?;
    let mut made = Vec::new();
    for role in Role::ALL {
        let [certificate, key] = Credentials { folder: folder.clone(), role }.files();
        let is_there = certificate.exists() && key.exists();
        let old = if certificate.exists() { certificates::hosts_in(&certificate) } else { Some(Vec::new()) };
        let hosts = hosts(old.as_deref().unwrap_or_default(), &args.host);
        // An unreadable certificate is replaced only on request.
        let is_complete = is_there && (!role.listens() || old.is_none_or(|old| old == hosts));
        if is_complete && !args.renew {
            continue;
        }
        let (text, private) = issue(role, role.common_name(), &hosts, args.days, &authority)?;
        write(&key, &private, 0o600)?;
        write(&certificate, &text, 0o644)?;
        made.push(role.name().to_string());
    }
    let old = pools(folder).filter(|_| args.renew);
    for pool in args.pool.iter().cloned().chain(old).collect::<BTreeSet<_>>() {
        let own = folder.join(POOLS).join(&pool);
        let files = pool_files(&own);
        if files.iter().all(|file| file.exists()) && !args.renew {
            continue;
        }
        let [certificate, key, authority_copy] = files;
        fs::create_dir_all(&own).with_context(|| format!("cannot create the folder `{}`", own.display()))?;
        let name = Role::common_name_of_pool(&pool);
        let (text, private) = issue(Role::Actor, name, &[], args.days, &authority)?;
        let root = Credentials::authority(folder);
        let root = fs::read_to_string(&root).with_context(|| format!("cannot read `{}`", root.display()))?;
        write(&authority_copy, &root, 0o644)?;
        write(&key, &private, 0o600)?;
        write(&certificate, &text, 0o644)?;
        made.push(format!("the pool {pool}"));
    }
    Ok(made)
}

/// Returns certificate, key and authority in the folder of a pool.
fn pool_files(own: &Path) -> [PathBuf; 3] {
    let [certificate, key] = Credentials { folder: own.to_path_buf(), role: Role::Actor }.files();
    [certificate, key, Credentials::authority(own)]
}

/// Returns the names of the pools that have a folder.
fn pools(folder: &Path) -> impl Iterator<Item = String> {
    let entries = fs::read_dir(folder.join(POOLS)).into_iter().flatten().flatten();
    let entries = entries.filter(|entry| entry.path().is_dir());
    entries.filter_map(|entry| entry.file_name().into_string().ok()).filter(|name| pool_name(name).is_ok())
}

fn pool_name(given: &str) -> Result<String, String> {
    check_ident("pool", given).map(|()| given.to_string()).map_err(|why| why.to_string())
}

/// Returns the hosts of a new certificate: those of the old one, or this machine's, then the given ones.
fn hosts(old: &[String], given: &[String]) -> Vec<String> {
    // An address has several spellings.
    let spelled = |host: &String| host.parse::<IpAddr>().map_or_else(|_| host.clone(), |address| address.to_string());
    let mut hosts = if old.is_empty() { LOCAL_HOSTS.map(String::from).to_vec() } else { old.to_vec() };
    for host in given.iter().map(spelled) {
        if !hosts.contains(&host) {
            hosts.push(host);
        }
    }
    hosts
}

/// Writes the files that one role needs into `own`; unchanged files are not written.
fn write_bundle(folder: &Path, role: Role, own: &Path) -> anyhow::Result<()> {
    fs::create_dir_all(own).with_context(|| format!("cannot create the folder `{}`", own.display()))?;
    let [certificate, key] = Credentials { folder: folder.to_path_buf(), role }.files();
    for (file, mode) in [(Credentials::authority(folder), 0o644), (key, 0o600), (certificate, 0o644)] {
        let text = fs::read_to_string(&file).with_context(|| format!("cannot read `{}`", file.display()))?;
        let copy = own.join(file.file_name().expect("files of a role have names"));
        if !fs::read_to_string(&copy).is_ok_and(|old| old == text) {
            write(&copy, &text, mode)?;
        }
    }
    Ok(())
}

/// Reads the folder's authority, or creates one.
fn authority(folder: &Path, days: u32) -> anyhow::Result<Issuer<'static, KeyPair>> {
    let (certificate, key) = (Credentials::authority(folder), folder.join("ca.key"));
    match (certificate.exists(), key.exists()) {
        (true, true) => {
            let read =
                |path: &Path| fs::read_to_string(path).with_context(|| format!("cannot read `{}`", path.display()));
            let pair =
                KeyPair::from_pem(&read(&key)?).with_context(|| format!("`{}` is not a private key", key.display()))?;
            Issuer::from_ca_cert_pem(&read(&certificate)?, pair)
                .with_context(|| format!("`{}` is not an authority's certificate", certificate.display()))
        }
        (false, false) => {
            let pair = KeyPair::generate()?;
            let mut params = CertificateParams::default();
            params.distinguished_name.push(DnType::CommonName, "treadmill-ca");
            params.is_ca = IsCa::Ca(BasicConstraints::Constrained(0));
            params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
            set_validity(&mut params, days.saturating_mul(10));
            let text = params.self_signed(&pair)?.pem();
            write(&key, &pair.serialize_pem(), 0o600)?;
            write(&certificate, &text, 0o644)?;
            Ok(Issuer::new(params, pair))
        }
        _ => Err(Usage(format!(
            "folder `{}` has only one of ca.crt and ca.key; restore the other one, or choose an empty folder",
            folder.display()
        ))
        .into()),
    }
}

/// Returns certificate and private key of a role, in the name of `common_name`.
fn issue(
    role: Role,
    common_name: String,
    hosts: &[String],
    days: u32,
    authority: &Issuer<'static, KeyPair>,
) -> anyhow::Result<(String, String)> {
    let names = if role.listens() { hosts.to_vec() } else { Vec::new() };
    let mut params = CertificateParams::new(names).map_err(|why| Usage(format!("--host: {why}")))?;
    params.distinguished_name.push(DnType::CommonName, common_name);
    params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
    if role.listens() {
        params.extended_key_usages.push(ExtendedKeyUsagePurpose::ServerAuth);
    }
    set_validity(&mut params, days);
    let pair = KeyPair::generate()?;
    let text = params.signed_by(&pair, authority)?.pem();
    Ok((text, pair.serialize_pem()))
}

fn set_validity(params: &mut CertificateParams, days: u32) {
    let now = OffsetDateTime::now_utc();
    params.not_before = now - LEEWAY;
    params.not_after = now + Duration::days(days.into());
}

/// Writes a file atomically with `mode` from the start, so that others can never read a private key.
fn write(path: &Path, text: &str, mode: u32) -> anyhow::Result<()> {
    let temporary = path.with_extension("new");
    let _ = fs::remove_file(&temporary);
    let written = fs::OpenOptions::new()
        .write(true)
        .create_new(true)
        .mode(mode)
        .open(&temporary)
        .and_then(|mut file| file.write_all(text.as_bytes()).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&temporary, path));
    written.with_context(|| format!("cannot write `{}`", path.display()))
}
