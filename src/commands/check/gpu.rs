//! Diagnosis of a GPU: driver, memory, whether it computes what the processor does, and how long a gradient step takes.

use treadmill_config::PpoConfig;
use treadmill_ppo::{
    PpoOptions,
    device::{Device, DeviceKind, GpuError},
    settings,
};
use treadmill_runtime::{error_chain, machine::cores};

use crate::{
    commands::bench::{network, update},
    diagnosis::finding::Finding,
};

/// Rows of the gradient steps that are measured: few, as the presets have, and many if that is quick.
const MINIBATCHES: [u32; 2] = [512, 16_384];
/// Gradient steps of an update that is measured.
const STEPS: f64 = 20.0;
/// Duration of a measurement on a fast device, and the longest one on a slow device, in seconds.
const DURATION_S: f64 = 0.3;
const DURATION_MAX_S: f64 = 3.0;

/// Largest distance of the parameters after an update there from those here, relative to their length. An update changes
/// them by some hundredths.
const DISTANCE_MAX: f64 = 1e-3;

/// Finds the first GPU, and compares it with the processor. A machine needs none.
pub fn diagnose() -> Finding {
    let device = match DeviceKind::Cuda.open() {
        Ok(device) => device,
        Err(GpuError::NoDriver) => return Finding::ok("gpu", "no NVIDIA driver: updates run on the processor"),
        Err(why) => return Finding::note("gpu", error_chain(&why), "without it, updates run on the processor"),
    };
    let Device::Cuda(gpu, _) = &device else { return Finding::ok("gpu", "none") };
    let remedy = "check `nvidia-smi`, or train with --device cpu";
    // Free memory first, of which the updates take some.
    let measured = gpu.memory_bytes().map_err(anyhow::Error::from).and_then(|bytes| {
        let distance = distance(&device)?;
        anyhow::ensure!(
            distance <= DISTANCE_MAX,
            "an update there is {distance:.1e} away from the processor's, relative to its parameters"
        );
        Ok((bytes, steps_us(&device)?))
    });
    match measured {
        Ok(([free, all], steps)) => {
            let [free_mb, all_mb] = [free, all].map(|bytes| bytes / 1_000_000);
            Finding::ok("gpu", format!("{gpu}, {free_mb} of {all_mb} MB free; {}", steps.join("; ")))
        }
        Err(why) => Finding::problem("gpu", format!("{gpu}: {why:#}"), remedy),
    }
}

/// Returns how far the parameters after an update there are from those here, relative to their length. A NaN stays NaN.
fn distance(gpu: &Device) -> anyhow::Result<f64> {
    let after = |device: &Device| -> anyhow::Result<Vec<f32>> {
        let options = PpoOptions { device: device.clone(), ..PpoOptions::on_cpu(cores())? };
        Ok(update::measure(options, network::usual(), MINIBATCHES[0], 0)?.2.parameters().to_vec())
    };
    let (there, here) = (after(gpu)?, after(&Device::Cpu)?);
    let length = |numbers: &mut dyn Iterator<Item = f64>| numbers.map(|number| number * number).sum::<f64>().sqrt();
    let apart = length(&mut there.iter().zip(&here).map(|(there, here)| f64::from(there - here)));
    Ok(apart / length(&mut here.iter().copied().map(f64::from)))
}

/// Measures gradient steps. Returns a sentence for each number of rows.
fn steps_us(gpu: &Device) -> anyhow::Result<Vec<String>> {
    let mut sentences = Vec::new();
    let mut slowest_us = 0.0;
    for rows in MINIBATCHES {
        // Steps on more rows take at most as many times longer.
        if slowest_us * f64::from(rows / MINIBATCHES[0]) * STEPS > DURATION_MAX_S * 1e6 {
            break;
        }
        let (there, here) = (step_us(gpu, rows)?, step_us(&Device::Cpu, rows)?);
        slowest_us = there.max(here);
        sentences
            .push(format!("a gradient step on {rows} rows takes {there:.0} µs there, {here:.0} µs on the processor"));
    }
    Ok(sentences)
}

/// Returns the duration of a gradient step on so many rows, in microseconds.
fn step_us(device: &Device, rows: u32) -> anyhow::Result<f64> {
    let measure = |updates: u32| -> anyhow::Result<f64> {
        let config = PpoConfig { minibatch: rows, ..PpoConfig::default() };
        let chunk_rows = settings::chunk_rows(&config, cores()) as usize;
        let options = PpoOptions { device: device.clone(), chunk_rows, ..PpoOptions::on_cpu(cores())? };
        let (_, samples_per_s, _) = update::measure(options, network::usual(), rows, updates)?;
        Ok(1e6 * f64::from(rows) / samples_per_s)
    };
    let rough_us = measure(1)?;
    match (DURATION_S * 1e6 / (STEPS * rough_us)) as u32 {
        0 => Ok(rough_us),
        updates => measure(updates),
    }
}
