//! Statements of ARCHITECTURE.md, checked against manifests and sources.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// Third-party crates, and the only folders whose packages may depend on them; "(dev)" marks dev-dependencies. The tests of
/// hostile clients need Zenoh itself.
const DEPENDENTS: [(&str, &[&str]); 19] = [
    ("axum", &["."]),
    ("bincode", &["learner"]),
    ("candle-core", &["common/policy", "learner/ppo"]),
    ("candle-nn", &["common/policy", "learner/ppo"]),
    ("cudarc", &["learner/gpu"]),
    ("gemm", &["common/policy"]),
    ("libfuzzer-sys", &["fuzz"]),
    ("numpy", &["python/treadmill_gym"]),
    ("object_store", &["common/store"]),
    ("prometheus-client", &["learner"]),
    ("prost", &["proto"]),
    ("prost-build", &["proto"]),
    ("protox", &["proto"]),
    ("pulp", &["actor/humanoid"]),
    ("pyo3", &["python/treadmill_gym"]),
    ("rapier3d", &["actor/humanoid"]),
    ("ratatui", &["."]),
    ("toml", &[".", "actor/humanoid", "common/config", "common/settings", "python/treadmill_gym"]),
    ("zenoh", &[". (dev)", "common/bus"]),
];
/// Packages of the workspace on which no other depends, and those on which few do.
const OWN_DEPENDENTS: [(&str, &[&str]); 5] = [
    ("treadmill-bench", &[]),
    ("treadmill-store", &[".", "learner"]),
    ("treadmill-fuzz", &[]),
    ("treadmill-gym", &[]),
    ("treadmill-rl", &["bench"]),
];
/// This file names what it searches for.
const THIS_FILE: &str = "tests/documentation/architecture.rs";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
}

/// Package of the workspace.
struct Package {
    folder: String,
    name: String,
    /// Names in `dependencies` and `build-dependencies`.
    dependencies: BTreeSet<String>,
    dev_dependencies: BTreeSet<String>,
}

impl Package {
    fn read(folder: &str) -> Self {
        let manifest: toml::Table = read(&format!("{folder}/Cargo.toml")).parse().unwrap();
        let names = |section: &str| -> BTreeSet<String> {
            let section = manifest.get(section).and_then(toml::Value::as_table);
            section.into_iter().flat_map(|table| table.keys().cloned()).collect()
        };
        let (mut dependencies, dev_dependencies) = (names("dependencies"), names("dev-dependencies"));
        dependencies.append(&mut names("build-dependencies"));
        let name = manifest["package"]["name"].as_str().unwrap().to_string();
        Self { folder: folder.to_string(), name, dependencies, dev_dependencies }
    }
}

/// Folders of the workspace's list `key`, which is `members` or `default-members`.
fn members(key: &str) -> Vec<String> {
    let workspace: toml::Table = read("Cargo.toml").parse().unwrap();
    let members = workspace["workspace"][key].as_array().unwrap().iter();
    members.map(|member| member.as_str().unwrap().to_string()).collect()
}

/// All packages by name.
fn packages() -> BTreeMap<String, Package> {
    let folders = members("members").into_iter().chain([".".to_string()]);
    folders.map(|folder| Package::read(&folder)).map(|package| (package.name.clone(), package)).collect()
}

/// Folders of the packages that depend on `name`.
fn dependents(packages: &BTreeMap<String, Package>, name: &str) -> BTreeSet<String> {
    let found = packages.values().filter_map(|Package { folder, dependencies, dev_dependencies, .. }| {
        match (dependencies.contains(name), dev_dependencies.contains(name)) {
            (true, _) => Some(folder.clone()),
            (false, true) => Some(format!("{folder} (dev)")),
            (false, false) => None,
        }
    });
    found.collect()
}

/// Every crate that `package` depends on: its own dependencies of all kinds, and those of the workspace's packages
/// among them.
fn all_dependencies(packages: &BTreeMap<String, Package>, package: &str) -> BTreeSet<String> {
    let mut pending: Vec<&String> =
        packages[package].dependencies.iter().chain(&packages[package].dev_dependencies).collect();
    let mut found = BTreeSet::new();
    while let Some(name) = pending.pop() {
        if found.insert(name.clone()) {
            pending.extend(packages.get(name).into_iter().flat_map(|package| &package.dependencies));
        }
    }
    found
}

