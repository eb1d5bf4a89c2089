//! Commands from the keyboard.
//!
//! Without a terminal, standard input is read as if its letters were typed, so that a program can steer, too.

use std::{
    io::{self, IsTerminal, Read, Write},
    sync::mpsc::{Receiver, sync_channel},
    thread,
};

use ratatui::crossterm::terminal;
use treadmill_config::VelocityConfig;

/// Keys, for the first line of the output.
pub const KEYS: &str = "keys: w s forward and back, a d left and right, q e turn, space stops, x ends";
/// Change of a velocity by one key (m/s, rad/s).
const STEP: f64 = 0.1;
/// Most keys that wait.
const QUEUE: usize = 256;

/// Source and state of the command.
pub struct Steering {
    keys: Receiver<u8>,
    wheel: Wheel,
    is_terminal: bool,
}

/// Command within the ranges of the task.
#[derive(Clone, Debug)]
struct Wheel {
    command: [f64; 3],
    ranges: [[f64; 2]; 3],
}

impl Steering {
    /// Begins to read keys; commands stay within the ranges of `velocity`.
    pub fn begin(velocity: &VelocityConfig) -> io::Result<Self> {
        let is_terminal = io::stdin().is_terminal();
        if is_terminal {
            terminal::enable_raw_mode()?;
        }
        let (sender, keys) = sync_channel(QUEUE);
        thread::Builder::new().name("keys".to_owned()).spawn(move || {
            let mut byte = [0];
            while io::stdin().read_exact(&mut byte).is_ok() && sender.send(byte[0]).is_ok() {}
        })?;
        let ranges = [velocity.lin_vel_x_mps, velocity.lin_vel_y_mps, velocity.ang_vel_z_radps];
        Ok(Self { keys, wheel: Wheel { command: [0.0; 3], ranges }, is_terminal })
    }

    /// Returns the present command: forward and left (m/s), yaw rate (rad/s). `None` after the key that ends.
    pub fn command(&mut self) -> Option<[f64; 3]> {
        while let Ok(key) = self.keys.try_recv() {
            if !self.wheel.turn(key) {
                return None;
            }
        }
        // Without a terminal the last command holds.
        Some(self.wheel.command)
    }

    /// Shows command and actual velocity in the terminal's last line.
    pub fn show(&self, actual: [f64; 3]) {
        if self.is_terminal {
            let [x, y, yaw] = self.wheel.command;
            let line = format!(
                "forward {x:+.2} ({:+.2}) m/s  left {y:+.2} ({:+.2}) m/s  turn {yaw:+.2} ({:+.2}) rad/s",
                actual[0], actual[1], actual[2]
            );
            let _ = write!(io::stdout().lock(), "\r{line}\x1b[K").and_then(|()| io::stdout().flush());
        }
    }
}

impl Drop for Steering {
    fn drop(&mut self) {
        if self.is_terminal {
            let _ = terminal::disable_raw_mode();
            let _ = writeln!(io::stdout().lock());
        }
    }
}

impl Wheel {
    /// Applies a key; returns false for the key that ends.
    fn turn(&mut self, key: u8) -> bool {
        let (entry, change) = match key {
            b'w' => (0, STEP),
            b's' => (0, -STEP),
            b'a' => (1, STEP),
            b'd' => (1, -STEP),
            b'q' => (2, STEP),
            b'e' => (2, -STEP),
            b' ' => {
                self.command = [0.0; 3];
                return true;
            }
            // Ctrl-C and Ctrl-D are letters in raw mode.
            b'x' | 3 | 4 => return false,
            _ => return true,
        };
        let [low, high] = self.ranges[entry];
        // Steps of a tenth stay tenths.
        let wanted = ((self.command[entry] + change) * 100.0).round() / 100.0;
        self.command[entry] = wanted.clamp(low.min(0.0), high.max(0.0));
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_change_the_command_within_its_ranges() {
        let mut wheel = Wheel { command: [0.0; 3], ranges: [[-0.5, 1.0], [-0.3, 0.3], [0.2, 0.5]] };
        let mut type_in = |letters: &str| {
            assert!(letters.bytes().all(|letter| wheel.turn(letter)));
            wheel.command
        };
        assert_eq!(type_in("wwwaq"), [0.3, 0.1, 0.1]);
        assert_eq!(type_in("wwwwwwwwwwww"), [1.0, 0.1, 0.1]);
        assert_eq!(type_in("ddddddd"), [1.0, -0.3, 0.1]);
        assert_eq!(type_in("eeee"), [1.0, -0.3, 0.0], "a range without its other side ends at rest");
        assert_eq!(type_in("? "), [0.0; 3]);
        assert_eq!(type_in("ssssssss"), [-0.5, 0.0, 0.0]);
        assert!(!wheel.turn(b'x') && !wheel.turn(3));
    }
}
