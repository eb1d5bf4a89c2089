//! The page `several-machines`: its commands run as printed, on network namespaces as hosts.
#![allow(clippy::print_stderr, reason = "reports a skipped test")]

use std::{path::Path, process::Command};

use crate::support::*;

/// Shell function that waits until two actors are in the run.
const AWAIT_ACTORS: &str = r#"
before=0
await_actors() {
    for _ in $(seq 240); do
        if tail -n "+$((before + 1))" runs/walk/metrics.jsonl | grep '"tag":"actors/alive"' | tail -1 |
            grep -q '"value":2.0'; then
            return
        fi
        sleep 0.5
    done
}
"#;

/// Returns the shell commands of a page.
fn commands(page: &str) -> String {
    let blocks = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.collect::<Vec<_>>().join("\n")
}

/// Returns whether this machine allows network namespaces.
fn namespaces_are_allowed() -> bool {
    let name = format!("tm{}-try", std::process::id());
    let netns =
        |verb: &str| Command::new("ip").args(["netns", verb, &name]).output().is_ok_and(|out| out.status.success());
    netns("add") && netns("delete")
}

#[test]
fn the_guide_to_several_machines_works_as_printed() {
    if !namespaces_are_allowed() {
        eprintln!(
            "SKIPPED: the guide to several machines needs root and `ip netns`, which this machine does not grant"
        );
        return;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = page("operations/several-machines");
    let (folder, _) = folders();
    std::os::unix::fs::symlink(root.join("experiments"), folder.path().join("experiments")).unwrap();
    // Names of hosts are unique, so that two of these tests can run at once. The trap removes them if a command fails.
    let prefix = format!("tm{}", std::process::id());
    let script = commands(&page)
        // Both actors are there, by the lines of the learner that runs now.
        .replace("sleep 10", "await_actors")
        .replace("\nwait\n", "\nwait\nbefore=$(wc -l < runs/walk/metrics.jsonl)\n")
        .replace("tm-", &format!("{prefix}-"))
        .replace("hosts.sh up", &format!("hosts.sh up {prefix}"))
        .replace("hosts.sh down", &format!("hosts.sh down {prefix}"));
    let script = format!(
        "{AWAIT_ACTORS}trap 'kill $(jobs -p) 2>/dev/null || true; experiments/faults/hosts.sh down {prefix}' EXIT\nset \
         -eu\n{script}"
    );
    let binary = Path::new(env!("CARGO_BIN_EXE_treadmill")).parent().unwrap();
    let path = format!("{}:{}", binary.display(), std::env::var("PATH").unwrap());
    let done =
        Command::new("bash").args(["-c", &script]).env("PATH", path).current_dir(folder.path()).output().unwrap();
    let (output, errors) = (stdout(&done), stderr(&done));
    assert!(done.status.success(), "{output}\n{errors}");
    let alive: Vec<&str> = output.lines().filter(|line| line.contains("actors/alive")).collect();
    assert_eq!(alive.len(), 2, "with endpoints, and with discovery: {output}\n{errors}");
    assert!(alive.iter().all(|line| line.contains("\"value\":2.0")), "{alive:?}");
}
