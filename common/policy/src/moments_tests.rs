//! Moments against calculations by hand, and what outliers and shifts do to them.

use proptest::prelude::*;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

use super::*;

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9 * (1.0 + b.abs()), "{a} is not {b}");
}

/// Returns samples of N(mean, std²).
fn normals(count: usize, mean: f32, std: f32, seed: u64) -> Vec<f32> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let standard: Vec<f32> = (0..count).map(|_| StandardNormal.sample(&mut random)).collect();
    standard.iter().map(|x| mean + std * x).collect()
}

fn std(moments: &RunningMoments) -> f64 {
    moments.variance()[0].sqrt()
}

#[test]
fn moments_agree_with_a_calculation_by_hand() {
    let mut moments = RunningMoments::new(2);
    moments.update(&[1.0, 10.0, 2.0, 10.0], 2);
    moments.update(&[6.0, 40.0], 2);
    assert_eq!(moments.count, 3.0);
    close(moments.mean[0], 3.0);
    close(moments.mean[1], 20.0);
    close(moments.variance()[0], 14.0 / 3.0);
    close(moments.variance()[1], 200.0);
}

#[test]
fn a_large_mean_does_not_swallow_the_variance() {
    let mut moments = RunningMoments::new(1);
    for _ in 0..100 {
        moments.update(&[16_000_000.0, 16_000_001.0], 1);
    }
    close(moments.variance()[0], 0.25);
}

#[test]
fn parts_of_a_batch_equal_the_whole() {
    let rows = normals(300, 3.0, 2.0, 1);
    let (mut whole, mut parts) = (RunningMoments::new(3), RunningMoments::new(3));
    whole.update(&rows, 3);
    parts.update_parts(&[&rows[..30], &[], &rows[30..]], 3);
    assert_eq!(parts, whole);
}

#[test]
fn one_absurd_number_among_normal_ones_changes_little() {
    for bad in [1e30, -1e30, f32::MAX, 1e6] {
        let mut rows = normals(4096, 5.0, 2.0, 2);
        let mut clean = RunningMoments::new(1);
        clean.update(&rows, 1);
        // In the first batch.
        rows[1000] = bad;
        let mut first = RunningMoments::new(1);
        first.update(&rows, 1);
        // 20 σ / n is 0.01 of 2, and 400 σ² / n is 0.098 of 4; the scale of the groups is off by a few per cent.
        assert!((first.mean[0] - clean.mean[0]).abs() < 0.011, "{bad}: {} {}", first.mean[0], clean.mean[0]);
        assert!((first.variance()[0] / clean.variance()[0] - 1.0).abs() < 0.11, "{bad}");
        // In the second, where half as much is left of it.
        let mut second = clean.clone();
        second.update(&rows, 1);
        assert!((second.mean[0] - clean.mean[0]).abs() < 0.006, "{bad}: {} {}", second.mean[0], clean.mean[0]);
        assert!((second.variance()[0] / clean.variance()[0] - 1.0).abs() < 0.06, "{bad}");
    }
}

#[test]
fn one_bad_half_of_the_first_batch_does_not_ruin_the_moments() {
    let good = normals(2048, -1.0, 0.5, 3);
    let mut moments = RunningMoments::new(1);
    moments.update_parts(&[&good, &[1e30; 2048]], 1);
    // The bad half is clamped to 20 σ beyond the mean.
    assert!(moments.mean[0] < 5.0 && std(&moments) < 7.0, "{} {}", moments.mean[0], std(&moments));
}

#[test]
fn ordinary_numbers_are_not_changed() {
    let rows = normals(5000, 3.0, 0.1, 4);
    let mut moments = RunningMoments::new(1);
    rows.chunks(1000).for_each(|part| moments.update(part, 1));
    let mean = rows.iter().map(|x| f64::from(*x)).sum::<f64>() / 5000.0;
    let variance = rows.iter().map(|x| (f64::from(*x) - mean).powi(2)).sum::<f64>() / 5000.0;
    close(moments.mean[0], mean);
    close(moments.variance()[0], variance);
}

#[test]
fn the_moments_follow_a_shift_of_the_distribution() {
    let mut moments = RunningMoments::new(1);
    moments.update(&normals(8192, 0.0, 1.0, 5), 1);
    // A thousand standard deviations away, ten times as wide.
    for batch in 0..50 {
        moments.update(&normals(8192, 1000.0, 10.0, 6 + batch), 1);
    }
    // The mixture of 1 part N(0, 1) and 50 parts N(1000, 10²).
    let share = 50.0 / 51.0;
    let variance = (1.0 - share) + share * 100.0 + share * (1.0 - share) * 1e6;
    assert!((moments.mean[0] / (1000.0 * share) - 1.0).abs() < 1e-3, "{}", moments.mean[0]);
    assert!((moments.variance()[0] / variance - 1.0).abs() < 1e-2, "{} {variance}", moments.variance()[0]);
}

