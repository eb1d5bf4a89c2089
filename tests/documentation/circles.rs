//! Modules of a crate do not import each other in circles.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

/// Crates that are checked: each folder or file directly below `src` is one module.
const CRATES: [&str; 5] = ["learner", "learner/ppo", "actor/humanoid", "common/bus", "common/experience"];

/// Imports between modules: for each pair of user and used one, the files that import.
type Imports = BTreeMap<(String, String), BTreeSet<String>>;

/// Returns every source below `folder` with its path from there, without tests.
fn sources(folder: &Path) -> Vec<(String, String)> {
    let (mut found, mut folders) = (Vec::new(), vec![folder.to_path_buf()]);
    while let Some(next) = folders.pop() {
        for path in fs::read_dir(&next).expect("a folder").flatten().map(|entry| entry.path()) {
            let name = path.strip_prefix(folder).expect("below it").to_string_lossy().into_owned();
            match path.extension() {
                None if path.is_dir() && !name.ends_with("tests") => folders.push(path),
                Some(kind) if kind == "rs" && !name.ends_with("tests.rs") => {
                    found.push((name, fs::read_to_string(&path).expect("UTF-8")));
                }
                _ => {}
            }
        }
    }
    found
}

/// Returns the code of a source, without comments and without its module of tests.
fn code(text: &str) -> String {
    let product = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    product.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// Returns the modules below `src` that lead to a file: `["session", "keys"]` for `session/keys.rs`.
fn module_path(file: &str) -> Vec<&str> {
    let path = file.trim_end_matches(".rs");
    path.strip_suffix("/mod").unwrap_or(path).split('/').collect()
}

/// Returns the first names of a path, or of each path of a group in braces.
fn first_names(rest: &str) -> Vec<&str> {
    let rest = rest.trim_start();
    let Some(group) = rest.strip_prefix('{') else {
        let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default();
        return if name.is_empty() { Vec::new() } else { vec![name] };
    };
    let (mut names, mut depth, mut start) = (Vec::new(), 0, 0);
    for (at, character) in group.char_indices() {
        let ends = character == '}' && depth == 0;
        if ends || character == ',' && depth == 0 {
            names.extend(first_names(&group[start..at]));
            start = at + 1;
        }
        match character {
            '{' => depth += 1,
            '}' if ends => break,
            '}' => depth -= 1,
            _ => {}
        }
    }
    names
}

/// Returns the names that a source takes from the root of its crate, which is `depth` modules above.
fn names_of_root(code: &str, depth: usize) -> Vec<&str> {
    let above = "super::".repeat(depth);
    let of_crate = code.split("crate::").skip(1);
    let of_super = code.match_indices(&above).filter(|(at, _)| !code[..*at].ends_with("super::"));
    let of_super = of_super.map(|(at, _)| &code[at + above.len()..]).filter(|rest| !rest.starts_with("super::"));
    of_crate.chain(of_super).flat_map(first_names).collect()
}

/// Returns the module of each name that the root exports from one.
fn exports(root: &str) -> BTreeMap<&str, &str> {
    let uses = root.split("use ").skip(1).filter_map(|rest| rest.split_once(';')?.0.split_once("::"));
    uses.flat_map(|(module, tree)| {
        tree.split(|c: char| !c.is_alphanumeric() && c != '_').map(move |name| (name, module))
    })
    .collect()
}

/// Returns the imports between the modules of a crate.
fn imports(sources: &[(String, String)]) -> Imports {
    let sources: Vec<(&str, String)> = sources.iter().map(|(file, text)| (file.as_str(), code(text))).collect();
    let modules: BTreeSet<&str> = sources.iter().map(|(file, _)| module_path(file)[0]).collect();
    let root = sources.iter().find(|(file, _)| *file == "lib.rs").map_or("", |(_, text)| text);
    let exports = exports(root);
    let mut found = Imports::new();
    for (file, text) in sources.iter().filter(|(file, _)| *file != "lib.rs") {
        let path = module_path(file);
        for name in names_of_root(text, path.len()) {
            let used = modules.get(name).or_else(|| exports.get(name));
            if let Some(used) = used.filter(|used| **used != path[0] && modules.contains(*used)) {
                found.entry((path[0].to_string(), (*used).to_string())).or_default().insert((*file).to_string());
            }
        }
    }
    found
}

/// Returns the modules that a module uses, directly or by others.
fn used_by<'a>(imports: &'a Imports, module: &'a str) -> BTreeSet<&'a str> {
    let (mut found, mut pending) = (BTreeSet::new(), vec![module]);
    while let Some(next) = pending.pop() {
        let used = imports.keys().filter(|(user, _)| user == next).map(|(_, used)| used.as_str());
        pending.extend(used.filter(|used| found.insert(*used)));
    }
    found
}

/// Returns every set of modules that use each other, each in the order of their names.
fn circles(imports: &Imports) -> BTreeSet<Vec<&str>> {
    let users: BTreeSet<&str> = imports.keys().map(|(user, _)| user.as_str()).collect();
    let all: BTreeMap<&str, BTreeSet<&str>> = users.iter().map(|user| (*user, used_by(imports, user))).collect();
    let circle = |user: &&str| -> Vec<&str> {
        users.iter().copied().filter(|other| all[user].contains(other) && all[other].contains(user)).collect()
    };
    users.iter().map(circle).filter(|circle| !circle.is_empty()).collect()
}

#[test]
fn modules_do_not_import_each_other_in_circles() {
    let mut offences = Vec::new();
    for folder in CRATES {
        let sources = sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join("src"));
        assert!(sources.len() > 3, "{folder}");
        let imports = imports(&sources);
        for circle in circles(&imports) {
            offences.push(format!("{folder}: {}", circle.join(", ")));
            let is_part = |(user, used): &(String, String)| circle.contains(&&**user) && circle.contains(&&**used);
            let parts = imports.iter().filter(|(pair, _)| is_part(pair));
            offences.extend(parts.map(|((user, used), files)| format!("    {user} uses {used} in {files:?}")));
        }
    }
    assert!(offences.is_empty(), "modules use each other in circles:\n{}", offences.join("\n"));
}

#[test]
fn circles_are_found_through_groups_exports_and_parents() {
    let sources = [
        ("lib.rs", "mod a;\nmod b;\npub mod c;\nmod d;\npub use c::{Thing, deep::Deeper};"),
        ("a.rs", "use crate::{\n    b::{self, One},\n    Deeper,\n};"),
        ("b/mod.rs", "use super::c;\n#[cfg(test)]\nmod tests {\n    use crate::d;\n}"),
        ("b/inner.rs", "use super::One;\n// use crate::d;"),
        ("c/deep.rs", "use super::super::a;"),
        ("d.rs", "fn f() -> crate::Thing {}"),
    ]
    .map(|(file, text)| (file.to_string(), text.to_string()));
    let imports = imports(&sources);
    let pairs: Vec<(&str, &str)> = imports.keys().map(|(user, used)| (user.as_str(), used.as_str())).collect();
    assert_eq!(pairs, [("a", "b"), ("a", "c"), ("b", "c"), ("c", "a"), ("d", "c")]);
    assert_eq!(circles(&imports), BTreeSet::from([vec!["a", "b", "c"]]));
}
