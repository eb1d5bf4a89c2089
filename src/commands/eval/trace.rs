//! Every step of an evaluation in a file, one JSON object per line.

use std::{
    any::Any,
    fs::File,
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

use anyhow::Context;
use serde_json::json;
use treadmill_actor::evaluation::EvaluationStep;
use treadmill_humanoid::task::motion::MotionTask;

/// Trace under way.
pub struct Trace {
    path: PathBuf,
    file: BufWriter<File>,
    written: io::Result<()>,
}

impl Trace {
    /// Creates the file.
    pub fn create(path: &Path) -> anyhow::Result<Self> {
        let file = File::create(path).with_context(|| context(path))?;
        Ok(Self { path: path.to_path_buf(), file: BufWriter::new(file), written: Ok(()) })
    }

    /// Writes a step; returns false after a failure, which [`Self::finish`] returns.
    pub fn record(&mut self, step: &EvaluationStep) -> bool {
        if self.written.is_ok() {
            self.written = writeln!(self.file, "{}", line(step));
        }
        self.written.is_ok()
    }

    /// Completes the file.
    ///
    /// # Errors
    /// If a line could not be written.
    pub fn finish(mut self) -> anyhow::Result<()> {
        self.written.and_then(|()| self.file.flush()).with_context(|| context(&self.path))
    }
}

fn context(path: &Path) -> String {
    format!("cannot write the trace `{}`", path.display())
}

/// Returns a step with the observation, command and state before it. After a fault there are no torques.
fn line(step: &EvaluationStep) -> serde_json::Value {
    let start = &step.start;
    let mut line = json!({
        "episode": step.episode,
        "step": step.step,
        "observation": start.observation,
        "action": start.action,
        "qpos": start.position,
        "qvel": start.velocity,
    });
    if let Some(command) = start.command {
        line["command"] = json!(command);
    }
    let task: &dyn Any = step.environment.task();
    if let Some(task) = task.downcast_ref::<MotionTask>() {
        line["motion"] = json!(task.motion());
    }
    if !step.ended.is_some_and(|played| played.fault) {
        line["torque"] = json!(step.environment.physics().joint_torques_nm());
    }
    line
}
