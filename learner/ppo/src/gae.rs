//! Generalised advantage estimation: Schulman et al. 2016, "High-dimensional continuous control using generalized
//! advantage estimation", arXiv:1506.02438, equations 11, 12 and 16.
//!
//! Pure functions on planes in time-major order, `[T, N]`: element `(t, n)` stands at `t · N + n`.
//!
//! **Truncation is not termination.** A terminated step has no future, so nothing is bootstrapped. After a truncated
//! step, and at the end of a fragment, the episode would have continued: the value of the observation truly reached
//! estimates the rest of the return. In both cases the next row belongs to another episode, so the trace is cut.

/// Steps of `envs` environments, each plane `[T, N]`; rewards and values in the same units.
#[derive(Clone, Copy, Debug)]
pub struct Steps<'a> {
    /// Environments, `N`.
    pub envs: usize,
    /// Reward of each step.
    pub rewards: &'a [f32],
    /// `V` of the observation before each step.
    pub values: &'a [f32],
    /// `V` of the observation truly reached by each step, as [`next_values`] gives it; not read where terminated.
    pub next_values: &'a [f32],
    /// Whether the episode terminated at the step.
    pub terminated: &'a [bool],
    /// Whether a time limit truncated the episode at the step.
    pub truncated: &'a [bool],
}

/// Result of [`estimate`], each plane `[T, N]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Advantages {
    /// Advantage of each step's action.
    pub advantages: Vec<f32>,
    /// Value target of each step: advantage + value, the λ-return.
    pub returns: Vec<f32>,
}

/// Estimates advantages and value targets: `δ = r + γ V' (1 − terminated) − V` and `A = δ + γ λ A'`, where `A'` is 0
/// after the end of an episode or fragment. Value targets are the λ-returns `V + A`.
///
/// # Panics
/// If the planes differ in length or do not hold whole rows of `envs`.
pub fn estimate(steps: &Steps, gamma: f32, lambda: f32) -> Advantages {
    let Steps { envs, rewards, values, next_values, terminated, truncated } = *steps;
    let count = rewards.len();
    assert!(envs > 0 && count.is_multiple_of(envs), "{count} steps do not fill rows of {envs} environments");
    assert!(values.len() == count && next_values.len() == count, "one value before and after each step");
    assert!(terminated.len() == count && truncated.len() == count, "one flag of each kind per step");

    let (mut advantages, mut returns) = (vec![0.0; count], vec![0.0; count]);
    let mut next_advantages = vec![0.0; envs];
    for start in (0..count).step_by(envs).rev() {
        for (env, next_advantage) in next_advantages.iter_mut().enumerate() {
            let i = start + env;
            let future = if terminated[i] { 0.0 } else { gamma * next_values[i] };
            let trace = if terminated[i] || truncated[i] { 0.0 } else { gamma * lambda * *next_advantage };
            advantages[i] = rewards[i] + future - values[i] + trace;
            *next_advantage = advantages[i];
            returns[i] = values[i] + advantages[i];
        }
    }
    Advantages { advantages, returns }
}

/// Returns the values after each step, from the values before each step and those of the true last observations.
///
/// * Step not ended, not in the last row: the value before the next step of the same environment.
/// * Truncated and not terminated: the next of `truncated_values`, which has one for each such step in time-major
///   order, including the last row.
/// * Last row, not ended: `final_values`, `[N]`, the values of the observations after the fragment.
/// * Terminated: 0.
///
/// # Panics
/// If the planes differ in length, or `truncated_values` does not have exactly one value for each truncated step.
pub fn next_values(
    values: &[f32],
    terminated: &[bool],
    truncated: &[bool],
    truncated_values: &[f32],
    final_values: &[f32],
) -> Vec<f32> {
    let envs = final_values.len();
    assert!(envs > 0 && values.len().is_multiple_of(envs), "the values do not fill rows of {envs} environments");
    assert!(terminated.len() == values.len() && truncated.len() == values.len(), "one flag of each kind per step");
    let mut truncated_values = truncated_values.iter().copied();
    let after = values.iter().skip(envs).chain(final_values).take(values.len());
    let next = after
        .zip(terminated.iter().zip(truncated))
        .map(|(after, ended)| match ended {
            (true, _) => 0.0,
            (false, true) => truncated_values.next().expect("one value for each truncated step"),
            (false, false) => *after,
        })
        .collect();
    assert_eq!(truncated_values.next(), None, "more values than truncated steps");
    next
}

#[cfg(test)]
#[path = "gae_tests.rs"]
mod tests;
