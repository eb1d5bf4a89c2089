use proptest::prelude::*;

use super::*;
use crate::actor_state::tests::sample as state;

pub(crate) fn sample() -> Fragment {
    Fragment {
        run: "walk".into(),
        actor: "a1".into(),
        actor_incarnation: 7,
        sequence: 3,
        version: PolicyVersion::new(9, 4),
        config_hash: 11,
        steps: 2,
        envs: 3,
        observation_size: 2,
        action_size: 1,
        observations: (0..12).map(|i| i as f32).collect(),
        actions: vec![0.5; 6],
        log_probs: vec![-1.0; 6],
        rewards: vec![5.0; 6],
        // Environment 0 continues, 1 is truncated at t = 0, 2 terminates at t = 1.
        flags: vec![0, TRUNCATED, 0, 0, 0, TERMINATED],
        last_observations: vec![1.0; 3 * 2],
        episodes: vec![Episode {
            return_sum: 12.0,
            length: 2,
            distance_m: 0.1,
            velocity_mean_mps: 3.0,
            cause: EndCause::TimeLimit,
            ground_kind: Some(2),
            ground_level: Some(3.0),
            command_factor: None,
            failed_step: None,
        }],
        settled_through: 1,
        actor_state: Some(state("a1", 3)),
        env_steps: 60,
        collect_s: 0.25,
        wire_version: 2,
        physics_version: 3,
        reward_terms: vec![RewardTerm { name: "forward".into(), mean: 1.5 }],
    }
}

proptest! {
    #[test]
    fn decoding_does_not_depend_on_pieces(positions in prop::collection::vec(any::<usize>(), 0..12), half in any::<bool>()) {
        let precision = if half { Precision::F16 } else { Precision::F32 };
        let bytes = sample().encode_as(precision).unwrap();
        let pieces = crate::pieces::tests::cut(&bytes, positions);
        prop_assert_eq!(Fragment::decode_pieces(&pieces).unwrap(), sample());
    }
}

#[test]
fn plane_numbers_match_the_schema() {
    let planes = wire::Fragment {
        observations: vec![1].into(),
        actions: vec![2].into(),
        log_probs: vec![3].into(),
        rewards: vec![4].into(),
        last_observations: vec![5].into(),
        ..Default::default()
    };
    let encoded = planes.encode_to_vec();
    let parts = Parts::of(Cursor::whole(&encoded)).unwrap();
    assert_eq!(parts.planes.map(|plane| plane.numbers(|[byte]| byte)), [[1], [2], [3], [4], [5]]);
    assert!(parts.others.is_empty());
}

#[test]
fn an_integer_in_place_of_a_plane_is_refused() {
    // Field 11 as an integer.
    let refused = Fragment::decode([0x58, 7]).unwrap_err().to_string();
    assert!(refused.contains("cannot be decoded") && refused.contains("observations"), "{refused}");
}

#[test]
fn half_precision_round_trips_and_names_itself() {
    let fragment = sample();
    let (full, half) = (fragment.encode().unwrap(), fragment.encode_as(Precision::F16).unwrap());
    assert_eq!(Fragment::decode(half.clone()).unwrap(), fragment);
    let numbers = fragment.observations.len() + fragment.last_observations.len();
    // Two bytes less for each number, and three more for the precision: a tag of two and a value of one.
    assert_eq!(half.len(), full.len() - 2 * numbers + 3);
    let unknown = wire::Fragment { observation_precision: 2, ..wire::Fragment::decode(&full[..]).unwrap() };
    let refused = Fragment::decode(unknown.encode_to_vec()).unwrap_err().to_string();
    assert!(refused.contains("`observation_precision` is 2"), "{refused}");
    let mut odd = wire::Fragment::decode(&half[..]).unwrap();
    odd.observations = odd.observations.slice(..odd.observations.len() - 1);
    assert!(Fragment::decode(odd.encode_to_vec()).unwrap_err().to_string().contains("`observations` is 23 bytes long"));
    let unrounded = Fragment { observations: vec![0.1; 12], ..sample() };
    assert!(unrounded.encode_as(Precision::F16).unwrap_err().to_string().contains("`observations` is 0.1"));
}

