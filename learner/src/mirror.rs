//! Left and right exchanged.

/// What a mirror makes of observations and actions.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// Of an observation.
    pub observation: Exchange,
    /// Of an action.
    pub action: Exchange,
}

/// For each number of a row, which number stands in its place in the mirror, and with which sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Exchange(pub Vec<(usize, f32)>);

impl Exchange {
    /// Each row in the mirror.
    pub fn apply(&self, rows: &[f32]) -> Vec<f32> {
        rows.chunks_exact(self.0.len()).flat_map(|row| self.0.iter().map(|(at, sign)| sign * row[*at])).collect()
    }
}
