//! Tests of exported policies.

use std::collections::HashMap;

use proptest::prelude::*;
use safetensors::tensor::{Dtype, TensorView, serialize};

use super::*;

fn sample() -> ExportedPolicy {
    let shape = NetworkShape { observation: 3, action: 2, hidden: vec![4], privileged: 0 };
    let mut moments = RunningMoments::new(3);
    moments.update(&[1.0, 2.0, 3.0, 3.0, 2.0, 7.0], 3);
    let (observation, mean, variance) = ObservationFacts::from_moments("compact", &moments, 10.0);
    ExportedPolicy {
        parameters: (0..shape.parameter_count()).map(|i| i as f32 * 0.25 - 3.0).collect(),
        shape,
        observation,
        mean,
        variance,
        action: ActionFacts { names: vec!["hip".into(), "knee".into()], low: vec![-0.4; 2], high: vec![0.4; 2] },
        returns: Some(ReturnFacts { count: 40.0, mean: 2.5, variance: 0.75 }),
        control_step_s: 0.015,
        settings: "[env]\nreset_noise_scale = 0.02\nhealthy_z_range = [1.0, inf]\n".into(),
        model_xml: "<mujoco/>".into(),
    }
}

/// Returns the sample's file with changed metadata.
fn with_metadata(change: impl Fn(&mut serde_json::Value)) -> Vec<u8> {
    let policy = sample();
    let bytes = policy.to_bytes().unwrap();
    let (_, header) = SafeTensors::read_metadata(&bytes).unwrap();
    let mut json = serde_json::from_str(&header.metadata().as_ref().unwrap()[METADATA_KEY]).unwrap();
    change(&mut json);
    let columns = [(MEAN, &policy.mean[..]), (VARIANCE, &policy.variance[..])];
    to_safetensors_with(&policy.shape, &policy.parameters, &columns, Some((METADATA_KEY, json.to_string())))
}

/// Returns the error of unusable bytes, with its causes.
fn refusal(bytes: &[u8]) -> String {
    treadmill_runtime::error_chain(&ExportedPolicy::from_bytes(bytes).expect_err("these bytes are unusable"))
}

#[test]
fn a_policy_survives_and_gives_the_same_bytes_every_time() {
    let bytes = sample().to_bytes().unwrap();
    assert_eq!(ExportedPolicy::from_bytes(&bytes).unwrap(), sample());
    for _ in 0..20 {
        assert_eq!(sample().to_bytes().unwrap(), bytes);
    }
}

#[test]
fn the_scale_of_values_is_kept_and_older_files_have_none() {
    let mut moments = RunningMoments::new(1);
    moments.update(&[1.0, 4.0, 4.0], 1);
    let facts = ReturnFacts::from_moments(&moments);
    assert_eq!((facts.count, facts.mean, facts.variance), (3.0, 3.0, 2.0));
    assert_eq!(facts.moments(), moments);
    let old = with_metadata(|m| drop(m.as_object_mut().unwrap().remove("returns")));
    assert_eq!(ExportedPolicy::from_bytes(&old).unwrap(), ExportedPolicy { returns: None, ..sample() });
}

