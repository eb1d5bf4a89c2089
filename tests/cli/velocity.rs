//! `eval` of policies that follow commands: tracking, `--commands`, `--randomised`, `--trace`.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::*;

const CARD: &str =
    "model = 'robot.xml'\nfeet = ['left_foot', 'right_foot']\n[[hinges]]\nnames = '*'\neffort_nm = 60.0\n";
const PUSHES: [&str; 2] = ["randomisation.push_mps=[0.1, 0.2]", "randomisation.push_interval_s=[0.1, 0.2]"];
/// Falls end nothing, so that episodes have complete windows.
const NEVER_FALLS: [&str; 4] = ["--set", "velocity.fall_height_share=0", "--set", "velocity.fall_tilt_rad=3.2"];
const FIELDS: [&str; 6] =
    ["velocity_error_mps", "yaw_rate_error_radps", "energy_per_metre_jpm", "foot_slip_mps", "pushes", "windows"];

fn run_with(folder: &Path, parts: &[&[&str]]) -> std::process::Output {
    run(folder, &parts.concat())
}

#[test]
fn a_policy_that_follows_commands_is_measured_by_them() {
    let (folder, run) = folders();
    let folder = folder.path();
    trained_robot(folder, &run, CARD, &PUSHES);
    let path = run.to_str().unwrap();
    let eval = |more: &[&[&str]]| run_with(folder, &[&[&["eval", path, "--episodes", "2"][..]], more].concat());

    // 151 steps: one second of waiting and two windows.
    let three_s = ["--set", "env.max_episode_steps=151", "--set", "velocity.resampling_s=[10, 10]"];
    let result = last_json(&eval(&[&three_s, &NEVER_FALLS, &["--json"]]));
    assert_eq!(
        (&result["windows"], &result["pushes"], &result["falls"]),
        (&4.into(), &0.into(), &0.into()),
        "{result}"
    );
    for field in &FIELDS[..4] {
        assert!(result[field].as_f64().is_some_and(|number| number > 0.0), "{field} in {result}");
    }
    assert!(result["velocity_error_mps"].as_f64().unwrap() < 5.0, "{result}");
    let text = stdout(&eval(&[&three_s, &NEVER_FALLS]));
    for part in ["error m/s", "(0 %)", "tracking      ", "(4 windows of 1 s)", "energy        ", "foot slip     "] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");

    // Pushes come more often than every second.
    let pushed = last_json(&eval(&[&three_s, &NEVER_FALLS, &["--json", "--randomised"]]));
    assert_eq!((&pushed["windows"], &pushed["velocity_error_mps"]), (&0.into(), &Value::Null), "{pushed}");
    assert!(pushed["pushes"].as_u64().unwrap() >= 28, "{pushed}");
    // Changes of command too.
    let changing = ["--set", "velocity.resampling_s=[0.5, 1.9]"];
    assert_eq!(last_json(&eval(&[&three_s, &NEVER_FALLS, &changing, &["--json"]]))["windows"], 0);

    let humanoid = run_with(folder, &[&["eval", "--agent", "random", "--episodes", "1", "--json"]]);
    assert!(FIELDS.iter().all(|field| last_json(&humanoid).get(field).is_none()), "a task without commands");
}

