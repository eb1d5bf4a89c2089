//! Limits on the length of pages and files, on words, and on names that two types share.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

/// Most words of a page.
const PAGE_WORDS_MAX: [(&str, usize); 3] = [("README.md", 1200), ("ARCHITECTURE.md", 2080), ("CHANGELOG.md", 730)];
/// Most words of all pages together, generated ones included.
const ALL_WORDS_MAX: usize = 41_350;
/// Most columns of a table.
const COLUMNS_MAX: usize = 7;
/// Most lines of Rust: in all, and of the product without tests.
const RUST_LINES_MAX: [usize; 2] = [113_100, 77_500];
/// Folders of the product.
const PRODUCT: [&str; 5] = ["src/", "actor/", "common/", "learner/", "proto/"];
/// Most files.
const FILES_MAX: usize = 1_160;
/// Most characters of a line of a comment.
const LINE_CHARS_MAX: usize = 125;
/// Words and phrases in place of a concrete subject or verb.
const FORBIDDEN: [&str; 11] = [
    "whoever",
    "somebody",
    "nobody",
    "heed",
    "heeds",
    "heeded",
    "tell",
    "tells",
    "told",
    "of which nothing",
    "what is not",
];
/// Extensions of files that are searched for forbidden words.
const READ: [&str; 8] = ["rs", "md", "py", "sh", "proto", "ts", "yml", "yaml"];
/// Most lines of a Rust file.
const FILE_LINES_MAX: usize = 400;
/// Rust files that may be longer, with the reason.
const LONG_FILES: [(&str, &str); 0] = [];
/// Generated sources.
const GENERATED_SOURCES: &str = "proto/src/generated/";
/// This file names what it forbids.
const THIS_FILE: &str = "tests/documentation/tidy.rs";

/// Returns the repository's root.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns path and text of every file with one of these extensions, sorted by path.
pub fn files(kinds: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    collect(root(), &mut found);
    let named = found.into_iter().filter_map(|path| {
        let is_of_kind = path.extension().is_some_and(|kind| kinds.iter().any(|wanted| kind == *wanted));
        let name = path.strip_prefix(root()).expect("below the root").to_string_lossy().into_owned();
        is_of_kind.then(|| (name, fs::read_to_string(&path).expect("UTF-8")))
    });
    let mut named: Vec<_> = named.collect();
    named.sort();
    named
}

/// Collects the files of this repository, without those of builds, runs and virtual environments.
pub(crate) fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    let is_foreign = |path: &Path| {
        let name = path.file_name().expect("a name").to_string_lossy();
        let is_cache = path.join("CACHEDIR.TAG").exists() || path.join("pyvenv.cfg").exists();
        let is_output = folder == root() && name == "runs"
            || ["target", "build", "corpus", "artifacts", "node_modules", "generated"].contains(&&*name);
        is_cache || name.starts_with('.') || is_output
    };
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let kind = entry.file_type().expect("a file type");
        if kind.is_file() {
            found.push(path);
        } else if kind.is_dir() && !is_foreign(&path) {
            collect(&path, found);
        }
    }
}

/// Asserts that no file offends against a rule.
#[track_caller]
pub fn assert_none(offences: &[String], rule: &str) {
    assert!(offences.is_empty(), "{rule}; {} offences:\n{}", offences.len(), offences.join("\n"));
}

#[test]
fn pages_are_short() {
    let pages = files(&["md"]);
    let counts: Vec<(&str, usize)> =
        pages.iter().map(|(name, text)| (name.as_str(), text.split_whitespace().count())).collect();
    assert!(counts.len() > 10, "{counts:?}");
    let mut offences = Vec::new();
    for (page, most) in PAGE_WORDS_MAX {
        let (_, words) = counts.iter().find(|(name, _)| *name == page).expect("the page is there");
        if *words > most {
            offences.push(format!("{page}: {words} words, at most {most}"));
        }
    }
    let all: usize = counts.iter().map(|(_, words)| words).sum();
    if all > ALL_WORDS_MAX {
        offences.push(format!("all pages: {all} words, at most {ALL_WORDS_MAX}"));
        offences.extend(counts.iter().map(|(name, words)| format!("    {name}: {words}")));
    }
    assert_none(&offences, "pages are short");
}

/// Returns the number of columns of a line of a table; a bar behind a backslash is text.
fn columns(line: &str) -> usize {
    match line.trim().strip_prefix('|') {
        Some(row) => row.replace("\\|", "").matches('|').count(),
        None => 0,
    }
}

#[test]
fn tables_are_narrow() {
    let mut offences = Vec::new();
    for (name, text) in files(&["md"]) {
        let wide = text.lines().enumerate().filter(|(_, line)| columns(line) > COLUMNS_MAX);
        offences.extend(wide.map(|(index, line)| format!("{name}:{}: {} columns", index + 1, columns(line))));
    }
    assert_none(&offences, "tables have at most seven columns");
    assert_eq!(columns("| a | `b \\| c` |"), 2);
}

#[test]
fn the_tree_is_small() {
    let is_test = |name: &str| name.contains("tests/") || name.ends_with("tests.rs") || name.contains("examples/");
    let (mut all, mut product) = (0, 0);
    for (name, text) in files(&["rs"]) {
        let lines = text.lines().count();
        all += lines;
        product += if PRODUCT.iter().any(|folder| name.starts_with(folder)) && !is_test(&name) { lines } else { 0 };
    }
    let mut found = Vec::new();
    collect(root(), &mut found);
    let mut offences = Vec::new();
    for (what, count, most) in [
        ("lines of Rust", all, RUST_LINES_MAX[0]),
        ("lines of Rust in the product", product, RUST_LINES_MAX[1]),
        ("files", found.len(), FILES_MAX),
    ] {
        if count > most {
            offences.push(format!("{count} {what}, at most {most}"));
        }
    }
    assert_none(&offences, "the tree is small");
}

