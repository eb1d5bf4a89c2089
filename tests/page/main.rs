//! The page in a real browser, and clients that are not one.

mod browser;
mod picture;
#[path = "../support/mod.rs"]
mod support;

use std::{
    fs,
    io::{Read, Write},
    net::TcpStream,
    path::Path,
};

use browser::{Browser, NARROW, Page, WIDE};
use serde_json::json;
use support::*;

/// Policies that are part of the repository.
const WALK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/results/policy.safetensors");
const G1: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/results/g1.safetensors");

/// Starts `watch`, and returns the address of its page.
fn watch(folder: &Path, args: &[&str]) -> (Running, String) {
    let watching = start(folder, &[&["watch", "--page-listen", "127.0.0.1:0"], args].concat());
    let line = watching.wait_for("watch at ");
    (watching, line.split_once("watch at ").expect("as waited for").1.to_string())
}

/// Returns a number in what the page shows of the first robot.
fn shown(browser: &mut Browser, page: &Page, field: &str) -> f64 {
    let value = browser.value(page, &format!("window.treadmill.shown()?.{field}"));
    value.as_f64().unwrap_or_else(|| panic!("{field} is {value}"))
}

fn assert_clean(browser: &Browser, address: &str) {
    assert_eq!(browser.errors(), Vec::<String>::new());
    let host = address.trim_start_matches("http://");
    let foreign = |url: &String| !url.contains(host) && !url.starts_with("data:") && !url.starts_with("blob:");
    let requests = browser.requests();
    assert!(requests.len() >= 4, "{requests:?}");
    assert!(!requests.iter().any(foreign), "{requests:?}");
}

#[test]
fn the_page_shows_a_robot_that_moves_and_obeys_the_keyboard() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut browser) = Browser::start() else { return };
    let (watching, address) = watch(folder.path(), &[G1, "--steer"]);
    let page = browser.open(&address, WIDE);
    browser.wait_for(&page, "window.treadmill?.frames() > 10");
    let first = browser.screenshot(&page);
    // Colours of left and right limbs.
    let orange = |[r, g, b]: [u8; 3]| r > 110 && r > g.saturating_add(25) && g > b.saturating_add(15);
    let green = |[r, g, b]: [u8; 3]| g > r.saturating_add(25) && b > r.saturating_add(25);
    assert!(first.share(orange) > 0.002 && first.share(green) > 0.002);
    // Steering goes on from the robot's own command; this stops it first.
    browser.press(&page, "x", "KeyX");
    for _ in 0..4 {
        browser.press(&page, "w", "KeyW");
    }
    // A G1 that is asked for 0.4 m/s walks faster than 0.2 m/s.
    browser.wait_for(&page, "Math.abs(window.treadmill.shown().command[0] - 0.4) < 1e-3");
    let from_s = shown(&mut browser, &page, "shown_s");
    browser.wait_for(&page, &format!("window.treadmill.shown().shown_s > {from_s} + 4"));
    let state = |browser: &mut Browser| ["base_m[0]", "base_m[1]", "shown_s"].map(|field| shown(browser, &page, field));
    let begun = state(&mut browser);
    browser.wait_for(&page, &format!("window.treadmill.shown().shown_s > {} + 4", begun[2]));
    let ended = state(&mut browser);
    let speed_mps = (ended[0] - begun[0]).hypot(ended[1] - begun[1]) / (ended[2] - begun[2]);
    assert!((0.2..0.6).contains(&speed_mps), "{speed_mps}");
    let later = browser.screenshot(&page);
    later.keep("g1.png");
    assert!(later.difference(&first) > 0.002, "{}", later.difference(&first));
    // Paused, the picture stands still while frames come in.
    browser.press(&page, " ", "Space");
    let paused_s = shown(&mut browser, &page, "shown_s");
    let frames = browser.value(&page, "window.treadmill.frames()");
    browser.wait_for(&page, &format!("window.treadmill.frames() > {frames} + 10"));
    assert!((shown(&mut browser, &page, "shown_s") - paused_s).abs() < 0.2);
    assert_clean(&browser, &address);
    stop(watching);
}

