use proptest::prelude::*;

use super::*;

fn config() -> Config {
    let mut config = Config::default();
    config.ppo.batch = 8192;
    config
}

fn rule() -> HorizonRule {
    HorizonRule::new(&config(), 45, 17)
}

fn fleet(members: &[(usize, f64)]) -> Vec<u32> {
    horizons(&rule(), members)
}

fn horizons(rule: &HorizonRule, members: &[(usize, f64)]) -> Vec<u32> {
    let names: Vec<String> = (0..members.len()).map(|i| format!("{i:05}")).collect();
    let fleet = names.iter().zip(members).map(|(name, (envs, speed))| {
        let member = Member { envs: *envs, speed: *speed };
        (name.as_str(), member)
    });
    rule.horizons(&fleet.collect()).into_values().collect()
}

#[test]
fn a_batch_stays_as_large_while_horizons_shrink_from_128_to_32() {
    assert_eq!(fleet(&[(32, 1.0), (32, 1.0)]), [128, 128]);
    assert_eq!(fleet(&[(32, 1.0); 3]), [86; 3], "3 x 32 x 86 = 8256");
    assert_eq!(fleet(&[(32, 1.0); 8]), [32; 8]);
    assert_eq!(fleet(&[(1, 1.0); 64]), [128; 64]);
}

#[test]
fn few_environments_deliver_several_equal_fragments_for_a_batch() {
    assert_eq!(fleet(&[(8, 1.0)]), [128], "8 rounds of 1024");
    assert_eq!(fleet(&[(40, 1.0)]), [103], "2 rounds of 4120");
}

#[test]
fn beyond_256_environments_batches_grow_and_horizons_shrink_slowly() {
    let rule = rule();
    assert_eq!(rule.nominal(512), 27);
    assert_eq!((rule.nominal(1024), rule.round_rows(1024)), (23, 23_170));
    assert_eq!((rule.nominal(2048), rule.round_rows(2048)), (16, 32_768), "four batches");
    assert_eq!((rule.nominal(4096), rule.round_rows(4096)), (8, 32_768));
    assert_eq!(rule.nominal(65_536), STEPS_MIN as u32, "and batches grow again");
    let mut config = config();
    config.ppo.batch_max = 10_000;
    assert_eq!(HorizonRule::new(&config, 45, 17).round_rows(4096), 10_000, "at most ppo.batch_max");
}

#[test]
fn an_actor_at_half_speed_gets_half_the_horizon() {
    let mut members = vec![(8, 1.0); 6];
    members.extend([(8, 0.5), (8, 0.1)]);
    // 8192 transitions / 8 environments / a sum of speeds of 6.6.
    assert_eq!(fleet(&members), [156, 156, 156, 156, 156, 156, 78, 16]);
    assert_eq!(fleet(&[(128, 1.0), (128, 0.01)]), [64, 8], "not below 8 steps");
    assert_eq!(fleet(&[(32, 1.0), (32, 100.0)]), [8, 254], "2.5 and 253.5 steps");
}

#[test]
fn a_configured_horizon_is_kept() {
    let mut config = config();
    config.rollout.fragment_steps = 24;
    let rule = HorizonRule::new(&config, 45, 17);
    assert_eq!(horizons(&rule, &[(8, 1.0), (8, 0.5)]), [24, 24]);
    assert_eq!(rule.nominal(4096), 24);
}

#[test]
fn a_fragment_fits_into_a_message() {
    let rule = HorizonRule::new(&config(), 4096, 17);
    let [steps] = horizons(&rule, &[(64, 1.0)])[..] else { panic!("one actor") };
    let bytes = steps as usize * 64 * (2 * 4096 + 17 + 2) * 4;
    assert!(steps < 128 && bytes <= FRAGMENT_BYTES_MAX, "{steps} steps");
}

proptest! {
    #[test]
    fn every_fleet_delivers_a_round(members in prop::collection::vec((1_usize..500, 0.1_f64..4.0), 1..80)) {
        let (rule, envs) = (rule(), members.iter().map(|(envs, _)| envs).sum::<usize>());
        let horizons = horizons(&rule, &members);
        let is_limited = horizons.iter().any(|steps| *steps == FACTOR_MAX as u32 * rule.nominal(envs));
        let rows: usize = members.iter().zip(&horizons).map(|((envs, _), steps)| envs * *steps as usize).sum();
        prop_assert!(rows >= rule.round_rows(envs) || is_limited, "{rows} rows");
        prop_assert!(horizons.iter().all(|steps| (STEPS_MIN as u32..=STEPS_MAX).contains(steps)));
    }

    #[test]
    fn a_faster_actor_gets_no_shorter_horizon(envs in 1_usize..300, slow in 0.05_f64..1.0, fast in 1.0_f64..3.0) {
        let horizons = fleet(&[(envs, slow), (envs, fast)]);
        prop_assert!(horizons[0] <= horizons[1]);
    }
}
