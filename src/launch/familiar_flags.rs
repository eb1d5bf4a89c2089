//! Hints for flags that users know from other programs of this kind, and for a frequent slip.

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Flags of Stable-Baselines3, CleanRL, rsl_rl and Gymnasium, and what they are called here.
const FAMILIAR: &[(&[&str], &str)] = &[
    (&["--num-envs", "--num_envs", "--n-envs", "--n_envs", "--nenvs"], "--envs N"),
    (&["--total-timesteps", "--total_timesteps", "--timesteps", "--max-steps", "--num-timesteps"], "--steps N"),
    (&["--lr", "--learning-rate", "--learning_rate"], "--set ppo.learning_rate=X"),
    (&["--gamma"], "--set ppo.gamma=X"),
    (&["--batch-size", "--batch_size", "--n-steps", "--n_steps", "--num-steps"], "--set ppo.batch=N"),
    (&["--minibatch-size", "--num-minibatches"], "--set ppo.minibatch=N"),
    (&["--n-epochs", "--n_epochs", "--epochs", "--update-epochs"], "--set ppo.epochs=N"),
    (&["--env", "--env-id", "--env_id"], "--task NAME"),
    (&["--num-workers", "--workers", "--num_workers"], "--actors N"),
    (&["--log-dir", "--logdir", "--output", "--out", "--save-dir", "--exp-name", "--name"], "--run-dir DIR"),
    (&["--load", "--load-run", "--load_run", "--restore"], "--resume RUN"),
    (&["--cuda", "--gpu"], "--device cuda"),
    (&["--headless", "--render", "--video"], "`treadmill eval RUN --film FILE` or `treadmill watch RUN`"),
];

/// Returns a hint for the unknown flag that `error` reports.
#[must_use]
pub fn hint(error: &clap::Error) -> Option<String> {
    if error.kind() != ErrorKind::UnknownArgument {
        return None;
    }
    let Some(ContextValue::String(given)) = error.get(ContextKind::InvalidArg) else { return None };
    let words: Vec<String> = std::env::args().collect();
    if let Some(hint) = set_without_equals(&words, given) {
        return Some(hint);
    }
    let given = given.split('=').next().unwrap_or(given);
    let (_, ours) = FAMILIAR.iter().find(|(theirs, _)| theirs.contains(&given))?;
    Some(format!("hint: what other programs call {given} is {ours} here; `treadmill config` prints every key"))
}

/// Returns a hint if the unknown argument is the value in `--set KEY VALUE`.
fn set_without_equals(words: &[String], given: &str) -> Option<String> {
    let [_, key, _] = words.windows(3).find(|words| words[0] == "--set" && words[2] == given)? else { return None };
    (!key.contains('=')).then(|| format!("hint: write --set {key}={given}"))
}