#[test]
fn the_imitated_motion_is_a_ghost_beside_the_robot() {
    let (folder, run) = folders();
    let Some(mut browser) = Browser::start() else { return };
    motion::write_imitated_robot(folder.path());
    motion::write_motion(folder.path(), "squat.csv", 0.6);
    // A mesh that is only seen: the page draws it instead of the shapes, without a flag.
    let seen = r#"<geom type="mesh" mesh="seen"/>"#;
    fs::write(
        folder.path().join("seen.obj"),
        "v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 0.2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    )
    .unwrap();
    let text = ROBOT_XML.replacen("<worldbody>", r#"<asset><mesh name="seen" file="seen.obj"/></asset><worldbody>"#, 1);
    let root = r#"<freejoint name="root"/>"#;
    fs::write(folder.path().join("robot.xml"), text.replacen(root, &format!("{root}{seen}"), 1)).unwrap();
    let train =
        ["train", "--preset", "smoke", "--task", "motion", "--steps", "512", "--actors", "1", "--model", "robot.toml"];
    let time = set(&["env.control_step_s=0.02", "env.substeps=5"]);
    let motion = ["--motion", "squat.csv", "--fps", "50", "--run-dir", run.to_str().unwrap()];
    done(folder.path(), &[&train[..], &time, &motion].concat());
    let (watching, address) = watch(folder.path(), &["run"]);
    let page = browser.open(&address, WIDE);
    browser.wait_for(&page, "window.treadmill?.frames() > 10 && window.treadmill.ghosts() === 1");
    assert_eq!(browser.value(&page, "window.treadmill.bodies()"), json!([1]));
    // The target of the joint that is chosen.
    let target = browser.value(&page, "document.getElementById('target').textContent");
    assert!(target.as_str().unwrap().starts_with("target "), "{target}");
    browser.screenshot(&page).keep("ghost.png");
    assert_clean(&browser, &address);
    stop(watching);
}

#[test]
fn policies_stand_side_by_side_on_a_phone_and_read_only_pages_cannot_steer() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut browser) = Browser::start() else { return };
    let (watching, address) = watch(folder.path(), &[G1, WALK, "--seed", "3"]);
    let page = browser.open(&address, NARROW);
    browser.wait_for(&page, "window.treadmill?.frames() > 10 && window.treadmill.robots() === 2");
    assert_eq!(browser.value(&page, "window.treadmill.steers()"), false);
    let title = browser.value(&page, "document.title");
    let title = title.as_str().unwrap();
    assert!(title.find("g1") < title.find("policy"), "the first one named is the first one shown: {title}");
    let overflows = browser.value(&page, "document.documentElement.scrollWidth > window.innerWidth");
    assert_eq!(overflows, false, "the page is wider than a phone");
    browser.screenshot(&page).keep("phone.png");
    assert_clean(&browser, &address);
    stop(watching);
}

#[test]
fn a_training_run_is_shown_and_found_again_after_its_learner_was_killed() {
    let (folder, run) = folders();
    let Some(mut browser) = Browser::start() else { return };
    let [listen] = free_endpoints("");
    let listen = listen.trim_start_matches('/');
    let page_at = ["--page-listen", listen, "--no-progress", "--actors", "1"];
    let training = start_endless(folder.path(), &run, "train", &page_at);
    let address = training.wait_for("  page      ");
    assert!(address.contains(&format!("http://{listen}/")), "{address}");
    await_steps(&run, 1024);
    let address = format!("http://{listen}/");
    let page = browser.open(&address, WIDE);
    browser.wait_for(&page, "window.treadmill?.fleet().runs === 1 && window.treadmill.fleet().actors === 1");
    browser.wait_for(&page, "window.treadmill?.frames() > 10");
    browser.wait_for(&page, "document.querySelectorAll('#charts .uplot').length > 2");
    browser.screenshot(&page).keep("train.png");
    training.signal(libc::SIGKILL);
    let _ = training.wait();
    browser.wait_for(&page, "!window.treadmill.connected()");
    let frames = browser.value(&page, "window.treadmill.frames()");
    let resumed = start(folder.path(), &[&["train", "--resume", "run"], &page_at[..]].concat());
    browser.wait_for(&page, &format!("window.treadmill.connected() && window.treadmill.frames() > {frames} + 10"));
    assert_eq!(browser.value(&page, "document.getElementById('banner').hidden"), true);
    stop(resumed);
    browser.wait_for(&page, "document.getElementById('banner').textContent.includes('has ended')");
}