#[test]
fn the_file_is_plain_safetensors_with_the_promised_names_and_shapes() {
    let bytes = sample().to_bytes().unwrap();
    let file = SafeTensors::deserialize(&bytes).unwrap();
    let mut tensors: Vec<_> = file.iter().map(|(name, view)| (name, view.dtype(), view.shape().to_vec())).collect();
    tensors.sort_by_key(|(name, ..)| *name);
    let wanted = [
        ("actor.0.bias", Dtype::F32, vec![4]),
        ("actor.0.weight", Dtype::F32, vec![4, 3]),
        ("actor.1.bias", Dtype::F32, vec![2]),
        ("actor.1.weight", Dtype::F32, vec![2, 4]),
        ("critic.0.bias", Dtype::F32, vec![4]),
        ("critic.0.weight", Dtype::F32, vec![4, 3]),
        ("critic.1.bias", Dtype::F32, vec![1]),
        ("critic.1.weight", Dtype::F32, vec![1, 4]),
        ("log_std", Dtype::F32, vec![2]),
        (MEAN, Dtype::F64, vec![3]),
        (VARIANCE, Dtype::F64, vec![3]),
    ];
    assert_eq!(tensors, wanted);
    let (_, header) = SafeTensors::read_metadata(&bytes).unwrap();
    let text = &header.metadata().as_ref().unwrap()[METADATA_KEY];
    assert!(text.starts_with(r#"{"format":1,"network":{"observation":3,"hidden":[4],"action":2,"activation":"elu"},"#));
    assert!(text.contains(r#""low":[-0.4,-0.4]"#), "{text}");
}

#[test]
fn the_normalisation_equals_that_of_the_run_bit_for_bit() {
    for rows in [300, 0] {
        let mut moments = RunningMoments::new(3);
        let numbers: Vec<f32> = (0..rows * 3).map(|i| (i as f32 * 0.37).sin() * 5.0 + 2.0).collect();
        moments.update(&numbers, 3);
        let (observation, mean, variance) = ObservationFacts::from_moments("compact", &moments, 7.0);
        let policy = ExportedPolicy { observation, mean, variance, ..sample() };
        assert_eq!(policy.normaliser(), Normaliser::from_moments(&moments, 7.0), "{rows} rows");
    }
}

#[test]
fn other_files_are_refused_with_their_kind() {
    let sound = sample().to_bytes().unwrap();
    for length in [0, 5, 40, sound.len() - 1] {
        assert!(refusal(&sound[..length]).contains("damaged or truncated"), "{length}");
    }
    assert!(refusal(b"TREADMILsome other file").contains("damaged or truncated"));
    assert!(refusal(&vec![0; BUNDLE_BYTES_MAX + 1]).contains("more than the"));
    let view = TensorView::new(Dtype::F32, vec![1], &[0, 0, 0, 0]).unwrap();
    for metadata in [None, Some(HashMap::from([("format".to_string(), "pt".to_string())]))] {
        assert!(refusal(&serialize([("w", view.clone())], metadata).unwrap()).contains("did not write it"));
    }
}

#[test]
fn invalid_metadata_is_named() {
    type Change = fn(&mut serde_json::Value);
    let cases: [(Change, &[&str]); 13] = [
        (|m| m["format"] = 2.into(), &["format 2", "reads format 1"]),
        (|m| *m = "text".into(), &["metadata", "cannot be read"]),
        (|m| m["network"]["activation"] = "tanh".into(), &["network.activation", "tanh", "elu"]),
        (|m| m["network"]["hidden"] = vec![4; 9].into(), &["network.hidden", "9 layers", "at most 8"]),
        (|m| m["network"]["hidden"] = vec![5000].into(), &["5000", "1 to 4096"]),
        (|m| m["network"]["hidden"] = vec![4096; 8].into(), &["parameters", "what fits"]),
        (|m| m["network"]["hidden"] = vec![7].into(), &["actor.0.weight", "[4, 3]", "[7, 3]"]),
        (|m| m["observation"]["size"] = 4.into(), &["observation.size", "is 4", "3"]),
        (|m| m["observation"]["clip"] = (-1.0).into(), &["observation", "clip"]),
        (|m| m["action"]["names"] = vec!["hip"].into(), &["action.names", "1 long", "2"]),
        (|m| m["action"]["low"] = vec![0.4, 0.4].into(), &["action.low", "0.4", "below action.high"]),
        (|m| m["returns"]["variance"] = (-1.0).into(), &["returns", "variance: -1.0", "at least 0"]),
        (|m| m["control_step_s"] = (-0.1).into(), &["control_step_s", "is -0.1", "at least 0"]),
    ];
    for (change, parts) in cases {
        let text = refusal(&with_metadata(change));
        assert!(parts.iter().all(|part| text.contains(part)), "{parts:?} in {text}");
    }
}

#[test]
fn numbers_that_are_not_finite_are_neither_written_nor_read() {
    let mut policy = sample();
    policy.parameters[5] = f32::NAN;
    assert!(matches!(policy.to_bytes(), Err(ExportedError::Parameters(ParameterError::NonFinite { .. }))));
    let columns = [(MEAN, &policy.mean[..]), (VARIANCE, &policy.variance[..])];
    let text = with_metadata(|_| ());
    let (_, header) = SafeTensors::read_metadata(&text).unwrap();
    let metadata = header.metadata().as_ref().unwrap()[METADATA_KEY].clone();
    let entry = Some((METADATA_KEY, metadata));
    let bytes = to_safetensors_with(&policy.shape, &policy.parameters, &columns, entry.clone());
    assert!(refusal(&bytes).contains("actor.0.weight") && refusal(&bytes).contains("index 5"), "{}", refusal(&bytes));

    let sound = sample();
    let columns = [(MEAN, &sound.mean[..]), (VARIANCE, &[1.0, f64::INFINITY, 1.0][..])];
    let bytes = to_safetensors_with(&sound.shape, &sound.parameters, &columns, entry);
    assert!(refusal(&bytes).contains("observation.variance"), "{}", refusal(&bytes));
}

proptest! {
    #[test]
    fn no_damage_makes_the_reader_panic(at in 0_usize..10_000, with in 1_u8.., cut in 0_usize..10_000) {
        let mut bytes = sample().to_bytes().unwrap();
        let length = bytes.len();
        bytes[at % length] ^= with;
        let _ = ExportedPolicy::from_bytes(&bytes);
        prop_assert!(ExportedPolicy::from_bytes(&bytes[..cut % length]).is_err());
    }
}
