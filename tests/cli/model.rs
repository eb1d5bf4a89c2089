//! `--model`: robots from files, from the command line through actors to checkpoints.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::support::*;

/// Trunk on one driven leg: observations have 13 entries, actions one.
const HOPPER: &str = r#"
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="trunk" pos="0 0 0.9">
      <freejoint/>
      <geom name="chest" type="box" size="0.1 0.1 0.2"/>
      <body name="leg" pos="0 0 -0.2">
        <joint name="hip" axis="0 1 0" range="-1 1" damping="1" armature="0.1"/>
        <geom name="leg" type="capsule" fromto="0 0 0 0 0 -0.6" size="0.05"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor name="hip" joint="hip" gear="20" ctrlrange="-0.5 1"/></actuator>
</mujoco>"#;

const HEALTHY: [&str; 2] = ["--set", "env.healthy_z_range=[0.5, 1.2]"];

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn train(folder: &Path, run: &Path, model: &str, more: &[&str]) -> std::process::Output {
    let args = ["train", "--preset", "smoke", "--steps", "1024", "--run-dir", run.to_str().unwrap(), "--model", model];
    self::run(folder, &[&args[..], more].concat())
}

#[test]
fn every_command_names_the_file_of_an_unusable_model() {
    let (folder, run) = folders();
    let bent = HOPPER.replace("<geom name=\"chest\"", "<geom name=\"chest\" condim=\"5\"");
    write(folder.path(), "bent.xml", &bent);
    write(folder.path(), "notes.xml", "remember the milk");
    write(folder.path(), "empty.xml", "");
    write(folder.path(), "huge.xml", &" ".repeat((16 << 20) + 1));
    write(folder.path(), "parts.xml", "<mujoco><include file=\"legs.xml\"/></mujoco>");
    let cases: [(&str, &[&str]); 6] = [
        ("missing.xml", &["missing.xml", "cannot be read", "No such file"]),
        ("bent.xml", &["bent.xml", "`chest`", "condim", "1, 3, 4 or 6"]),
        ("notes.xml", &["notes.xml", "not valid MJCF"]),
        ("empty.xml", &["empty.xml", "empty"]),
        ("huge.xml", &["huge.xml", "16777217 bytes", "16777216"]),
        ("parts.xml", &["parts.xml", "legs.xml", "No such file"]),
    ];
    for (file, parts) in cases {
        assert_refused(&train(folder.path(), &run, file, &[]), 2, parts);
        assert_refused(&self::run(folder.path(), &["eval", "--agent", "random", "--model", file]), 2, parts);
    }
    let args = ["learner", "--run-dir", run.to_str().unwrap(), "--model", "bent.xml", "--listen", "tcp/127.0.0.1:0"];
    assert_refused(&self::run(folder.path(), &args), 2, cases[1].1);
    assert_refused(&self::run(folder.path(), &["bench", "env", "--model", "bent.xml"]), 2, cases[1].1);
    assert!(!run.exists(), "no folder is left behind");
}

#[test]
fn a_robot_that_starts_unhealthy_is_refused_with_a_suitable_range() {
    let (folder, run) = folders();
    write(folder.path(), "hopper.xml", HOPPER);
    let parts = ["hopper.xml", "0.9 m", "1 m to 2 m", "env.healthy_z_range=[0.63, 1.26]"];
    assert_refused(&train(folder.path(), &run, "hopper.xml", &[]), 2, &parts);
    assert_refused(&self::run(folder.path(), &["bench", "env", "--model", "hopper.xml"]), 2, &parts);
    assert_usage(folder.path(), &["eval", "--agent", "random", "--set", "ppo.gamma=0.9"], &["ppo.gamma", "[env]"]);
}

