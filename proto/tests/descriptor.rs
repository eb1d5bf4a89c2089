//! The descriptor file, which the Python package reads at run time, matches the schemas.

use std::{fs, path::PathBuf};

fn path(below: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(below)
}

#[test]
fn the_descriptor_file_matches_the_schemas() {
    let mut names: Vec<String> = fs::read_dir(path("proto/schema"))
        .unwrap()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let mut compiler = protox::Compiler::new([path("proto/schema")]).unwrap();
    compiler.include_imports(true).include_source_info(false);
    compiler.open_files(&names).unwrap();
    let wanted = compiler.encode_file_descriptor_set();
    let file = path("python/treadmill_actor/schema.binpb");
    if std::env::var_os("TREADMILL_WRITE_SCHEMA").is_some() {
        fs::write(&file, &wanted).unwrap();
    }
    let found = fs::read(&file).unwrap_or_default();
    assert!(
        found == wanted,
        "python/treadmill_actor/schema.binpb does not match proto/schema/; regenerate it with \
         TREADMILL_WRITE_SCHEMA=1 cargo test --release -p treadmill-proto --test descriptor"
    );
}
