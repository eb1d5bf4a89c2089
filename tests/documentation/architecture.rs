//! The architecture's invariants, checked over the sources.

use std::{
    fs,
    path::{Path, PathBuf},
};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every Rust source and manifest of the workspace, with its path from the root. Tests at the root see all parts.
fn sources() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for folder in ["src", "proto", "common", "actor", "learner", "render", "watch", "python"] {
        collect(&root().join(folder), &mut found);
    }
    found
        .into_iter()
        .map(|path| {
            let name = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).unwrap())
        })
        .collect()
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() && path.file_name().is_some_and(|name| name != "target") {
            collect(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Code lines, without comments.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.starts_with("//"))
}

/// Files outside `allowed` whose code contains one of `words`.
fn named_outside(words: &[&str], allowed: &[&str]) -> Vec<String> {
    sources()
        .into_iter()
        .filter(|(name, _)| !allowed.iter().any(|prefix| name.starts_with(prefix)))
        .filter(|(_, text)| code(text).any(|line| words.iter().any(|word| line.contains(word))))
        .map(|(name, _)| name)
        .collect()
}

#[test]
fn wire_serialisers_are_named_only_in_proto() {
    assert_eq!(named_outside(&["prost::", "prost_build", "protox::"], &["proto/"]), [""; 0]);
}

#[test]
fn bincode_is_named_in_one_file() {
    assert_eq!(named_outside(&["bincode::"], &["learner/src/checkpoint/encoding.rs"]), [""; 0]);
}

#[test]
fn only_the_bus_names_zenoh() {
    assert_eq!(named_outside(&["zenoh::"], &["common/src/bus/"]), [""; 0]);
}

#[test]
fn only_the_humanoid_names_rapier() {
    assert_eq!(named_outside(&["rapier3d", "parry3d"], &["actor/humanoid/"]), [""; 0]);
}

#[test]
fn only_the_viewer_depends_on_rerun_and_is_not_built_with_the_rest() {
    assert_eq!(named_outside(&["rerun::"], &["watch/"]), [""; 0]);
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let line = manifest.lines().find(|line| line.starts_with("default-members")).unwrap();
    assert!(!line.contains("\"watch\""), "{line}");
    for folder in ["", "proto", "common", "actor", "actor/humanoid", "learner", "learner/ppo", "render", "fuzz"] {
        let manifest = fs::read_to_string(root().join(folder).join("Cargo.toml")).unwrap();
        let own = manifest.split_once("[package]").unwrap().1;
        assert!(!own.contains("rerun.workspace") && !own.contains("treadmill-watch"), "{folder}");
    }
}

#[test]
fn the_humanoid_knows_nothing_of_bus_runtime_and_tensors() {
    let manifest = fs::read_to_string(root().join("actor/humanoid/Cargo.toml")).unwrap();
    for foreign in ["zenoh", "tokio", "candle", "treadmill-common", "treadmill-proto"] {
        assert!(!manifest.lines().any(|line| line.starts_with(foreign)), "{foreign}");
    }
}

#[test]
fn the_learner_does_not_depend_on_the_actor() {
    for manifest in ["learner/Cargo.toml", "learner/ppo/Cargo.toml", "common/Cargo.toml", "proto/Cargo.toml"] {
        let text = fs::read_to_string(root().join(manifest)).unwrap();
        for foreign in ["treadmill-actor", "treadmill-humanoid", "rapier3d"] {
            assert!(!text.lines().any(|line| line.starts_with(foreign)), "{foreign} in {manifest}");
        }
    }
}

#[test]
fn the_gymnasium_environment_knows_humanoid_and_pictures_alone() {
    let manifest = fs::read_to_string(root().join("python/treadmill_gym/Cargo.toml")).unwrap();
    let dependencies = manifest.split_once("[dependencies]").unwrap().1;
    let ours: Vec<_> = dependencies
        .lines()
        .filter_map(|line| line.split('.').next())
        .filter(|name| name.starts_with("treadmill-"))
        .collect();
    assert_eq!(ours, ["treadmill-humanoid", "treadmill-render"]);
    let workspace = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let default_members = workspace.lines().find(|line| line.starts_with("default-members")).unwrap();
    assert!(!default_members.contains("python/treadmill_gym"), "building the trainer needs no Python");
}

#[test]
fn the_image_has_every_member_of_the_workspace() {
    let workspace = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let members = workspace.lines().find(|line| line.starts_with("members")).unwrap();
    let ignored = fs::read_to_string(root().join(".dockerignore")).unwrap();
    let mut checked = 0;
    for member in members.split('"').skip(1).step_by(2) {
        checked += 1;
        let is_line = |folder: &Path| ignored.lines().any(|line| !line.is_empty() && Path::new(line) == folder);
        let is_left_out = Path::new(member).ancestors().any(is_line);
        let is_kept = |file: &str| ignored.lines().any(|line| line == format!("!{member}/{file}"));
        assert!(!is_left_out || is_kept("Cargo.toml") && is_kept("src/lib.rs"), "{member}");
    }
    assert!(checked > 5, "{checked}");
}

#[test]
fn the_mathematics_does_no_io_and_reads_no_clock() {
    let pure = ["learner/ppo/src/", "actor/humanoid/src/task.rs", "common/src/policy/gaussian.rs"];
    let impure = ["std::fs", "std::io", "std::net", "Instant", "SystemTime", "tokio::", "rand::rng"];
    let mut checked = 0;
    for (name, text) in sources().into_iter().filter(|(name, _)| pure.iter().any(|prefix| name.starts_with(prefix))) {
        checked += 1;
        for word in impure {
            assert!(!code(&text).any(|line| line.contains(word)), "{word} in {name}");
        }
    }
    assert!(checked >= pure.len(), "the files that this test is about are there");
}

#[test]
fn every_path_that_the_architecture_names_exists() {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let mut checked = 0;
    for path in text.split('`').skip(1).step_by(2) {
        let looks_like_a_path =
            path.contains('/') && !path.contains([' ', '*', '{', '<', ':']) && !path.starts_with("treadmill/");
        if looks_like_a_path
            && !path.starts_with("runs/")
            && !path.starts_with("tcp/")
            && !path.starts_with("checkpoints/")
        {
            checked += 1;
            assert!(root().join(path).exists(), "{path}");
        }
    }
    assert!(checked > 20, "{checked}");
}