#[test]
fn a_robot_trains_is_evaluated_and_keeps_its_model_when_resumed() {
    let (folder, run) = folders();
    let file = write(folder.path(), "hopper.xml", HOPPER);
    let trained = train(folder.path(), &run, "hopper.xml", &HEALTHY);
    assert!(trained.status.success(), "{}", stderr(&trained));
    assert_eq!(fs::read_to_string(run.join("model.xml")).unwrap(), HOPPER);
    // The run holds the model, so the file is no longer needed.
    fs::remove_file(&file).unwrap();
    let run_name = run.to_str().unwrap();
    let eval =
        |more: &[&str]| self::run(folder.path(), &[&["eval", run_name, "--episodes", "2", "--json"], more].concat());
    assert_eq!(last_json(&eval(&[]))["episodes"], 2);
    let resume = |more: &[&str]| {
        let args = ["train", "--resume", run_name, "--steps", "2048", "--no-progress"];
        self::run(folder.path(), &[&args[..], more].concat())
    };
    assert_refused(&resume(&["--model", "hopper.xml"]), 2, &["hopper.xml", "cannot be read"]);
    write(folder.path(), "other.xml", &HOPPER.replace("gear=\"20\"", "gear=\"30\""));
    assert_refused(&resume(&["--model", "other.xml"]), 2, &["other.xml", "keeps its model", "begin a new run"]);
    write(folder.path(), "same.xml", HOPPER);
    let resumed = resume(&["--model", "same.xml"]);
    assert!(resumed.status.success(), "{}", stderr(&resumed));

    // The policy fits a stronger motor, but not a body with other sizes.
    assert_ne!(last_json(&eval(&["--model", "other.xml"]))["return_mean"], last_json(&eval(&[]))["return_mean"]);
    let two = HOPPER.replace("</actuator>", "<motor joint=\"hip\"/></actuator>");
    write(folder.path(), "two.xml", &two);
    assert_refused(&eval(&["--model", "two.xml"]), 2, &["two.xml", "it has 2 motors, the policy's has 1"]);
}

#[test]
fn a_robot_can_be_played_and_timed_without_a_run() {
    let (folder, _) = folders();
    write(folder.path(), "hopper.xml", HOPPER);
    let args = ["eval", "--agent", "random", "--episodes", "2", "--json", "--model", "hopper.xml"];
    let played = self::run(folder.path(), &[&args[..], &HEALTHY].concat());
    assert!(last_json(&played)["length_mean"].as_f64().unwrap() > 1.0);
    let args = ["bench", "env", "--steps", "640", "--json", "--model", "hopper.xml"];
    let timed = last_json(&self::run(folder.path(), &[&args[..], &HEALTHY].concat()));
    assert_eq!((&timed["observation"], &timed["faults"]), (&13.into(), &0.into()));
}

#[test]
fn robot_drafts_a_card_that_trains_and_paints_the_robot() {
    let (folder, run) = folders();
    write(folder.path(), "hopper.xml", HOPPER);
    for flag in ["--png", "--draft"] {
        let refused = self::run(folder.path(), &["robot", "hopper.xml", flag, "absent/file"]);
        assert_refused(&refused, 2, &[flag, "absent/file: it cannot be written", "No such file"]);
    }
    let drafted = done(folder.path(), &["robot", "hopper.xml", "--png", "hopper.png"]);
    let report = stdout(&drafted);
    for part in
        ["# robot", "1 hinges", "level plane", "hip", "model = \"hopper.xml\"", "base = \"trunk\"", "effort_nm = 20.0"]
    {
        assert!(report.contains(part), "`{part}` is missing in:\n{report}");
    }
    assert!(fs::read(folder.path().join("hopper.png")).unwrap().starts_with(b"\x89PNG"));
    write(folder.path(), "card.toml", &report);
    let printed = self::run(folder.path(), &["robot", "card.toml"]);
    assert!(stdout(&printed).lines().all(|line| !line.starts_with('#')), "{}", stdout(&printed));
    let trained = train(folder.path(), &run, "card.toml", &HEALTHY);
    assert!(trained.status.success(), "{}", stderr(&trained));
    assert!(fs::read_to_string(run.join("model.xml")).unwrap().contains("treadmill_robot_card"));

    write(folder.path(), "sliding.xml", &HOPPER.replace("<joint name=\"hip\"", "<joint name=\"hip\" type=\"slide\""));
    // A redirected card names its model from where it is written.
    std::fs::create_dir(folder.path().join("cards")).unwrap();
    for card in ["hopper-card.toml", "cards/hopper.toml"] {
        let file = std::fs::File::create(folder.path().join(card)).unwrap();
        let mut drafting = treadmill(folder.path());
        assert!(drafting.args(["robot", "hopper.xml"]).stdout(file).status().unwrap().success());
        let drafted = std::fs::read_to_string(folder.path().join(card)).unwrap();
        assert_eq!(drafted.contains("model = \"hopper.xml\""), card == "hopper-card.toml", "{drafted}");
        done(folder.path(), &["robot", card]);
    }
    assert_usage(folder.path(), &["robot", "sliding.xml"], &["sliding.xml", "hip", "slide"]);
    write(folder.path(), "wrong.toml", &report.replace("names = \"hip\"", "names = \"knee\""));
    assert_usage(folder.path(), &["robot", "wrong.toml"], &["wrong.toml", "robot card", "knee", "no hinge", "hip"]);
    assert_refused(&train(folder.path(), &folder.path().join("x"), "wrong.toml", &HEALTHY), 2, &["wrong.toml", "knee"]);
    assert_usage(folder.path(), &["robot", "card.toml", "--card", "h1"], &["card `h1`", "card of its own"]);
    let args = ["eval", "--agent", "random", "--model", "hopper.xml", "--set", "env.robot=h2"];
    assert_refused(&self::run(folder.path(), &args), 2, &["env.robot", "`h2`", "g1, g1-29, h1, t1"]);
    assert_usage(folder.path(), &["robot", "hopper.xml", "--card", "h1"], &["`base`", "pelvis", "trunk"]);
    write(folder.path(), "lost.toml", &report.replace("hopper.xml", "gone.xml"));
    assert_usage(folder.path(), &["robot", "lost.toml"], &["gone.xml", "cannot be read"]);
    write(
        folder.path(),
        "meshes.xml",
        &HOPPER
            .replace("<worldbody>", "<asset><mesh name=\"m\" file=\"m.stl\"/></asset><worldbody>")
            .replace("type=\"capsule\" fromto=\"0 0 0 0 0 -0.6\" size=\"0.05\"", "type=\"mesh\" mesh=\"m\""),
    );
    assert_usage(folder.path(), &["robot", "meshes.xml"], &["meshes.xml", "m.stl", "cannot be read"]);
    assert_usage(folder.path(), &["robot", "hoper.xml"], &["hoper.xml"]);
}

