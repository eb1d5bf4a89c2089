//! Hostile client: raw Zenoh, without the limits of Treadmill's own clients.

use std::{
    path::Path,
    sync::{
        Arc, Mutex,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use bytes::Bytes;
use serde_json::json;
use treadmill_proto::{ActorStats, Fragment, PolicyBundle, PolicyPiece, PolicyRequest, PolicyVersion, Receipt};
use zenoh::{Config, Session, Wait, qos::CongestionControl};

#[path = "../support/fragment.rs"]
pub mod sample;

pub use self::sample::fragment;

/// Longest wait for an answer.
pub const TIMEOUT: Duration = Duration::from_secs(20);
/// Number in a valid fragment that is replaced after encoding.
const MARK: f32 = 1234.5;

/// Client of the bus.
pub struct Attacker {
    session: Session,
    run: String,
}

/// Messages of a flood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flood {
    /// Empty fragments, all under one name.
    Empty,
    /// One invalid byte, each time under another name.
    Names,
    /// 64 KiB of noise under one name.
    Noise,
    /// Fragments with a NaN, under the name of a good actor.
    Impostor,
    /// One valid fragment again and again.
    Replay,
    /// Statistics, each time of another actor.
    Stats,
    /// Requests of evaluators with an invalid report.
    Evaluations,
    /// Announcements of policies, which only the learner may make.
    Forbidden,
}

impl Flood {
    /// All kinds, with their names on the command line.
    pub const ALL: [(&'static str, Self); 8] = [
        ("empty", Self::Empty),
        ("names", Self::Names),
        ("noise", Self::Noise),
        ("impostor", Self::Impostor),
        ("replay", Self::Replay),
        ("stats", Self::Stats),
        ("evaluations", Self::Evaluations),
        ("forbidden", Self::Forbidden),
    ];
}

impl Attacker {
    /// Joins the bus of `run`. Uses TLS if given a folder of certificates and a role; an empty role shows no
    /// certificate. Returns `None` if the session is not open within `timeout`.
    pub fn join(endpoint: &str, run: &str, tls: Option<(&Path, &str)>, timeout: Duration) -> Option<Self> {
        let mut config = Config::default();
        let mut set = |key: &str, value: serde_json::Value| config.insert_json5(key, &value.to_string()).unwrap();
        set("mode", json!("client"));
        set("scouting/multicast/enabled", json!(false));
        set("connect/endpoints", json!([endpoint]));
        set("connect/timeout_ms", json!(timeout.as_millis() as u64));
        if let Some((folder, role)) = tls {
            set("transport/link/tls/root_ca_certificate", json!(folder.join("ca.crt")));
            if !role.is_empty() {
                set("transport/link/tls/enable_mtls", json!(true));
                set("transport/link/tls/connect_certificate", json!(folder.join(format!("{role}.crt"))));
                set("transport/link/tls/connect_private_key", json!(folder.join(format!("{role}.key"))));
            }
        }
        let session = zenoh::open(config).wait().ok()?;
        Some(Self { session, run: run.to_string() })
    }

    /// Returns the session.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Returns all answers to a query.
    pub fn ask(&self, key: &str, payload: impl Into<Bytes>, timeout: Duration) -> Vec<Vec<u8>> {
        let payload: Bytes = payload.into();
        let asked =
            self.session.get(key).payload(payload).timeout(timeout).congestion_control(CongestionControl::Block).wait();
        let Ok(replies) = asked else { return Vec::new() };
        let until = Instant::now() + timeout + Duration::from_secs(1);
        let mut answers = Vec::new();
        while let Ok(Some(reply)) = replies.recv_deadline(until) {
            answers.extend(reply.result().ok().map(|sample| sample.payload().to_bytes().into_owned()));
        }
        answers
    }

    /// Waits for the newest policy.
    pub fn policy(&self) -> PolicyBundle {
        let until = Instant::now() + TIMEOUT;
        loop {
            let answers = self.ask(&format!("treadmill/{}/policy/latest", self.run), Bytes::new(), TIMEOUT);
            if let Some(bundle) = answers.into_iter().next() {
                return PolicyBundle::decode(bundle).unwrap();
            }
            assert!(Instant::now() < until, "no learner sends a policy");
        }
    }

    /// Sends a payload as a fragment of `actor`.
    pub fn send(&self, actor: &str, payload: impl Into<Bytes>) -> Option<Receipt> {
        let key = format!("treadmill/{}/rollouts/{actor}", self.run);
        let answer = self.ask(&key, payload, TIMEOUT).into_iter().next()?;
        Some(Receipt::decode(&answer).expect("a receipt"))
    }

    /// Serves the policy in `bundle`, encoded as it is, to actors that have no other version.
    pub fn serve_policy(&self, bundle: Arc<Mutex<Vec<u8>>>) {
        let answer = move |query: zenoh::query::Query| {
            let encoded = Bytes::from(bundle.lock().unwrap().clone());
            let PolicyBundle { run, version, .. } = PolicyBundle::decode(encoded.clone()).unwrap();
            let request = query.payload().map(|payload| PolicyRequest::decode(&payload.to_bytes()).unwrap());
            let piece = match request.unwrap_or_default() {
                request if request.known == Some(version) => PolicyPiece::unchanged(&run, version),
                request => PolicyPiece::cut(&run, version, &encoded, request.offset),
            };
            let _ = query.reply(query.key_expr().clone(), piece.encode()).wait();
        };
        let key = format!("treadmill/{}/policy/pieces", self.run);
        self.session.declare_queryable(key).callback(answer).background().wait().unwrap();
    }

    /// Publishes a payload.
    pub fn put(&self, key: &str, payload: impl Into<Bytes>) {
        let payload: Bytes = payload.into();
        let _ = self.session.put(key, payload).congestion_control(CongestionControl::Block).wait();
    }

    /// Sends messages as fast as possible, at most `count` and only before `until`; fragments are by the policy in `bundle`.
    /// Returns their number.
    pub fn flood(&self, flood: Flood, victim: &str, count: u64, until: Instant, bundle: &PolicyBundle) -> u64 {
        let noise: Bytes =
            (0..64 << 10).map(|i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect::<Vec<_>>().into();
        let valid: Bytes = fragment(bundle, "replayer", 1).encode().unwrap().into();
        let nan: Bytes = corrupted(bundle, victim, f32::NAN).into();
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let mut sent = 0;
        while sent < count && Instant::now() < until {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let run = &self.run;
            let rollouts = |actor: &str| format!("treadmill/{run}/rollouts/{actor}");
            match flood {
                Flood::Empty => self.ask_and_leave(&rollouts("flooder"), Bytes::new()),
                Flood::Names => self.ask_and_leave(&rollouts(&format!("f{number}")), Bytes::from_static(&[0xff])),
                Flood::Noise => self.ask_and_leave(&rollouts("noisy"), noise.clone()),
                Flood::Impostor => self.ask_and_leave(&rollouts(victim), nan.clone()),
                Flood::Replay => self.ask_and_leave(&rollouts("replayer"), valid.clone()),
                Flood::Evaluations => {
                    self.ask_and_leave(&format!("treadmill/{run}/evaluations/e{number}"), Bytes::from_static(&[0xff]));
                }
                Flood::Forbidden => self.put(&format!("treadmill/{run}/policy/version"), Bytes::new()),
                Flood::Stats => {
                    let actor = format!("s{number}");
                    let stats = ActorStats { actor: actor.clone(), env_steps_per_s: 1e300, ..ActorStats::default() };
                    self.put(&format!("treadmill/{run}/actors/{actor}/stats"), stats.to_bytes());
                }
            }
            sent += 1;
        }
        sent
    }

    /// Sends a query without waiting for the answer.
    fn ask_and_leave(&self, key: &str, payload: Bytes) {
        let asked = self.session.get(key).payload(payload).timeout(Duration::from_secs(2));
        let _ = asked.congestion_control(CongestionControl::Block).callback(drop).wait();
    }
}

/// Returns a fragment that is valid but for `number` as its reward.
pub fn corrupted(bundle: &PolicyBundle, actor: &str, number: f32) -> Vec<u8> {
    let mut marked = fragment(bundle, actor, 1);
    marked.rewards[0] = MARK;
    let mut bytes = marked.encode().unwrap();
    let mark = MARK.to_le_bytes();
    let at = bytes.windows(4).position(|window| window == mark).expect("the mark is there");
    bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
    bytes
}

/// Returns every kind of malformed fragment: its name, its bytes, and a part of the receipt's reason.
pub fn malformed_fragments(bundle: &PolicyBundle) -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let encode = |actor: &str, change: &dyn Fn(&mut Fragment)| {
        let mut fragment = fragment(bundle, actor, 1);
        change(&mut fragment);
        fragment.encode().unwrap()
    };
    let valid = encode("planes", &|_| ());
    let wide = |fragment: &mut Fragment| {
        fragment.observation_size += 1;
        fragment.observations.push(0.0);
        fragment.last_observations.push(0.0);
    };
    let future = PolicyVersion { number: bundle.version.number + 1_000_000, ..bundle.version };
    vec![
        ("empty", vec![], "the payload has 0 bytes"),
        ("noise", (0..5000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect(), "cannot be decoded"),
        // A text with a length of 2³⁰ bytes, of which one is present.
        ("lengths", vec![0x0a, 0x80, 0x80, 0x80, 0x80, 0x04, b'x'], "cannot be decoded"),
        ("bomb", [0x8a, 1, 0].repeat((29 << 20) / 3), "`episodes`"),
        ("large", vec![0; (30 << 20) + 100], "a fragment has 1 to 31457280"),
        ("nan", corrupted(bundle, "nan", f32::NAN), "`rewards` holds NaN at index 0"),
        ("infinity", corrupted(bundle, "infinity", f32::NEG_INFINITY), "`rewards` holds -inf"),
        ("shapes", encode("shapes", &wide), "`observation_size` is"),
        // The observations a second time, as one number: the last occurrence counts.
        ("planes", [&valid[..], &[0x5a, 4, 0, 0, 0, 0]].concat(), "`observations` is 4 bytes long"),
        ("foreign", encode("foreign", &|f| f.run = "other".into()), "`run` is `other`"),
        ("config", encode("config", &|f| f.config_hash ^= 1), "`config_hash`"),
        ("masked", encode("someone-else", &|_| ()), "as the key says"),
        ("future", encode("future", &|f| f.version = future), "the newest"),
        ("endless", [&valid[..], &[0x20], &[0xff; 9], &[1]].concat(), "`sequence` is 18446744073709551615"),
    ]
}