#[test]
fn infinite_numbers_are_refused_in_either_precision() {
    for (precision, number) in [(Precision::F32, &[0, 0, 0x80, 0x7f][..]), (Precision::F16, &[0, 0x7c][..])] {
        let mut message = wire::Fragment::decode(&sample().encode_as(precision).unwrap()[..]).unwrap();
        let mut plane = message.observations.to_vec();
        plane[2 * number.len()..][..number.len()].copy_from_slice(number);
        message.observations = plane.into();
        let refused = Fragment::decode(message.encode_to_vec()).unwrap_err().to_string();
        assert!(refused.contains("`observations` holds inf at index 2"), "{refused}");
    }
}

#[test]
fn the_number_of_last_observations_follows_from_the_flags() {
    // One for the truncation, and two at the end, where environments 0 and 1 continue.
    assert_eq!(sample().last_observation_count(), 3);
    let mut short = sample();
    short.last_observations.truncate(4);
    assert!(short.encode().unwrap_err().to_string().contains("last_observations"));
}

#[test]
fn the_error_names_the_bad_field() {
    let refuse = |change: fn(&mut Fragment)| {
        let mut fragment = sample();
        change(&mut fragment);
        fragment.check().unwrap_err().to_string()
    };
    assert!(refuse(|f| f.run = "a/b".into()).contains("`run`"));
    assert!(refuse(|f| f.steps = 0).contains("`steps` is 0"));
    assert!(refuse(|f| f.sequence = 0).contains("`sequence`"));
    assert!(refuse(|f| f.sequence = SEQUENCE_MAX + 1).contains("`sequence`"));
    assert!(refuse(|f| f.actor_state = Some(state("a2", 3))).contains("`actor_state.actor` is `a2`"));
    assert!(refuse(|f| f.actor_state = Some(state("a1", 2))).contains("of 2 environments and 4 numbers"));
    assert!(refuse(|f| f.actor_state.as_mut().unwrap().noise.clear()).contains("`actor_state.noise`"));
    assert!(refuse(|f| f.settled_through = 3).contains("`settled_through` is 3"));
    assert!(refuse(|f| f.observations[3] = f32::NAN).contains("`observations` holds NaN at index 3"));
    assert!(refuse(|f| f.rewards.truncate(5)).contains("`rewards` is 5 numbers long; expected 6"));
    assert!(refuse(|f| f.flags[0] = 3).contains("`flags` is 3"));
    assert!(refuse(|f| f.reward_terms[0].name = "a b".into()).contains("`reward_terms.name` is `a b`"));
    assert!(refuse(|f| f.episodes[0].return_sum = f64::INFINITY).contains("`episodes`"));
}

#[test]
fn oversized_fragments_are_refused_before_decoding() {
    let huge = Bytes::from(vec![0xff; FRAGMENT_BYTES_MAX + 1]);
    assert!(matches!(Fragment::decode(huge), Err(Malformed::TooLarge { .. })));
}

#[test]
fn many_empty_episodes_are_refused_before_decoding() {
    // Empty episodes: three bytes each, and forty once decoded.
    let episodes = [0x8a, 1, 0].repeat(FRAGMENT_BYTES_MAX / 3);
    let error = Fragment::decode(episodes).unwrap_err().to_string();
    assert!(error.contains("`episodes`") && error.contains("at most"), "{error}");
}

#[test]
fn many_empty_reward_terms_are_refused_before_decoding() {
    let terms = [0xca, 1, 0].repeat(FRAGMENT_BYTES_MAX / 3);
    let error = Fragment::decode(terms).unwrap_err().to_string();
    assert!(error.contains("`reward_terms` is") && error.contains("at most 64"), "{error}");
}

#[test]
fn the_incarnation_is_read_from_the_first_bytes() {
    let bytes = sample().encode().unwrap();
    assert_eq!(claimed_incarnation(&bytes[..16]), Some(7));
    assert_eq!(claimed_incarnation(&bytes[..6]), None);
    assert_eq!(claimed_incarnation(&[0xff; 64]), None);
    // A string in place of the number.
    assert_eq!(claimed_incarnation(&[0x1a, 1, b'x']), None);
}