#[test]
fn commands_come_from_a_file_and_every_step_is_traced() {
    let (folder, run) = folders();
    let folder = folder.path();
    trained_robot(folder, &run, CARD, &PUSHES);
    let path = run.to_str().unwrap();
    fs::write(folder.join("walk.csv"), "time_s,vx,vy,yaw_rate\n0,0.5,0,0\n0.1,-0.25,0.125,0.5 # turns\n").unwrap();
    let limits = ["--set", "env.max_episode_steps=8", "--film", "a.gif", "--size", "96x64"];
    let args = ["eval", path, "--episodes", "2", "--json", "--trace", "trace.jsonl", "--commands", "walk.csv"];
    done(folder, &[&args[..], &limits, &NEVER_FALLS].concat());
    let lines = json_lines(&folder.join("trace.jsonl"));
    assert_eq!(lines.len(), 16);
    for (index, line) in lines.iter().enumerate() {
        let (episode, step) = (index / 8 + 1, index % 8 + 1);
        assert_eq!((&line["episode"], &line["step"]), (&episode.into(), &step.into()));
        let sizes = ["action", "qpos", "qvel", "torque"].map(|key| numbers(&line[key]).len());
        assert_eq!(sizes, [29, 36, 35, 29]);
        // Step 6 begins after 0.1 s.
        let expected = if step <= 5 { [0.5, 0.0, 0.0] } else { [-0.25, 0.125, 0.5] };
        assert_eq!(numbers(&line["command"]), expected, "step {step}");
        assert_eq!(numbers(&line["observation"])[6..9], expected, "the policy observes it in step {step}");
    }
    let height = |index: usize| numbers(&lines[index]["qpos"])[2];
    assert!(height(0) != height(1) && (height(0) - height(8)).abs() < 0.2, "the state before each step");

    let refused = |text: &str, parts: &[&str]| {
        fs::write(folder.join("bad.csv"), text).unwrap();
        let output = run_with(folder, &[&["eval", path, "--commands", "bad.csv"]]);
        assert_refused(&output, 2, &[&["--commands bad.csv"], parts].concat());
        assert_eq!(stderr(&output).trim().lines().count(), 1, "{}", stderr(&output));
    };
    refused("0,0,0,0\n1,0,0,5.5\n", &["line 2", "yaw_rate is 5.5", "-5 to 5"]);
    refused("0,0,0,0\n1,0,0,0\n0.5,0,0,0\n", &["line 3", "time_s is 0.5", "after 1"]);
    refused("", &["no command"]);
    let missing = run_with(folder, &[&["eval", path, "--commands", "no.csv"]]);
    assert_refused(&missing, 2, &["--commands no.csv", "cannot be read"]);
    let without = run_with(folder, &[&["eval", "--agent", "random", "--commands", "walk.csv"]]);
    assert_refused(&without, 2, &["--commands walk.csv", "no commands"]);
}

#[test]
fn commands_that_no_episode_reaches_are_named() {
    let (folder, run) = folders();
    let folder = folder.path();
    trained_robot(folder, &run, CARD, &[]);
    let path = run.to_str().unwrap();
    fs::write(folder.join("long.csv"), "0,0.5,0,0\n0.1,0.3,0,0\n0.16,0,0,0\n9,0.1,0,0\n").unwrap();
    let play = |steps: &str| {
        let args = ["eval", path, "--episodes", "1", "--commands", "long.csv", "--json", "--set", steps];
        stderr(&run_with(folder, &[&args]))
    };
    let warning = "--commands long.csv: 2 commands from time_s 0.16 on are not played, because episodes end at 0.16 s";
    assert!(play("env.max_episode_steps=8").contains(warning), "{}", play("env.max_episode_steps=8"));
    assert!(!play("env.max_episode_steps=1000").contains("not played"));
}

#[test]
fn a_robot_that_is_to_stand_is_measured_standing() {
    let (folder, run) = folders();
    let folder = folder.path();
    trained_robot(folder, &run, CARD, &["velocity.gait_rests=true", "velocity.gait_rests_after_s=0"]);
    fs::write(folder.join("stand.csv"), "0,0,0,0\n").unwrap();
    let args = ["eval", run.to_str().unwrap(), "--episodes", "1", "--commands", "stand.csv", "--set"];
    let more = ["env.max_episode_steps=150", "--trace", "trace.jsonl", "--json"];
    let result = last_json(&run_with(folder, &[&args, &more, &NEVER_FALLS]));
    for field in ["standing_drift_m", "standing_hinge_radps", "standing_lifts_per_s"] {
        assert!(result[field].as_f64().is_some_and(|number| number >= 0.0), "{field} in {result}");
    }
    let lines = json_lines(&folder.join("trace.jsonl"));
    // By the trace, which lacks the state after the last of the 50 steps that count.
    let squares = |line: &Value| numbers(&line["qvel"])[6..].iter().map(|rate| rate * rate).sum::<f64>() / 29.0;
    let sum: f64 = lines[101..].iter().map(squares).sum();
    let found = result["standing_hinge_radps"].as_f64().unwrap();
    assert!(found * found * 50.0 > 0.999 * sum && sum > 0.0, "{found} {sum}");
    // The gait's phase rests: the last two entries that the policy sees.
    let phase = |line: &Value| numbers(&line["observation"])[9 + 3 * 29..][..2].to_vec();
    assert!(lines.iter().all(|line| phase(line) == [0.0, 0.0]), "{:?}", phase(&lines[50]));
    let walking = last_json(&run_with(folder, &[&args[..4], &["--json", "--set", "velocity.standing_share=0"]]));
    assert_eq!(walking["standing_drift_m"], Value::Null);
}

