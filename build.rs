//! Notes the commit that is built, so that two builds of one version differ in name.

use std::{env, path::Path, process::Command};

fn main() {
    println!("cargo:rerun-if-env-changed=TREADMILL_COMMIT");
    // Each commit and each change of branch appends a line. A file that does not exist would count as changed.
    let log = ".git/logs/HEAD";
    println!("cargo:rerun-if-changed={}", if Path::new(log).exists() { log } else { "build.rs" });
    let commit = env::var("TREADMILL_COMMIT").ok().or_else(|| {
        let output = Command::new("git").args(["rev-parse", "--short=9", "HEAD"]).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_string())
    });
    println!("cargo:rustc-env=TREADMILL_COMMIT={}", commit.unwrap_or_default());
}
