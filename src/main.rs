//! The program `treadmill`; the library beside it has everything.

use std::process::ExitCode;

fn main() -> ExitCode {
    treadmill_rl::main()
}
