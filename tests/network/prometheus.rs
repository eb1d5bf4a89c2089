//! The metrics page: all logged metrics, under the names that dashboard, alarms and autoscaling use.

use std::{
    collections::BTreeSet,
    fs,
    io::{Read, Write},
    net::{TcpListener, TcpStream},
    path::Path,
};

use crate::support::*;
use treadmill_learner::metrics::{
    catalogue::{METRICS, MetricSource},
    prometheus,
};

/// Sends a request, and returns status and body.
fn ask(address: &str, method: &str, path: &str) -> Option<(u16, String)> {
    let mut stream = TcpStream::connect(address).ok()?;
    stream.set_read_timeout(Some(TIMEOUT)).expect("a timeout is set");
    write!(stream, "{method} {path} HTTP/1.0\r\nHost: {address}\r\n\r\n").ok()?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer).ok()?;
    let (head, body) = answer.split_once("\r\n\r\n")?;
    Some((head.split(' ').nth(1)?.parse().ok()?, body.to_string()))
}

pub fn get(address: &str, path: &str) -> Option<(u16, String)> {
    ask(address, "GET", path)
}

/// Starts a run with a metrics page, and returns the page's address.
fn train(folder: &Path, run: &Path, more: &[&str]) -> (Running, String) {
    let with_page = ["--no-progress", "--prometheus", "127.0.0.1:0"];
    let training = start_endless(folder, run, "train", &[&with_page, more].concat());
    let line = training.wait_for("  metrics   ");
    let address = line.split("http://").nth(1).and_then(|rest| rest.strip_suffix("/metrics")).expect("an address");
    (training, address.to_string())
}

/// Returns the names of the metrics on a page.
fn names_on(page: &str) -> BTreeSet<String> {
    let type_line = |line: &str| line.strip_prefix("# TYPE ")?.split_once(' ').map(|(name, _)| name.to_string());
    page.lines().filter_map(type_line).collect()
}

/// Returns all words of `text` that look like the name of a metric.
fn names_in(text: &str) -> BTreeSet<String> {
    let is_part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let words = text.split(|c: char| !is_part(c)).filter(|word| word.starts_with("treadmill_"));
    words.map(str::to_string).collect()
}

/// Metrics that only runs of the tasks `velocity` and `motion` log.
const OF_OTHER_TASKS: [&str; 10] = [
    "treadmill_eval_velocity_error_meters_per_second",
    "treadmill_eval_yaw_rate_error_radians_per_second",
    "treadmill_rollout_command_factor",
    "treadmill_rollout_ground_level",
    "treadmill_rollout_failure_entropy",
    "treadmill_eval_body_error_meters",
    "treadmill_eval_body_angle_error_radians",
    "treadmill_eval_anchor_error_meters",
    "treadmill_eval_hinge_error_radians",
    "treadmill_eval_done_ratio",
];

fn repository(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
}

#[test]
fn the_page_has_every_metric_that_is_logged_documented_or_queried() {
    let (folder, run) = folders();
    let often = ["--set", "eval.every_steps=5000", "--set", "eval.episodes=1"];
    let (_training, address) = train(folder.path(), &run, &often);
    let page = await_that("a page with an evaluation and an actor", || {
        let (status, page) = get(&address, "/metrics")?;
        assert_eq!(status, 200);
        let is_full = ["treadmill_eval_mean_reward{", "treadmill_rollout_ep_rew_mean{", "treadmill_actor_policy_lag{"];
        is_full.iter().all(|part| page.contains(part)).then_some(page)
    });
    let exported = names_on(&page);

    let row = page.lines().find(|line| line.starts_with("treadmill_time_timesteps_total{")).expect("the row");
    let (labels, value) = row.rsplit_once(' ').expect("a value");
    assert_eq!(labels, "treadmill_time_timesteps_total{run=\"run\"}");
    let value: f64 = value.parse().expect("a number");
    let step =
        await_that("the same in the log", || metrics(&run).into_iter().find(|(_, step, _)| *step as f64 == value));
    assert!(step.1 > 0);

    // The page's metrics are those of the table, each with its help.
    let rows = METRICS.iter().filter(|row| !matches!(row.source, MetricSource::Term | MetricSource::Histogram));
    let mut documented: BTreeSet<String> = rows.map(|row| prometheus::name(row.tag)).collect();
    for name in OF_OTHER_TASKS {
        assert!(documented.remove(name), "{name} is not documented");
    }
    documented.extend(["survive", "forward", "ctrl", "contact"].map(|term| format!("treadmill_rewards_{term}")));
    assert_eq!(documented, exported);
    assert!(!page.contains("A metric of Treadmill"), "a help text is missing");

    // Metrics that dashboard, alarms and autoscaling query are on the page.
    let mut queried = BTreeSet::new();
    for path in [
        "deploy/observability/grafana/dashboards/treadmill.json",
        "deploy/observability/alarms.yml",
        "deploy/kubernetes/autoscaling.yaml",
        "deploy/kubernetes/prometheus-adapter.yaml",
    ] {
        let names = names_in(&repository(path));
        assert!(!names.is_empty(), "{path} queries no metric");
        queried.extend(names);
    }
    assert_eq!(queried.difference(&exported).collect::<Vec<_>>(), [""; 0].iter().collect::<Vec<_>>());
    let dashboard: serde_json::Value =
        serde_json::from_str(&repository("deploy/observability/grafana/dashboards/treadmill.json")).expect("JSON");
    for panel in dashboard["panels"].as_array().expect("panels") {
        for target in panel["targets"].as_array().into_iter().flatten() {
            let expression = target["expr"].as_str().expect("an expression");
            assert!(!names_in(expression).is_empty(), "`{expression}` queries no metric of Treadmill");
        }
    }
}

