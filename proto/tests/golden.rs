//! Compatibility: messages as first written decode to the same values, and default fields do not change the encoding.
//!
//! `golden/messages-N.txt` holds one message a line, as it was first encoded: its name and its bytes in
//! hexadecimal. Lines are added, never changed. With `TREADMILL_WRITE_GOLDEN=FILE`, the test writes the messages of
//! this version.

use bytes::Bytes;
use treadmill_proto::{
    ActorState, ActorStats, EndCause, Episode, EvaluationReport, Fragment, Outcome, PolicyAnnouncement, PolicyBundle,
    PolicyPiece, PolicyRequest, PolicyVersion, Pose, Receipt,
    json::{EpisodeReport, Metric},
};

const GOLDEN: &str = include_str!("golden/messages-1.txt");
const VERSION: PolicyVersion = PolicyVersion::new(0x0102_0304_0506_0708, 4);
const ANNOUNCEMENT: PolicyAnnouncement = PolicyAnnouncement { version: VERSION, checksum: 5, actor_checksum: 0 };

fn actor_state() -> ActorState {
    ActorState {
        actor: "actor-0".into(),
        start: 1 << 40,
        noise: vec![1, u64::MAX, 3, 4],
        episodes: vec![5, 6],
        lengths: vec![7, 8],
        progress: vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
        positions: vec![1.0, 2.0, 3.0, 4.0],
        velocities: vec![-1.0, -2.0, -3.0, -4.0],
        observations: vec![0.5, 1.5, 2.5, 3.5],
        past_actions: vec![0.25, -0.25],
        steps_to_push: vec![9, u32::MAX],
        streams: (0..24).collect(),
        task: vec![],
    }
}

fn fragment() -> Fragment {
    let episode = |cause, length| Episode {
        return_sum: 12.5,
        length,
        distance_m: 0.1,
        velocity_mean_mps: 3.0,
        cause,
        ground_kind: None,
        ground_level: None,
        command_factor: None,
        failed_step: None,
    };
    Fragment {
        run: "walk-1".into(),
        actor: "actor-0".into(),
        actor_incarnation: u64::MAX,
        sequence: 300,
        version: VERSION,
        config_hash: 0x1112_1314_1516_1718,
        steps: 2,
        envs: 2,
        observation_size: 2,
        action_size: 1,
        observations: (0..8).map(|i| i as f32 * 0.5).collect(),
        actions: vec![0.5, -0.5, 1.5, -1.5],
        log_probs: vec![-1.0, -2.0, -3.0, -4.0],
        rewards: vec![5.0, 4.0, 3.0, -2.0],
        flags: vec![2, 0, 0, 1],
        last_observations: vec![1.0, 2.0, 3.0, 4.0],
        episodes: vec![episode(EndCause::TimeLimit, 1), episode(EndCause::Fell, 2), episode(EndCause::NonFinite, 3)],
        settled_through: 299,
        actor_state: Some(actor_state()),
        ..Fragment::default()
    }
}

fn bundle() -> PolicyBundle {
    PolicyBundle {
        run: "walk-1".into(),
        version: VERSION,
        observation_size: 2,
        action_size: 1,
        hidden: vec![256, 128],
        weights: Bytes::from_static(b"\0safetensors\xff"),
        observation_mean: vec![0.5, 1.0],
        observation_inverse_std: vec![1.0, 2.0],
        observation_clip: 10.0,
        config_hash: 3,
        config_toml: "[run]\nseed = 1\n".into(),
        model_xml: "<mujoco/>".into(),
        checksum: 0xfff0_0000_0000_0001,
        actor_state: Some(actor_state()),
        ..PolicyBundle::default()
    }
}

fn receipt(outcome: Outcome) -> Receipt {
    Receipt { outcome, reason: "weil – because".into(), version: VERSION, durable_through: 129, fragment_steps: 0 }
}

