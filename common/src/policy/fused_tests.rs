//! Tests of the fused operation against Candle's own operations and autograd.

use candle_core::{Device, Var};

use super::*;
use crate::policy::plain;

fn wave(count: usize, step: f64) -> Vec<f32> {
    (0..count).map(|i| ((i as f64 + 1.0) * step).sin() as f32 * 0.6).collect()
}

fn pool(threads: usize) -> Option<Arc<ThreadPool>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    Some(Arc::new(pool))
}

/// Output and parameter gradient of `Σ output · c + Σ output²` with `c` different for every element.
fn run(forward: impl Fn(&Tensor, &Tensor) -> Result<Tensor>, shape: &NetworkShape, rows: usize) -> [Vec<f32>; 2] {
    let inner = || -> Result<[Vec<f32>; 2]> {
        let parameters = Var::from_vec(wave(shape.parameter_count(), 0.71), shape.parameter_count(), &Device::Cpu)?;
        let observations =
            Tensor::from_vec(wave(rows * shape.observation, 1.37), (rows, shape.observation), &Device::Cpu)?;
        let output = forward(&parameters, &observations)?;
        let weights = Tensor::from_vec(wave(output.elem_count(), 0.3), output.shape(), &Device::Cpu)?;
        let loss = ((&output * weights)? + output.sqr()?)?.mean_all()?;
        let gradients = loss.backward()?;
        let gradient = gradients.get(&parameters).expect("the parameters take part");
        Ok([output.flatten_all()?.to_vec1()?, gradient.to_vec1()?])
    };
    inner().expect("candle runs")
}

#[test]
fn output_and_gradient_are_those_of_candles_own_operations() {
    for (hidden, rows) in [(vec![16, 8], 33), (vec![4], 700), (vec![], 5), (vec![8, 8, 8], CHUNK_ROWS * LANES + 300)] {
        let shape = NetworkShape { observation: 7, action: 3, hidden };
        let networks = FusedNetworks::actor_critic(&shape, None);
        let fused = run(|p, x| networks.forward(p, x), &shape, rows);
        let plain = run(|p, x| plain::actor_critic(&shape, p, x), &shape, rows);
        for (fused, plain) in fused.iter().zip(&plain) {
            assert_eq!(fused.len(), plain.len());
            for (i, (a, b)) in fused.iter().zip(plain).enumerate() {
                assert!((a - b).abs() < 3e-5 * (1.0 + b.abs()), "{shape:?} {i}: {a} {b}");
            }
        }
        assert!(fused[1][shape.log_std()].iter().all(|g| *g == 0.0));
    }
}

#[test]
fn the_number_of_threads_does_not_change_one_bit() {
    let shape = NetworkShape { observation: 9, action: 4, hidden: vec![32, 16] };
    let rows = CHUNK_ROWS * (LANES + 3) + 17;
    let alone = FusedNetworks::actor_critic(&shape, None);
    let expected = run(|p, x| alone.forward(p, x), &shape, rows);
    for threads in [1, 2, 3, 7] {
        let networks = FusedNetworks::actor_critic(&shape, pool(threads));
        assert_eq!(run(|p, x| networks.forward(p, x), &shape, rows), expected, "{threads} threads");
    }
}

#[test]
fn reused_buffers_of_another_size_leave_no_trace() {
    let shape = NetworkShape { observation: 5, action: 2, hidden: vec![8] };
    let networks = FusedNetworks::actor_critic(&shape, None);
    let fresh = |rows| {
        let networks = FusedNetworks::actor_critic(&shape, None);
        run(|p, x| networks.forward(p, x), &shape, rows)
    };
    for rows in [3000, 10, 600, 1] {
        assert_eq!(run(|p, x| networks.forward(p, x), &shape, rows), fresh(rows), "{rows} rows");
    }
    assert_eq!(lock(&networks.inner.spare).len(), 1);
}

#[test]
fn two_forward_passes_before_one_backward_pass_do_not_disturb_each_other() -> Result<()> {
    let shape = NetworkShape { observation: 5, action: 2, hidden: vec![8] };
    let networks = FusedNetworks::actor_critic(&shape, None);
    let expected = run(|p, x| networks.forward(p, x), &shape, 20);
    let twice = run(
        |p, x| {
            let output = networks.forward(p, x)?;
            networks.forward(p, &(x * 3.0)?)?;
            Ok(output)
        },
        &shape,
        20,
    );
    assert_eq!(twice, expected);
    Ok(())
}

#[test]
fn tensors_of_another_shape_are_refused() -> Result<()> {
    let shape = NetworkShape { observation: 5, action: 2, hidden: vec![8] };
    let networks = FusedNetworks::actor_critic(&shape, None);
    let parameters = Tensor::zeros(shape.parameter_count(), candle_core::DType::F32, &Device::Cpu)?;
    let wrong = Tensor::zeros((4, 6), candle_core::DType::F32, &Device::Cpu)?;
    let text = networks.forward(&parameters, &wrong).expect_err("six numbers per row").to_string();
    assert!(text.contains("5 observations") && text.contains('6'), "{text}");
    Ok(())
}
