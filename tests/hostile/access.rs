//! Rights of each certificate, and refusal of clients without a valid one.

use std::{
    fs,
    net::TcpStream,
    path::Path,
    process::Command,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use crate::{
    attacks::{Attacker, fragment},
    floods::{self, Fleet},
    support::*,
};
use treadmill_bus::Role;
use treadmill_proto::Outcome;
use zenoh::Wait;

/// Longer than an allowed request takes.
const SILENCE: Duration = Duration::from_secs(2);

/// Learner over TLS with one actor.
fn fleet() -> Fleet {
    floods::fleet(true, &[])
}

fn actor(folder: &Path, endpoint: &str, certs: &str) -> Command {
    let mut command = treadmill(folder);
    command.args(["actor", "--connect", endpoint, "--envs", "8", "--tls", certs]);
    command
}

/// Subscribes and counts messages.
fn listen(client: &Attacker, key: &'static str) -> Arc<AtomicU64> {
    let count = Arc::<AtomicU64>::default();
    let counted = count.clone();
    let count_one = move |_| {
        counted.fetch_add(1, Ordering::Relaxed);
    };
    client.session().declare_subscriber(key).callback(count_one).background().wait().unwrap();
    count
}

/// Answers queries with a forged reply and counts them.
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
fn only_an_operator_can_send_commands() {
    let fleet = fleet();
    // Another session with the learner's certificate, which counts commands.
    let learner = fleet.join_as("learner");
    let commands = answer(&learner, "treadmill/run/control");
    let operator = fleet.join_as("operator");
    await_that("a command of the operator", || {
        (!operator.ask("treadmill/run/control", vec![1], SILENCE).is_empty()).then_some(())
    });
    let heard = commands.load(Ordering::Relaxed);
    for role in ["actor", "evaluator", "observer"] {
        let other = fleet.join_as(role);
        // It is on the bus: allowed queries are answered.
        other.policy();
        for key in ["treadmill/run/control", "treadmill/*/control", "treadmill/run/*", "treadmill/**"] {
            assert_eq!(other.ask(key, vec![1], SILENCE), Vec::<Vec<u8>>::new(), "{role} on {key}");
        }
    }
    assert_eq!(commands.load(Ordering::Relaxed), heard);
    fleet.assert_trains();
}

#[test]
fn an_actor_can_neither_forge_the_learners_messages_nor_read_those_of_other_actors() {
    let fleet = fleet();
    let observer = fleet.join_as("observer");
    let metrics = listen(&observer, "treadmill/run/metrics/**");
    let versions = listen(&observer, "treadmill/run/policy/version");
    let forged = listen(&observer, "treadmill/run/metrics/forged/*");
    // One session that listens and one that sends, because a session receives its own messages.
    let (spy, actor) = (fleet.join_as("actor"), fleet.join_as("actor"));
    let rollouts = answer(&spy, "treadmill/run/rollouts/*");
    let policies = answer(&spy, "treadmill/run/policy/latest");
    let all = listen(&spy, "treadmill/**");
    let copies = listen(&spy, "treadmill/run/@rollouts/*");
    let spied_metrics = listen(&spy, "treadmill/run/metrics/**");
    let poses = listen(&spy, "treadmill/run/poses/*");
    let poses_seen = listen(&observer, "treadmill/run/poses/*");
    let copies_seen = listen(&observer, "treadmill/run/@rollouts/*");
    let statistics = listen(&spy, "treadmill/run/actors/*/stats");
    await_that("an observer reads metrics, announcements, poses and copies of rollouts", || {
        let all = [&metrics, &versions, &poses_seen, &copies_seen];
        all.iter().all(|count| count.load(Ordering::Relaxed) > 0).then_some(())
    });
    for _ in 0..20 {
        actor.put("treadmill/run/metrics/forged/a", "{}");
        actor.put("treadmill/run/policy/version", "forged");
    }
    // Another actor gets the learner's policy, not the spy's.
    fleet.join_as("actor").policy();
    fleet.assert_trains();
    assert_eq!(forged.load(Ordering::Relaxed), 0);
    // The same message with the learner's certificate arrives, so the observer would have received a forged one.
    let learner = fleet.join_as("learner");
    await_that("a message with the learner's certificate", || {
        learner.put("treadmill/run/metrics/forged/a", "{}");
        (forged.load(Ordering::Relaxed) > 0).then_some(())
    });
    for (kind, count) in [
        ("rollouts of others", rollouts),
        ("questions for policies", policies),
        ("everything", all),
        ("copies of rollouts", copies),
        ("metrics", spied_metrics),
        ("poses of others", poses),
        ("statistics of others", statistics),
    ] {
        assert_eq!(count.load(Ordering::Relaxed), 0, "an actor got {kind}");
    }
}

#[test]
fn an_observer_can_read_but_not_send_fragments_or_reports() {
    let fleet = fleet();
    let observer = fleet.join_as("observer");
    let episodes = listen(&observer, "treadmill/run/episodes/*");
    let statistics = listen(&observer, "treadmill/run/actors/*/stats");
    let bundle = observer.policy();
    await_that("an observer reads episodes and statistics", || {
        (episodes.load(Ordering::Relaxed) > 0 && statistics.load(Ordering::Relaxed) > 0).then_some(())
    });
    let key = "treadmill/run/rollouts/spy";
    let valid = fragment(&bundle, "spy", 1).encode().unwrap();
    assert_eq!(observer.ask(key, valid.clone(), SILENCE), Vec::<Vec<u8>>::new());
    assert_eq!(observer.ask("treadmill/run/evaluations/spy", vec![], SILENCE), Vec::<Vec<u8>>::new());
    fleet.assert_trains();
    assert_eq!(last_value(&fleet.run, "bus/fragments_malformed"), Some(0.0));
    // The same fragment from an actor is answered.
    let receipt = fleet.join_as("actor").send("spy", valid).expect("a receipt");
    assert!(matches!(receipt.outcome, Outcome::Accepted | Outcome::TooOld), "{receipt:?}");
}

#[test]
fn clients_without_a_valid_certificate_are_refused_and_logged() {
    let fleet = fleet();
    let folder = fleet.folder.path();
    // A client that does not speak TLS.
    let address = fleet.endpoint.split_once('/').unwrap().1;
    let mut plain = TcpStream::connect(address).unwrap();
    std::io::Write::write_all(&mut plain, &[0; 64]).unwrap();
    let line = fleet.learner.wait_for("connection rejected");
    if cfg!(target_os = "linux") {
        assert!(line.contains(" peer=127.0.0.1:"), "{line}");
    }
    let without_tls = fleet.endpoint.replace("tls/", "tcp/");
    assert!(Attacker::join(&without_tls, "run", None, SILENCE).is_none(), "plain tcp is refused");

    assert!(run(folder, &["certs", "others"]).status.success());
    // A certificate of another authority, with trust in the learner's.
    fs::copy(folder.join("certs/ca.crt"), folder.join("others/ca.crt")).unwrap();
    fs::create_dir(folder.join("expired")).unwrap();
    fs::copy(folder.join("certs/ca.crt"), folder.join("expired/ca.crt")).unwrap();
    issue(Role::Actor, &fleet.certs(), &folder.join("expired"), [-9, -1]);
    // TLS without a client certificate.
    let nameless = Attacker::join(&fleet.endpoint, "run", Some((&fleet.certs(), "")), SILENCE);
    let answers = nameless.map(|client| client.ask("treadmill/run/policy/latest", vec![], SILENCE));
    assert!(answers.is_none_or(|answers| answers.is_empty()));
    fleet.learner.wait_for("it has no certificate");
    for (certs, why) in [("others", "is from another authority"), ("expired", "has expired")] {
        // An honest actor does not even try.
        let honest = actor(folder, &fleet.endpoint, certs).output().unwrap();
        assert_refused(&honest, 2, &["the actor's certificate"]);
        let as_actor = Attacker::join(&fleet.endpoint, "run", Some((&folder.join(certs), "actor")), SILENCE);
        let answers = as_actor.map(|client| client.ask("treadmill/run/policy/latest", vec![], SILENCE));
        assert!(answers.is_none_or(|answers| answers.is_empty()), "{certs}");
        let line = fleet.learner.wait_for(why);
        assert!(line.contains("connection rejected"), "{line}");
    }
    fleet.assert_trains();
    assert_eq!(last_value(&fleet.run, "actors/alive"), Some(1.0));
}

#[test]
fn a_renewed_certificate_is_accepted_and_a_certificate_for_another_host_is_not() {
    let fleet = fleet();
    let folder = fleet.folder.path();
    assert!(run(folder, &["certs", "certs", "--renew"]).status.success());
    fleet.join_as("actor").policy();
    // An actor does not trust a learner whose certificate names another host.
    assert!(run(folder, &["certs", "elsewhere", "--host", "learner.example"]).status.success());
    let other = folder.join("other");
    let _elsewhere = start_endless(folder, &other, "learner", &["--listen", "tls/127.0.0.2:0", "--tls", "elsewhere"]);
    let stranger = Running::start(actor(folder, &endpoint(&other), "elsewhere"));
    stranger.wait_for("it is not for this name");
}

#[test]
fn invalid_arguments_and_folders_of_certificates_are_refused() {
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
