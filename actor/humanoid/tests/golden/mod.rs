//! Golden states with the observations of Gymnasium's environments, written by `make_states.py`.

use nalgebra::{Point3, Vector3};
use treadmill_humanoid::ContactForce;

const FILE: &[u8] = include_bytes!("states.bin");

/// State of the body, with the observations and contacts of MuJoCo and Gymnasium.
pub struct State {
    pub position: Vec<f64>,
    pub velocity: Vec<f64>,
    pub controls: Vec<f32>,
    pub v5: Vec<f32>,
    pub v4: Vec<f32>,
    pub tendon_length_rad: Vec<f64>,
    pub tendon_velocity_radps: Vec<f64>,
    pub contact_cost: f64,
    pub contacts: Vec<ContactForce>,
}

/// Reads numbers in order.
struct Reader(std::slice::Iter<'static, [u8; 4]>);

impl Reader {
    fn numbers(&mut self, count: usize) -> Vec<f32> {
        self.0.by_ref().take(count).map(|bytes| f32::from_le_bytes(*bytes)).collect()
    }

    fn doubles(&mut self, count: usize) -> Vec<f64> {
        self.numbers(count).into_iter().map(f64::from).collect()
    }

    fn contact(&mut self) -> ContactForce {
        let row = self.doubles(8);
        let link = |number: f64| (number >= 0.0).then_some(number as usize);
        ContactForce {
            links: [link(row[0]), link(row[1])],
            at_m: Point3::new(row[2], row[3], row[4]),
            force_n: Vector3::new(row[5], row[6], row[7]),
        }
    }
}

/// Returns all states of the file.
pub fn states() -> Vec<State> {
    assert_eq!(&FILE[..8], b"TMSTATES");
    let (words, rest) = FILE[8..].as_chunks::<4>();
    assert!(rest.is_empty());
    let sizes: Vec<usize> = words[..7].iter().map(|word| u32::from_le_bytes(*word) as usize).collect();
    let [states, nq, nv, nu, v5, v4, tendons] = sizes[..] else { unreachable!("seven sizes were read") };
    let mut reader = Reader(words[sizes.len()..].iter());
    let all = (0..states)
        .map(|_| State {
            position: reader.doubles(nq),
            velocity: reader.doubles(nv),
            controls: reader.numbers(nu),
            v5: reader.numbers(v5),
            v4: reader.numbers(v4),
            tendon_length_rad: reader.doubles(tendons),
            tendon_velocity_radps: reader.doubles(tendons),
            contact_cost: reader.doubles(1)[0],
            contacts: {
                let count = reader.numbers(1)[0] as usize;
                (0..count).map(|_| reader.contact()).collect()
            },
        })
        .collect();
    assert_eq!(reader.0.len(), 0, "the file is longer than its header says");
    all
}

/// Entry outside its tolerance.
#[derive(Debug)]
#[expect(dead_code, reason = "printed by failed assertions")]
pub struct Mismatch {
    pub state: usize,
    pub entry: usize,
    pub found: f32,
    pub expected: f32,
    pub tolerance: f32,
}

/// Compares rows entry by entry. The tolerance is 1e-3 of the entry's root mean square over all rows, or of its own size if
/// that is larger. An entry that is always zero must be zero.
pub fn compare(found: &[Vec<f32>], expected: &[&[f32]]) -> Result<(), Mismatch> {
    assert_eq!(found.len(), expected.len());
    let width = expected[0].len();
    for entry in 0..width {
        let squares: f64 = expected.iter().map(|row| f64::from(row[entry]).powi(2)).sum();
        let scale = (squares / expected.len() as f64).sqrt() as f32;
        for (state, (found, expected)) in found.iter().zip(expected).enumerate() {
            assert_eq!(found.len(), width);
            let tolerance = 1e-3 * scale.max(expected[entry].abs());
            let (found, expected) = (found[entry], expected[entry]);
            let is_close = (found - expected).abs() <= tolerance;
            if !is_close {
                return Err(Mismatch { state, entry, found, expected, tolerance });
            }
        }
    }
    Ok(())
}