/// Every Rust source but this one, with its path from the root.
fn sources() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for folder in
        ["src", "proto", "common", "actor", "learner", "render", "bench", "python", "fuzz", "tests", "examples"]
    {
        collect(&root().join(folder), &mut found);
    }
    let named = found.into_iter().map(|path| {
        let name = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
        (name, fs::read_to_string(&path).unwrap())
    });
    named.filter(|(name, _)| name != THIS_FILE).collect()
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

/// Lines without those of comments.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.starts_with("//"))
}

/// Asserts that only sources with a prefix of `allowed` name one of `words`, and that each prefix is needed.
#[track_caller]
fn assert_named_only_in(words: &[&str], allowed: &[&str]) {
    let naming: Vec<String> = sources()
        .into_iter()
        .filter(|(_, text)| code(text).any(|line| words.iter().any(|word| line.contains(word))))
        .map(|(name, _)| name)
        .collect();
    let others: Vec<&String> =
        naming.iter().filter(|name| !allowed.iter().any(|prefix| name.starts_with(prefix))).collect();
    assert!(others.is_empty(), "{words:?} in {others:?}");
    for prefix in allowed {
        assert!(naming.iter().any(|name| name.starts_with(prefix)), "{words:?} is not in {prefix}");
    }
}

#[test]
fn only_the_listed_packages_depend_on_a_crate() {
    let packages = packages();
    for (name, folders) in DEPENDENTS.iter().chain(&OWN_DEPENDENTS) {
        let folders: BTreeSet<String> = folders.iter().map(|folder| (*folder).to_string()).collect();
        assert_eq!(dependents(&packages, name), folders, "dependents of {name}");
    }
}

#[test]
fn crates_are_named_only_in_their_folder() {
    assert_named_only_in(&["prost::", "prost_build", "protox::"], &["proto/"]);
    assert_named_only_in(&["bincode::"], &["learner/src/checkpoint/encoding.rs"]);
    assert_named_only_in(&["zenoh::"], &["common/bus/", "tests/hostile/"]);
    assert_named_only_in(&["rapier3d::", "parry3d::"], &["actor/humanoid/src/collision"]);
    assert_named_only_in(&["pulp::"], &["actor/humanoid/src/lanes"]);
    assert_named_only_in(&["axum::"], &["src/page/"]);
    assert_named_only_in(&["object_store::"], &["common/store/"]);
    assert_named_only_in(&["cudarc::"], &["learner/gpu/"]);
}

#[test]
fn ppo_does_not_depend_on_zenoh_and_does_not_name_tokio() {
    let packages = packages();
    let all = all_dependencies(&packages, "treadmill-ppo");
    assert!(all.contains("treadmill-policy") && all.contains("candle-core"), "{all:?}");
    assert!(!all.contains("zenoh"), "{all:?}");
    assert!(all_dependencies(&packages, "treadmill-learner").contains("zenoh"), "indirect dependencies are found");
    assert!(!packages["treadmill-ppo"].dependencies.contains("tokio"));
}

#[test]
fn settings_of_ppo_are_named_only_there_and_where_they_are_checked() {
    // An actor's first horizon depends on the batch.
    assert_named_only_in(
        &["config.ppo."],
        &[
            "actor/src/settings.rs",
            "common/config/",
            "learner/src/intake/horizon_tests.rs",
            "learner/src/metrics/tensorboard/texts.rs",
            "learner/tests/",
            "tests/",
        ],
    );
}

#[test]
fn the_humanoid_depends_only_on_the_settings_and_not_on_zenoh_tokio_or_candle() {
    let packages = packages();
    for name in all_dependencies(&packages, "treadmill-humanoid") {
        let is_foreign = ["zenoh", "tokio", "candle"].iter().any(|foreign| name.starts_with(foreign));
        assert!(!is_foreign && (name == "treadmill-settings" || !packages.contains_key(&name)), "{name}");
    }
}

#[test]
fn learner_and_actor_do_not_depend_on_each_other() {
    let packages = packages();
    let [learning, acting] = [["treadmill-learner", "treadmill-ppo"], ["treadmill-actor", "treadmill-humanoid"]];
    for (packages_of_one, others) in [(learning, acting), (acting, learning)] {
        for package in packages_of_one {
            let all = all_dependencies(&packages, package);
            assert!(!others.iter().any(|other| all.contains(*other)), "{package} depends on {all:?}");
        }
    }
}

