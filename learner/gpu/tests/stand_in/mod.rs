//! Builds the driver of tests, see `cuda.c`.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// Compiles the driver into a folder. Returns the library, which the program finds if `LD_LIBRARY_PATH` names the folder.
pub fn build(folder: &Path) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().map(|above| above.join("learner/gpu"));
    let here = here.into_iter().find(|gpu| gpu.is_dir()).expect("the crate treadmill-gpu");
    let library = folder.join("libcuda.so");
    let mut compiler = Command::new("cc");
    compiler
        .args(["-O2", "-Wno-unknown-pragmas", "-shared", "-fPIC", "-Wl,-soname,libcuda.so", "-I"])
        .arg(here.join("src"));
    compiler.arg(here.join("tests/stand_in/cuda.c")).arg("-o").arg(&library).arg("-lm");
    assert!(compiler.status().expect("a C compiler").success(), "{compiler:?}");
    library
}
