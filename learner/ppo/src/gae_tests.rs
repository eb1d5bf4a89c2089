//! Advantages against numbers computed by hand, and against the definition.

use proptest::prelude::*;

use super::*;

/// Advantages of one environment with γ = 0.5 and λ = 0.5.
fn one(rewards: &[f32], values: &[f32], ends: &[(bool, bool)], truncated_values: &[f32], last: f32) -> Advantages {
    run(rewards, values, ends, truncated_values, &[last], 0.5, 0.5)
}

fn run(
    rewards: &[f32],
    values: &[f32],
    ends: &[(bool, bool)],
    truncated_values: &[f32],
    final_values: &[f32],
    gamma: f32,
    lambda: f32,
) -> Advantages {
    let (terminated, truncated): (Vec<_>, Vec<_>) = ends.iter().copied().unzip();
    let next_values = next_values(values, &terminated, &truncated, truncated_values, final_values);
    let steps = Steps {
        envs: final_values.len(),
        rewards,
        values,
        next_values: &next_values,
        terminated: &terminated,
        truncated: &truncated,
    };
    estimate(&steps, gamma, lambda)
}

const CONTINUES: (bool, bool) = (false, false);
const TERMINATED: (bool, bool) = (true, false);
const TRUNCATED: (bool, bool) = (false, true);

#[test]
fn termination_cuts_the_bootstrap_and_the_trace() {
    let result = one(&[1.0, 2.0, 3.0], &[4.0, 8.0, 16.0], &[CONTINUES, TERMINATED, CONTINUES], &[], 100.0);
    // δ2 = 3 + 50 − 16 = 37; δ1 = 2 − 8 = −6; δ0 = 1 + 4 − 4 = 1, A0 = 1 + ¼ · −6.
    assert_eq!(result.advantages, [-0.5, -6.0, 37.0]);
    assert_eq!(result.returns, [3.5, 2.0, 53.0]);
}

#[test]
fn truncation_bootstraps_from_the_true_last_observation_and_cuts_the_trace() {
    let result = one(&[1.0, 2.0, 3.0], &[4.0, 8.0, 16.0], &[CONTINUES, TRUNCATED, CONTINUES], &[20.0], 100.0);
    // δ1 = 2 + 10 − 8 = 4; A0 = 1 + ¼ · 4.
    assert_eq!(result.advantages, [2.0, 4.0, 37.0]);
}

#[test]
fn the_fragment_end_bootstraps_from_the_final_observation() {
    assert_eq!(one(&[1.0], &[4.0], &[CONTINUES], &[], 10.0).advantages, [2.0]);
    assert_eq!(one(&[1.0], &[4.0], &[TERMINATED], &[], 10.0).advantages, [-3.0]);
    assert_eq!(one(&[1.0], &[4.0], &[TRUNCATED], &[20.0], 10.0).advantages, [7.0]);
}

#[test]
fn a_step_both_terminated_and_truncated_counts_as_terminated() {
    assert_eq!(one(&[1.0], &[4.0], &[(true, true)], &[], 10.0).advantages, [-3.0]);
}

#[test]
fn environments_do_not_mix() {
    let ends = [CONTINUES, TRUNCATED, TRUNCATED, CONTINUES];
    let result = run(&[1.0, 2.0, 3.0, 4.0], &[0.0; 4], &ends, &[10.0, 20.0], &[30.0, 40.0], 0.5, 0.5);
    // Env 1 is truncated first in time-major order (V = 10), then env 0 (V = 20).
    assert_eq!(result.advantages, [1.0 + 0.25 * 13.0, 7.0, 13.0, 24.0]);
}

#[test]
fn lambda_one_is_the_monte_carlo_return_and_lambda_zero_the_temporal_difference() {
    let rewards = [1.0, 2.0, 4.0];
    let values = [10.0, 20.0, 30.0];
    let ends = [CONTINUES, CONTINUES, TERMINATED];
    let monte_carlo = run(&rewards, &values, &ends, &[], &[9.0], 0.5, 1.0);
    assert_eq!(monte_carlo.returns, [1.0 + 1.0 + 1.0, 2.0 + 2.0, 4.0]);
    let difference = run(&rewards, &values, &ends, &[], &[9.0], 0.5, 0.0);
    assert_eq!(difference.returns, [1.0 + 10.0, 2.0 + 15.0, 4.0]);
}

#[test]
#[should_panic(expected = "more values than truncated steps")]
fn too_many_truncated_values_panic() {
    next_values(&[1.0], &[false], &[false], &[1.0], &[1.0]);
}

#[test]
#[should_panic(expected = "one value for each truncated step")]
fn missing_truncated_values_panic() {
    next_values(&[1.0], &[false], &[true], &[], &[1.0]);
}

/// Equation 16: `A_t = Σ_l (γλ)^l δ_{t+l}` up to the end of the episode or fragment.
fn by_definition(steps: &Steps, gamma: f64, lambda: f64) -> Vec<f64> {
    let envs = steps.envs;
    let total = steps.rewards.len() / envs;
    let wide = |plane: &[f32], t: usize, n: usize| f64::from(plane[t * envs + n]);
    let mut advantages = vec![0.0; total * envs];
    for t in 0..total {
        for n in 0..envs {
            for l in 0..total - t {
                let at = (t + l) * envs + n;
                let bootstrap = if steps.terminated[at] { 0.0 } else { gamma * wide(steps.next_values, t + l, n) };
                let delta = wide(steps.rewards, t + l, n) + bootstrap - wide(steps.values, t + l, n);
                advantages[t * envs + n] += (gamma * lambda).powi(l as i32) * delta;
                if steps.terminated[at] || steps.truncated[at] {
                    break;
                }
            }
        }
    }
    advantages
}

proptest! {
    #[test]
    fn the_recursion_equals_the_definition(
        envs in 1_usize..5,
        cells in prop::collection::vec((-5.0_f32..5.0, -5.0_f32..5.0, -5.0_f32..5.0, 0_u8..8), 5..120),
        gamma in 0.0_f32..1.0,
        lambda in 0.0_f32..1.0,
    ) {
        let cells = &cells[..cells.len() / envs * envs];
        let rewards: Vec<_> = cells.iter().map(|c| c.0).collect();
        let values: Vec<_> = cells.iter().map(|c| c.1).collect();
        let reached: Vec<_> = cells.iter().map(|c| c.2).collect();
        let terminated: Vec<_> = cells.iter().map(|c| c.3 == 0).collect();
        let truncated: Vec<_> = cells.iter().map(|c| c.3 == 1).collect();
        let steps = Steps {
            envs,
            rewards: &rewards,
            values: &values,
            next_values: &reached,
            terminated: &terminated,
            truncated: &truncated,
        };
        let result = estimate(&steps, gamma, lambda);
        for (a, e) in result.advantages.iter().zip(by_definition(&steps, gamma.into(), lambda.into())) {
            prop_assert!((f64::from(*a) - e).abs() < 1e-3, "{a} {e}");
        }
    }
}