#[test]
fn a_robot_that_is_described_wrongly_is_refused_before_it_is_trained() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("robot.xml"), ROBOT_XML).unwrap();
    let train = |card: &str, more: &[&str]| {
        fs::write(folder.join("robot.toml"), card).unwrap();
        let args = ["train", "--model", "robot.toml", "--set", "env.task=velocity", "--steps", "512", "--actors", "1"];
        run(folder, &[&args[..], &["--preset", "smoke", "--run-dir", "never"], more].concat())
    };
    for (feet, parts) in [
        ("['left_foot', 'left_foot']", ["`left_foot` twice", "the right foot"]),
        ("['right_foot', 'left_foot']", ["left foot first", "`right_foot`"]),
    ] {
        let card = CARD.replace("['left_foot', 'right_foot']", feet);
        assert_refused(&train(&card, &[]), 2, &[&parts[..], &["model file `robot.toml`"]].concat());
    }
    assert_refused(
        &train(&format!("height_m = 0.3\n{CARD}"), &[]),
        2,
        &["deep in the ground", "`height_m` of the card"],
    );
    assert!(!folder.join("never").exists());
    fs::write(folder.join("robot.toml"), CARD).unwrap();
    let report = last_json(&run(folder, &["robot", "robot.toml", "--json"]));
    assert_eq!(report["axes"], serde_json::json!({"forward": "+x", "up": "+z"}));
    assert_eq!(report["on_ground_at_home"], serde_json::json!(["left_foot", "right_foot"]), "{report}");
    let text = stdout(&run(folder, &["robot", "robot.toml"]));
    for part in ["axes       of the base: +x forward, +z up", "at home    on the ground: left_foot", "bodies     "] {
        assert!(text.contains(part), "{part} in {text}");
    }
}

/// Settings of a training that ends within seconds.
const BRIEF: [&str; 7] = [
    "rollout.envs=8",
    "rollout.fragment_steps=64",
    "policy.hidden=[32, 32]",
    "ppo.batch=512",
    "ppo.minibatch=256",
    "ppo.epochs=2",
    "ppo.batch_growth_steps=0",
];