/// Chest on one driven leg that ends in a mesh of a package.
const URDF: &str = r#"<robot name="hopper">
  <link name="chest">
    <inertial><mass value="6"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.05"/></inertial>
    <collision><geometry><box size="0.2 0.2 0.4"/></geometry></collision>
  </link>
  <joint name="hip" type="revolute">
    <parent link="chest"/><child link="leg"/><origin xyz="0 0 -0.2"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="20" velocity="9"/><dynamics damping="1"/>
  </joint>
  <link name="leg">
    <inertial><origin xyz="0 0 -0.3"/><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.01"/></inertial>
    <collision><origin xyz="0 0 -0.6"/><geometry><mesh filename="package://legs/foot.obj" scale="0.1 0.1 0.1"/></geometry></collision>
  </link>
</robot>"#;

#[test]
fn a_urdf_trains_and_its_run_needs_no_file() {
    let (folder, run) = folders();
    let at = folder.path();
    write(at, "hopper.urdf", URDF);
    fs::create_dir(at.join("meshes")).unwrap();
    write(
        &at.join("meshes"),
        "foot.obj",
        "v 0 0 -1\nv 1 1 0\nv -1 1 0\nv 0 -1 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 3 4\n",
    );
    let package = ["--package", "legs=meshes"];
    assert_refused(&train(at, &run, "hopper.urdf", &HEALTHY), 2, &["hopper.urdf", "link leg", "--package legs=FOLDER"]);
    assert_refused(&self::run(at, &["robot", "hopper.urdf", "--package", "legs=gone"]), 2, &["`gone` is no folder"]);
    assert_refused(&self::run(at, &["robot", "hopper.urdf", "--package", "legs"]), 2, &["NAME=FOLDER", "as in"]);
    for given in [&package[..], &["--hold-slides"]] {
        let alone = [&["train", "--preset", "smoke"], given].concat();
        assert_refused(&self::run(at, &alone), 2, &[given[0], "has no effect without --model"]);
    }

    let report = last_json(&done(at, &[&["robot", "hopper.urdf", "--json"], &package[..]].concat()));
    assert_eq!((report["root"].as_str(), report["mass_kg"].as_f64()), (Some("chest"), Some(8.0)));
    // The tip of the foot, 0.2 + 0.6 + 0.1 m below the chest, is on the ground.
    assert!((report["height_m"].as_f64().unwrap() - 0.9).abs() < 1e-6, "{report}");
    let trained = train(at, &run, "hopper.urdf", &[&HEALTHY[..], &package].concat());
    assert!(trained.status.success(), "{}", stderr(&trained));

    fs::remove_dir_all(at.join("meshes")).unwrap();
    fs::remove_file(at.join("hopper.urdf")).unwrap();
    let text = fs::read_to_string(run.join("model.xml")).unwrap();
    assert!(text.contains("vertex=") && !text.contains("foot.obj"), "{text}");
    done(at, &["eval", run.to_str().unwrap(), "--episodes", "1"]);
    let path = run.to_str().unwrap();
    for args in [
        &["train", "--steps", "4096", "--resume", path][..],
        &["train", "--steps", "4096", "--fork", path],
        &["eval", path],
    ] {
        let refused = self::run(at, &[args, &["--hold-slides"]].concat());
        assert_refused(&refused, 2, &["--hold-slides has no effect without --model"]);
    }
    done(at, &["train", "--resume", run.to_str().unwrap(), "--steps", "2048"]);
}
