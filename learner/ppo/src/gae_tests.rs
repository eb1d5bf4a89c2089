//! Advantages computed by hand, and compared with the definition.

use proptest::prelude::*;

use super::*;

/// One environment, γ = 0.5, λ = 0.5 unless given otherwise.
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
        weights: None,
    };
    estimate(&steps, gamma, lambda)
}

const GOES_ON: (bool, bool) = (false, false);
const TERMINATED: (bool, bool) = (true, false);
const TRUNCATED: (bool, bool) = (false, true);

#[test]
fn termination_cuts_the_bootstrap_and_the_trace() {
    let result = one(&[1.0, 2.0, 3.0], &[4.0, 8.0, 16.0], &[GOES_ON, TERMINATED, GOES_ON], &[], 100.0);
    // δ2 = 3 + 50 − 16 = 37; δ1 = 2 − 8 = −6; δ0 = 1 + 4 − 4 = 1, A0 = 1 + ¼ · −6.
    assert_eq!(result.advantages, [-0.5, -6.0, 37.0]);
    assert_eq!(result.returns, [3.5, 2.0, 53.0]);
}

#[test]
fn truncation_bootstraps_from_the_true_last_observation_and_cuts_the_trace() {
    let result = one(&[1.0, 2.0, 3.0], &[4.0, 8.0, 16.0], &[GOES_ON, TRUNCATED, GOES_ON], &[20.0], 100.0);
    // δ1 = 2 + 10 − 8 = 4; A0 = 1 + ¼ · 4.
    assert_eq!(result.advantages, [2.0, 4.0, 37.0]);
}

#[test]
fn the_fragment_end_bootstraps_from_the_final_observation() {
    assert_eq!(one(&[1.0], &[4.0], &[GOES_ON], &[], 10.0).advantages, [2.0]);
    assert_eq!(one(&[1.0], &[4.0], &[TERMINATED], &[], 10.0).advantages, [-3.0]);
    assert_eq!(one(&[1.0], &[4.0], &[TRUNCATED], &[20.0], 10.0).advantages, [7.0]);
}

#[test]
fn a_step_both_terminated_and_truncated_counts_as_terminated() {
    assert_eq!(one(&[1.0], &[4.0], &[(true, true)], &[], 10.0).advantages, [-3.0]);
}

#[test]
fn environments_do_not_mix() {
    let ends = [GOES_ON, TRUNCATED, TRUNCATED, GOES_ON];
    let result = run(&[1.0, 2.0, 3.0, 4.0], &[0.0; 4], &ends, &[10.0, 20.0], &[30.0, 40.0], 0.5, 0.5);
    // Env 1 is truncated first in time-major order (V = 10), then env 0 (V = 20).
    assert_eq!(result.advantages, [1.0 + 0.25 * 13.0, 7.0, 13.0, 24.0]);
}

#[test]
fn lambda_one_is_the_monte_carlo_return_and_lambda_zero_the_temporal_difference() {
    let rewards = [1.0, 2.0, 4.0];
    let values = [10.0, 20.0, 30.0];
    let ends = [GOES_ON, GOES_ON, TERMINATED];
    let monte_carlo = run(&rewards, &values, &ends, &[], &[9.0], 0.5, 1.0);
    assert_eq!(monte_carlo.returns, [1.0 + 1.0 + 1.0, 2.0 + 2.0, 4.0]);
    let difference = run(&rewards, &values, &ends, &[], &[9.0], 0.5, 0.0);
    assert_eq!(difference.returns, [1.0 + 10.0, 2.0 + 15.0, 4.0]);
}

#[test]
#[should_panic(expected = "more values than truncated steps")]
fn values_left_over_are_a_mistake() {
    next_values(&[1.0], &[false], &[false], &[1.0], &[1.0]);
}

#[test]
#[should_panic(expected = "one value for each truncated step")]
fn values_that_are_missing_are_a_mistake() {
    next_values(&[1.0], &[false], &[true], &[], &[1.0]);
}

