//! Certificates of the roles on the bus, and their permissions.
//!
//! Both ends of a link authenticate with certificates of one authority (mutual TLS). A certificate's common name states its
//! holder's role. The learner and routers allow each role only what its work needs, and drop everything else on arrival
//! without an answer.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use serde_json::{Value, json};
use treadmill_proto::limits::{FRAGMENT_BYTES_MAX, POSE_BYTES_MAX, SMALL_BYTES_MAX, STATS_BYTES_MAX};

use crate::role::Role;

/// Certificate files of one role: `ca.crt`, `ROLE.crt` and `ROLE.key` in one folder.
#[derive(Clone, Debug)]
pub struct Credentials {
    /// The folder.
    pub folder: PathBuf,
    /// The role.
    pub role: Role,
}

impl Credentials {
    /// Returns the path of the authority's certificate.
    pub fn authority(folder: &Path) -> PathBuf {
        folder.join("ca.crt")
    }

    /// Returns the paths of this role's certificate and private key.
    pub fn files(&self) -> [PathBuf; 2] {
        ["crt", "key"].map(|kind| self.folder.join(format!("{}.{kind}", self.role.name())))
    }

    /// Returns the first missing file.
    pub fn missing(&self) -> Option<PathBuf> {
        let [certificate, key] = self.files();
        [Self::authority(&self.folder), certificate, key].into_iter().find(|file| !file.is_file())
    }

    /// Returns Zenoh's TLS settings.
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

/// Runs that the certificate of a pool's actors admits to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdmittedPool {
    /// Name of the pool.
    pub pool: String,
    /// Names of runs; one that ends with `*` stands for all that begin so.
    pub runs: Vec<String>,
}

/// Returns Zenoh's access control settings of learners and routers.
pub(super) fn access(pools: &[AdmittedPool]) -> Value {
    let mut rules = Vec::new();
    let mut policies = Vec::new();
    let mut subjects = Vec::new();
    let mut add = |name: &str, common_name: String, granted: Vec<Grant>, runs: Option<&[String]>| {
        let mut ids = Vec::new();
        for (number, Grant { flows, messages, keys }) in granted.into_iter().enumerate() {
            let id = format!("{name}-{number}");
            let keys: Vec<String> = keys.iter().flat_map(|key| of_runs(key, runs)).collect();
            rules.push(json!({
                "id": id, "permission": "allow", "flows": flows, "messages": messages, "key_exprs": keys,
            }));
            ids.push(id);
        }
        policies.push(json!({"rules": ids, "subjects": [name]}));
        subjects.push(json!({"id": name, "cert_common_names": [common_name]}));
    };
    for role in Role::ALL {
        add(role.name(), role.common_name(), grants(role), None);
    }
    let mut of_pools = BTreeMap::<&str, Vec<String>>::new();
    for AdmittedPool { pool, runs } in pools {
        of_pools.entry(pool).or_default().extend_from_slice(runs);
    }
    for (pool, runs) in &of_pools {
        add(&format!("pool-{pool}"), Role::common_name_of_pool(pool), grants(Role::Actor), Some(runs));
    }
    json!({
        "enabled": true,
        "default_permission": "deny",
        "rules": rules,
        "subjects": subjects,
        "policies": policies,
    })
}

/// Returns a key for these runs only, unless it has none or says only which runs there are and what they want.
fn of_runs(key: &str, runs: Option<&[String]>) -> Vec<String> {
    match (runs, key.strip_prefix("treadmill/*/")) {
        (Some(runs), Some(rest)) if !KNOWN_TO_POOLS.contains(&key) => {
            // A wildcard within a part of a key has a sign of its own.
            let part = |run: &String| if run == "*" { run.clone() } else { run.replace('*', "$*") };
            runs.iter().map(|run| format!("treadmill/{}/{rest}", part(run))).collect()
        }
        _ => vec![key.to_string()],
    }
}

/// Returns the size limits of messages to learners and routers, by key; larger messages are dropped on arrival.
pub(super) fn sizes() -> Value {
    json!([
        size_limit("rollouts", "query", "treadmill/*/rollouts/*", FRAGMENT_BYTES_MAX + SMALL_BYTES_MAX),
        size_limit("evaluations", "query", "treadmill/*/evaluations/*", SMALL_BYTES_MAX),
        size_limit("policies", "query", "treadmill/*/policy/**", SMALL_BYTES_MAX),
        size_limit("control", "query", "treadmill/*/control", SMALL_BYTES_MAX),
        size_limit("status", "query", "treadmill/*/status", SMALL_BYTES_MAX),
        size_limit("pool", "query", "treadmill/*/pool/**", SMALL_BYTES_MAX),
        size_limit("statistics", "put", "treadmill/*/actors/*/stats", STATS_BYTES_MAX),
        size_limit("episodes", "put", "treadmill/*/episodes/*", STATS_BYTES_MAX),
        size_limit("poses", "put", "treadmill/*/poses/*", POSE_BYTES_MAX),
    ])
}

fn size_limit(id: &str, message: &str, key: &str, bytes: usize) -> Value {
    json!({"id": id, "flows": IN, "messages": [message], "key_exprs": [key], "size_limit": bytes})
}

type Keys = &'static [&'static str];

