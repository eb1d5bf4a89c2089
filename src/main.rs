//! Program `treadmill`; the code is in the library `treadmill_rl`.

use std::process::ExitCode;

fn main() -> ExitCode {
    treadmill_rl::main(&[])
}
