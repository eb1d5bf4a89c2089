//! Scalars as text: a boxed table for a terminal, one line for a log file.

use console::measure_text_width;

use super::{Scalars, catalogue::MetricRow};

/// Indentation of a name below its group's heading.
const INDENT: &str = "   ";

/// Significant digits of a number with a fraction.
const SIGNIFICANT_DIGITS: i32 = 4;

/// Numbers from here on are written with an exponent.
const PLAIN_BELOW: f64 = 1e15;

/// Numbers below this are written with an exponent.
const PLAIN_FROM: f64 = 1e-4;

/// Returns the most important metrics, in their own order: errors instead of distances where the task has commands or
/// motions.
pub fn important(scalars: &Scalars) -> Vec<(String, f64)> {
    let has = |wanted: &str| scalars.iter().any(|(tag, _)| tag == wanted);
    let (is_commanded, is_imitating) = (has("eval/velocity_error"), has("eval/done_share"));
    let is_important = |tag: &str| MetricRow::of(tag).is_some_and(|row| row.is_important);
    let is_of_walkers = |tag: &str| tag.contains("distance") && (is_commanded || is_imitating);
    let is_of_commands = |tag: &str| tag.ends_with("_error") && tag != "eval/body_error" && is_imitating;
    let shown = |tag: &str| is_important(tag) && !is_of_walkers(tag) && !is_of_commands(tag);
    scalars.iter().filter(|(tag, _)| shown(tag)).cloned().collect()
}

/// Returns a boxed table with two columns and one block per group, the part of a tag before its first `/`. Groups, and
/// the names in each, keep their order. Every line ends in a newline.
pub fn render_table(scalars: &Scalars) -> String {
    let rows = rows(scalars);
    let width = |column: fn(&Row) -> &str| rows.iter().map(|row| measure_text_width(column(row))).max().unwrap_or(0);
    let (names, values) = (width(|row| &row.0), width(|row| &row.1));

    // `| ` before, ` | ` between and ` |` after the columns.
    let rule = format!("{}\n", "-".repeat(names + values + 7));
    let mut table = rule.clone();
    for (name, value) in &rows {
        table.push_str(&format!("| {} | {} |\n", padded(name, names), padded(value, values)));
    }
    table.push_str(&rule);
    table
}

/// Returns one line without a newline: `steps=81920 rollout/ep_rew_mean=123.4 …`.
pub fn render_line(env_steps: u64, scalars: &Scalars) -> String {
    let mut line = format!("steps={env_steps}");
    for (tag, value) in scalars {
        line.push_str(&format!(" {tag}={}", format_number(*value)));
    }
    line
}

/// Formats a number with four significant digits; whole numbers in full; very small and large numbers with an exponent.
pub fn format_number(value: f64) -> String {
    if value.is_nan() {
        return "nan".to_string();
    }
    if value.is_infinite() {
        return if value > 0.0 { "inf" } else { "-inf" }.to_string();
    }
    let size = value.abs();
    if size < PLAIN_BELOW && value.fract() == 0.0 {
        // Adding zero turns -0 into 0.
        return format!("{:.0}", value + 0.0);
    }
    // The exponent after rounding: for 9.99996 that of 10.
    let scientific = format!("{value:.*e}", (SIGNIFICANT_DIGITS - 1) as usize);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    if !(PLAIN_FROM..PLAIN_BELOW).contains(&size) {
        return format!("{}e{exponent}", without_trailing_zeros(mantissa));
    }
    let decimals = SIGNIFICANT_DIGITS - 1 - exponent.parse::<i32>().unwrap_or(0);
    let fixed = format!("{value:.*}", decimals.max(0) as usize);
    without_trailing_zeros(&fixed).to_string()
}

/// Name and value as shown; a heading has no value.
type Row = (String, String);

fn rows(scalars: &Scalars) -> Vec<Row> {
    let mut groups: Vec<(&str, Vec<Row>)> = Vec::new();
    for (tag, value) in scalars {
        let (group, name) = tag.split_once('/').unwrap_or(("", tag));
        let indent = if group.is_empty() { "" } else { INDENT };
        let row = (format!("{indent}{name}"), format_number(*value));
        match groups.iter_mut().find(|(known, _)| *known == group) {
            Some((_, rows)) => rows.push(row),
            None => groups.push((group, vec![row])),
        }
    }
    let heading = |group: &str| (!group.is_empty()).then(|| (format!("{group}/"), String::new()));
    groups.into_iter().flat_map(|(group, rows)| heading(group).into_iter().chain(rows)).collect()
}

