//! Reads a flag that names a file.

use std::path::PathBuf;

use treadmill_runtime::words::nearest_path;

/// Returns the path of a file that exists; the error names the one that a misspelled path may mean.
///
/// # Errors
/// If there is no such file.
pub fn existing_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.exists() {
        return Ok(path);
    }
    let hint = nearest_path(&path).map(|near| format!("; did you mean `{near}`?"));
    Err(format!("it does not exist{}", hint.unwrap_or_default()))
}
