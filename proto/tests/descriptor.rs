//! The schemas as one file that other languages read at run time, without a compiler of their own: kept as it must be.

use std::{fs, path::PathBuf};

fn path(below: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(below)
}

#[test]
fn what_the_python_package_reads_is_what_the_schemas_say() {
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
        "python/treadmill_actor/schema.binpb is not what proto/schema/ says; write it anew with \
         TREADMILL_WRITE_SCHEMA=1 cargo test --release -p treadmill-proto --test descriptor"
    );
}
