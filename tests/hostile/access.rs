//! What each certificate entitles to, and that without a good one there is nothing.

use std::{
    fs,
    net::TcpStream,
    path::{Path, PathBuf},
    process::Command,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use crate::attacks::{Attacker, fragment};
use crate::support::*;
use rcgen::{CertificateParams, DnType, ExtendedKeyUsagePurpose, Issuer, KeyPair};
use treadmill_proto::Outcome;
use zenoh::Wait;

/// Longer than anything that is allowed takes.
const SILENCE: Duration = Duration::from_secs(2);

/// A learner over TLS with one actor.
struct Fleet {
    learner: Running,
    _actor: Running,
    endpoint: String,
    folder: tempfile::TempDir,
    run: PathBuf,
}

fn actor(folder: &Path, endpoint: &str, certs: &str) -> Command {
    let mut command = treadmill(folder);
    command.args(["actor", "--connect", endpoint, "--envs", "8", "--tls", certs]);
    command
}

fn fleet() -> Fleet {
    bus_on_one_thread();
    let (folder, run) = folders();
    assert!(self::run(folder.path(), &["certs", "certs"]).status.success());
    let mut command = treadmill(folder.path());
    command.args(["learner", "--preset", "smoke", "--steps", "1000000000", "--run-dir", run.to_str().unwrap()]);
    command.args(["--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    let learner = Running::start(command);
    let endpoint = endpoint(&run);
    let actor = Running::start(actor(folder.path(), &endpoint, "certs"));
    await_steps(&run, 1024);
    Fleet { learner, _actor: actor, endpoint, folder, run }
}

impl Fleet {
    fn certs(&self) -> PathBuf {
        self.folder.path().join("certs")
    }

    fn join_as(&self, role: &str) -> Attacker {
        Attacker::join(&self.endpoint, "run", Some((&self.certs(), role)), PATIENCE).expect("it is let in")
    }

    fn goes_on(&self) {
        let steps = metrics(&self.run).last().unwrap().1;
        await_steps(&self.run, steps + 2048);
    }
}

/// Counts what comes to a subscriber.
fn listen(client: &Attacker, key: &'static str) -> Arc<AtomicU64> {
    let count = Arc::new(AtomicU64::new(0));
    let counted = count.clone();
    let count_one = move |_| {
        counted.fetch_add(1, Ordering::Relaxed);
    };
    client.session().declare_subscriber(key).callback(count_one).background().wait().unwrap();
    count
}

/// Answers questions, and counts them.
fn answer(client: &Attacker, key: &'static str) -> Arc<AtomicU64> {
    let count = Arc::new(AtomicU64::new(0));
    let counted = count.clone();
    let reply = move |query: zenoh::query::Query| {
        counted.fetch_add(1, Ordering::Relaxed);
        let _ = query.reply(query.key_expr().clone(), "forged").wait();
    };
    client.session().declare_queryable(key).callback(reply).background().wait().unwrap();
    count
}

#[test]
fn only_an_operator_commands() {
    let fleet = fleet();
    // Something that listens to commands is there in any case: here it is another of the learner's sessions.
    let learner = fleet.join_as("learner");
    let commands = answer(&learner, "treadmill/run/control");
    let operator = fleet.join_as("operator");
    await_that("an operator is heard", || {
        (!operator.ask("treadmill/run/control", vec![1], SILENCE).is_empty()).then_some(())
    });
    let heard = commands.load(Ordering::Relaxed);
    for role in ["actor", "evaluator", "observer"] {
        let other = fleet.join_as(role);
        // It is on the bus: what it may ask is answered.
        other.policy();
        for key in ["treadmill/run/control", "treadmill/*/control", "treadmill/run/*", "treadmill/**"] {
            assert_eq!(other.ask(key, vec![1], SILENCE), Vec::<Vec<u8>>::new(), "{role} on {key}");
        }
    }
    assert_eq!(commands.load(Ordering::Relaxed), heard);
    fleet.goes_on();
}

#[test]
fn an_actor_says_nothing_in_the_learners_name_and_hears_nothing_of_others() {
    let fleet = fleet();
    let observer = fleet.join_as("observer");
    let metrics = listen(&observer, "treadmill/run/metrics/**");
    let versions = listen(&observer, "treadmill/run/policy/version");
    let forged = listen(&observer, "treadmill/run/metrics/forged/*");
    // One that listens and one that speaks: a session hears what it says itself.
    let (spy, actor) = (fleet.join_as("actor"), fleet.join_as("actor"));
    let rollouts = answer(&spy, "treadmill/run/rollouts/*");
    let policies = answer(&spy, "treadmill/run/policy/latest");
    let all = listen(&spy, "treadmill/**");
    let copies = listen(&spy, "treadmill/run/@rollouts/*");
    let told = listen(&spy, "treadmill/run/metrics/**");
    let poses = listen(&spy, "treadmill/run/poses/*");
    let poses_seen = listen(&observer, "treadmill/run/poses/*");
    let statistics = listen(&spy, "treadmill/run/actors/*/stats");
    await_that("an observer reads metrics, announcements and poses", || {
        let all = [&metrics, &versions, &poses_seen];
        all.iter().all(|count| count.load(Ordering::Relaxed) > 0).then_some(())
    });
    for _ in 0..20 {
        actor.put("treadmill/run/metrics/forged/a", "{}");
        actor.put("treadmill/run/policy/version", "forged");
    }
    // Another actor that asks for a policy gets the learner's.
    fleet.join_as("actor").policy();
    fleet.goes_on();
    assert_eq!(forged.load(Ordering::Relaxed), 0);
    // The same from the learner's own certificate arrives, so the observer would have heard it.
    let learner = fleet.join_as("learner");
    await_that("the learner is heard", || {
        learner.put("treadmill/run/metrics/forged/a", "{}");
        (forged.load(Ordering::Relaxed) > 0).then_some(())
    });
    for (what, count) in [
        ("rollouts of others", rollouts),
        ("questions for policies", policies),
        ("everything", all),
        ("copies of rollouts", copies),
        ("metrics", told),
        ("poses of others", poses),
        ("statistics of others", statistics),
    ] {
        assert_eq!(count.load(Ordering::Relaxed), 0, "an actor got {what}");
    }
}

#[test]
fn an_observer_watches_and_hands_nothing_in() {
    let fleet = fleet();
    let observer = fleet.join_as("observer");
    let episodes = listen(&observer, "treadmill/run/episodes/*");
    let statistics = listen(&observer, "treadmill/run/actors/*/stats");
    let bundle = observer.policy();
    await_that("an observer reads episodes and statistics", || {
        (episodes.load(Ordering::Relaxed) > 0 && statistics.load(Ordering::Relaxed) > 0).then_some(())
    });
    let key = "treadmill/run/rollouts/spy";
    let sound = fragment(&bundle, "spy", 1).encode().unwrap();
    assert_eq!(observer.ask(key, sound.clone(), SILENCE), Vec::<Vec<u8>>::new());
    assert_eq!(observer.ask("treadmill/run/evaluations/spy", vec![], SILENCE), Vec::<Vec<u8>>::new());
    fleet.goes_on();
    assert_eq!(last_value(&fleet.run, "bus/fragments_malformed"), Some(0.0));
    // The same from an actor is looked at.
    let receipt = fleet.join_as("actor").send("spy", sound).expect("an actor is answered");
    assert!(matches!(receipt.outcome, Outcome::Accepted | Outcome::TooOld), "{receipt:?}");
}

/// A certificate for an actor by the authority in `certs` that ran out yesterday, in a folder of its own.
fn expired(folder: &Path) {
    let (certs, out) = (folder.join("certs"), folder.join("expired"));
    let read = |name: &str| fs::read_to_string(certs.join(name)).unwrap();
    let authority = Issuer::from_ca_cert_pem(&read("ca.crt"), KeyPair::from_pem(&read("ca.key")).unwrap()).unwrap();
    let mut params = CertificateParams::default();
    params.distinguished_name.push(DnType::CommonName, "treadmill-actor");
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
    params.not_before = time::OffsetDateTime::now_utc() - time::Duration::days(9);
    params.not_after = time::OffsetDateTime::now_utc() - time::Duration::days(1);
    let pair = KeyPair::generate().unwrap();
    fs::create_dir(&out).unwrap();
    fs::copy(certs.join("ca.crt"), out.join("ca.crt")).unwrap();
    fs::write(out.join("actor.crt"), params.signed_by(&pair, &authority).unwrap().pem()).unwrap();
    fs::write(out.join("actor.key"), pair.serialize_pem()).unwrap();
}

#[test]
fn without_a_good_certificate_there_is_nothing_and_the_learner_says_so() {
    let fleet = fleet();
    let folder = fleet.folder.path();
    // A client that does not speak TLS.
    let address = fleet.endpoint.split_once('/').unwrap().1;
    let mut plain = TcpStream::connect(address).unwrap();
    std::io::Write::write_all(&mut plain, &[0; 64]).unwrap();
    fleet.learner.wait_for("a connection was refused, since it did not prove who it is");
    let without_tls = fleet.endpoint.replace("tls/", "tcp/");
    assert!(Attacker::join(&without_tls, "run", None, SILENCE).is_none(), "plain tcp is not let in");

    assert!(run(folder, &["certs", "others"]).status.success());
    // Its certificate is of another authority, but it trusts the learner's.
    fs::copy(folder.join("certs/ca.crt"), folder.join("others/ca.crt")).unwrap();
    expired(folder);
    // It speaks TLS and trusts the learner, but shows nothing itself.
    let nameless = Attacker::join(&fleet.endpoint, "run", Some((&fleet.certs(), "")), SILENCE);
    let answers = nameless.map(|client| client.ask("treadmill/run/policy/latest", vec![], SILENCE));
    assert!(answers.is_none_or(|answers| answers.is_empty()));
    fleet.learner.wait_for("it has no certificate");
    for (certs, why) in [("others", "is of another authority"), ("expired", "has expired")] {
        let stranger = Running::start(actor(folder, &fleet.endpoint, certs));
        stranger.wait_for("nobody answers");
        let line = fleet.learner.wait_for(why);
        assert!(line.contains("a connection was refused"), "{line}");
        let as_actor = Attacker::join(&fleet.endpoint, "run", Some((&folder.join(certs), "actor")), SILENCE);
        let answers = as_actor.map(|client| client.ask("treadmill/run/policy/latest", vec![], SILENCE));
        assert!(answers.is_none_or(|answers| answers.is_empty()), "{certs}");
    }
    fleet.goes_on();
    assert_eq!(last_value(&fleet.run, "actors/alive"), Some(1.0));
}

#[test]
fn a_renewed_certificate_is_let_in_and_a_name_that_is_not_the_learners_is_not_trusted() {
    let fleet = fleet();
    let folder = fleet.folder.path();
    assert!(run(folder, &["certs", "certs", "--renew"]).status.success());
    fleet.join_as("actor").policy();
    // A learner whose certificate names another host is not taken for it.
    assert!(run(folder, &["certs", "elsewhere", "--host", "learner.example"]).status.success());
    let mut command = treadmill(folder);
    let other = folder.join("other");
    command.args(["learner", "--preset", "smoke", "--steps", "4096", "--run-dir", other.to_str().unwrap()]);
    command.args(["--listen", "tls/127.0.0.1:0", "--tls", "elsewhere"]);
    let _elsewhere = Running::start(command);
    let stranger = Running::start(actor(folder, &endpoint(&other), "elsewhere"));
    stranger.wait_for("nobody answers");
}

#[test]
fn certificates_are_refused_where_they_cannot_be() {
    let (folder, _) = folders();
    let path = folder.path();
    fs::write(path.join("file"), "").unwrap();
    assert_refused(&run(path, &["certs", "file"]), 1, &["file"]);
    assert_refused(&run(path, &["certs", "certs", "--days", "0"]), 2, &["--days"]);
    assert_refused(&run(path, &["certs", "certs", "--host", "näme"]), 2, &["--host"]);
    assert!(run(path, &["certs", "certs"]).status.success());
    fs::write(path.join("certs/ca.key"), "no key").unwrap();
    assert_refused(&run(path, &["certs", "certs", "--renew"]), 1, &["ca.key", "not a private key"]);
    let args = ["learner", "--listen", "tls/127.0.0.1:0", "--tls", "nowhere"];
    assert_refused(&run(path, &args), 2, &["nowhere/ca.crt", "treadmill certs"]);
    // Beyond this machine, plain text needs `--insecure`.
    let args = ["learner", "--preset", "smoke", "--listen", "tcp/0.0.0.0:0"];
    assert_refused(&run(path, &args), 2, &["tls/HOST:PORT", "--insecure"]);
}