fn padded(text: &str, width: usize) -> String {
    format!("{text}{}", " ".repeat(width - measure_text_width(text)))
}

fn without_trailing_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scalars(values: &[(&str, f64)]) -> Vec<(String, f64)> {
        values.iter().map(|(tag, value)| (tag.to_string(), *value)).collect()
    }

    #[test]
    fn numbers_have_four_significant_digits() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (123.456, "123.5"),
            (-1.234567, "-1.235"),
            (0.000_3, "0.0003"),
            (0.012_345_6, "0.01235"),
            (9.999_96, "10"),
            (99_999.5, "100000"),
            (12_345.67, "12346"),
            (0.000_099_999_9, "1e-4"),
            (0.000_012_345, "1.234e-5"),
            (-2.5e17, "-2.5e17"),
            (1e300, "1e300"),
            (10_000_000.0, "10000000"),
            (81_920.0, "81920"),
            (100.0, "100"),
            (f64::NAN, "nan"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::MIN_POSITIVE, "2.225e-308"),
        ];
        for (value, text) in cases {
            assert_eq!(format_number(value), text, "{value:e}");
        }
    }

    #[test]
    fn a_table_of_important_metrics_fits_a_small_terminal() {
        let all: Vec<(String, f64)> =
            crate::metrics::catalogue::METRICS.iter().map(|row| (row.tag.to_string(), 1.5)).collect();
        // Of imitators, of robots with commands, and of walkers.
        let without =
            |tags: &[&str]| all.iter().filter(|(tag, _)| !tags.contains(&tag.as_str())).cloned().collect::<Vec<_>>();
        let of_motions = ["eval/done_share", "eval/body_error"];
        let of_others = [&of_motions[..], &["eval/velocity_error", "eval/yaw_rate_error"]].concat();
        for all in [all.clone(), without(&of_motions), without(&of_others)] {
            let table = render_table(&important(&all));
            assert!(table.lines().count() <= 25 && !table.contains("accepted_mb"), "{table}");
        }
    }

    #[test]
    fn errors_stand_for_distances_where_the_task_has_commands() {
        let tags = ["rollout/distance_mean_m", "eval/velocity_error", "eval/distance_mean_m"];
        let all: Vec<(String, f64)> = tags.iter().map(|tag| (tag.to_string(), 1.5)).collect();
        let shown = |scalars| important(scalars).into_iter().map(|(tag, _)| tag).collect::<Vec<_>>();
        assert_eq!(shown(&all), ["eval/velocity_error"]);
        assert_eq!(shown(&all[..1]), ["rollout/distance_mean_m"]);
    }

    #[test]
    fn a_table_is_grouped_by_the_part_before_the_slash() {
        let table = render_table(&scalars(&[
            ("rollout/ep_rew_mean", 123.456),
            ("time/total_timesteps", 81_920.0),
            ("rollout/ep_len_mean", f64::NAN),
        ]));
        assert_eq!(
            table,
            "------------------------------\n\
             | rollout/           |       |\n\
             |    ep_rew_mean     | 123.5 |\n\
             |    ep_len_mean     | nan   |\n\
             | time/              |       |\n\
             |    total_timesteps | 81920 |\n\
             ------------------------------\n"
        );
    }

    #[test]
    fn unusual_tags_and_empty_tables_are_rendered() {
        assert_eq!(render_table(&[]), "-------\n-------\n");
        let table = render_table(&scalars(&[("loose", 1.0), ("größe/höhe", 2.0), ("a/b/c", 3.0)]));
        assert_eq!(
            table,
            "---------------\n\
             | loose   | 1 |\n\
             | größe/  |   |\n\
             |    höhe | 2 |\n\
             | a/      |   |\n\
             |    b/c  | 3 |\n\
             ---------------\n"
        );
    }

    #[test]
    fn a_line_keeps_whole_tags() {
        assert_eq!(render_line(7, &[]), "steps=7");
        assert_eq!(
            render_line(81_920, &scalars(&[("rollout/ep_rew_mean", 1.5), ("train/value_loss", f64::NAN)])),
            "steps=81920 rollout/ep_rew_mean=1.5 train/value_loss=nan"
        );
    }
}