const OUTCOMES: [(&str, Outcome); 8] = [
    ("receipt.accepted", Outcome::Accepted),
    ("receipt.duplicate", Outcome::Duplicate),
    ("receipt.too_old", Outcome::TooOld),
    ("receipt.vanished", Outcome::Vanished),
    ("receipt.malformed", Outcome::Malformed),
    ("receipt.quarantined", Outcome::Quarantined),
    ("receipt.busy", Outcome::Busy),
    ("receipt.stopping", Outcome::Stopping),
];

#[allow(clippy::needless_update, reason = "added fields have their defaults in old messages")]
fn stats() -> ActorStats {
    ActorStats {
        actor: "actor-0".into(),
        incarnation: 1,
        host: "rack-7".into(),
        pid: 4242,
        version: Some(VERSION),
        envs: 32,
        env_steps_per_s: 6000.5,
        env_steps: 1 << 33,
        episodes: 17,
        faults: 1,
        produced: 20,
        accepted: 15,
        dropped_by_rule: 3,
        in_flight: 2,
        resent: 4,
        awaiting_durability: 5,
        resident_bytes: 60_000_000,
        ..ActorStats::default()
    }
}

fn evaluation() -> EvaluationReport {
    EvaluationReport {
        run: "walk-1".into(),
        evaluator: "evaluator".into(),
        version: VERSION,
        episodes: 20,
        return_mean: 6000.25,
        return_std: 3.5,
        length_mean: 990.0,
        distance_mean_m: 20.5,
        velocity_mean_mps: 1.375,
        falls: 1,
        velocity_error_mps: None,
        yaw_rate_error_radps: None,
        anchor_error_m: None,
        body_error_m: None,
        body_error_rad: None,
        hinge_error_rad: None,
        done_share: None,
    }
}

#[allow(clippy::needless_update, reason = "added fields have their defaults in old messages")]
fn pose() -> Pose {
    Pose {
        run: "walk-1".into(),
        actor: "actor-0".into(),
        actor_incarnation: 1,
        version: Some(VERSION),
        config_hash: 0x1112_1314_1516_1718,
        episode: 3,
        step: 300,
        time_s: 4.5,
        bodies: vec![1.5, -0.25, 1.25, 0.0, 1.0, 0.0, 0.0],
        contacts: vec![1.5, -0.25, 0.0, 0.5, 0.0, 400.0],
        joint_torques_nm: vec![-40.0, 0.125],
        reward_survive: 5.0,
        reward_forward: 1.875,
        reward_ctrl: -0.25,
        reward_contact: -0.5,
        velocity_mps: 1.5,
        distance_m: 6.75,
        ..Pose::default()
    }
}

fn policy_request() -> PolicyRequest {
    PolicyRequest { known: Some(VERSION), announced: Some(VERSION), config_hash: 0x1112_1314_1516_1718, offset: 60_000 }
}

fn policy_piece() -> PolicyPiece {
    let data = Bytes::from_static(&[7]);
    PolicyPiece { run: "walk-1".into(), version: VERSION, total_bytes: 60_001, offset: 60_000, data }
}

fn metric() -> Metric {
    let (run, tag) = ("walk-1".into(), "rollout/ep_rew_mean".into());
    Metric { run, tag, step: 8192, value: 91.95, time_unix_s: 1_795_229_241.25 }
}

fn episode() -> EpisodeReport {
    EpisodeReport::new("walk-1", "actor-0", &fragment().episodes[1])
}

/// Returns every message as this version encodes it.
fn encoded_messages() -> Vec<(&'static str, Vec<u8>)> {
    let mut all = vec![
        ("fragment", fragment().encode().unwrap()),
        ("bundle", bundle().encode().unwrap()),
        ("announcement", ANNOUNCEMENT.encode()),
        ("policy_request", policy_request().encode()),
        ("policy_piece", policy_piece().encode()),
        ("stats", stats().to_bytes()),
        ("evaluation", evaluation().encode()),
        ("pose", pose().to_bytes().unwrap()),
        ("metric", metric().to_json()),
        ("episode", episode().to_json()),
    ];
    all.extend(OUTCOMES.map(|(name, outcome)| (name, receipt(outcome).encode())));
    all
}