#[test]
fn an_actor_that_trains_is_watched_live() {
    let (folder, run) = folders();
    let Some(mut browser) = Browser::start() else { return };
    let training = start_endless(folder.path(), &run, "train", &["--no-page", "--no-progress", "--actors", "1"]);
    await_steps(&run, 512);
    let (watching, address) = watch(folder.path(), &["--live", "run"]);
    let page = browser.open(&address, WIDE);
    browser.wait_for(&page, "window.treadmill?.frames() > 10");
    let episode = shown(&mut browser, &page, "episode");
    browser.wait_for(&page, &format!("window.treadmill.shown().episode > {episode}"));
    assert_clean(&browser, &address);
    stop(watching);
    drop(training);
}

#[test]
fn a_trace_is_played_as_it_was_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut browser) = Browser::start() else { return };
    done(folder.path(), &["eval", G1, "--episodes", "1", "--trace", "trace.jsonl"]);
    let text = std::fs::read_to_string(folder.path().join("trace.jsonl")).unwrap();
    let steps: Vec<serde_json::Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let (watching, address) = watch(folder.path(), &[G1, "--trace", "trace.jsonl"]);
    let page = browser.open(&address, WIDE);
    browser.wait_for(&page, "window.treadmill?.shown()?.shown_s > 1");
    browser.press(&page, " ", "Space");
    let shown = browser.value(&page, "window.treadmill.shown()");
    // Between two steps of the trace: G1 makes one each 20 ms, the page shows 30 poses per second and what lies between.
    let time_s = shown["time_s"].as_f64().unwrap();
    let begun = (time_s / 0.02) as usize;
    for axis in 0..3 {
        let at = |step: usize| steps[step.min(steps.len() - 1)]["qpos"][axis].as_f64().unwrap();
        let near: Vec<f64> = (begun.saturating_sub(3)..begun + 4).map(at).collect();
        let (low, high) =
            (near.iter().copied().fold(f64::MAX, f64::min), near.iter().copied().fold(f64::MIN, f64::max));
        let found = shown["base_m"][axis].as_f64().unwrap();
        assert!(
            (low - 1e-3..=high + 1e-3).contains(&found),
            "axis {axis}: {found} is not in {low} to {high} at {time_s} s"
        );
    }
    assert_eq!(shown["angles_rad"].as_array().unwrap().len(), 29);
    assert_clean(&browser, &address);
    stop(watching);
}

#[test]
fn one_page_at_a_time_steers_also_by_a_gamepad() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut browser) = Browser::start() else { return };
    let (watching, address) = watch(folder.path(), &[G1, "--steer"]);
    let [first, second] = [WIDE, WIDE].map(|size| browser.open(&address, size));
    for page in [&first, &second] {
        browser.wait_for(page, "window.treadmill?.frames() > 10");
    }
    browser.press(&first, "x", "KeyX");
    browser.wait_for(&second, "window.treadmill.othersSteer()");
    assert_eq!(browser.value(&first, "window.treadmill.othersSteer()"), false);
    // A stick that is pushed forward after it rested once.
    let gamepad = |forward: f64| {
        format!(
            "Object.defineProperty(navigator, 'getGamepads', {{ configurable: true, value: () => \
             [{{ connected: true, mapping: 'standard', axes: [0, {}, 0, 0], buttons: [] }}] }}); true",
            -forward
        )
    };
    browser.value(&second, &gamepad(0.0));
    // What is shown moves only when the page is drawn, which reads the sticks.
    let rested_s = shown(&mut browser, &second, "shown_s");
    browser.wait_for(&second, &format!("window.treadmill.shown().shown_s > {rested_s} + 2"));
    browser.value(&second, &gamepad(1.0));
    browser.wait_for(&first, "window.treadmill.othersSteer()");
    // Full forward is the end of training's range, 1 m/s.
    browser.wait_for(&first, "Math.abs(window.treadmill.shown().command[0] - 1) < 1e-3");
    // Its command ends with it.
    browser.close(&second);
    browser.wait_for(&first, "!window.treadmill.othersSteer()");
    // Full screen, and back.
    browser.click(&first, "#full");
    browser.wait_for(&first, "document.fullscreenElement !== null");
    browser.click(&first, "#full");
    browser.wait_for(&first, "document.fullscreenElement === null");
    stop(watching);
}

