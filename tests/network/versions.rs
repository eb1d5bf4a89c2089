//! Fleets of this and the next version: each ignores what only the other knows, and refuses what it must not ignore by name.

use std::{
    path::Path,
    sync::{Arc, Mutex},
};

use crate::{attacks::Attacker, bus::batch, support::*};
use toml::{Table, Value};
use treadmill_bus::{
    Bus,
    learner::{Admission, RolloutCopies, RolloutIntake},
};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_proto::{Fragment, Outcome, PolicyBundle, Receipt, WIRE_VERSION};

/// Field 1000 with three bytes, which no schema of this version has.
const UNKNOWN_FIELD: [u8; 6] = [0xc2, 0x3e, 3, 1, 2, 3];

fn learner(folder: &Path, run: &Path) -> Running {
    let any = ["learner", "--listen", "tcp/127.0.0.1:0", "--preset", "smoke", "--set", "learner.mode=sync"];
    start(folder, &[&any[..], &["--run-dir", run.to_str().unwrap()]].concat())
}

/// Returns the first policy of a run of this version.
async fn bundle() -> PolicyBundle {
    let (folder, run) = folders();
    let _learner = learner(folder.path(), &run);
    policy(&join(&run)).await
}

/// Returns the bundle as a learner of the next version may encode it, after `change` of its configuration.
fn next_version(bundle: &PolicyBundle, change: impl Fn(&mut Table)) -> Vec<u8> {
    let mut config: Table = bundle.config_toml.parse().unwrap();
    change(&mut config);
    let next = PolicyBundle { wire_version: WIRE_VERSION + 1, config_toml: config.to_string(), ..bundle.clone() };
    [&next.encode().unwrap()[..], &UNKNOWN_FIELD].concat()
}

fn section<'a>(config: &'a mut Table, name: &str) -> &'a mut Table {
    config[name].as_table_mut().unwrap()
}

/// Adds keys and a section that this version does not know, and values of learner's keys that it refuses elsewhere.
fn add_unknown(config: &mut Table) {
    section(config, "env").insert("terrain".to_string(), "flat".into());
    section(config, "ppo").insert("minibatch".to_string(), Value::Integer(-1));
    section(config, "ppo").insert("algorithm".to_string(), "ppo-2".into());
    section(config, "learner").insert("quarantine_after".to_string(), "never".into());
    let weather = Table::from_iter([("wind_mps".to_string(), Value::Float(3.0))]);
    config.insert("weather".to_string(), Value::Table(weather));
}

/// Learner of the next version: serves an encoded bundle, and accepts fragments without training.
struct NextLearner {
    bundle: Arc<Mutex<Vec<u8>>>,
    rollouts: RolloutIntake,
    endpoint: String,
    bus: Bus,
    /// Client of the bus that serves the bundle as it is; `common/bus` would encode it.
    _client: Attacker,
}

impl NextLearner {
    fn open(bundle: Vec<u8>) -> Self {
        let (bus, endpoints) = open_router(&[]);
        let copies = RolloutCopies::open(&bus, "run").unwrap();
        let rollouts = RolloutIntake::open(&bus, "run", 4, Arc::new(Admission::new(8, 4)), &copies).unwrap();
        let client = Attacker::join(&endpoints[0], "run", None, TIMEOUT).unwrap();
        let bundle = Arc::new(Mutex::new(bundle));
        client.serve_policy(bundle.clone());
        Self { bundle, rollouts, endpoint: endpoints[0].clone(), bus, _client: client }
    }

    /// Waits for a fragment and accepts it.
    fn accept(&self) -> Fragment {
        let mut incoming = self.rollouts.next(TIMEOUT).expect("a fragment");
        let fragment = incoming.take().unwrap().fragment.unwrap();
        let (version, durable_through) = (fragment.version, fragment.sequence);
        let (outcome, reason) = (Outcome::Accepted, String::new());
        incoming.answer(&Receipt { outcome, reason, version, durable_through, fragment_steps: 0 });
        fragment
    }
}