/// One permission of a role.
#[derive(Clone)]
struct Grant {
    flows: &'static [&'static str],
    messages: &'static [&'static str],
    keys: Keys,
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
const POLICY: Keys = &["treadmill/*/policy/latest", "treadmill/*/policy/pieces", "treadmill/*/policy/pieces/*"];
const ANNOUNCEMENT: Keys = &["treadmill/*/policy/version"];
const STATUS: Keys = &["treadmill/*/status"];
const TOKENS: Keys = &["treadmill/*/actors/*", "treadmill/*/learner"];
/// Keys that observers and operators may subscribe to.
const PUBLIC: Keys = &[
    "treadmill/*/metrics/**",
    "treadmill/*/episodes/*",
    "treadmill/*/poses/*",
    "treadmill/*/actors/*/stats",
    "treadmill/*/policy/version",
];

/// Copies of accepted fragments. No wildcard matches them, so every rule names them. Observers may read them: they reveal
/// little more than episodes and statistics, and a slow link loses copies without delaying training.
const COPIES: Keys = &["treadmill/*/@rollouts/*"];
/// Keys of all runs that every pool may read: which runs there are, and what they want.
const KNOWN_TO_POOLS: Keys = &["treadmill/*/learner", "treadmill/*/pool/demand", "treadmill/*/pool/room"];
/// Tokens of the pool's actors. No wildcard matches them, either.
const POOLED: Keys = &["treadmill/@pool/actors/*/*"];
/// Everything.
const ALL: Keys = &["treadmill/**", "treadmill/*/@rollouts/*", "treadmill/@pool/actors/*/*"];

/// Allows queries on these keys, and their replies.
fn query(keys: Keys) -> Vec<Grant> {
    vec![
        Grant { flows: IN, messages: &["query"], keys },
        Grant { flows: OUT, messages: &["reply", "declare_queryable"], keys },
    ]
}

/// Allows subscriptions to these keys, and their publications.
fn subscribe(keys: Keys) -> Vec<Grant> {
    vec![Grant { flows: IN, messages: &["declare_subscriber"], keys }, Grant { flows: OUT, messages: &["put"], keys }]
}

fn grants(role: Role) -> Vec<Grant> {
    let read_policy = [query(POLICY), subscribe(ANNOUNCEMENT)].concat();
    // Which runs there are, for the message that the wanted one is missing.
    const LEARNERS: Keys = &["treadmill/*/learner"];
    let learners = vec![
        Grant { flows: IN, messages: &["liveliness_query"], keys: LEARNERS },
        Grant { flows: OUT, messages: &["liveliness_token", "reply"], keys: LEARNERS },
    ];
    let tokens = vec![
        Grant { flows: IN, messages: &["declare_liveliness_subscriber", "liveliness_query"], keys: TOKENS },
        Grant { flows: OUT, messages: &["liveliness_token", "reply"], keys: TOKENS },
    ];
    let watch = [read_policy.clone(), query(STATUS), subscribe(PUBLIC), subscribe(COPIES), tokens].concat();
    match role {
        Role::Learner | Role::Standby | Role::Router => {
            vec![Grant { flows: BOTH, messages: EVERYTHING, keys: ALL }]
        }
        Role::Actor => {
            const ACTORS: Keys = &["treadmill/*/actors/*"];
            const PUBLISHED: Keys = &["treadmill/*/actors/*/stats", "treadmill/*/episodes/*", "treadmill/*/poses/*"];
            let publish = vec![
                Grant { flows: IN, messages: &["put"], keys: PUBLISHED },
                Grant { flows: OUT, messages: &["declare_subscriber"], keys: PUBLISHED },
                Grant { flows: IN, messages: &["liveliness_token"], keys: ACTORS },
                // Whether its name is taken.
                Grant { flows: IN, messages: &["liveliness_query"], keys: ACTORS },
                Grant { flows: OUT, messages: &["liveliness_token", "reply"], keys: ACTORS },
            ];
            let deliver = query(&["treadmill/*/rollouts/*", "treadmill/*/tasks/*"]);
            // Whether the learner hears of an actor whose name is taken.
            let status = query(STATUS);
            let pool = [
                query(&["treadmill/*/pool/demand", "treadmill/*/pool/join/*"]),
                subscribe(&["treadmill/*/pool/release/*", "treadmill/*/pool/room"]),
                vec![
                    Grant { flows: IN, messages: &["liveliness_token"], keys: POOLED },
                    // Whether the learner is still there.
                    Grant { flows: IN, messages: &["declare_liveliness_subscriber"], keys: LEARNERS },
                ],
            ]
            .concat();
            [read_policy, deliver, publish, status, learners, pool].concat()
        }
        Role::Evaluator => [read_policy, query(&["treadmill/*/evaluations/*"]), learners].concat(),
        Role::Observer => watch,
        Role::Operator => [watch, query(&["treadmill/*/control"])].concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pool_is_admitted_to_the_runs_that_are_named() {
        let pools = [AdmittedPool { pool: "lab".to_string(), runs: vec!["walk".to_string(), "seeds-*".to_string()] }];
        let access = access(&pools);
        let keys: Vec<&str> = access["rules"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|rule| rule["id"].as_str().unwrap().starts_with("pool-lab-"))
            .flat_map(|rule| rule["key_exprs"].as_array().unwrap().iter().map(|key| key.as_str().unwrap()))
            .collect();
        for key in ["treadmill/walk/rollouts/*", "treadmill/seeds-$*/policy/latest", "treadmill/@pool/actors/*/*"] {
            assert!(keys.contains(&key), "{key}");
        }
        let of_all: Vec<&&str> = keys.iter().filter(|key| key.starts_with("treadmill/*/")).collect();
        assert!(of_all.iter().all(|key| KNOWN_TO_POOLS.contains(key)), "{of_all:?}");
        let subject = access["subjects"].as_array().unwrap().last().unwrap();
        assert_eq!(subject["cert_common_names"][0], "treadmill-actor-lab");
    }
}