#[test]
fn seeds_of_one_experiment_are_shown_as_a_band() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut browser) = Browser::start() else { return };
    for seed in ["1", "2"] {
        let run = format!("walk-{seed}");
        let train = ["train", "--preset", "smoke", "--steps", "4096", "--seed", seed, "--run-dir", &run, "--no-page"];
        done(folder.path(), &train);
    }
    let (watching, address) = watch(folder.path(), &["walk-1", "walk-2"]);
    let page = browser.open(&address, WIDE);
    browser.wait_for(&page, "window.treadmill?.bands() > 2");
    browser.screenshot(&page).keep("seeds.png");
    assert_clean(&browser, &address);
    stop(watching);
}

/// Sends a request and returns the answer's first line.
fn answer(address: &str, request: &str) -> String {
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(TIMEOUT)).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    let mut text = String::new();
    let mut bytes = [0; 4096];
    while !text.contains("\r\n") {
        let count = stream.read(&mut bytes).unwrap();
        assert!(count > 0, "closed after `{text}`");
        text += &String::from_utf8_lossy(&bytes[..count]);
    }
    text.lines().next().unwrap().to_string()
}

#[test]
fn pages_of_other_sites_get_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (watching, address) = watch(folder.path(), &[WALK]);
    let own = address.trim_start_matches("http://").trim_end_matches('/');
    let upgrade = "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
                   Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    let get =
        |path: &str, host: &str, more: &str| answer(own, &format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n{more}\r\n"));
    assert!(get("/", own, "").contains("200"));
    assert!(get("/", "evil.example", "").contains("403"));
    assert!(get("/socket", own, &format!("{upgrade}Origin: {}\r\n", address.trim_end_matches('/'))).contains("101"));
    assert!(get("/socket", own, upgrade).contains("403"));
    assert!(get("/socket", own, &format!("{upgrade}Origin: http://evil.example\r\n")).contains("403"));
    assert!(get("/../Cargo.toml", own, "").contains("404"));
    stop(watching);
}

#[test]
fn invalid_arguments_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |args: &[&str], code, parts: &[&str]| {
        assert_refused(&run(folder.path(), &[&["watch"], args].concat()), code, parts);
    };
    refused(&[], 2, &["treadmill watch runs/walk-1", "--live"]);
    refused(&["absent"], 2, &["absent"]);
    refused(&[WALK, "absent"], 2, &["absent"]);
    refused(&[WALK; 33], 2, &["33 runs", "at most 32"]);
    refused(
        &[WALK, "--trace", "absent.jsonl"],
        1,
        &["--trace absent.jsonl", "treadmill eval RUN --trace absent.jsonl"],
    );
    std::fs::write(folder.path().join("trace.jsonl"), "{\"episode\":1,\"step\":0,\"qpos\":[0],\"qvel\":[]}\n").unwrap();
    refused(&[WALK, "--trace", "trace.jsonl"], 1, &["--trace trace.jsonl: line 1", "this robot has [24, 23]"]);
    assert_usage(folder.path(), &["watch", WALK, "--trace", "trace.jsonl", "--steer"], &["--trace", "--steer"]);
    refused(&[WALK, "--page-listen", "0.0.0.0:7448"], 2, &["--page-listen 0.0.0.0:7448", "ssh -L 7448:127.0.0.1:7448"]);
    refused(&[WALK, "--actor", "a"], 2, &["--live"]);
    refused(&["--live", "run", "--steer"], 2, &["--live", "--steer"]);
    refused(&[WALK, "--model", "absent.xml"], 1, &["absent.xml"]);
    refused(&["--live", "--connect", "tcp/127.0.0.1:9", "--actor", "a/b"], 2, &["--actor", "a/b"]);
    refused(&["--live", "--connect", "tcp/127.0.0.1:9"], 1, &["no process listens at tcp/127.0.0.1:9"]);
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    refused(&[WALK, "--page-listen", &address], 2, &["--page-listen", &address]);
    assert_usage(folder.path(), &["train", "--no-page", "--steer"], &["--no-page", "--steer"]);
}
