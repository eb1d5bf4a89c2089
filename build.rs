//! Notes the commit that is built, so that two builds of one version differ in name.

use std::{env, process::Command};

fn main() {
    println!("cargo:rerun-if-env-changed=TREADMILL_COMMIT");
    // Each commit and each change of branch appends a line.
    println!("cargo:rerun-if-changed=.git/logs/HEAD");
    let commit = env::var("TREADMILL_COMMIT").ok().or_else(|| {
        let output = Command::new("git").args(["rev-parse", "--short=9", "HEAD"]).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_string())
    });
    println!("cargo:rustc-env=TREADMILL_COMMIT={}", commit.unwrap_or_default());
}