/// Asserts that `bytes` decode to the message of this name.
fn assert_decodes(name: &str, bytes: &[u8]) {
    match name {
        "fragment" => assert_eq!(Fragment::decode(bytes), Ok(fragment())),
        "bundle" => assert_eq!(PolicyBundle::decode(bytes.to_vec()), Ok(bundle())),
        "announcement" => assert_eq!(PolicyAnnouncement::decode(bytes), Ok(ANNOUNCEMENT)),
        "policy_request" => assert_eq!(PolicyRequest::decode(bytes), Ok(policy_request())),
        "policy_piece" => assert_eq!(PolicyPiece::decode(bytes.to_vec()), Ok(policy_piece())),
        "stats" => assert_eq!(ActorStats::decode_checked(bytes), Ok(stats())),
        "evaluation" => assert_eq!(EvaluationReport::decode(bytes), Ok(evaluation())),
        "pose" => assert_eq!(Pose::decode_checked(bytes), Ok(pose())),
        "metric" => assert_eq!(Metric::from_json(bytes), Ok(metric())),
        "episode" => assert_eq!(EpisodeReport::from_json(bytes), Ok(episode())),
        _ => {
            let outcome = OUTCOMES.iter().find(|(known, _)| *known == name).expect("a name of this test").1;
            assert_eq!(Receipt::decode(bytes), Ok(receipt(outcome)));
        }
    }
}

fn golden() -> Vec<(&'static str, Vec<u8>)> {
    let parse = |line: &'static str| {
        let (name, hex) = line.split_once(' ').expect("a name and bytes");
        let byte = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).expect("two digits");
        (name, (0..hex.len()).step_by(2).map(byte).collect())
    };
    GOLDEN.lines().filter(|line| !line.is_empty()).map(parse).collect()
}

#[test]
fn old_messages_decode_to_the_same_values() {
    if let Some(file) = std::env::var_os("TREADMILL_WRITE_GOLDEN") {
        let line = |(name, bytes): (&str, Vec<u8>)| {
            let hex: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
            format!("{name} {hex}\n")
        };
        std::fs::write(file, encoded_messages().into_iter().map(line).collect::<String>()).unwrap();
    }
    let golden = golden();
    golden.iter().for_each(|(name, bytes)| assert_decodes(name, bytes));
    for (name, _) in encoded_messages() {
        assert!(golden.iter().any(|(known, _)| *known == name), "`{name}` has no golden bytes");
    }
}

#[test]
fn messages_are_encoded_as_before() {
    // An added field with its default value is not encoded, so these bytes do not change.
    for (name, bytes) in encoded_messages() {
        let (_, old) = golden().into_iter().find(|(known, _)| *known == name).expect("see the other test");
        assert_eq!(bytes, old, "{name} is encoded differently than before");
    }
}

#[test]
fn unknown_fields_are_ignored() {
    // Field 1000 as a varint, as bytes, as four bytes and as eight.
    let added: [&[u8]; 4] = [
        &[0xc0, 0x3e, 0x96, 1],
        &[0xc2, 0x3e, 3, 1, 2, 3],
        &[0xc5, 0x3e, 1, 2, 3, 4],
        &[0xc1, 0x3e, 1, 2, 3, 4, 5, 6, 7, 8],
    ];
    for (name, bytes) in golden() {
        if bytes[0] == b'{' {
            let text = String::from_utf8(bytes).unwrap().replacen('{', r#"{"added":{"deep":[1]},"#, 1);
            assert_decodes(name, text.as_bytes());
            continue;
        }
        for field in added {
            assert_decodes(name, &[field, &bytes].concat());
            assert_decodes(name, &[&bytes, field].concat());
        }
    }
}