impl Drop for NextLearner {
    fn drop(&mut self) {
        self.bus.close();
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn an_actor_delivers_to_a_learner_of_the_next_version() {
    let bundle = bundle().await;
    assert_eq!((bundle.wire_version, bundle.wire_version_min), (WIRE_VERSION, 0));
    assert_eq!(bundle.physics_version, PHYSICS_VERSION);
    let learner = NextLearner::open(next_version(&bundle, add_unknown));
    let folder = tempfile::tempdir().unwrap();
    let mut command = treadmill(folder.path());
    command.args(["actor", "--connect", &learner.endpoint, "--run", "run", "--envs", "2"]).env("TREADMILL_LOG", "info");
    let actor = Running::start(command);
    let line = actor.wait_for("ignored unknown keys");
    for key in ["env.terrain", "ppo.algorithm", "weather.wind_mps"] {
        assert!(line.contains(key), "`{key}` is missing in: {line}");
    }
    for sequence in 1..=3 {
        let fragment = learner.accept();
        assert_eq!((fragment.sequence, fragment.config_hash), (sequence, bundle.config_hash));
        assert_eq!((fragment.wire_version, fragment.physics_version), (WIRE_VERSION, PHYSICS_VERSION));
    }
    stop(actor);
}

#[tokio::test(flavor = "multi_thread")]
async fn an_actor_refuses_what_it_must_not_ignore_by_name() {
    let bundle = bundle().await;
    let learner = NextLearner::open(next_version(&bundle, |_| ()));
    let folder = tempfile::tempdir().unwrap();
    let refused = |command: &str, served: Vec<u8>, code: i32, parts: &[&str]| {
        *learner.bundle.lock().unwrap() = served;
        let output = self::run(folder.path(), &[command, "--connect", &learner.endpoint, "--run", "run"]);
        assert_refused(&output, code, parts);
    };
    let next = PHYSICS_VERSION + 1;
    let other_physics = next_version(&PolicyBundle { physics_version: next, ..bundle.clone() }, |_| ());
    let wanted = format!("this actor simulates physics {PHYSICS_VERSION}, the run `run` has physics {next}");
    for command in ["actor", "evaluator"] {
        refused(command, other_physics.clone(), 1, &[&wanted, "use the same version of treadmill"]);
    }
    // A key with an effect that this version does not know.
    let newer = PolicyBundle { wire_version_min: WIRE_VERSION + 1, ..bundle.clone() };
    let needed = format!("wire version {}", WIRE_VERSION + 1);
    refused(
        "actor",
        next_version(&newer, add_unknown),
        1,
        &["`env.terrain`", &needed, "use the same version of treadmill"],
    );
    // A known key with a value of the future.
    let task = |config: &mut Table| drop(section(config, "env").insert("task".to_string(), "humanoid-v6".into()));
    refused("actor", next_version(&bundle, task), 2, &["`env.task` is \"humanoid-v6\"", "\"humanoid-v5\""]);
}

async fn send(bus: &Bus, fragment: &Fragment) -> Receipt {
    deliver(bus, &fragment.actor, [&fragment.encode().unwrap()[..], &UNKNOWN_FIELD].concat()).await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_learner_accepts_fragments_of_other_wire_versions_but_of_no_other_physics() {
    let (folder, run) = folders();
    let _learner = learner(folder.path(), &run);
    let bus = join(&run);
    // A sender that does not set the version of the wire is accepted, too.
    for (sequence, wire_version) in [(1, 0), (2, WIRE_VERSION + 1)] {
        let physics_version = PHYSICS_VERSION;
        let bundle = policy(&bus).await;
        let receipt =
            send(&bus, &Fragment { wire_version, physics_version, ..batch(&bundle, "next-1", sequence) }).await;
        assert_eq!((receipt.outcome, &receipt.reason[..]), (Outcome::Accepted, ""));
        assert_eq!(receipt.version.number, sequence, "one update for each");
    }
    let bundle = policy(&bus).await;
    for physics_version in [0, PHYSICS_VERSION + 1] {
        let receipt = send(&bus, &Fragment { physics_version, ..batch(&bundle, "next-1", 3) }).await;
        assert_eq!(receipt.outcome, Outcome::Malformed);
        let reason = &receipt.reason;
        assert!(reason.contains("`physics_version`") && reason.contains("same version"), "{reason}");
    }
}