#[test]
fn a_robot_without_a_card_is_understood_and_trained() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("robot.xml"), ROBOT_XML).unwrap();
    let brief = set(&BRIEF);
    let train = |model: &str, run: &str, more: &[&str]| {
        let args =
            ["train", "--task", "velocity", "--model", model, "--steps", "512", "--actors", "1", "--run-dir", run];
        run_with(folder, &[&args, &brief, more, &["--no-progress"]])
    };
    let trained = train("robot.xml", "found", &["--set", "velocity.gait_period_s=0.9"]);
    assert!(trained.status.success(), "{}", stderr(&trained));
    let config: toml::Table = fs::read_to_string(folder.join("found/config.toml")).unwrap().parse().unwrap();
    let report = last_json(&run(folder, &["robot", "robot.xml", "--json"]));
    let length = report["leg_length_m"].as_f64().unwrap() / 0.657;
    let number = |section: &str, key: &str| config[section][key].as_float().unwrap();
    // The swing's height scales with the legs, velocities with their root, and a key that is given stays.
    assert!((number("velocity", "swing_height_m") / (0.08 * length) - 1.0).abs() < 5e-3, "{config}");
    let forward_mps = config["velocity"]["lin_vel_x_mps"][1].as_float().unwrap();
    assert!((forward_mps / length.sqrt() - 1.0).abs() < 5e-3, "{forward_mps}");
    assert_eq!((number("velocity", "gait_period_s"), number("env", "control_step_s")), (0.9, 0.02));
    // The legs have six hinges each, and the rest is held.
    let played = last_json(&run(folder, &["eval", "found", "--episodes", "1", "--json"]));
    assert!(played["velocity_error_mps"].is_number(), "{played}");
    let text = stdout(&run(folder, &["robot", "robot.xml", "--draft", "card.toml"]));
    for part in
        ["legs       ", "at home    on the ground: left_foot, right_foot", "symmetry   each hinge has a mirror image"]
    {
        assert!(text.contains(part), "{part} in {text}");
    }
    let card = fs::read_to_string(folder.join("card.toml")).unwrap();
    assert!(card.starts_with("model = \"robot.xml\"") && card.contains("held = true") && card.contains("# "), "{card}");
    // So does the built-in humanoid, without a file.
    let built_in = ["train", "--task", "velocity", "--steps", "512", "--actors", "1", "--run-dir", "built-in"];
    assert!(run_with(folder, &[&built_in, &brief, &["--no-progress"]]).status.success());
    // The card trains the same robot, the file plays the policy, and the run goes on with either.
    let again = train("card.toml", "by-card", &[]);
    assert!(again.status.success(), "{}", stderr(&again));
    let with_file = run(folder, &["eval", "found", "--episodes", "1", "--json", "--model", "robot.xml"]);
    assert_eq!(last_json(&with_file)["return_mean"], played["return_mean"]);
    let resumed =
        ["train", "--resume", "found", "--model", "robot.xml", "--steps", "1024", "--actors", "1", "--no-progress"];
    assert!(run(folder, &resumed).status.success());
    let twice = run(folder, &["robot", "card.toml", "--draft", "other.toml"]);
    assert_refused(&twice, 2, &["--draft", "`card.toml` has a card already"]);
    let again = run(folder, &["robot", "robot.xml", "--draft", "card.toml"]);
    assert_refused(&again, 2, &["--draft card.toml", "it exists"]);

    // A policy keeps the card that it was trained with, also where the file alone begins another run.
    let edited = card.replacen("action_scale_rad = 0.3", "action_scale_rad = 0.21", 1);
    assert_ne!(edited, card);
    fs::write(folder.join("edited.toml"), edited).unwrap();
    assert!(train("edited.toml", "edited", &[]).status.success());
    let warm = train("robot.xml", "warm", &["--init-from", "edited"]);
    assert!(warm.status.success(), "{}", stderr(&warm));
    assert!(fs::read_to_string(folder.join("warm/model.xml")).unwrap().contains("action_scale_rad = 0.21"));

    // A service has one command line for all of its starts.
    let service = |steps: &str| {
        let args = ["train", "--preset", "velocity", "--model", "robot.xml", "--actors", "1", "--run-dir", "service"];
        run_with(folder, &[&args, &brief, &["--steps", steps, "--resume-or-start", "--no-progress"]])
    };
    for steps in ["512", "1024"] {
        assert!(service(steps).status.success(), "{}", stderr(&service(steps)));
    }

    fs::write(folder.join("blind.xml"), HOPPER).unwrap();
    let refused = train("blind.xml", "never", &[]);
    assert_refused(&refused, 2, &["blind.xml", "`feet` of the card", "robot blind.xml --draft card.toml"]);
    assert!(!folder.join("never").exists());
}

/// Trunk on one leg.
const HOPPER: &str = r#"<mujoco><worldbody><body name="trunk" pos="0 0 1"><freejoint/><geom type="sphere" size="0.1"/>
    <body name="leg"><joint name="hip" axis="0 1 0" range="-30 30"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.9" size="0.05"/></body></body></worldbody>
    <actuator><motor joint="hip" gear="20"/></actuator></mujoco>"#;
