//! The guide to several machines, followed as it is printed, on hosts that are network namespaces.
#![allow(clippy::print_stderr, reason = "a test that was left out must say so")]

use std::{path::Path, process::Command};

use crate::support::*;

/// Every block of shell commands on a page.
fn commands(page: &str) -> String {
    let blocks = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.collect::<Vec<_>>().join("\n")
}

/// Whether this machine lets us make hosts.
fn hosts_can_be_made() -> bool {
    let name = format!("tm{}-try", std::process::id());
    let netns =
        |verb: &str| Command::new("ip").args(["netns", verb, &name]).output().is_ok_and(|out| out.status.success());
    netns("add") && netns("delete")
}

#[test]
fn the_guide_to_several_machines_works_as_printed() {
    if !hosts_can_be_made() {
        eprintln!(
            "SKIPPED: the guide to several machines needs root and `ip netns`, which this machine does not grant"
        );
        return;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = page("operations/several-machines");
    let (folder, _) = folders();
    std::os::unix::fs::symlink(root.join("experiments"), folder.path().join("experiments")).unwrap();
    // Hosts of its own, so that two of these tests may run at once; they are gone also where a command fails.
    let prefix = format!("tm{}", std::process::id());
    let script = commands(&page)
        // Test machines are busier than a reader's.
        .replace("sleep 10", "sleep 20")
        .replace("tm-", &format!("{prefix}-"))
        .replace("hosts.sh up", &format!("hosts.sh up {prefix}"))
        .replace("hosts.sh down", &format!("hosts.sh down {prefix}"));
    let script = format!(
        "trap 'kill $(jobs -p) 2>/dev/null || true; experiments/faults/hosts.sh down {prefix}' EXIT\nset -eu\n{script}"
    );
    let binary = Path::new(env!("CARGO_BIN_EXE_treadmill")).parent().unwrap();
    let path = format!("{}:{}", binary.display(), std::env::var("PATH").unwrap());
    let done =
        Command::new("bash").args(["-c", &script]).env("PATH", path).current_dir(folder.path()).output().unwrap();
    let (said, complained) = (stdout(&done), stderr(&done));
    assert!(done.status.success(), "{said}\n{complained}");
    let alive: Vec<&str> = said.lines().filter(|line| line.contains("actors/alive")).collect();
    assert_eq!(alive.len(), 2, "with endpoints, and with discovery: {said}\n{complained}");
    assert!(alive.iter().all(|line| line.contains("\"value\":2.0")), "{alive:?}");
}
