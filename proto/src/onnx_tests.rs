use std::collections::HashMap;

use super::*;

/// Runs the graph on one observation.
fn run(model: &[u8], observation: &[f32]) -> Vec<f32> {
    let graph = wire::ModelProto::decode(model).unwrap().graph.unwrap();
    let numbers =
        |tensor: &wire::TensorProto| planes::from_bytes("x", &tensor.raw_data, tensor.raw_data.len() / 4).unwrap();
    let mut known: HashMap<String, Vec<f32>> =
        graph.initializer.iter().map(|tensor| (tensor.name.clone(), numbers(tensor))).collect();
    for tensor in &graph.initializer {
        let numbers = tensor.raw_data.len() / if tensor.data_type == INT64 { 8 } else { 4 };
        assert_eq!(tensor.dims.iter().product::<i64>() as usize, numbers, "{}", tensor.name);
    }
    known.insert(graph.input[0].name.clone(), observation.to_vec());
    for node in &graph.node {
        let of: Vec<&Vec<f32>> = node.input.iter().map(|name| &known[name]).collect();
        let both = |f: fn(f32, f32) -> f32| of[0].iter().zip(of[1]).map(|(one, other)| f(*one, *other)).collect();
        let result: Vec<f32> = match node.op_type.as_str() {
            "Sub" => both(|one, other| one - other),
            "Mul" => both(|one, other| one * other),
            "Add" => both(|one, other| one + other),
            // As the runtimes that turn NaN into a bound.
            "Clip" => of[0].iter().map(|x| x.max(of[1][0]).min(of[2][0])).collect(),
            "ReduceSum" => {
                assert_eq!((node.attribute[0].name.as_str(), node.attribute[0].i), ("keepdims", 1));
                vec![of[0].iter().sum(); of[0].len().min(1)]
            }
            "Elu" => of[0].iter().map(|x| if *x > 0.0 { *x } else { x.exp() - 1.0 }).collect(),
            "Gemm" => {
                assert_eq!((node.attribute[0].name.as_str(), node.attribute[0].i), ("transB", 1));
                let rows = of[1].chunks(of[0].len());
                rows.zip(of[2])
                    .map(|(row, bias)| row.iter().zip(of[0]).map(|(w, x)| w * x).sum::<f32>() + bias)
                    .collect()
            }
            other => panic!("unexpected operator {other}"),
        };
        known.insert(node.output[0].clone(), result);
    }
    known.remove(&graph.output[0].name).unwrap()
}

#[test]
fn actions_match_a_hand_computation() {
    let policy = OnnxPolicy {
        mean: &[1.0, 2.0],
        inverse_std: &[0.5, 2.0],
        clip: 3.0,
        layers: vec![
            Layer { weight: &[1.0, 0.0, 0.0, -1.0], bias: &[0.0, 0.5] },
            Layer { weight: &[0.25, 0.5], bias: &[0.1] },
        ],
        low: &[-0.2],
        high: &[0.6],
        ports: Ports::ANY_BATCH,
        motion: None,
        offset: None,
        doc: "c",
        metadata: vec![("treadmill.a".into(), "b".into())],
    };
    let model = policy.encode();
    assert_eq!(model, policy.encode());
    // (3 − 1) · 0.5 = 1; (10 − 2) · 2 = 16, clipped to 3. Hidden: 1, and ELU(−3 + 0.5) = e^−2.5 − 1 = −0.917915.
    // 0.25 − 0.458958 + 0.1 = −0.108958, in a range with centre 0.2 and half width 0.4.
    let action = run(&model, &[3.0, 10.0]);
    assert!((action[0] - (0.2 - 0.108_958 * 0.4)).abs() < 1e-6, "{action:?}");
    // Beyond both bounds. Hidden: 3, and 3 + 0.5 = 3.5; 0.75 + 1.75 + 0.1 = 2.6, clipped to 1.
    assert_eq!(run(&model, &[100.0, -100.0]), [0.6]);
    assert!(run(&model, &[f32::NAN, 10.0])[0].is_nan() && run(&model, &[3.0, f32::INFINITY])[0].is_nan());
    let read = wire::ModelProto::decode(&model[..]).unwrap();
    assert_eq!((read.opset_import[0].version, read.metadata_props[0].value.as_str()), (OPERATORS, "b"));
    let dims = &read.graph.unwrap().input[0].r#type.clone().unwrap().tensor_type.unwrap().shape.unwrap().dim;
    use wire::tensor_shape_proto::dimension::Value;
    assert_eq!(dims[0].value, Some(Value::DimParam("batch".into())));
    assert_eq!(dims[1].value, Some(Value::DimValue(2)));
    let fixed = OnnxPolicy { ports: Ports::UNITREE, ..policy }.encode();
    assert_eq!(run(&fixed, &[100.0, -100.0]), [0.6]);
    let graph = wire::ModelProto::decode(&fixed[..]).unwrap().graph.unwrap();
    assert_eq!([&graph.input[0].name, &graph.output[0].name], ["obs", "actions"]);
    let dims = &graph.input[0].r#type.clone().unwrap().tensor_type.unwrap().shape.unwrap().dim;
    assert_eq!(dims[0].value, Some(Value::DimValue(1)));
}
