//! Commands from the keyboard, and from a gamepad where there is one.
//!
//! Without a terminal, standard input is read as if its letters were typed, so that a program can steer, too.

use std::{
    fs::File,
    io::{self, IsTerminal, Read, Write},
    path::Path,
    sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel},
    thread,
};

use ratatui::crossterm::terminal;
use treadmill_config::VelocityConfig;

/// Keys, for the first line of the output.
pub const KEYS: &str =
    "keys: w s forward and back, a d left and right, q e turn, space stops, x ends; a gamepad's sticks do the same";
/// Change of a velocity by one key (m/s, rad/s).
const STEP: f64 = 0.1;
/// Most inputs that wait.
const QUEUE: usize = 256;
/// Joystick of Linux, which sends events of eight bytes.
const GAMEPAD: &str = "/dev/input/js0";
const EVENT_BYTES: usize = 8;
const AXIS_EVENT: u8 = 2;
/// Part of an axis around its middle that counts as its middle.
const DEAD_ZONE: f64 = 0.1;

/// Source and state of the command.
pub struct Steering {
    inputs: Receiver<Input>,
    wheel: Wheel,
    is_terminal: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Input {
    Key(u8),
    /// Number of an axis, and its position from −1 to 1.
    Axis(u8, f64),
}

/// Command within the ranges of the task.
#[derive(Clone, Debug)]
struct Wheel {
    command: [f64; 3],
    ranges: [[f64; 2]; 3],
}

impl Steering {
    /// Begins to read keys and gamepad; commands stay within the ranges of `velocity`.
    pub fn begin(velocity: &VelocityConfig) -> io::Result<Self> {
        let is_terminal = io::stdin().is_terminal();
        if is_terminal {
            terminal::enable_raw_mode()?;
        }
        let (sender, inputs) = sync_channel(QUEUE);
        let gamepad = sender.clone();
        thread::Builder::new().name("keys".to_owned()).spawn(move || read_keys(&mut io::stdin(), &sender))?;
        if Path::new(GAMEPAD).exists() {
            thread::Builder::new().name("gamepad".to_owned()).spawn(move || {
                if let Ok(mut device) = File::open(GAMEPAD) {
                    read_gamepad(&mut device, &gamepad);
                }
            })?;
        }
        let ranges = [velocity.lin_vel_x_mps, velocity.lin_vel_y_mps, velocity.ang_vel_z_radps];
        Ok(Self { inputs, wheel: Wheel { command: [0.0; 3], ranges }, is_terminal })
    }

    /// Returns the present command: forward and left (m/s), yaw rate (rad/s). `None` after the key that ends.
    pub fn command(&mut self) -> Option<[f64; 3]> {
        loop {
            match self.inputs.try_recv() {
                Ok(input) if !self.wheel.turn(input) => return None,
                Ok(_) => {}
                // Without a terminal the last command holds.
                Err(TryRecvError::Empty | TryRecvError::Disconnected) => return Some(self.wheel.command),
            }
        }
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
    /// Applies an input; returns false for the key that ends.
    fn turn(&mut self, input: Input) -> bool {
        let (entry, change) = match input {
            Input::Axis(axis, position) => return self.tilt(axis, position),
            Input::Key(b'w') => (0, STEP),
            Input::Key(b's') => (0, -STEP),
            Input::Key(b'a') => (1, STEP),
            Input::Key(b'd') => (1, -STEP),
            Input::Key(b'q') => (2, STEP),
            Input::Key(b'e') => (2, -STEP),
            Input::Key(b' ') => {
                self.command = [0.0; 3];
                return true;
            }
            // Ctrl-C and Ctrl-D are letters in raw mode.
            Input::Key(b'x' | 3 | 4) => return false,
            Input::Key(_) => return true,
        };
        let [low, high] = self.ranges[entry];
        // Steps of a tenth stay tenths.
        let wanted = ((self.command[entry] + change) * 100.0).round() / 100.0;
        self.command[entry] = wanted.clamp(low.min(0.0), high.max(0.0));
        true
    }

    /// Applies a stick: up is forward, left is left; the second stick turns.
    fn tilt(&mut self, axis: u8, position: f64) -> bool {
        let entry = match axis {
            1 => 0,
            0 => 1,
            3 => 2,
            _ => return true,
        };
        let [low, high] = self.ranges[entry];
        let share = if position.abs() < DEAD_ZONE { 0.0 } else { -position };
        self.command[entry] = if share < 0.0 { -share * low.min(0.0) } else { share * high.max(0.0) };
        true
    }
}

/// Sends each byte until the input ends or its receiver is gone.
fn read_keys(input: &mut impl Read, keys: &SyncSender<Input>) {
    let mut byte = [0];
    while input.read_exact(&mut byte).is_ok() && keys.send(Input::Key(byte[0])).is_ok() {}
}

/// Sends each movement of an axis; an event is a time (4 bytes), a position (2), a kind and a number.
fn read_gamepad(device: &mut impl Read, inputs: &SyncSender<Input>) {
    let mut event = [0; EVENT_BYTES];
    while device.read_exact(&mut event).is_ok() {
        let [_, _, _, _, low, high, kind, number] = event;
        let position = f64::from(i16::from_le_bytes([low, high])) / f64::from(i16::MAX);
        // The device first reports every axis with another bit set: at rest, which changes nothing.
        if kind == AXIS_EVENT && inputs.send(Input::Axis(number, position)).is_err() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wheel() -> Wheel {
        Wheel { command: [0.0; 3], ranges: [[-0.5, 1.0], [-0.3, 0.3], [0.2, 0.5]] }
    }

    #[test]
    fn keys_change_the_command_within_its_ranges() {
        let mut wheel = wheel();
        let mut type_in = |letters: &str| {
            assert!(letters.bytes().all(|letter| wheel.turn(Input::Key(letter))));
            wheel.command
        };
        assert_eq!(type_in("wwwaq"), [0.3, 0.1, 0.1]);
        assert_eq!(type_in("wwwwwwwwwwww"), [1.0, 0.1, 0.1]);
        assert_eq!(type_in("ddddddd"), [1.0, -0.3, 0.1]);
        assert_eq!(type_in("eeee"), [1.0, -0.3, 0.0], "a range without its other side ends at rest");
        assert_eq!(type_in("? "), [0.0; 3]);
        assert_eq!(type_in("ssssssss"), [-0.5, 0.0, 0.0]);
        assert!(!wheel.turn(Input::Key(b'x')) && !wheel.turn(Input::Key(3)));
    }

    #[test]
    fn sticks_are_shares_of_the_ranges() {
        let (sender, inputs) = sync_channel(8);
        // Axis 1 up by all, axis 0 right by half, a button, axis 0 reported at the start.
        let events: [[u8; 8]; 4] = [
            [0, 0, 0, 0, 0x01, 0x80, 2, 1],
            [0, 0, 0, 0, 0, 0x40, 2, 0],
            [0, 0, 0, 0, 1, 0, 1, 0],
            [0, 0, 0, 0, 9, 9, 0x82, 0],
        ];
        read_gamepad(&mut &events.concat()[..], &sender);
        let mut wheel = wheel();
        inputs.try_iter().for_each(|input| assert!(wheel.turn(input)));
        assert_eq!(wheel.command[0], 1.0);
        assert!((wheel.command[1] + 0.15).abs() < 1e-4, "{:?}", wheel.command);
        wheel.turn(Input::Axis(1, 0.05));
        assert_eq!(wheel.command[0], 0.0, "near the middle is the middle");
    }
}
