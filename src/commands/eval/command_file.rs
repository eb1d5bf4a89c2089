//! Commands that every episode follows, from a CSV file.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

use crate::launch::exit_code::Usage;

/// Names of a line's values.
const COLUMNS: [&str; 4] = ["time_s", "vx", "vy", "yaw_rate"];
/// Most lines with a command.
const LINES_MAX: usize = 10_000;
/// Largest file that is read (bytes).
const BYTES_MAX: u64 = 4 << 20;
/// Largest velocity (m/s) and yaw rate (rad/s).
const COMMAND_MAX: f64 = 5.0;
/// Time by which a control step may begin before a line that it follows (s), for the rounding of times.
const EARLY_S: f64 = 1e-6;

/// Commands, each of which holds until the next one.
#[derive(Clone, Debug, PartialEq)]
pub struct CommandFile {
    /// Times of their beginnings (s), ascending from 0.
    times_s: Vec<f64>,
    /// Forward velocity and velocity to the left (m/s), yaw rate (rad/s).
    commands: Vec<[f64; 3]>,
}

impl CommandFile {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Usage`] with file, line and value.
    pub fn read(path: &Path) -> Result<Self, Usage> {
        let refuse = |why: String| Usage(format!("--commands {}{why}", path.display()));
        let text = text(path).map_err(|why| refuse(format!(": cannot be read: {why}")))?;
        Self::parse(&text).map_err(refuse)
    }

    /// Reads the lines `time_s,vx,vy,yaw_rate`, without comments, empty lines and a header.
    fn parse(text: &str) -> Result<Self, String> {
        let (mut times_s, mut commands) = (Vec::new(), Vec::new());
        let mut may_be_header = true;
        // Spreadsheets begin with a byte order mark.
        for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
            let content = line.split('#').next().unwrap_or_default().trim();
            if content.is_empty() {
                continue;
            }
            let cells: Vec<&str> = content.split(',').map(str::trim).collect();
            if std::mem::take(&mut may_be_header) && cells == COLUMNS {
                continue;
            }
            let [time_s, command @ ..] = values(&cells).map_err(|why| format!(", line {number}: {why}"))?;
            if times_s.len() == LINES_MAX {
                return Err(format!(", line {number}: there are more than {LINES_MAX} commands; allowed: {LINES_MAX}"));
            }
            match times_s.last() {
                None if time_s != 0.0 => {
                    return Err(format!(", line {number}: time_s is {time_s}; the first time must be 0"));
                }
                Some(before) if time_s <= *before => {
                    return Err(format!(
                        ", line {number}: time_s is {time_s}, after {before} in the line before; times must ascend"
                    ));
                }
                _ => {}
            }
            times_s.push(time_s);
            commands.push(command);
        }
        match times_s.is_empty() {
            true => {
                Err(": there is no command; give at least the line `0,0.5,0,0` (time_s,vx,vy,yaw_rate)".to_string())
            }
            false => Ok(Self { times_s, commands }),
        }
    }

    /// Returns the times of the commands that begin at `end_s` or later (s), when an episode is over.
    #[must_use]
    pub fn after(&self, end_s: f64) -> &[f64] {
        &self.times_s[self.times_s.partition_point(|begin_s| *begin_s + EARLY_S < end_s)..]
    }

    /// Returns the command at a time since the start of an episode (s).
    #[must_use]
    pub fn at(&self, time_s: f64) -> [f64; 3] {
        let begun = self.times_s.partition_point(|begin_s| *begin_s <= time_s + EARLY_S);
        self.commands[begun.saturating_sub(1)]
    }
}

fn text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    File::open(path)?.take(BYTES_MAX + 1).read_to_string(&mut text)?;
    if text.len() as u64 > BYTES_MAX {
        return Err(io::Error::other(format!("it has more than {BYTES_MAX} bytes; allowed: {BYTES_MAX}")));
    }
    Ok(text)
}

/// Returns the values of a line.
fn values(cells: &[&str]) -> Result<[f64; 4], String> {
    let Ok(cells) = <[&str; 4]>::try_from(cells) else {
        return Err(format!("`{}` has {} values instead of 4: {}", cells.join(","), cells.len(), COLUMNS.join(",")));
    };
    let mut values = [0.0; 4];
    for (value, (name, cell)) in values.iter_mut().zip(COLUMNS.into_iter().zip(cells)) {
        *value = match cell.parse::<f64>() {
            Ok(number) if number.is_finite() => number,
            _ => return Err(format!("{name} is `{cell}`, which is not a finite number")),
        };
        if name != COLUMNS[0] && value.abs() > COMMAND_MAX {
            return Err(format!("{name} is {cell}; allowed: -{COMMAND_MAX} to {COMMAND_MAX}"));
        }
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_command_holds_until_the_next_one() {
        let file = "\u{feff}# turns\ntime_s, vx, vy, yaw_rate\n0,0.5,0,0\n\n 0.3 , -5, 0.1,1e-1 # turn\n2,0,0,5\n";
        let file = CommandFile::parse(file).unwrap();
        let (first, second, third) = ([0.5, 0.0, 0.0], [-5.0, 0.1, 0.1], [0.0, 0.0, 5.0]);
        for (time_s, expected) in
            [(0.0, first), (0.28, first), (0.3, second), (1.999, second), (2.0, third), (1e6, third)]
        {
            assert_eq!(file.at(time_s), expected, "{time_s}");
        }
        // 15 steps of 0.02 s, rounded down.
        assert_eq!(file.at(0.3_f64.next_down()), second);
    }

    #[test]
    fn what_is_wrong_is_named_with_line_and_value() {
        for (text, expected) in [
            ("", ": there is no command"),
            ("# nothing\ntime_s,vx,vy,yaw_rate\n", ": there is no command"),
            ("1,0,0,0\n", ", line 1: time_s is 1; the first time must be 0"),
            ("-1,0,0,0\n", ", line 1: time_s is -1; the first time must be 0"),
            ("0,0,0,0\n2,0,0,0\n2,0,0,0\n", ", line 3: time_s is 2, after 2 in the line before"),
            ("0,0,0,0\n#\n2,0,0,0\n1.5,0,0,0\n", ", line 4: time_s is 1.5, after 2 in"),
            ("0,0,0,NaN\n", ", line 1: yaw_rate is `NaN`, which is not a finite number"),
            ("0,0,inf,0\n", ", line 1: vy is `inf`"),
            ("0,0,0,0\ninf,0,0,0\n", ", line 2: time_s is `inf`"),
            ("0,fast,0,0\n", ", line 1: vx is `fast`"),
            ("0,0,0,0\ntime_s,vx,vy,yaw_rate\n", ", line 2: time_s is `time_s`"),
            ("0,5.01,0,0\n", ", line 1: vx is 5.01; allowed: -5 to 5"),
            ("0,0,0,-6\n", ", line 1: yaw_rate is -6; allowed: -5 to 5"),
            ("0,1,0\n", ", line 1: `0,1,0` has 3 values instead of 4: time_s,vx,vy,yaw_rate"),
        ] {
            let why = CommandFile::parse(text).unwrap_err();
            assert!(why.starts_with(expected), "{why} instead of {expected}");
        }
        let lines = |count: usize| (0..count).map(|index| format!("{index},0,0,0\n")).collect::<String>();
        assert!(CommandFile::parse(&lines(LINES_MAX)).is_ok());
        let why = CommandFile::parse(&lines(LINES_MAX + 1)).unwrap_err();
        assert!(why.starts_with(", line 10001: there are more than 10000 commands"), "{why}");
    }
}
