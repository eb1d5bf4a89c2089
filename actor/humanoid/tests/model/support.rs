//! Changed texts, and their errors.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use treadmill_humanoid::{Model, ModelFiles, read_model_file};

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

/// Temporary folder of one test.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("treadmill-{name}-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        Self(folder)
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, bytes).expect("a file");
    }

    /// Reads a model file.
    pub fn read(&self, name: &str) -> Result<String, String> {
        self.read_with(name, &ModelFiles::default())
    }

    pub fn read_with(&self, name: &str, files: &ModelFiles) -> Result<String, String> {
        read_model_file(&self.0.join(name), files).map_err(|error| error.to_string())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