#[test]
fn the_gymnasium_environment_depends_only_on_humanoid_render_and_settings() {
    let packages = packages();
    let ours = packages["treadmill-gym"].dependencies.iter().filter(|name| packages.contains_key(*name));
    assert_eq!(ours.collect::<Vec<_>>(), ["treadmill-humanoid", "treadmill-render", "treadmill-settings"]);
}

#[test]
fn bench_fuzz_targets_and_python_package_are_not_default_members() {
    let mut expected = members("members");
    expected.retain(|member| !["bench", "fuzz", "python/treadmill_gym"].contains(&&**member));
    let mut found = members("default-members");
    found.retain(|member| member != ".");
    assert_eq!(found, expected);
}

#[test]
fn the_image_has_every_member_of_the_workspace() {
    let ignored = read(".dockerignore");
    let members = members("members");
    assert!(members.len() > 5, "{members:?}");
    for member in members {
        let is_line = |folder: &Path| ignored.lines().any(|line| !line.is_empty() && Path::new(line) == folder);
        let is_ignored = Path::new(&member).ancestors().any(is_line);
        let is_kept = |file: &str| ignored.lines().any(|line| line == format!("!{member}/{file}"));
        assert!(!is_ignored || is_kept("Cargo.toml") && is_kept("src/lib.rs"), "{member}");
    }
}

#[test]
fn the_mathematics_does_no_io_and_reads_no_clock() {
    let impure = ["std::fs", "std::io", "std::net", "Instant", "SystemTime", "tokio::", "rand::rng"];
    let sources = sources();
    for prefix in
        ["learner/ppo/src/", "actor/humanoid/src/task/", "common/policy/src/gaussian.rs", "common/experience/src/"]
    {
        let mut pure = sources.iter().filter(|(name, _)| name.starts_with(prefix)).peekable();
        assert!(pure.peek().is_some(), "{prefix} does not exist");
        for (name, text) in pure {
            for word in impure {
                assert!(!code(text).any(|line| line.contains(word)), "{word} in {name}");
            }
        }
    }
}

/// Name of a thread without the number of a pool's thread: `update-` for `update-0` and for `update-{index}`.
fn without_number(name: &str) -> String {
    let name = name.split('{').next().unwrap();
    name.trim_end_matches(|c: char| c.is_ascii_digit()).to_string()
}

#[test]
fn the_table_of_threads_has_every_thread_that_is_started() {
    let text = read("ARCHITECTURE.md");
    let section = text.split("\n## ").find(|section| section.starts_with("Threads\n")).expect("the section");
    let rows = section.lines().filter(|line| line.starts_with("| ")).skip(1);
    let cells = rows.map(|row| row.split('|').nth(2).expect("the column of threads"));
    let documented: BTreeSet<String> = cells
        .flat_map(|cell| cell.split('`').skip(1).step_by(2))
        .filter(|name| *name != "main")
        .map(without_number)
        .collect();

    let mut started = BTreeSet::new();
    for (_, text) in sources().iter().filter(|(name, _)| !name.contains("tests/") && !name.contains("examples/")) {
        let begins = [
            ".name(\"",
            ".name(format!(\"",
            "thread_name(|index| format!(\"",
            "THREAD: &str = \"",
            "start_thread(\"",
            "start_thread(&format!(\"",
        ];
        for begin in begins {
            started.extend(text.split(begin).skip(1).map(|rest| without_number(rest.split('"').next().unwrap())));
        }
    }
    assert!(started.len() > 10, "{started:?}");
    assert_eq!(documented, started, "threads in ARCHITECTURE.md and in the sources");
}

#[test]
fn every_path_in_the_architecture_exists_and_the_code_map_has_every_member() {
    let text = read("ARCHITECTURE.md");
    let mut checked = 0;
    for path in text.split('`').skip(1).step_by(2) {
        let is_other =
            ["treadmill/", "runs/", "tcp/", "tls/", "checkpoints/"].iter().any(|begin| path.starts_with(begin));
        if path.contains('/') && !path.contains([' ', '*', '{', '<', ':']) && !is_other {
            checked += 1;
            assert!(root().join(path).exists(), "{path}");
        }
    }
    assert!(checked > 20, "{checked}");
    for member in members("members") {
        assert!(text.contains(&format!("| `{member}/")), "{member} is missing in the code map");
    }
}