#[test]
fn comments_are_narrow() {
    let mut offences = Vec::new();
    for (name, text) in &files(&["rs"]) {
        let is_prose = |line: &str| line.trim().starts_with("//") && !line.contains("! |");
        let long = text.lines().enumerate().filter(|(_, line)| is_prose(line) && line.chars().count() > LINE_CHARS_MAX);
        offences.extend(long.map(|(index, line)| format!("{name}:{}: {}", index + 1, line.chars().count())));
    }
    assert_none(&offences, "comments are narrow");
}

/// Splits a text into lower-case words and single marks, each with its line. Drops the marks that begin a comment.
fn tokens(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim_start().trim_start_matches(['/', '!', '#']).to_lowercase();
        let mut word = String::new();
        for character in line.chars().chain([' ']) {
            if character.is_alphanumeric() || character == '_' {
                word.push(character);
                continue;
            }
            if !word.is_empty() {
                found.push((index + 1, std::mem::take(&mut word)));
            }
            if !character.is_whitespace() {
                found.push((index + 1, character.to_string()));
            }
        }
    }
    found
}

/// Returns forbidden phrases with the lines where they begin. A phrase may continue on the next line.
fn forbidden(text: &str) -> Vec<(usize, &'static str)> {
    let tokens = tokens(text);
    let phrases = FORBIDDEN.map(|phrase| (phrase, phrase.split(' ').collect::<Vec<_>>()));
    let mut found = Vec::new();
    for start in 0..tokens.len() {
        // A library may name a method so.
        let next = tokens.get(start + 1).map(|(_, token)| token.as_str());
        if start > 0 && tokens[start - 1].1 == "." && next == Some("(") {
            continue;
        }
        for (phrase, words) in &phrases {
            let here = tokens[start..].iter().map(|(_, word)| word.as_str());
            if tokens.len() - start >= words.len() && here.zip(words).all(|(word, wanted)| word == *wanted) {
                found.push((tokens[start].0, *phrase));
            }
        }
    }
    found
}

#[test]
fn forbidden_words_are_not_used() {
    let texts = files(&READ);
    assert!(texts.len() > 200, "{}", texts.len());
    let mut offences = Vec::new();
    for (name, text) in texts.iter().filter(|(name, _)| name != THIS_FILE) {
        offences.extend(forbidden(text).iter().map(|(line, phrase)| format!("{name}:{line}: {phrase}")));
    }
    assert_none(&offences, "name the subject or use the standard term instead");
}

#[test]
fn phrases_are_found_across_lines_and_only_whole() {
    let text = "/// Refuses what is\n    /// not sound. What is. Not\nNobody heeds_it.";
    assert_eq!(forbidden(text), [(1, "what is not"), (3, "nobody")]);
}

/// Returns the names of a source's public types, with their lines.
fn public_types(text: &str) -> Vec<(usize, &str)> {
    let named = text.lines().enumerate().filter_map(|(index, line)| {
        let line = line.trim_start();
        let rest = line.strip_prefix("pub")?;
        let rest = if rest.starts_with('(') { rest.split_once(')')?.1 } else { rest };
        let (kind, rest) = rest.strip_prefix(' ')?.split_once(' ')?;
        let rest = if kind == "unsafe" { rest.strip_prefix("trait ")? } else { rest };
        let is_type = ["struct", "enum", "trait", "type", "union", "unsafe"].contains(&kind);
        let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()?;
        (is_type && !name.is_empty()).then_some((index + 1, name))
    });
    named.collect()
}

#[test]
fn no_two_public_types_share_a_name() {
    let is_product = |name: &str| {
        let in_tests = name.contains("tests/") || name.ends_with("tests.rs") || name.contains("examples/");
        !in_tests && !name.starts_with(GENERATED_SOURCES)
    };
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (file, text) in files(&["rs"]).iter().filter(|(name, _)| is_product(name)) {
        for (line, name) in public_types(text) {
            places.entry(name.to_string()).or_default().push(format!("{file}:{line}"));
        }
    }
    assert!(places.len() > 200, "{}", places.len());
    let shared = places.iter().filter(|(_, places)| places.len() > 1);
    let offences: Vec<String> = shared.map(|(name, places)| format!("{name}: {}", places.join(", "))).collect();
    assert_none(&offences, "one name, one public type");
}

#[test]
fn public_types_are_found_by_their_declarations() {
    let text =
        "pub struct A<T>(T);\n    pub(crate) enum B {\npub fn c() {}\npub type D = u8;\nstruct E;\npub struct $name;";
    assert_eq!(public_types(text), [(1, "A"), (2, "B"), (4, "D")]);
}

#[test]
fn files_are_short() {
    let mut offences = Vec::new();
    for (name, text) in files(&["rs"]).iter().filter(|(name, _)| !name.starts_with(GENERATED_SOURCES)) {
        let lines = text.lines().count();
        if lines > FILE_LINES_MAX && !LONG_FILES.iter().any(|(long, _)| long == name) {
            offences.push(format!("{name}: {lines} lines, at most {FILE_LINES_MAX}"));
        }
    }
    for (name, reason) in LONG_FILES {
        let text = fs::read_to_string(root().join(name)).unwrap_or_default();
        if text.lines().count() <= FILE_LINES_MAX {
            offences.push(format!("{name}: short enough without being listed ({reason})"));
        }
    }
    assert_none(&offences, "files are short");
}