/// Equation 16 as it stands: `A_t = Σ_l (γλ)^l δ_{t+l}` up to the end of the episode or fragment.
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
            weights: None,
        };
        let result = estimate(&steps, gamma, lambda);
        for (a, e) in result.advantages.iter().zip(by_definition(&steps, gamma.into(), lambda.into())) {
            prop_assert!((f64::from(*a) - e).abs() < 1e-3, "{a} {e}");
        }
    }
}

/// Targets of V-trace for one environment, step by step as Espeholt et al. 2018 define them: equation 1 with
/// c = λ · weight, from double precision and without recursion.
fn v_trace(steps: &Steps, weights: &[f32], gamma: f64, lambda: f64) -> Vec<f64> {
    let of = |plane: &[f32], i: usize| f64::from(plane[i]);
    let ended = |i: usize| steps.terminated[i] || steps.truncated[i];
    let delta = |i: usize| {
        let future = if steps.terminated[i] { 0.0 } else { gamma * of(steps.next_values, i) };
        of(weights, i) * (of(steps.rewards, i) + future - of(steps.values, i))
    };
    (0..steps.rewards.len())
        .map(|s| {
            let (mut target, mut product, mut t) = (of(steps.values, s), 1.0, s);
            loop {
                target += product * delta(t);
                product *= gamma * lambda * of(weights, t);
                if ended(t) || t + 1 == steps.rewards.len() {
                    return target;
                }
                t += 1;
            }
        })
        .collect()
}

proptest! {
    #[test]
    fn weighted_targets_are_those_of_v_trace(
        cells in prop::collection::vec((-5.0_f32..5.0, -5.0_f32..5.0, 0.0_f32..1.0, 0_u8..8), 1..60),
        gamma in 0.0_f32..1.0,
        lambda in 0.0_f32..1.0,
    ) {
        let rewards: Vec<_> = cells.iter().map(|c| c.0).collect();
        let values: Vec<_> = cells.iter().map(|c| c.1).collect();
        let weights: Vec<_> = cells.iter().map(|c| c.2).collect();
        let terminated: Vec<_> = cells.iter().map(|c| c.3 == 0).collect();
        let truncated: Vec<_> = cells.iter().map(|c| c.3 == 1).collect();
        let truncated_values: Vec<_> = cells.iter().filter(|c| c.3 == 1).map(|c| c.0 + 1.0).collect();
        let next_values = next_values(&values, &terminated, &truncated, &truncated_values, &[0.7]);
        let (rewards, values) = (&rewards[..], &values[..]);
        let (next_values, terminated, truncated) = (&next_values[..], &terminated[..], &truncated[..]);
        let plain = Steps { envs: 1, rewards, values, next_values, terminated, truncated, weights: None };
        let steps = Steps { weights: Some(&weights), ..plain };
        let result = estimate(&steps, gamma, lambda);
        for (found, wanted) in result.returns.iter().zip(v_trace(&steps, &weights, gamma.into(), lambda.into())) {
            prop_assert!((f64::from(*found) - wanted).abs() < 1e-3, "{found} {wanted}");
        }
        let ones = vec![1.0; rewards.len()];
        let own = Steps { weights: Some(&ones), ..plain };
        prop_assert_eq!(estimate(&own, gamma, lambda), estimate(&plain, gamma, lambda));
    }
}

#[test]
fn weights_are_by_hand() {
    let next_values = [8.0, 16.0, 100.0];
    let steps = Steps {
        envs: 1,
        rewards: &[1.0, 2.0, 3.0],
        values: &[4.0, 8.0, 16.0],
        next_values: &next_values,
        terminated: &[false; 3],
        truncated: &[false; 3],
        weights: Some(&[0.25, 0.5, 1.0]),
    };
    let result = estimate(&steps, 0.5, 0.5);
    // δ2 = 3 + 50 − 16 = 37; A1 = 2 + 8 − 8 + ¼ · 37; A0 = 1 + 4 − 4 + ¼ · ½ · A1.
    assert_eq!(result.advantages, [2.40625, 11.25, 37.0]);
    // Values plus the weighted advantages.
    assert_eq!(result.returns, [4.6015625, 13.625, 53.0]);
}
