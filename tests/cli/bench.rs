//! `bench`: every documented field is present and measured. No test asserts a speed.

use crate::support::*;
use serde_json::Value;

fn bench(args: &[&str]) -> Value {
    let (folder, _) = folders();
    let mut all = vec!["bench"];
    all.extend(args);
    all.push("--json");
    let output = self::run(folder.path(), &all);
    assert!(output.status.success(), "{}", stderr(&output));
    last_json(&output)
}

#[test]
fn env_measures_steps_with_and_without_observation() {
    let first = bench(&["env", "--steps", "1280"]);
    assert!(first["env_steps_per_s"].as_f64().unwrap() > 0.0);
    assert!(first["physics_only_steps_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!((&first["observation"], &first["threads"]), (&45.into(), &1.into()));
    assert_eq!(first["observation_kind"], "compact");
    assert_eq!(first["control_step_s"], 0.015);
    assert!(!first["cpu"].as_str().unwrap().is_empty());
    assert_eq!(first["checksum"], bench(&["env", "--steps", "1280"])["checksum"], "the same work each time");
    let spread = bench(&["env", "--steps", "1280", "--threads", "2"]);
    assert_eq!((&spread["threads"], &spread["checksum"]), (&2.into(), &first["checksum"]));
    assert_eq!(spread["workload"], first["workload"], "as many resets");
    let finer = bench(&["env", "--steps", "1280", "--set", "env.substeps=5"]);
    assert_ne!(finer["checksum"], first["checksum"], "configuration keys take effect");
    let slower = bench(&["env", "--steps", "1280", "--set", "env.control_step_s=0.02"]);
    assert_eq!(slower["control_step_s"], 0.02);
}

#[test]
fn env_measures_how_far_joints_exceed_their_limits() {
    let one = bench(&["env", "--quality", "--steps", "6400"]);
    let overshoot = |name: &str| one[format!("limit_overshoot_{name}_rad")].as_f64().expect("a number");
    let ordered = [overshoot("p50"), overshoot("p99"), overshoot("p999"), overshoot("max")];
    assert!(ordered.is_sorted() && ordered[0] >= 0.0 && ordered[3].is_finite(), "{ordered:?}");
    assert_eq!((&one["faults"], &one["steps"]), (&0.into(), &6400.into()));
    let residuals = ["p50", "p99", "max"].map(|name| one[format!("residual_{name}")].as_f64().expect("a number"));
    assert!(residuals.is_sorted() && residuals[2] < 10.0, "{residuals:?} m/s² or rad/s²");
    let two = bench(&["env", "--quality", "--steps", "6400", "--threads", "2"]);
    assert_eq!(one["checksum"], two["checksum"]);
}

#[test]
fn env_ignores_a_retired_key_with_a_notice() {
    let (folder, _) = folders();
    let given = ["bench", "env", "--steps", "64", "--json", "--set", "env.solver_iterations=4"];
    let output = self::run(folder.path(), &given);
    assert!(output.status.success(), "{}", stderr(&output));
    let notice = stderr(&output);
    assert!(notice.contains("retired") && notice.contains("env.solver_iterations"), "{notice}");
    assert_eq!(last_json(&output)["faults"], 0);
}

#[test]
fn env_refuses_a_key_that_does_not_exist() {
    let (folder, _) = folders();
    let output = self::run(folder.path(), &["bench", "env", "--set", "env.substep=4"]);
    assert_refused(&output, 2, &["env.substep", "env.substeps"]);
}

#[test]
fn update_measures_samples_and_does_the_same_work_on_any_number_of_threads() {
    let one = bench(&["update", "--updates", "1", "--minibatch", "256"]);
    assert!(one["samples_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!(one["minibatch"], 256);
    assert!(one["network"].as_str().unwrap().contains("45-256-128"));
    assert!(!one["cpu"].as_str().unwrap().is_empty());
    let two = bench(&["update", "--updates", "1", "--minibatch", "256", "--threads", "2"]);
    assert_eq!((&one["threads"], &two["threads"]), (&1.into(), &2.into()));
    assert_eq!(one["checksum"], two["checksum"]);
    let larger = bench(&["update", "--updates", "1", "--minibatch", "64", "--network", "348-512-256"]);
    assert_eq!(larger["network"], "348-512-256 actor and critic");
}

#[test]
fn policy_measures_calls_and_does_the_same_work_each_time() {
    let one = bench(&["policy", "--calls", "20"]);
    assert!(one["call_us"].as_f64().unwrap() > 0.0 && one["rows_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!((&one["rows"], &one["threads"]), (&64.into(), &1.into()));
    assert_eq!(one["network"], "45-256-128 actor");
    assert!(!one["cpu"].as_str().unwrap().is_empty());
    assert_eq!(one["checksum"], bench(&["policy", "--calls", "10"])["checksum"]);
    let larger = bench(&["policy", "--calls", "10", "--rows", "3", "--network", "348-512-256"]);
    assert_eq!((&larger["rows"], &larger["network"]), (&3.into(), &"348-512-256 actor".into()));
    assert_ne!(one["checksum"], larger["checksum"]);
}

#[test]
fn sizes_that_would_fill_the_memory_are_refused() {
    let (folder, _) = folders();
    for minibatch in ["0", "4000000000"] {
        let output = self::run(folder.path(), &["bench", "update", "--minibatch", minibatch]);
        assert_refused(&output, 2, &["--minibatch", minibatch]);
    }
}

#[test]
fn a_fleet_refuses_a_kept_folder_and_a_second_mode() {
    let (folder, _) = folders();
    let fleet = |args: &[&str]| self::run(folder.path(), &[&["bench", "fleet"], args].concat());
    std::fs::create_dir_all(folder.path().join("kept/fleet")).unwrap();
    assert_refused(&fleet(&["--keep", "kept"]), 2, &["--keep kept", "name another folder"]);
    assert_refused(&fleet(&["--set", "learner.mode=async"]), 2, &["learner.mode=async", "--mode"]);
}

#[test]
fn invalid_networks_are_refused() {
    let (folder, _) = folders();
    for bench in ["update", "policy"] {
        let output = self::run(folder.path(), &["bench", bench, "--network", "45-0"]);
        assert_refused(&output, 2, &["45-0", "45-256-128"]);
    }
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
        assert_eq!((&result["silent"], &result["refused"]), (&0.0.into(), &0.0.into()), "{result}");
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
    // 45 observations, 17 actions, log-probability and reward as floats, a byte of flags, and 1/128 of the last observation of
    // each environment. The rest is the fragment's header.
    let ours = 4.0 * (45.0 + 17.0 + 2.0) + 1.0 + 4.0 * 45.0 / 128.0;
    let (full, half) = (bytes("f32"), bytes("f16"));
    assert!((ours..ours + 0.2).contains(&full), "{full}");
    let ours = ours - 2.0 * 45.0 * (1.0 + 1.0 / 128.0);
    assert!((ours..ours + 0.2).contains(&half), "{half}");
}

#[test]
fn bus_refuses_invalid_flags() {
    let (folder, _) = folders();
    for (flag, value) in [("--seconds", "0"), ("--fragment-mb", "31"), ("--actors", "0")] {
        assert_refused(&self::run(folder.path(), &["bench", "bus", flag, value]), 2, &[flag, value]);
    }
}

#[test]
fn train_measures_the_whole_system() {
    let result = bench(&["train", "--steps", "8192", "--actors", "1"]);
    assert!(result["env_steps_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!(result["actors"], 1);
    assert!(!result["cpu"].as_str().unwrap().is_empty());
}

/// Runs `bench fleet` with a learner of the preset `smoke`, whose fragments have 64 steps, and checks what every run adds up to.
fn fleet(args: &[&str]) -> Value {
    let smoke = ["fleet", "--preset", "smoke", "--actors", "3", "--envs", "4", "--seconds", "0.5", "--warmup-s", "0"];
    let result = bench(&[&smoke, args].concat());
    let fragments = &result["fragments"];
    let count = |name: &str| fragments[name].as_u64().unwrap_or_else(|| panic!("{name}: {result}"));
    assert_eq!(count("produced"), count("accepted") + count("dropped") + count("in_flight"), "{result}");
    assert_eq!(count("dropped"), count("too_old") + count("vanished"), "{result}");
    for name in ["produced", "accepted", "dropped", "in_flight"] {
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
    for kind in ["receipt", "policy_fetch", "send_late"] {
        assert!(figure(&format!("{kind}_p50_ms")) <= figure(&format!("{kind}_p99_ms")), "{result}");
    }
    result
}

#[test]
fn fleet_counts_every_fragment_of_a_learner_in_lock_step() {
    let result = fleet(&["--rate", "4000", "--slow", "0.5"]);
    assert_eq!((&result["mode"], &result["rate_sum"]), (&"sync".into(), &10_000.0.into()));
    assert_eq!(result["policy_lag_max"], 0.0);
    assert_eq!(result["update_steps_per_s_before"], Value::Null);
}

#[test]
fn fleet_counts_every_fragment_of_delayed_actors_behind_a_router() {
    let result = fleet(&["--mode", "async", "--tls", "--routers", "1", "--delay-ms", "5", "--calibrate-s", "0.5"]);
    assert_eq!((&result["mode"], &result["transport"]), (&"async".into(), &"mutual tls".into()));
    let figure = |name: &str| result[name].as_f64().unwrap_or_else(|| panic!("{name}: {result}"));
    let load = figure("rate_sum") / figure("update_steps_per_s_before");
    assert!((load - 0.8).abs() < 1e-3, "{result}");
    assert!(figure("receipt_p50_ms") >= 10.0 && figure("policy_fetch_p50_ms") >= 10.0, "two delays: {result}");
}

#[test]
fn fleet_refuses_rates_out_of_range() {
    let (folder, _) = folders();
    for (args, parts) in [
        (["--rate", "fast"], ["--rate", "auto"]),
        (["--slow", "2"], ["--slow", "0.001 to 1"]),
        (["--load", "0"], ["--load", "above 0"]),
    ] {
        assert_refused(&self::run(folder.path(), &[&["bench", "fleet"][..], &args].concat()), 2, &parts);
    }
}
