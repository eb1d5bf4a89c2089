//! The tutorial and the guides to sweeps and motions: their commands run as printed, with shorter trainings. Parts in
//! Python, on several hosts and in the browser have tests of their own.

use std::{fs, path::Path, process::Command};

use crate::support::*;

/// Returns the `treadmill` commands of a page that need only this program.
fn commands(page: &str) -> Vec<String> {
    let blocks = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let alone = blocks.filter(|block| !block.contains("ip netns"));
    let lines = alone.flat_map(str::lines).filter(|line| line.starts_with("treadmill "));
    lines.filter(|line| !line.contains("treadmill watch")).map(str::to_string).collect()
}

#[test]
fn the_first_commands_of_the_guide_to_motions_work_as_printed() {
    let Some(python) = python_with("math") else { return };
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (folder, _) = folders();
    std::os::unix::fs::symlink(root.join("python"), folder.path().join("python")).unwrap();
    let page = page("guide/motion");
    let first = page.split("```sh\n").nth(1).unwrap().split("```").next().unwrap();
    let programs = Path::new(env!("CARGO_BIN_EXE_treadmill")).parent().unwrap().display();
    let script =
        first.replace("--steps 4000000", "--steps 10000").replace("python3", &python.get_program().to_string_lossy());
    let path = format!("{programs}:{}", std::env::var("PATH").unwrap());
    let done = Command::new("sh").args(["-ec", &script]).env("PATH", path).current_dir(folder.path()).output().unwrap();
    assert!(done.status.success(), "{}\n{}", stdout(&done), stderr(&done));
    assert!(stdout(&done).contains("of the motion in the mean"), "{}", stdout(&done));
    for made in ["wave.gif", "imitated.gif", "runs/wave/learning_curve.png"] {
        assert!(folder.path().join(made).metadata().is_ok_and(|file| file.len() > 1000), "{made}");
    }
}

#[test]
fn the_tutorial_works_as_printed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let commands = commands(&page("guide/tutorial"));
    assert!(commands.len() >= 8, "{commands:?}");
    let (folder, _) = folders();
    std::os::unix::fs::symlink(root.join("docs"), folder.path().join("docs")).unwrap();
    for command in commands {
        // Batches may be larger on a busy machine.
        let shorter = command.replace("--steps 1000000", "--steps 10000").replace("--steps 4000000", "--steps 60000");
        let args: Vec<&str> = shorter.split_whitespace().skip(1).collect();
        let output = run(folder.path(), &args);
        // `check` may find problems of the test machine.
        let is_expected = output.status.success() || args == ["check"];
        assert!(is_expected && !stdout(&output).is_empty(), "{command}\n{}\n{}", stdout(&output), stderr(&output));
    }
    for made in ["runs/first/learning_curve.png", "walk.gif", "policy.onnx"] {
        assert!(folder.path().join(made).metadata().is_ok_and(|file| file.len() > 1000), "{made}");
    }
}

#[test]
fn sweeps_work_as_printed() {
    let page = page("guide/sweep");
    let (folder, _) = folders();
    for block in page.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()) {
        let name = block.lines().next().unwrap().strip_prefix("# ").unwrap();
        let smaller =
            block.replace("interval_steps = 500000", "interval_steps = 1000").replace("trials = 30", "trials = 3");
        fs::write(folder.path().join(name), smaller).unwrap();
    }
    let commands = commands(&page);
    assert!(commands.len() >= 9, "{commands:?}");
    let [router] = free_endpoints("tcp");
    let mut others = Vec::new();
    let has_optuna = python_with("optuna").is_some();
    for command in commands.into_iter().filter(|command| has_optuna || !command.contains("optuna")) {
        let smaller = command
            .replace(" --preset walk", "")
            .replace("--trials 60", "--trials 4")
            .replace("--steps 3000000", "--steps 3000 --preset smoke");
        let smaller = smaller.replace("tcp/127.0.0.1:7447", &router);
        let args: Vec<&str> = smaller.split_whitespace().skip(1).filter(|word| *word != "&").collect();
        match command.ends_with(" &") {
            true => others.push(start(folder.path(), &args)),
            false => {
                let modules = Path::new(env!("CARGO_MANIFEST_DIR")).join("python");
                let output = treadmill(folder.path()).args(&args).env("PYTHONPATH", modules).output().unwrap();
                assert!(output.status.success() && !output.stdout.is_empty(), "{command}: {}", stderr(&output));
            }
        }
    }
    for made in ["seeds/sweep.png", "search/sweep.csv", "population/lineage.csv", "pool/sweep.csv"] {
        assert!(folder.path().join("runs").join(made).metadata().is_ok_and(|file| file.len() > 100), "{made}");
    }
}
