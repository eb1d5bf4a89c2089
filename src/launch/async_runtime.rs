//! Runtime for the asynchronous work of a command.

use anyhow::Context;

/// Runs `work` to its end. Dials and closes that hang afterwards do not keep the process alive.
pub fn run<T>(work: impl Future<Output = anyhow::Result<T>>) -> anyhow::Result<T> {
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().context("no runtime")?;
    let outcome = runtime.block_on(work);
    runtime.shutdown_background();
    outcome
}
