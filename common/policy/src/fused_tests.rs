//! Tests of the fused operation against Candle's own operations and autograd.

use candle_core::{Device, Var};

use super::*;
use crate::{kernel::tests::exact_output, plain};

fn wave(count: usize, step: f64) -> Vec<f32> {
    (0..count).map(|i| ((i as f64 + 1.0) * step).sin() as f32 * 0.6).collect()
}

fn pool(threads: usize) -> Option<Arc<ThreadPool>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    Some(Arc::new(pool))
}

fn actor_critic(shape: &NetworkShape, pool: Option<Arc<ThreadPool>>) -> FusedNetworks {
    FusedNetworks::new(shape, NetworkPart::ActorCritic, pool)
}

/// Returns parameters that keep the outputs of wide layers near 1.
fn parameters(shape: &NetworkShape) -> Vec<f32> {
    let widest = shape.hidden.iter().copied().max().unwrap_or(1).max(shape.observation);
    let scale = (16.0 / widest as f32).sqrt().min(1.0);
    wave(shape.parameter_count(), 0.71).iter().map(|p| p * scale).collect()
}

/// Returns the networks of the presets, for the compact and Gymnasium's observation.
fn shapes_in_use() -> [NetworkShape; 2] {
    [(45, vec![256, 128]), (348, vec![512, 256])].map(|(observation, hidden)| NetworkShape {
        observation,
        action: 17,
        hidden,
        privileged: 0,
    })
}