#[test]
fn slow_clients_delay_neither_others_nor_training() {
    let (folder, run) = folders();
    let (_training, address) = train(folder.path(), &run, &[]);
    // More connections than are served at a time, none of which completes its request.
    let slow: Vec<TcpStream> = (0..200)
        .map(|_| {
            let mut stream = TcpStream::connect(&address).expect("the port is open");
            // Fails if the connection was refused at once.
            let _ = stream.write_all(b"GET /metrics HTTP/1.1\r\nHost:");
            stream
        })
        .collect();
    let before = last_value(&run, "time/total_timesteps").unwrap_or(0.0) as u64;
    await_steps(&run, before + 2000);
    let (_, health) = await_that("an answer", || get(&address, "/healthz").filter(|(status, _)| *status == 200));
    assert_eq!(health, "ok\n");
    drop(slow);
    assert_eq!(ask(&address, "POST", "/metrics").map(|(status, _)| status), Some(405));
    assert_eq!(get(&address, "/").map(|(status, _)| status), Some(404));
    // An overlong request is cut off, and the next one is answered.
    let _ = get(&address, &format!("/{}", "x".repeat(1_000_000)));
    assert_eq!(get(&address, "/livez").map(|(status, _)| status), Some(200));
}

#[test]
fn the_health_of_each_process_names_what_it_lacks() {
    let (folder, run) = folders();
    let page = |process: &Running, line: &str| {
        let line = process.wait_for(line);
        line.split("http://").nth(1).and_then(|rest| rest.strip_suffix("/metrics")).expect("an address").to_string()
    };
    let with_page = ["--prometheus", "127.0.0.1:0"];
    let learner = start_endless(folder.path(), &run, "learner", &with_page);
    let of_learner = page(&learner, "  metrics   ");
    let answers = |address: &str, path: &str, wanted: &(u16, &str)| {
        await_that(&format!("{wanted:?} of {path}"), || {
            get(address, path).filter(|(status, text)| *status == wanted.0 && text.starts_with(wanted.1))
        });
    };
    answers(&of_learner, "/healthz", &(503, "no actors are connected"));
    answers(&of_learner, "/livez", &(200, "ok"));
    let router_args = ["router", "--listen", "tcp/127.0.0.1:0", "--connect", &endpoint(&run)];
    let router = start(folder.path(), &[&router_args[..], &with_page].concat());
    let listening = router.wait_for("listening ");
    let of_router = page(&router, "metrics   ");
    let actor_args = ["actor", "--envs", "2", "--connect", listening.split(' ').nth(1).expect("an endpoint")];
    let actor = start(folder.path(), &[&actor_args[..], &with_page].concat());
    let of_actor = page(&actor, "metrics   ");
    for address in [&of_learner, &of_router, &of_actor] {
        answers(address, "/healthz", &(200, "ok"));
        answers(address, "/metrics", &(200, "# HELP treadmill_"));
    }
    learner.signal(libc::SIGKILL);
    answers(&of_router, "/healthz", &(503, "no link to tcp/"));
    answers(&of_router, "/livez", &(200, "ok"));
    drop(router);
    answers(&of_actor, "/healthz", &(503, "no link to tcp/"));
}

/// Finds a program of Prometheus, on the path or unpacked; skips the test where it is missing.
fn tool(name: &str) -> Option<String> {
    let program = std::env::var(format!("TREADMILL_{}", name.to_uppercase())).unwrap_or_else(|_| name.to_string());
    if works(&program, &["--version"]) {
        return Some(program);
    }
    skip(&format!("{name} is not installed"));
    None
}

