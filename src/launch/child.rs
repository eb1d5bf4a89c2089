//! Child processes that end with this one.

use std::{io, os::unix::process::CommandExt, path::Path, process::Command};

/// Returns the command of a program at this nice value. The process is killed when the thread that starts it ends.
pub fn command(program: &Path, nice: i32) -> Command {
    let mut command = Command::new(program);
    // SAFETY: between fork and exec, nice and prctl are allowed, and they access no memory here.
    unsafe {
        command.pre_exec(move || {
            // Fails only for negative values.
            libc::nice(nice);
            match libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL) {
                0 => Ok(()),
                _ => Err(io::Error::last_os_error()),
            }
        });
    }
    command
}
