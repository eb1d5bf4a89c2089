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

/// Model text that other tests change.
pub struct Text(pub &'static str);

impl Text {
    /// Asserts that each change of the text is refused with a message that contains all parts.
    pub fn assert_refused(&self, cases: &[(&str, &str, &[&str])]) {
        assert!(Model::from_mjcf(self.0).is_ok());
        for (from, to, parts) in cases {
            let message = problem(&changed(self.0, from, to));
            assert!(parts.iter().all(|part| message.contains(part)), "`{to:.60}`: {parts:?} are missing in: {message}");
        }
    }
}
