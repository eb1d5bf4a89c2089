//! Recipes of `docs/guide/change.md`: each patch fits the sources, is short, and compiles.

use std::{collections::BTreeSet, fs, path::Path, process::Command};

use treadmill_rl::humanoid::card::RobotCard;

use crate::tidy::{collect, root};

/// Most lines of a recipe.
const LINES_MAX: usize = 25;
/// Files that a recipe changes.
const FILES: usize = 2;

/// Returns the patches of the page.
fn patches() -> Vec<String> {
    let page = fs::read_to_string(root().join("docs/guide/change.md")).unwrap();
    page.split("```diff\n").skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// Applies a patch to the files below `folder`, as `git apply` does, and returns the names of the files. Each hunk must fit
/// one place.
fn apply(patch: &str, folder: &Path) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let (mut name, mut hunks): (&str, Vec<[String; 2]>) = ("", Vec::new());
    let write = |name: &str, hunks: &[[String; 2]]| {
        if hunks.is_empty() {
            return;
        }
        let path = folder.join(name);
        let mut text = fs::read_to_string(&path).unwrap_or_default();
        for [before, after] in hunks {
            let is_new = text.is_empty() && before.is_empty();
            assert!(is_new || text.matches(before.as_str()).count() == 1, "{name} has one place with:\n{before}");
            text = if is_new { after.clone() } else { text.replacen(before.as_str(), after, 1) };
        }
        fs::write(path, text).unwrap();
    };
    for line in patch.lines() {
        if let Some(next) = line.strip_prefix("+++ b/") {
            write(name, &std::mem::take(&mut hunks));
            name = next;
            names.insert(name.to_owned());
        } else if line.starts_with("@@") {
            hunks.push(Default::default());
        } else if let (Some([before, after]), false) = (hunks.last_mut(), line.starts_with("--- ")) {
            let (mark, content) = line.split_at_checked(1).unwrap_or((" ", ""));
            if mark != "+" {
                *before += &format!("{content}\n");
            }
            if mark != "-" {
                *after += &format!("{content}\n");
            }
        }
    }
    write(name, &hunks);
    names
}

#[test]
fn recipes_are_short_and_compile() {
    let copy = tempfile::tempdir().unwrap();
    let mut files = Vec::new();
    collect(root(), &mut files);
    for file in files {
        let target = copy.path().join(file.strip_prefix(root()).unwrap());
        fs::create_dir_all(target.parent().unwrap()).unwrap();
        fs::copy(&file, target).unwrap();
    }
    let patches = patches();
    assert_eq!(patches.len(), 3);
    for patch in &patches {
        assert!(patch.lines().count() <= LINES_MAX, "{patch}");
        assert_eq!(apply(patch, copy.path()).len(), FILES, "{patch}");
    }
    let card = fs::read_to_string(copy.path().join("actor/humanoid/assets/robots/mine.toml")).unwrap();
    RobotCard::parse(&card).unwrap();
    let mut cargo = Command::new(env!("CARGO"));
    // Variables of this test would make build scripts run again, here and in the next build.
    for (name, _) in std::env::vars_os() {
        if name.to_string_lossy().starts_with("CARGO") && name != "CARGO_HOME" {
            cargo.env_remove(name);
        }
    }
    // In the same target folder, so that other people's crates need not be checked again.
    let output = cargo
        .args(["check", "--release", "--offline", "--locked"])
        .current_dir(copy.path())
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
