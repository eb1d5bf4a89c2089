//! `bus` and `fleet`: every figure that is documented is there and measured. No test asserts a speed.

use std::{
    path::Path,
    process::{Command, Output},
};

use serde_json::Value;

fn run(folder: &Path, args: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_treadmill-bench");
    Command::new(program).current_dir(folder).args(args).output().expect("the program starts")
}

fn bench(args: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &[args, &["--json"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    serde_json::from_str(text.trim_end().lines().last().expect("a line")).expect("an object")
}

#[track_caller]
fn assert_refused(output: &Output, code: i32, parts: &[&str]) {
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{text}");
    assert!(parts.iter().all(|part| text.contains(part)), "{parts:?} in {text}");
}

#[test]
fn a_fleet_refuses_a_kept_folder_and_a_second_mode() {
    let folder = tempfile::tempdir().unwrap();
    let fleet = |args: &[&str]| run(folder.path(), &[&["fleet"], args].concat());
    std::fs::create_dir_all(folder.path().join("kept/bench")).unwrap();
    assert_refused(&fleet(&["--keep", "kept"]), 2, &["--keep kept", "name another folder"]);
    assert_refused(&fleet(&["--set", "learner.mode=async"]), 2, &["learner.mode=async", "--mode"]);
}

#[test]
fn bus_measures_a_learner_among_actors_over_each_transport() {
    let mut checksums = Vec::new();
    for (flag, transport) in [(None, "tcp"), (Some("--tls"), "mutual tls"), (Some("--shared-memory"), "shared memory")]
    {
        let mut args = vec!["bus", "--actors", "1,3", "--seconds", "1", "--fragment-mb", "0.2", "--broadcasts", "2"];
        args.extend(flag);
        let result = bench(&args);
        assert_eq!((&result["actors"], &result["transport"]), (&3.into(), &transport.into()));
        for field in ["accepted_mb_per_s", "raw_tcp_mb_per_s", "ratio_to_raw_tcp", "receipt_p50_ms", "policy_p50_ms"] {
            assert!(result[field].as_f64().unwrap() > 0.0, "{field} over {transport}: {result}");
        }
        for field in ["learner_resident_max_mb", "learner_cpu_s_per_gb", "actors_cpu_s_per_gb", "raw_tcp_cpu_s_per_gb"]
        {
            assert!(result[field].as_f64().unwrap() > 0.0, "{field} over {transport}: {result}");
        }
        for kind in ["receipt", "policy"] {
            let time_ms = |name: &str| result[format!("{kind}_{name}_ms")].as_f64().unwrap();
            assert!(time_ms("p50") <= time_ms("p99"), "{result}");
        }
        assert_eq!(result["dropped"], 0, "{result}");
        assert_eq!(result["policies_fetched"], 6, "two policies to each of three actors: {result}");
        assert_eq!(result["through_shared_memory"].as_f64().unwrap() > 0.0, transport == "shared memory", "{result}");
        let steps = result["steps"].as_array().unwrap();
        assert_eq!(steps.iter().map(|step| step["actors"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 3]);
        checksums.push(result["checksum"].clone());
    }
    assert!(!checksums[0].as_str().unwrap().is_empty());
    assert!(checksums.iter().all(|checksum| *checksum == checksums[0]), "the same numbers arrive: {checksums:?}");
}

#[test]
fn bus_reports_the_bytes_of_a_transition() {
    let bytes = |precision: &str| {
        let small = ["--actors", "1", "--seconds", "0.2", "--fragment-mb", "0.2", "--broadcasts", "1"];
        bench(&[&["bus", "--precision", precision][..], &small].concat())["bytes_per_transition"].as_f64().unwrap()
    };
    // 45 observations, 17 actions, log-probability and reward as floats, a byte of flags, and 1/128 of the last
    // observation of each environment. The rest is the fragment's header.
    let ours = 4.0 * (45.0 + 17.0 + 2.0) + 1.0 + 4.0 * 45.0 / 128.0;
    let (full, half) = (bytes("f32"), bytes("f16"));
    assert!((ours..ours + 0.2).contains(&full), "{full}");
    let ours = ours - 2.0 * 45.0 * (1.0 + 1.0 / 128.0);
    assert!((ours..ours + 0.2).contains(&half), "{half}");
}

#[test]
fn bus_refuses_invalid_flags() {
    let folder = tempfile::tempdir().unwrap();
    for (flag, value) in [("--seconds", "0"), ("--fragment-mb", "31"), ("--actors", "0")] {
        assert_refused(&run(folder.path(), &["bus", flag, value]), 2, &[flag, value]);
    }
}

/// Runs `fleet` with a learner of the preset `smoke`, whose fragments have 64 steps, and checks what every run adds up to.
fn fleet(args: &[&str]) -> Value {
    let smoke = ["fleet", "--preset", "smoke", "--actors", "3", "--envs", "4", "--seconds", "0.5"];
    let result = bench(&[&smoke, args].concat());
    let fragments = &result["fragments"];
    let count = |name: &str| fragments[name].as_u64().unwrap_or_else(|| panic!("{name}: {result}"));
    assert_eq!(result["in_flight"], count("produced") - count("accepted") - count("dropped"), "{result}");
    for name in ["produced", "accepted", "dropped"] {
        assert_eq!(count(&format!("{name}_steps")), 64 * 4 * count(name), "{name} of 256 transitions each: {result}");
    }
    let untrained = count("accepted_steps") as i64 - result["trained_in_all_steps"].as_i64().unwrap();
    assert_eq!(result["untrained_steps"], untrained);
    assert_eq!(result["nothing_lost"], true, "{result}");
    assert_eq!((&result["actors_alive_min"], &result["actors"]), (&3.0.into(), &3.into()));
    let figure = |name: &str| result[name].as_f64().unwrap_or_else(|| panic!("{name}: {result}"));
    let (trained, dropped) = (figure("trained_steps"), figure("dropped_steps"));
    assert_eq!(figure("used_share"), trained / (trained + dropped), "{result}");
    assert!(figure("updates") >= 5.0 && figure("update_steps_per_s") > 0.0 && figure("learner_resident_max_mb") > 0.0);
    for kind in ["receipt", "policy_fetch"] {
        assert!(figure(&format!("{kind}_p50_ms")) <= figure(&format!("{kind}_p99_ms")), "{result}");
    }
    result
}

#[test]
fn fleet_counts_every_fragment_of_a_learner_in_lock_step() {
    let result = fleet(&["--rate", "4000", "--slow", "0.5"]);
    assert_eq!((&result["mode"], &result["rate_max"]), (&"sync".into(), &4000.0.into()));
    assert_eq!(result["policy_lag_max"], 0.0);
}

#[test]
fn fleet_counts_every_fragment_of_actors_behind_a_router() {
    let result = fleet(&["--mode", "async", "--routers", "1"]);
    assert_eq!((&result["mode"], &result["transport"]), (&"async".into(), &"tcp".into()));
}

#[test]
fn fleet_encrypts_every_link() {
    // At a rate that Zenoh's TLS links bear: under full load they break now and then, and an actor is away for a moment.
    let result = fleet(&["--mode", "async", "--tls", "--routers", "1", "--rate", "4000"]);
    assert_eq!((&result["mode"], &result["transport"]), (&"async".into(), &"mutual tls".into()));
}

#[test]
fn fleet_refuses_rates_out_of_range() {
    let folder = tempfile::tempdir().unwrap();
    for (args, parts) in [
        (["--rate", "fast"], ["--rate", "auto"]),
        (["--slow", "2"], ["--slow", "0.001 to 1"]),
        (["--load", "0"], ["--load", "above 0"]),
    ] {
        assert_refused(&run(folder.path(), &[&["fleet"][..], &args].concat()), 2, &parts);
    }
}