#[test]
fn names_and_types_follow_the_conventions() {
    let Some(promtool) = tool("promtool") else { return };
    let (folder, run) = folders();
    let (_training, address) = train(folder.path(), &run, &[]);
    let page = await_that("a page with an actor", || {
        get(&address, "/metrics").map(|(_, page)| page).filter(|page| page.contains("treadmill_actor_policy_version{"))
    });
    let mut check = std::process::Command::new(promtool)
        .args(["check", "metrics"])
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("promtool starts");
    check.stdin.take().expect("a pipe").write_all(page.as_bytes()).expect("promtool reads");
    let output = check.wait_with_output().expect("promtool ends");
    assert!(output.status.success(), "{}{}", stdout(&output), stderr(&output));
    assert_eq!((stdout(&output), stderr(&output)), (String::new(), String::new()));
}

#[test]
fn prometheus_evaluates_the_alarms_on_a_run() {
    let Some(prometheus) = tool("prometheus") else { return };
    let (folder, run) = folders();
    let (training, address) = train(folder.path(), &run, &[]);
    let at = |name: &str| folder.path().join(name);
    let config = repository("deploy/observability/prometheus.yml");
    let config = config.replace("learner:9464", &address).replace("standby", "standby.invalid");
    let config = config.replace(": 10s", ": 1s").replace(": 30s", ": 1s").replace(": 5s", ": 1s");
    fs::write(at("prometheus.yml"), config).expect("a file");
    fs::write(at("alarms.yml"), repository("deploy/observability/alarms.yml")).expect("a file");
    let mut command = std::process::Command::new(prometheus);
    command.args(["--config.file=prometheus.yml", "--storage.tsdb.path=tsdb", "--web.listen-address=127.0.0.1:0"]);
    command.current_dir(folder.path());
    let server = Running::start(command);
    let line = server.wait_for("\"Listening on\"");
    let server_at = line.split("address=").nth(1).expect("an address").trim().to_string();
    let state = |path: &str| -> Option<serde_json::Value> {
        let (status, text) = get(&server_at, path)?;
        (status == 200).then(|| serde_json::from_str(&text).expect("JSON"))
    };
    let rules = || {
        let rules = state("/api/v1/rules")?["data"]["groups"][0]["rules"].as_array()?.clone();
        let text = |rule: &serde_json::Value, key: &str| rule[key].as_str().unwrap_or_default().to_string();
        Some(
            rules
                .iter()
                .map(|rule| [text(rule, "name"), text(rule, "health"), text(rule, "state")])
                .collect::<Vec<_>>(),
        )
    };
    await_that("a scrape", || {
        let up = state("/api/v1/query?query=treadmill_time_iterations_total")?;
        (!up["data"]["result"].as_array()?.is_empty()).then_some(())
    });
    let evaluated = await_that("all rules evaluated", || {
        rules().filter(|rules| rules.iter().all(|[_, health, _]| health != "unknown"))
    });
    assert!(evaluated.len() >= 7, "{evaluated:?}");
    for [name, health, state] in &evaluated {
        assert_eq!((health.as_str(), state.as_str()), ("ok", "inactive"), "{name}");
    }
    training.signal(libc::SIGKILL);
    await_that("the alarm", || {
        rules()?.iter().any(|[name, _, state]| name == "LearnerGone" && state == "pending").then_some(())
    });
}

#[test]
fn a_stalled_training_thread_is_reported() {
    let (folder, run) = folders();
    // One update takes seconds, longer than the limit set for the page.
    let long = ["ppo.batch=32768", "ppo.minibatch=512", "ppo.epochs=100", "ppo.target_kl=0", "policy.hidden=[256,128]"];
    let mut more = vec!["--stalled-after-s", "1"];
    more.extend(long.iter().flat_map(|pair| ["--set", pair]));
    let (_training, address) = train(folder.path(), &run, &more);
    let health =
        |wanted: u16| await_that("its health", || get(&address, "/healthz").filter(|(status, _)| *status == wanted));
    health(200);
    let (_, why) = health(503);
    assert!(why.starts_with("no progress for "), "{why}");
    health(200);
}

#[test]
fn an_unusable_address_is_refused_before_anything_is_written() {
    let (folder, run) = folders();
    let refused = |address: &str, code, parts: &[&str]| {
        let args = ["train", "--preset", "smoke", "--prometheus", address, "--run-dir", run.to_str().unwrap()];
        assert_refused(&self::run(folder.path(), &args), code, parts);
        assert!(!run.exists(), "{address} left a folder behind");
    };
    refused("0.0.0.0:0", 2, &["--prometheus 0.0.0.0:0", "--prometheus-open", "127.0.0.1"]);
    refused("localhost", 2, &["--prometheus", "localhost"]);
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    refused(&address, 1, &[&address, "choose another port"]);
}