#[test]
fn old_rows_lose_weight_beyond_those_remembered() {
    let mut moments = RunningMoments { count: ROWS_REMEMBERED, mean: vec![0.0], m2: vec![ROWS_REMEMBERED] };
    let rows = normals(1_000_000, 2.0, 1.0, 7);
    for _ in 0..20 {
        moments.update(&rows, 1);
        assert_eq!(moments.count, ROWS_REMEMBERED);
    }
    // Each million keeps 20/21 of what was before it: (20/21)²⁰ = 0.377.
    let kept = (20.0_f64 / 21.0).powi(20);
    assert!((moments.mean[0] - 2.0 * (1.0 - kept)).abs() < 0.005, "{}", moments.mean[0]);
    assert!((moments.variance()[0] - (1.0 + 4.0 * kept * (1.0 - kept))).abs() < 0.01, "{}", moments.variance()[0]);
}

#[test]
fn a_constant_column_that_begins_to_move_is_followed() {
    let mut moments = RunningMoments::new(2);
    for _ in 0..10 {
        moments.update(&[8.907_463, 0.0].repeat(1024), 2);
    }
    // In one row of 200, as a rare contact does.
    let mut rows = [8.907_463_f32, 0.0].repeat(8192);
    (0..8192).step_by(200).for_each(|row| (rows[2 * row], rows[2 * row + 1]) = (10.0, 1.0));
    for _ in 0..90 {
        moments.update(&rows, 2);
    }
    let share = 41.0 / 8192.0 * (90.0 * 8192.0) / (90.0 * 8192.0 + 10.0 * 1024.0);
    close(moments.mean[1], share);
    close(moments.variance()[1], share * (1.0 - share));
    assert!((moments.variance()[0] / (share * (1.0 - share) * 1.092_537_f64.powi(2)) - 1.0).abs() < 1e-5);
}

proptest! {
    #[test]
    fn finite_rows_keep_finite_moments(
        batches in prop::collection::vec(prop::collection::vec(any::<f32>(), 0..100), 1..6),
    ) {
        let mut moments = RunningMoments::new(2);
        for batch in &batches {
            let finite: Vec<f32> = batch.iter().map(|x| if x.is_finite() { *x } else { f32::MAX }).collect();
            moments.update(&finite[..finite.len() / 2 * 2], 2);
            prop_assert!(moments.is_finite(), "{moments:?}");
            prop_assert!(moments.m2.iter().all(|m2| *m2 >= 0.0));
        }
    }

    #[test]
    fn merged_parts_equal_the_whole(rows in prop::collection::vec(-100.0_f32..100.0, 0..60), cut in 0_usize..20) {
        let rows = &rows[..rows.len() / 3 * 3];
        let cut = (cut * 3).min(rows.len());
        let plain = |rows: &[f32]| {
            let mut moments = RunningMoments::new(3);
            rows.chunks(3).for_each(|row| {
                let mean = row.iter().map(|x| f64::from(*x)).collect();
                moments.merge(&RunningMoments { count: 1.0, mean, m2: vec![0.0; 3] });
            });
            moments
        };
        let mut whole = RunningMoments::new(3);
        whole.update(rows, 3);
        let mut left = plain(&rows[..cut]);
        left.merge(&plain(&rows[cut..]));
        prop_assert_eq!(left.count, whole.count);
        for i in 0..3 {
            prop_assert!((left.mean[i] - whole.mean[i]).abs() < 1e-9);
            prop_assert!((left.m2[i] - whole.m2[i]).abs() < 1e-6);
        }
    }
}

#[test]
fn symmetric_moments_are_those_of_the_rows_and_their_mirror_images() {
    let rows: Vec<f32> = (0..300).map(|i| (i as f32 * 0.37).sin() * 3.0 + i as f32 % 3.0).collect();
    let reflection = [(1, -1.0), (0, -1.0), (2, -1.0)];
    let images: Vec<f32> =
        rows.chunks_exact(3).flat_map(|row| reflection.map(|(at, sign): (usize, f32)| sign * row[at])).collect();
    let (mut found, mut both) = (RunningMoments::new(3), RunningMoments::new(3));
    found.update(&rows, 3);
    found.symmetrise(&reflection);
    both.update(&[rows, images].concat(), 3);
    assert_eq!(found.count, 100.0);
    assert!(found.mean[0] == -found.mean[1] && found.mean[2] == 0.0);
    for i in 0..3 {
        assert!((found.mean[i] - both.mean[i]).abs() < 1e-9);
        assert!((found.m2[i] - 0.5 * both.m2[i]).abs() < 1e-9 * both.m2[i]);
    }
}
