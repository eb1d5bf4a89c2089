//! Plays an exported policy without any code of this project: reads one observation per line and writes one action per line,
//! both as JSON lists.
//!
//! ```sh
//! treadmill export runs/walk-1 --safetensors policy.safetensors
//! cargo run --release --example play_policy policy.safetensors < observations.jsonl
//! ```
#![allow(clippy::print_stdout, reason = "the program's output")]

use std::{env, error::Error, fs, io};

use safetensors::{Dtype, SafeTensors};
use serde_json::Value;

fn main() -> Result<(), Box<dyn Error>> {
    let bytes = fs::read(env::args().nth(1).ok_or("usage: play_policy POLICY.safetensors")?)?;
    let (_, head) = SafeTensors::read_metadata(&bytes)?;
    let facts: Value = serde_json::from_str(&head.metadata().as_ref().ok_or("no metadata")?["treadmill"])?;
    let tensors = SafeTensors::deserialize(&bytes)?;
    let numbers = |name: &str| -> Result<Vec<f64>, Box<dyn Error>> {
        let tensor = tensors.tensor(name)?;
        Ok(match tensor.dtype() {
            Dtype::F64 => tensor.data().as_chunks().0.iter().map(|number| f64::from_le_bytes(*number)).collect(),
            _ => tensor.data().as_chunks().0.iter().map(|number| f32::from_le_bytes(*number).into()).collect(),
        })
    };
    let fact = |name: &str| facts["observation"][name].as_f64().ok_or("incomplete metadata");
    let (clip, epsilon) = (fact("clip")?, fact("variance_epsilon")?);
    let (mean, variance) = (numbers("observation.mean")?, numbers("observation.variance")?);
    let hidden = facts["network"]["hidden"].as_array().map_or(0, Vec::len);
    let layer = |index| Ok((numbers(&format!("actor.{index}.weight"))?, numbers(&format!("actor.{index}.bias"))?));
    let layers = (0..=hidden).map(layer).collect::<Result<Vec<_>, Box<dyn Error>>>()?;
    let ends = |name: &str| serde_json::from_value::<Vec<f64>>(facts["action"][name].clone());
    let (low, high) = (ends("low")?, ends("high")?);
    for line in io::stdin().lines() {
        let mut x: Vec<f64> = serde_json::from_str(&line?)?;
        for (x, (mean, variance)) in x.iter_mut().zip(mean.iter().zip(&variance)) {
            *x = ((*x - mean) / (variance + epsilon).sqrt()).clamp(-clip, clip);
        }
        for (index, (weight, bias)) in layers.iter().enumerate() {
            let dot = |row: &[f64]| row.iter().zip(&x).map(|(w, x)| w * x).sum::<f64>();
            let y: Vec<f64> = weight.chunks(x.len()).zip(bias).map(|(row, bias)| dot(row) + bias).collect();
            let elu = |y: f64| if index < hidden && y < 0.0 { y.exp_m1() } else { y };
            x = y.into_iter().map(elu).collect();
        }
        // −1 is the low end of a motor's range, 1 the high one.
        let stretch =
            |(share, (low, high)): (f64, (&f64, &f64))| low + (share.clamp(-1.0, 1.0) + 1.0) / 2.0 * (high - low);
        println!("{}", Value::from(x.into_iter().zip(low.iter().zip(&high)).map(stretch).collect::<Vec<_>>()));
    }
    Ok(())
}
