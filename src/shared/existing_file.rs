//! Reads a flag that names a file.

use std::path::PathBuf;

use treadmill_runtime::words::nearest_path;

/// Returns the path of a file that exists; the error names the one that a misspelled path may mean.
///
/// # Errors
/// If there is no such file.
pub fn existing_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let Err(why) = path.metadata() else { return Ok(path) };
    let hint = nearest_path(&path).map(|near| format!("; did you mean `{near}`?"));
    Err(format!("it cannot be read: {why}{}", hint.unwrap_or_default()))
}
