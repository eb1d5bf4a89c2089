//! Networks of benchmarks and their inputs.

use std::str::FromStr;

use clap::ValueEnum;
use rand_distr::{Distribution, StandardNormal};
use treadmill_policy::{NetworkShape, Networks, PolicyMirror};
use treadmill_runtime::seeds;

use crate::launch::exit_code::Usage;

/// Actions of the humanoid.
const ACTIONS: usize = 17;
/// Largest width of a layer or an observation.
const WIDTH_MAX: usize = 4096;

/// Networks to measure.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum BenchSymmetry {
    /// Dense networks.
    Off,
    /// Networks that act mirrored in mirrored states.
    Equivariant,
}

/// Widths of the observation and of each hidden layer, as in `45-256-128`.
#[derive(Clone, Debug, PartialEq)]
pub struct Widths(Vec<usize>);

impl FromStr for Widths {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = format!("2 to 9 widths from 1 to {WIDTH_MAX}, observation first, as in 45-256-128");
        let width = |part: &str| part.parse().ok().filter(|width| (1..=WIDTH_MAX).contains(width));
        let widths: Option<Vec<usize>> = text.split('-').map(width).collect();
        widths.filter(|widths| (2..=9).contains(&widths.len())).map(Self).ok_or(expected)
    }
}

impl std::fmt::Display for Widths {
    fn fmt(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        let widths: Vec<String> = self.0.iter().map(usize::to_string).collect();
        formatter.write_str(&widths.join("-"))
    }
}

impl Widths {
    /// Returns networks of these widths with the humanoid's actions.
    pub fn shape(&self) -> NetworkShape {
        NetworkShape { observation: self.0[0], action: ACTIONS, hidden: self.0[1..].to_vec(), privileged: 0 }
    }

    /// Returns dense networks of these widths, or equivariant ones under a mirror that reverses the order of entries.
    pub fn networks(&self, symmetry: BenchSymmetry) -> Result<Networks, Usage> {
        let reversed = |size: usize| (0..size).rev().map(|entry| (entry, 1.0)).collect();
        let mirror = match symmetry {
            BenchSymmetry::Off => None,
            BenchSymmetry::Equivariant => {
                Some(PolicyMirror { observation: reversed(self.0[0]), action: reversed(ACTIONS) })
            }
        };
        Networks::new(self.shape(), mirror).map_err(|why| Usage(format!("{why}; use --symmetry off")))
    }
}

/// Returns the networks that `bench update` measures by default.
pub fn usual() -> Networks {
    let widths: Widths = "45-256-128".parse().expect("they are widths");
    widths.networks(BenchSymmetry::Equivariant).expect("the widths are even")
}

/// Draws standard normal numbers.
pub fn normals(count: usize, random: &mut seeds::Stream) -> Vec<f32> {
    (0..count).map(|_| StandardNormal.sample(random)).collect()
}

/// Returns the checksum of numbers as text.
pub fn checksum(numbers: &[f32]) -> String {
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    format!("{:016x}", seeds::checksum(&[&bytes]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_parsed_and_printed_alike() {
        for text in ["45-256-128", "348-512-256", "1-1", "376-512-256-128"] {
            assert_eq!(text.parse::<Widths>().expect("widths").to_string(), text);
        }
        let shape = "348-512-256".parse::<Widths>().expect("widths").shape();
        assert_eq!(shape, NetworkShape { observation: 348, action: 17, hidden: vec![512, 256], privileged: 0 });
    }

    #[test]
    fn invalid_widths_are_refused() {
        for text in ["", "45", "45-", "-45-256", "45-0", "45-4097", "45x256", "45-2.5", "1-1-1-1-1-1-1-1-1-1"] {
            assert!(text.parse::<Widths>().expect_err(text).contains("45-256-128"));
        }
    }
}
