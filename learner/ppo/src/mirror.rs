//! Swaps left and right in observations and actions.

/// Mirror of observations and actions, for `ppo.symmetry`.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchMirror {
    /// Swaps the entries of an observation.
    pub observation: IndexSwap,
    /// Swaps the entries of an action.
    pub action: IndexSwap,
}

/// Index and sign of the entry that replaces each entry of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexSwap(pub Vec<(usize, f32)>);

impl IndexSwap {
    /// Returns every row with its entries swapped.
    pub fn apply(&self, rows: &[f32]) -> Vec<f32> {
        rows.chunks_exact(self.0.len()).flat_map(|row| self.0.iter().map(|(at, sign)| sign * row[*at])).collect()
    }
}