/// Returns output and parameter gradient of `Σ output · c + Σ output²` with `c` different for every element.
fn run(forward: impl Fn(&Tensor, &Tensor) -> Result<Tensor>, shape: &NetworkShape, rows: usize) -> [Vec<f32>; 2] {
    let inner = || -> Result<[Vec<f32>; 2]> {
        let parameters = Var::from_vec(parameters(shape), shape.parameter_count(), &Device::Cpu)?;
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
fn output_and_gradient_agree_with_candles_operations() {
    let small = [(vec![16, 8], 33), (vec![4], 700), (vec![], 5), (vec![8, 8, 8], CHUNK_ROWS * LANES_MIN + 300)]
        .map(|(hidden, rows)| (NetworkShape { observation: 7, action: 3, hidden, privileged: 0 }, rows));
    for (shape, rows) in small.into_iter().chain(shapes_in_use().map(|shape| (shape, CHUNK_ROWS + 30))) {
        let networks = actor_critic(&shape, None);
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

/// Returns `Σ c · output` of both networks in f64.
fn weighted_output(shape: &NetworkShape, parameters: &[f64], observations: &[f64], weights: &[f64]) -> f64 {
    let rows = observations.chunks_exact(shape.observation);
    let outputs = rows
        .flat_map(|row| [shape.actor(), shape.critic()].map(|layers| exact_output(&layers, parameters, row)).concat());
    outputs.zip(weights).map(|(output, weight)| output * weight).sum()
}

#[test]
fn the_gradient_of_actor_and_critic_agrees_with_finite_differences() -> Result<()> {
    const ROWS: usize = 3;
    for shape in shapes_in_use() {
        let (numbers, seen) = (parameters(&shape), wave(ROWS * shape.observation, 1.37));
        let weights = wave(ROWS * (shape.action + 1), 2.1);
        let leaf = Var::from_slice(&numbers, numbers.len(), &Device::Cpu)?;
        let observations = Tensor::from_slice(&seen, (ROWS, shape.observation), &Device::Cpu)?;
        let output = actor_critic(&shape, None).forward(&leaf, &observations)?;
        let loss = (output * Tensor::from_slice(&weights, (ROWS, shape.action + 1), &Device::Cpu)?)?.sum_all()?;
        let gradient = loss.backward()?.get(&leaf).expect("the parameters take part").to_vec1::<f32>()?;

        let wide = |numbers: &[f32]| numbers.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
        let (mut p, x, c) = (wide(&numbers), wide(&seen), wide(&weights));
        let exact = weighted_output(&shape, &p, &x, &c);
        assert!((f64::from(loss.to_scalar::<f32>()?) - exact).abs() < 1e-4, "{shape:?}");
        for tensor in shape.tensors() {
            let (range, mut largest) = (tensor.range(), 0.0_f64);
            for i in [range.start, range.start + range.len() / 2, range.end - 1] {
                let centre = p[i];
                p[i] = centre + 1e-5;
                let above = weighted_output(&shape, &p, &x, &c);
                p[i] = centre - 1e-5;
                let below = weighted_output(&shape, &p, &x, &c);
                p[i] = centre;
                let (found, expected) = (f64::from(gradient[i]), (above - below) / 2e-5);
                assert!(
                    (found - expected).abs() < 1e-4 * expected.abs().max(0.1),
                    "{}: {found} {expected}",
                    tensor.name
                );
                largest = largest.max(expected.abs());
            }
            assert!(tensor.name == "log_std" || largest > 1e-4, "{} takes part: {largest}", tensor.name);
        }
    }
    Ok(())
}

#[test]
fn actor_and_critic_alone_agree_with_both_together() -> Result<()> {
    for shape in shapes_in_use() {
        let rows = CHUNK_ROWS + 5;
        let numbers = Tensor::new(parameters(&shape), &Device::Cpu)?;
        let observations =
            Tensor::from_vec(wave(rows * shape.observation, 1.37), (rows, shape.observation), &Device::Cpu)?;
        let both = actor_critic(&shape, None).forward(&numbers, &observations)?;
        for (part, start) in [(NetworkPart::Actor, 0), (NetworkPart::Critic, shape.action)] {
            let alone = FusedNetworks::new(&shape, part, None).forward(&numbers, &observations)?;
            let together = both.narrow(1, start, alone.dim(1)?)?;
            let largest = (together - alone)?.abs()?.max_all()?.to_scalar::<f32>()?;
            assert!(largest < 1e-5, "{shape:?}: {largest}");
        }
    }
    Ok(())
}

#[test]
fn the_number_of_threads_does_not_change_one_bit() {
    let shape = NetworkShape { observation: 9, action: 4, hidden: vec![32, 16], privileged: 0 };
    let rows = CHUNK_ROWS * (LANES_MIN + 3) + 17;
    let alone = actor_critic(&shape, None);
    let expected = run(|p, x| alone.forward(p, x), &shape, rows);
    for threads in [1, 2, 3, 7] {
        let networks = actor_critic(&shape, pool(threads));
        assert_eq!(run(|p, x| networks.forward(p, x), &shape, rows), expected, "{threads} threads");
    }
}

#[test]
fn every_chunk_has_its_own_lane_while_memory_allows() {
    let [default, gymnasium] = shapes_in_use().map(|shape| actor_critic(&shape, None));
    for chunks in [1, 4, 8, 32, 93] {
        assert_eq!(default.inner.lanes(chunks), chunks);
    }
    let (default, gymnasium) = (default.inner.lanes(100_000), gymnasium.inner.lanes(100_000));
    assert_eq!((default, gymnasium), (93, 29));
    let huge = NetworkShape { observation: 4096, action: 17, hidden: vec![4096; 4], privileged: 0 };
    assert_eq!(actor_critic(&huge, None).inner.lanes(100_000), LANES_MIN);
}

#[test]
fn chunks_that_share_a_lane_give_the_gradient_of_candles_operations() {
    // So large that the memory of lanes is for the fewest.
    let shape = NetworkShape { observation: 2, action: 1, hidden: vec![1100, 1500], privileged: 0 };
    let networks = actor_critic(&shape, pool(2));
    let rows = CHUNK_ROWS * (LANES_MIN + 1) + 9;
    assert!(networks.inner.lanes(rows.div_ceil(CHUNK_ROWS)) < rows.div_ceil(CHUNK_ROWS));
    let fused = run(|p, x| networks.forward(p, x), &shape, rows);
    let plain = run(|p, x| plain::actor_critic(&shape, p, x), &shape, rows);
    for (i, (a, b)) in fused[1].iter().zip(&plain[1]).enumerate() {
        assert!((a - b).abs() < 3e-5 * (1.0 + b.abs()), "{i}: {a} {b}");
    }
}

#[test]
fn reused_buffers_of_another_size_do_not_change_results() {
    let shape = NetworkShape { observation: 5, action: 2, hidden: vec![8], privileged: 0 };
    let networks = actor_critic(&shape, None);
    let fresh = |rows| {
        let networks = actor_critic(&shape, None);
        run(|p, x| networks.forward(p, x), &shape, rows)
    };
    for rows in [3000, 10, 600, 1] {
        assert_eq!(run(|p, x| networks.forward(p, x), &shape, rows), fresh(rows), "{rows} rows");
    }
    assert_eq!(lock(&networks.inner.spare).len(), 1);
}

#[test]
fn two_forward_passes_before_one_backward_pass_do_not_disturb_each_other() -> Result<()> {
    let shape = NetworkShape { observation: 5, action: 2, hidden: vec![8], privileged: 0 };
    let networks = actor_critic(&shape, None);
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
    let shape = NetworkShape { observation: 5, action: 2, hidden: vec![8], privileged: 0 };
    let networks = actor_critic(&shape, None);
    let parameters = Tensor::zeros(shape.parameter_count(), candle_core::DType::F32, &Device::Cpu)?;
    let wrong = Tensor::zeros((4, 6), candle_core::DType::F32, &Device::Cpu)?;
    let text = networks.forward(&parameters, &wrong).expect_err("six numbers per row").to_string();
    assert!(text.contains("5 observations") && text.contains('6'), "{text}");
    Ok(())
}
