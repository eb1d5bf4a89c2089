//! Reflection of observations and actions, and even and odd parts of rows.

use serde::{Deserialize, Serialize};

/// For each entry of a mirrored row, the index and the sign, 1 or −1, of the original entry that it holds.
pub type Reflection = Vec<(usize, f32)>;

/// Reflection of observations and actions that exchanges left and right.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PolicyMirror {
    /// Reflection of an observation.
    pub observation: Reflection,
    /// Reflection of an action.
    pub action: Reflection,
}

/// Returns a reflection as it is sent: the number of each entry from 1, negative if its sign changes.
pub fn mirror_indices(reflection: &Reflection) -> Vec<i32> {
    reflection.iter().map(|(entry, sign)| if *sign < 0.0 { -1 - *entry as i32 } else { 1 + *entry as i32 }).collect()
}

impl PolicyMirror {
    /// Returns the mirror of [`mirror_indices`] that are not 0; none if there are no indices.
    pub fn of_indices(observation: &[i32], action: &[i32]) -> Option<Self> {
        let reflection = |indices: &[i32]| {
            indices.iter().map(|index| (index.unsigned_abs() as usize - 1, index.signum() as f32)).collect()
        };
        (!observation.is_empty() || !action.is_empty())
            .then(|| Self { observation: reflection(observation), action: reflection(action) })
    }
}

/// Coordinate of a row that its reflection keeps or negates: `row[entry] + coefficient · row[image]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    pub(crate) entry: usize,
    pub(crate) image: usize,
    /// 0 for an entry that is its own image.
    coefficient: f32,
}

impl Part {
    /// Returns the entries that the part consists of, and their coefficients.
    pub(crate) fn terms(self) -> impl Iterator<Item = (usize, f32)> + Clone {
        let count = if self.is_pair() { 2 } else { 1 };
        [(self.entry, 1.0), (self.image, self.coefficient)].into_iter().take(count)
    }

    pub(crate) fn is_pair(self) -> bool {
        self.coefficient != 0.0
    }
}

/// Parts of a row: the even ones, which its reflection keeps, then the odd ones, which it negates. There are as many as
/// entries.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Parts {
    pub(crate) even: Vec<Part>,
    pub(crate) odd: Vec<Part>,
}

impl Parts {
    /// Returns the parts under a reflection that is its own inverse.
    pub(crate) fn of(reflection: &[(usize, f32)]) -> Self {
        let (mut even, mut odd) = (Vec::new(), Vec::new());
        for (entry, (image, sign)) in reflection.iter().copied().enumerate() {
            if image == entry {
                let part = Part { entry, image, coefficient: 0.0 };
                if sign > 0.0 { even.push(part) } else { odd.push(part) }
            } else if entry < image {
                even.push(Part { entry, image, coefficient: sign });
                odd.push(Part { entry, image, coefficient: -sign });
            }
        }
        Self { even, odd }
    }

    /// Returns the parts of a hidden layer, whose halves the reflection exchanges.
    pub(crate) fn of_halves(width: usize) -> Self {
        let half = width / 2;
        let swapped: Reflection = (0..width).map(|unit| ((unit + half) % width, 1.0)).collect();
        Self::of(&swapped)
    }

    /// Returns the number of entries of a row.
    pub(crate) fn width(&self) -> usize {
        self.even.len() + self.odd.len()
    }

    /// Returns the length of a part of a row of length 1 in its direction, divided by the sum of its terms.
    pub(crate) fn share(&self, part: usize) -> f64 {
        let parts = self.even.iter().chain(&self.odd);
        let is_pair = parts.clone().nth(part).is_some_and(|part| part.is_pair());
        if is_pair { std::f64::consts::FRAC_1_SQRT_2 } else { 1.0 }
    }

    /// Replaces `parts` by the parts of `rows`; both are `[n, width]`.
    pub(crate) fn split(&self, rows: &[f32], parts: &mut [f32]) {
        let width = self.width().max(1);
        for (row, numbers) in rows.chunks_exact(width).zip(parts.chunks_exact_mut(width)) {
            let (even, odd) = numbers.split_at_mut(self.even.len());
            for (parts, numbers) in [(&self.even, even), (&self.odd, odd)] {
                for (part, number) in parts.iter().zip(numbers) {
                    *number = row[part.entry] + part.coefficient * row[part.image];
                }
            }
        }
    }

    /// Writes the rows that consist of `parts`: the transpose of [`Self::split`].
    pub(crate) fn join(&self, parts: &[f32], rows: &mut [f32]) {
        rows.fill(0.0);
        let width = self.width().max(1);
        for (numbers, row) in parts.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
            let (even, odd) = numbers.split_at(self.even.len());
            for (parts, numbers) in [(&self.even, even), (&self.odd, odd)] {
                for (part, number) in parts.iter().zip(numbers) {
                    row[part.entry] += number;
                    row[part.image] += part.coefficient * number;
                }
            }
        }
    }
}

/// Checks that a reflection has `size` entries and is its own inverse.
pub(crate) fn check(what: &str, reflection: &[(usize, f32)], size: usize) -> Result<(), String> {
    if reflection.len() != size {
        return Err(format!("the mirror image of an {what} has {} entries, expected {size}", reflection.len()));
    }
    let is_inverse = |(entry, (image, sign)): (usize, &(usize, f32))| {
        sign.abs() == 1.0 && reflection.get(*image).is_some_and(|back| *back == (entry, *sign))
    };
    match reflection.iter().enumerate().find(|pair| !is_inverse(*pair)) {
        None => Ok(()),
        Some((entry, (image, sign))) => Err(format!(
            "entry {entry} of the mirror image of an {what} is {sign} times entry {image}; the mirror image of the mirror \
             image must be the original"
        )),
    }
}
