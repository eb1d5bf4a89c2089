//! Starts this program anew in the same process.

use std::{
    env,
    ffi::OsString,
    io,
    os::unix::process::CommandExt,
    process::{self, Command},
    thread,
    time::Duration,
};

/// Environment variable of a new start: the process, which its children are not, and its pause in milliseconds.
const VARIABLE: &str = "TREADMILL_RESTARTED";

/// Replaces this program by a new start of itself with the same arguments, except that each flag of `values` gets these
/// values. Links, memory and threads of the present start end with it, whatever their state. The new one begins after
/// `pause`. Returns only if the system refuses.
pub fn restart(values: &[(&str, Vec<String>)], pause: Duration) -> io::Error {
    let mut arguments = env::args_os();
    let name = arguments.next().unwrap_or_default();
    // Also if the file of the program was replaced meanwhile.
    let program =
        if cfg!(target_os = "linux") { Ok("/proc/self/exe".into()) } else { env::current_exe().map(Into::into) };
    let pause = format!("{} {}", process::id(), pause.as_millis());
    let command = |program: OsString| {
        Command::new(program).arg0(name).args(replaced(arguments, values)).env(VARIABLE, pause).exec()
    };
    program.map_or_else(|why| why, command)
}

/// Waits for the pause of a start that [`restart`] made.
pub fn pause() {
    if let Some(pause_ms) = pause_ms() {
        thread::sleep(Duration::from_millis(pause_ms));
    }
}

/// Returns whether [`restart`] made this start.
pub fn is_restarted() -> bool {
    pause_ms().is_some()
}

fn pause_ms() -> Option<u64> {
    let given = env::var(VARIABLE).unwrap_or_default();
    let (process, pause_ms) = given.split_once(' ')?;
    (process == process::id().to_string()).then(|| pause_ms.parse().unwrap_or(0))
}

fn replaced(arguments: impl Iterator<Item = OsString>, values: &[(&str, Vec<String>)]) -> Vec<OsString> {
    let mut kept = Vec::new();
    let mut is_value = false;
    for argument in arguments {
        let text = argument.to_string_lossy();
        let is_flag = values.iter().any(|(flag, _)| text == *flag);
        let has_value =
            values.iter().any(|(flag, _)| text.strip_prefix(flag).is_some_and(|rest| rest.starts_with('=')));
        if !is_value && !is_flag && !has_value {
            kept.push(argument);
        }
        is_value = is_flag && !is_value;
    }
    let added =
        values.iter().flat_map(|(flag, values)| values.iter().map(move |value| format!("{flag}={value}").into()));
    kept.into_iter().chain(added).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_get_their_new_values_and_others_stay() {
        let old = ["learner", "--listen", "tcp/h:0", "--store", "file:///s", "--listen=tcp/h:1", "--listener", "-v"];
        let values = [("--listen", vec!["tcp/h:5".to_string(), "tcp/h:1".to_string()]), ("--prometheus", Vec::new())];
        let new = replaced(old.into_iter().map(OsString::from), &values);
        let wanted = ["learner", "--store", "file:///s", "--listener", "-v", "--listen=tcp/h:5", "--listen=tcp/h:1"];
        assert_eq!(new, wanted.map(OsString::from));
    }
}
