//! Curve in one line of text.

/// Unicode blocks from low to high.
const BLOCKS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// ASCII characters from low to high.
const ASCII: [char; 8] = ['_', '.', ':', '-', '=', '+', '*', '#'];

/// Draws the values from first to last in at most `width` characters; each shows the mean of an equal share of the
/// values. The scale spans the lowest and the highest mean.
pub fn sparkline(values: &[f64], width: usize, is_unicode: bool) -> String {
    let values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    let width = width.min(values.len());
    let part = |index: usize| &values[index * values.len() / width..(index + 1) * values.len() / width];
    let means: Vec<f64> =
        (0..width).map(part).map(|part| part.iter().map(|value| value / part.len() as f64).sum()).collect();
    let (low, high) =
        means.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), mean| (low.min(*mean), high.max(*mean)));
    let characters = if is_unicode { BLOCKS } else { ASCII };
    let height = |mean: f64| if high > low { (mean / 8.0 - low / 8.0) / (high / 8.0 - low / 8.0) } else { 0.0 };
    means.into_iter().map(|mean| characters[((height(mean) * 8.0) as usize).min(7)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_proportional_to_values() {
        // In eighths of the range from 0 to 7, 3 is 3/7 of 8, so the fourth character.
        assert_eq!(sparkline(&[0.0, 3.0, 7.0], 10, true), "▁▄█");
        assert_eq!(sparkline(&[7.0, 3.0, 0.0], 10, false), "#-_");
        assert_eq!(sparkline(&[1.0, 1.0], 10, true), "▁▁");
    }

    #[test]
    fn many_values_are_averaged_and_non_finite_ones_omitted() {
        // Two halves: the means are 0.5 and 9.5.
        assert_eq!(sparkline(&[0.0, 1.0, 9.0, 10.0], 2, true), "▁█");
        assert_eq!(sparkline(&[f64::NAN, 0.0, f64::INFINITY, 2.0], 10, true), "▁█");
        assert_eq!(sparkline(&[], 10, true), "");
        assert_eq!(sparkline(&[1.0], 0, true), "");
        assert_eq!(sparkline(&[f64::MIN, f64::MAX], 2, true), "▁█");
    }
}
