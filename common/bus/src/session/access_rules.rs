//! Who is who on the bus: one certificate for each part that is played, and what it entitles to.
//!
//! Both ends of a link prove by certificates of one authority who they are (mutual TLS). A certificate's common name says
//! which part its holder plays; the learner and routers let each part do what its work needs, and nothing else. What is
//! not allowed is dropped where it comes in, without an answer.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use treadmill_proto::limits::{FRAGMENT_BYTES_MAX, POSE_BYTES_MAX, SMALL_BYTES_MAX, STATS_BYTES_MAX};

/// A part that is played on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Trains; every key is its own.
    Learner,
    /// Hands on what others say.
    Router,
    /// Simulates: sends rollouts, statistics, episodes and poses, reads policies.
    Actor,
    /// Evaluates: hands reports in, takes policies.
    Evaluator,
    /// Watches: reads metrics, episodes, poses, statistics, policies, and who is there.
    Observer,
    /// Watches, and commands the learner.
    Operator,
}

impl Role {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Learner, Self::Router, Self::Actor, Self::Evaluator, Self::Observer, Self::Operator];

    /// Its name, as files are called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Learner => "learner",
            Self::Router => "router",
            Self::Actor => "actor",
            Self::Evaluator => "evaluator",
            Self::Observer => "observer",
            Self::Operator => "operator",
        }
    }

    /// The common name in its certificate.
    #[must_use]
    pub fn common_name(self) -> String {
        format!("treadmill-{}", self.name())
    }

    /// Whether others dial it, so that its certificate must name the hosts where it listens.
    #[must_use]
    pub fn listens(self) -> bool {
        matches!(self, Self::Learner | Self::Router)
    }
}

/// The files of one part: in its folder, `ca.crt`, and `ROLE.crt` and `ROLE.key`.
#[derive(Clone, Debug)]
pub struct Credentials {
    /// The folder.
    pub folder: PathBuf,
    /// Whose they are.
    pub role: Role,
}

impl Credentials {
    /// The authority's certificate, which everybody trusts.
    pub fn authority(folder: &Path) -> PathBuf {
        folder.join("ca.crt")
    }

    /// Certificate and private key of this part.
    pub fn files(&self) -> [PathBuf; 2] {
        ["crt", "key"].map(|kind| self.folder.join(format!("{}.{kind}", self.role.name())))
    }

    /// The first file that is not there.
    pub fn missing(&self) -> Option<PathBuf> {
        let [certificate, key] = self.files();
        [Self::authority(&self.folder), certificate, key].into_iter().find(|file| !file.is_file())
    }

    /// Settings of the transport.
    pub(super) fn transport(&self) -> Value {
        let [certificate, key] = self.files();
        json!({
            "root_ca_certificate": Self::authority(&self.folder),
            "enable_mtls": true,
            "verify_name_on_connect": true,
            "close_link_on_expiration": true,
            "listen_certificate": certificate,
            "listen_private_key": key,
            "connect_certificate": certificate,
            "connect_private_key": key,
        })
    }
}

/// What the learner's session and routers let in and out, as a setting of the bus.
pub(super) fn access() -> Value {
    let mut rules = Vec::new();
    let mut policies = Vec::new();
    for role in Role::ALL {
        let mut own = Vec::new();
        for (number, Grant { flows, messages, keys }) in grants(role).into_iter().enumerate() {
            let id = format!("{}-{number}", role.name());
            rules.push(json!({
                "id": id, "permission": "allow", "flows": flows, "messages": messages, "key_exprs": keys,
            }));
            own.push(id);
        }
        policies.push(json!({"rules": own, "subjects": [role.name()]}));
    }
    let subjects: Vec<Value> =
        Role::ALL.map(|role| json!({"id": role.name(), "cert_common_names": [role.common_name()]})).into();
    json!({
        "enabled": true,
        "default_permission": "deny",
        "rules": rules,
        "subjects": subjects,
        "policies": policies,
    })
}

/// Largest messages that the learner's session and routers let in, by key; what is larger is dropped where it comes in.
pub(super) fn sizes() -> Value {
    let rule = |id: &str, message: &str, key: &str, bytes: usize| json!({"id": id, "flows": IN, "messages": [message], "key_exprs": [key], "size_limit": bytes});
    json!([
        rule("rollouts", "query", "treadmill/*/rollouts/*", FRAGMENT_BYTES_MAX + SMALL_BYTES_MAX),
        rule("evaluations", "query", "treadmill/*/evaluations/*", SMALL_BYTES_MAX),
        rule("policies", "query", "treadmill/*/policy/*", SMALL_BYTES_MAX),
        rule("control", "query", "treadmill/*/control", SMALL_BYTES_MAX),
        rule("statistics", "put", "treadmill/*/actors/*/stats", STATS_BYTES_MAX),
        rule("episodes", "put", "treadmill/*/episodes/*", STATS_BYTES_MAX),
        rule("poses", "put", "treadmill/*/poses/*", POSE_BYTES_MAX),
    ])
}

