//! Films of the newest policy for TensorBoard, made by a process of their own that lets training go first.

use std::{
    fs,
    path::Path,
    process::{Child, Stdio},
    thread::{self, JoinHandle},
    time::{Duration, Instant},
};

use anyhow::{Context, ensure};
use serde::Deserialize;
use treadmill_learner::metrics::{FilmOfPolicy, FilmSlot};
use treadmill_runtime::{error_chain, run_folder::RunFolder, shutdown::Shutdown};

use super::child;

/// The first film is due after this time; the next when the run is twice as old, or after the longest pause.
const FIRST_AFTER: Duration = Duration::from_secs(20);
const PAUSE_MAX: Duration = Duration::from_secs(1800);
/// Interval of looking for a request to stop.
const POLL_EVERY: Duration = Duration::from_millis(200);
/// Longest time that a film may take.
const TIMEOUT: Duration = Duration::from_secs(120);
/// Niceness of the process that makes films.
const NICENESS: i32 = 19;
/// Width and height of a film in pixels, its pictures per second, and its length (s).
const SIZE: [u32; 2] = [320, 240];
const FPS: &str = "12";
const SECONDS: &str = "6";

/// Result of `eval`, as far as it says which policy was filmed.
#[derive(Deserialize)]
struct Played {
    checkpoint_env_steps: u64,
}

/// Thread that makes films of a run. It ends when this is dropped: a process that ended before it would leave the folder of
/// the film that is being made.
pub struct Films {
    stop: Shutdown,
    thread: Option<JoinHandle<()>>,
}

impl Films {
    /// Begins to make films.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn begin(folder: RunFolder, slot: FilmSlot) -> anyhow::Result<Self> {
        let stop = Shutdown::default();
        let make = {
            let stop = stop.clone();
            move || make(&folder, &slot, &stop)
        };
        let thread = thread::Builder::new().name("films".to_string()).spawn(make).context("no thread for films")?;
        Ok(Self { stop, thread: Some(thread) })
    }
}

impl Drop for Films {
    fn drop(&mut self) {
        self.stop.ask();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn make(folder: &RunFolder, slot: &FilmSlot, shutdown: &Shutdown) {
    let (begun, mut due) = (Instant::now(), FIRST_AFTER);
    while !shutdown.asked() {
        thread::sleep(POLL_EVERY);
        if begun.elapsed() < due {
            continue;
        }
        match film(folder, shutdown) {
            Ok(film) => film.into_iter().for_each(|film| slot.put(film)),
            Err(why) => tracing::debug!(error = %error_chain(&*why), "no film of the robot"),
        }
        due = begun.elapsed() + begun.elapsed().min(PAUSE_MAX);
    }
}

/// Films an episode of the newest policy; `None` after a request to stop.
fn film(folder: &RunFolder, shutdown: &Shutdown) -> anyhow::Result<Option<FilmOfPolicy>> {
    let place = tempfile::tempdir().context("no folder for the film")?;
    let (gif, program) = (place.path().join("film.gif"), std::env::current_exe()?);
    let size = SIZE.map(|side| side.to_string()).join("x");
    let mut command = child::command(&program, NICENESS);
    command.arg("eval").arg(folder.root()).args(["--checkpoint", "latest", "--episodes", "1", "--json"]);
    command.arg("--film").arg(&gif).args(["--size", &size, "--fps", FPS, "--seconds", SECONDS]);
    let output = place.path().join("output");
    command.stdin(Stdio::null()).stdout(fs::File::create(&output)?).stderr(Stdio::null());
    if !wait(command.spawn().context("no process for the film")?, shutdown)? {
        return Ok(None);
    }
    let Played { checkpoint_env_steps } = read(&output)?;
    Ok(Some(FilmOfPolicy { env_steps: checkpoint_env_steps, size: SIZE, gif: fs::read(&gif)? }))
}

/// Waits for the process; returns false after a request to stop.
fn wait(mut process: Child, shutdown: &Shutdown) -> anyhow::Result<bool> {
    let until = Instant::now() + TIMEOUT;
    loop {
        if let Some(status) = process.try_wait()? {
            ensure!(status.success(), "the process that filmed ended with {status}");
            return Ok(true);
        }
        if shutdown.asked() || Instant::now() >= until {
            process.kill()?;
            process.wait()?;
            ensure!(shutdown.asked(), "the film took longer than {TIMEOUT:?}");
            return Ok(false);
        }
        thread::sleep(POLL_EVERY);
    }
}

/// Reads the last line of what `eval` printed.
fn read(output: &Path) -> anyhow::Result<Played> {
    let text = fs::read_to_string(output)?;
    Ok(serde_json::from_str(text.lines().last().unwrap_or_default())?)
}
