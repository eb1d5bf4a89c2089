//! Process of Python that owns a study of Optuna (`python/treadmill_sweep/`): each request is a line of JSON, and so is its
//! answer.

use std::{
    io::{BufRead, BufReader, Write},
    os::unix::process::CommandExt,
    path::{Path, PathBuf},
    process::{ChildStdin, ChildStdout, Stdio},
};

use anyhow::Context;
use serde_json::{Value, json};

use crate::launch::{child, exit_code::Usage, supervisor::own_program};

/// Variable that names the interpreter.
const PYTHON: &str = "TREADMILL_PYTHON";

/// Connection to the process, which ends with it.
pub(crate) struct Proposer {
    python: String,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Proposer {
    /// Starts the process in `folder`, from which paths of a database count.
    ///
    /// # Errors
    /// If Python, the module or a package that `strategy` needs is missing.
    pub(crate) fn start(strategy: &str, folder: &Path) -> anyhow::Result<Self> {
        // A wheel installs the program beside the Python that has its packages.
        let beside = own_program()?.with_file_name("python3");
        let default = if beside.exists() { beside.display().to_string() } else { "python3".to_string() };
        let python = std::env::var(PYTHON).unwrap_or(default);
        let mut command = child::command(&PathBuf::from(&python), 0);
        command.args(["-m", "treadmill_sweep", "--serve"]).stdin(Stdio::piped()).stdout(Stdio::piped());
        // Ctrl-C reaches only the sweep, which asks for more afterwards.
        let child = command.current_dir(folder).process_group(0).spawn();
        let mut child =
            child.map_err(|why| Usage(format!("`{python}` cannot be started ({why}); name a Python by {PYTHON}")))?;
        let (Some(requests), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            anyhow::bail!("`{python}` has no standard input and output");
        };
        let mut proposer = Self { python, requests, answers: BufReader::new(answers) };
        let checked = proposer.exchange(&json!({"call": "check", "strategy": strategy}));
        let why = match checked {
            Ok(answer) if answer["error"].is_null() => return Ok(proposer),
            Ok(answer) => answer["error"].as_str().unwrap_or_default().to_string(),
            Err(_) => "`treadmill_sweep` does not start; if it is missing: pip install \"./python[sweep]\"".to_string(),
        };
        Err(Usage(format!("`{}`, the Python of this search: {why}", proposer.python)).into())
    }

    /// Returns the answer to a request.
    ///
    /// # Errors
    /// If Optuna refuses the request, or the process has ended.
    pub(crate) fn call(&mut self, request: &Value) -> anyhow::Result<Value> {
        let answer = self.exchange(request).with_context(|| format!("`{} -m treadmill_sweep` fails", self.python))?;
        match answer["error"].as_str() {
            Some(why) => Err(anyhow::anyhow!("{why}")),
            None => Ok(answer),
        }
    }

    fn exchange(&mut self, request: &Value) -> anyhow::Result<Value> {
        self.requests.write_all(format!("{request}\n").as_bytes())?;
        let mut line = String::new();
        anyhow::ensure!(self.answers.read_line(&mut line)? > 0, "it has ended");
        serde_json::from_str(&line).with_context(|| format!("no answer to {request}"))
    }
}