/// One thing that a part may do.
struct Grant {
    flows: &'static [&'static str],
    messages: &'static [&'static str],
    keys: &'static [&'static str],
}

const IN: &[&str] = &["ingress"];
const OUT: &[&str] = &["egress"];
const BOTH: &[&str] = &["ingress", "egress"];
const EVERYTHING: &[&str] = &[
    "put",
    "delete",
    "declare_subscriber",
    "query",
    "declare_queryable",
    "reply",
    "liveliness_token",
    "declare_liveliness_subscriber",
    "liveliness_query",
];
const POLICY: &[&str] = &["treadmill/*/policy/latest"];
const ANNOUNCEMENT: &[&str] = &["treadmill/*/policy/version"];
const STATUS: &[&str] = &["treadmill/*/status"];
const TOKENS: &[&str] = &["treadmill/*/actors/*", "treadmill/*/learner"];
/// What anybody who watches may read.
const PUBLIC: &[&str] = &[
    "treadmill/*/metrics/**",
    "treadmill/*/episodes/*",
    "treadmill/*/poses/*",
    "treadmill/*/actors/*/stats",
    "treadmill/*/policy/version",
];

/// Copies of accepted fragments. No wildcard matches them, so they are named wherever they may go. Whoever watches may read
/// them: what is in them, every watcher of episodes and statistics knows the gist of, and a link that is too slow loses
/// copies and costs training nothing.
const COPIES: &[&str] = &["treadmill/*/@rollouts/*"];

fn grants(role: Role) -> Vec<Grant> {
    let read_policy = || {
        vec![
            Grant { flows: IN, messages: &["query"], keys: POLICY },
            Grant { flows: OUT, messages: &["reply", "declare_queryable"], keys: POLICY },
            Grant { flows: IN, messages: &["declare_subscriber"], keys: ANNOUNCEMENT },
            Grant { flows: OUT, messages: &["put"], keys: ANNOUNCEMENT },
        ]
    };
    let watch = || {
        let mut grants = read_policy();
        grants.extend([
            Grant { flows: IN, messages: &["query"], keys: STATUS },
            Grant { flows: OUT, messages: &["reply", "declare_queryable"], keys: STATUS },
            Grant { flows: IN, messages: &["declare_subscriber"], keys: PUBLIC },
            Grant { flows: OUT, messages: &["put"], keys: PUBLIC },
            Grant { flows: IN, messages: &["declare_subscriber"], keys: COPIES },
            Grant { flows: OUT, messages: &["put"], keys: COPIES },
            Grant { flows: IN, messages: &["declare_liveliness_subscriber", "liveliness_query"], keys: TOKENS },
            Grant { flows: OUT, messages: &["liveliness_token", "reply"], keys: TOKENS },
        ]);
        grants
    };
    match role {
        Role::Learner | Role::Router => {
            vec![Grant { flows: BOTH, messages: EVERYTHING, keys: &["treadmill/**", "treadmill/*/@rollouts/*"] }]
        }
        Role::Actor => {
            const ROLLOUTS: &[&str] = &["treadmill/*/rollouts/*", "treadmill/*/tasks/*"];
            const TOLD: &[&str] = &["treadmill/*/actors/*/stats", "treadmill/*/episodes/*", "treadmill/*/poses/*"];
            let mut grants = read_policy();
            grants.extend([
                Grant { flows: IN, messages: &["query"], keys: ROLLOUTS },
                Grant { flows: OUT, messages: &["reply", "declare_queryable"], keys: ROLLOUTS },
                Grant { flows: IN, messages: &["put"], keys: TOLD },
                Grant { flows: OUT, messages: &["declare_subscriber"], keys: TOLD },
                Grant { flows: IN, messages: &["liveliness_token"], keys: &["treadmill/*/actors/*"] },
            ]);
            grants
        }
        Role::Evaluator => {
            const EVALUATIONS: &[&str] = &["treadmill/*/evaluations/*"];
            let mut grants = read_policy();
            grants.extend([
                Grant { flows: IN, messages: &["query"], keys: EVALUATIONS },
                Grant { flows: OUT, messages: &["reply", "declare_queryable"], keys: EVALUATIONS },
            ]);
            grants
        }
        Role::Observer => watch(),
        Role::Operator => {
            const CONTROL: &[&str] = &["treadmill/*/control"];
            let mut grants = watch();
            grants.extend([
                Grant { flows: IN, messages: &["query"], keys: CONTROL },
                Grant { flows: OUT, messages: &["reply", "declare_queryable"], keys: CONTROL },
            ]);
            grants
        }
    }
}
