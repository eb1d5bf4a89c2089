//! Changed texts, and their errors.

use treadmill_humanoid::Model;

/// Returns the error of a text, with its cause.
pub fn problem(text: &str) -> String {
    let Err(error) = Model::from_mjcf(text) else { panic!("accepted: {text}") };
    match std::error::Error::source(&error) {
        Some(cause) => format!("{error}: {cause}"),
        None => error.to_string(),
    }
}

/// Returns a text with one place changed.
pub fn changed(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "there is no {from}");
    text.replacen(from, to, 1)
}
